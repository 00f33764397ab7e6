"""Golden cases of the dynamic blocks: lead-lags, integrals, delays.

Coefficients come from scipy's discretisation, sums from exact fractions. Parameters change while the blocks run, and
samples are missing.
"""
import math
from fractions import Fraction

import numpy as np
from scipy.signal import cont2discrete

import golden


def good(x):
    return math.isfinite(x)


class Lag:
    """One pole and one zero: b0 x + b1 x' - a1 y'; rest is the gain that the first output takes."""

    def __init__(self):
        self.y = 0.0
        self.before = None
        self.started = False

    def step(self, x, num, den, method, period, alpha=None):
        num, den, _ = cont2discrete((num, den), period, method=method, alpha=alpha)
        (b0, b1), (_, a1) = num.flatten(), den
        if good(x):
            if not self.started:
                self.y = x * num.sum() / den.sum()
            else:
                self.y = b0 * x + b1 * (x if self.before is None else self.before) - a1 * self.y
            self.started = True
        self.before = x if good(x) else None
        return self.y

    def track(self, x, y):
        if good(y):
            self.y, self.started = y, True
        self.before = x if good(x) else None
        return self.y


def wave(k):
    return round(3 * math.sin(0.2 * k) + (2 if k > 25 else 0) + 0.1 * (k * 7 % 5), 6)


def lead_lags():
    period, steps = 0.1, 120
    program = """
! Lead-lags; T2 and k change while they run, two samples are missing, trk holds b for a while.
CONTROL
1 x = ain ( : 0, 1, 1 )
2 trk = msi ( : 0 )
3 xt = ain ( : 0, 1, 2 )
4 a = leadlag ( x : 2., 0.5, 1.5 )
5 b = leadlag ( x, trk, xt : 1., 0., 3. )
6 c = leadlag ( x : -0.5, -0.2, 0.3 )
7 w = washout ( x : 0.8 )
8 d = deriv ( x : 0.6, 5. )
9 e = deriv ( x : 0., 8. )
END
"""
    blocks = {name: Lag() for name in "abcwde"}
    stimulus, trace = [], []
    for k in range(steps):
        x = math.nan if k in (0, 40, 41, 90) else wave(k)
        trk = 1 if 60 <= k < 70 else 0
        xt = math.nan if k == 64 else round(7 - 0.1 * k, 6)
        gain = 1.25 if k >= 50 else 2.0
        lag = 0.4 if k >= 75 else 1.5
        derivative = 1.5 if k >= 80 else 0.6
        stimulus.append([k, x, trk, xt, gain, lag, derivative])
        row = [
            blocks["a"].step(x, [gain * 0.5, gain], [lag, 1], "bilinear", period),
            blocks["b"].track(x, xt) if trk else blocks["b"].step(x, [0.0, 1], [3.0, 1], "bilinear", period),
            blocks["c"].step(x, [-0.5 * -0.2, -0.5], [0.3, 1], "bilinear", period),
            blocks["w"].step(x, [0.8, 0], [0.8, 1], "backward_diff", period),
            blocks["d"].step(x, [derivative, 0], [derivative / 5.0, 1], "backward_diff", period),
            0.0,
        ]
        trace.append([k] + row)
    golden.write("lead_lags", program,
                 (["ain(0,1,1)", "trk.value", "ain(0,1,2)", "a.k", "a.T2", "d.Td"], stimulus),
                 (list("abcwde"), trace), "scipy's bilinear and backward forms in another order of the sums", period=period)


class Integral:
    """Exact; clamped."""

    def __init__(self, y0):
        self.y = Fraction(y0)
        self.before = None

    def step(self, x, k, lo, hi, y0, mode, period, hold=0, rst=0):
        if rst:
            self.y = Fraction(y0)
        elif good(x) and not hold:
            other = self.before if mode == "trap" and self.before is not None else x
            self.y += Fraction(k) * Fraction(period) / 2 * (Fraction(x) + Fraction(other))
        self.y = min(max(self.y, Fraction(lo)), Fraction(hi))
        self.before = x if good(x) else None
        return float(self.y)


def integrals():
    period, steps = 0.25, 120
    program = """
! Integrals: trapezoids and rectangles, clamped, held, reset; k and the mode change. Totals per second and per hour.
CONTROL
1 x = ain ( : 0, 1, 1 )
2 stop = msi ( : 0 )
3 rst = msi ( : 0 )
4 a = integ ( x, stop, rst : 2., -5., 9., 1., trap )
5 b = integ ( x : k = 0.5, mode = euler )
6 s, sw = total ( x, rst : 3., s, 0.5 )
7 h, hw = total ( x : k = 1000., unit = h )
8 f, fw = total ( x : k = 2e8 )
END
"""
    a, b = Integral(1.0), Integral(0.0)
    totals = {"s": Fraction(0), "h": Fraction(0), "f": Fraction(0)}
    stimulus, trace = [], []
    for k in range(steps):
        x = math.nan if k in (30, 31, 80) else wave(k)
        stop = 1 if 45 <= k < 50 else 0
        rst = 1 if k in (60, 61) else 0
        gain = 0.75 if k >= 70 else 2.0
        mode = "euler" if k >= 100 else "trap"
        stimulus.append([k, x, stop, rst, gain, 1 if mode == "euler" else 0])
        row = [a.step(x, gain, -5, 9, 1, mode, period, stop, rst), b.step(x, 0.5, -10**30, 10**30, 0, "euler", period)]
        for name, factor, cut, reset in (("s", Fraction(3), 0.5, rst), ("h", Fraction(1000, 3600), 0, 0), ("f", Fraction(2e8), 0, 0)):
            if reset:
                totals[name] = Fraction(0)
            elif good(x) and x >= cut and x > 0:
                totals[name] += min(factor * Fraction(period) * Fraction(x), 5 * 10**8)
            row += [float(totals[name] % 10**9), int(totals[name] // 10**9)]
        trace.append([k] + row)
    golden.write("integrals", program, (["ain(0,1,1)", "stop.value", "rst.value", "a.k", "a.mode"], stimulus),
                 (["a", "b", "s", "sw", "h", "hw", "f", "fw"], trace), "exact sums", period=period,
                 single=(1e-4, "a float holds eight digits of 1e9 counts"))


def slow_integral():
    """What a plain float sum never does: 50 + 2.8e-7 is 50."""
    program = """
! A slow integral that a plain sum in float would not move, and a total of small counts.
CONTROL
1 e = msc ( : 0.1 )
2 y = integ ( e : k = 0.0002777777777777778, y0 = 50., mode = euler )
3 z = integ ( e : k = 0.0002777777777777778, y0 = 50. )
4 r, wrap = total ( e : k = 0.001 )
END
"""
    period, steps = 0.01, 300
    step = Fraction(0.0002777777777777778) * Fraction(0.01) * Fraction(0.1)
    trace = []
    for k in range(steps):
        y = float(50 + (k + 1) * step)
        trace.append([k, y, y, float((k + 1) * Fraction(1e-3) * Fraction(0.01) * Fraction(0.1))])
    golden.write("slow_integral", program, (["e.value"], [[k, 0.1] for k in range(steps)]), (["y", "z", "r"], trace),
                 "exact sums", period=period, single=(1.2e-7, "one unit in the last place of a float", 1e-9))


def delays():
    period, steps = 0.5, 100
    program = """
! Delays by scans and by a time that changes; means; samples held. Samples of x and td are missing.
CONTROL
1 x = ain ( : 0, 1, 1 )
2 td = ain ( : 0, 1, 2 )
3 trig = msi ( : 0 )
4 a = delay ( x, 1 : 0.5 )
5 b = delay ( x, 7 : )
6 c = dead ( x, td, 6 : )
7 d = dead ( x, td, 1 : )
8 m = mavg ( x, 5 : )
9 n = mavg ( x, 1 : )
10 s = hold ( x, trig : )
END
"""
    seen = {name: [] for name in "abcdmn"}
    out = {"a": 0.5, "b": 0.0, "c": 0.0, "d": 0.0, "m": 0.0, "n": 0.0, "s": 0.0}
    trig1, started = 0, False
    stimulus, trace = [], []

    def dead(name, x, td, most):
        if good(x) and good(td):
            samples = seen[name]
            samples.append(x)
            times = period * (np.arange(len(samples)) - len(samples) + 1)
            out[name] = float(np.interp(-min(max(td, 0.0), most * period), times, samples))

    def late(name, x, n, x0):
        if good(x):
            seen[name].append(x)
            out[name] = seen[name][-1 - n] if len(seen[name]) > n else x0

    def mean(name, x, n):
        if good(x):
            seen[name].append(x)
            out[name] = float(np.mean(([seen[name][0]] * n + seen[name])[-n:]))

    for k in range(steps):
        x = math.nan if k in (0, 33, 34, 72) else wave(k)
        td = math.nan if k == 20 else round(1.1 + 0.02 * k - (3.3 if k > 80 else 0), 6) if k < 90 else 5.0
        trig = 1 if k % 9 in (3, 4) or 32 <= k < 37 else 0
        stimulus.append([k, x, td, trig])
        late("a", x, 1, 0.5)
        late("b", x, 7, 0.0)
        dead("c", x, td, 6)
        dead("d", x, td, 1)
        mean("m", x, 5)
        mean("n", x, 1)
        if good(x):
            if not started or (trig and not trig1):
                out["s"] = x
            started, trig1 = True, trig
        trace.append([k] + [out[name] for name in "abcdmns"])
    golden.write("delays", program, (["ain(0,1,1)", "ain(0,1,2)", "trig.value"], stimulus), (list("abcdmns"), trace),
                 "numpy's interpolation and mean", period=period)


lead_lags()
integrals()
slow_integral()
delays()

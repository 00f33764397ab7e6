"""Golden cases of the dynamic blocks: lead-lags, integrals, delays, plants, difference equations, programs.

Coefficients come from scipy's discretisation, sums from exact fractions. Parameters change while the blocks run, and
samples are missing.
"""
import math
from fractions import Fraction

import numpy as np
from scipy.signal import chirp, cont2discrete, dlsim, lfilter, lfiltic

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


def slow_in_float():
    """What a plain float sum never does: 50 + 2.8e-7 is 50."""
    program = """
! Slow blocks that a plain sum in float would not move, and a total of small counts.
CONTROL
1 e = msc ( : 0.1 )
2 y = integ ( e : k = 0.0002777777777777778, y0 = 50., mode = euler )
3 z = integ ( e : k = 0.0002777777777777778, y0 = 50. )
4 r, wrap = total ( e : k = 0.001 )
5 g = ramp ( e : 0.00002, 50. )
6 x = stepgen ( : 50., 51., 0.01 )
7 l = leadlag ( x : 1., 0., 2000. )
8 f = fopdt ( x, 1 : 1., 2000., 0. )
9 s = lag2 ( x : 1., 0.01, 1. )
10 w = washout ( x : 2000. )
END
"""
    period, steps = 0.01, 300
    step = Fraction(0.0002777777777777778) * Fraction(0.01) * Fraction(0.1)
    lag, high, plant, second = Lag(), Lag(), Delayed(), Delayed()
    trace = []
    for k in range(steps):
        y = float(50 + (k + 1) * step)
        x = 51.0 if k else 50.0
        trace.append([
            k, y, y, float((k + 1) * Fraction(1e-3) * Fraction(0.01) * Fraction(0.1)), 50 - (k + 1) * 2e-7,
            lag.step(x, [0.0, 1], [2000.0, 1], "bilinear", period),
            plant.step(x, [[-1 / 2000]], [1 / 2000], [[1.0]], 0.0, period),
            second.step(x, [[0, 1], [-1e-4, -0.02]], [0, 1e-4], [[1, 0]], 0.0, period),
            high.step(x, [2000.0, 0], [2000.0, 1], "backward_diff", period),
        ])
    golden.write("slow_in_float", program, (["e.value"], [[k, 0.1] for k in range(steps)]),
                 (["y", "z", "r", "g", "l", "f", "s", "w"], trace), "scipy rounds 1 - 5e-6 before it sums",
                 relative=1e-10, period=period, single=(1.2e-7, "one unit in the last place of a float", 1e-9))


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



class Ring:
    """Past good samples, the first one for ever before."""

    def __init__(self):
        self.samples = []

    def push(self, x):
        self.samples.append(x)

    def past(self, i):
        return self.samples[max(len(self.samples) - 1 - i, 0)]


class Delayed:
    """A state-space plant whose input comes td late: scipy's hold equivalents of the two parts of a scan."""

    def __init__(self):
        self.inputs = Ring()
        self.x = None
        self.y = 0.0

    def step(self, u, a, b, c, td, period):
        if not good(u):
            return self.y
        a, b, c = np.atleast_2d(a).astype(float), np.array(b, dtype=float).reshape(-1, 1), np.atleast_2d(c)
        self.inputs.push(u)
        if self.x is None:
            self.x = np.linalg.solve(a, -b * u)
        whole = math.floor(td / period + 1e-9)
        part = td - whole * period
        for length, late in ((part, whole + 1), (period - part, whole)):
            if length > 1e-9:
                f, g, *_ = cont2discrete((a, b, c, np.zeros((1, 1))), length)
                self.x = f @ self.x + g * self.inputs.past(late)
        self.y = (c @ self.x).item()
        return self.y


def plants():
    period, steps = 0.25, 120
    program = """
! Plants with dead time and the second-order lag, damped, critical and not; parameters change, samples are missing.
CONTROL
1 u = ain ( : 0, 1, 1 )
2 a = fopdt ( u, 8 : 2., 1.5, 0.6 )
3 b = fopdt ( u, 2 : -1., 400., 0.5 )
4 c = fopdt ( u, 1 : 1., 0.03, 0. )
5 d = sopdt ( u, 8 : 1.5, 2., 0.5, 0.35 )
6 e = sopdt ( u, 4 : 1., 0.7, 0.7, 1. )
7 f = lag2 ( u : 2., 1.5, 0.3 )
8 g = lag2 ( u : 1., 2., 1. )
9 h = lag2 ( u : 0.5, 3., 4. )
END
"""
    blocks = {name: Delayed() for name in "abcdefgh"}
    stimulus, trace = [], []

    def first(k, tau):
        return [[-1 / tau]], [k / tau], [[1.0]]

    def series(k, one, two):
        return [[-1 / one, 0], [1 / two, -1 / two]], [k / one, 0], [[0, 1]]

    def second(k, wn, z):
        return [[0, 1], [-wn * wn, -2 * z * wn]], [0, k * wn * wn], [[1, 0]]

    for k in range(steps):
        u = math.nan if k in (0, 50, 51) else wave(k)
        late = 1.9 if k >= 40 else 0.6
        lag = 0.8 if k >= 70 else 1.5
        two = 2.0 if k >= 60 else 0.5
        speed = 4.0 if k >= 80 else 1.5
        stimulus.append([k, u, late, lag, two, speed])
        trace.append([k] + [
            blocks["a"].step(u, *first(2.0, lag), late, period),
            blocks["b"].step(u, *first(-1.0, 400.0), 0.5, period),
            blocks["c"].step(u, *first(1.0, 0.03), 0.0, period),
            blocks["d"].step(u, *series(1.5, 2.0, two), 0.35, period),
            blocks["e"].step(u, *series(1.0, 0.7, 0.7), 1.0, period),
            blocks["f"].step(u, *second(2.0, speed, 0.3), 0.0, period),
            blocks["g"].step(u, *second(1.0, 2.0, 1.0), 0.0, period),
            blocks["h"].step(u, *second(0.5, 3.0, 4.0), 0.0, period),
        ])
    golden.write("dead_time_plants", program, (["ain(0,1,1)", "a.td", "a.tau", "d.tau2", "f.wn"], stimulus),
                 (list("abcdefgh"), trace), "scipy's matrix exponentials against expm1", period=period)


class Recursion:
    """The difference equation by scipy's lfilter on what has passed; clamping makes it go sample by sample."""

    def __init__(self, na, nb, d):
        self.na, self.past_x, self.past_y, self.y = na, nb + d, None, 0.0
        self.nb, self.d = nb, d

    def step(self, x, a, b, lo, hi):
        if not good(x):
            return self.y
        if self.past_y is None:
            rest = 0.0 if abs(1 + sum(a)) < 1e-12 else x * sum(b) / (1 + sum(a))
            self.past_y = [min(max(rest, lo), hi)] * self.na
            self.past_x = [x] * (self.nb + self.d)
        numerator = [0.0] * self.d + list(b)
        denominator = [1.0] + list(a)
        state = lfiltic(numerator, denominator, self.past_y, self.past_x)
        self.y = min(max(lfilter(numerator, denominator, [x], zi=state)[0][0], lo), hi)
        self.past_y = ([self.y] + self.past_y)[:self.na]
        self.past_x = [x] + self.past_x[:-1]
        return self.y


def difference_equations():
    period, steps = 0.5, 100
    program = """
! Transfer functions in z, one clamped, one an integrator, one without poles; a state space in five matrices.
INITIALIZE
1 A = setmat ( 2, 2 : 0.9, 0.2, -0.3, 0.7 )
2 B = setmat ( 2, 2 : 1., 0., 0.5, -1. )
3 C = setmat ( 3, 2 : 1., 0., 0., 1., 1., -1. )
4 D = setmat ( 3, 2 : 0., 0., 0.5, 0., 0., 2. )
CONTROL
5 x = ain ( : 0, 1, 1 )
6 u2 = ain ( : 0, 1, 2 )
7 a = ztf ( x, 2, 2, 0 : -1.5, 0.7, 0.3, -0.1, -1e9, 1e9 )
8 b = ztf ( x, 1, 3, 4 : -0.9, 0.2, 0.3, -0.1, -2., 4. )
9 c = ztf ( x, 1, 1, 1 : -1., 0.25, , )
10 d = ztf ( x, 0, 4, 2 : 0.25, 0.25, 0.25, 0.25, , )
11 u = setvec ( 2 : 0., 0. )
12 u = ftov ( 2, x, 1 : )
13 u = ftov ( 2, u2, 2 : )
14 y, s = dss ( u, 2, 2, 3, A, B, C, D : 0.5, -1. )
END
"""
    filters = {"a": Recursion(2, 2, 0), "b": Recursion(1, 3, 4), "c": Recursion(1, 1, 1), "d": Recursion(0, 4, 2)}
    matrices = [np.array(m) for m in ([[0.9, 0.2], [-0.3, 0.7]], [[1.0, 0], [0.5, -1]],
                                      [[1.0, 0], [0, 1], [1, -1]], [[0.0, 0], [0.5, 0], [0, 2]])]
    stimulus, trace, inputs, kept = [], [], [], [0.0, 0.0, 0.0, 0.5, -1.0]
    for k in range(steps):
        x = math.nan if k in (0, 44, 45) else wave(k)
        u2 = math.nan if k == 60 else round(math.cos(0.3 * k), 6)
        gain = 0.6 if k >= 50 else 0.3
        pole = -0.5 if k >= 70 else -0.9
        stimulus.append([k, x, u2, gain, pole])
        row = [
            filters["a"].step(x, [-1.5, 0.7], [gain, -0.1], -1e9, 1e9),
            filters["b"].step(x, [pole], [0.2, 0.3, -0.1], -2.0, 4.0),
            filters["c"].step(x, [-1.0], [0.25], -1e30, 1e30),
            filters["d"].step(x, [], [0.25] * 4, -1e30, 1e30),
        ]
        if good(x) and good(u2):
            inputs.append([x, u2])
            _, outputs, states = dlsim((*matrices, period), np.array(inputs + [[0.0, 0.0]]), x0=[0.5, -1.0])
            kept = list(outputs[len(inputs) - 1]) + list(states[len(inputs) - 1])
        trace.append([k] + row + kept)
    columns = list("abcd") + ["y[1]", "y[2]", "y[3]", "s[1]", "s[2]"]
    golden.write("difference_equations", program, (["ain(0,1,1)", "ain(0,1,2)", "a.b[1]", "b.a[1]"], stimulus),
                 (columns, trace), "scipy's lfilter and dlsim in another order of the sums", period=period)


def programs():
    period, steps = 0.5, 100
    program = """
! Ramps and set-point programs: run, hold, reset, guaranteed soak; step, pulses, triangles, sine, sweep. Rates and periods change.
CONTROL
1 tgt = ain ( : 0, 1, 1 )
2 run = msi ( : 1 )
3 rst = msi ( : 0 )
4 stop = msi ( : 0 )
5 fb = ain ( : 0, 1, 2 )
6 a, there = ramp ( tgt, run, rst : 0.7, 2. )
7 p, seg, done, left = profile ( run, stop, rst, 4 : 1., 4., 4.75, 15., 2., 5., 5., -1., 0. )
8 q, qseg, qdone, qleft = profile ( run, , , 3, fb : 0., 4., 10., 0., 8., 8., 0.75 )
9 one, oseg, odone, oleft = profile ( run, , rst, 1 : 2.25, 3., )
10 s = stepgen ( : -1., 2., 10.2 )
11 u = pulsgen ( : 2., 3.25, 1.1, -1., 2. )
12 t = trigen ( : 2., 7., 0.5, 1.25 )
13 w = singen ( : 1.5, 3.7, 0.4, -0.25, 2.5 )
14 c = sweep ( : 2., 0.05, 0.6, 20., 0.25, 1. )
END
"""
    ns = 10**9
    tick = int(period * ns)
    a = Fraction(2)
    now = {"p": 0, "q": 0, "one": 0}
    tables = {"p": ([1.0, 4.0, 4.75, 15.0], [2.0, 5.0, 5.0, -1.0]), "q": ([0.0, 4.0, 10.0], [0.0, 8.0, 8.0]), "one": ([2.25], [3.0])}
    pulse, triangle, length, sine = -2 * ns, -1250000000, 7 * ns, -2500000000
    stimulus, trace = [], []
    fb_state, ready = 0.0, 0
    for k in range(steps):
        tgt = math.nan if k in (0, 12) else 6.0 if k < 40 else -3.0 if k < 70 else 0.125
        run = 0 if 20 <= k < 24 else 1
        rst = 1 if k in (61, 62) else 0
        stop = 1 if 10 <= k < 13 else 0
        fb = math.nan if k in (5, 6) else round(fb_state, 6)
        rate = 1.3 if k >= 45 else 0.7
        width = 2.0 if k >= 50 else 1.1
        if k == 60:
            triangle, length = triangle * 5 // 7, 5 * ns
        stimulus.append([k, tgt, run, rst, stop, fb, rate, width, length / ns])
        if rst:
            a = Fraction(2)
        elif run and good(tgt):
            step, gap = Fraction(rate) * Fraction(period), Fraction(tgt) - a
            a = Fraction(tgt) if abs(gap) <= step else a + (step if gap > 0 else -step)
        ready = int(a == Fraction(tgt)) if good(tgt) else ready
        row = [float(a), ready]
        for name, (times, values) in tables.items():
            if rst and name != "q":
                now[name] = 0
            y = float(np.interp(now[name] / ns, times, values))
            finished = now[name] >= times[-1] * ns
            row += [y, sum(now[name] >= t * ns for t in times), int(finished), max(times[-1] - now[name] / ns, 0.0)]
            waits = (name == "p" and stop) or (name != "q" and rst) or (name == "q" and not abs(y - fb) <= 0.75)
            if run and not waits and not finished:
                now[name] += tick
            if name == "q":
                fb_state += 0.35 * (y - fb_state)
        row.append(2.0 if k * tick >= 10.2 * ns else -1.0)
        row.append(-1.0 + (2.0 if 0 <= pulse and pulse % int(3.25 * ns) < width * ns else 0.0))
        pulse += tick
        row.append(0.5 + 2 * (float(np.interp(triangle % length / length, [0, 0.25, 0.75, 1], [0, 1, -1, 0])) if triangle > 0 else 0.0))
        triangle += tick
        row.append(-0.25 + (1.5 * math.sin(2 * math.pi * sine / (3.7 * ns) + 0.4) if sine >= 0 else 0.0))
        sine += tick
        time = k * period - 1
        row.append(0.25 + (2 * chirp(time % 20, 0.05, 20, 0.6, phi=-90) if time > 0 else 0.0))
        trace.append([k] + row)
    columns = ["a", "there", "p", "seg", "done", "left", "q", "qseg", "qdone", "qleft", "one", "oseg", "odone", "oleft",
               "s", "u", "t", "w", "c"]
    golden.write("set_point_programs", program,
                 (["ain(0,1,1)", "run.value", "rst.value", "stop.value", "ain(0,1,2)", "a.rate", "u.width", "t.period"], stimulus),
                 (columns, trace), "numpy's interpolation", period=period)


def limiters():
    period, steps = 0.2, 110
    program = """
! A rate limiter: limited both ways, tracking, told to wait and told of a limit downstream; rates change.
CONTROL
1 x = ain ( : 0, 1, 1 )
2 trk = msi ( : 0 )
3 xt = ain ( : 0, 1, 2 )
4 back = setvec ( 2 : 0., 0. )
5 L, lim, bk = ratelim ( x, trk, xt, back : 2., 5. )
6 slow = ratelim ( x : 0.01, 0. )
END
"""
    y, slow, bk, lim = None, None, [0.0, 0.0], 0
    stimulus, trace = [], []
    for k in range(steps):
        x = math.nan if k in (0, 33, 34) else wave(k) if k < 60 else 1.0
        trk = 1 if 40 <= k < 46 else 0
        xt = math.nan if k == 43 else round(2 + 0.3 * k, 6)
        state = 3 if k in (55, 56) else 1 if k in (70, 71) else 2 if k == 72 else 0
        value = 9.5 if state == 3 else 0.75 if state else 0.0
        up = 1.0 if k >= 20 else 2.0
        stimulus.append([k, x, trk, xt, value, float(state), up])
        if state == 3 or trk:
            y = value if state == 3 else xt if good(xt) else y
            bk, lim = [y, 3.0], 0
        elif good(x):
            before = x if y is None else y
            y = min(max(x, before - 5 * period), before + up * period)
            lim = 1 if y < x else 2 if y > x else 0
            bk = [value, float(state)] if state else [y, float(lim)]
        if good(x):
            slow = x if slow is None else min(max(x, slow), slow + 0.01 * period)
        trace.append([k, y or 0.0, lim] + bk + [slow or 0.0])
    golden.write("rate_limiters", program,
                 (["ain(0,1,1)", "trk.value", "ain(0,1,2)", "back.v[1]", "back.v[2]", "L.up"], stimulus),
                 (["L", "lim", "bk[1]", "bk[2]", "slow"], trace), "another order of the sums", period=period)


def by_section():
    """A block's period is that of its section: 0.3 s in CONTROL 3 1, 0.025 s in a PLANT of four substeps."""
    period, steps = 0.1, 90
    program = """
! Blocks that count time in a plant of substeps, in every scan and in every third one.
PLANT
1 a = fopdt ( b, 20 : 1., 0.4, 0.0375 )
CONTROL
2 x = ain ( : 0, 1, 1 )
3 b = integ ( x : 1., -50., 50., 0., euler )
CONTROL 3 1
4 c = integ ( x : 1., -50., 50., 0., trap )
5 td = ain ( : 0, 1, 2 )
6 d = dead ( x, td, 4 : )
7 e = fopdt ( x, 4 : 1., 2., 0.95 )
8 f = stepgen ( : 0., 1., 3. )
9 g = ramp ( x : 0.5, 0. )
END
"""
    plant, slow = Delayed(), Delayed()
    b, c = Integral(0.0), Integral(0.0)
    samples, g, held = [], Fraction(0), [0.0] * 5
    stimulus, trace, u = [], [], 0.0
    lag, other = ([[-1 / 0.4]], [1 / 0.4], [[1.0]]), ([[-0.5]], [0.5], [[1.0]])
    for k in range(steps):
        x, td = wave(k), round(0.4 + 0.005 * k, 6)
        stimulus.append([k, x, td])
        for _ in range(4):
            a = plant.step(u, *lag, 0.0375, period / 4)
        u = b.step(x, 1, -50, 50, 0, "euler", Fraction(1, 10))
        if k % 3 == 1:
            samples.append(x)
            times = 0.3 * (np.arange(len(samples)) - len(samples) + 1)
            way = Fraction(x) - g
            g = Fraction(x) if abs(way) <= Fraction(15, 100) else g + (1 if way > 0 else -1) * Fraction(15, 100)
            held = [c.step(x, 1, -50, 50, 0, "trap", Fraction(3, 10)), float(np.interp(-min(td, 1.2), times, samples)),
                    slow.step(x, *other, 0.95, 0.3), 1.0 if k // 3 * 0.3 > 2.999 else 0.0, float(g)]
        trace.append([k, a, u] + held)
    golden.write("periods_by_section", program, (["ain(0,1,1)", "ain(0,1,2)"], stimulus), (list("abcdefg"), trace),
                 "scipy's matrix exponentials against expm1", period=period)
    project = golden.CASES / "periods_by_section" / "pcl2.toml"
    project.write_text(project.read_text() + "\n[sim]\nsubsteps = 4\n")


def spikes():
    program = """
! A mean over a window that a huge value passes: when it has left, nothing of it is left.
CONTROL
1 x = ain ( : 0, 1, 1 )
2 m = mavg ( x, 7 : )
3 n = mavg ( x, 64 : )
END
"""
    stimulus, trace, samples = [], [], []
    for k in range(200):
        x = 1e12 if k in (20, 91) else round(0.1 * (k % 13) + 0.3, 6)
        stimulus.append([k, x])
        samples.append(x)
        means = [float(sum(map(Fraction, ([samples[0]] * n + samples)[-n:])) / n) for n in (7, 64)]
        trace.append([k] + means)
    golden.write("mean_after_spikes", program, (["ain(0,1,1)"], stimulus), (["m", "n"], trace), "exact sums", period=0.1)


lead_lags()
integrals()
delays()
plants()
difference_equations()
programs()
limiters()
by_section()
spikes()
slow_in_float()

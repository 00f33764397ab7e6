"""Golden cases of gpc1, gpc2, gpcn: the dense formula of Clarke, Mohtadi, Tuffs (1987) in numpy.

Free response, step response, matrix G and a general solver each scan; nothing is kept from a design.
"""
import math

import numpy as np

import golden


class Gpc:
    """Polynomials A = 1 - a1 z^-1 .., B; N1 = d+1. Bad w or y: everything frozen, u held."""

    def __init__(self, na, nb, d, n2, nu, u0):
        self.na, self.nb, self.d, self.n2, self.nu = na, nb, d, n2, nu
        self.u = u0
        self.y = None                              # y(t-1), y(t-2) ..
        self.du = np.zeros(nb + d + 1)             # Du(t-1), Du(t-2) ..

    def first_move(self, w, y, p, lam):
        a, b, n1 = p[:self.na], p[self.na:], self.d + 1
        poly = np.convolve(np.concatenate(([1.0], -np.asarray(a))), [1.0, -1.0])
        f = {0: y}
        for i in range(1, self.na + 1):
            f[-i] = self.y[i - 1]
        g = {}
        for j in range(1, self.n2 + 1):
            f[j] = -sum(poly[i] * f[j - i] for i in range(1, self.na + 2))
            g[j] = sum(a[i - 1] * g.get(j - i, 0.0) for i in range(1, self.na + 1))
            for m in range(self.nb):
                ahead = j - 1 - self.d - m
                if ahead < 0:
                    f[j] += b[m] * self.du[-ahead - 1]
                else:
                    g[j] += b[m]
        big = np.array([[g.get(j - i, 0.0) for i in range(self.nu)] for j in range(n1, self.n2 + 1)])
        normal = big.T @ big + lam * np.eye(self.nu)
        if not np.all(np.isfinite(normal)) or np.linalg.matrix_rank(normal, hermitian=True) < self.nu:
            return 0.0
        error = np.array([w - f[j] for j in range(n1, self.n2 + 1)])
        return np.linalg.solve(normal, big.T @ error)[0]

    def scan(self, w, y, p, sw, u0, umin, umax, lam):
        manual = math.isfinite(sw) and sw != 0.0
        good = math.isfinite(y)
        if not good and self.y is None:
            if manual:
                raise NotImplementedError
            return self.u
        if self.y is None:
            self.y = [y] * (self.na + 1)
        if manual:
            u = min(max(u0, umin), umax)
            y = y if good else self.y[0]
        elif good and math.isfinite(w):
            u = min(max(self.u + self.first_move(w, y, p, lam), umin), umax)
        else:
            return self.u
        self.du = np.concatenate(([u - self.u], self.du[:-1]))
        self.y = [y] + self.y[:-1]
        self.u = u
        return u


LAG = [0.893, -0.17377, 0.2807, 0.0]               # 10/((s+2)(s+5)) at 0.25 s, as the paper prints it
SLOW = [1.38533, -0.472367, 0.024465, 0.01905]     # 1/((s+1)(s+2)) at 0.25 s
THIRD = [1.2, -0.5, 0.1, 0.2, 0.15, -0.05]
NAN = math.nan


def measured(k):
    """A measured value that answers to nobody: the controllers are compared in open loop."""
    return round(0.8 * math.sin(0.21 * k) + 0.3 * math.cos(0.67 * k), 6)


def setpoint(k):
    return [0.0, 1.0, -0.5, 2.0][k // 25 % 4]


def open_loop():
    blocks = [                                     # name, code, p, na, nb, d, N2, Nu, umin, umax, lambda
        ("u1", "gpc1", [0.8, 0.4], 1, 1, 0, 8, 1, -10.0, 10.0, 0.1),
        ("u2", "gpc2", LAG, 2, 2, 0, 10, 3, -10.0, 10.0, 0.1),
        ("u3", "gpcn", SLOW, 2, 2, 2, 12, 3, -20.0, 20.0, 0.05),
        ("u4", "gpc2", SLOW, 2, 2, 2, 10, 1, -10.0, 10.0, 0.0),
        ("u5", "gpcn", THIRD, 3, 3, 0, 10, 2, -1.0, 1.5, 0.2),
        ("u6", "gpc1", [0.9, 0.5], 1, 1, 2, 6, 3, -10.0, 10.0, 0.01),
        ("u7", "gpcn", [0.5, 0.3, 0.1], 0, 3, 1, 7, 2, -10.0, 10.0, 0.3),
        ("u8", "gpcn", THIRD, 3, 3, 1, 2, 1, -10.0, 10.0, 0.5),
    ]
    u0 = 0.25
    lines = ["! Predictive controllers of several sizes on one measured value; manual from scan 60 to 69.",
             "INITIALIZE"]
    for i, (name, _, p, *_rest) in enumerate(blocks):
        lines.append(f"{i + 1} p{name[1:]} = setvec ( {len(p)} : {', '.join(map(str, p))} )")
    lines += ["CONTROL", "11 y = ain ( : 0, 1, 1 )", "12 w = msc ( : 0. )", "13 sw = msc ( : 0. )"]
    loops = []
    for i, (name, code, p, na, nb, d, n2, nu, umin, umax, lam) in enumerate(blocks):
        sizes = f"{d}, {na + 1}, {nb}, {n2}, {nu}" if code == "gpcn" else f"{d}, {n2}, {nu}"
        lines.append(f"{20 + i} {name} = {code} ( w, y, p{name[1:]}, sw, {sizes} : {u0}, {umin}, {umax}, {lam} )")
        loops.append((Gpc(na, nb, d, n2, nu, u0), p, umin, umax, lam))
    lines.append("END")
    stimulus, trace = [], []
    for k in range(120):
        w, y, sw = setpoint(k), measured(k), 1.0 if 60 <= k < 70 else 0.0
        stimulus.append([k, y, w, sw])
        trace.append([k] + [c.scan(w, y, p, sw, u0, lo, hi, lam) for c, p, lo, hi, lam in loops])
    golden.write("gpc_open_loop", "\n".join(lines), (["ain(0,1,1)", "w.value", "sw.value"], stimulus),
                 ([b[0] for b in blocks], trace),
                 "numpy's solver and another order of the sums")


def closed_loop():
    program = """
! Three moves, clamped, on two lags in a row (1/(s+2) and 5/(s+5)); manual from scan 100 on, then back.
INITIALIZE
1 p1 = setvec ( 4 : 0.893, -0.17377, 0.2807, 0.0 )
2 p3 = setvec ( 2 : 0.606530659712633, 0.393469340287367 )
CONTROL
3 b = first ( u1 : 2.0, 2.0, 0.0 )
4 y1 = first ( b : 5.0, 5.0, 0.0 )
5 y3 = first ( u3 : 2.0, 2.0, 0.0 )
6 w = msc ( : 0.0 )
7 sw = msc ( : 0.0 )
8 u1 = gpc2 ( w, y1, p1, sw, 0, 10, 3 : 0.5, -0.5, 1.6, 0.1 )
9 u3 = gpc1 ( w, y3, p3, sw, 0, 5, 2 : 0., -10., 10., 0.2 )
END
"""
    p1 = [0.893, -0.17377, 0.2807, 0.0]
    p3 = [0.606530659712633, 0.393469340287367]
    c1, c3 = Gpc(2, 2, 0, 10, 3, 0.5), Gpc(1, 1, 0, 5, 2, 0.0)
    e2, e5 = math.exp(-0.5), math.exp(-1.25)
    b = y1 = y3 = 0.0
    stimulus, trace = [], []
    for k in range(150):
        w, sw = setpoint(k), 1.0 if 100 <= k < 115 else 0.0
        b = e2 * b + (1.0 - e2) * c1.u
        y1 = e5 * y1 + (1.0 - e5) * b
        y3 = e2 * y3 + (1.0 - e2) * c3.u
        u1 = c1.scan(w, y1, p1, sw, 0.5, -0.5, 1.6, 0.1)
        u3 = c3.scan(w, y3, p3, sw, 0.0, -10.0, 10.0, 0.2)
        stimulus.append([k, w, sw])
        trace.append([k, y1, u1, y3, u3])
    golden.write("gpc_closed_loop", program, (["w.value", "sw.value"], stimulus),
                 (["y1", "u1", "y3", "u3"], trace), "rounding goes around the loop, which is stable")


def adaptive():
    program = """
! The model vector and lambda change while the loop runs; from scan 40 to 44 there is no law
! (lambda = 0 and B = 0): u is held.
CONTROL
1 y = ain ( : 0, 1, 1 )
2 w = msc ( : 0. )
3 sw = msc ( : 0. )
4 a1 = msc ( : 0.893 )
5 a2 = msc ( : -0.17377 )
6 b0 = msc ( : 0.2807 )
7 p = ftov ( 4, a1, 1 : )
8 p = ftov ( 4, a2, 2 : )
9 p = ftov ( 4, b0, 3 : )
10 u1 = gpc2 ( w, y, p, sw, 0, 10, 1 : 0., -10., 10., 0.1 )
11 u3 = gpcn ( w, y, p, sw, 1, 3, 2, 10, 3 : 0., -10., 10., 0.1 )
END
"""
    c1, c3 = Gpc(2, 2, 0, 10, 1, 0.0), Gpc(2, 2, 1, 10, 3, 0.0)
    stimulus, trace = [], []
    for k in range(80):
        w, y = setpoint(k), measured(k)
        a1, a2, b0 = 0.893, -0.17377, 0.2807
        if 20 <= k < 60:
            a1, b0 = round(0.9 + 0.01 * math.sin(k), 6), round(0.3 + 0.05 * math.cos(0.5 * k), 6)
        if 40 <= k < 45:
            b0 = 0.0
        lam = 0.0 if 40 <= k < 45 else 0.5 if k >= 70 else 0.1
        p = [a1, a2, b0, 0.0]
        stimulus.append([k, y, w, a1, b0, lam, lam])
        trace.append([k, c1.scan(w, y, p, 0.0, 0.0, -10.0, 10.0, lam),
                      c3.scan(w, y, p, 0.0, 0.0, -10.0, 10.0, lam)])
    golden.write("gpc_adaptive", program,
                 (["ain(0,1,1)", "w.value", "a1.value", "b0.value", "u1.lambda", "u3.lambda"], stimulus),
                 (["u1", "u3"], trace), "numpy's solver and another order of the sums")


def bad_signal():
    program = """
! y is not a number in scans 20 to 24 and 52, w in scan 30, sw in scan 35 (automatic); manual from 50 to 55.
INITIALIZE
1 p = setvec ( 4 : 0.893, -0.17377, 0.2807, 0.0 )
CONTROL
2 y = ain ( : 0, 1, 1 )
3 w = ain ( : 0, 1, 2 )
4 sw = ain ( : 0, 1, 3 )
5 u = gpc2 ( w, y, p, sw, 1, 10, 2 : 0.3, -10., 10., 0.1 )
END
"""
    c = Gpc(2, 2, 1, 10, 2, 0.3)
    stimulus, trace = [], []
    for k in range(70):
        y = NAN if 20 <= k < 25 or k == 52 else measured(k)
        w = NAN if k == 30 else setpoint(k)
        sw = NAN if k == 35 else 1.0 if 50 <= k < 56 else 0.0
        stimulus.append([k, y, w, sw])
        trace.append([k, c.scan(w, y, LAG, sw, 0.3, -10.0, 10.0, 0.1)])
    golden.write("gpc_bad_signal", program, (["ain(0,1,1)", "ain(0,1,2)", "ain(0,1,3)"], stimulus),
                 (["u"], trace), "numpy's solver and another order of the sums",
                 single=(1e-3, "the law's gain of 20 on the noise of a float signal"))


if __name__ == "__main__":
    open_loop()
    closed_loop()
    adaptive()
    bad_signal()

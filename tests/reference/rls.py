"""Golden cases of rls1, rls2, rlsn: padasip where it applies, else the dense textbook formula in numpy.

padasip 1.2.2 knows neither freezing nor pmax; its `adapt` is called row by row (its recorded history of
weights would be one row late).
"""
import math

import numpy as np
import padasip

import golden
from gpc import Gpc


class Rls:
    """Dense: P phi as a product of matrices, the whole of P symmetrised."""

    def __init__(self, na, nb, d, lam=0.98, p0=1000.0, pmax=1e6, theta0=None):
        self.na, self.nb, self.d, self.lam, self.pmax = na, nb, d, lam, pmax
        self.theta = np.zeros(na + nb) if theta0 is None else np.array(theta0)
        self.p = p0 * np.eye(na + nb)
        self.y = [0.0] * na
        self.u = [0.0] * (nb + d)
        self.blind = 0

    def regressor(self):
        return np.array(self.y + self.u[self.d:])

    def adapt(self, phi, y):
        s = self.p @ phi
        gain = s / (self.lam + phi @ s)
        grown = np.trace(self.p) > self.pmax
        self.theta = self.theta + gain * (y - phi @ self.theta)
        self.p = (self.p - np.outer(gain, s)) / (1.0 if grown else self.lam)
        self.p = 0.5 * (self.p + self.p.T)

    def scan(self, y, u, en):
        """A bad sample enters as its predecessor; nothing is learnt until it has left the regressor."""
        bad = not (math.isfinite(y) and math.isfinite(u))
        self.u = [u if math.isfinite(u) else self.u[0]] + self.u[:-1]
        if bad:
            self.blind = max(self.na, self.nb + self.d)
        elif self.blind:
            self.blind -= 1
        elif math.isfinite(en) and en != 0.0:
            self.adapt(self.regressor(), y)
        if self.na:
            self.y = [y if math.isfinite(y) else self.y[0]] + self.y[:-1]
        return list(self.theta)


class Padasip(Rls):
    """The same regressor, padasip's update."""

    def __init__(self, na, nb, d, lam=0.98, p0=1000.0):
        super().__init__(na, nb, d, lam, p0)
        self.filter = padasip.filters.FilterRLS(n=na + nb, mu=lam, eps=1.0 / p0, w="zeros")

    def adapt(self, phi, y):
        self.filter.adapt(y, phi)
        self.theta = np.array(self.filter.w)


def columns(name, n):
    return [f"{name}[{i + 1}]" for i in range(n)]


def record(steps, a, b, d, seed):
    """y(k) and u(k-1) of a plant with a little noise, u a random level held for 3 scans."""
    random = np.random.default_rng(seed)
    y, u, rows = [0.0] * (len(a) + 1), [0.0] * (len(b) + d + 1), []
    for k in range(steps):
        if k % 3 == 0:
            level = round(float(random.uniform(-1.0, 1.0)), 4)
        new = sum(ai * yi for ai, yi in zip(a, y)) + sum(bi * ui for bi, ui in zip(b, u[d:]))
        new = round(new + float(random.normal(0.0, 0.01)), 6)
        rows.append((new, u[0]))
        y, u = [new] + y[:-1], [level] + u[:-1]
    return rows


def identify():
    program = """
! Three estimators on one record of a second-order plant.
CONTROL
1 y = ain ( : 0, 1, 1 )
2 u = ain ( : 0, 1, 2 )
3 en = msc ( : 1. )
4 th1 = rls1 ( 2, y, u, en : )
5 th2 = rls2 ( 4, y, u, en : lambda = 0.95, P0 = 100. )
6 thn = rlsn ( 5, y, u, en, 1, 3, 3 : lambda = 0.99, P0 = 500. )
END
"""
    estimators = [Padasip(1, 1, 0), Padasip(2, 2, 0, 0.95, 100.0), Padasip(2, 3, 1, 0.99, 500.0)]
    rows = record(150, [1.38533, -0.472367], [0.24465, 0.1905], 0, 1)
    stimulus = [[k, y, u] for k, (y, u) in enumerate(rows)]
    trace = [[k] + [x for e in estimators for x in e.scan(y, u, 1.0)] for k, (y, u) in enumerate(rows)]
    golden.write("rls_identify", program, (["ain(0,1,1)", "ain(0,1,2)"], stimulus),
                 (columns("th1", 2) + columns("th2", 4) + columns("thn", 5), trace),
                 "padasip's update is another order of the same sums; P starts at 1000 and cancels",
                 absolute=1e-11)


def freeze():
    program = """
! en is 0 in scans 30 to 39 and not a number in 45; y is bad in 50, u in 70. From scan 80 on nothing
! excites the loop and P grows to pmax.
CONTROL
1 y = ain ( : 0, 1, 1 )
2 u = ain ( : 0, 1, 2 )
3 en = ain ( : 0, 1, 3 )
4 th = rls2 ( 4, y, u, en : 0.8, 10., 2000., 0.5, 0., 0.1, 0.1 )
END
"""
    e = Rls(2, 2, 0, 0.8, 10.0, 2000.0, [0.5, 0.0, 0.1, 0.1])
    stimulus, trace = [], []
    for k, (y, u) in enumerate(record(150, [0.893, -0.17377], [0.2807, 0.1], 0, 2)):
        if k >= 80:
            y, u = (0.5, 0.4) if k < 140 else (0.6 + 0.01 * (k - 140), 0.3)
        y = math.nan if k == 50 else y
        u = math.nan if k == 70 else u
        en = 0.0 if 30 <= k < 40 else math.nan if k == 45 else 1.0
        stimulus.append([k, y, u, en])
        trace.append([k] + e.scan(y, u, en))
    golden.write("rls_freeze", program, (["ain(0,1,1)", "ain(0,1,2)", "ain(0,1,3)"], stimulus),
                 (columns("th", 4), trace), "another order of the sums, while P is large",
                 absolute=1e-11)


def self_tuning():
    program = """
! Self-tuning control: rls2 identifies two lags in a row while gpc2 controls with what it found.
CONTROL
1 b = first ( u : 2.0, 2.0, 0.0 )
2 y = first ( b : 5.0, 5.0, 0.0 )
3 w = msc ( : 0. )
4 on = msc ( : 1. )
5 sw = msc ( : 0. )
6 p = rls2 ( 4, y, u, on : 0.99, 10., , 0.8, -0.1, 0.2, 0.05 )
7 u = gpc2 ( w, y, p, sw, 0, 8, 1 : 0., -3., 3., 0.5 )
END
"""
    e, c = Rls(2, 2, 0, 0.99, 10.0, 1e6, [0.8, -0.1, 0.2, 0.05]), Gpc(2, 2, 0, 8, 1, 0.0)
    e2, e5 = math.exp(-0.5), math.exp(-1.25)
    b = y = 0.0
    stimulus, trace = [], []
    for k in range(150):
        w = [1.0, -1.0, 0.5][k // 20 % 3]
        b = e2 * b + (1.0 - e2) * c.u
        y = e5 * y + (1.0 - e5) * b
        theta = e.scan(y, c.u, 1.0)
        u = c.scan(w, y, theta, 0.0, 0.0, -3.0, 3.0, 0.5)
        stimulus.append([k, w])
        trace.append([k, y] + theta + [u])
    golden.write("rls_self_tuning", program, (["w.value"], stimulus), (["y"] + columns("p", 4) + ["u"], trace),
                 "rounding goes around the adaptive loop", absolute=1e-11)


if __name__ == "__main__":
    identify()
    freeze()
    self_tuning()

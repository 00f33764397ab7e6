"""Golden cases of flc: all 49 rules in numpy, the triangles from scikit-fuzzy.

scikit-fuzzy's own centroid integrates between the points; it must agree to 5e-3 (checked here; it halves the end points), the
trace has the sums over the 201 points.
"""
import math

import numpy as np
import skfuzzy

import golden

CENTRES = [c / 3.0 for c in range(-3, 4)]
POINTS = np.linspace(-1.0, 1.0, 201)


def triangle(x, centre):
    return skfuzzy.trimf(np.atleast_1d(x), [centre - 1.0 / 3.0, centre, centre + 1.0 / 3.0])


def infer(kind, e, de):
    e, de = (min(max(v, -1.0), 1.0) for v in (e, de))
    weight = total = 0.0
    shape = np.zeros_like(POINTS)
    for i in range(-3, 4):
        for j in range(-3, 4):
            a, b = triangle(e, i / 3.0)[0], triangle(de, j / 3.0)[0]
            r = min(max(i + j, -3), 3)
            total += a * b * r / 3.0
            weight += a * b
            shape = np.fmax(shape, np.fmin(min(a, b), triangle(POINTS, r / 3.0)))
    if kind == 0:
        return total / weight
    centroid = float(np.sum(POINTS * shape) / np.sum(shape))
    assert abs(centroid - skfuzzy.defuzz(POINTS, shape, "centroid")) < 5e-3
    return centroid


class Flc:
    def __init__(self, kind, u0, umin, umax, ge, gd, gu):
        self.kind, self.u0, self.umin, self.umax = kind, u0, umin, umax
        self.ge, self.gd, self.gu = ge, gd, gu
        self.u, self.e = u0, None

    def scan(self, w, y, sw):
        e = w - y
        good = math.isfinite(e)
        de = 0.0 if self.e is None else e - self.e
        self.e = e if good else None
        if math.isfinite(sw) and sw != 0.0:
            self.u = min(max(self.u0, self.umin), self.umax)
        elif good:
            out = infer(self.kind, self.ge * e, self.gd * de)
            self.u = min(max(self.u + self.gu * out, self.umin), self.umax)
        return self.u


def surface():
    """u0 = 0, gu = 1, every second scan manual: u is the rule surface itself."""
    program = """
! The rule surface: manual in every even scan, so that u of an odd scan is that of its error and change.
CONTROL
1 y = ain ( : 0, 1, 1 )
2 w = msc ( : 0. )
3 sw = msc ( : 1. )
4 us = flc ( w, y, sw, 0 : 0., -2., 2., 1., 1., 1. )
5 um = flc ( w, y, sw, 1 : 0., -2., 2., 1., 1., 1. )
END
"""
    random = np.random.default_rng(3)
    blocks = [Flc(kind, 0.0, -2.0, 2.0, 1.0, 1.0, 1.0) for kind in (0, 1)]
    special = [(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (0.5, -0.5),
               (1.0 / 3.0, 0.0), (2.5, 3.0), (-0.25, 1.5)]
    targets = special + [tuple(round(float(v), 6) for v in random.uniform(-1.2, 1.2, 2)) for _ in range(85)]
    stimulus, trace = [], []
    for n, (e, de) in enumerate(targets):
        for k, y, sw in ((2 * n, -(e - de), 1.0), (2 * n + 1, -e, 0.0)):
            stimulus.append([k, y, sw])
            trace.append([k] + [b.scan(0.0, y, sw) for b in blocks])
    golden.write("flc_surface", program, (["ain(0,1,1)", "sw.value"], stimulus), (["us", "um"], trace),
                 "another order of the sums")


def closed_loop():
    program = """
! Both kinds on a lag 1/(s+1); manual in scans 70 to 79, y not a number in 110 to 112.
CONTROL
1 ys = first ( us : 1.0, 1.0, 0.0 )
2 ym = first ( um : 1.0, 1.0, 0.0 )
3 bias = ain ( : 0, 1, 1 )
4 vs = sumII ( 1, ys, bias, 2 : 1., 1. )
5 vm = sumII ( 1, ym, bias, 2 : 1., 1. )
6 w = msc ( : 0. )
7 sw = msc ( : 0. )
8 us = flc ( w, vs, sw, 0 : 0.2, -1., 1.4, 0.6, 3., 0.3 )
9 um = flc ( w, vm, sw, 1 : 0.2, -1., 1.4, 0.6, 3., 0.3 )
END
"""
    blocks = [Flc(kind, 0.2, -1.0, 1.4, 0.6, 3.0, 0.3) for kind in (0, 1)]
    y, hold = [0.0, 0.0], math.exp(-0.25)
    stimulus, trace = [], []
    for k in range(150):
        w = [1.0, 0.2, -0.4][k // 40 % 3]
        sw = 1.0 if 70 <= k < 80 else 0.0
        bias = math.nan if 110 <= k < 113 else round(0.05 * math.sin(0.4 * k), 6)
        y = [hold * v + (1.0 - hold) * b.u for v, b in zip(y, blocks)]
        u = [b.scan(w, v + bias, sw) for v, b in zip(y, blocks)]
        stimulus.append([k, bias, w, sw])
        trace.append([k] + y + u)
    golden.write("flc_closed_loop", program, (["ain(0,1,1)", "w.value", "sw.value"], stimulus),
                 (["ys", "ym", "us", "um"], trace), "rounding goes around the loop, which is stable")


if __name__ == "__main__":
    surface()
    closed_loop()

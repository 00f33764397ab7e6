"""Golden cases of the arithmetic codes: numpy and scipy; the points of IEC 60751 typed in from its table."""
import math

import numpy as np
from scipy.interpolate import RegularGridInterpolator
from scipy.optimize import brentq

import golden

BAD = float("nan")


def real(function, x):
    """A value as the codes give it: bad where numpy has none."""
    with np.errstate(all="ignore"):
        y = float(function(np.float64(x)))
    return y if math.isfinite(y) else BAD


FUNCTIONS = [
    ("abs", np.abs), ("sqr", np.square), ("ln", np.log), ("log10", np.log10), ("sin", np.sin), ("cos", np.cos),
    ("tan", np.tan), ("asin", lambda x: np.arcsin(np.clip(x, -1, 1))), ("acos", lambda x: np.arccos(np.clip(x, -1, 1))),
    ("atan", np.arctan), ("round", np.round), ("trunc", np.trunc), ("floor", np.floor), ("ceil", np.ceil),
]


def functions():
    lines = [f"{i + 10} y{name} = {name} ( x : )" for i, (name, _) in enumerate(FUNCTIONS)]
    program = """
! Elementary functions of x, and of x with z = 0.75. What has no real value is bad, and a fault.
CONTROL
1 x = msc ( : 0. )
2 z = msc ( : 0.75 )
""" + "\n".join(lines) + """
40 root = sqrt ( x : 0.01 )
41 grown = exp ( x : )
42 power = pow ( x, z : )
43 half = round ( x : )
44 whole = pow ( x, half : )
45 turned = atan2 ( x, z : )
46 low = min ( x, z : )
47 high = max ( x, z : )
48 sum = sumIV ( 1, x, z, yabs, ysqr, 4 : 1., -2., 3., 0.5 )
49 moved = bias ( x : -1.5 )
50 mixed = ratio ( x, z : 2., 0.25 )
51 flow = dpflow ( x : 3., 0.5 )
52 late = abs ( yln : )
END
"""
    xs = [0.0, 1.0, -1.0, 0.3, -0.3, 0.75, 2.5, -2.5, 3.5, 0.005, 1e-6, -7.25, 12.0, 20.0, -8.0, 0.5, 1.5]
    header = ["y" + name for name, _ in FUNCTIONS]
    header += ["root", "grown", "power", "whole", "turned", "low", "high", "sum", "moved", "mixed", "flow", "late"]
    trace = []
    for k, x in enumerate(xs):
        half = float(np.round(x))
        row = [real(f, x) for _, f in FUNCTIONS]
        row += [0.0 if x < 0.01 else math.sqrt(x), math.exp(x), real(lambda v: v**0.75, x), real(lambda v: v**half, x)]
        row += [math.atan2(x, 0.75), min(x, 0.75), max(x, 0.75), x - 1.5 + 3 * abs(x) + 0.5 * x * x, x - 1.5]
        row += [1.5 * x + 0.25, 0.0 if x < 0.5 else 3 * math.sqrt(x), abs(real(np.log, x))]
        trace.append([k] + row)
    golden.write("arithmetic_functions", program, (["x.value"], [[k, x] for k, x in enumerate(xs)]), (header, trace),
                 "both sides round; the tangent and large powers magnify it", relative=1e-12, absolute=1e-14, period=0.1)


def curves():
    gx, gy = [-2.0, 0.0, 0.5, 3.0, 10.0], [4.0, 0.0, 1.0, 1.5, -20.0]
    rows, columns = [0.0, 1.0, 4.0], [10.0, 20.0, 25.0, 40.0]
    rng = np.random.default_rng(3)
    z = rng.uniform(-5, 5, (3, 4)).round(3)
    c = [0.5, -1.25, 0.75, 0.1, -0.02]
    listed = lambda values: ", ".join(repr(float(v)) for v in np.asarray(values).flatten())
    program = f"""
! Curves through points, a table and a polynomial.
CONTROL
1 x = msc ( : 0. )
2 y = msc ( : 0. )
3 held = fgen ( x, 5 : {listed(gx)}, {listed(gy)}, )
4 drawn = fgen ( x, 5 : {listed(gx)}, {listed(gy)}, extrapolate )
5 w = fgen2 ( x, y, 3, 4 : {listed(rows)}, {listed(columns)}, {listed(z)} )
6 p = poly ( x, 4 : {listed(c)} )
END
"""
    table = RegularGridInterpolator((rows, columns), z)
    stimulus, trace = [], []
    for k, x in enumerate([-5.0, -2.0, -0.7, 0.0, 0.31, 0.5, 1.0, 2.9, 3.0, 3.999, 4.0, 9.5, 10.0, 17.25]):
        y = round(float(rng.uniform(5, 45)), 3) if k % 5 else 25.0
        line = 0 if x < -2 else 3
        outside = gy[line] + (x - gx[line]) * (gy[line + 1] - gy[line]) / (gx[line + 1] - gx[line])
        inside = float(np.interp(x, gx, gy))
        place = [min(max(x, rows[0]), rows[-1]), min(max(y, columns[0]), columns[-1])]
        stimulus.append([k, x, y])
        trace.append([k, inside, outside if x < -2 or x > 10 else inside, float(table(place)[0]), float(np.polyval(c[::-1], x))])
    golden.write("arithmetic_curves", program, (["x.value", "y.value"], stimulus), (["held", "drawn", "w", "p"], trace),
                 "another order of the operations", relative=1e-13, absolute=1e-13, period=0.1,
                 single=(1e-5, "differences of numbers near each other in floats"))


def lines():
    """scale: the rising and the falling line by numpy.interp, in both directions."""
    program = """
! A falling line that is clipped and a rising one that is not, with what comes from downstream.
INITIALIZE
1 back = setvec ( 2 : 0., 0. )
CONTROL
2 x = msc ( : 0. )
3 value = msc ( : 0. )
4 state = msc ( : 0. )
5 back = ftov ( 2, value, 1 : )
6 back = ftov ( 2, state, 2 : )
7 S, Sbk = scale ( x, back = back : 4., 20., 100., 0., )
8 U, Ubk = scale ( x, back = back : 4., 20., -50., 150., off )
END
"""
    turned = {0: 0, 1: 2, 2: 1, 3: 3}
    stimulus, trace = [], []
    for k, (x, value, state) in enumerate([(8, 0, 0), (2, 0, 0), (25, 9, 0), (12, 75, 1), (12, 40, 2), (12, 60, 3), (20, 5, 0)]):
        falling = float(np.interp(x, [4, 20], [100, 0]))
        rising = (x - 4) / 16 * 200 - 50
        if state:
            own = [float(np.interp(value, [0, 100], [20, 4])), turned[state]]
            other = [float(np.interp(value, [-50, 150], [4, 20])), state]
        else:
            own = [min(max(x, 4), 20), 1 if x > 20 else 2 if x < 4 else 0]
            other = [x, 0]
        stimulus.append([k, float(x), float(value), float(state)])
        trace.append([k, falling] + [float(v) for v in own] + [rising] + [float(v) for v in other])
    header = ["S", "Sbk[1]", "Sbk[2]", "U", "Ubk[1]", "Ubk[2]"]
    golden.write("arithmetic_lines", program, (["x.value", "value.value", "state.value"], stimulus), (header, trace),
                 "another order of the operations", relative=1e-12, absolute=1e-12, period=0.1)


# Resistance of a Pt100 in ohm, IEC 60751:2008, table 1.
POINTS = {
    -200: 18.52, -180: 27.10, -150: 39.72, -100: 60.26, -50: 80.31, -20: 92.16, -10: 96.09, 0: 100.00, 10: 103.90,
    20: 107.79, 50: 119.40, 100: 138.51, 150: 157.33, 200: 175.86, 300: 212.05, 400: 247.09, 500: 280.98,
    600: 313.71, 700: 345.28, 800: 375.70, 850: 390.48,
}


def resistance(t, r0=100.0):
    cold = -4.183e-12 * (t - 100) * t**3 if t < 0 else 0.0
    return r0 * (1 + 3.9083e-3 * t - 5.775e-7 * t**2 + cold)


def thermometers():
    a, b, c = 1.129148e-3, 2.34125e-4, 8.76741e-8
    program = f"""
! Resistance thermometers at the points of the standard, and outside them; a thermistor.
CONTROL
1 ohm = msc ( : 100. )
2 t = rtd ( ohm : )
3 large = sumII ( 1, ohm, ohm, 2 : 5., 5. )
4 t1000 = rtd ( large : 1000. )
5 warm = ntc ( ohm : {a!r}, {b!r}, {c!r} )
END
"""
    stimulus, trace = [], []
    for k, (point, ohm) in enumerate(list(POINTS.items()) + [(None, 18.4), (None, 390.6), (None, -5.0), (25, 109.734660)]):
        t = BAD if point is None else brentq(lambda v: resistance(v) - ohm, -210, 870, xtol=1e-13, rtol=1e-14)
        # the table has two decimals: half of the last one is up to 0.017 degC
        assert point is None or abs(t - point) < 0.02, (point, t)
        warm = BAD if ohm <= 0 else 1 / (a + b * math.log(ohm) + c * math.log(ohm) ** 3) - 273.15
        stimulus.append([k, ohm])
        trace.append([k, t, t, warm])
    golden.write("arithmetic_thermometers", program, (["ohm.value"], stimulus), (["t", "t1000", "warm"], trace),
                 "digits lost in the difference from 0 degC", relative=1e-9, absolute=1e-6, period=0.1,
                 single=(1e-4, "a float resistance has 2e-5 ohm steps, 5e-5 degC"))


functions()
curves()
lines()
thermometers()

"""Golden cases of the vector and matrix codes and of sumII: numpy, and Python's unbounded integers."""
import numpy as np

import golden

LOW, HIGH = -2**31, 2**31 - 1


def saturated(values):
    return [min(max(int(v), LOW), HIGH) for v in values]


def names(name, rows, columns):
    return [f"{name}[{i + 1},{j + 1}]" for i in range(rows) for j in range(columns)]


def vector(name, n):
    return [f"{name}[{i + 1}]" for i in range(n)]


def listed(values):
    return ", ".join(repr(v) for v in np.asarray(values).flatten().tolist())


def reals():
    rng = np.random.default_rng(1)
    a, b = rng.uniform(-9, 9, (2, 3)).round(3), rng.uniform(-9, 9, (3, 4)).round(3)
    v, m4, m8 = rng.uniform(-2, 2, 3).round(3), rng.uniform(-1, 1, (4, 4)).round(3), rng.uniform(-1, 1, (8, 8)).round(3)
    program = f"""
! Vectors and matrices of reals. The right vector of q counts as a column; d = d d reads what it writes.
INITIALIZE
1 a = setmat ( 2, 3 : {listed(a)} )
2 b = setmat ( 3, 4 : {listed(b)} )
3 v = setvec ( 3 : {listed(v)} )
4 d = setmat ( 4, 4 : {listed(m4)} )
5 e = setmat ( 8, 8 : {listed(m8)} )
CONTROL
6 x = msc ( : 0. )
7 v = ftov ( 3, x, 2 : )
8 p = mulmat ( 2, 4, a, b : )
9 q = mulmat ( 2, 1, a, v : )
10 s = addmat ( 2, 4, p, p : )
11 w = addvec ( 3, v, v : )
12 d = mulmat ( 4, 4, d, d : )
13 f = mulmat ( 8, 8, e, e : )
14 g = addmat ( 4, 4, d, d : )
15 z = sumII ( 1, x, v[3], 2 : 10.0, -15.0 )
END
"""
    header = names("p", 2, 4) + names("q", 2, 1) + names("s", 2, 4) + vector("w", 3) + names("d", 4, 4) + names("f", 8, 8) + ["g[4,4]", "z"]
    stimulus, trace, d = [], [], m4
    for k in range(6):
        x = round(float(rng.uniform(-5, 5)), 4)
        v[1] = x
        d = d @ d
        p = a @ b
        parts = [p, a @ v, p + p, v + v, d, m8 @ m8, [2 * d[3, 3], 10.0 * x - 15.0 * v[2]]]
        stimulus.append([k, x])
        trace.append([k] + [float(y) for part in parts for y in np.asarray(part).flatten()])
    golden.write("matrix_reals", program, (["x.value"], stimulus), (header, trace), "another order of the sums", period=0.1)


def integers():
    a = np.array([[1, -2, 3], [HIGH, HIGH, 7]], dtype=object)
    b = np.array([[HIGH, 4], [LOW, -5], [2, HIGH]], dtype=object)
    program = f"""
! Integers: exact products and sums, held at the ends of the range.
INITIALIZE
1 a = setimat ( 2, 3 : {listed(a)} )
2 b = setimat ( 3, 2 : {listed(b)} )
3 v = setivec ( 3 : 1, 2, 3 )
CONTROL
4 x = msi ( : 0 )
5 v = itov ( 3, x, 3 : )
6 p = mulimat ( 2, 2, a, b : )
7 q = mulimat ( 2, 1, a, v : )
8 s = addimat ( 2, 2, p, p : )
9 w = addivec ( 3, v, v : )
END
"""
    header = names("p", 2, 2) + vector("v", 3) + names("s", 2, 2) + vector("w", 3)
    stimulus, trace = [], []
    for k, x in enumerate([0, 5, -7, HIGH, LOW, 1073741824]):
        v = [1, 2, x]
        p = saturated((a @ b).flatten())
        q = saturated(a @ np.array(v, dtype=object))
        stimulus.append([k, x])
        trace.append([k] + p + v + saturated(2 * y for y in p) + saturated(2 * y for y in v) + q)
    golden.write("matrix_integers", program, (["x.value"], stimulus), (header + names("q", 2, 1), trace),
                 "exact", relative=0.0, absolute=0.0, period=0.1)


reals()
integers()

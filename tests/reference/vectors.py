"""Golden cases of the vector and matrix codes beside sums and products: numpy and scipy.linalg."""
import numpy as np
import scipy.linalg

import golden


def listed(values):
    return ", ".join(repr(float(v)) for v in np.asarray(values).flatten())


def vector(name, n):
    return [f"{name}[{i + 1}]" for i in range(n)]


def matrix(name, rows, columns):
    return [f"{name}[{i + 1},{j + 1}]" for i in range(rows) for j in range(columns)]


def equations():
    rng = np.random.default_rng(11)
    a, b = rng.uniform(-3, 3, (5, 5)).round(3), rng.uniform(-3, 3, 5).round(3)
    program = f"""
! Linear equations and an inverse while one element of the matrix moves; in scans 2 and 3 a row is twice another one.
INITIALIZE
1 a = setmat ( 5, 5 : {listed(a)} )
2 b = setvec ( 5 : {listed(b)} )
CONTROL
3 row = setvec ( 5 : {listed(a[0])} )
4 a = setrow ( 5, 5, row, 2 : )
5 x, ok = solmat ( 5, a, b : )
6 m, whole = invmat ( 5, a : )
END
"""
    rows = [a[1], rng.uniform(-3, 3, 5).round(3), 2 * a[0], 2 * a[0], np.array([0, 1, 0, 0, 0.5]), np.zeros(5)]
    stimulus, trace = [], []
    for k, row in enumerate(rows):
        now = a.copy()
        now[1] = row
        ok = np.linalg.matrix_rank(now) == 5
        if ok:
            x, m = scipy.linalg.solve(now, b), scipy.linalg.inv(now)
        stimulus.append([k] + [float(v) for v in row])
        trace.append([k] + [float(v) for v in x] + [int(ok)] + [float(v) for v in m.flatten()] + [int(ok)])
    header = vector("x", 5) + ["ok"] + matrix("m", 5, 5) + ["whole"]
    golden.write("matrix_equations", program, ([f"row.v[{i + 1}]" for i in range(5)], stimulus), (header, trace),
                 "conditions up to 100", relative=1e-11, absolute=1e-12, period=0.1,
                 single=(1e-3, "conditions up to 100 in floats"))


def parts():
    rng = np.random.default_rng(12)
    a, b = rng.uniform(-9, 9, 20).round(3), rng.uniform(-9, 9, 20).round(3)
    m = rng.uniform(-9, 9, (3, 4)).round(3)
    program = f"""
! Parts of vectors and matrices, and numbers about them.
INITIALIZE
1 a = setvec ( 20 : {listed(a)} )
2 b = setvec ( 20 : {listed(b)} )
3 m = setmat ( 3, 4 : {listed(m)} )
CONTROL
4 i = msi ( : 1 )
5 k = msc ( : 1. )
6 m = ftom ( 3, 4, k, 2, 3 : )
10 part = slice ( 3, a, i : )
11 row = rowmat ( 4, m, i : )
12 column = colmat ( 3, m, i : )
13 both = catvec ( 7, row, column : )
14 dot = dotvec ( a, b : )
15 short = dotvec ( row, row : )
16 total = sumvec ( both : )
17 mean = avgvec ( both : )
18 most, mosti = maxvec ( both : )
19 least, leasti = minvec ( both : )
20 length = normvec ( both : )
21 turned = tranmat ( 4, 3, m : )
22 scaled = sclmat ( 3, 4, k, m : )
23 less = submat ( 3, 4, m, scaled : )
24 product = mulmv ( 3, m, row : )
25 square = mulvec ( 4, row, row : )
26 back = divvec ( 4, square, row : )
27 one = eyemat ( 3 : )
28 diagonal = diagmat ( 3, column : )
29 both2 = subvec ( 7, both, both : )
30 twice = sclvec ( 7, k, both : )
31 element = vtof ( both, i : )
32 corner = mtof ( m, i, i : )
33 whole = rtoi ( k : )
34 bits = itob ( 4, i : )
35 again = itor ( whole : )
END
"""
    stimulus, trace = [], []
    for k, (i, value) in enumerate([(1, 1.5), (2, -2.5), (3, 3.5), (9, 1e12), (-4, -0.25), (2147483647, 7.125)]):
        clamp = lambda n: min(max(i, 1), n) - 1
        m[1, 2] = value
        row, column = m[clamp(3)].copy(), m[:, clamp(4)].copy()
        both = np.concatenate([row, column])
        first = min(max(i, 1), 18) - 1
        whole = int(min(max(np.round(value), -2**31), 2**31 - 1))
        reals = [a[first:first + 3], row, column, both, [a @ b, row @ row, both.sum(), both.mean()]]
        numbers = [both.max(), int(both.argmax()) + 1, both.min(), int(both.argmin()) + 1, np.linalg.norm(both)]
        more = [m.T, value * m, m - value * m, m @ row, row * row, row, np.eye(3), np.diag(column), 0 * both, value * both]
        line = [float(v) for p in reals for v in np.asarray(p).flatten()] + numbers
        line += [float(v) for p in more for v in np.asarray(p).flatten()]
        line += [float(both[clamp(7)]), float(m[clamp(3), clamp(4)]), whole]
        line += [(i >> bit) & 1 for bit in range(4)] + [float(whole)]
        stimulus.append([k, i, value])
        trace.append([k] + [v if isinstance(v, int) else float(v) for v in line])
    header = vector("part", 3) + vector("row", 4) + vector("column", 3) + vector("both", 7)
    header += ["dot", "short", "total", "mean", "most", "mosti", "least", "leasti", "length"]
    header += matrix("turned", 4, 3) + matrix("scaled", 3, 4) + matrix("less", 3, 4) + vector("product", 3)
    header += vector("square", 4) + vector("back", 4) + matrix("one", 3, 3) + matrix("diagonal", 3, 3)
    header += vector("both2", 7) + vector("twice", 7) + ["element", "corner", "whole"] + vector("bits", 4) + ["again"]
    golden.write("matrix_parts", program, (["i.value", "k.value"], stimulus), (header, trace),
                 "another order of the sums", relative=1e-12, absolute=1e-12, period=0.1,
                 single=(1e-4, "sums of 20 products in floats"))


equations()
parts()

"""Golden case of words, parts and shaping: Python's own integers (masked to 32 bits), numpy, and ISO 5167's density ratio."""
import math

import numpy as np

import golden

STEPS = 60


def signed(value):
    """The 32 bits of a word as an int."""
    value &= 0xFFFFFFFF
    return value - (1 << 32) if value >> 31 else value


def saturated(value):
    return max(-(1 << 31), min((1 << 31) - 1, value))


def shift(x, k, left):
    if not 0 <= k <= 31:
        return 0
    return signed(x << k) if left else signed((x & 0xFFFFFFFF) >> k)


def shaped(e, span, gap, kgap):
    return kgap * e if abs(e) <= gap else e * abs(e) / span


def transfer(a, b, s, length):
    """The ramp of the transfer of ints: from the old output to the new signal in so many periods."""
    out, since, offset, last = [], 0, 0, None
    for n in range(len(a)):
        new = b[n] if s[n] else a[n]
        if last is not None and s[n] != last:
            since, offset = n, out[-1] - new
        last = s[n]
        part = new + offset * max(0.0, 1.0 - (n - since) / length)
        assert abs(part % 1.0 - 0.5) > 1e-6, "no ties: their rounding is another question"
        out.append(math.floor(part + 0.5))
    return out


def main():
    rng = np.random.default_rng(5)
    edge = [0, 1, -1, 2147483647, -2147483648, 65535, -65536, 7]
    a = [int(v) for v in rng.integers(-2**31, 2**31, STEPS)]
    b = [int(v) for v in rng.integers(-2**31, 2**31, STEPS)]
    a[:8], b[4:12] = edge, edge
    k = [int(v) for v in rng.integers(-3, 36, STEPS)]
    s = [int(n // 13 % 2) for n in range(STEPS)]
    e = [round(float(v), 3) for v in rng.uniform(-40.0, 40.0, STEPS)]
    p = [round(float(v), 4) for v in rng.uniform(0.5, 9.0, STEPS)]
    t = [round(float(v), 2) for v in rng.uniform(250.0, 600.0, STEPS)]
    # Small numbers for the ramp: an int's ramp of billions would only test the reals.
    c, d = [n // 3 for n in range(STEPS)], [900 - 5 * n for n in range(STEPS)]
    density = [x / 1.2 * 290.0 / y for x, y in zip(p, t)]
    columns = {
        "both": [signed(x & y) for x, y in zip(a, b)],
        "any": [signed(x | y) for x, y in zip(a, b)],
        "odd": [signed(x ^ y) for x, y in zip(a, b)],
        "left": [shift(x, n, True) for x, n in zip(a, k)],
        "right": [shift(x, n, False) for x, n in zip(a, k)],
        "sum": [1.5 * (x != 0) - 2.25 * (n != 0) + 100.0 * (z != 0) for x, n, z in zip(a, k, s)],
        "either": [y if z else x for x, y, z in zip(a, b, s)],
        "B": [x & 1 for x in a],
        "B.q16": [x >> 15 & 1 for x in a],
        "less[1]": [saturated(x - y) for x, y in zip(a, b)],
        "less[2]": [saturated(y - x) for x, y in zip(a, b)],
        "mless[1,2]": [saturated(y - x) for x, y in zip(a, b)],
        "part": [x if n <= 1 else y for x, y, n in zip(a, b, k)],
        "ramp": transfer(c, d, s, 7),
        "shape": [shaped(x, 50.0, 10.0, 0.2) for x in e],
        "mass": [80.0 * math.sqrt(r) for r in density],
        "volume": [80.0 / math.sqrt(r) for r in density],
        "linear": [80.0 * r for r in density],
        "on": [0] * 20 + [1] * (STEPS - 20),
        "S.last": [max(0, x) for x in a],
        "S.max": [max(0, *a[:n + 1]) for n in range(STEPS)],
        "S.overruns": [sum(x > 100000 for x in a[:n + 1]) for n in range(STEPS)],
    }
    program = """! Words, parts of vectors, transfers of ints, shaping, gas flow, scan times.
INITIALIZE
1 v = setivec ( 2 : )
2 w = setivec ( 2 : )
3 vm = setimat ( 1, 2 : )
4 wm = setimat ( 1, 2 : )
5 v1 = setivec ( 1 : )
6 one = setimat ( 1, 2 : 1, 0 )
7 two = setimat ( 1, 2 : 0, 1 )
CONTROL
10 a = msi ( : 0 )
11 b = msi ( : 0 )
12 k = msi ( : 0 )
13 s = msi ( : 0 )
14 e = ain ( : 0, 1, 1 )
15 p = ain ( : 0, 1, 2 )
16 t = ain ( : 0, 1, 3 )
17 c = msi ( : 0 )
18 d = msi ( : 0 )
20 both = bitand ( a, b : )
21 any = bitor ( a, b : )
22 odd = bitxor ( a, b : )
23 left = shl ( a, k : )
24 right = shr ( a, k : )
25 sum = dsum ( a, k, s : 1.5, -2.25, 100., , , , , )
26 either = dtrans ( a, b, s : )
27 B = unpack ( a : )
50 v = itov ( 2, a, 1 : )
51 v = itov ( 2, b, 2 : )
52 w = itov ( 2, b, 1 : )
53 w = itov ( 2, a, 2 : )
54 less = subivec ( 2, v, w : )
55 v1 = itov ( 1, a, 1 : )
56 am = mulimat ( 1, 2, v1, one : )
57 v1 = itov ( 1, b, 1 : )
58 bm = mulimat ( 1, 2, v1, two : )
59 vm = addimat ( 1, 2, am, bm : )
60 v1 = itov ( 1, b, 1 : )
61 bm1 = mulimat ( 1, 2, v1, one : )
62 v1 = itov ( 1, a, 1 : )
63 am2 = mulimat ( 1, 2, v1, two : )
64 wm = addimat ( 1, 2, bm1, am2 : )
65 mless = subimat ( 1, 2, vm, wm : )
66 part = vtoi ( v, k : )
67 ramp = itrans ( c, d, s : 0.7 )
68 shape = errsq ( e : 50., 10., 0.2 )
69 q = msc ( : 80. )
70 mass = ptcomp ( q, p, t : 1.2, 290., mass )
71 volume = ptcomp ( q, p, t : 1.2, 290., volume )
72 linear = ptcomp ( q, p, t : 1.2, 290., linear )
73 on = mss ( : off )
74 S = scant ( : )
END
"""
    header = ["a.value", "b.value", "k.value", "s.value", "ain(0,1,1)", "ain(0,1,2)", "ain(0,1,3)", "c.value", "d.value",
              "on.value", "scant(0,0,0)"]
    rows = [[n, a[n], b[n], k[n], s[n], e[n], p[n], t[n], c[n], d[n], columns["on"][n], a[n]] for n in range(STEPS)]
    trace = [[n] + [values[n] for values in columns.values()] for n in range(STEPS)]
    golden.write("words_and_parts", program, (header, rows), (list(columns), trace), "square roots and quotients in another order",
                 relative=1e-12, period=0.1)


if __name__ == "__main__":
    main()

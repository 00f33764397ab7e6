"""Golden case of expressions: the same lines in Python, whose floats are doubles and whose integers are exact.

Integers saturate at 32 bits, quotients of integers lose their fraction, a real divisor below 1e-12 gives a bad signal,
and a comparison with what is no number holds not.
"""
import golden

PROGRAM = (golden.CASES / "expressions" / "main.cfg").read_text()
LEAST, MOST = -(2**31), 2**31 - 1
NAN, INF = float("nan"), float("inf")


def sat(n):
    return max(LEAST, min(MOST, n))


def divi(a, b):
    if b == 0:
        return 0
    size = abs(a) // abs(b)
    return sat(size if (a < 0) == (b < 0) else -size)


def modi(a, b):
    return 0 if b == 0 else a - b * divi(a, b) if (a, b) != (LEAST, -1) else 0


def div(a, b):
    return a / b if b >= 1e-12 or b <= -1e-12 else NAN


def ne(a, b):
    return int(a < b or a > b)


def comparisons(a, b):
    return (a > b) + 2 * (a >= b) + 4 * (a < b) + 8 * (a <= b) + 16 * (a == b) + 32 * ne(a, b)


SAMPLES = [(1.0, 2.0), (3.5, -1.0), (0.1, 0.1), (NAN, 1.0), (2.0, NAN), (INF, 2.0), (-2.25, 4.0), (4096.0, 4096.0),
           (1.0, -1.0), (0.5, 3.0)]
HEADER = ["count", "x", "level", "y", "left", "right", "minus", "mixed", "ints", "byzero", "ends", "top", "matrix",
          "order", "all", "allints", "swap", "copy", "number", "whole", "41", "named", "drain", "slow"]


def trace():
    count, x, level, drain, slow, x1 = 0, 0.25, 0.0, 0.0, 0.0, 0.0
    i1, m = [7, -3], [[1.5, 2.0], [-0.5, 4.0]]
    rows = []
    for k, sample in enumerate(SAMPLES):
        level = 0.9 * level + 0.1 * (x1 - drain)
        x1, x2 = sample
        row = {"y": div(x1 * x1, 1.0 + x2)}
        row["left"] = x1 - x2 - 3.0 / 2.0 / 4.0
        row["right"] = x1 - (x2 - (3.0 - 1) / 4.0)
        row["minus"] = -x1 * -x2 - -2.0 - -(x1 + 1.0)
        row["mixed"] = i1[0] * x1 + divi(i1[1], 2) - divi(7, 2)
        row["ints"] = i1[0] * i1[1] - divi(i1[0], i1[1]) + modi(i1[0], i1[1])
        row["byzero"] = divi(i1[0], i1[1] + 3) + modi(i1[0], 0)
        row["ends"] = sat(-2147483647 - 1)
        row["top"] = sat(sat(divi(row["ends"], -1) + 1) + sat(-row["ends"]))
        row["matrix"] = m[0][0] * m[1][1] - m[0][1] * m[1][0]
        row["order"] = int(int(x1 < x2) == ne(int(x2 >= x1 + 1.0), 0))
        row["all"] = comparisons(x1, x2)
        row["allints"] = comparisons(count, 2)
        count += 1
        x = x / 2.0 + x1 * 0.5
        row["swap"] = int(x1 > 1.0) * x1 + int(x1 <= 1) * x2
        row |= {"copy": x1, "number": 1e-3, "whole": 42, "41": div(x1 + 1, 2 - x2), "named": -(x1 * 3.0)}
        drain = level / 10.0
        if k % 2 == 0:
            slow = slow + x1 * 0.125
        row |= {"count": count, "x": x, "level": level, "drain": drain, "slow": slow}
        rows.append([k] + [row[name] for name in HEADER])
    return HEADER, rows


if __name__ == "__main__":
    header = ["ain(0,0,1)", "ain(0,0,2)"]
    stimulus = [[k, *sample] for k, sample in enumerate(SAMPLES)]
    golden.write("expressions", PROGRAM, (header, stimulus), trace(),
                 "the same operations in the same order: the last digit at most", relative=1e-15, absolute=0.0,
                 period=0.1, single=(1e-6, "rounding of floats", 1e-7))

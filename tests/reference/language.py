"""Traces of the cases about the language itself: rates, substeps, composites, long programs, names.

Each program is written out again by hand; there is no reader of .cfg here.
"""
import math

import golden


def write(name, header, rows):
    golden.table(golden.CASES / name / "trace.csv", ["@k"] + header, [[k] + row for k, row in enumerate(rows)])


def lag(a, b, period):
    return math.exp(-a * period), b / a * -math.expm1(-a * period)


def rates():
    n1 = n2 = n3 = n4 = seen = y = 0.0
    e, g = lag(2.0, 2.0, 0.4)
    rows = []
    for k in range(24):
        n1 += 1
        if k % 2 == 0:
            n2 += 1
        if k % 3 == 1:
            n3 += 1
            seen = n1 + 100 * n2
        if k % 4 == 3:
            n4 += seen
            y = e * y + g * n4
        rows.append([n1, n2, n3, seen, n4, y])
    write("rates", ["n1", "n2", "n3", "seen", "n4", "y"], rows)


def plant_substeps():
    h, n, w, u, x, y = 0.05, 0.0, 0.0, 0.0, 0.5, 1.0
    rows = []
    for _ in range(30):
        for _ in range(4):
            n += w
            # One Runge-Kutta step of x' = u - 3 x, and y = 2 x.
            k1 = u - 3 * x
            k2 = u - 3 * (x + h / 2 * k1)
            k3 = u - 3 * (x + h / 2 * k2)
            k4 = u - 3 * (x + h * k3)
            x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            y = 2 * x
        w = 1.0
        u = 2 * w - y
        rows.append([n, y, w, u])
    write("plant_substeps", ["n", "y", "w", "u"], rows)


def composite_many():
    loops = []
    for i in range(20):
        gain, a, b = 2.0, 1.0, 1.0
        if i % 3:
            gain, a, b = 1 + i / 4, 0.5 + i / 8, 0.75 + i / 8
        elif i % 2:
            gain = 2 + i / 4
        loops.append((gain, *lag(a, b, 0.1)))
    y = [0.0] * 20
    rows = []
    for k in range(30):
        before = 1.0 if k < 10 else -1.0
        for i, (gain, e, g) in enumerate(loops):
            u = gain * (before - y[i])
            y[i] = e * y[i] + g * u
            before = y[i]
        rows.append(list(y))
    write("composite_many", [f"y{i + 1}" for i in range(20)], rows)


def long_program():
    x = [0.0] * 151
    rows = []
    for first, second in [(1, 0), (2, 0), (-3, 1), (4, 7), (4, 7)]:
        x[0] = first
        for i in range(1, 151):
            other = x[i] if i % 10 == 0 else 1.0
            weight = second if i == 75 else i % 3
            x[i] = (x[i - 1] if i % 2 else -x[i - 1]) + weight * other
        rows.append(list(x))
    write("long_program", [f"x{i}" for i in range(151)], rows)


def names_clash():
    e, g = lag(2.0, 2.0, 0.1)
    count = 27
    y1 = int_ = j0 = 0.0
    rows = []
    for k in range(20):
        y1 = e * y1 + g * int_
        y0 = y1 + j0
        int_ = 1.0 if k < 5 else 0.5
        j0 = 1.0 if k < 5 else 2.0
        total = y0
        for i in range(count):
            total += i % 19 + 1
        rows.append([y1, y0, total, 2 * total, 4.0, 2 * total + 4.0])
    write("names_clash", ["y1", "y0", "uint16_t", "for[1]", "for[2]", "while"], rows)


def lags(name, slow_later=0.5, v_later=2.0):
    u = fast = slow = 0.0
    fast = 0.5
    rows = []
    for k in range(25):
        u = 1.0 if k < 7 else -2.0
        e, g = lag(4.0, 3.0, 0.1)
        fast = e * fast + g * u
        e, g = lag(0.5 if k < 12 else slow_later, 0.25, 0.1)
        slow = e * slow + g * u
        v = [1.0, 2.0 if k < 12 else v_later]
        rows.append([u, fast, slow, 0.25 * fast - 2 * slow, *v, 2 * v[0], 2 * v[1]])
    write(name, ["u", "fast", "slow", "s", "v[1]", "v[2]", "v2[1]", "v2[2]"], rows)


def user_block():
    def ramp(y, u, largest):
        return y + min(max(u - y, -largest), largest)

    y, z = 0.25, 0.0
    rows = []
    for k in range(21):
        w, rate = (1.0, 0.5) if k < 8 else (-1.0, 4.0)
        y = ramp(y, w, 0.2)
        z = ramp(z, y, rate * 0.1)
        rows.append([w, y, z])
    write("user_block", ["w", "y", "z"], rows)


def operator_cells():
    manual_u = manual_w = 0.0
    x = 1.0
    rows = []
    for k in range(10):
        if k == 3:
            manual_u = 4.0
        if k == 5:
            x, manual_w = -2.0, -8.0
        manual_u = u = x + 0.5 * manual_u
        v = 2 * x + 0.5 * u
        manual_w = w = 0.25 * x + 0.5 * manual_w
        rows.append([x, u, v, w])
    write("operator_cells", ["x", "u", "v", "w"], rows)


rates()
plant_substeps()
composite_many()
long_program()
names_clash()
lags("tunable_none")
lags("tunable_list", slow_later=1.5, v_later=-7.0)
lags("float_lags")
user_block()
operator_cells()

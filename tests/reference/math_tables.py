"""Tables of the elementary functions, from multiple-precision arithmetic (pip install mpmath).

    python3 tests/reference/math_tables.py

writes tests/reference/math/NAME.f64.csv and NAME.f32.csv, rows x,y,rest in ascending x: x and y as the bits of the
format in hexadecimal, y the nearest value of the format, rest = (true value - y) in units of the last place of y,
so the true value is known to some seven digits more than the format holds. A rest of 0 with a y that is
infinite or not a number: the function's special value itself. Functions of two arguments have a column z behind x.
tests/c/math_ulp.c reads them.
"""

import itertools
import math
import os
import random
import struct

import mpmath

mpmath.mp.prec = 300

FORMATS = {
    64: {"int": "<Q", "real": "<d", "fraction": 52, "bias": 1023},
    32: {"int": "<I", "real": "<f", "fraction": 23, "bias": 127},
}


def bits_of(x, width):
    f = FORMATS[width]
    return struct.unpack(f["int"], struct.pack(f["real"], x))[0]


def real_of(bits, width):
    f = FORMATS[width]
    return struct.unpack(f["real"], struct.pack(f["int"], bits))[0]


def rounded(value, width):
    """The bits nearest to a multiple-precision value, ties to even, and the rest in units of the last place."""
    f = FORMATS[width]
    sign = 1 << (width - 1) if value < 0 else 0
    size = abs(value)
    lowest = 1 - f["bias"]
    exponent = lowest if size == 0 else max(lowest, int(mpmath.floor(mpmath.log(size, 2))))
    if size != 0 and exponent > lowest:
        while mpmath.ldexp(1, exponent) > size:
            exponent -= 1
        while mpmath.ldexp(2, exponent) <= size:
            exponent += 1
    steps = mpmath.ldexp(size, f["fraction"] - exponent)
    whole = int(mpmath.nint(steps))
    bits = ((exponent - lowest) << f["fraction"]) + whole
    infinite = (2 * f["bias"] + 1) << f["fraction"]
    if bits >= infinite:
        return sign | infinite, mpmath.mpf(0)
    rest = steps - whole
    return sign | bits, -rest if value < 0 else rest


def row(name, x, width):
    bits = bits_of(x, width)
    digits = width // 4
    inf = float("inf")
    if x != x:
        y, rest = bits, 0
    elif x == 0:
        y, rest = (bits_of(1.0, width), 0) if name == "exp" else (bits, 0)
    elif abs(x) > 1e4:
        limit = {"exp": (0.0, inf), "expm1": (-1.0, inf), "tanh": (-1.0, 1.0)}[name][x > 0]
        y, rest = bits_of(limit, width), 0
    else:
        y, rest = rounded(getattr(mpmath, name)(mpmath.mpf(x)), width)
    return f"0x{bits:0{digits}x},0x{y:0{digits}x},{mpmath.nstr(mpmath.mpf(rest), 7)}"


def hardest(name, width, low, high, rng, tries, keep):
    """The arguments, of many, whose value lies closest to the middle between two values of the format."""
    found = []
    mpmath.mp.prec = 120
    for _ in range(tries):
        x = real_of(bits_of(rng.uniform(low, high), width), width)
        if x != 0:
            found.append((abs(abs(rounded(getattr(mpmath, name)(mpmath.mpf(x)), width)[1]) - 0.5), x))
    mpmath.mp.prec = 300
    found.sort()
    return [x for _, x in found[:keep]]


def special(width):
    f = FORMATS[width]
    tiny = [1, 2, 3, 12345, (1 << f["fraction"]) - 1, 1 << f["fraction"], (1 << f["fraction"]) + 1]
    largest = ((2 * f["bias"] + 1) << f["fraction"]) - 1
    found = [real_of(b, width) for b in tiny + [largest]]
    found += [0.0, float("inf")]
    return found + [-x for x in found] + [float("nan")]


def around(x, width, count):
    """The neighbours of x in the format."""
    bits = bits_of(x, width)
    return [real_of(bits + i, width) for i in range(-count, count + 1)]


def arguments(name, width, rng):
    ends = {
        ("exp", 64): (-746.0, 710.0), ("exp", 32): (-105.0, 89.0),
        ("expm1", 64): (-40.0, 710.0), ("expm1", 32): (-20.0, 89.0),
        ("tanh", 64): (-22.0, 22.0), ("tanh", 32): (-11.0, 11.0),
    }
    low, high = ends[name, width]
    xs = special(width)
    xs += [rng.uniform(low, high) for _ in range(800)]
    xs += [rng.uniform(-1.5, 1.5) for _ in range(900)]
    xs += [rng.choice((-1, 1)) * 2.0 ** rng.uniform(-60 if width == 64 else -30, 3) for _ in range(800)]
    xs += hardest(name, width, low, high, rng, 8000, 150)
    xs += hardest(name, width, -1.0, 1.0, rng, 8000, 150)
    for k in range(-8, 9):
        xs += around((k + 0.5) * 0.6931471805599453 * (0.5 if name == "tanh" else 1), width, 3)
    for x in {("exp", 64): (709.782712893384, -708.3964185322641, -745.1332191019411),
              ("exp", 32): (88.72283905206835, -87.33654475055310, -103.9720770839918),
              ("expm1", 64): (709.782712893384, -37.42994775023705, 36.7368005696771),
              ("expm1", 32): (88.72283905206835, -17.32867951398635, 16.63553233343869),
              ("tanh", 64): (19.06154746539849, -19.06154746539849, 1e-8),
              ("tanh", 32): (9.010913, -9.010913, 2e-4)}[name, width]:
        xs += around(x, width, 8)
    if name == "tanh":
        xs += around(0.55, width, 20) + around(-0.55, width, 20)
    if name == "exp":
        xs += [rng.uniform(low, low + (38 if width == 64 else 18)) for _ in range(150)]
    keys = {bits_of(x, width): real_of(bits_of(x, width), width) for x in xs}
    return sorted(keys.values(), key=lambda x: (x != x, x))


# The functions below have shorter tables: arguments spread over what they are made of, and their hard places.

INF, NAN = float("inf"), float("nan")
UNARY = ("log", "log10", "log1p", "sin", "cos", "tan", "asin", "acos", "atan")


def unary(name, x):
    """A special value as a float, any other as a multiple-precision number."""
    odd = name in ("log1p", "sin", "tan", "asin", "atan")
    if x != x or (odd and x == 0):
        return x
    if abs(x) == INF and name in ("sin", "cos", "tan", "asin", "acos"):
        return NAN
    if abs(x) == INF:
        return math.copysign(math.pi / 2, x) if name == "atan" else x if x > 0 else NAN
    if (name in ("asin", "acos") and abs(x) > 1) or (name.startswith("log") and x < (-1 if name == "log1p" else 0)):
        return NAN
    if x == (-1 if name == "log1p" else 0) and name.startswith("log"):
        return -INF
    with mpmath.workprec(1500 if name in ("sin", "cos", "tan") else 300):
        return getattr(mpmath, name)(mpmath.mpf(x))


def power(x, y):
    """x^y with the special values of C99 F.9.4.4."""
    if x == 1 or y == 0:
        return 1.0
    if x != x or y != y:
        return NAN
    odd = abs(y) < 2.0**60 and y == int(y) and int(y) % 2 == 1
    sign = -1.0 if math.copysign(1, x) < 0 and odd else 1.0
    if x == 0 or abs(x) == INF:
        return sign * (INF if (x == 0) == (y < 0) else 0.0)
    if abs(y) == INF:
        return 1.0 if x == -1 else INF if (abs(x) > 1) == (y > 0) else 0.0
    if x < 0 and y != int(y):
        return NAN
    turns = y * (mpmath.log(abs(x), 2) if x != -1 else 0)
    if abs(turns) > 1100:
        return sign * (INF if turns > 0 else 0.0)
    return sign * mpmath.power(abs(mpmath.mpf(x)), mpmath.mpf(y))


def angle(y, x):
    """The angle of the point (x, y); signs of zeros count, as C99 F.9.1.4 has it."""
    if x != x or y != y:
        return NAN
    sign = math.copysign(1, y)
    if abs(x) == INF or abs(y) == INF or y == 0:
        rise = 1 if abs(y) == INF else 0
        run = 0 if abs(x) != INF and abs(y) == INF else math.copysign(1, x)
        size = mpmath.atan2(rise, run)
        return sign * (0.0 if size == 0 else size)
    return mpmath.atan2(mpmath.mpf(y), mpmath.mpf(x))


def places(name, width):
    """Where the function or its algorithm changes."""
    halves = {"asin": (0.5, -0.5, 1.0, -1.0), "acos": (0.5, -0.5, 1.0, -1.0), "atan": (1.0, -1.0)}
    if name.startswith("log"):
        return [1.0, 2.0, 0.5, 2.0**0.5, 10.0, 1000.0] if name != "log1p" else [0.4142135623730951, -0.5, 1.0, 1e-8]
    if name in halves:
        return list(halves[name]) + [math.tan((i + 0.5) / 8) if name == "atan" else (i + 0.5) / 9 for i in range(8)]
    turns = [i * math.pi / 4 for i in (-3, -2, -1, 1, 2, 3, 4, 6, 7, 40, 1000001)]
    return turns + [400.0 if width == 32 else 1.6e6]


def spread(name, width, rng, count):
    """Arguments of every size, half of them where the function is curved."""
    low, high = {"asin": (-1, 1), "acos": (-1, 1), "log1p": (-1, 3)}.get(name, (0, 3) if name[:3] == "log" else (-8, 8))
    largest = FORMATS[width]["bias"]
    for _ in range(count):
        yield rng.uniform(low, high)
        sign = 1 if name in ("log", "log10") else rng.choice((-1, 1))
        yield sign * 2.0 ** (rng.uniform(-30, 0) if low == -1 else rng.uniform(1 - largest, largest))


def sample(name, width, rng):
    count = 150 if width == 64 else 60
    xs = special(width) + list(spread(name, width, rng, count))
    for x in places(name, width):
        xs += around(x, width, 2)
    if name in ("sin", "cos", "tan"):
        xs += [2.0**k for k in range(8, FORMATS[width]["bias"], 37 if width == 64 else 5)]
        xs += nearest_quarters(width)
    keys = {bits_of(x, width): real_of(bits_of(x, width), width) for x in xs}
    return sorted(keys.values(), key=lambda x: (x != x, x, math.copysign(1, x)))


def nearest_quarters(width):
    """For each power of 2 the whole number times it that lies nearest to a multiple of pi/2, by continued fractions."""
    f = FORMATS[width]
    found = []
    with mpmath.workprec(3000):
        for e in range(0, f["bias"] - f["fraction"], 60 if width == 64 else 9):
            ratio = mpmath.ldexp(2, e) / mpmath.pi
            last, now, rest = 0, 1, ratio - mpmath.floor(ratio)
            while now < 2 ** (f["fraction"] + 1):
                best, rest = now, 1 / rest
                last, now = now, int(mpmath.floor(rest)) * now + last
                rest -= mpmath.floor(rest)
            found.append(math.ldexp(best, e))
    return found


def pairs(name, width, rng):
    some = [0.0, 1.0, 2.0, 3.0, 0.5, 1e30, 2.0 ** (1 - FORMATS[width]["bias"]), INF]
    some = [s * x for x in some for s in (1, -1)] + [NAN]
    found = list(itertools.product(some, some))
    for _ in range(200 if width == 64 else 100):
        if name == "atan2":
            y, x = rng.uniform(-1, 1), rng.uniform(-1, 1)
            found += [(y, x), (y * 2.0 ** rng.uniform(-100, 100), x)]
        else:
            end = FORMATS[width]["bias"] + FORMATS[width]["fraction"]
            x = 2.0 ** (rng.uniform(-1, 1) * (FORMATS[width]["bias"] - 1))
            found += [(x, rng.uniform(-1, 1) * end / abs(math.log2(x))), (rng.uniform(0, 10), rng.uniform(-20, 20))]
            x = 1 + rng.uniform(-1, 1) * 2.0 ** rng.uniform(-20, -2)
            found.append((x, rng.uniform(-1, 1) * end / abs(math.log2(x))))
    bits = {(bits_of(a, width), bits_of(b, width)) for a, b in found}
    return [(real_of(a, width), real_of(b, width)) for a, b in sorted(bits)]


def line(arguments, value, width):
    if isinstance(value, float) and (value != value or abs(value) == INF or value == 0):
        y, rest = bits_of(value, width), 0
    else:
        y, rest = rounded(mpmath.mpf(value), width)
    digits = width // 4
    bits = [bits_of(x, width) for x in arguments] + [y]
    return ",".join(f"0x{b:0{digits}x}" for b in bits) + f",{mpmath.nstr(mpmath.mpf(rest), 7)}"


def write(folder, name, width, lines):
    with open(os.path.join(folder, f"{name}.f{width}.csv"), "w", newline="\n") as out:
        out.write("\n".join(lines) + "\n")


def main():
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "math")
    os.makedirs(folder, exist_ok=True)
    for width in (64, 32):
        for name in ("exp", "expm1", "tanh"):
            rng = random.Random(f"{name} {width}")
            write(folder, name, width, ["x,y,rest"] + [row(name, x, width) for x in arguments(name, width, rng)])
        for name in UNARY:
            xs = sample(name, width, random.Random(f"{name} {width}"))
            write(folder, name, width, ["x,y,rest"] + [line((x,), unary(name, x), width) for x in xs])
        for name, true in (("pow", power), ("atan2", angle)):
            points = pairs(name, width, random.Random(f"{name} {width}"))
            write(folder, name, width, ["x,z,y,rest"] + [line(point, true(*point), width) for point in points])


if __name__ == "__main__":
    main()

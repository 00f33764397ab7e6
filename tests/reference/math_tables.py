"""Tables of the elementary functions, from multiple-precision arithmetic (pip install mpmath).

    python3 tests/reference/math_tables.py

writes tests/reference/math/NAME.f64.csv and NAME.f32.csv, rows x,y,rest in ascending x: x and y as the bits of the
format in hexadecimal, y the nearest value of the format, rest = (true value - y) in units of the last place of y,
so the true value is known to some seven digits more than the format holds. A rest of 0 with a y that is
infinite or not a number: the function's special value itself. tests/c/math_ulp.c reads them.
"""

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


def main():
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "math")
    os.makedirs(folder, exist_ok=True)
    for name in ("exp", "expm1", "tanh"):
        for width in (64, 32):
            rng = random.Random(f"{name} {width}")
            lines = ["x,y,rest"] + [row(name, x, width) for x in arguments(name, width, rng)]
            with open(os.path.join(folder, f"{name}.f{width}.csv"), "w", newline="\n") as out:
                out.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()

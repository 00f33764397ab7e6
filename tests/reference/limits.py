"""Golden cases of limits, selection and alarms: numpy over the whole record, or rules restated run by run."""
import math

import numpy as np

import golden
from logic import row

PERIOD = 0.1
NAN = math.nan


def signals(steps, seed, bad):
    """Three rounded random walks; bad lists (signal, first scan, scans)."""
    rng = np.random.default_rng(seed)
    x = np.round(50.0 + np.cumsum(rng.normal(0.0, 6.0, (steps, 3)), axis=0), 3)
    for signal, first, length in bad:
        x[first:first + length, signal] = NAN
    return x


WORDS = ["ain(0,1,1)", "ain(0,1,2)", "ain(0,1,3)"]
INPUTS = "".join(f"{i + 1} x{i + 1} = ain ( : 0, 1, {i + 1} )\n" for i in range(3))


def write(name, title, program, stimulus, columns, reason):
    """stimulus and columns: {name: values by scan}."""
    steps = len(next(iter(stimulus.values())))
    cells = [[k] + [values[k] for values in stimulus.values()] for k in range(steps)]
    rows = [[k] + [values[k] for values in columns.values()] for k in range(steps)]
    golden.write(name, f"! {title}\nCONTROL\n{program.strip()}\nEND\n", (list(stimulus), cells), (list(columns), rows),
                 reason, period=PERIOD)


def held(values, good):
    """Each value, or the last good one; 0 before it."""
    out, last = [], 0
    for value, ok in zip(values, good):
        last = value if ok else last
        out.append(last)
    return out


def selectors():
    x = signals(80, 1, [(0, 10, 8), (1, 14, 3), (2, 16, 2), (1, 30, 5), (2, 40, 12), (0, 48, 2), (0, 60, 3), (1, 60, 3), (2, 60, 3)])
    good = ~np.isnan(x)
    some = good.any(axis=1)
    filled = np.where(some[:, None], x, 0.0)
    count = good.sum(axis=1)
    first = np.argmax(good, axis=1)
    mean = np.nanmean(filled, axis=1)
    middle = np.nanmedian(filled, axis=1)
    is_element = count % 2 == 1
    two = count >= 2
    # Votes above 52 of at least 2 of 3, the limit without a band.
    over = np.where(good, np.nan_to_num(x) > 52.0, False).sum(axis=1)
    lower = over >= np.maximum(2 - (3 - count), 1)
    keep = over >= np.minimum(2, count)
    columns = {
        "H": held(np.nanmax(filled, axis=1), some),
        "H.idx": held(np.nanargmax(filled, axis=1) + 1, some),
        "L": held(np.nanmin(filled, axis=1), some),
        "L.idx": held(np.nanargmin(filled, axis=1) + 1, some),
        "M": held(middle, some),
        "M.good": count,
        "F": held(x[np.arange(len(x)), first], some),
        "F.idx": held(first + 1, some),
        "A": held(mean, two),
        "D": held(middle, some),
        "S": held(x[:, 1], good[:, 1]),
        "V": np.where(some, lower, 0),
        "V.votes": over,
        "K": np.where(some, keep, 1),
        "T": over >= 2 - (3 - count),
        "q": count < 3,
    }
    columns = {name: [v.item() if hasattr(v, "item") else v for v in values] for name, values in columns.items()}
    for name in ["V", "K", "T", "q", "H.idx", "L.idx", "F.idx", "M.good", "V.votes"]:
        columns[name] = [int(v) for v in columns[name]]
    assert is_element.any() and not is_element.all()
    write("limits_selectors", "Selectors and votes, with bad signals.", INPUTS + """
4 H = hisel ( x1, x2, x3, 3 : )
6 L = losel ( x1, x2, x3, 3 : )
8 M = midsel ( x1, x2, x3 : )
11 F = isel ( x1, x2, x3, 3 : first, )
13 A = isel ( x1, x2, x3, 3 : avg, 2 )
15 D = isel ( x1, x2, x3, 3 : mid, )
17 two = msi ( : 2 )
18 S = isel ( x1, x2, x3, 3, sel = two : operator, )
20 V = vote ( x1, x2, x3, 3, 2 : lim = 52. )
23 K = vote ( x1, x2, x3, 3, 2 : lim = 52., degrade = keep, onbad = one )
26 T = vote ( x1, x2, x3, 3, 2 : lim = 52., degrade = trip )
29 q = qtest ( x1, x2, x3, 3 : )
""", {word: [v.item() for v in x[:, i]] for i, word in enumerate(WORDS)}, columns, "numpy's order of sums")


def latched(sets, clears, good, onbad):
    """A set and clear memory; while not good, onbad: 0, 1 or None for hold."""
    out, q = [], 0
    for s, c, ok in zip(sets, clears, good):
        if ok:
            q = 1 if s else 0 if c else q
        elif onbad is not None:
            q = onbad
        out.append(q)
    return out


def delayed(raw, on, off):
    """raw as (sets, clears) by scan; the output changes when its cause has lasted so many periods."""
    out, q, since = [], 0, None
    for k, (s, c) in enumerate(raw):
        cause = c if q else s
        since = (k if since is None else since) if cause else None
        if cause and k - since >= (off if q else on):
            q, since = 1 - q, None
        out.append(q)
    return out


def comparisons():
    rng = np.random.default_rng(7)
    steps = 120
    x = np.round(5.0 + 3.0 * np.sin(0.21 * np.arange(steps)) + rng.normal(0.0, 0.6, steps), 2)
    y = np.round(5.0 + rng.normal(0.0, 0.3, steps), 2)
    x[7] = y[7]
    x[25:28], y[60:62] = NAN, NAN
    good = ~np.isnan(x) & ~np.isnan(y)
    fine = ~np.isnan(x)
    levels = [x >= 7.5, x >= 6.5, x <= 3.5, x <= 2.5]
    back = [x < 7.5 - 0.25, x < 6.5 - 0.25, x > 3.5 + 0.25, x > 2.5 + 0.25]

    def alarm(i):
        """The delays stand still while x is bad, with onbad = hold: those scans are cut out and put back."""
        short = delayed([(s, c) for s, c, ok in zip(levels[i], back[i], fine) if ok], 2, 3)
        out, at = [], -1
        for ok in fine:
            at += ok
            out.append(short[at])
        return out

    four = [alarm(i) for i in range(4)]
    bad = (~fine).astype(int)
    columns = {
        "g": latched(x > y, x <= y - 0.5, good, 0),
        "ge": latched(x >= y, x < y - 0.5, good, 1),
        "l": latched(x < y, x >= y + 0.5, good, None),
        "le": latched(x <= y, x > y + 0.5, good, 0),
        "e": latched(np.abs(x - y) <= 0.5, np.abs(x - y) > 0.5, good, 0),
        "n": latched(np.abs(x - y) > 0.0, x == y, good, 0),
        "s": latched(x >= 6.0, x <= 4.0, fine, None),
        "r": latched(x <= 4.0, x >= 6.0, fine, 0),
        "C": latched(x >= 6.0, x < 5.5, fine, 0),
        "C.ql": latched(x <= 4.0, x > 4.5, fine, 0),
        "A": four[0], "A.qh": four[1], "A.ql": four[2], "A.qll": four[3],
        "A.any": [int(any(v)) for v in zip(*four, bad)],
        "A.bad": [int(v) for v in bad],
        "d": latched(np.abs(x - y) >= 1.5, np.abs(x - y) < 1.0, good, 0),
    }
    write("limits_comparisons", "Comparisons with hysteresis, alarms with deadband and delays, bad signals.", """
1 x = ain ( : 0, 1, 1 )
2 y = ain ( : 0, 1, 2 )
3 g = gt ( x, y : h = 0.5 )
4 ge = ge ( x, y : 0.5, one )
5 l = lt ( x, y : 0.5, hold )
6 le = le ( x, y : h = 0.5 )
7 e = eq ( x, y : h = 0.5 )
8 n = ne ( x, y : )
9 s = hyst ( x : 6., 4., hold )
10 r = hyst ( x : 4., 6., )
11 C = hlcmp ( x : 6., 4., 0.5, )
13 A = alarm ( x : 7.5, 6.5, 3.5, 2.5, 0.25, 0.2, 0.3, hold )
19 d = devalm ( x, y : d = 1.5, db = 0.5 )
""", {"ain(0,1,1)": x.tolist(), "ain(0,1,2)": y.tolist()}, columns, "truth values")


def zones():
    rng = np.random.default_rng(3)
    steps = 100
    x = np.round(np.cumsum(rng.normal(0.0, 0.8, steps)), 3)
    x[40:44] = NAN
    band, lash, moved = [], [], []
    b = g = None
    for v in x:
        if not math.isnan(v):
            b = v if b is None or abs(v - b) > 1.2 else b
            g = v if g is None else min(max(g, v - 0.75), v + 0.75)
        band.append(b)
        lash.append(g)
    ramp = np.interp(x, [-1.0, 2.0], [-1.0, 2.0])
    shift = np.where(np.isnan(x), NAN, x - np.interp(x, [0.5 - 1.0, 0.5 + 1.0], [-0.5, 1.5]))
    shift = np.where(x > 1.5, x - 0.5 - 1.0, np.where(x < -0.5, x - 0.5 + 1.0, np.where(np.isnan(x), NAN, 0.0)))
    keep = np.where(np.isnan(x), NAN, np.where(np.abs(x - 0.5) > 1.0, x - 0.5, 0.0))
    step = np.sign(x) * np.floor(np.abs(x) / 0.4 + 0.5) * 0.4
    flag = [0 if math.isnan(v) else 1 if v > 2.0 else 2 if v < -1.0 else 0 for v in x]
    filtered, rate = None, []
    for v in x:
        if math.isnan(v):
            filtered = None
            rate.append(0.0)
            continue
        new = v if filtered is None else filtered + (1.0 - math.exp(-PERIOD / 0.3)) * (v - filtered)
        rate.append(0.0 if filtered is None else (new - filtered) / PERIOD)
        filtered = new
    columns = {
        "L": np.where(np.isnan(x), NAN, ramp).tolist(), "L.flag": flag,
        "z": shift.tolist(), "w": keep.tolist(), "q": step.tolist(), "b": band, "g": lash,
        "R": [int(r >= 2.0) for r in rate], "R.qdn": [int(r <= -1.5) for r in rate], "R.rate": rate,
    }
    write("limits_zones", "Limit, dead zone, quantiser, dead band, backlash, rate alarm.", """
1 x = ain ( : 0, 1, 1 )
2 L = hilim ( x : -1., 2. )
4 z = dzone ( x : 1., 0.5, )
5 w = dzone ( x : 1., 0.5, keep )
6 q = quant ( x : 0.4 )
7 b = dband ( x : 1.2 )
8 g = backl ( x : 1.5 )
9 R = rocalm ( x : 2., 1.5, 0.3, )
""", {"ain(0,1,1)": x.tolist()}, columns, "differences of decimals")


def transfers():
    steps = 60
    k = np.arange(steps)
    a = np.round(20.0 + 5.0 * np.sin(0.3 * k), 3)
    b = np.round(70.0 - 0.4 * k, 3)
    b[20:24] = NAN
    s = ((k // 15) % 2).astype(int)
    i = (k // 7 - 1).astype(int)
    # Which signal is taken in each scan, and when it was taken first: the ramp of 8 periods starts at the old output.
    y, taken, since, offset = [], None, 0, 0.0
    for n in range(steps):
        want = "b" if s[n] and not math.isnan(b[n]) else "a"
        new = b[n] if want == "b" else a[n]
        if taken is not None and want != taken:
            since, offset = n, y[-1] - new
        elif taken is None:
            since = n - 8
        taken = want
        y.append(new + offset * max(0.0, 1.0 - (n - since) / 8))
    redundant, who, ramp, last = [], [], (0, 0.0), None
    for n in range(steps):
        asked = "b" if s[n] else "a"
        use = asked if n == 0 or s[n] != s[n - 1] else last
        use = "a" if use == "b" and math.isnan(b[n]) else use
        new = b[n] if use == "b" else a[n]
        if last not in (None, use):
            ramp = (n, redundant[-1] - new)
        last = use
        redundant.append(new + ramp[1] * max(0.0, 1.0 - (n - ramp[0]) / 4))
        who.append(int(use == "b"))
    chosen = np.clip(i, 1, 3)
    three = np.stack([a, b, -a], axis=1)
    length = 0
    used, late = [], []
    for v in b:
        length = length + 1 if math.isnan(v) else 0
        used.append(int(1 <= length <= 3))
        late.append(length > 3)
    columns = {
        "y": y,
        "m": [float(v) for v in three[np.arange(steps), chosen - 1]],
        "D": [float(a[n]) if chosen[n] == 1 else -9.0 for n in range(steps)],
        "D.y3": [float(a[n]) if chosen[n] == 3 else -9.0 for n in range(steps)],
        "U": [float(a[n]) if used[n] else float(b[n]) for n in range(steps)],
        "U.used": used,
        "R": redundant,
        "R.st": who,
        "R.dv": [int(abs(v - w) > 45.0) for v, w in zip(a, b)],
    }
    write("limits_transfers", "Bumpless transfer, multiplexers, substitution.", """
1 a = ain ( : 0, 1, 1 )
2 b = ain ( : 0, 1, 2 )
3 s = msi ( : 0 )
4 i = msi ( : 0 )
5 y = atrans ( a, b, s : 0.8 )
6 c = sumII ( 1, a, a, 2 : -1., 0. )
7 m = mux ( a, b, c, i, 3 : )
8 D = demux ( a, i, 3 : -9. )
11 U = subst ( b, a : 0.3 )
13 R = redai ( a, b, s : dev = 45., trate = 0.4 )
""", {"ain(0,1,1)": a.tolist(), "ain(0,1,2)": b.tolist(), "s.value": s.tolist(), "i.value": i.tolist()}, columns,
          "sums of decimals")


def returns():
    """Return wires by their rules: hilim, selectors, split range of a cooling and a heating valve."""
    rng = np.random.default_rng(11)
    steps = 90
    x = np.round(rng.uniform(-10.0, 110.0, steps), 2)
    z = np.round(rng.uniform(0.0, 100.0, steps), 2)
    value = np.round(rng.uniform(5.0, 95.0, steps), 2)
    state = rng.integers(0, 4, steps)
    names = ["L", "H", "W", "S1", "S2"]
    columns = {f"{block}[{e}]": [] for block in ["Lbk", "H.bk1", "H.bk2", "W.bk1", "W.bk2", "Sbk"] for e in (1, 2)}
    columns.update({"S": [], "S2": []})
    assert names

    def put(name, pair):
        columns[f"{name}[1]"].append(float(pair[0]))
        columns[f"{name}[2]"].append(float(pair[1]))

    for u, v, f, st in zip(x, z, value, state):
        clamped = min(max(u, 20.0), 80.0)
        own = 1 if u > 80.0 else 2 if u < 20.0 else 0
        put("Lbk", (f, st) if st else (clamped, own))
        for block, best, limit in [("H", max(u, v), 2), ("W", min(u, v), 1)]:
            followed = f if st else best
            for port, signal in [("bk1", u), ("bk2", v)]:
                chosen = signal == best
                put(f"{block}.{port}", (followed, st if chosen or st == 3 else limit))
        # Cooling 100 to 0 on 0 to 45, heating 0 to 100 on 55 to 100; the return wire belongs to heating.
        cool = float(np.interp(u, [0.0, 45.0], [100.0, 0.0]))
        heat = float(np.interp(u, [55.0, 100.0], [0.0, 100.0]))
        columns["S"].append(cool)
        columns["S2"].append(heat)
        mapped = float(np.interp(f, [0.0, 100.0], [55.0, 100.0]))
        up = (u < 45.0) or (u < 100.0 and st != 1)
        down = (u > 0.0) or (u > 55.0 and st != 2)
        inside = 55.0 <= u <= 100.0 and st in (1, 2)
        hull = min(max(u, 0.0), 100.0)
        if st == 3:
            put("Sbk", (mapped, 3))
        elif up and down:
            put("Sbk", (hull, 0))
        else:
            put("Sbk", (mapped if inside else hull, 2 if up else 1))
    write("limits_returns", "Return wires of a limit, selectors and a split range.", """
1 x = ain ( : 0, 1, 1 )
2 z = ain ( : 0, 1, 2 )
3 value = ain ( : 0, 1, 3 )
4 state = ain ( : 0, 1, 4 )
5 back = ftov ( 2, value, 1 : )
6 back = ftov ( 2, state, 2 : )
7 L, flag, Lbk = hilim ( x, back : 20., 80. )
9 H = hisel ( x, z, 2, back = back : )
11 W = losel ( x, z, 2, back = back : )
13 S, S2, Sbk = split ( x, 2, back2 = back : 0., 55., 45., 100., 100., 0., 0., 100. )
""", {"ain(0,1,1)": x.tolist(), "ain(0,1,2)": z.tolist(), "ain(0,1,3)": value.tolist(), "ain(0,1,4)": state.tolist()},
          columns, "numpy's interpolation")


def sequences():
    """ISA-18.1 sequences and the first-out, typed in."""
    inputs = {
        "a.value": "  . 1 1 1 . . . 1 . . . . 1 1 1 . . . .",
        "k.value": "  . . . 1 1 . . . . 1 . . . 1 . . . . .",
        "r.value": "  . . . . . 1 . . . . . 1 . . . . 1 . .",
    }
    outputs = {
        "A.lamp": "   . 1 1 2 . . . 1 1 . . . 1 2 2 . . . .",
        "M.lamp": "   . 1 1 2 2 . . 1 1 2 2 . 1 2 2 2 . . .",
        "R.lamp": "   . 1 1 2 3 . . 1 1 3 3 . 1 2 2 3 . . .",
        "R": "        . 1 1 . . . . 1 1 . . . 1 . . . . . .",
        "R.horn": "   . 1 1 . . . . 1 1 . . . 1 . . . . . .",
        "F": "        . 2 2 2 2 . . 2 2 2 2 . 1 1 1 1 . . .",
        "F.order[1]": " . . . 2 2 . . . . 3 3 . 1 1 1 1 . . .",
        "F.order[2]": " . 1 1 1 1 . . 1 1 1 1 . 2 2 2 2 . . .",
        "F.order[3]": " . . . . . . . 2 2 2 2 . . . . . . . .",
    }
    stimulus = {name: row(text) for name, text in inputs.items()}
    stimulus["b.value"] = row(". . . . . . . 1 . . . . . . . . . . .")
    stimulus["c.value"] = row(". . . 1 1 . . . . 1 . . 1 1 . . . . .")
    lengths = {len(v) for v in stimulus.values()} | {len(row(t)) for t in outputs.values()}
    assert len(lengths) == 1, {n: len(row(t)) for n, t in outputs.items()}
    write("limits_sequences", "Alarm sequences of ISA-18.1, and which alarm came first.", """
1 a = msi ( : 0 )
2 k = msi ( : 0 )
3 r = msi ( : 0 )
4 b = msi ( : 0 )
5 c = msi ( : 0 )
6 A = ackalm ( a, k, r : )
9 M = ackalm ( a, k, r : manual )
12 R = ackalm ( a, k, r : ringback )
15 F = firstout ( c, a, b, 3, rst = r : )
""", stimulus, {name: row(text) for name, text in outputs.items()}, "tables")


selectors()
comparisons()
zones()
transfers()
returns()
sequences()

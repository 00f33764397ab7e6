"""Golden cases of the sequence codes: the vectors that the paper prints, brute force over all sets of transitions, a chart
interpreter, the function blocks of IEC 61131-3 wired as its figure of ACTION_CONTROL, and rules restated with counts of
scans. Times are whole milliseconds here."""
import itertools

import numpy as np

import golden

PERIOD = 100  # ms


def write(name, title, program, stimulus, columns, initialize=""):
    """stimulus and columns: {name: values by scan}; times, in ms, have names that end in `.t` or `.tleft`."""
    steps = len(next(iter(stimulus.values())))
    timed = (".t", ".tleft")
    cells = [[k] + [values[k] for values in stimulus.values()] for k in range(steps)]
    rows = [[k] + [values[k] / 1000 if key.endswith(timed) else values[k] for key, values in columns.items()]
            for k in range(steps)]
    head = f"INITIALIZE\n{initialize.strip()}\n" if initialize else ""
    golden.write(name, f"! {title}\n{head}CONTROL\n{program.strip()}\nEND\n", (list(stimulus), cells),
                 (list(columns), rows), "tables; a time is shown as seconds", period=PERIOD / 1000)


def flags(rng, steps, share):
    return [int(value) for value in rng.random(steps) < share]


def levels(rng, steps, share):
    """A signal that changes with this probability in a scan."""
    return [int(value) for value in np.cumsum(rng.random(steps) < share) % 2]


def rising(values, k):
    """An edge; the first scan has none."""
    return k > 0 and values[k] != 0 and values[k - 1] == 0


def inputs(names):
    return "".join(f"{i + 1} {name} = msi ( : 0 )\n" for i, name in enumerate(names))


def flat(matrix):
    return ",\n    ".join(", ".join(str(value) for value in row) for row in matrix)


# --- Nets ---------------------------------------------------------------------------------------------------------------

def matrices(places, transitions):
    """transitions: {name: ({place: taken}, {place: put})}; references stand in both."""
    row = {place: i for i, place in enumerate(places)}
    minus = [[0] * len(transitions) for _ in places]
    plus = [[0] * len(transitions) for _ in places]
    for j, (takes, puts) in enumerate(transitions.values()):
        for place, weight in takes.items():
            minus[row[place]][j] = weight
        for place, weight in puts.items():
            plus[row[place]][j] = weight
    return minus, plus


def legal(chosen, minus, plus, marking, capacity):
    """Whether these transitions can fire together from this marking."""
    for i, tokens in enumerate(marking):
        pairs = [(minus[i][j], plus[i][j]) for j in chosen]
        if any(a == b and a > tokens for a, b in pairs):
            return False
        if sum(a for a, b in pairs if a != b) > tokens:
            return False
        room = max(0, (capacity[i] or 2**31 - 1) - tokens)
        if sum(max(0, b - a) for a, b in pairs) > room:
            return False
    return True


def best(minus, plus, marking, capacity, condition):
    """Of all sets that can fire together the one that prefers the earlier transition, whatever the later ones are."""
    free = [j for j, holds in enumerate(condition) if holds]
    sets = [combination for size in range(len(free) + 1) for combination in itertools.combinations(free, size)]
    vectors = [[int(j in chosen) for j in range(len(condition))]
               for chosen in sets if legal(chosen, minus, plus, marking, capacity)]
    return max(vectors)


def fired(minus, plus, marking, vector):
    change = np.array(plus) - np.array(minus)
    return [int(value) for value in np.array(marking) + change @ np.array(vector)]


TANK = {
    "t0": "S0 S1 P1", "t1": "S1 S2 D20", "t2": "S2 S3 D11", "t3": "S3 S4 V10", "t4": "S4 S5 D10", "t5": "S5 S6 D21",
    "t6": "S6 S0 V20 L1", "tp10": "P1 P0", "tp11": "P0 P1", "tL0": "L0 L1 S6", "tL1": "L1 L0 S1", "tv10": "V10 V11 S1",
    "tv11": "V11 V10 S3", "tv20": "V20 V21 S4", "tv21": "V21 V20 S6", "tz10": "Z11 Z12 V11", "tz11": "Z10 Z11 V11",
    "tz12": "Z12 Z11 V21", "tz13": "Z11 Z10 V21", "tD10": "D10 D11 Z12", "tD11": "D11 D10 Z11", "tD20": "D20 D21 Z10",
    "tD21": "D21 D20 Z11",
}
TANK_PLACES = ("S0 S1 S2 S3 S4 S5 S6 P0 P1 L1 L0 V11 V10 V21 V20 Z12 Z11 Z10 D11 D10 D21 D20").split()
# The published vectors (9), (15), (16), (17), and the matrices (8) and (14) that lead to them.
MAIN = [[-1, 0, 0, 0, 0, 0, 1, 0, 0], [1, -1, 0, 0, 0, 0, 0, 0, 0], [0, 1, -1, 0, 0, 0, 0, 0, 0],
        [0, 0, 1, -1, 0, 0, 0, 0, 0], [0, 0, 0, 1, -1, 0, 0, 0, 0], [0, 0, 0, 0, 1, -1, 0, 0, 0],
        [0, 0, 0, 0, 0, 1, -1, 0, 0], [0, 0, 0, 0, 0, 0, 0, 1, -1], [0, 0, 0, 0, 0, 0, 0, -1, 1]]
CHARGE = [[1, -1, 0, 0, 0, 0, 0, 0, 0, 0], [-1, 1, 0, 0, 0, 0, 0, 0, 0, 0], [0, 0, 1, -1, 0, 0, 0, 0, 0, 0],
          [0, 0, -1, 1, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 1, 0, -1, 0, 0, 0], [0, 0, 0, 0, -1, 1, 1, -1, 0, 0],
          [0, 0, 0, 0, 0, -1, 0, 1, 0, 0], [0, 0, 0, 0, 0, 0, 0, 0, 1, -1], [0, 0, 0, 0, 0, 0, 0, 0, -1, 1]]
PRINTED = {"p9": "0 1 0 0 0 0 0 0 1", "p15": "0 1 1 0 0 0 1 1 0", "p16": "0 1 1 0 0 1 0 1 0", "p17": "0 1 1 0 1 0 0 0 1"}


def tank():
    transitions = {}
    for name, text in TANK.items():
        before, behind, *read = text.split()
        transitions[name] = ({before: 1, **{p: 1 for p in read}}, {behind: 1, **{p: 1 for p in read}})
    minus, plus = matrices(TANK_PLACES, transitions)
    start = [int(place in "S0 P0 L1 V10 V20 Z10 D10 D21".split()) for place in TANK_PLACES]
    names, steps = list(TANK), 20
    press, release = [int(k == 1) for k in range(steps)], [int(k == 6) for k in range(steps)]
    marking, markings, vectors = start, [], []
    for k in range(steps):
        # A token a place: without conflicts, so what is enabled fires.
        there = {place for place, tokens in zip(TANK_PLACES, marking) if tokens}
        condition = [{"tp11": press[k], "tp10": release[k]}.get(name, 1) for name in names]
        vector = [int(holds and set(takes) <= there) for holds, (takes, _) in zip(condition, transitions.values())]
        assert legal([j for j in range(len(names)) if vector[j]], minus, plus, marking, [0] * len(start))
        marking = fired(minus, plus, marking, vector)
        markings.append(marking)
        vectors.append(vector)
    # From the press of the button back to the start: 16 scans, and each transition once.
    assert marking == start and [sum(column) for column in zip(*vectors)] == [1] * len(names)
    assert [k for k in range(steps) if any(vectors[k])] == list(range(1, 17))
    columns = {f"N[{i + 1}]": [m[i] for m in markings] for i in range(len(start))}
    columns |= {f"N.f[{j + 1}]": [v[j] for v in vectors] for j in range(len(names))}
    columns |= {f"{name}[{i + 1}]": [int(value)] * steps
                for name, text in PRINTED.items() for i, value in enumerate(text.split())}
    stimulus = {f"c.v[{names.index('tp11') + 1}]": press, f"c.v[{names.index('tp10') + 1}]": release}
    program = f"""
8 c = setivec ( {len(names)} : v = 1 )
9 N = pnet ( {len(start)}, {len(names)}, c :
    {flat(minus)},
    {flat(plus)},
    {flat([start])}, cap = 0 )
20 p9 = pnfire ( p6, B, t7 : )
21 p15 = pnfire ( p12, Bs, t13 : )
22 p16 = pnfire ( p15, Bs, t15 : )
23 p17 = pnfire ( p16, Bs, t16 : )
"""
    initialize = f"""
1 B = setimat ( 9, 9 : {flat(MAIN)} )
2 p6 = setivec ( 9 : 1, 0, 0, 0, 0, 0, 0, 1, 0 )
3 t7 = setivec ( 9 : 1, 0, 0, 0, 0, 0, 0, 0, 1 )
4 Bs = setimat ( 9, 10 : {flat(CHARGE)} )
5 p12 = setivec ( 9 : 1, 0, 0, 1, 0, 0, 1, 1, 0 )
6 t13 = setivec ( 10 : 0, 1, 1, 0, 0, 0, 0, 0, 0, 0 )
7 t15 = setivec ( 10 : 0, 0, 0, 0, 0, 1, 0, 0, 0, 0 )
30 t16 = setivec ( 10 : 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 )
"""
    write("sequence_tank", "The paper's measuring tank: the whole net, and the printed vectors of the divided one.",
          program, stimulus, columns, initialize)


def nets():
    """A net with weights, capacities, references, loops and conflicts; conditions, capacities and weights change."""
    rng, steps = np.random.default_rng(17), 90
    places = [f"p{i}" for i in range(6)]
    transitions = {
        "a": ({"p0": 2}, {"p1": 1}), "b": ({"p0": 1, "p4": 1}, {"p2": 2, "p4": 1}), "c": ({"p1": 1}, {"p0": 2, "p3": 1}),
        "d": ({"p2": 1, "p5": 2}, {"p0": 1, "p5": 1}), "e": ({"p3": 2}, {"p5": 3}), "f": ({}, {"p3": 1}),
        "g": ({"p2": 1, "p0": 1}, {"p0": 2}), "h": ({"p5": 1}, {}), "i": ({"p1": 1, "p2": 1}, {"p0": 1, "p1": 1, "p2": 1}),
    }
    minus, plus = matrices(places, transitions)
    start, capacity = [2, 0, 1, 0, 1, 2], [7, 2, 3, 4, 0, 0]
    conditions = [flags(rng, steps, 0.6) for _ in transitions]
    rst = [int(k in (40, 41)) for k in range(steps)]
    room = [2 if 20 <= k < 30 else 7 if k < 60 else 0 for k in range(steps)]
    weight = [1 if k < 70 else 2 for k in range(steps)]
    marking, markings, vectors = start, [], []
    for k in range(steps):
        capacity[0], minus[0][1] = room[k], weight[k]
        condition = [values[k] for values in conditions]
        vector = best(minus, plus, marking, capacity, condition) if not rst[k] else [0] * len(condition)
        marking = fired(minus, plus, marking, vector) if not rst[k] else start
        markings.append(marking)
        vectors.append(vector)
    minus[0][1], capacity[0] = 1, 7
    assert all(sum(column) > 2 for column in zip(*vectors)), "each transition fires"
    stimulus = {f"c.v[{j + 1}]": values for j, values in enumerate(conditions)}
    stimulus |= {"rst.value": rst, "N.cap[1]": room, "N.Bm[1,2]": weight}
    # The state equation, from changing markings, at the ends of the range too.
    wide = [[2147483647, -2147483648, 1], [-1, 2, 2147483647], [3, 0, -2]]
    x = [[int(v) for v in rng.choice([0, 1, -1, 7, 2147483647, -2147483648], 3)] for _ in range(steps)]
    f = [[int(v) for v in rng.choice([0, 1, 2, -1, 2147483647, -2147483648], 3)] for _ in range(steps)]
    sums = [[max(-2**31, min(2**31 - 1, a + sum(b * c for b, c in zip(row, f[k])))) for a, row in zip(x[k], wide)]
            for k in range(steps)]
    stimulus |= {f"x.v[{i + 1}]": [v[i] for v in x] for i in range(3)}
    stimulus |= {f"f.v[{i + 1}]": [v[i] for v in f] for i in range(3)}
    columns = {f"N[{i + 1}]": [m[i] for m in markings] for i in range(len(places))}
    columns |= {f"N.f[{j + 1}]": [v[j] for v in vectors] for j in range(len(transitions))}
    columns |= {f"y[{i + 1}]": [v[i] for v in sums] for i in range(3)}
    program = f"""
2 rst = msi ( : 0 )
3 c = setivec ( {len(transitions)} : )
4 N = pnet ( {len(places)}, {len(transitions)}, c, rst :
    {flat(minus)},
    {flat(plus)},
    {flat([start])},
    {flat([capacity])} )
6 x = setivec ( 3 : )
7 f = setivec ( 3 : )
8 y = pnfire ( x, B, f : )
"""
    write("sequence_nets", "Nets with weights, capacities, references and conflicts; the state equation.", program,
          stimulus, columns, f"1 B = setimat ( 3, 3 : {flat(wide)} )")


# --- Sequential function charts -----------------------------------------------------------------------------------------

class Chart:
    """A chart as IEC 61131-3 evolves it: what can be crossed at the start is crossed, all at once; left before right."""

    def __init__(self, initial, transitions):
        self.initial, self.transitions = initial, transitions
        self.active, self.since, self.ran = set(), {}, {}

    def time(self, step, k):
        return (k - self.since[step]) * PERIOD if step in self.active else self.ran.get(step, 0)

    def begin(self, k):
        for step in set(self.since) - self.initial:
            self.ran[step] = 0
        self.active, self.since = set(self.initial), {step: k for step in self.initial}

    def scan(self, k, holds):
        left, entered, free = set(), set(), set(self.active)
        crossed = []
        for name, before, behind in self.transitions:
            if before <= free and holds(name):
                free -= before
                left |= before
                entered |= behind
                crossed.append(name)
        for step in left:
            self.ran[step] = (k - self.since[step] - 1) * PERIOD
        self.active = (self.active - left) | entered
        self.since |= {step: k for step in entered}
        return crossed


STEPS_PROGRAM = """
6 late = S4.t >= 0.3
7 both = and ( S2, S3 : )
10 T1 = trans ( S0, a : )
12 T2 = trans ( T1.rest, b : )
14 T3 = trans ( S1, c : )
16 T4 = trans ( both, d : )
18 T5 = trans ( S4, late : )
20 T6 = trans ( S5, c : )
22 home = or ( T5, T6 : )
23 gone = or ( T1, T2 : )
30 S0 = step ( home, gone, clr : yes )
32 S1 = step ( T1, T3, clr : )
34 S2 = step ( T1, T4, clr : )
36 S3 = step ( T3, T4, clr : )
38 S4 = step ( T4, T5, clr : )
40 S5 = step ( T2, T6, clr : )
"""


def charts():
    rng, steps = np.random.default_rng(4), 160
    shares = {"a": 0.25, "b": 0.15, "c": 0.3, "d": 0.4}
    signals = {name: flags(rng, steps, share) for name, share in shares.items()}
    clr = [int(k in (57, 58, 120)) for k in range(steps)]
    chart = Chart({"S0"}, [("T1", {"S0"}, {"S1", "S2"}), ("T2", {"S0"}, {"S5"}), ("T3", {"S1"}, {"S3"}),
                           ("T4", {"S2", "S3"}, {"S4"}), ("T5", {"S4"}, {"S0"}), ("T6", {"S5"}, {"S0"})])
    names = [f"S{i}" for i in range(6)]
    columns = {name: [] for name in names} | {f"{name}.t": [] for name in names} | {f"T{i}": [] for i in range(1, 7)}
    counts = {}
    for k in range(steps):
        inputs_of = {"T1": "a", "T2": "b", "T3": "c", "T4": "d", "T6": "c"}
        holds = lambda name: chart.time("S4", k - 1) >= 300 if name == "T5" else signals[inputs_of[name]][k]
        if k == 0 or clr[k]:
            # The transitions judge before the steps begin anew.
            before = Chart(chart.initial, chart.transitions)
            before.active, before.since, before.ran = set(chart.active), dict(chart.since), dict(chart.ran)
            crossed = before.scan(k, holds) if k else []
            chart.begin(k)
        else:
            crossed = chart.scan(k, holds)
        for name in names:
            columns[name].append(int(name in chart.active))
            columns[f"{name}.t"].append(chart.time(name, k))
        for i in range(1, 7):
            columns[f"T{i}"].append(int(f"T{i}" in crossed))
        for name in crossed:
            counts[name] = counts.get(name, 0) + 1
        # One token, or two in the parallel branch: nothing is lost, nothing doubled.
        where = chart.active
        assert len(where) == (2 if where & {"S1", "S2", "S3"} else 1)
    assert len(counts) == 6 and min(counts.values()) > 2, counts
    stimulus = {f"{name}.value": values for name, values in signals.items()} | {"clr.value": clr}
    write("sequence_steps", "A chart with a choice and a parallel branch.", inputs(["a", "b", "c", "d", "clr"])
          + STEPS_PROGRAM.strip(), stimulus, columns)


class Rs:
    """RS of the standard."""
    q = False

    def __call__(self, s, r1):
        self.q = not r1 and (s or self.q)
        return self.q


class Ton:
    """TON of the standard; counts whole periods from 0 in the scan of the edge."""
    began = None

    def __call__(self, k, enabled, pt):
        self.began = None if not enabled else k if self.began is None else self.began
        return enabled and (k - self.began) * PERIOD >= pt


class Trig:
    """R_TRIG of the standard."""
    m = False

    def __call__(self, clk):
        q = clk and not self.m
        self.m = clk
        return q


class ActionControl:
    """The figure of ACTION_CONTROL, wire by wire, with the pulses P1 and P0 of the later editions."""

    def __init__(self, t):
        self.t = t
        self.s_ff, self.sd_ff, self.ds_ff, self.sl_ff = Rs(), Rs(), Rs(), Rs()
        self.l_tmr, self.d_tmr, self.sd_tmr, self.ds_tmr, self.sl_tmr = Ton(), Ton(), Ton(), Ton(), Ton()
        self.p_trig, self.p1_trig, self.p0 = Trig(), Trig(), False

    def __call__(self, k, **on):
        get = lambda name: bool(on.get(name, False))
        r = get("R")
        parts = [get("N"), self.s_ff(get("S"), r)]
        over = self.l_tmr(k, get("L"), self.t)
        parts.append(get("L") and not over)
        parts.append(self.d_tmr(k, get("D"), self.t))
        parts.append(self.p_trig(get("P")))
        parts.append(self.sd_tmr(k, self.sd_ff(get("SD"), r), self.t))
        parts.append(self.ds_ff(self.ds_tmr(k, get("DS"), self.t), r))
        stored = self.sl_ff(get("SL"), r)
        over = self.sl_tmr(k, stored, self.t)
        parts.append(stored and not over)
        parts.append(self.p1_trig(get("P1")))
        parts.append(self.p0 and not get("P0"))
        self.p0 = get("P0")
        return int(not r and any(parts))


def actions():
    """Each qualifier with an R beside it; several steps of one qualifier; all at once, in two orders of the steps."""
    rng, steps = np.random.default_rng(9), 240
    x = levels(rng, steps, 0.12)
    y = levels(rng, steps, 0.2)
    r = flags(rng, steps, 0.04)
    z = levels(rng, steps, 0.07)
    kinds = "N R S L D P SD DS SL P1 P0".split()
    signals = {"x": x, "y": y, "z": z, "r": r}
    lists = {f"q{kind}": [("x", kind), ("r", "R")] for kind in kinds}
    lists |= {f"o{kind}": [("x", kind), ("y", kind), ("r", "R")] for kind in kinds}
    mixed = [("x", "S"), ("y", "L"), ("z", "D"), ("r", "R"), ("z", "SL"), ("x", "P0")]
    lists |= {"first": mixed, "last": mixed[::-1]}
    columns, program = {}, inputs(list(signals))
    for number, (name, pairs) in enumerate(lists.items()):
        block, values = ActionControl(250 if name != "first" and name != "last" else 500), []
        for k in range(steps):
            on = {kind: any(signals[signal][k] for signal, other in pairs if other == kind) for _, kind in pairs}
            values.append(block(k, **on))
        columns[name] = values
        program += (f"{number + 10} {name} = action ( {', '.join(signal for signal, _ in pairs)}, {len(pairs)} : "
                    f"{', '.join(kind for _, kind in pairs)}, {block.t / 1000} )\n")
        assert 0 < sum(values) < steps or name in ("qR", "oR"), name
    assert columns["first"] == columns["last"]
    write("sequence_actions", "Actions with every qualifier, alone and together.", program,
          {f"{name}.value": values for name, values in signals.items()}, columns)


# --- Generators, devices, interlocks ------------------------------------------------------------------------------------

def generators():
    rng, steps = np.random.default_rng(23), 260
    names = ["trig", "hold", "thold", "rst", "jmp", "jn", "dis", "cycle"]
    signals = {name: flags(rng, steps, share)
               for name, share in zip(names, (0.2, 0.0, 0.0, 0.02, 0.06, 0.0, 0.1, 0.0))}
    signals["hold"], signals["thold"] = levels(rng, steps, 0.06), levels(rng, steps, 0.06)
    signals["cycle"] = [int(k > 120) for k in range(steps)]
    signals["jn"] = [int(v) for v in rng.integers(-1, 7, steps)]
    masks = [5, 2, -8, 33]
    second = [200 if k < 150 else 450 for k in range(steps)]
    step, waited, columns = 0, 0, {name: [] for name in ("G", "G.step", "G.tleft", "G.taken")}
    for k in range(steps):
        s = {name: values[k] for name, values in signals.items()}
        times = [250, second[k], 0, 100]
        waited += int(not s["thold"])
        goes = None
        if s["rst"]:
            goes = 0 if step else None
        elif rising(signals["jmp"], k) and 0 <= s["jn"] <= 4:
            goes = s["jn"]
        elif not s["hold"]:
            over = step > 0 and times[step - 1] > 0 and waited * PERIOD >= times[step - 1]
            if rising(signals["trig"], k) or over:
                goes = step + 1 if step < 4 else s["cycle"]
        if goes is not None:
            step, waited = goes, 0
        length = times[step - 1] if step else 0
        columns["G"].append(masks[step - 1] if step and not s["dis"] else 0)
        columns["G.step"].append(step)
        columns["G.tleft"].append(max(0, length - waited * PERIOD) if length else 0)
        columns["G.taken"].append(int(goes is not None))
    assert set(columns["G.step"]) == set(range(5))
    # The master: four outputs by the digits of the selected mask, a 2 as it was.
    texts, selected, outputs = ["1001", "0220", "2212", "0000", "1222"], 0, "0000"
    columns |= {f"M[{i}]": [] for i in range(1, 5)} | {"M.step": []}
    for k in range(steps):
        if rising(signals["jmp"], k) and 0 <= signals["jn"][k] <= len(texts):
            selected = signals["jn"][k]
        mask = texts[selected - 1] if selected else "0000"
        outputs = "".join(old if digit == "2" else digit for old, digit in zip(outputs, mask))
        for i in range(4):
            columns[f"M[{i + 1}]"].append(int(outputs[i]))
        columns["M.step"].append(selected)
    program = inputs(names) + f"""
10 G = seqgen ( trig, hold, thold, rst, jmp, jn, dis, 4, cycle : {', '.join(map(str, masks))}, 0.25, 0.2, 0., 0.1 )
20 M = seqmas ( jmp, jn, 5 : {', '.join(str(int(text)) for text in texts)} )
""".strip()
    stimulus = {f"{name}.value": values for name, values in signals.items()}
    stimulus["G.times[2]"] = [value / 1000 for value in second]
    write("sequence_generators", "Steps by time, trigger, jump and number.", program, stimulus, columns)


def agrees(mask, feedback):
    return all(digit == "2" or int(digit) == bit for digit, bit in zip(mask, feedback))


def driver(cmd, fb, ovr, masks, twait):
    """The two-state driver: states good, bad, waiting."""
    out, st, since, waiting = [], [], None, False
    for k, command in enumerate(cmd):
        if k == 0 or command != cmd[k - 1]:
            since, waiting = k, True
        if ovr[k] or agrees(masks[command], fb[k]):
            st.append(0)
            waiting = False
        elif waiting and (k - since) * PERIOD < twait:
            st.append(2)
        else:
            st.append(1)
            waiting = False
        out.append(command)
    return out, st


def multistate(c1, c2, fb, outs, fbs, twait, tfault, pulse):
    outputs, st, state, since, deadline, good = [], [], 0, 0, None, False
    for k in range(len(c1)):
        asked = c1[k] + 2 * c2[k]
        if asked and asked != state:
            state, since, deadline, good = asked, k, k * PERIOD + twait, False
        if state == 0 or agrees(fbs[state - 1], fb[k]):
            st.append(0)
            deadline, good = None, True
        else:
            if deadline is None and good:
                deadline = k * PERIOD + tfault
            good = False
            st.append(2 if deadline is not None and k * PERIOD < deadline else 1)
            if st[-1] == 1:
                deadline = None
        live = state > 0 and (pulse == 0 or (k - since) * PERIOD < pulse)
        outputs.append([int(digit) for digit in outs[state - 1]] if live else [0, 0, 0])
    return outputs, st


def timed_device(signals, reports, up_time, down_time, inhibit, has_rest):
    """Motor or valve as one chart: rest, rising, work, falling, failed, with the reasons of its arrows. A valve has_rest:
    it reports its rest too, begins as falling, and a rest that it leaves by itself is a failure."""
    state, since, cause, stopped = ("falling" if has_rest else "rest"), 0, "none", None
    rows = []
    for k in range(len(signals["go"])):
        s = {name: values[k] for name, values in signals.items()}
        at_work, at_rest = reports(k, [row[0] for row in rows])
        age = (k - since) * PERIOD
        left = 0 if stopped is None else max(0, inhibit - (k - stopped) * PERIOD)
        allowed = not s["stop"] and not s["trip"] and s["ilk"]
        arrows = {
            "rest": [(s["trip"], "failed", "trip"), (not at_rest and has_rest, "failed", "moved"),
                     (not at_rest, "falling", cause), (rising(signals["go"], k) and allowed and not left, "rising", "none")],
            "rising": [(s["trip"], "failed", "trip"), (s["stop"], "falling", "none"), (not s["ilk"], "falling", "interlock"),
                       (at_work, "work", "none"), (age >= up_time, "failed", "noup")],
            "work": [(s["trip"], "failed", "trip"), (s["stop"], "falling", "none"), (not s["ilk"], "falling", "interlock"),
                     (not at_work, "failed", "moved")],
            "falling": [(s["trip"], "failed", "trip"), (at_rest, "rest", cause), (age >= down_time, "failed", "nodown")],
            "failed": [(rising(signals["rst"], k) and not s["trip"] and (has_rest or at_rest),
                        "falling" if has_rest else "rest", "none")],
        }
        driven = state in ("rising", "work")
        for holds, target, reason in arrows[state]:
            if holds:
                state, cause, since = target, reason, k
                break
        if driven and state not in ("rising", "work"):
            stopped, left = k, inhibit
        ready = state == "rest" and allowed and not left and bool(at_rest)
        rows.append((int(state in ("rising", "work")), state, int(ready), cause, left))
    return rows


class Device:
    """What is driven: it follows after one to three scans, and now and then not at all or by itself."""

    def __init__(self, rng, both):
        self.rng, self.both, self.place, self.target, self.due = rng, both, 0, 0, 0
        self.working, self.resting = [], []

    def __call__(self, k, driven):
        wanted = driven[-1] if driven else 0
        if wanted != self.target:
            late = int(self.rng.integers(1, 4)) if self.rng.random() < 0.85 else 9
            self.target, self.due = wanted, k + late
        slips = self.rng.random() < 0.02
        self.place = 1 - self.place if slips else self.target if k >= self.due else self.place
        moving = self.both and self.place != self.target
        self.working.append(int(self.place and not moving))
        self.resting.append(int(not self.place and not moving))
        return self.working[-1], self.resting[-1]


MOTOR_STATES = ["rest", "rising", "work", "falling", "failed"]
VALVE_STATES = ["falling", "rest", "rising", "work", "failed"]
CAUSES = ["none", "interlock", "trip", "noup", "moved", "nodown"]


def motors():
    rng, steps = np.random.default_rng(31), 500
    signals = {name: flags(rng, steps, share)
               for name, share in (("go", 0.3), ("stop", 0.04), ("trip", 0.01), ("ilk", 0.98), ("rst", 0.2))}
    pump, gate = Device(rng, False), Device(rng, True)
    motor = timed_device(signals, pump, 300, 250, 400, False)
    valve = timed_device(signals, gate, 400, 500, 0, True)
    columns = {"M": [row[0] for row in motor], "M.state": [MOTOR_STATES.index(row[1]) for row in motor],
               "M.ready": [row[2] for row in motor], "M.cause": [CAUSES.index(row[3]) for row in motor],
               "M.tleft": [row[4] for row in motor],
               "V": [row[0] for row in valve], "V.state": [VALVE_STATES.index(row[1]) for row in valve],
               "V.ready": [row[2] for row in valve], "V.cause": [CAUSES.index(row[3]) for row in valve]}
    for name, least in (("M.state", 5), ("M.cause", 6), ("V.state", 5), ("V.cause", 6)):
        assert set(columns[name]) == set(range(least)), name
    signals |= {"fb": pump.working, "fbo": gate.working, "fbc": gate.resting}
    program = inputs(signals) + """
10 M = motor ( go, stop, fb, trip, ilk, rst : 0.3, 0.25, 0.4 )
20 V = valveo ( go, stop, fbo, fbc, trip, ilk, rst : 0.4, 0.5 )
""".strip()
    write("sequence_motors", "A motor and a valve that report in time, late, not at all, and without being asked.", program,
          {f"{name}.value": values for name, values in signals.items()}, columns)


def devices():
    rng, steps = np.random.default_rng(41), 240
    names = ["cmd", "fb1", "fb2", "fb3", "fb4", "ovr", "c1", "c2"]
    shares = (0.08, 0.15, 0.2, 0.1, 0.1, 0.04, 0.05, 0.05)
    signals = {name: levels(rng, steps, share) for name, share in zip(names, shares)}
    fb = list(zip(*(signals[f"fb{i}"] for i in range(1, 5))))
    out, st = driver(signals["cmd"], fb, signals["ovr"], ["01", "12"], 350)
    outs, fbs = ["100", "011", "001"], ["1222", "0122", "2212"]
    outputs, states = multistate(signals["c1"], signals["c2"], fb, outs, fbs, 300, 200, 0)
    pulses, again = multistate(signals["c1"], signals["c2"], fb, outs, fbs, 0, 0, 250)
    assert set(st) == set(states) == {0, 1, 2} and set(again) == {0, 1}
    columns = {"D": out, "D.st": st} | {f"A.o{i + 1}" if i else "A": [o[i] for o in outputs] for i in range(3)}
    columns |= {"A.st": states} | {f"B.o{i + 1}" if i else "B": [o[i] for o in pulses] for i in range(3)} | {"B.st": again}
    program = inputs(names) + f"""
10 D = devdrv ( cmd, fb1, fb2, ovr : 01, 12, 0.35 )
20 A = msdd ( c1, c2, fb1, fb2, fb3, fb4 : {', '.join(str(int(v)) for v in outs + fbs)}, 0.3, 0.2, 0. )
30 B = msdd ( c1, c2, fb1, fb2, fb3, fb4 : {', '.join(str(int(v)) for v in outs + fbs)}, 0., 0., 0.25 )
""".strip()
    write("sequence_devices", "Drivers of devices whose feedbacks agree late, never, or stop agreeing.", program,
          {f"{name}.value": values for name, values in signals.items()}, columns)


def interlocks():
    rng, steps = np.random.default_rng(47), 240
    conditions = [[1 - v for v in flags(rng, steps, 0.08)] for _ in range(4)]
    for i, begin, length in ((0, 50, 6), (3, 118, 12), *((i, k + 6 * i, 8) for i in (1, 2) for k in range(20, 220, 40))):
        conditions[i][begin:begin + length] = [0] * length
    asked = [levels(rng, steps, 0.06) for _ in range(4)]
    rst = flags(rng, steps, 0.05)
    allowed = [0, 1, 1, 0]
    columns = {}
    for tag, delay in (("I", 0), ("J", 250)):
        ok, first, last = [], [], 1
        for k in range(steps):
            lost = []
            for i, values in enumerate(conditions):
                # How long it has been 0 without a break, this scan included.
                run = next((n for n in range(k + 1) if values[k - n]), k + 1)
                if run > 0 and (run - 1) * PERIOD >= delay and not (asked[i][k] and allowed[i]):
                    lost.append(i + 1)
            ok.append(int(not lost))
            before = first[-1] if first else 0
            first.append(min(lost) if lost and last else 0 if rst[k] and not lost else before)
            last = ok[-1]
        columns |= {tag: ok, f"{tag}.first": first}
        columns |= {f"{tag}.bypassed[{i + 1}]": [int(asked[i][k] and allowed[i]) for k in range(steps)] for i in range(4)}
        assert set(first) == set(range(5)) and 0 < sum(ok) < steps
    table = [[1.5, -2.0, 3.25], [10.0, 20.0, 30.0], [0.125, 0.0, 7.0]]
    number = [int(v) for v in rng.integers(-2, 6, steps)]
    names = ["c1", "c2", "c3", "c4", "rst", "number"]
    program = inputs(names) + f"""
10 I = ilock ( c1, c2, c3, c4, 4, rst = rst : 0., no, yes, yes, no )
20 keys = setivec ( 4 : )
21 J = ilock ( c1, c2, c3, c4, 4, by = keys, rst = rst : 0.25, no, yes, yes, no )
30 v = recipe ( number, 3, 3 : {', '.join(str(value) for row in table for value in row)} )
""".strip()
    stimulus = {f"c{i + 1}.value": values for i, values in enumerate(conditions)} | {"rst.value": rst, "number.value": number}
    stimulus |= {f"I.by[{i + 1}]": values for i, values in enumerate(asked)}
    stimulus |= {f"keys.v[{i + 1}]": values for i, values in enumerate(asked)}
    rows = [table[min(max(i, 1), 3) - 1] for i in number]
    write("sequence_interlocks", "Interlocks with bypasses, by the operator and by wire; recipes.", program, stimulus,
          columns | {f"v[{i + 1}]": [row[i] for row in rows] for i in range(3)})


if __name__ == "__main__":
    tank()
    nets()
    charts()
    actions()
    generators()
    devices()
    motors()
    interlocks()

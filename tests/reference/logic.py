"""Golden cases of the logic codes: the timing diagrams of IEC 61131-3 and truth tables, typed in as rows of scans.

A time in these rows is a number of periods of 0.1 s; a dot is 0."""
import golden

PERIOD = 0.1


def row(text):
    return [0 if cell == "." else int(cell) for cell in text.split()]


def table(name, title, inputs, program, outputs, times=(), period=PERIOD):
    """inputs: {stimulus column: row}, outputs: {trace column: row}; times are the columns in periods."""
    rows = [row(text) for text in inputs.values()]
    expected = [[cell * period if name in times else cell for cell in row(text)] for name, text in outputs.items()]
    length = len(rows[0])
    assert all(len(cells) == length for cells in rows + expected), {n: len(row(t)) for n, t in {**inputs, **outputs}.items()}
    stimulus = [[k] + [cells[k] for cells in rows] for k in range(length)]
    trace = [[k] + [cells[k] for cells in expected] for k in range(length)]
    golden.write(name, f"! {title}\n{program.strip()}\n", (list(inputs), stimulus), (list(outputs), trace),
                 "tables; a time is shown as seconds", period=period)


# The diagrams: an input longer than pt, one shorter, one that comes back within pt. pt is 4 periods.
IN = "  . 1 1 1 1 1 1 1 . . 1 1 . . 1 . . 1 1 1 1 1 1 . . . . . . . . . 1 . 1 . 1 . ."
TON_Q = ". . . . . 1 1 1 . . . . . . . . . . . . . 1 1 . . . . . . . . . . . . . . . ."
TON_T = ". . 1 2 3 4 4 4 . . . 1 . . . . . . 1 2 3 4 4 . . . . . . . . . . . . . . . ."
TOF_Q = ". 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 . . . . . 1 1 1 1 1 1 1"
TOF_T = ". . . . . . . . . 1 . . . 1 . . 1 . . . . . . . 1 2 3 4 4 4 4 4 . . . . . . 1"
TP_Q = "  . 1 1 1 1 . . . . . 1 1 1 1 . . . 1 1 1 1 . . . . . . . . . . . 1 1 1 1 . . ."
TP_T = "  . . 1 2 3 4 4 4 . . . 1 2 3 4 . . . 1 2 3 4 4 . . . . . . . . . . 1 2 3 4 . ."

table("logic_timers", "Timers: the timing diagrams of IEC 61131-3.", {"in.value": IN}, """
CONTROL
1 in = msi ( : 0 )
2 ON = ton ( in : 0.4 )
4 OFF = tof ( in : 0.4 )
6 P = tp ( in : 0.4 )
8 D = timer ( in : delay, 0.4 )
10 H = timer ( in : hold, 0.4 )
12 U = timer ( in : pulse, 0.4 )
END
""", {"ON": TON_Q, "ON.et": TON_T, "OFF": TOF_Q, "OFF.et": TOF_T, "P": TP_Q, "P.et": TP_T,
      "D": TON_Q, "D.et": TON_T, "H": TOF_Q, "H.et": TOF_T, "U": TP_Q, "U.et": TP_T},
      times=("ON.et", "OFF.et", "P.et", "D.et", "H.et", "U.et"))

def retuned():
    """pt in periods for each scan: 4, 6 when the first have ended, 2 while the next run, 6, and 0."""
    inputs = row(" . 1 1 1 1 1 1 1 1 . 1 1 1 1 1 . . . . . . . . 1 1 . .")
    pt = row("     4 4 4 4 4 4 4 6 6 6 6 6 6 2 2 6 6 6 6 6 6 6 6 0 0 0 0")
    expected = {
        "ON": "    . . . . . 1 1 1 1 . . . . 1 1 . . . . . . . . 1 1 . .",
        "ON.et": " . . 1 2 3 4 4 4 4 . . 1 2 2 2 . . . . . . . . . . . .",
        "OFF": "   . 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 . . 1 1 . .",
        "OFF.et": ". . . . . . . . . . . . . . . . 1 2 3 4 5 6 6 . . . .",
        "P": "     . 1 1 1 1 . . . . . 1 1 1 . . . . . . . . . . . . . .",
        "P.et": "  . . 1 2 3 4 4 4 4 . . 1 2 2 2 . . . . . . . . . . . .",
    }
    rows = [row(text) for text in expected.values()]
    assert all(len(cells) == len(inputs) == len(pt) for cells in rows)
    scale = [PERIOD if name.endswith(".et") else 1 for name in expected]
    program = """
! Timers whose time changes after they have ended and while they run, down to 0.
CONTROL
1 in = msi ( : 0 )
2 ON = ton ( in : 0.4 )
4 OFF = tof ( in : 0.4 )
6 P = tp ( in : 0.4 )
END
"""
    stimulus = [[k, inputs[k]] + 3 * [pt[k] * PERIOD] for k in range(len(inputs))]
    trace = [[k] + [cells[k] * factor for cells, factor in zip(rows, scale)] for k in range(len(inputs))]
    golden.write("logic_timers_retuned", program, (["in.value", "ON.pt", "OFF.pt", "P.pt"], stimulus),
                 (list(expected), trace), "tables; a time is shown as seconds", period=PERIOD)


retuned()

# Edges, latches, counters.
table("logic_counters", "Edges, latches and counters.", {
    "a.value": "1 1 . 1 . . 1 1 . 1 . 1 . . 1 . 1 . 1 .",
    "b.value": ". . 1 1 . 1 . . . 1 . 1 1 . . . 1 . . .",
    "c.value": ". . . . . . . 1 . . . . . . . 1 1 . . .",
}, """
CONTROL
1 a = msi ( : 0 )
2 b = msi ( : 0 )
3 c = msi ( : 0 )
4 two = msi ( : 2 )
5 up = rtrig ( a : )
6 once = rtrig ( a : yes )
7 down = ftrig ( a : )
8 s = sr ( a, b : )
9 r = rs ( a, b : )
10 U = ctu ( a, c, two : )
12 D = ctd ( b, c, two : )
14 B = ctud ( a, b, , c, two : )
17 t = trip ( c, a, b : )
18 m = rcm ( a, b, c, c : )
19 S = shreg ( b, a, 3, r = c : )
END
""", {
    "up": "     . . . 1 . . 1 . . 1 . 1 . . 1 . 1 . 1 .",
    "once": "   1 . . 1 . . 1 . . 1 . 1 . . 1 . 1 . 1 .",
    "down": "   . . 1 . 1 . . . 1 . 1 . 1 . . 1 . 1 . 1",
    "s": "      1 1 . 1 1 . 1 1 1 1 1 1 . . 1 1 1 1 1 1",
    "r": "      1 1 . . . . 1 1 1 . . . . . 1 1 . . 1 1",
    "U.cv": "   . . . 1 1 1 2 . . 1 1 2 2 2 3 . . . 1 1",
    "U": "      . . . . . . 1 . . . . 1 1 1 1 . . . . .",
    "D.cv": "   . . -1 -1 -1 -2 -2 2 2 1 1 . . . . 2 2 2 2 2",
    "D": "      1 1 1 1 1 1 1 . . . . 1 1 1 1 . . . . .",
    "B.cv": "   . . -1 . . -1 . 2 2 2 2 2 2 2 3 2 2 2 3 3",
    "B": "      . . . . . . . 1 1 1 1 1 1 1 1 1 1 1 1 1",
    "B.qd": "   1 1 1 1 1 1 1 . . . . . . . . . . . . .",
    "t": "      . . . . . . . 1 1 . . . . . . 1 1 1 1 1",
    "m": "      . . . 1 1 . 1 1 1 . . . . . 1 1 1 1 1 1",
    "S": "      . . . . . . . . . . . . . . 1 . . . . .",
    "S.y[1]":  ". . . 1 1 1 . . . 1 1 1 1 1 . . . . . .",
    "S.y[2]":  ". . . . . . 1 . . . . 1 1 1 1 . . . . .",
})

# A blinker whose times are no whole number of periods (1.5 on, 1 off), running time, gates.
table("logic_running", "Blinker, running time, gates.", {
    "a.value": ". 1 1 1 1 1 1 1 1 1 1 1 . . 1 1",
    "b.value": ". . . . . 1 1 . . 1 . . . 1 . .",
    "c.value": "1 . 1 . 1 . 1 . 1 . 1 . 1 . 1 .",
}, """
CONTROL
1 a = msi ( : 0 )
2 b = msi ( : 0 )
3 c = msi ( : 0 )
4 l = blink ( a : 0.15, 0.1 )
5 E = etimer ( a, b : 0.4 )
7 n = not ( a : )
8 d = and ( a, b, c : )
9 o = or ( b, c : )
10 x = xor ( a, b, c : )
11 m = qor ( a, b, c, 3 : 2, )
12 e = qor ( a, b, c, 3 : 2, yes )
END
""", {
    "l": "  . 1 1 . 1 . 1 1 . 1 . 1 . . 1 1",
    "E": "  . 1 2 3 4 . . 1 2 . 1 2 2 . 1 2",
    "E.q": ". . . . 1 . . . . . . . . . . .",
    "n": "  1 . . . . . . . . . . . 1 1 . .",
    "d": "  . . . . . . 1 . . . . . . . . .",
    "o": "  1 . 1 . 1 1 1 . 1 1 1 . 1 1 1 .",
    "x": "  1 1 . 1 . . 1 1 . . . 1 1 1 . 1",
    "m": "  . . 1 . 1 1 1 . 1 1 1 . . . 1 .",
    "e": "  . . 1 . 1 1 . . 1 1 1 . . . 1 .",
}, times=("E",))

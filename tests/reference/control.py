"""Golden cases of the blocks between controller and valve: plain re-implementations from the declarations' text.

The stimuli are random but repeatable: inputs of few binary digits, bad ones among them, modes, return wires in all
states, and inputs that come to what was asked for, which is known here because the blocks are computed on the way.
"""
import math
import random

import golden
import gpc

T = 0.25
NAN = math.nan
PATIENCE = 1000
FOLLOWING, HIGH, LOW, WAITING = 0, 1, 2, 3
MAN, AUTO, CAS, TRACK, INIT = 0, 1, 2, 3, 4


def good(x):
    return math.isfinite(x)


def clamp(x, lo, hi):
    return min(max(x, lo), hi)


def come(x, asked):
    return good(x) and abs(x - asked) <= 1e-5 * abs(asked) + 1024.0 * 2.0**-52


def told(back):
    return int(back[1]) if good(back[0]) and back[1] in (1, 2, 3) else FOLLOWING


def mirrored(state):
    return {HIGH: LOW, LOW: HIGH}.get(state, state)


def toward(y, x, step):
    return x if abs(x - y) <= step else y + math.copysign(step, x - y)


def beyond(x, y):
    return HIGH if x > y else LOW if x < y else FOLLOWING


class Patience:
    """After a scan without following, 15 more at most until the driver has come; nothing where nobody reads bk."""

    def __init__(self, heard):
        self.heard, self.left = heard, 0

    def wait(self, now, x, asked):
        if now or not self.heard:
            self.left = PATIENCE
            return now
        if self.left:
            self.left = 0 if come(x, asked) else self.left - 1
        return self.left > 0


class Shed:
    def __init__(self, tbad):
        self.scans, self.bad = math.ceil(tbad / T), 0

    def over(self, bad):
        self.bad = self.bad + 1 if bad else 0
        return bad and self.bad > self.scans


class Station:
    """ma, and casc with its own idea of what a mode means."""

    def __init__(self, heard, lo, hi, rate, tbad, cascade=False, sptrack=False):
        self.lo, self.hi, self.step = lo, hi, rate * T if rate else math.inf
        self.cascade, self.sptrack = cascade, sptrack
        self.patience, self.shed, self.first = Patience(heard), Shed(tbad), True
        self.out, self.actual, self.bk = 0.0, 0, (0.0, 0)

    def obey(self, wanted):
        if good(wanted):
            self.out = clamp(wanted, self.lo, self.hi)

    def scan(self, x, mode, manual, back, trk=0, utr=0.0, y=0.0):
        state = told(back)
        tracks = trk != 0 and not self.cascade
        local = mode in (MAN, AUTO) if self.cascade else mode == MAN
        free = state != WAITING and not tracks and not local
        over = self.shed.over(free and not good(x))
        if state == WAITING:
            self.out, self.actual = back[0], INIT
        elif tracks:
            self.actual = TRACK
            self.obey(utr)
        elif local:
            self.actual = mode
            self.obey(y if self.cascade and self.sptrack and mode == MAN else manual)
        elif over:
            self.actual = AUTO if self.cascade else MAN
            self.obey(manual)
        else:
            self.actual = CAS if self.cascade or mode == CAS else AUTO
        free = free and good(x)
        if self.patience.wait(not free, x, self.out):
            self.actual = INIT if free else self.actual
            self.bk = (self.out, WAITING)
        else:
            self.out = toward(self.out, clamp(x, self.lo, self.hi), math.inf if self.first else self.step)
            own = beyond(x, self.out)
            self.bk = (back[0] if state else self.out, own or state)
        self.first = False


class Ratio:
    def __init__(self, heard, kmin, kmax, lo, hi, rate, tbad):
        self.kmin, self.kmax, self.lo, self.hi = kmin, kmax, lo, hi
        self.step = rate * T if rate else math.inf
        self.patience, self.shed, self.first, self.ran = Patience(heard), Shed(tbad), True, False
        self.w, self.k, self.actual, self.bk = 0.0, 0.0, 0, (0.0, 0)

    def measure(self, wild):
        if good(wild) and abs(wild) >= 1e-12:
            self.k = clamp(self.w / wild, self.kmin, self.kmax)

    def scan(self, wild, mode, km, wm, kr, back):
        state = told(back)
        wants = state != WAITING and mode != MAN
        runs = wants and good(wild)
        remote = runs and mode == CAS
        lost = remote and not good(kr)
        over = self.shed.over(wants and (not runs or lost))
        self.actual = CAS if mode == CAS else AUTO
        if state == WAITING:
            self.w, self.actual = back[0], INIT
        elif mode == MAN or (over and not runs):
            self.w, self.actual = clamp(wm, self.lo, self.hi), MAN
        elif over:
            self.actual = AUTO
        if not runs:
            self.measure(wild)
        elif not self.ran and not self.first:
            self.measure(wild)
        elif not remote or over or self.first:
            self.k = clamp(km, self.kmin, self.kmax)
        waits = self.patience.wait(not remote or lost, kr, self.k)
        wanted = self.k if waits else kr
        self.k = clamp(wanted, self.kmin, self.kmax)
        if runs:
            target = self.k * wild
            self.w = toward(self.w, clamp(target, self.lo, self.hi), math.inf if self.first else self.step)
            own = beyond(wanted, self.k)
            tells = abs(wild) >= 1e-12
            if tells and not own:
                own = beyond(target, self.w) if wild > 0 else mirrored(beyond(target, self.w))
        if waits:
            self.actual = INIT if remote and not lost else self.actual
            self.bk = (self.k, WAITING)
        else:
            down = state if tells else FOLLOWING
            value = back[0] / wild if down else self.k
            self.bk = (value, own or (mirrored(down) if wild < 0 else down))
        self.ran, self.first = runs, False


class Generator:
    def __init__(self, heard, lo, hi, up, dn):
        self.lo, self.hi, self.up, self.dn = lo, hi, up * T, dn * T
        self.patience, self.first = Patience(heard), True
        self.v, self.target, self.bk = 0.0, 0.0, (0.0, 0)

    def take(self, v):
        self.v = self.target = v
        self.first = False

    def scan(self, w, trk, y, back):
        state = told(back)
        if state == WAITING:
            self.take(back[0])
        elif (trk or (self.first and not good(w))) and good(y):
            self.take(clamp(y, self.lo, self.hi))
        if self.patience.wait(state == WAITING or trk != 0 or not good(w), w, self.v):
            self.bk = (self.v, WAITING)
            return
        self.target = clamp(w, self.lo, self.hi)
        self.v = self.target if self.first else clamp(self.target, self.v - self.dn, self.v + self.up)
        self.first = False
        own = beyond(w, self.v)
        self.bk = (back[0] if state else self.v, own or state)


class Balance:
    """What was missing goes to 0 at an even rate."""

    def __init__(self, time):
        self.time, self.value, self.step = time, 0.0, 0.0

    def pass_scan(self):
        self.value = toward(self.value, 0.0, self.step)

    def take(self, more):
        self.value += more
        self.step = abs(self.value) * T / self.time


class Forward:
    """ffsum."""

    def __init__(self, heard, k, bias, tb):
        self.k, self.bias = k, bias
        self.patience, self.balance, self.stood = Patience(heard), Balance(tb), False
        self.first, self.ff, self.was_bad, self.law = True, None, False, (0.0, 0.0)
        self.y, self.bk = 0.0, (0.0, 0)

    def forward(self, ff, on):
        known = self.ff is not None
        last = self.ff
        if good(ff):
            self.ff = ff
        law = (self.k, self.bias) if on and self.ff is not None else (0.0, 0.0)
        now = self.ff if self.ff is not None else 0.0
        before = last if known and self.was_bad and good(ff) else now
        old = self.law[0] * before + self.law[1]
        new = law[0] * now + law[1]
        if not self.first and (law != self.law or before != now):
            self.balance.take(old - new)
        self.was_bad, self.law, self.first = not good(ff), law, False
        return new

    def scan(self, u, ff, on, back):
        state = told(back)
        self.balance.pass_scan()
        extra = self.forward(ff, on)
        if state == WAITING:
            self.y, self.balance.value = back[0], 0.0
        asked = self.y - extra - self.balance.value
        if self.patience.wait(state == WAITING or not good(u), u, asked):
            self.stood, self.bk = True, (asked, WAITING)
            return
        if self.stood:
            self.balance.take(self.y - u - extra - self.balance.value)
            self.stood = False
        self.y = u + extra + self.balance.value
        self.bk = ((back[0] if state else self.y) - extra - self.balance.value, state)


class BiasGain:
    def __init__(self, heard, bias, balt, gain, lo, hi):
        self.bias, self.gain, self.lo, self.hi = bias, gain, lo, hi
        self.patience, self.balance, self.stood = Patience(heard), Balance(balt), False
        self.first, self.law = True, None
        self.y, self.actual, self.bk = 0.0, 0, (0.0, 0)

    def scan(self, x, mode, um, back):
        state = told(back)
        stands = state == WAITING or mode == MAN or not good(x)
        self.balance.pass_scan()
        self.actual = CAS if mode == CAS else AUTO
        if state == WAITING:
            self.y, self.actual = back[0], INIT
        elif mode == MAN:
            self.y, self.actual = clamp(um, self.lo, self.hi), MAN
        if stands:
            self.balance.value, self.stood = 0.0, not self.first

        def inverse(y):
            return (y - self.bias - self.balance.value) / self.gain

        waits = self.patience.wait(stands, x, inverse(self.y))
        own = FOLLOWING
        if waits:
            self.actual = self.actual if stands else INIT
        else:
            line = self.gain * x + self.bias
            if self.stood:
                self.balance.take(self.y - line - self.balance.value)
            elif self.law not in (None, (self.gain, self.bias)):
                self.balance.take(self.law[0] * x + self.law[1] - line)
            self.y = clamp(line + self.balance.value, self.lo, self.hi)
            self.stood, own = False, beyond(line + self.balance.value, self.y)
        final = WAITING if waits else own or state
        value = back[0] if state and not waits else self.y
        self.bk = (inverse(value), mirrored(final) if self.gain < 0 else final)
        self.law, self.first = (self.gain, self.bias), False


class Override:
    def __init__(self, n, high):
        self.n, self.high, self.patience = n, high, Patience(True)
        self.u, self.idx, self.bk = 0.0, 0, [(0.0, 0)] * n

    def scan(self, x, back):
        state = told(back)
        candidates = [i for i in range(self.n) if good(x[i])]
        best = (max if self.high else min)(candidates, key=lambda i: x[i]) if candidates else None
        if state == WAITING:
            self.u = back[0]
        if best is not None:
            self.idx = best + 1
        picked = self.u if best is None else x[best]
        if self.patience.wait(best is None or state == WAITING, picked, self.u):
            self.bk = [(self.u, WAITING)] * self.n
            return
        self.u = picked
        value = back[0] if state else picked
        self.bk = [(value, state if i == best else LOW if self.high else HIGH) for i in range(self.n)]


class OnOff:
    def __init__(self, h, ton, toff, onbad):
        self.h, self.least, self.onbad = h, {1: round(ton / T), 0: round(toff / T)}, onbad
        self.q, self.scans = 0, math.inf

    def scan(self, w, y):
        if not good(w) or not good(y):
            q = self.q if self.onbad is None else self.onbad
        elif self.scans >= self.least[self.q]:
            q = 1 if w - y >= self.h else 0 if w - y <= -self.h else self.q
        else:
            q = self.q
        self.scans = 1 if q != self.q or self.scans == math.inf else self.scans + 1
        self.q = q


class Pwm:
    """In scans."""

    def __init__(self, tper, tmin, lo, hi):
        self.cycle, self.tmin, self.lo, self.hi = tper / T, tmin / T, lo, hi
        self.passed, self.given, self.wanted, self.duty, self.q = None, 0, 0.0, 0.0, 0

    def scan(self, u):
        if good(u):
            self.duty = clamp((u - self.lo) / (self.hi - self.lo), 0.0, 1.0)
        if self.passed is None or self.passed >= self.cycle:
            carried = 0.0 if self.passed is None else clamp(self.wanted - self.given, -self.cycle, self.cycle)
            self.passed = 0.0 if self.passed is None else self.passed - self.cycle
            self.wanted, self.given = self.duty * self.cycle + carried, 0
        aim = self.wanted
        if aim < self.tmin:
            aim = 0.0
        elif self.cycle - aim < self.tmin:
            aim = self.cycle
        self.q = int(aim >= self.cycle or self.given + 0.5 < aim)
        self.given += self.q
        self.passed += 1


class Three:
    """Positions in scans of the stroke."""

    def __init__(self, heard, tstroke, tmin, db):
        self.stroke, self.tmin, self.db = tstroke / T, tmin / T, db / 100 * tstroke / T
        self.at, self.drive, self.pulse, self.seated = None, 0, 0, 0
        self.pos, self.bk, self.patience = 0.0, (0.0, 0), Patience(heard)

    def scan(self, u, fb):
        first = self.at is None
        place = clamp(u, 0.0, 100.0) / 100 * self.stroke if good(u) else 0.0
        if good(fb):
            self.at = clamp(fb, 0.0, 100.0) / 100 * self.stroke
        elif first:
            self.at = place
        else:
            self.at = clamp(self.at + self.drive, 0.0, self.stroke)
        self.pos = fb if good(fb) else self.at / self.stroke * 100
        if self.patience.wait(not good(u) or (self.patience.heard and good(fb) and first), u, self.pos):
            self.drive, self.bk = 0, (self.pos, WAITING)
            return
        way, before = place - self.at, self.drive
        at_end = {0.0: -1, self.stroke: 1}.get(place, 0)
        if not good(fb) and (not at_end or way):
            self.seated = 0
        if not good(fb) and at_end and not way and self.seated < math.floor(self.stroke / 10):
            self.seated += 1
            self.drive = at_end
        elif self.drive:
            runs_on = self.pulse < self.tmin or way * self.drive > 0.5
            self.drive = self.drive if runs_on else 0
        elif abs(way) > max(self.db, 0.5) and abs(way) >= self.tmin:
            self.drive = 1 if way > 0 else -1
        self.pulse = self.pulse + 1 if self.drive and self.drive == before else 1
        self.bk = (clamp(u, 0.0, 100.0), HIGH if u > 100 else LOW if u < 0 else FOLLOWING)


class Predictive(gpc.Gpc):
    """gpc* with its return wires; rises: a larger set-point asks for a larger u."""

    def __init__(self, rises, *sizes):
        super().__init__(*sizes)
        self.rises, self.patience, self.asked, self.bk = rises, Patience(True), 0.0, (0.0, 0)

    def ask(self, w):
        if self.y is None:
            self.bk = (w, FOLLOWING)
        else:
            self.asked = self.y[0]
            self.patience.wait(True, w, self.asked)
            self.bk = (self.asked, WAITING)

    def answer(self, w, y, p, sw, u0, umin, umax, lam, back):
        state = told(back)
        if state == WAITING:
            if good(y):
                self.y = [y] + (self.y[:-1] if self.y else [y] * self.na)
            else:
                self.y = self.y and [self.y[0]] + self.y[:-1]
            self.u, self.du = back[0], 0 * self.du
            return self.ask(w)
        if sw or not good(w) or not good(y):
            self.scan(w, y, p, sw, u0, umin, umax, lam)
            return self.ask(w)
        waits = self.patience.wait(False, w, self.asked)
        w = self.asked if waits else w
        if (state == HIGH and back[0] < self.u) or (state == LOW and back[0] > self.u):
            self.du[0] += back[0] - self.u
            self.u = back[0]
        past = ([y] + self.y[:-1] if self.y else None, self.u)
        self.y = self.y or [y] * (self.na + 1)
        wanted = past[1] + self.first_move(w, y, p, lam)
        self.scan(w, y, p, 0.0, u0, umin, umax, lam)
        own = beyond(wanted, self.u)
        final = own or state
        self.bk = (w, WAITING if waits else final if self.rises else mirrored(final))


class Digital:
    """gdc."""

    def __init__(self, a, b, d, lo, hi):
        self.a, self.b, self.d, self.lo, self.hi = a, b, d, lo, hi
        self.e = None
        self.past, self.ff, self.y, self.asked = [0.0] * len(a), 0.0, 0.0, 0.0
        self.u, self.actual, self.bk, self.patience = 0.0, 0, (0.0, 0), Patience(True)

    def place(self, u):
        self.u, self.past = u, [u - self.ff] * len(self.a)

    def scan(self, y, w, trk, rel, ff, back):
        state, seen = told(back), good(w) and good(y)
        self.ff = ff if good(ff) else self.ff
        free = rel != 0 and state != WAITING
        if seen and self.e is None:
            self.e = [w - y] * (len(self.b) + self.d)
            self.place(clamp(trk if good(trk) else self.lo, self.lo, self.hi))
        self.y = y if seen else self.y
        waits = self.patience.wait(not seen or not free, w, self.asked)
        if seen:
            w = self.asked if waits and free else w
            self.e = [w - y] + self.e[:-1]
        if state == WAITING:
            self.place(back[0])
            self.actual = INIT
        elif not rel:
            self.place(clamp(trk, self.lo, self.hi) if good(trk) else self.u)
            self.actual = TRACK
        if not seen or not free:
            self.asked = self.y
            self.bk = (w, FOLLOWING) if self.e is None else (self.y, WAITING)
            self.patience.left = 0 if self.e is None else PATIENCE
            return
        self.actual = AUTO
        if (state == HIGH and back[0] < self.u) or (state == LOW and back[0] > self.u):
            self.past[0] += back[0] - self.u
        v = sum(b * e for b, e in zip(self.b, self.e[self.d:])) - sum(a * u for a, u in zip(self.a, self.past)) + self.ff
        self.u = clamp(v, self.lo, self.hi)
        self.past = [self.u - self.ff] + self.past[:-1]
        final = beyond(v, self.u) or state
        self.bk = (w, WAITING if waits else final if sum(self.b) > 0 else mirrored(final))


class Chance:
    """Repeatable choices; numbers are multiples of 1/8, the same in both widths."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def often(self, part):
        return self.random.random() < part

    def number(self, lo, hi):
        return self.random.randint(int(lo * 8), int(hi * 8)) / 8

    def one(self, *choices):
        return self.random.choice(choices)

    def walk(self, x, lo, hi, bad=0.04):
        """A new value, mostly near the old one; seldom a bad one."""
        if self.often(bad):
            return NAN
        if not good(x) or self.often(0.1):
            return self.number(lo, hi)
        return clamp(x + self.number(-2, 2), lo, hi) if self.often(0.5) else x

    def back(self, was, lo, hi):
        """A return wire: mostly as it was."""
        if self.often(0.85):
            return was
        return (self.number(lo, hi), self.one(0, 0, 0, 1, 2, 3))


WIRE = """
INITIALIZE
1 back = setvec ( 2 : 0., 0. )
CONTROL
2 v = ain ( : 0, 9, 1 )
3 s = ain ( : 0, 9, 2 )
4 back = ftov ( 2, v, 1 : )
5 back = ftov ( 2, s, 2 : )
"""
WIRE_INPUTS = ["ain(0,9,1)", "ain(0,9,2)"]


def pair(name):
    return [f"{name}[1]", f"{name}[2]"]


def stations():
    chance, rows, trace = Chance(1), [], []
    a = Station(True, 0.0, 50.0, 4.0, 1.0)
    b = Station(False, 0.0, 50.0, 0.0, 0.0)
    c = Station(True, 10.0, 80.0, 8.0, 0.5, cascade=True, sptrack=True)
    x, y, back, um = 20.0, 30.0, (0.0, 0), {"a": 0.0, "b": 0.0, "c": 0.0}
    modes, trk, utr = {"a": AUTO, "b": AUTO, "c": CAS}, 0, 5.0
    for k in range(600):
        x, y, utr = chance.walk(x, -10, 90), chance.walk(y, 0, 100), chance.walk(utr, -5, 60)
        back = chance.back(back, 0, 60)
        asked = chance.one(a.out, b.out, c.out)
        x = asked if chance.often(0.15) else x
        row = {}
        for name in modes:
            if chance.often(0.06):
                row[name + ".mode"] = modes[name] = chance.one(MAN, AUTO, CAS)
            if chance.often(0.08):
                row[name + (".wm" if name == "c" else ".um")] = um[name] = chance.number(-10, 100)
        trk = chance.one(0, 1) if chance.often(0.04) else trk
        a.scan(x, modes["a"], um["a"], back, trk, utr)
        b.scan(x, modes["b"], um["b"], back)
        c.scan(x, modes["c"], um["c"], back, y=y)
        um = {"a": a.out, "b": b.out, "c": c.out}
        names = ["a.mode", "a.um", "b.mode", "b.um", "c.mode", "c.wm"]
        rows.append([k, x, y, utr, trk, *back] + [row.get(name) for name in names])
        trace.append([k, a.out, a.actual, *a.bk, b.out, b.actual, c.out, c.actual, *c.bk])
    program = "! Stations in all modes, against a return wire in all states; b has no listener.\n" + WIRE.strip() + """
6 x = ain ( : 0, 1, 1 )
7 y = ain ( : 0, 1, 2 )
8 utr = ain ( : 0, 1, 3 )
9 trk = msi ( : 0 )
10 a, aact, abk = ma ( x, , , trk, utr, back : hi = 50., rate = 4., tbad = 1. )
11 b, bact = ma ( x, back = back : hi = 50. )
12 c, cact, cbk = casc ( x, y, back = back : lo = 10., hi = 80., rate = 8., sptrack = yes, tbad = 0.5 )
END
"""
    inputs = ["ain(0,1,1)", "ain(0,1,2)", "ain(0,1,3)", "trk.value"] + WIRE_INPUTS
    inputs += ["a.mode", "a.um", "b.mode", "b.um", "c.mode", "c.wm"]
    golden.write("control_stations", program, (inputs, rows),
                 (["a", "aact", *pair("abk"), "b", "bact", "c", "cact", *pair("cbk")], trace),
                 "the order of sums", period=T, single=(1e-5, "float: the order of sums"))


def ratio():
    chance, rows, trace = Chance(2), [], []
    a = Ratio(True, 0.5, 4.0, 0.0, 100.0, 0.0, 1.0)
    b = Ratio(False, 0.0, 10.0, 0.0, 60.0, 8.0, 0.0)
    wild, kr, back = 20.0, 2.0, (0.0, 0)
    cells = {"a": [1.0, 0.0], "b": [1.0, 0.0]}
    modes = {"a": AUTO, "b": CAS}
    for k in range(600):
        wild = chance.one(0.0, -8.0) if chance.often(0.02) else chance.walk(wild, 1, 40)
        kr = a.k if chance.often(0.3) else chance.walk(kr, 0, 6)
        back = chance.back(back, 4, 60)
        row = {}
        for name in modes:
            if chance.often(0.06):
                row[name + ".mode"] = modes[name] = chance.one(MAN, AUTO, CAS)
            if chance.often(0.06):
                row[name + ".km"] = cells[name][0] = chance.number(0, 6)
            if chance.often(0.06):
                row[name + ".wm"] = cells[name][1] = chance.number(0, 80)
        a.scan(wild, modes["a"], *cells["a"], kr, back)
        b.scan(wild, modes["b"], *cells["b"], kr, back)
        cells = {"a": [a.k, a.w], "b": [b.k, b.w]}
        names = [f"{n}.{cell}" for n in "ab" for cell in ("mode", "km", "wm")]
        rows.append([k, wild, kr, *back] + [row.get(name) for name in names])
        trace.append([k, a.w, a.k, a.actual, *a.bk, b.w, b.k, b.actual])
    program = "! Ratio stations: entry with the ratio that there is, wild flows of 0 and below, lost signals.\n" + WIRE.strip() + """
6 wild = ain ( : 0, 1, 1 )
7 kr = ain ( : 0, 1, 2 )
8 a, ak, aact, abk = rat ( wild, kr = kr, back = back : kmin = 0.5, kmax = 4., tbad = 1. )
9 cas = msi ( : 2 )
10 b, bk, bact = rat ( wild, kr = kr, back = back : hi = 60., rate = 8. )
END
"""
    inputs = ["ain(0,1,1)", "ain(0,1,2)"] + WIRE_INPUTS + [f"{n}.{cell}" for n in "ab" for cell in ("mode", "km", "wm")]
    rows[0][inputs.index("b.mode") + 1] = rows[0][inputs.index("b.mode") + 1] or CAS
    golden.write("control_ratio", program.replace("9 cas = msi ( : 2 )\n", ""), (inputs, rows),
                 (["a", "ak", "aact", *pair("abk"), "b", "bk", "bact"], trace),
                 "the order of sums", period=T, single=(1e-4, "a quotient of floats and its product again"))


def sums():
    chance, rows, trace = Chance(3), [], []
    f, g = Forward(True, 0.5, -4.0, 5.0), Forward(False, -1.5, 0.0, 2.0)
    h, i = BiasGain(True, 5.0, 4.0, 0.5, 0.0, 100.0), BiasGain(False, 90.0, 3.0, -1.0, 0.0, 100.0)
    p = Generator(True, 0.0, 70.0, 4.0, 8.0)
    q_cell, q = NAN, Generator(False, 0.0, 90.0, 2.0, 2.0)
    u, ff, y, back, on, trk = 20.0, 8.0, 40.0, (0.0, 0), 1, 0
    ums, modes, kf = {"h": 0.0, "i": 0.0}, {"h": AUTO, "i": AUTO}, 0.5
    for k in range(600):
        u, ff, y = chance.walk(u, 0, 80), chance.walk(ff, 0, 20), chance.walk(y, 0, 100)
        back = chance.back(back, 0, 60)
        if chance.often(0.2):
            u = chance.one(f.bk[0], h.bk[0], p.v)
        row = {}
        on = 1 - on if chance.often(0.05) else on
        trk = 1 - trk if chance.often(0.04) else trk
        if chance.often(0.03):
            row["f.k"] = f.k = chance.number(-1, 1)
        if chance.often(0.03):
            row["h.bias"] = h.bias = chance.number(0, 20)
        if chance.often(0.05):
            row["q.w"] = q_cell = chance.number(0, 100)
        for name in modes:
            if chance.often(0.06):
                row[name + ".mode"] = modes[name] = chance.one(MAN, AUTO, CAS)
            if chance.often(0.06):
                row[name + ".um"] = ums[name] = chance.number(-10, 110)
        f.scan(u, ff, on, back)
        g.scan(u, ff, on, back)
        h.scan(u, modes["h"], ums["h"], back)
        i.scan(u, modes["i"], ums["i"], back)
        p.scan(u, trk, y, back)
        q.scan(q_cell, trk, y, (0.0, 0))
        q_cell, ums = q.target, {"h": h.y, "i": i.y}
        names = ["f.k", "h.bias", "q.w", "h.mode", "h.um", "i.mode", "i.um"]
        rows.append([k, u, ff, y, on, trk, *back] + [row.get(name) for name in names])
        trace.append([k, f.y, *f.bk, g.y, h.y, h.actual, *h.bk, i.y, i.actual, p.v, *p.bk, q.v])
    program = "! What stands between controllers: feed-forward, bias and gain, set-points. g, i and q have no listener.\n" + WIRE.strip() + """
6 u = ain ( : 0, 1, 1 )
7 ff = ain ( : 0, 1, 2 )
8 y = ain ( : 0, 1, 3 )
9 on = msi ( : 1 )
10 trk = msi ( : 0 )
11 f, fbk = ffsum ( u, ff, on, back : k = 0.5, bias = -4., tb = 5. )
12 g = ffsum ( u, ff, on, back : k = -1.5, tb = 2. )
13 h, hact, hbk = bgs ( u, back = back : bias = 5., balt = 4., gain = 0.5 )
14 i, iact = bgs ( u, back = back : bias = 90., balt = 3., gain = -1. )
15 p, pbk = spgen ( u, trk, y, back : hi = 70., up = 4., dn = 8. )
16 q = spgen ( , trk, y : hi = 90., up = 2., dn = 2. )
END
"""
    inputs = ["ain(0,1,1)", "ain(0,1,2)", "ain(0,1,3)", "on.value", "trk.value"] + WIRE_INPUTS
    inputs += ["f.k", "h.bias", "q.w", "h.mode", "h.um", "i.mode", "i.um"]
    columns = ["f", *pair("fbk"), "g", "h", "hact", *pair("hbk"), "i", "iact", "p", *pair("pbk"), "q"]
    golden.write("control_sums", program, (inputs, rows), (columns, trace),
                 "the order of sums", period=T, single=(1e-4, "the balance in many steps of a float"))


def override():
    chance, rows, trace = Chance(4), [], []
    low, high = Override(3, False), Override(2, True)
    x, back = [20.0, 30.0, 40.0], (0.0, 0)
    for k in range(400):
        x = [chance.walk(value, 0, 80, 0.1) for value in x]
        back = chance.back(back, 0, 60)
        if chance.often(0.2):
            x = [low.u] * 3
        low.scan(x, back)
        high.scan(x[:2], back)
        rows.append([k, *x, *back])
        flat = [part for bk in low.bk + high.bk for part in bk]
        trace.append([k, low.u, low.idx, high.u, high.idx, *flat])
    program = "! Override selectors with bad inputs, against a return wire in all states.\n" + WIRE.strip() + """
6 a = ain ( : 0, 1, 1 )
7 b = ain ( : 0, 1, 2 )
8 c = ain ( : 0, 1, 3 )
9 l, lidx, l1, l2, l3 = ovr ( a, b, c, 3, back = back : )
10 h, hidx, h1, h2 = ovr ( a, b, 2, back = back : high )
END
"""
    columns = ["l", "lidx", "h", "hidx"]
    columns += [name for wire in ("l1", "l2", "l3", "h1", "h2") for name in pair(wire)]
    golden.write("control_override", program, (["ain(0,1,1)", "ain(0,1,2)", "ain(0,1,3)"] + WIRE_INPUTS, rows),
                 (columns, trace), "a selection adds nothing", relative=0, absolute=0, period=T)


def switching():
    chance, rows, trace = Chance(5), [], []
    a, b = OnOff(2.0, 2.0, 3.0, 0), OnOff(1.0, 0.0, 0.0, None)
    p, q = Pwm(4.0, 0.0, 0.0, 100.0), Pwm(6.0, 1.0, 0.0, 64.0)
    t, e = Three(True, 32.0, 0.5, 2.0), Three(False, 20.0, 1.0, 1.0)
    y, u, fb = 50.0, 40.0, 20.0
    for k in range(800):
        y, u = chance.walk(y, 40, 60), chance.walk(u, -10, 110, 0.02)
        fb = NAN if 300 <= k < 360 else clamp((20.0 if k == 300 or not good(fb) else fb) + 0.75 * t.drive, 0.0, 100.0)
        if k == 3:
            u = 20.0
        a.scan(50.0, y)
        b.scan(50.0, y)
        p.scan(u)
        q.scan(u)
        t.scan(u, fb)
        e.scan(u, NAN)
        rows.append([k, y, u, fb])
        trace.append([k, a.q, b.q, p.q, q.q, t.drive > 0, t.drive < 0, t.pos, *t.bk, e.drive > 0, e.drive < 0, e.pos])
    program = """
! Relays, time-proportional outputs and step controllers, with a measured position and without.
CONTROL
1 w = msc ( : 50. )
2 y = ain ( : 0, 1, 1 )
3 u = ain ( : 0, 1, 2 )
4 fb = ain ( : 0, 1, 3 )
5 a = onoff ( w, y : h = 2., ton = 2., toff = 3. )
6 b = onoff ( w, y : onbad = hold )
7 p = pwm ( u : tper = 4. )
8 q = pwm ( u : tper = 6., tmin = 1., hi = 64. )
9 tup, tdn, tpos, tbk = three ( u, fb : tstroke = 32., tmin = 0.5, db = 2. )
10 eup, edn, epos = three ( u : tstroke = 20., tmin = 1., db = 1. )
END
"""
    columns = ["a", "b", "p", "q", "tup", "tdn", "tpos", *pair("tbk"), "eup", "edn", "epos"]
    golden.write("control_switching", program, (["ain(0,1,1)", "ain(0,1,2)", "ain(0,1,3)"], rows), (columns, trace),
                 "percent of a stroke in nanoseconds", absolute=1e-6, period=T,
                 single=(1e-5, "percent of a stroke in floats"))


def prediction():
    chance, rows, trace = Chance(6), [], []
    up, down = [0.8, 0.4], [1.2, -0.4, -0.1, -0.05]
    a, b = Predictive(True, 1, 1, 2, 8, 1, 0.5), Predictive(False, 2, 2, 1, 9, 2, 0.0)
    w, y, sw, back = 1.0, 0.5, 0.0, (0.0, 0)
    for k in range(500):
        w = chance.one(a.asked, b.asked) if chance.often(0.2) else chance.walk(w, -3, 3, 0.02)
        y = chance.walk(y, -2, 2, 0.03)
        sw = chance.one(0.0, 1.0) if chance.often(0.05) else sw
        back = chance.back(back, -3, 3)
        a.answer(w, y, up, sw, 0.5, -4.0, 4.0, 0.1, back)
        b.answer(w, y, down, sw, 0.0, -6.0, 5.0, 0.3, back)
        rows.append([k, w, y, sw, *back])
        trace.append([k, a.u, *a.bk, b.u, *b.bk])
    program = "! Predictive controllers between a master and a return wire in all states; b has a negative gain.\n" + WIRE.strip() + """
6 w = ain ( : 0, 1, 1 )
7 y = ain ( : 0, 1, 2 )
8 sw = ain ( : 0, 1, 3 )
9 p = setvec ( 2 : 0.8, 0.4 )
10 q = setvec ( 4 : 1.2, -0.4, -0.1, -0.05 )
11 a, abk = gpc1 ( w, y, p, sw, 2, 8, 1, back : 0.5, -4., 4., 0.1 )
12 b, bbk = gpcn ( w, y, q, sw, 1, 3, 2, 9, 2, back : 0., -6., 5., 0.3 )
END
"""
    golden.write("control_prediction", program, (["ain(0,1,1)", "ain(0,1,2)", "ain(0,1,3)"] + WIRE_INPUTS, rows),
                 (["a", *pair("abk"), "b", *pair("bbk")], trace),
                 "numpy's solver and another order of the sums", period=T,
                 single=(1e-3, "the law's gain on the noise of a float signal"))


def digital():
    chance, rows, trace = Chance(7), [], []
    a = Digital([-1.5, 0.5], [2.0, -3.0, 1.25], 1, 0.0, 100.0)
    b = Digital([-1.0], [-0.5, 0.25], 0, -20.0, 80.0)
    w, y, trk, ff, rel, back = 50.0, 45.0, 20.0, 0.0, 1, (0.0, 0)
    for k in range(500):
        w = chance.one(a.asked, b.asked) if chance.often(0.2) else chance.walk(w, 40, 60, 0.02)
        y, trk, ff = chance.walk(y, 40, 60, 0.03), chance.walk(trk, -5, 90), chance.walk(ff, -4, 8)
        rel = 1 - rel if chance.often(0.05 if rel else 0.2) else rel
        back = chance.back(back, 0, 80)
        a.scan(y, w, trk, rel, ff, back)
        b.scan(y, w, trk, rel, 0.0, back)
        rows.append([k, w, y, trk, ff, rel, *back])
        trace.append([k, a.u, a.actual, *a.bk, b.u, b.actual, *b.bk])
    program = "! Digital controllers with an integrator, tracked and released, between a master and a return wire.\n"
    program += WIRE.strip() + """
6 w = ain ( : 0, 1, 1 )
7 y = ain ( : 0, 1, 2 )
8 trk = ain ( : 0, 1, 3 )
9 ff = ain ( : 0, 1, 4 )
10 rel = msi ( : 1 )
11 a, aact, abk = gdc ( y, w, trk, rel, ff, 2, 3, 1, back : -1.5, 0.5, 2., -3., 1.25, , )
12 b, bact, bbk = gdc ( y, w, trk, rel, , 1, 2, 0, back : -1., -0.5, 0.25, -20., 80. )
END
"""
    inputs = [f"ain(0,1,{i})" for i in (1, 2, 3, 4)] + ["rel.value"] + WIRE_INPUTS
    golden.write("control_digital", program, (inputs, rows),
                 (["a", "aact", *pair("abk"), "b", "bact", *pair("bbk")], trace),
                 "the order of sums", period=T, single=(1e-4, "an integrator of floats"))


if __name__ == "__main__":
    digital()
    prediction()
    stations()
    ratio()
    sums()
    override()
    switching()

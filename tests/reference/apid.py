"""Golden case of apid: scipy's filter, and the controller from its equations (Astrom, Hagglund, Advanced PID Control)."""
import math

import numpy as np
from scipy.signal import cont2discrete

import golden

PERIOD = 0.2


class Filter:
    """1/(1 + s Tf + (s Tf)^2/2) behind a hold, by scipy's matrix exponential."""

    def __init__(self, Tf, y):
        a = np.array([[0.0, 1.0], [-2.0 / Tf**2, -2.0 / Tf]])
        b = np.array([[0.0], [2.0 / Tf**2]])
        self.ad, self.bd, *_ = cont2discrete((a, b, np.eye(2), np.zeros((2, 1))), PERIOD)
        self.x = np.array([y, 0.0])

    def __call__(self, y):
        self.x = self.ad @ self.x + self.bd[:, 0] * y
        return self.x[0]


class Controller:
    def __init__(self, K=1.0, Ti=10.0, Td=0.0, N=8.0, b=1.0, c=0.0, umin=0.0, umax=100.0, Tf=0.0, du=0.0, Tt=0.0, bias=0.0,
                 gap=0.0, kgap=1.0, form="isa", sptrack=False, yspan=100.0, uspan=100.0, direct=False):
        K *= uspan / yspan
        if form == "series":
            K, Ti, Td = K * (1 + Td / Ti), Ti + Td, Ti * Td / (Ti + Td)
        self.sign = -1.0 if direct else 1.0
        self.P, rest = K, (1.0 if form == "parallel" else K)
        self.form, self.Ti, self.b, self.c = form, Ti, b, c
        self.I = rest * PERIOD / Ti if Ti else 0.0
        self.a = Td / (Td + N * PERIOD)
        self.D = rest * N * self.a
        self.track = min(1.0, PERIOD / (Tt or math.sqrt(Ti * Td) or Ti)) if Ti else 0.0
        self.low, self.high, self.rate = umin, umax, du * PERIOD or math.inf
        self.Tf, self.bias, self.gap, self.kgap, self.sptrack = Tf, 0.0 if Ti else bias, gap, kgap, sptrack
        self.u, self.w = min(max(0.0, umin), umax), None
        self.first = True

    def error(self, e):
        inside = max(-self.gap, min(self.gap, e))
        return e - inside + self.kgap * inside

    def proportional(self, w, y):
        return self.sign * self.P * (self.error(w - y) - (1.0 - self.b) * w)

    def scan(self, y, w, ff=0.0, trk=0, utr=0.0, inh=0, dnh=0):
        if self.first:
            self.filter = Filter(self.Tf, y) if self.Tf else (lambda y: y)
        y = self.filter(y)
        if self.sptrack and trk:
            w = y
        e = w - y
        p = self.proportional(w, y) + ff + self.bias
        if self.first or trk:
            plain = self.first and not self.Ti and not trk
            self.u = min(max(utr if trk else p if plain else self.u, self.low), self.high)
            self.i, self.d, self.first = 0.0 if plain else self.u - p, 0.0, False
        else:
            self.d = self.a * self.d + self.sign * self.D * (self.c * (w - self.w) - (y - self.y))
            v = p + self.i + self.d
            u = min(max(v, self.low), self.high)
            u = min(max(u, self.u - self.rate), self.u + self.rate)
            u = min(u, self.u) if inh else u
            u = max(u, self.u) if dnh else u
            if self.form == "erf":
                self.i += (1.0 - math.exp(-PERIOD / self.Ti)) * (u - ff - self.i)
            else:
                self.i += self.sign * self.I * self.error(e) + self.track * (u - v)
            self.u = u
        self.y, self.w = y, w
        return self.u, e


KINDS = {
    "filtered": dict(K=1.5, Ti=6.0, Td=1.5, Tf=0.8, b=0.6),
    "parallel": dict(K=0.8, Ti=5.0, Td=0.7, form="parallel", umin=-40.0),
    "series": dict(K=1.1, Ti=4.0, Td=1.0, form="series", umin=-40.0),
    "reset": dict(K=2.0, Ti=5.0, form="erf", umax=40.0, umin=-40.0),
    "slow": dict(K=3.0, Ti=8.0, du=2.0, umin=-40.0),
    "gapped": dict(K=2.0, Ti=8.0, gap=2.0, kgap=0.25, direct=True, umin=-40.0),
    "plain": dict(K=2.0, Ti=0.0, bias=30.0),
    "spans": dict(K=1.0, Ti=7.0, Tt=2.0, yspan=50.0, uspan=25.0, umax=20.0, sptrack=True),
}


def open_loop():
    steps = 300
    text = ("! The forms and options of apid in the open loop.\nCONTROL\n1 y = ain ( : 0, 1, 1 )\n2 w = ain ( : 0, 1, 2 )\n"
            "3 ff = ain ( : 0, 1, 3 )\n4 trk = msi ( : 0 )\n5 utr = ain ( : 0, 1, 4 )\n6 inh = msi ( : 0 )\n7 dnh = msi ( : 0 )\n")
    for i, (name, kind) in enumerate(KINDS.items()):
        given = ", ".join("act = direct" if key == "direct" else "sptrack = yes" if key == "sptrack" else f"{key} = {value}"
                          for key, value in kind.items())
        text += f"{i + 10} {name} = apid ( y, w, trk = trk, utr = utr, ff = ff, inh = inh, dnh = dnh : {given} )\n"
    text += "END\n"
    loops = {name: Controller(**kind) for name, kind in KINDS.items()}
    stimulus, trace = [], []
    for k in range(steps):
        y = round(30.0 + 5.0 * math.sin(0.07 * k) + 1.2 * math.sin(1.1 * k), 4)
        w = 33.0 if k < 90 else 27.0
        ff = 0.0 if k < 60 else 4.0
        trk, utr = int(120 <= k < 140), 18.5
        inh, dnh = int(200 <= k < 215), int(240 <= k < 250)
        stimulus.append([k, y, w, ff, trk, utr, inh, dnh])
        row = [k]
        for loop in loops.values():
            row += loop.scan(y, w, ff, trk, utr, inh, dnh)
        trace.append(row)
    header = ["ain(0,1,1)", "ain(0,1,2)", "ain(0,1,3)", "trk.value", "ain(0,1,4)", "inh.value", "dnh.value"]
    columns = [column for name in KINDS for column in (name, f"{name}.e")]
    golden.write("apid_open_loop", text, (header, stimulus), (columns, trace),
                 "scipy's matrix exponential against a closed form, sums in another order", relative=1e-10, absolute=1e-10,
                 period=PERIOD)


if __name__ == "__main__":
    open_loop()

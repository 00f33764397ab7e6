"""Golden cases of pid: an independent controller, written from the equations
(Astrom, Hagglund, Advanced PID Control, 2006); and the identity
sum(e) T = (Ti/K) du of a settled loop, which needs no controller at all.
"""
import math

import golden

AUTO, MAN = 1, 0


class Reference:
    """Position form with back-calculation; transfers recompute the integral part from the output."""

    def __init__(self, period, K=1.0, Ti=10.0, Td=0.0, N=8.0, b=1.0, c=0.0, umin=0.0, umax=100.0, direct=False, nbad=0, fail=None):
        self.T, self.limits, self.nbad, self.fail = period, (umin, umax), nbad, fail
        self.set(K, Ti, Td, N, b, c, direct)
        self.integral = self.derivative = 0.0
        self.u = min(max(0.0, umin), umax)
        self.past = None
        self.lost = 0
        self.bumpless = True

    def set(self, K, Ti, Td, N, b, c, direct):
        self.K, self.Ti, self.Td, self.N, self.b, self.c = (-K if direct else K), Ti, Td, N, b, c

    def proportional(self, w, y):
        return self.K * (self.b * w - y)

    def scan(self, y, w, mode=AUTO, um=None):
        low, high = self.limits
        if math.isnan(y):
            if self.lost >= self.nbad:
                self.bumpless = True
                if self.fail is not None and mode == AUTO:
                    self.u = min(max(self.fail, low), high)
            self.lost += 1
            if mode == MAN and um is not None:
                self.u = min(max(um, low), high)
            return self.u
        if self.lost and self.past:
            self.past = (y, self.past[1])
        self.lost = 0
        if mode == MAN or self.bumpless:
            self.u = min(max(self.u if um is None else um, low), high)
            self.integral, self.derivative = self.u - self.proportional(w, y), 0.0
            self.past, self.bumpless = (y, w), False
            return self.u
        y1, w1 = self.past
        filtered = self.Td / (self.Td + self.N * self.T)
        self.derivative = filtered * self.derivative + self.K * self.N * filtered * ((self.c * w - y) - (self.c * w1 - y1))
        v = self.proportional(w, y) + self.integral + self.derivative
        self.u = min(max(v, low), high)
        if self.Ti:
            tracking = math.sqrt(self.Ti * self.Td) or self.Ti
            self.integral += self.K * self.T / self.Ti * (w - y) + min(1.0, self.T / tracking) * (self.u - v)
        self.past = (y, w)
        return self.u


def controllers():
    period, steps = 0.1, 400
    kinds = {
        "u1": dict(K=2.0, Ti=5.0),
        "u2": dict(K=1.5, Ti=4.0, Td=1.0, N=5.0, b=0.7, c=0.3, umin=-20.0, umax=60.0),
        "u3": dict(K=0.8, Ti=3.0, Td=0.2, direct=True, umin=-50.0, umax=50.0),
        "u4": dict(K=3.0, Ti=2.0, umin=10.0, umax=30.0),
        "u5": dict(K=1.0, Ti=6.0, nbad=8),
        "u6": dict(K=1.0, Ti=6.0, fail=12.5),
    }
    text = "! Controllers in the open loop: forms, limits, direct action, a dead sensor.\nCONTROL\n1 y = ain ( : 0, 1, 1 )\n2 w = ain ( : 0, 1, 2 )\n"
    for i, (name, kind) in enumerate(kinds.items()):
        params = [f"{key} = {value!r}" for key, value in kind.items() if key not in ("direct", "nbad", "fail")]
        params += ["act = direct"] * kind.get("direct", False)
        params += [f"tbad = {kind['nbad'] * period:.1f}"] if "nbad" in kind else []
        params += [f"onfail = value, ufail = {kind['fail']}"] if "fail" in kind else []
        text += f"{i + 3} {name} = pid ( y, w : {', '.join(params)} )\n"
    text += "END\n"
    loops = {name: Reference(period, **kind) for name, kind in kinds.items()}
    stimulus, trace = [], []
    for k in range(steps):
        w = 50.0 if k < 100 else 42.0
        y = round(45.0 + 6.0 * math.sin(0.05 * k) + 1.5 * math.sin(0.9 * k), 4)
        if 200 <= k < 206 or 260 <= k < 290 or k == 320:
            y = math.nan
        man = 150 <= k < 170
        um = None
        if k == 155:
            um = 25.0
        if k == 270:
            um = 33.0
        retune = k == 230
        if retune:
            loops["u1"].integral += loops["u1"].proportional(*reversed(loops["u1"].past))
            loops["u1"].K = 4.0
            loops["u1"].integral -= loops["u1"].proportional(*reversed(loops["u1"].past))
        stimulus.append([k, y, w, (MAN if man else AUTO) if k in (150, 170) else None, um if k == 155 else None,
                         um if k == 270 else None, 4.0 if retune else None])
        row = [k]
        for name, loop in loops.items():
            manual = man and name == "u1"
            given = um if (name == "u1" and k == 155) or (name == "u5" and k == 270) else None
            if name == "u5" and given is not None and loop.lost >= loop.nbad:
                loop.u = given
            row.append(loop.scan(y, w, MAN if manual else AUTO, given if name == "u1" else None))
        trace.append(row)
    header = ["ain(0,1,1)", "ain(0,1,2)", "u1.mode", "u1.um", "u5.um", "u1.K"]
    golden.write("pid_open_loop", text, (header, stimulus), (list(kinds), trace),
                 "sums in another order, and a compensated integral against a plain one", relative=1e-10, absolute=1e-10,
                 period=period)


def settled():
    """A settled loop: the integral action is all of du, so sum(e) T = (Ti/K) du."""
    period, steps = 0.05, 4000
    a, gain, K, Ti = 0.5, 0.8, 2.0, 4.0
    e = math.exp(-a * period)
    g = gain / a * (1.0 - e)
    y, total, rows = 0.0, 0.0, []
    loop = Reference(period, K=K, Ti=Ti, umin=-1000.0, umax=1000.0)
    u = loop.u
    for k in range(steps):
        y = e * y + g * u
        u = loop.scan(y, 10.0)
        total += 10.0 - y
        rows.append([k, y, u])
    assert abs(y - 10.0) < 1e-12, y
    # After the first scan, which sets I = u - P, the integral action makes up for all the rest.
    first = rows[0]
    total -= 10.0 - first[1]
    assert math.isclose(total * period, Ti / K * (u - first[2] + K * (10.0 - first[1])), rel_tol=1e-9)
    text = ("! One loop that settles.\nPLANT\n1 y = first ( u : 0.5, 0.8, 0. )\nCONTROL\n2 w = msc ( : 10. )\n"
            "3 u = pid ( y, w : K = 2., Ti = 4., umin = -1000., umax = 1000. )\nEND\n")
    golden.write("pid_settled", text, ([], [[0]]), (["y", "u"], rows[:400]), "expm1 against exp", relative=1e-10,
                 absolute=1e-10, period=period)


if __name__ == "__main__":
    controllers()
    settled()

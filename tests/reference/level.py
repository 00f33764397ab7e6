"""Trace of examples/level: the plant from its equations, the controllers from theirs, every 5th scan.

The start is not computed: it must leave the plant at rest. Nor is there a return wire: each controller is told what the
selector did in the scan before."""
import csv
import math

import golden

FOLDER = golden.CASES.parent.parent / "examples" / "level"
PERIOD = 0.5
NAMES = ["va", "vb", "q", "p", "h", "LC", "FC", "OV"]


class Plant:
    def __init__(self):
        self.xa, self.xb, self.p, self.h = 57.142857143, 0.0, 3.0, 50.0

    def scan(self, valves, inflow, network):
        moved = -math.expm1(-0.66666666667 * PERIOD)
        self.xa += moved * (valves[0] - self.xa)
        self.xb += moved * (valves[1] - self.xb)
        self.q = (0.2 * self.xa + 0.6 * self.xb) * (10.0 - self.p) / 4.0
        self.p += -math.expm1(-0.5 * PERIOD) * (network + 0.05 * self.q - self.p)
        self.h += 0.0055555555556 * PERIOD * (inflow - self.q)


class Level:
    """A PI controller that does not integrate into the limit of its slave."""

    def __init__(self, u, error):
        self.u, self.sum = u, u - 2.0 * error

    def apart(self, u, error):
        self.u, self.sum = u, u - 2.0 * error

    def scan(self, error, limited):
        free = 2.0 * error + self.sum
        step = 2.0 * PERIOD / 360.0 * error
        if limited is not None:
            step = min(step, 0.0) + PERIOD / 360.0 * (min(limited, free) - free)
        self.u, self.sum = free, self.sum + step


class Reset:
    """External reset: u = K e + the followed output behind a lag of Ti."""

    def __init__(self, u, error, gain, reset):
        self.gain, self.rate = gain, -math.expm1(-PERIOD / reset)
        self.apart(u, error)

    def apart(self, u, error):
        self.u, self.sum = u, u - self.gain * error

    def scan(self, error, followed, selected):
        self.u = min(max(self.gain * error + self.sum, 0.0), 100.0)
        self.sum += self.rate * ((followed if selected else min(followed, self.u)) - self.sum)


def stimulus():
    words = {"FC.mode": "cas", "FC.um": None, "LC.mode": "auto", "LC.um": None, "qi": 20.0, "pb": 2.0}
    with open(FOLDER / "stimulus.csv", newline="") as file:
        rows = [(round(float(row.pop("t")) / PERIOD), row) for row in csv.DictReader(file)]
    for k in range(rows[-1][0] + 1):
        while rows and rows[0][0] == k:
            found = {name.replace(".value", ""): text for name, text in rows.pop(0)[1].items() if text}
            words.update({name: text if name.endswith("mode") else float(text) for name, text in found.items()})
        yield k, words


def main():
    plant, valves = Plant(), (57.142857143, 0.0)
    rest = 57.142857143 / 4.0
    level, flow, pressure = Level(20.0, 0.0), Reset(rest, 0.0, 0.4, 1.5), Reset(rest, 3.0, 5.0, 2.5)
    acts, u, point, linked, blocked = "flow", rest, 20.0, True, False
    rows = []
    for k, world in stimulus():
        plant.scan(valves, world["qi"], world["pb"])
        error = plant.h - 50.0
        if not linked:
            level.apart(point, error)
        elif world["LC.mode"] == "man":
            level.apart(level.u if world["LC.um"] is None else world["LC.um"], error)
        else:
            level.scan(error, point if blocked else None)
        mode = world["FC.mode"]
        point = level.u if mode == "cas" else point
        if mode == "man":
            flow.apart(flow.u if world["FC.um"] is None else world["FC.um"], point - plant.q)
        else:
            flow.scan(point - plant.q, u, acts == "flow")
        linked, blocked = mode == "cas", acts != "flow"
        pressure.scan(6.0 - plant.p, u, acts == "pressure")
        acts, u = ("flow", flow.u) if flow.u <= pressure.u else ("pressure", pressure.u)
        valves = 4.0 * min(u, 25.0), max(u - 25.0, 0.0) / 0.75
        if k % 5 == 0 and k > 0:
            rows.append([k, *valves, plant.q, plant.p, plant.h, level.u, flow.u, u])
    golden.table(FOLDER / "trace.csv", ["@k"] + NAMES, rows)


if __name__ == "__main__":
    main()

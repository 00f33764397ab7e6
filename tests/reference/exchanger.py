"""Trace of examples/exchanger: the plant from its equations, both controllers in their velocity form, every 5th scan.

The controllers are not those of the runtime: an increment of the output has no integral part to transfer, so a change of
mode is bumpless by itself, and what both forms share is the control law alone."""
import csv
import math

import golden

FOLDER = golden.CASES.parent.parent / "examples" / "exchanger"
PERIOD = 0.5
NAMES = ["TT", "F", "FF", "TC", "TC.actual", "FC", "FC.actual", "kWh", "steam", "mean"]
MAN, AUTO, CAS, INIT = 0, 1, 2, 4


class Plant:
    def __init__(self):
        self.x, self.tubes, self.steam = 0.0, 20.0, 0.0
        self.pipe = None

    def scan(self, valve, world):
        self.x += -math.expm1(-0.5 * PERIOD) * (valve - self.x)
        self.steam = 0.002 * self.x * world["ps"]
        warm = 20.0 + 523.80952381 * self.steam / world["W"]
        self.tubes += -math.expm1(-0.033333333333 * PERIOD) * (warm - self.tubes)
        self.pipe = [self.tubes] * 42 if self.pipe is None else [self.tubes] + self.pipe[:-1]
        late = 80.0 / world["W"] / PERIOD
        n = int(late)
        return (1.0 - (late - n)) * self.pipe[n] + (late - n) * self.pipe[n + 1]


class Velocity:
    """du = K ((w - w') - (y - y')) + K T/Ti (w' - y') + (ff - ff'), for a loop whose output is not limited; in a scan in
    which the output comes from elsewhere nothing is integrated."""

    def __init__(self, gain, reset, period):
        self.gain, self.sum = gain, gain * period / reset
        self.past = None

    def apart(self, u, w, y, ff=0.0):
        self.u, self.past, self.error = u, (w, y, ff), 0.0
        return u

    def scan(self, w, y, ff=0.0):
        w1, y1, ff1 = self.past
        self.u += self.gain * ((w - w1) - (y - y1)) + self.sum * self.error + (ff - ff1)
        self.past, self.error = (w, y, ff), w - y
        return self.u


def stimulus():
    words = {"FC.mode": AUTO, "FC.w": 0.0, "W": 10.0, "sp": 70.0, "ps": 10.0, "wire": 1.0}
    modes = {"auto": AUTO, "cas": CAS}
    with open(FOLDER / "stimulus.csv", newline="") as file:
        rows = [(round(float(row.pop("t")) / PERIOD), row) for row in csv.DictReader(file)]
    for k in range(rows[-1][0] + 1):
        while rows and rows[0][0] == k:
            found = {name.replace(".value", ""): text for name, text in rows.pop(0)[1].items() if text}
            words.update({name: modes[text] if text in modes else float(text) for name, text in found.items()})
        yield k, words


def main():
    plant, master, slave = Plant(), Velocity(0.025, 30.0, 5 * PERIOD), Velocity(40.0, 2.0, PERIOD)
    tc = fc = ff = last_load = 0.0
    state, blind = AUTO, 0
    kwh = steam = 0.0
    samples, rows = [], []
    cascade = False
    point = 0.0
    for k, world in stimulus():
        outlet = plant.scan(fc, world)
        sensor = world["wire"] != 0.0
        if k % 5 == 0:
            load = world["W"]
            gain, period = 0.095454545455, 5 * PERIOD
            if k == 0:
                ff = gain * load
            else:
                ff = ((2 * 2.5 - period) * ff + gain * ((2 * 4.0 + period) * load - (2 * 4.0 - period) * last_load)) / (2 * 2.5 + period)
            last_load = load
            if not sensor:
                state = MAN if blind >= round(10.0 / period) else state
                blind += 1
            elif k == 0:
                tc = master.apart(0.0, world["sp"], outlet, ff)
            elif not cascade:
                tc, state = master.apart(point, world["sp"], outlet, ff), INIT
            elif blind > round(10.0 / period):
                tc, state, blind = master.apart(tc, world["sp"], outlet, ff), AUTO, 0
            else:
                tc, state, blind = master.scan(world["sp"], outlet, ff), AUTO, 0
        cascade = world["FC.mode"] == CAS
        point = tc if cascade else world["FC.w"]
        fc = slave.apart(0.0, point, plant.steam) if k == 0 else slave.scan(point, plant.steam)
        assert 0.0 <= fc <= 100.0 and 0.0 <= tc <= 2.0
        if k % 50 == 0:
            if sensor:
                kwh += 50 * PERIOD * 0.000277777777778 * 4.2 * world["W"] * (outlet - 20.0)
                samples = ([outlet] * 4 if not samples else samples[1:] + [outlet])
            steam += 50 * PERIOD * plant.steam
        if k % 5 == 0:
            shown = outlet if sensor else math.nan
            rows.append([k, shown, plant.steam, ff, tc, state, fc, world["FC.mode"], kwh, steam, sum(samples) / 4.0])
    golden.table(FOLDER / "trace.csv", ["@k"] + NAMES, rows)


if __name__ == "__main__":
    main()

"""Trace of examples/burner: the plant from its equations, the burner as a sequence of states with clocks."""
import csv
import math

import golden

FOLDER = golden.CASES.parent.parent / "examples" / "burner"
PERIOD = 0.1
NAMES = ["start", "run", "fan", "spark", "vp", "vm", "flame", "lock", "cause", "refused", "missing", "q", "pf"]


def scans(seconds):
    return round(seconds / PERIOD)


class Lag:
    def __init__(self, rate, y=0.0):
        self.keep, self.y = math.exp(-rate * PERIOD), y

    def to(self, target):
        self.y = self.keep * self.y + (1.0 - self.keep) * target
        return self.y


class Plant:
    def __init__(self):
        self.pilot, self.main, self.gas = Lag(10.0), Lag(10.0), Lag(5.0, 50.0)
        self.scanner, self.air, self.furnace = Lag(4.0), Lag(0.5), Lag(1.0)
        self.fire, self.q = False, 0.0

    def scan(self, out, world):
        opening = 0.1 * self.pilot.to(out["vp"]) + 0.9 * self.main.to(out["vm"])
        self.q = 2.0 * opening * self.gas.y
        self.gas.to(world["supply"] - 0.1 * self.q)
        spark = out["spark"] and world["coil"]
        self.fire = bool((spark or self.fire) and self.q > 3.0 and not world["storm"])
        self.scanner.to(100.0 * self.fire)
        self.air.to(100.0 * out["fan"])
        self.furnace.to((0.005 * self.air.y + 0.02 * self.q) * world["clog"])


class Burner:
    """state: off, vent, purge, pilot, prove, fire; since counts the scans in it."""

    def __init__(self):
        self.state, self.since = "off", 0
        self.lock = self.cause = self.refused = 0
        self.dark = self.low = self.steady = 0
        self.off = None
        self.flame = self.gas = self.air = self.free = 0
        self.seen = None

    def go(self, state):
        self.state, self.since = state, 0

    def switch(self, name, x, on, off):
        held = getattr(self, name)
        rises = on > off
        if x >= on if rises else x <= on:
            held = 1
        elif x <= off if rises else x >= off:
            held = 0
        setattr(self, name, held)

    def trips(self):
        """Those that hold now, of a burner that ran in the scan before."""
        s, found = self.state, []
        lit = s in ("prove", "fire")
        if s == "prove" and self.since == 0 and not self.flame:
            found.append(1)
        self.dark = self.dark + 1 if lit and not self.flame else 0
        if self.dark > scans(0.5):
            found.append(2)
        self.low = self.low + 1 if s in ("pilot", "prove", "fire") and not self.gas else 0
        if self.low > scans(1.0):
            found.append(3)
        if not self.free:
            found.append(4)
        if (s == "vent" and self.since > scans(10.0)) or (s != "vent" and not self.air):
            found.append(5)
        return found

    def sequence(self):
        s, n = self.state, self.since
        if s == "vent" and self.air:
            self.go("purge")
        elif s == "purge" and n == scans(10.0):
            self.go("pilot")
        elif s == "pilot" and n == scans(3.0):
            self.go("prove")
        self.steady = self.steady + 1 if self.state == "prove" and self.flame else 0
        if self.steady > scans(2.0):
            self.go("fire")

    def scan(self, plant, buttons):
        self.switch("gas", plant.gas.y, 40.0, 35.0)
        self.switch("flame", plant.scanner.y, 40.0, 20.0)
        self.switch("air", plant.air.y, 80.0, 70.0)
        self.switch("free", plant.furnace.y, 4.0, 5.0)
        ran = self.state != "off"
        pushed = {name: bool(value) and self.seen is not None and not self.seen[name] for name, value in buttons.items()}
        self.seen = dict(buttons)
        self.since += 1
        if ran:
            self.sequence()
        found = self.trips() if ran else []
        if found:
            self.cause = self.cause or found[0]
            self.lock = 1
        elif self.lock and pushed["reset"]:
            self.lock, self.cause = 0, 0
        fit = self.gas and self.free and not self.flame and not self.lock
        if pushed["start"] and not fit and not ran:
            self.refused = 1
        elif (pushed["start"] and fit) or buttons["reset"]:
            self.refused = 0
        if buttons["stop"] or self.lock:
            self.stop(ran)
        elif pushed["start"] and fit and not ran:
            self.go("vent")
        return self.outputs(bool(self.state != "off"))

    def stop(self, ran):
        if ran:
            self.off = 0
        self.state, self.dark, self.low, self.steady = "off", 0, 0, 0

    def outputs(self, runs):
        s = self.state
        fan = runs or (self.off is not None and self.off < scans(5.0))
        if not runs and self.off is not None:
            self.off += 1
        missing = (not self.gas) + 2 * (not self.free) + 4 * self.flame + 8 * self.lock
        vp = s in ("pilot", "prove") or (s == "fire" and self.since < scans(5.0))
        return {"run": runs, "fan": fan, "spark": s == "pilot", "vp": vp, "vm": s == "fire", "flame": self.flame,
                "lock": self.lock, "cause": self.cause, "refused": self.refused, "missing": missing}


def stimulus():
    """The words of the world and the buttons in each scan, to the last row."""
    words = {"start": 0, "stop": 0, "reset": 0, "storm": 0, "supply": 50.0, "clog": 1.0, "coil": 1}
    with open(FOLDER / "stimulus.csv", newline="") as file:
        rows = [(scans(float(row.pop("t"))), row) for row in csv.DictReader(file)]
    for k in range(rows[-1][0] + 1):
        while rows and rows[0][0] == k:
            words.update({name.split(".")[0]: float(text) for name, text in rows.pop(0)[1].items() if text})
        yield k, dict(words)


def main():
    plant, burner = Plant(), Burner()
    out = dict.fromkeys(["vp", "vm", "spark", "fan"], False)
    rows = []
    for k, world in stimulus():
        plant.scan(out, world)
        out = burner.scan(plant, {name: world[name] for name in ("start", "stop", "reset")})
        seen = dict(out, start=int(world["start"]), q=plant.q, pf=plant.furnace.y)
        rows.append([k] + [seen[name] for name in NAMES])
    golden.table(FOLDER / "trace.csv", ["@k"] + NAMES, rows)


if __name__ == "__main__":
    main()

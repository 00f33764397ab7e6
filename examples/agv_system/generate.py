"""Writes the nets and the user functions of the AGV system: python3 generate.py [FOLDER]

Five vehicles, a track of 12 zones with 4 stations each. What is alike for each zone or each vehicle is written once here.
Each user function is written twice: as a composite in functions, and in C in functions_c. Both compute the same.

The net has the size of the one in the paper, with the boxes and gates of all instances:

                            boxes   gates
    agvs.net                   44      41
    agv.net, five times     5 (20      10
    travel.net in each        +28)    +38)
                              284     281

63 logical inputs and outputs are in the head of agvs.net, 5 classes of tokens and 82 user functions in all nets together.
A macro counts as a box, and so do the boxes inside it.
"""
import re
import sys
from pathlib import Path

VEHICLES = range(1, 6)
ZONES = range(1, 13)
STATIONS_OF_A_ZONE = 4
STATIONS = STATIONS_OF_A_ZONE * len(ZONES)

# Zones lead to the next one; 3 and 9 have a branch too, to the other side.
BRANCHES = {3: 10, 9: 4}
# mm/s, empty and loaded: slower in the curves.
SPEEDS = {zone: (800, 500) if zone in (3, 4, 9, 10) else (1000, 800) for zone in ZONES}


def after(zone):
    return zone % len(ZONES) + 1


# User functions ------------------------------------------------------------------------------------------------------


class Function:
    """head is (outputs, inputs); lines are assignments in the expressions of PCL2."""

    def __init__(self, name, text, outputs, inputs, lines):
        self.name, self.text, self.outputs, self.inputs, self.lines = name, text, outputs, inputs, lines

    def declaration(self):
        def listed(words):
            return ", ".join(words)

        return f"! {self.text}\n{listed(self.outputs)} = {self.name} ( {listed(self.inputs)} : )\n"

    def composite(self):
        return self.declaration() + "BODY\n" + "".join(f"{target} = {value}\n" for target, value in self.lines) + "END\n"

    def rule(self):
        return "BAD A\n" if any(word.startswith("real") for word in self.inputs) else "BAD L\n"

    def code(self):
        names = {word.split()[1]: word.split()[0] for word in self.outputs}
        out = [f"/* {self.text} */", f'#include "pcl2_{self.name}.h"', ""]
        kinds = {"int": "int32_t", "real": "pcl2_real"}
        ports = "".join(f", {kinds[word.split()[0]]} {word.split()[1]}" for word in self.inputs)
        out += [f"PCL2_KERNEL void pcl2_{self.name}(struct pcl2_{self.name} *self{ports})", "{"]
        used = " ".join(value for _, value in self.lines)
        for word in self.inputs:
            port = word.split()[1]
            if not re.search(rf"\b{port}\b", used):
                out.append(f"    (void){port};")
        for target, value in self.lines:
            kind = names.get(target)
            left = f"self->{target}" if kind else f"const int32_t {target}"
            out.append(f"    {left} = {c_expression(value, kind == 'real')};")
        return "\n".join(out + ["}", ""])


def c_expression(value, is_real):
    """PCL2 binds as C does, but for NOT, which no function uses."""
    for word, sign in ((r"\bAND\b", "&&"), (r"\bOR\b", "||"), ("<>", "!=")):
        value = re.sub(word, sign, value)
    if is_real:
        value = re.sub(r"\d+\.\d+", lambda number: f"PCL2_R({number.group()})", value)
        value = re.sub(r"\bloaded\b", "(pcl2_real)loaded", value)
    return value


def functions_of_a_zone(z):
    first = STATIONS_OF_A_ZONE * (z - 1)
    here = f"goal > {first} AND goal <= {first + STATIONS_OF_A_ZONE}"
    straight, branch = after(z), BRANCHES.get(z)
    turns = turning(z)
    goes = [("zone", f"(goal + {STATIONS_OF_A_ZONE - 1})/{STATIONS_OF_A_ZONE}")] if branch else []
    onward = f"{straight} + {branch - straight}*({turns})" if branch else f"{straight}"
    turn = f" + 10*(1 - here)*({turns})" if branch else ""
    empty, loaded = SPEEDS[z]
    yield Function(f"stops_{z}", f"Whether a station lies in zone {z}.", ["int here"], ["int goal"],
                   [("here", here)])
    yield Function(f"next_{z}", f"The zone behind zone {z} on the way to a station.", ["int next"], ["int goal"],
                   goes + [("next", onward)])
    yield Function(f"word_{z}", f"The command for zone {z}: 100 zone + 10 if it turns off + stations to go.",
                   ["int word"], ["int goal"],
                   goes + [("here", f"({here})"),
                           ("word", f"{100 * z}{turn} + here*(goal - {first}) + {STATIONS_OF_A_ZONE}*(1 - here)")])
    yield Function(f"limit_{z}", f"How long an answer from zone {z} may take, in seconds.", ["real limit"], ["int loaded"],
                   [("limit", f"{2 + 0.1 * z:.1f} + 1.0*loaded")])
    yield Function(f"speed_{z}", f"The speed in zone {z}, in mm/s.", ["int speed"], ["int loaded"],
                   [("speed", f"{empty} - {empty - loaded}*loaded")])
    yield Function(f"power_{z}", f"The battery's charge behind zone {z}, in percent.", ["real left"],
                   ["real power", "int loaded"], [("left", f"power - {0.3 + 0.02 * z:.2f} - 0.2*loaded")])


def turning(z):
    """Zones that are nearer by the branch, as a condition on `zone`."""
    if z not in BRANCHES:
        return ""
    nearer = [goal for goal in ZONES if distance(BRANCHES[z], goal) < distance(after(z), goal)]
    return " OR ".join(f"zone == {goal}" for goal in nearer)


def distance(start, goal):
    """How many zones lie between, by the shortest way."""
    reached, seen, steps = {start}, {start}, 0
    while goal not in reached:
        reached = {z for here in reached for z in (after(here), BRANCHES.get(here, after(here)))} - seen
        seen |= reached
        steps += 1
    return steps


def common_functions():
    most = STATIONS
    legal = f"pick >= 1 AND pick <= {most} AND drop >= 1 AND drop <= {most} AND pick <> drop"
    yield Function("stations", "The stations of an order, 10000 urgency + 100 pick + drop; 0 where one is not there.",
                   ["int load_at", "int bring_to"], ["int order"],
                   [("pick", "order/100 - order/10000*100"), ("drop", "order - order/100*100"),
                    ("legal", f"({legal})"), ("load_at", "legal*pick"), ("bring_to", "legal*drop")])
    yield Function("urgency", "How urgent an order is, 0 to 9.", ["int urgent"], ["int order"],
                   [("urgent", "order/10000 - order/100000*10")])
    yield Function("ticket", "The number of the next request, 1 to 999.", ["int number"], ["int last"],
                   [("number", "last - last/999*999 + 1")])
    yield Function("zone_of", "The zone in which a station lies.", ["int zone"], ["int station"],
                   [("zone", f"(station + {STATIONS_OF_A_ZONE - 1})/{STATIONS_OF_A_ZONE}")])
    ways = "".join(f" + (here == {here})*({way_from(here)})" for here in ZONES)
    yield Function("far", "How many zones lie between a vehicle and a station.", ["int zones"],
                   ["int here", "int station"],
                   [("zone", f"(station + {STATIONS_OF_A_ZONE - 1})/{STATIONS_OF_A_ZONE}"), ("zones", "0" + ways)])
    free = [f"int free{i}" for i in VEHICLES] + [f"int cost{i}" for i in VEHICLES]
    bids = [(f"bid{i}", f"cost{i} + 1000*(1 - free{i})") for i in VEHICLES]
    wins = []
    for i in VEHICLES:
        others = [f"bid{i} {'<' if j < i else '<='} bid{j}" for j in VEHICLES if j != i]
        wins.append(f"{i}*(bid{i} < 1000 AND {' AND '.join(others)})")
    yield Function("nearest", "The free vehicle with the least cost, the first of equal ones; 0 if none is free.",
                   ["int vehicle"], free, bids + [("vehicle", " + ".join(wins))])
    yield Function("answered", "Whether a command needs no more answer: answered, or sent three times in vain.",
                   ["int ready", "int sent"], ["int cause", "int tries"],
                   [("done", "(cause == 0 OR tries >= 3)"), ("ready", "done"), ("sent", "tries + 1 - done")])
    yield Function("charger", "The station where a vehicle is charged.", ["int station"], ["int id"],
                   [("station", f"{STATIONS} - id + 1")])
    yield Function("weak", "Whether a battery must be charged before the next transport.", ["int low"], ["real power"],
                   [("low", "power < 30.0")])
    yield Function("status", "What the display shows of a vehicle: 1000 vehicle + its last request.", ["int shown"],
                   ["int id", "int number"], [("shown", "1000*id + number")])


def way_from(here):
    """The number of zones to each zone, as a sum of conditions."""
    return " + ".join(f"{distance(here, goal)}*(zone == {goal})" for goal in ZONES if goal != here)


def all_functions():
    return [function for z in ZONES for function in functions_of_a_zone(z)] + list(common_functions())


# Nets ----------------------------------------------------------------------------------------------------------------

TRIP = """CLASS vehicle ( int id = 0, int zone = 0, int task = 0, int goal = 0, int next = 0, int here = 0, int loaded = 0,
                int drop = 0, real power = 33. )
"""


def travel_net():
    lines = ["! A vehicle travels from zone to zone until the station of its goal. It asks for each zone before it enters it, and",
             "! gives back the one behind it then. In a zone it is told what to do, and runs by itself until it reports.",
             "int send, int word, int speed, int want, int left, int at = travel ( int ack, int passed, int grant, int reset : )",
             TRIP + "LOCAL int tries, real limit",
             "",
             "ENTRY start OF vehicle           ! in the yard of its zone",
             "STATE asks OF vehicle            ! for the next zone"]
    for z in ZONES:
        lines += [f"PROCESS told[{z}] OF vehicle DRIVES send UNTIL ack WITHIN limit",
                  f"DO told[{z}].here = stops_{z} ( told[{z}].goal : )",
                  f"DO told[{z}].next = next_{z} ( told[{z}].goal : )",
                  f"DO word = word_{z} ( told[{z}].goal : )",
                  f"DO speed = speed_{z} ( told[{z}].loaded : )",
                  f"DO told[{z}].power = power_{z} ( told[{z}].power, told[{z}].loaded : )",
                  f"DO limit = limit_{z} ( told[{z}].loaded : )",
                  "DO tries = 1",
                  f"AFTER told[{z}].ready, tries = answered ( told[{z}].cause, tries : )",
                  f"STATE runs[{z}] OF vehicle"]
    lines += ["STATE halts OF vehicle           ! it does not answer",
              "EXIT there OF vehicle            ! in the yard of the goal's zone",
              "",
              "GATE leave : start -> asks",
              "DO left = 0",
              "DO want = start.zone",
              "DO start.next = start.zone"]
    for z in ZONES:
        lines += [f"GATE into[{z}] : asks -> told[{z}]  IF grant == {z} AND asks.next == {z}",
                  f"DO left = asks.zone*(asks.zone <> {z})",
                  f"DO asks.zone = {z}",
                  f"DO at = {z}",
                  f"GATE goes[{z}] : told[{z}] -> runs[{z}], halts",
                  "IF ack",
                  f"THEN told[{z}] -> runs[{z}]",
                  "ELSE",
                  f"THEN told[{z}] -> halts",
                  f"GATE out[{z}] : runs[{z}] -> asks, there",
                  f"IF passed AND runs[{z}].here",
                  f"THEN runs[{z}] -> there",
                  "DO want = 0",
                  f"DO left = {z}",
                  "IF passed",
                  f"THEN runs[{z}] -> asks",
                  f"DO want = runs[{z}].next"]
    lines += ["GATE again : halts -> asks       IF reset",
              "DO halts.next = halts.zone",
              "END"]
    return "\n".join(lines) + "\n"


# The words of a vehicle: from it, to it, and between it and the traffic control.
INPUTS = ["ack", "passed", "loaded", "unloaded", "charged"]
OUTPUTS = ["word", "speed", "send", "load", "unload", "charge"]
ASKS = ["want", "left", "at", "able", "finished", "shown"]
TELLS = ["go", "pick", "drop", "number", "grant"]


def ints(names):
    return ", ".join(f"int {name}" for name in names)


def vehicle_net():
    return f"""! One vehicle, Fig. 9 of the paper: it waits, travels to the station where it loads, loads, travels to the other one,
! unloads. All its ways are one macro; task says what the way is for: 1 to load, 2 to unload, 3 to be charged.
{ints(OUTPUTS + ASKS)} = agv (
    {ints(INPUTS + TELLS)}, int reset
    : int id = 1, int home = 1 )
{TRIP}CLASS job ( int pick = 0, int drop = 0 )
CLASS event ( int number = 0 )
LOCAL int low, int first

PROCESS idle OF vehicle MARKED ( id = 0 )     ! in the yard of its zone
DO first = zone_of ( home : )
DO idle.zone = idle.zone + first*(idle.zone == 0)
DO at = idle.zone
GENERATE task OF job SIZE 1 WHEN go
DO task.pick = pick
DO task.drop = drop
MACRO travels : send, word, speed, want, left, at = travel ( ack, passed, grant, reset : )
PROCESS loads OF vehicle DRIVES load UNTIL loaded WITHIN 30.
GENERATE has_loaded SIZE 1 WHEN loaded
PROCESS unloads OF vehicle DRIVES unload UNTIL unloaded WITHIN 30.
DO low = weak ( unloads.power : )
GENERATE has_unloaded OF event SIZE 1 WHEN unloaded
DO has_unloaded.number = number
STATE charges OF vehicle DRIVES charge
GENERATE is_charged SIZE 1 WHEN charged
STATE bare MARKED                             ! nothing is on the fork
STATE full
TIME rests 2. MARKED                          ! the fork goes in before the next transport
STATE strong MARKED DRIVES able               ! the battery
GENERATE gets_weak SIZE 1 WHEN low
STATE weakened
PROCESS reports OF event DO shown = status ( id, reports.number : )
TIME tells 1. DRIVES finished
COUNT trips 10                                ! a service is due after ten
STATE service
GENERATE serviced SIZE 1 WHEN reset

GATE begins    : idle, task, rests -> travels  READ strong
THEN idle -> travels
THEN task -> nothing
THEN rests -> nothing
DO idle.id = id
DO idle.task = 1
DO idle.goal = task.pick
DO idle.drop = task.drop
GATE arrives   : travels -> loads, unloads, charges
IF travels.task == 1
THEN travels -> loads
IF travels.task == 2
THEN travels -> unloads
ELSE
THEN travels -> charges
GATE picks_up  : loads, has_loaded, bare -> travels, full
THEN loads -> travels
THEN has_loaded -> nothing
THEN bare -> full
DO loads.loaded = 1
DO loads.task = 2
DO loads.goal = loads.drop
GATE puts_down : unloads, has_unloaded, full -> idle, reports, bare, rests, tells, trips
THEN unloads -> idle
THEN has_unloaded -> reports
THEN full -> bare, rests, tells, trips
DO unloads.loaded = 0
GATE reported  : reports, tells ->
GATE weakens   : gets_weak, strong -> weakened
GATE to_charge : idle, weakened -> travels
THEN idle -> travels
THEN weakened -> nothing
DO idle.task = 3
DO idle.goal = charger ( id : )
GATE recovers  : charges, is_charged -> idle, strong
THEN charges -> idle
THEN is_charged -> strong
DO charges.power = 100.
DO low = 0
GATE due       : trips -> service
GATE looked_at : service, serviced ->
END
"""


def system_net():
    orders = ["request", "order", "cancel", "stop", "reset"]
    accounts = ["waiting", "done", "refused"]
    of_all = [f"{name}{i}" for name in OUTPUTS for i in VEHICLES]
    to_all = [f"{name}{i}" for name in INPUTS for i in VEHICLES]
    lines = ["! Five vehicles, the requests for them, and the traffic between them.",
             ints(accounts + of_all) + " = agvs (",
             f"    {ints(orders)},"]
    lines += [f"    {ints(to_all[k:k + 5])}{',' if k + 5 < len(to_all) else ' : )'}" for k in range(0, len(to_all), 5)]
    lines += ["CLASS request ( int pick = 0, int drop = 0, int urgent = 0, int number = 0, int vehicle = 0 )",
              "CLASS place ( int id = 0 )",
              "LOCAL int last"]
    lines += [f"LOCAL {ints(f'{name}{i}' for name in ASKS + TELLS + ['cost'])}" for i in VEHICLES]
    lines += ["",
              "! Requests of the production computer.",
              "GENERATE new OF request SIZE 4 WHEN request",
              "DO new.pick, new.drop = stations ( order : )",
              "DO new.urgent = urgency ( order : )",
              "STATE desk MARKED",
              "PROCESS check OF request",
              "DO last = ticket ( last : )",
              "DO check.number = last",
              "CAPACITY queue OF request SIZE 20 ORDER most urgent DRIVES waiting"]
    for name, why in (("assign_new", "a request is new"), ("assign_idle", "a vehicle is idle")):
        lines += [f"PROCESS {name}" + " " * 8 + f"! {why}"]
        for i in VEHICLES:
            lines += [f"DO cost{i} = far ( at{i}, queue.pick : )", f"DO cost{i} = cost{i} + 1000*(1 - able{i})"]
        ports = ", ".join([f"free[{i}]" for i in VEHICLES] + [f"cost{i}" for i in VEHICLES])
        lines += [f"DO queue.vehicle = nearest ( {ports} : )"]
    lines += ["STATE running MARKED",
              "STATE stopped",
              "GENERATE halt SIZE 1 WHEN stop",
              "GENERATE go_on SIZE 1 WHEN stopped AND NOT stop",
              "",
              "! Vehicles: free or out."]
    for i in VEHICLES:
        lines += [f"STATE free[{i}] MARKED", f"STATE out[{i}] DRIVES go{i}"]
    lines += ["", "! Zones of the track: one vehicle in each."]
    for z in ZONES:
        lines += [f"STATE clear[{z}] OF place MARKED ( id = 0 )", f"STATE taken[{z}] OF place"]
    lines += [""]
    homes = {1: 3, 2: 12, 3: 21, 4: 30, 5: 39}
    for i in VEHICLES:
        given = ", ".join(f"{name}{i}" for name in OUTPUTS + ASKS)
        told = ", ".join(f"{name}{i}" for name in INPUTS + TELLS)
        lines += [f"MODULE v[{i}] : {given} = agv (", f"    {told}, reset", f"    : id = {i}, home = {homes[i]} )"]
    lines += ["",
              "GATE accept : new, desk -> check, desk",
              "IF new.pick == 0",
              "THEN new -> nothing",
              "THEN desk -> desk",
              "DO refused = refused + 1",
              "ELSE",
              "THEN new -> check",
              "THEN desk -> nothing",
              "GATE file : check -> queue, assign_new, desk",
              "THEN check -> queue",
              "THEN NEW -> assign_new, desk",
              "GATE assigned_new : assign_new ->",
              "GATE assigned_idle : assign_idle -> assign_idle",
              "IF queue AND (free[1] OR free[2] OR free[3] OR free[4] OR free[5])",
              "THEN assign_idle -> assign_idle",
              "ELSE",
              "THEN assign_idle -> nothing",
              "GATE cancels : queue ->  IF cancel AND queue.number == cancel",
              "GATE halts : running, halt -> stopped",
              "GATE resumes : stopped, go_on -> running",
              ""]
    for i in VEHICLES:
        lines += [f"GATE give[{i}] : free[{i}], queue -> out[{i}]  READ running",
                  f"IF queue.vehicle == {i}",
                  f"THEN free[{i}] -> out[{i}]",
                  "THEN queue -> nothing",
                  f"DO pick{i} = queue.pick",
                  f"DO drop{i} = queue.drop",
                  f"DO number{i} = queue.number",
                  f"GATE back[{i}] : out[{i}] -> free[{i}], assign_idle",
                  f"IF finished{i} AND NOT assign_idle",
                  f"THEN out[{i}] -> free[{i}], assign_idle",
                  "DO done = done + 1",
                  f"IF finished{i}",
                  f"THEN out[{i}] -> free[{i}]",
                  "DO done = done + 1"]
    lines += [""]
    for z in ZONES:
        lines += [f"GATE seize[{z}] : clear[{z}] -> taken[{z}]"]
        for i in VEHICLES:
            lines += [f"IF want{i} == {z}", f"DO clear[{z}].id = {i}", f"DO grant{i} = {z}"]
        lines += [f"GATE release[{z}] : taken[{z}] -> clear[{z}]"]
        for i in VEHICLES:
            lines += [f"IF taken[{z}].id == {i} AND left{i} == {z}", f"DO grant{i} = grant{i}*(grant{i} <> {z})"]
    return "\n".join(lines + ["END"]) + "\n"


def main(folder):
    (folder / "agvs.net").write_text(system_net())
    (folder / "agv.net").write_text(vehicle_net())
    (folder / "travel.net").write_text(travel_net())
    for name in ("functions", "functions_c"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    for function in all_functions():
        (folder / "functions" / f"{function.name}.fc").write_text(function.composite())
        (folder / "functions_c" / f"{function.name}.fc").write_text(function.declaration() + function.rule())
        (folder / "functions_c" / f"{function.name}.c").write_text(function.code())


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent)

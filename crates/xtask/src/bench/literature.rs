//! Nets of the literature, written as PNML.

use std::fmt::Write;

/// A place/transition net.
#[derive(Default)]
pub(crate) struct Net {
    places: Vec<(String, u64)>,
    transitions: Vec<Transition>,
}

/// A name, the places that it takes from, the places that it puts into.
type Transition = (String, Vec<String>, Vec<String>);

impl Net {
    fn place(&mut self, name: &str, tokens: u64) {
        self.places.push((name.to_owned(), tokens));
    }

    /// Both lists are names between blanks.
    fn transition(&mut self, name: &str, takes: &str, puts: &str) {
        let names = |list: &str| list.split_whitespace().map(str::to_owned).collect();
        self.transitions.push((name.to_owned(), names(takes), names(puts)));
    }

    /// As PNML.
    pub(crate) fn pnml(&self) -> String {
        let mut text = "<pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\">\n".to_owned();
        text += "<net id=\"net\" type=\"http://www.pnml.org/version-2009/grammar/ptnet\"><page id=\"page\">\n";
        for (name, tokens) in &self.places {
            let marking = format!("<initialMarking><text>{tokens}</text></initialMarking>");
            let _ = writeln!(text, "<place id=\"{name}\">{marking}</place>");
        }
        for (name, takes, puts) in &self.transitions {
            let _ = writeln!(text, "<transition id=\"{name}\"/>");
            let arcs = takes.iter().map(|place| (place, name)).chain(puts.iter().map(|place| (name, place)));
            for (source, target) in arcs {
                let _ = writeln!(text, "<arc source=\"{source}\" target=\"{target}\"/>");
            }
        }
        text + "</page></net></pnml>\n"
    }
}

/// Four cells with n cards each; the second and the third work side by side (Ciardo, Tilgner 1996).
pub(crate) fn kanban(n: u64) -> Net {
    let mut net = Net::default();
    for cell in 1..=4 {
        for (state, tokens) in [("card", n), ("work", 0), ("bad", 0), ("done", 0)] {
            net.place(&format!("{state}{cell}"), tokens);
        }
        net.transition(&format!("fail{cell}"), &format!("work{cell}"), &format!("bad{cell}"));
        net.transition(&format!("repeat{cell}"), &format!("bad{cell}"), &format!("work{cell}"));
        net.transition(&format!("pass{cell}"), &format!("work{cell}"), &format!("done{cell}"));
    }
    net.transition("enter", "card1", "work1");
    net.transition("divide", "done1 card2 card3", "card1 work2 work3");
    net.transition("join", "done2 done3 card4", "card2 card3 work4");
    net.transition("leave", "done4", "card4");
    net
}

/// A flexible manufacturing system with n pallets of each of three kinds of parts, of which the first two may be joined
/// (Ciardo, Trivedi 1993).
pub(crate) fn fms(n: u64) -> Net {
    let mut net = Net::default();
    for (machine, count) in [("M1", 3), ("M2", 1), ("M3", 2)] {
        net.place(machine, count);
    }
    for part in ["P1", "P2", "P3"] {
        net.place(part, n);
        net.place(&format!("{part}s"), 0);
    }
    for part in ["P1", "P2"] {
        for state in ["w", "m", "d", "j"] {
            net.place(&format!("{part}{state}"), 0);
        }
        let machine = if part == "P1" { "M1" } else { "M2" };
        net.transition(&format!("{part}_come"), part, &format!("{part}w"));
        net.transition(&format!("{part}_begin"), &format!("{part}w {machine}"), &format!("{part}m"));
        net.transition(&format!("{part}_end"), &format!("{part}m"), &format!("{part}d {machine}"));
        net.transition(&format!("{part}_alone"), &format!("{part}d"), &format!("{part}s"));
        net.transition(&format!("{part}_wait"), &format!("{part}d"), &format!("{part}j"));
        net.transition(&format!("{part}_ship"), &format!("{part}s"), part);
    }
    for state in ["P12", "P12w", "P12m", "P12s", "P3m"] {
        net.place(state, 0);
    }
    net.transition("join", "P1j P2j", "P12");
    net.transition("P12_come", "P12", "P12w");
    net.transition("P12_begin", "P12w M3", "P12m");
    net.transition("P12_end", "P12m", "P12s M3");
    net.transition("P12_ship", "P12s", "P1 P2");
    net.transition("P3_come", "P3", "P3m");
    net.transition("P3_work", "P3m M2", "P3s M2");
    net.transition("P3_ship", "P3s", "P3");
    net
}

/// The order of the jobs in building a house, for n houses (Peterson 1981; a model of the Model Checking Contest).
pub(crate) fn house_construction(n: u64) -> Net {
    const JOBS: [(&str, &str); 18] = [
        ("p1", "p2"),
        ("p2", "p3"),
        ("p3", "p4 p5 p6"),
        ("p6", "p7 p8 p12"),
        ("p5", "p9 p13"),
        ("p7", "p11"),
        ("p4 p15", "p16"),
        ("p11", "p15"),
        ("p8 p9", "p10"),
        ("p10 p12 p13", "p14"),
        ("p14", "p17"),
        ("p17", "p18 p19 p20"),
        ("p22", "p23 p27"),
        ("p25 p26 p27", ""),
        ("p19 p20", "p22"),
        ("p18", "p21"),
        ("p21 p23", "p26"),
        ("p16", "p25"),
    ];
    let mut net = Net::default();
    for place in (1..=27).filter(|place| *place != 24) {
        net.place(&format!("p{place}"), if place == 1 { n } else { 0 });
    }
    for (job, (takes, puts)) in JOBS.iter().enumerate() {
        net.transition(&format!("job{job}"), takes, puts);
    }
    net
}

/// A pool with cabins and bags for 20 n guests (Model Checking Contest; Brams 1983).
pub(crate) fn swimming_pool(n: u64) -> Net {
    let mut net = Net::default();
    for (place, tokens) in [("out", 20 * n), ("cabins", 10 * n), ("bags", 15 * n)] {
        net.place(place, tokens);
    }
    for place in ["entered", "waiting", "undressing", "bathing", "dressing", "dressed"] {
        net.place(place, 0);
    }
    net.transition("enter", "out", "entered");
    net.transition("take_key", "entered cabins", "waiting");
    net.transition("take_bag", "waiting bags", "undressing");
    net.transition("leave_cabin", "undressing", "bathing cabins");
    net.transition("take_key_again", "bathing cabins", "dressing");
    net.transition("give_bag_back", "dressing", "dressed bags");
    net.transition("give_key_back", "dressed", "out cabins");
    net
}

/// n voters say yes or no (Model Checking Contest).
pub(crate) fn referendum(n: u64) -> Net {
    let mut net = Net::default();
    net.place("ready", 1);
    let mut voting = String::new();
    for voter in 1..=n {
        for state in ["voting", "yes", "no"] {
            net.place(&format!("{state}{voter}"), 0);
        }
        let _ = write!(voting, "voting{voter} ");
        net.transition(&format!("say_yes{voter}"), &format!("voting{voter}"), &format!("yes{voter}"));
        net.transition(&format!("say_no{voter}"), &format!("voting{voter}"), &format!("no{voter}"));
    }
    net.transition("start", "ready", &voting);
    net
}

/// The flight control system AutoFlight in its simple form, with n units (Model Checking Contest): processes that take
/// turns, and devices that change by themselves.
pub(crate) fn auto_flight(n: u64) -> Net {
    let mut net = Net::default();
    let mut start = "free".to_owned();
    for place in ["start", "free", "busy"] {
        net.place(place, u64::from(place == "start"));
    }
    for unit in 1..=n {
        start += &auto_flight_unit(&mut net, unit);
    }
    let all = |kind: &str| (1..=n).map(|unit| format!("{kind}{unit}")).collect::<Vec<_>>();
    let moves =
        |takes: &str, puts: &str| all("").iter().map(|u| (format!("{takes}{u}"), format!("{puts}{u}"))).collect();
    let reads = || all("enabled").into_iter().map(|place| (place.clone(), place)).collect::<Vec<_>>();
    let waits = |count: u64| (0..count).map(|_| (String::new(), String::new())).collect::<Vec<_>>();
    let first: Vec<_> = moves("left_failed", "left_ok");
    let second: Vec<_> = moves("right_failed", "right_ok");
    start += &process(&mut net, "check", [first, reads(), waits(n), reads()].concat());
    start += &process(&mut net, "test", [second, reads(), waits(2 * n), reads()].concat());
    net.transition("begin", "start", &start);
    net
}

/// A unit; its places that are marked after the beginning.
fn auto_flight_unit(net: &mut Net, unit: u64) -> String {
    for place in ["off", "on", "steady", "enabled"] {
        net.place(&format!("{place}{unit}"), 0);
    }
    for device in ["left", "right"] {
        for state in ["ok", "used", "failed"] {
            net.place(&format!("{device}_{state}{unit}"), 0);
        }
        for copy in ["a", "b"] {
            let name = format!("{device}{unit}{copy}");
            net.transition(&format!("return_{name}"), &format!("{device}_used{unit}"), &format!("{device}_ok{unit}"));
            net.transition(&format!("fail_{name}"), &format!("{device}_ok{unit}"), &format!("{device}_failed{unit}"));
        }
    }
    for copy in ["a", "b"] {
        net.transition(&format!("switch{unit}{copy}"), &format!("off{unit}"), &format!("on{unit}"));
    }
    let at = |place: &str| format!("{place}{unit}");
    let steps = vec![
        (at("steady"), at("steady")),
        (at("on"), at("off")),
        (at("left_ok"), at("left_used")),
        (at("right_ok"), at("right_used")),
    ];
    let waiting = process(net, &format!("engage{unit}_"), steps);
    ["off", "steady", "enabled", "left_ok", "right_ok"].iter().fold(waiting, |all, place| all + " " + &at(place))
}

/// A process that waits for its turn, takes and puts in each step, and hands the turn on. The place in which it waits.
fn process(net: &mut Net, name: &str, steps: Vec<(String, String)>) -> String {
    net.place(&format!("{name}wait"), 0);
    net.place(&format!("{name}0"), 0);
    net.transition(&format!("{name}begin"), &format!("{name}wait free"), &format!("{name}0 busy"));
    let count = steps.len();
    for (step, (takes, puts)) in steps.into_iter().enumerate() {
        net.place(&format!("{name}{}", step + 1), 0);
        net.transition(
            &format!("{name}step{step}"),
            &format!("{name}{step} {takes}"),
            &format!("{name}{} {puts}", step + 1),
        );
    }
    net.transition(&format!("{name}end"), &format!("{name}{count} busy"), &format!("{name}wait free"));
    format!(" {name}wait")
}

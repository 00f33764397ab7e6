//! The state equation with its check.

use crate::nets::{net, place_id, tank, transition_id};
use crate::tank::SCANS;
use pcl2_net::pt::PtNet;
use pcl2_net::structure::fire::{OnBlocked, Rule, Run, Scan, by_names, by_vector, fire, initial};
use pcl2_net::structure::names::Names;
use pcl2_net::structure::part::{Part, part};
use pcl2_net::structure::step::{Reason, maximal_step};

fn pick(whole: &PtNet, places: &str, transitions: &str) -> Part {
    let places = places.split(' ').map(|name| place_id(whole, name)).collect();
    part(whole, "part", places, transitions.split(' ').map(|name| transition_id(whole, name)).collect())
}

/// Equations (4) and (5).
fn main_loop() -> PtNet {
    pick(&tank(), "S0 S1 S2 S3 S4 S5 S6 P0 P1", "t0 t1 t2 t3 t4 t5 t6 tp10 tp11").net
}

/// Equations (10) and (11).
fn sub_net() -> Part {
    pick(&tank(), "L1 L0 V11 V10 Z12 Z11 Z10 D21 D20", "tL0 tL1 tv10 tv11 tz10 tz11 tz12 tz13 tD20 tD21")
}

fn scans(net: &PtNet, text: &[&str]) -> Vec<Scan> {
    let names = Names::new(net);
    text.iter().map(|scan| by_names(&names, scan.split_whitespace()).unwrap()).collect()
}

fn digits(marking: &[i128]) -> String {
    marking.iter().map(ToString::to_string).collect()
}

fn messages(net: &PtNet, run: &Run) -> Vec<String> {
    run.blocked.iter().map(|blocked| blocked.message(net)).collect()
}

#[test]
fn equation_9_needs_t0_and_the_button() {
    let net = main_loop();
    let scan = by_vector(&net, &[1, 0, 0, 0, 0, 0, 0, 0, 1]).unwrap();
    assert_eq!(digits(&initial(&net)), "100000010");
    let run = fire(&net, &initial(&net), std::slice::from_ref(&scan), Rule::Step, OnBlocked::Note).unwrap();
    assert_eq!(digits(&run.markings[1]), "010000001");
    let message = "scan 1: `t0` is not enabled: expected 1 token to read in `P1`, found 0";
    assert_eq!(messages(&net, &run), [message]);
    let refused = fire(&net, &initial(&net), &[scan], Rule::Step, OnBlocked::Refuse).unwrap();
    assert_eq!((refused.markings.len(), messages(&net, &refused)), (1, vec![message.to_owned()]));
}

#[test]
fn equation_9_is_possible_one_after_the_other() {
    let net = main_loop();
    let scans = scans(&net, &["tp11 t0"]);
    let run = fire(&net, &initial(&net), &scans, Rule::Interleaving, OnBlocked::Refuse).unwrap();
    assert_eq!((digits(&run.markings[1]), run.blocked.len()), ("010000001".to_owned(), 0));
}

#[test]
fn equations_15_to_17_are_steps_of_the_sub_net() {
    let net = sub_net().net;
    let scans = [[0, 1, 1, 0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1, 0, 0, 0, 0], [0, 0, 0, 0, 1, 0, 0, 0, 0, 1]];
    let scans: Vec<Scan> = scans.iter().map(|counts| by_vector(&net, counts).unwrap()).collect();
    let run = fire(&net, &initial(&net), &scans, Rule::Step, OnBlocked::Refuse).unwrap();
    let found: Vec<String> = run.markings.iter().map(|marking| digits(marking)).collect();
    assert_eq!(found, ["100100110", "011000110", "011001010", "011010001"]);
    assert_eq!(run.blocked, []);
}

#[test]
fn equation_17_depends_on_the_order_one_after_the_other() {
    let net = sub_net().net;
    let start = [0, 1, 1, 0, 0, 1, 0, 1, 0];
    let fire = |text: &str| fire(&net, &start, &scans(&net, &[text]), Rule::Interleaving, OnBlocked::Refuse).unwrap();
    assert_eq!(digits(&fire("tD21 tz10").markings[1]), "011010001");
    let refused = fire("tz10 tD21");
    let message = "scan 1: `tD21` is not enabled: expected 1 token to read in `Z11`, found 0";
    assert_eq!((refused.markings.len(), messages(&net, &refused)), (1, vec![message.to_owned()]));
}

#[test]
fn what_the_sub_net_waits_for_outside_is_told_and_makes_transitions_free() {
    let (whole, sub_net) = (tank(), sub_net());
    let told: Vec<String> = sub_net
        .outer
        .iter()
        .map(|outer| {
            let transition = &sub_net.net.transitions[outer.transition.0 as usize].name;
            format!("{transition} {:?} {}", outer.kind, whole.places[outer.arc.place.0 as usize].name)
        })
        .collect();
    let expected = ["tL0 Read S6", "tL1 Read S1", "tv10 Read S1", "tv11 Read S3", "tz12 Read V21", "tz13 Read V21"];
    assert_eq!(told, expected);
    let free = sub_net.net.transitions.iter().filter(|transition| transition.free).count();
    assert_eq!(free, 6);
}

#[test]
fn the_tanks_run_satisfies_the_state_equation() {
    let net = tank();
    let mut text = SCANS;
    text[1] = "t0 tp10";
    let run = fire(&net, &initial(&net), &scans(&net, &text), Rule::Step, OnBlocked::Refuse).unwrap();
    assert_eq!((run.markings.len(), run.blocked.len()), (17, 0));
    assert_eq!(run.markings[16], initial(&net));
    let once = by_vector(&net, &[1; 23]).unwrap();
    let run = fire(&net, &initial(&net), &[once], Rule::Step, OnBlocked::Note).unwrap();
    assert_eq!(run.markings[1], initial(&net));
    // At rest nothing can move but the button.
    assert_eq!(run.blocked.len(), 22);
}

#[test]
fn a_step_sees_neither_new_tokens_nor_new_room() {
    let net = net("a=1/1 b=0/1 c", "t: a -> b\nu: b -> c\nv: -> a");
    let fire = |text: &str, rule| {
        let run = fire(&net, &initial(&net), &scans(&net, &[text]), rule, OnBlocked::Refuse).unwrap();
        (run.markings.last().map(|marking| digits(marking)).unwrap(), messages(&net, &run))
    };
    let message = "scan 1: `u` is not enabled: expected 1 token to take from `b`, found 0".to_owned();
    assert_eq!(fire("t u", Rule::Step), ("100".to_owned(), vec![message]));
    assert_eq!(fire("t u", Rule::Interleaving), ("001".to_owned(), vec![]));
    let message = "scan 1: `v` is not enabled: expected room for 1 token in `a`, found 0".to_owned();
    assert_eq!(fire("t v", Rule::Step), ("100".to_owned(), vec![message]));
    assert_eq!(fire("t v", Rule::Interleaving), ("110".to_owned(), vec![]));
}

#[test]
fn weights_reads_inhibitors_and_gates_are_checked() {
    let mut net = net(
        "a=5 b=3 c=0/4",
        "take: 3*a -> c
         read: -> c ? 4*b
         block: -> c ? !3*b
         pass: -> c ? !4*b 3*b
         turn: 2*c -> 3*c",
    );
    let blocked = |net: &PtNet, text: &str, rule| {
        messages(net, &fire(net, &initial(net), &scans(net, &[text]), rule, OnBlocked::Note).unwrap())
    };
    let not = |name: &str, why: &str| format!("scan 1: `{name}` is not enabled: {why}");
    let (left, read) = ("expected 3 tokens to take from `a`, found 2", "expected 4 tokens to read in `b`, found 3");
    assert_eq!(blocked(&net, "take take", Rule::Interleaving), [not("take", left)]);
    assert_eq!(blocked(&net, "read", Rule::Step), [not("read", read)]);
    assert_eq!(blocked(&net, "block", Rule::Step), [not("block", "expected fewer than 3 tokens in `b`, found 3")]);
    assert_eq!(blocked(&net, "pass take", Rule::Step), Vec::<String>::new());
    assert_eq!(blocked(&net, "pass pass pass turn", Rule::Interleaving), Vec::<String>::new());
    let room = "expected room for 1 token in `c`, found 0";
    assert_eq!(blocked(&net, "pass pass pass turn turn", Rule::Interleaving), [not("turn", room)]);
    let again = "expected one firing of its gate in a scan, found `pass` before it";
    assert_eq!(blocked(&net, "pass pass", Rule::Step), [not("pass", again)]);
    net.transitions[0].gate = net.transitions[3].gate;
    assert_eq!(blocked(&net, "pass take", Rule::Step), [not("take", again)]);
}

#[test]
fn many_repetitions_are_checked_at_once() {
    let net = net("a=1000000000000 b", "t: a -> b\nu: 2*b -> a");
    let (t, u) = (transition_id(&net, "t"), transition_id(&net, "u"));
    let fire = |scan: Scan| fire(&net, &initial(&net), &[scan], Rule::Interleaving, OnBlocked::Refuse);
    assert_eq!(fire(vec![(t, 1_000_000_000_000), (u, 500_000_000_000)]).unwrap().blocked, []);
    let reason = Reason::Tokens { place: place_id(&net, "b"), expected: 2, found: 0 };
    assert_eq!(fire(vec![(t, 1_000_000_000_000), (u, 500_000_000_001)]).unwrap().blocked[0].reason, reason);
    let reason = Reason::Tokens { place: place_id(&net, "a"), expected: 1, found: 0 };
    assert_eq!(fire(vec![(t, 1_000_000_000_001)]).unwrap().blocked[0].reason, reason);
}

#[test]
fn wrong_firings_are_told() {
    let net = net("a=1", "start: a -> 18446744073709551615*a");
    let names = Names::new(&net);
    let message = "expected a transition of the net, found `strat` (did you mean `start`?)";
    assert_eq!(by_names(&names, ["strat"]), Err(message.to_owned()));
    assert_eq!(by_vector(&net, &[1, 0]), Err("expected a firing vector of 1 numbers, found 2".to_owned()));
    let scan = vec![(transition_id(&net, "start"), u64::MAX)];
    let run = fire(&net, &initial(&net), &[scan], Rule::Interleaving, OnBlocked::Note);
    assert_eq!(run, Err("scan 1: `a` gets more tokens than can be counted".to_owned()));
    let run = fire(&net, &[1, 2], &[], Rule::Step, OnBlocked::Note);
    assert_eq!(run, Err("expected a marking of 1 numbers, found 2".to_owned()));
    let step = maximal_step(&net, &[2], |_| true);
    assert_eq!(step, Err("`a` gets more tokens than 64 bits can count".to_owned()));
}

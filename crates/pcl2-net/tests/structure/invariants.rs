//! Invariants against hand-made lists, and against all supports tried.

use crate::nets::{Dice, net, philosophers, tank};
use pcl2_net::pt::PtNet;
use pcl2_net::structure::invariants::{p_invariants, place_bounds, t_invariants};
use pcl2_net::structure::matrix::{Matrix, MatrixKind};

const LIMIT: usize = 10_000;

/// P-invariants as sums, sorted.
fn of_places(net: &PtNet) -> Vec<String> {
    sums(p_invariants(net, LIMIT).unwrap(), |id| net.places[id.0 as usize].name.as_str())
}

/// T-invariants as sums, sorted.
fn of_transitions(net: &PtNet) -> Vec<String> {
    sums(t_invariants(net, LIMIT).unwrap(), |id| net.transitions[id.0 as usize].name.as_str())
}

fn sums<'n, Id: Copy>(invariants: Vec<Vec<(Id, u64)>>, name: impl Fn(Id) -> &'n str) -> Vec<String> {
    let term = |(id, weight): &(Id, u64)| match weight {
        1 => name(*id).to_owned(),
        _ => format!("{weight}{}", name(*id)),
    };
    let sum = |invariant: &Vec<(Id, u64)>| invariant.iter().map(term).collect::<Vec<_>>().join("+");
    let mut sums: Vec<String> = invariants.iter().map(sum).collect();
    sums.sort();
    sums
}

#[test]
fn each_device_of_the_tank_is_a_cycle() {
    let net = tank();
    let mut places =
        ["S0+S1+S2+S3+S4+S5+S6", "P0+P1", "L1+L0", "V11+V10", "V21+V20", "Z12+Z11+Z10", "D11+D10", "D21+D20"];
    let mut transitions = [
        "t0+t1+t2+t3+t4+t5+t6",
        "tp10+tp11",
        "tL0+tL1",
        "tv10+tv11",
        "tv20+tv21",
        "tz10+tz12",
        "tz11+tz13",
        "tD10+tD11",
        "tD20+tD21",
    ];
    places.sort_unstable();
    transitions.sort_unstable();
    assert_eq!(of_places(&net), places);
    assert_eq!(of_transitions(&net), transitions);
    assert_eq!(place_bounds(&net, &p_invariants(&net, LIMIT).unwrap()), vec![Some(1); 22]);
}

#[test]
fn philosophers_keep_themselves_and_their_forks() {
    let net = philosophers(5, false);
    let mut expected = Vec::new();
    for i in 0..5 {
        expected.push(format!("think{i}+eat{i}+hold{i}"));
    }
    // Fork i is with i from the first grasp on, or with the left neighbour who eats.
    for fork in ["eat0+fork0+hold0+eat4", "eat0+eat1+fork1+hold1", "eat1+eat2+fork2+hold2"] {
        expected.push(fork.to_owned());
    }
    expected.extend(["eat2+eat3+fork3+hold3", "eat3+eat4+fork4+hold4"].map(str::to_owned));
    expected.sort();
    assert_eq!(of_places(&net), expected);
    let mut cycles: Vec<String> = (0..5).map(|i| format!("left{i}+right{i}+put{i}")).collect();
    cycles.sort();
    assert_eq!(of_transitions(&net), cycles);
}

/// The Kanban system of the model checking contest: four cells of N cards.
fn kanban(cards: u64) -> PtNet {
    let (mut places, mut transitions) = (String::new(), String::new());
    for i in 1..=4 {
        places += &format!("P{i}={cards} Pm{i} Pback{i} Pout{i} ");
        transitions += &format!("tok{i}: Pm{i} -> Pout{i}\ntredo{i}: Pm{i} -> Pback{i}\ntback{i}: Pback{i} -> Pm{i}\n");
    }
    transitions += "tin1: P1 -> Pm1
        tsynch1_23: Pout1 P2 P3 -> P1 Pm2 Pm3
        tsynch23_4: Pout2 Pout3 P4 -> P2 P3 Pm4
        tout4: Pout4 -> P4";
    net(&places, &transitions)
}

#[test]
fn kanban_keeps_the_cards_of_each_cell() {
    let net = kanban(5);
    // Cells 2 and 3 are filled and emptied together: each sum holds with the free cards of the other one too.
    let expected = [
        "P1+Pm1+Pback1+Pout1",
        "P2+Pm2+Pback2+Pout2",
        "P2+Pm3+Pback3+Pout3",
        "P3+Pm3+Pback3+Pout3",
        "P4+Pm4+Pback4+Pout4",
        "Pm2+Pback2+Pout2+P3",
    ];
    assert_eq!(of_places(&net), expected);
    let through = "tok1+tok2+tok3+tok4+tin1+tsynch1_23+tsynch23_4+tout4".to_owned();
    let redo = (1..=4).map(|i| format!("tredo{i}+tback{i}"));
    assert_eq!(of_transitions(&net), [through].into_iter().chain(redo).collect::<Vec<_>>());
    assert_eq!(place_bounds(&net, &p_invariants(&net, LIMIT).unwrap()), vec![Some(5); 16]);
}

#[test]
fn weights_have_no_common_divisor_and_bound_places() {
    let net = net("a=7 b c=3/4 d", "split: 2*a -> 3*b\njoin: 6*b -> 4*a\nmake: -> d");
    assert_eq!(of_places(&net), ["3a+2b", "c"]);
    assert_eq!(of_transitions(&net), ["2split+join"]);
    let bounds = place_bounds(&net, &p_invariants(&net, LIMIT).unwrap());
    assert_eq!(bounds, [Some(7), Some(10), Some(3), None]);
    assert_eq!(place_bounds(&net, &[]), [None, None, Some(4), None]);
}

#[test]
fn what_takes_too_many_rows_or_too_large_numbers_is_not_known() {
    // Of 2n places n pairs: 2^n ways round.
    let (mut places, mut transitions) = ("s0 ".to_owned(), String::new());
    for i in 0..40 {
        places += &format!("a{i} b{i} s{} ", i + 1);
        transitions += &format!("x{i}: s{i} -> a{i}\ny{i}: s{i} -> b{i}\n");
        transitions += &format!("u{i}: a{i} -> s{}\nv{i}: b{i} -> s{}\n", i + 1, i + 1);
    }
    let net_of_ways = net(&places, &format!("{transitions}back: s40 -> s0"));
    assert_eq!(t_invariants(&net_of_ways, 1000), None);
    assert_eq!(p_invariants(&net_of_ways, 1000).map(|found| found.len()), Some(1));
    assert_eq!(p_invariants(&net_of_ways, 10), None);
    let chain: String = (0..20).map(|i| format!("t{i}: 99991*p{i} -> 99989*p{}\n", i + 1)).collect();
    let places: Vec<String> = (0..=20).map(|i| format!("p{i}")).collect();
    assert_eq!(p_invariants(&net(&places.join(" "), &chain), 1000), None);
}

/// All minimal invariants by trying all supports: minimal means that the equations leave one solution, up to a factor,
/// and that it is positive throughout.
fn tried(rows: &[Vec<i128>]) -> Vec<Vec<(u32, u64)>> {
    let mut found = Vec::new();
    for set in 1..1_usize << rows.len() {
        let support: Vec<usize> = (0..rows.len()).filter(|row| set >> row & 1 == 1).collect();
        let equations = (0..rows[0].len()).map(|column| support.iter().map(|row| rows[*row][column]).collect());
        if let Some(weights) = only_solution(equations.collect(), support.len()) {
            found.push(support.iter().map(|row| *row as u32).zip(weights).collect());
        }
    }
    found.sort();
    found
}

/// Gauss and Jordan without fractions.
fn only_solution(mut equations: Vec<Vec<i128>>, unknowns: usize) -> Option<Vec<u64>> {
    let mut pivots = Vec::new();
    let mut free = Vec::new();
    for unknown in 0..unknowns {
        let rank = pivots.len();
        let Some(at) = (rank..equations.len()).find(|row| equations[*row][unknown] != 0) else {
            free.push(unknown);
            continue;
        };
        equations.swap(rank, at);
        for row in (0..equations.len()).filter(|row| *row != rank) {
            let (a, b) = (equations[rank][unknown], equations[row][unknown]);
            let pivot = equations[rank].clone();
            for (value, other) in equations[row].iter_mut().zip(&pivot) {
                *value = *value * a - other * b;
            }
            let divisor = equations[row].iter().fold(0, |divisor, value| gcd(divisor, *value));
            equations[row].iter_mut().for_each(|value| *value /= divisor.max(1));
        }
        pivots.push(unknown);
    }
    let [free] = free[..] else {
        return None;
    };
    let scale = pivots.iter().enumerate().fold(1, |scale, (row, pivot)| {
        let value = equations[row][*pivot].abs();
        scale / gcd(scale, value) * value
    });
    let mut weights = vec![scale; unknowns];
    for (row, pivot) in pivots.iter().enumerate() {
        weights[*pivot] = -equations[row][free] * scale / equations[row][*pivot];
    }
    let divisor = weights.iter().fold(0, |divisor, value| gcd(divisor, *value));
    weights.iter().map(|weight| u64::try_from(weight / divisor).ok().filter(|weight| *weight > 0)).collect()
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

fn dense(matrix: &Matrix) -> Vec<Vec<i128>> {
    let row = |row| (0..matrix.columns.len()).map(|column| matrix.entry(row, column)).collect();
    (0..matrix.rows.len()).map(row).collect()
}

#[test]
fn all_supports_tried_give_the_same_invariants() {
    let mut dice = Dice(1);
    let (mut places, mut transitions) = (0, 0);
    for round in 0..400 {
        let net = dice.net(2 + round % 7, 2 + round % 6, 1 + round % 3, true);
        let rows = dense(&Matrix::of(&net, MatrixKind::Change));
        let columns: Vec<Vec<i128>> =
            (0..rows[0].len()).map(|column| rows.iter().map(|row| row[column]).collect()).collect();
        let found = p_invariants(&net, LIMIT).unwrap();
        let found: Vec<Vec<(u32, u64)>> =
            found.iter().map(|sum| sum.iter().map(|(id, weight)| (id.0, *weight)).collect()).collect();
        assert_eq!(found, tried(&rows), "round {round}");
        places += found.len();
        let found = t_invariants(&net, LIMIT).unwrap();
        let found: Vec<Vec<(u32, u64)>> =
            found.iter().map(|sum| sum.iter().map(|(id, weight)| (id.0, *weight)).collect()).collect();
        assert_eq!(found, tried(&columns), "round {round}");
        transitions += found.len();
    }
    assert!(places > 300 && transitions > 300, "only {places} and {transitions}");
}

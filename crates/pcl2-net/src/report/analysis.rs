//! What is known of a net from its arcs and its first marking.

use super::document::{Cell, Content, Section, Style, cell, table};
use crate::flat::Flat;
use crate::pt::{PlaceId, PtNet};
use crate::structure::conflicts::{Over, conflicts};
use crate::structure::invariants::{Invariant, p_invariants, t_invariants, weighted_tokens};
use crate::structure::matrix::{Matrix, MatrixKind};
use crate::structure::modules::modules;
use crate::structure::names;
use crate::structure::siphons::{Member, Siphon, is_ordinary, siphons_that_can_empty};

/// The most rows that the search for invariants, and the most sets that the search for siphons, may hold.
const MOST_ROWS: usize = 5000;
/// So many pairs of transitions are looked at closely.
const PAIRS: usize = 100_000;
/// The most rows and columns of a matrix that is shown.
const MATRIX: usize = 40;
/// The most entries of a list.
const ENTRIES: usize = 200;

/// The sections of the analysis.
pub(super) fn sections(flat: &Flat) -> Vec<Section> {
    let net = &flat.net;
    let invariants = p_invariants(net, MOST_ROWS);
    vec![
        device_cycles(net, invariants.as_deref()),
        firing_cycles(net),
        siphons(net),
        rivals(net, invariants.as_deref().unwrap_or(&[])),
        matrices(net),
    ]
}

/// A sum of names with weights.
fn sum<Id: Copy>(terms: &Invariant<Id>, name: impl Fn(Id) -> String) -> String {
    let term = |(id, weight): &(Id, u64)| if *weight == 1 { name(*id) } else { format!("{weight}*{}", name(*id)) };
    terms.iter().map(term).collect::<Vec<_>>().join(" + ")
}

/// The first entries of a list as a table, and how many are left out.
fn listed(columns: &[(&'static str, Style)], mut rows: Vec<Vec<Cell>>) -> Vec<Content> {
    let more = rows.len().saturating_sub(ENTRIES);
    rows.truncate(ENTRIES);
    let mut content = vec![Content::Table(table(columns, rows))];
    content.extend((more > 0).then(|| Content::Words(format!("And {more} more."))));
    content
}

fn unknown() -> Vec<Content> {
    vec![Content::Words("Not known: there are too many to look at.".to_owned())]
}

fn device_cycles(net: &PtNet, found: Option<&[Invariant<PlaceId>]>) -> Section {
    let row = |invariant: &Invariant<PlaceId>| {
        let tokens = weighted_tokens(net, invariant).map_or("?".to_owned(), |tokens| tokens.to_string());
        vec![cell(sum(invariant, |id| names::place(net, id).to_owned())), cell(tokens)]
    };
    let columns = [("boxes", Style::Code), ("tokens", Style::Number)];
    let content = match found {
        None => unknown(),
        Some([]) => vec![Content::Words("No sum of boxes keeps its tokens.".to_owned())],
        Some(found) => listed(&columns, found.iter().map(row).collect()),
    };
    let mut all = vec![Content::Words(
        "Sums of boxes whose number of tokens never changes (P-invariants): the loop of a device has one.".to_owned(),
    )];
    all.extend(content);
    Section::new(2, "Cycles of devices", all)
}

fn firing_cycles(net: &PtNet) -> Section {
    let content = match t_invariants(net, MOST_ROWS) {
        None => unknown(),
        Some(found) if found.is_empty() => vec![Content::Words("No firings lead back to where they began.".to_owned())],
        Some(found) => {
            let row = |invariant| vec![cell(sum(invariant, |id| names::transition(net, id).to_owned()))];
            listed(&[("gates", Style::Code)], found.iter().map(row).collect())
        }
    };
    let mut words = "Firings that lead back to the marking where they began (T-invariants).".to_owned();
    if net.transitions.iter().any(|transition| transition.name.contains(['/', '+', ':'])) {
        words.push_str(
            " Here and below g/2 is the second rule of the gate g, +b the making of a token in b, abort:D/b ",
        );
        words.push_str("an ABORT of D while b is marked.");
    }
    let mut all = vec![Content::Words(words)];
    all.extend(content);
    Section::new(2, "Cycles of firings", all)
}

fn siphons(net: &PtNet) -> Section {
    let member = |member: &Member| match member {
        Member::Tokens(place) => names::place(net, *place).to_owned(),
        Member::Room(place) => format!("room of {}", names::place(net, *place)),
    };
    let row = |siphon: &Siphon| vec![cell(siphon.iter().map(member).collect::<Vec<_>>().join(", "))];
    let content = match siphons_that_can_empty(net, MOST_ROWS) {
        None => unknown(),
        Some(found) if !found.is_empty() => {
            let words = "Sets of boxes that stay empty once they are empty, and that no structure keeps marked: gates \
                         behind them may stop for good.";
            let mut content = vec![Content::Words(words.to_owned())];
            content.extend(listed(&[("boxes", Style::Code)], found.iter().map(row).collect()));
            content
        }
        Some(_) if is_ordinary(net) => {
            let words = "None: whatever the marking, the tokens enable some gate. Its conditions may still keep it.";
            vec![Content::Words(words.to_owned())]
        }
        Some(_) => {
            let words = "None. With weights or inhibitors a box that holds too few tokens may still stop the net.";
            vec![Content::Words(words.to_owned())]
        }
    };
    Section::new(2, "Siphons that can empty", content)
}

fn rivals(net: &PtNet, invariants: &[Invariant<PlaceId>]) -> Section {
    let columns = [("box", Style::Code), ("over", Style::Words), ("gates, the first one wins", Style::Code)];
    let rows: Vec<Vec<Cell>> = conflicts(net, invariants, PAIRS)
        .into_iter()
        .map(|conflict| {
            let over = match conflict.over {
                Over::Tokens => "tokens",
                Over::Room => "room",
            };
            let gates: Vec<&str> = conflict.transitions.iter().map(|id| names::transition(net, *id)).collect();
            vec![cell(names::place(net, conflict.place)), cell(over), cell(gates.join(", "))]
        })
        .collect();
    let content = if rows.is_empty() {
        vec![Content::Words("None: no two gates want the same token or the same room.".to_owned())]
    } else {
        let words = "Gates that may want the same token or the same room in one scan: their order decides.";
        let mut content = vec![Content::Words(words.to_owned())];
        content.extend(listed(&columns, rows));
        content
    };
    Section::new(2, "Conflicts", content)
}

/// B of the whole net, or of each module where the whole is too large.
fn matrices(net: &PtNet) -> Section {
    let words = "B: what each gate changes (columns) in each box (rows). What it only reads is not in it.";
    let mut content = vec![Content::Words(words.to_owned())];
    let fits = |matrix: &Matrix| matrix.rows.len() <= MATRIX && matrix.columns.len() <= MATRIX;
    let whole = Matrix::of(net, MatrixKind::Change);
    let shown = if fits(&whole) {
        vec![whole]
    } else {
        let part = |module: crate::structure::modules::Module| {
            let mut matrix = Matrix::of_part(net, MatrixKind::Change, &module.places, &module.transitions);
            matrix.label = module.name;
            matrix
        };
        modules(net).into_iter().filter(|module| !module.places.is_empty()).map(part).collect()
    };
    let count = shown.len();
    let shown: Vec<Matrix> = shown.into_iter().filter(fits).collect();
    let left_out = count - shown.len();
    content.extend(shown.iter().filter(|matrix| !matrix.rows.is_empty()).map(text));
    if left_out > 0 {
        let words = format!("Too large to be shown: {left_out}. `pcl2 net matrix` prints all of them.");
        content.push(Content::Words(words));
    }
    Section::new(2, "Incidence matrix", content)
}

fn text(matrix: &Matrix) -> Content {
    let mut bytes = Vec::new();
    // A vector takes all that is written to it.
    let _ = matrix.write_text(&mut bytes);
    Content::Code(String::from_utf8_lossy(&bytes).into_owned())
}

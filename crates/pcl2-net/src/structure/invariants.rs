//! Invariants: the weights of places whose weighted sum of tokens no firing changes, and the firing counts that lead
//! back to the marking they began with. All those of minimal support, by the Farkas algorithm with exact integers.
//!
//! Read arcs, inhibitors and capacities move no token and change no invariant.

use crate::pt::{PlaceId, PtNet, TransitionId};
use crate::structure::matrix::{Matrix, MatrixKind};
use fixedbitset::FixedBitSet;

/// Weights of at least 1, in order of the ids, without a common divisor.
pub type Invariant<Id> = Vec<(Id, u64)>;

/// Words compared for each row that is allowed: what keeps the time within bounds.
const WORDS_A_ROW: u64 = 1 << 15;

/// The minimal P-invariants, sorted. `None`, not known: more than `limit` rows were needed, or larger numbers than
/// there are.
pub fn p_invariants(net: &PtNet, limit: usize) -> Option<Vec<Invariant<PlaceId>>> {
    let matrix = Matrix::of(net, MatrixKind::Change);
    let rows = (0..matrix.rows.len()).map(|row| matrix.row(row).to_vec()).collect();
    let found = solutions(rows, matrix.columns.len(), limit)?;
    Some(
        found
            .into_iter()
            .map(|weights| weights.into_iter().map(|(id, weight)| (PlaceId(id), weight)).collect())
            .collect(),
    )
}

/// The minimal T-invariants, sorted. `None` as above.
pub fn t_invariants(net: &PtNet, limit: usize) -> Option<Vec<Invariant<TransitionId>>> {
    let matrix = Matrix::of(net, MatrixKind::Change);
    let mut rows = vec![Vec::new(); matrix.columns.len()];
    for row in 0..matrix.rows.len() {
        for (column, value) in matrix.row(row) {
            rows[*column as usize].push((row as u32, *value));
        }
    }
    let found = solutions(rows, matrix.rows.len(), limit)?;
    Some(
        found
            .into_iter()
            .map(|weights| weights.into_iter().map(|(id, weight)| (TransitionId(id), weight)).collect())
            .collect(),
    )
}

/// The most tokens that a place can ever hold, as far as invariants and capacities tell.
pub fn place_bounds(net: &PtNet, invariants: &[Invariant<PlaceId>]) -> Vec<Option<u64>> {
    let mut bounds: Vec<Option<u64>> =
        net.places.iter().map(|place| Some(place.capacity?.max(place.initial))).collect();
    for invariant in invariants {
        let Some(sum) = weighted_tokens(net, invariant) else {
            continue;
        };
        for (place, weight) in invariant {
            let found = u64::try_from(sum / u128::from(*weight)).ok();
            let bound = &mut bounds[place.0 as usize];
            *bound = (*bound).into_iter().chain(found).min();
        }
    }
    bounds
}

/// The sum that an invariant keeps: of the first marking. `None` when it is beyond 128 bits.
pub fn weighted_tokens(net: &PtNet, invariant: &Invariant<PlaceId>) -> Option<u128> {
    invariant.iter().try_fold(0_u128, |sum, (place, weight)| {
        let tokens = net.places[place.0 as usize].initial;
        sum.checked_add(u128::from(tokens) * u128::from(*weight))
    })
}

/// Entries of a sparse row: columns in ascending order.
type Entries = Vec<(u32, i128)>;

/// A non-negative combination of the given rows.
struct Row {
    /// How often each given row is in it.
    weights: Entries,
    /// What it sums up to in the columns that are not yet eliminated.
    rest: Entries,
    /// The given rows that are in it.
    support: FixedBitSet,
}

impl Row {
    /// Whether its support is within a set. Its ends tell of most rows that it is not.
    fn is_within(&self, set: &FixedBitSet) -> bool {
        let ends = [self.weights.first(), self.weights.last()];
        ends.into_iter().flatten().all(|(row, _)| set.contains(*row as usize)) && self.support.is_subset(set)
    }
}

/// The non-negative solutions y of y A = 0 that have minimal support, for a matrix A given by its rows.
///
/// After each column the rows are the extreme rays of the cone of the columns so far. A positive and a negative row are
/// combined only if they are neighbours: no third row has its support within theirs. So no row is made that has to be
/// removed later.
fn solutions(given: Vec<Entries>, columns: usize, limit: usize) -> Option<Vec<Vec<(u32, u64)>>> {
    let count = given.len();
    let mut rows: Vec<Row> = given.into_iter().enumerate().map(|(i, rest)| first_row(i, rest, count)).collect();
    let mut budget = Budget { rows: limit, words: (limit as u64).saturating_mul(WORDS_A_ROW) };
    if count > limit {
        return None;
    }
    let mut eliminated = 0;
    while let Some(column) = next_column(&rows, columns) {
        rows = eliminate(rows, column, eliminated, &mut budget)?;
        eliminated += 1;
    }
    let mut found = Vec::with_capacity(rows.len());
    for row in rows {
        let weights = row.weights.into_iter().map(|(id, weight)| Some((id, u64::try_from(weight).ok()?)));
        found.push(weights.collect::<Option<Vec<_>>>()?);
    }
    found.sort();
    Some(found)
}

fn first_row(index: usize, rest: Entries, count: usize) -> Row {
    let mut support = FixedBitSet::with_capacity(count);
    support.insert(index);
    Row { weights: vec![(index as u32, 1)], rest, support }
}

struct Budget {
    rows: usize,
    words: u64,
}

impl Budget {
    fn spend(&mut self, words: usize) -> Option<()> {
        self.words = self.words.checked_sub(words as u64)?;
        Some(())
    }
}

/// The column whose elimination makes the number of rows grow least.
fn next_column(rows: &[Row], columns: usize) -> Option<u32> {
    let mut signs = vec![(0_i64, 0_i64); columns];
    for (column, value) in rows.iter().flat_map(|row| &row.rest) {
        let (positive, negative) = &mut signs[*column as usize];
        *(if *value > 0 { positive } else { negative }) += 1;
    }
    let used = (0_u32..).zip(signs).filter(|(_, (positive, negative))| positive + negative > 0);
    let growth = |(positive, negative): (i64, i64)| positive.saturating_mul(negative) - positive - negative;
    used.min_by_key(|(_, signs)| growth(*signs)).map(|(column, _)| column)
}

fn eliminate(rows: Vec<Row>, column: u32, eliminated: usize, budget: &mut Budget) -> Option<Vec<Row>> {
    let value = |row: &Row| row.rest.binary_search_by_key(&column, |entry| entry.0).map_or(0, |at| row.rest[at].1);
    let values: Vec<i128> = rows.iter().map(value).collect();
    let with = |wanted: fn(i128) -> bool| (0..rows.len()).filter(|i| wanted(values[*i])).collect::<Vec<_>>();
    let (positive, negative) = (with(|value| value > 0), with(|value| value < 0));
    let kept = rows.len() - positive.len() - negative.len();
    let mut combined = Vec::new();
    for plus in &positive {
        for minus in &negative {
            if are_neighbours(&rows, *plus, *minus, eliminated, budget)? {
                combined.push(combine(&rows[*plus], &rows[*minus], values[*plus], values[*minus])?);
                budget.rows.checked_sub(kept + combined.len())?;
            }
        }
    }
    let mut left: Vec<Row> =
        rows.into_iter().zip(values).filter(|(_, value)| *value == 0).map(|(row, _)| row).collect();
    left.append(&mut combined);
    Some(left)
}

/// Whether the smallest face of the cone with both rows is the one between them.
fn are_neighbours(rows: &[Row], a: usize, b: usize, eliminated: usize, budget: &mut Budget) -> Option<bool> {
    let (a_support, b_support) = (&rows[a].support, &rows[b].support);
    let words = a_support.as_slice().len() + 1;
    budget.spend(words)?;
    // A face of dimension 2 leaves at most two unknowns more than there are equations.
    if a_support.union_count(b_support) > eliminated + 2 {
        return Some(false);
    }
    let both = a_support | b_support;
    let mut compared = 0;
    let third = rows.iter().enumerate().any(|(i, row)| {
        compared += 1;
        i != a && i != b && row.is_within(&both)
    });
    budget.spend(compared * words)?;
    Some(!third)
}

/// The combination of two rows that is zero in a column, where they have these values.
fn combine(plus: &Row, minus: &Row, plus_value: i128, minus_value: i128) -> Option<Row> {
    let minus_value = minus_value.checked_neg()?;
    let divisor = common_divisor(plus_value, minus_value);
    let factors = (minus_value / divisor, plus_value / divisor);
    let mut weights = sum(&plus.weights, &minus.weights, factors)?;
    let mut rest = sum(&plus.rest, &minus.rest, factors)?;
    let divisor = weights.iter().chain(&rest).fold(0, |divisor, entry| common_divisor(divisor, entry.1));
    if divisor > 1 {
        weights.iter_mut().chain(&mut rest).for_each(|entry| entry.1 /= divisor);
    }
    Some(Row { weights, rest, support: &plus.support | &minus.support })
}

/// a * factor + b * factor, without zeros.
fn sum(a: &Entries, b: &Entries, (a_factor, b_factor): (i128, i128)) -> Option<Entries> {
    let mut sum = Vec::with_capacity(a.len() + b.len());
    let (mut a, mut b) = (a.iter().peekable(), b.iter().peekable());
    while let Some(column) = a.peek().into_iter().chain(b.peek()).map(|entry| entry.0).min() {
        let a_value = a.next_if(|entry| entry.0 == column).map_or(0, |entry| entry.1);
        let b_value = b.next_if(|entry| entry.0 == column).map_or(0, |entry| entry.1);
        let value = a_value.checked_mul(a_factor)?.checked_add(b_value.checked_mul(b_factor)?)?;
        if value != 0 {
            sum.push((column, value));
        }
    }
    Some(sum)
}

/// Of absolute values. Zero has every divisor.
fn common_divisor(mut a: i128, mut b: i128) -> i128 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a.saturating_abs()
}

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
    let mut rows =
        Rows { by_column: vec![Vec::new(); columns], signs: vec![Signs::default(); columns], ..Rows::default() };
    for (i, rest) in given.into_iter().enumerate() {
        rows.insert(first_row(i, rest, count));
    }
    let mut budget = Budget { rows: limit, words: (limit as u64).saturating_mul(WORDS_A_ROW) };
    if count > limit {
        return None;
    }
    let mut eliminated = 0;
    while let Some(column) = next_column(&rows.signs) {
        eliminate(&mut rows, column, eliminated, &mut budget)?;
        eliminated += 1;
    }
    let mut found = Vec::with_capacity(rows.slots.len());
    for row in rows.slots.into_iter().flatten() {
        let weights = row.weights.into_iter().map(|(id, weight)| Some((id, u64::try_from(weight).ok()?)));
        found.push(weights.collect::<Option<Vec<_>>>()?);
    }
    found.sort();
    Some(found)
}

/// The rows of now. A slot whose row is gone takes another.
#[derive(Default)]
struct Rows {
    slots: Vec<Option<Row>>,
    free: Vec<u32>,
    /// By column the slots of rows that are not zero there; of some the row is another now.
    by_column: Vec<Vec<u32>>,
    signs: Vec<Signs>,
}

impl Rows {
    fn insert(&mut self, row: Row) {
        let slot = self.free.pop().unwrap_or(self.slots.len() as u32);
        for (column, value) in &row.rest {
            self.by_column[*column as usize].push(slot);
            self.signs[*column as usize].count(*value, 1);
        }
        match self.slots.get_mut(slot as usize) {
            Some(place) => *place = Some(row),
            None => self.slots.push(Some(row)),
        }
    }

    fn remove(&mut self, slot: u32) {
        let Some(row) = self.slots[slot as usize].take() else {
            return;
        };
        row.rest.iter().for_each(|(column, value)| self.signs[*column as usize].count(*value, -1));
        self.free.push(slot);
    }

    /// The slots of rows that are not zero in a column, with their values there.
    fn in_column(&mut self, column: u32) -> Vec<(u32, i128)> {
        let mut slots = std::mem::take(&mut self.by_column[column as usize]);
        slots.sort_unstable();
        slots.dedup();
        let value = |slot: u32| {
            let rest = &self.slots[slot as usize].as_ref()?.rest;
            rest.binary_search_by_key(&column, |entry| entry.0).ok().map(|at| rest[at].1)
        };
        slots.into_iter().filter_map(|slot| Some((slot, value(slot)?))).collect()
    }

    fn pair(&self, a: u32, b: u32) -> Option<(&Row, &Row)> {
        self.slots[a as usize].as_ref().zip(self.slots[b as usize].as_ref())
    }
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

/// How many rows are positive in a column, and how many negative.
#[derive(Clone, Copy, Default)]
struct Signs {
    positive: i64,
    negative: i64,
}

impl Signs {
    /// A row with this value comes (1) or goes (-1).
    fn count(&mut self, value: i128, times: i64) {
        *(if value > 0 { &mut self.positive } else { &mut self.negative }) += times;
    }
}

/// The column whose elimination makes the number of rows grow least.
fn next_column(signs: &[Signs]) -> Option<u32> {
    let used = (0_u32..).zip(signs).filter(|(_, signs)| signs.positive + signs.negative > 0);
    let growth = |signs: &Signs| signs.positive.saturating_mul(signs.negative) - signs.positive - signs.negative;
    used.min_by_key(|(_, signs)| growth(signs)).map(|(column, _)| column)
}

/// Replaces the rows that are not zero in a column by combinations that are.
fn eliminate(rows: &mut Rows, column: u32, eliminated: usize, budget: &mut Budget) -> Option<()> {
    let touched = rows.in_column(column);
    let live = rows.slots.len() - rows.free.len();
    let (positive, negative): (Vec<_>, Vec<_>) = touched.iter().partition(|(_, value)| *value > 0);
    let mut combined = Vec::new();
    for (plus, plus_value) in &positive {
        for (minus, minus_value) in &negative {
            if are_neighbours(rows, *plus, *minus, eliminated, budget)? {
                let (plus, minus) = rows.pair(*plus, *minus)?;
                combined.push(combine(plus, minus, *plus_value, *minus_value)?);
                budget.rows.checked_sub(live - touched.len() + combined.len())?;
            }
        }
    }
    touched.iter().for_each(|(slot, _)| rows.remove(*slot));
    combined.into_iter().for_each(|row| rows.insert(row));
    Some(())
}

/// Whether the smallest face of the cone with both rows is the one between them.
fn are_neighbours(rows: &Rows, a: u32, b: u32, eliminated: usize, budget: &mut Budget) -> Option<bool> {
    let (a_row, b_row) = rows.pair(a, b)?;
    let (a_support, b_support) = (&a_row.support, &b_row.support);
    let words = a_support.as_slice().len() + 1;
    budget.spend(words)?;
    // A face of dimension 2 leaves at most two unknowns more than there are equations.
    if a_support.union_count(b_support) > eliminated + 2 {
        return Some(false);
    }
    let both = a_support | b_support;
    let mut compared = 0;
    let third = (0_u32..).zip(&rows.slots).any(|(i, row)| {
        compared += usize::from(row.is_some());
        i != a && i != b && row.as_ref().is_some_and(|row| row.is_within(&both))
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

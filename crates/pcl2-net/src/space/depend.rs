//! Places whose tokens follow from those of other places.

use super::rules::Rules;

/// An equation that holds in every reachable marking: m(place) = constant + sum of factor m(other).
#[derive(Clone, Debug)]
pub(super) struct Dependence {
    pub(super) place: usize,
    pub(super) constant: i64,
    /// Independent places.
    pub(super) terms: Vec<(usize, i64)>,
}

/// Additions of matrix elements after which no more dependences are looked for.
const WORK: usize = 20_000_000;
/// Factors are at most this large.
const LARGEST: i64 = 1 << 31;

/// Finds dependences: rows of the incidence matrix that are integer combinations of earlier rows. Places come in the given
/// order, so late ones become dependent.
pub(super) fn find(rules: &Rules, initial: &[u64], order: &[usize]) -> Vec<Dependence> {
    let mut basis = Basis { rows: Vec::new(), work: 0 };
    let rows = rows(rules);
    let mut found = Vec::new();
    for place in order {
        if basis.work > WORK {
            break;
        }
        let combination = basis.add(*place, &rows[*place], rules.list.len(), rows.len());
        found.extend(combination.and_then(|terms| dependence(*place, &terms, initial)));
    }
    found
}

/// What the equations and capacities prove: the most tokens that each place can hold.
pub(super) fn bounds(found: &[Dependence], capacities: &[Option<u64>], initial: &[u64]) -> Vec<Option<u64>> {
    let mut bounds: Vec<Option<u64>> =
        capacities.iter().zip(initial).map(|(capacity, now)| capacity.map(|capacity| capacity.max(*now))).collect();
    let mut bound = |place: usize, most: u64| bounds[place] = Some(bounds[place].map_or(most, |known| known.min(most)));
    for dependence in found {
        // With no factor above 0, a sum of tokens is constant.
        let Ok(constant) = u64::try_from(dependence.constant) else { continue };
        if dependence.terms.iter().all(|(_, factor)| *factor < 0) {
            bound(dependence.place, constant);
            dependence.terms.iter().for_each(|(place, factor)| bound(*place, constant / factor.unsigned_abs()));
        }
    }
    bounds
}

/// The changes of each place by the transitions.
fn rows(rules: &Rules) -> Vec<Vec<(usize, i64)>> {
    let mut rows = vec![Vec::new(); rules.places];
    for (transition, rule) in rules.list.iter().enumerate() {
        for (place, change) in &rule.change {
            rows[*place].push((transition, *change));
        }
    }
    rows
}

fn dependence(place: usize, terms: &[(usize, i64)], initial: &[u64]) -> Option<Dependence> {
    let mut constant = i64::try_from(initial[place]).ok()?;
    for (other, factor) in terms {
        let share = i64::try_from(initial[*other]).ok()?.checked_mul(*factor)?;
        constant = constant.checked_sub(share)?;
    }
    Some(Dependence { place, constant, terms: terms.to_vec() })
}

struct Basis {
    rows: Vec<BasisRow>,
    work: usize,
}

/// A combination of rows of independent places, with 1 or -1 at its pivot.
struct BasisRow {
    pivot: usize,
    sign: i64,
    elements: Vec<(usize, i64)>,
    combination: Vec<(usize, i64)>,
}

impl Basis {
    /// Takes up a row, or says of which independent places it is a combination.
    fn add(
        &mut self,
        place: usize,
        row: &[(usize, i64)],
        transitions: usize,
        places: usize,
    ) -> Option<Vec<(usize, i64)>> {
        let (mut elements, mut combination) = (vec![0; transitions], vec![0; places]);
        row.iter().for_each(|(at, element)| elements[*at] = *element);
        self.work += transitions + places + self.rows.len();
        for known in &self.rows {
            let factor = elements[known.pivot].checked_mul(-known.sign)?;
            if factor != 0 {
                self.work += known.elements.len() + known.combination.len();
                add_multiple(&mut elements, factor, &known.elements)?;
                add_multiple(&mut combination, factor, &known.combination)?;
            }
        }
        let Some(pivot) = elements.iter().position(|element| element.abs() == 1) else {
            let vanished = elements.iter().all(|element| *element == 0);
            // row + combination = 0
            return vanished.then(|| sparse(&combination).map(|(at, factor)| (at, -factor)).collect());
        };
        combination[place] = 1;
        let sign = elements[pivot];
        let (elements, combination) = (sparse(&elements).collect(), sparse(&combination).collect());
        self.rows.push(BasisRow { pivot, sign, elements, combination });
        None
    }
}

fn sparse(row: &[i64]) -> impl Iterator<Item = (usize, i64)> + '_ {
    row.iter().copied().enumerate().filter(|(_, element)| *element != 0)
}

/// Adds a multiple of a sparse row; `None` if numbers get too large.
fn add_multiple(row: &mut [i64], factor: i64, other: &[(usize, i64)]) -> Option<()> {
    for (at, element) in other {
        let sum = row[*at].checked_add(element.checked_mul(factor)?)?;
        row[*at] = Some(sum).filter(|sum| sum.abs() < LARGEST)?;
    }
    Some(())
}

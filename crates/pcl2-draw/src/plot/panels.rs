//! Which signals share a panel: what has one unit and lies in one range, set points with what they are for. Switches
//! stand below each other, as in a timing diagram, and so do all boxes of a net.

use super::{Bucket, Role, Signal, range};

/// The most signals of a panel; as many as there are colours.
pub(super) const MOST: usize = 6;
/// Ranges that differ by more than this factor do not share a panel.
const FACTOR: f64 = 5.0;

/// Signals with one axis.
#[derive(Debug, PartialEq)]
pub(super) struct Panel {
    /// Indexes of signals.
    pub(super) signals: Vec<usize>,
    pub(super) kind: Kind,
    /// Of all good samples.
    pub(super) range: Option<(f64, f64)>,
}

/// How a panel is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Reals over one axis.
    Real,
    /// Ints over one axis.
    Whole,
    /// Ints that are 0 or 1, one below the other.
    Switches,
    /// The boxes of a net, one below the other.
    Tokens,
}

/// Divides signals into panels, in order of the first of each.
pub(super) fn panels(signals: &[Signal], buckets: &[Vec<Bucket>]) -> Vec<Panel> {
    let mut panels: Vec<Panel> = Vec::new();
    for (i, signal) in signals.iter().enumerate() {
        let range = range(&buckets[i]);
        let kind = kind(signal, range);
        let fits = |panel: &&mut Panel| {
            panel.kind == kind && (kind == Kind::Tokens || panel.signals.len() < MOST) && {
                let first = &signals[panel.signals[0]];
                let same = first.family == signal.family
                    && first.unit == signal.unit
                    && first.names == signal.names
                    && side(first) == side(signal);
                same && (kind.has_lanes() || side(signal).1.is_some() || share(panel.range, range))
            }
        };
        match panels.iter_mut().find(fits) {
            Some(panel) => {
                panel.signals.push(i);
                panel.range = union(panel.range, range);
            }
            None => panels.push(Panel { signals: vec![i], kind, range }),
        }
    }
    panels
}

impl Kind {
    /// Whether each signal has a lane of its own.
    pub(super) fn has_lanes(self) -> bool {
        match self {
            Kind::Switches | Kind::Tokens => true,
            Kind::Real | Kind::Whole => false,
        }
    }
}

fn kind(signal: &Signal, range: Option<(f64, f64)>) -> Kind {
    match range {
        _ if signal.tokens => Kind::Tokens,
        _ if !signal.whole => Kind::Real,
        Some((low, high)) if (low < 0.0 || high > 1.0) => Kind::Whole,
        _ if !signal.names.is_empty() => Kind::Whole,
        _ => Kind::Switches,
    }
}

/// Controllers' outputs stand apart from their inputs; the loops of one set point stand together.
fn side(signal: &Signal) -> (bool, Option<usize>) {
    match signal.role {
        Role::None => (false, None),
        Role::SetPoint(number) | Role::Measured(number) => (false, Some(number)),
        Role::Output => (true, None),
    }
}

fn union(a: Option<(f64, f64)>, b: Option<(f64, f64)>) -> Option<(f64, f64)> {
    match (a, b) {
        (Some(a), Some(b)) => Some((a.0.min(b.0), a.1.max(b.1))),
        (one, other) => one.or(other),
    }
}

/// Whether both can be read over one axis: neither is flattened by the other.
fn share(a: Option<(f64, f64)>, b: Option<(f64, f64)>) -> bool {
    let (Some(a), Some(b)) = (a, b) else {
        return true;
    };
    let both = a.1.max(b.1) - a.0.min(b.0);
    let spans = [a.1 - a.0, b.1 - b.0];
    let enough = |span: f64| span * FACTOR >= both;
    match spans.map(|span| span > 0.0) {
        [true, true] => spans.into_iter().all(enough),
        // Constants: near what moves, or of one size.
        [true, false] => enough(spans[0]),
        [false, true] => enough(spans[1]),
        [false, false] => both <= a.0.abs().max(b.0.abs()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signal(label: &str, whole: bool, unit: Option<&str>, role: Role) -> Signal {
        let (label, unit) = (label.to_owned(), unit.map(str::to_owned));
        Signal { label, family: None, whole, unit, names: Vec::new(), role, tokens: false }
    }

    fn samples(low: f64, high: f64) -> Vec<Bucket> {
        let mut buckets = vec![Bucket::EMPTY; 2];
        buckets[0].take(low);
        buckets[1].take(high);
        buckets
    }

    fn grouped(signals: &[Signal], ranges: &[(f64, f64)]) -> Vec<String> {
        let buckets: Vec<Vec<Bucket>> = ranges.iter().map(|(low, high)| samples(*low, *high)).collect();
        let names =
            |panel: Panel| panel.signals.iter().map(|i| signals[*i].label.clone()).collect::<Vec<_>>().join(" ");
        panels(signals, &buckets).into_iter().map(names).collect()
    }

    #[test]
    fn a_loop_has_a_panel_for_what_it_compares_and_one_for_what_it_does() {
        let roles = [Role::SetPoint(0), Role::Measured(0), Role::Output, Role::Measured(0), Role::Output];
        let signals: Vec<Signal> = ["w", "y1", "u1", "y2", "u2"]
            .iter()
            .zip(roles)
            .map(|(name, role)| signal(name, false, None, role))
            .collect();
        let ranges = [(0.0, 1.0), (0.0, 1.1), (-2.0, 3.0), (0.0, 0.01), (-1.0, 2.0)];
        assert_eq!(grouped(&signals, &ranges), ["w y1 y2", "u1 u2"]);
    }

    #[test]
    fn units_ranges_and_ints_stand_apart() {
        let signals = [
            signal("t", false, Some("degC"), Role::None),
            signal("p", false, Some("bar"), Role::None),
            signal("t2", false, Some("degC"), Role::None),
            signal("big", false, Some("degC"), Role::None),
            signal("on", true, None, Role::None),
            signal("count", true, None, Role::None),
            signal("off", true, None, Role::None),
        ];
        let ranges = [(20.0, 80.0), (1.0, 2.0), (30.0, 60.0), (0.0, 5000.0), (0.0, 1.0), (0.0, 90.0), (0.0, 0.0)];
        assert_eq!(grouped(&signals, &ranges), ["t t2", "p", "big", "on off", "count"]);
    }

    #[test]
    fn all_boxes_of_a_net_share_a_panel() {
        let place = |net: &str, label: &str| {
            let family = Some(net.to_owned());
            Signal { family, tokens: true, ..signal(label, true, None, Role::None) }
        };
        let mut signals: Vec<Signal> = (0..9).map(|i| place("N.box", &format!("N.s{i}"))).collect();
        signals.push(place("M.box", "M.s0"));
        let ranges = [(0.0, 1.0), (0.0, 7.0), (0.0, 1.0), (0.0, 0.0), (1.0, 1.0)].repeat(2);
        assert_eq!(grouped(&signals, &ranges), ["N.s0 N.s1 N.s2 N.s3 N.s4 N.s5 N.s6 N.s7 N.s8", "M.s0"]);
    }
}

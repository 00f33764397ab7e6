//! Axes: where a range begins and ends, and ticks at round numbers.

/// Ticks at multiples of 1, 2 or 5 times a power of ten.
pub(super) struct Ticks {
    /// Values and what is written at them.
    pub(super) marks: Vec<(f64, String)>,
}

/// A power of ten and a digit: 1, 2 or 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Step {
    digit: u8,
    power: i32,
}

/// The ticks of a range, at most about so many; for whole numbers none lie between them.
pub(super) fn ticks(low: f64, high: f64, most: u32, whole: bool) -> Ticks {
    let step = step((high - low) / f64::from(most.max(1)), whole);
    let size = step.size();
    let scientific = low.abs().max(high.abs()) >= 1e6 || step.power < -5;
    let first = (low / size - 1e-9).ceil();
    let mut marks = Vec::new();
    for i in 0..=2 * most {
        let value = (first + f64::from(i)) * size;
        if value > high + 1e-9 * size {
            break;
        }
        marks.push((value, label(value, step, scientific)));
    }
    Ticks { marks }
}

/// The least round step that is not smaller than this.
fn step(least: f64, whole: bool) -> Step {
    let text = format!("{least:e}");
    let (mantissa, power) = text.split_once('e').unwrap_or(("1", "0"));
    let mantissa: f64 = mantissa.parse().unwrap_or(1.0);
    let power: i32 = power.parse().unwrap_or(0);
    let step = match mantissa {
        ..=1.000_001 => Step { digit: 1, power },
        ..=2.000_001 => Step { digit: 2, power },
        ..=5.000_001 => Step { digit: 5, power },
        _ => Step { digit: 1, power: power + 1 },
    };
    if whole && step.power < 0 { Step { digit: 1, power: 0 } } else { step }
}

impl Step {
    fn size(self) -> f64 {
        format!("{}e{}", self.digit, self.power).parse().unwrap_or(1.0)
    }
}

fn label(value: f64, step: Step, scientific: bool) -> String {
    let value = if value.abs() < step.size() / 2.0 { 0.0 } else { value };
    if scientific && value == 0.0 {
        return "0".to_owned();
    }
    if scientific {
        let exponent = format!("{value:e}").split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0);
        let digits = usize::try_from(exponent - step.power).unwrap_or(0);
        return format!("{value:.digits$e}");
    }
    let digits = usize::try_from(-step.power).unwrap_or(0);
    format!("{value:.digits$}")
}

/// A range with some room around; a flat one with room enough to lie in the middle.
pub(super) fn roomy(low: f64, high: f64) -> (f64, f64) {
    let span = high - low;
    let size = low.abs().max(high.abs());
    let room = match span {
        _ if span > 1e-9 * size => 0.06 * span,
        _ if size > 0.0 => 0.1 * size,
        _ => 1.0,
    };
    (low - room, high + room)
}

/// A unit for times up to this many seconds, and how many seconds it has.
pub(super) fn unit_of_time(seconds: f64) -> (&'static str, f64) {
    match seconds {
        ..=0.1 => ("ms", 1e-3),
        ..=600.0 => ("s", 1.0),
        ..=36_000.0 => ("min", 60.0),
        ..=864_000.0 => ("h", 3600.0),
        _ => ("d", 86_400.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64, most: u32, whole: bool) -> Vec<String> {
        ticks(low, high, most, whole).marks.into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_stand_at_round_numbers() {
        assert_eq!(labels(0.0, 30.25, 10, false), ["0", "5", "10", "15", "20", "25", "30"]);
        assert_eq!(labels(-0.53, 1.06, 5, false), ["-0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(labels(0.0, 3.0, 6, true), ["0", "1", "2", "3"]);
        assert_eq!(labels(-0.06, 1.06, 5, true), ["0", "1"]);
        assert_eq!(labels(99.98, 100.03, 5, false), ["99.98", "99.99", "100.00", "100.01", "100.02", "100.03"]);
    }

    #[test]
    fn very_large_and_small_numbers_are_scientific() {
        assert_eq!(labels(0.0, 4e9, 4, false), ["0", "1e9", "2e9", "3e9", "4e9"]);
        assert_eq!(labels(0.0, 1.5e-6, 3, false), ["0", "5e-7", "1.0e-6", "1.5e-6"]);
        assert!(labels(-1e300, 1e300, 5, false).len() > 2);
    }

    #[test]
    fn a_flat_range_has_room() {
        assert_eq!(roomy(0.0, 0.0), (-1.0, 1.0));
        assert_eq!(roomy(50.0, 50.0), (45.0, 55.0));
    }
}

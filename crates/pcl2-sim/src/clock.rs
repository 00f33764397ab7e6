//! Times written as decimals, compared to scans without rounding.

/// A time as written, rounded up to whole nanoseconds. Scans start at whole nanoseconds, so "the first scan not
/// before this time" is the same for both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Instant(i128);

/// Why a text is no time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoInstant {
    /// It is no decimal number.
    Unreadable,
    /// It is beyond any run.
    TooLarge,
}

/// Digits beyond this many are only noticed, not counted.
const MAX_DIGITS: usize = 30;

impl Instant {
    /// Reads seconds: `[+-] digits [. digits] [e [+-] digits]`.
    pub fn parse(text: &str) -> Result<Instant, NoInstant> {
        let (negative, rest) = match text.as_bytes().first() {
            Some(b'-') => (true, &text[1..]),
            Some(b'+') => (false, &text[1..]),
            _ => (false, text),
        };
        let (magnitude, inexact) = nanoseconds(rest)?;
        Ok(Instant(if negative { -magnitude } else { magnitude + i128::from(inexact) }))
    }

    /// The first scan k with k T not before this time.
    pub fn scan(self, period: i64) -> Option<u64> {
        let period = i128::from(period.max(1));
        let nanoseconds = self.0.max(0);
        u64::try_from((nanoseconds + period - 1) / period).ok()
    }

    /// Whether the time lies before the first scan.
    pub fn is_negative(self) -> bool {
        self.0 < 0
    }
}

/// Reads a period: seconds above 0, in whole nanoseconds.
pub fn period(text: &str) -> Option<i64> {
    let (magnitude, inexact) = nanoseconds(text.strip_prefix('+').unwrap_or(text)).ok()?;
    i64::try_from(magnitude).ok().filter(|period| *period > 0 && !inexact)
}

/// Seconds without a sign in nanoseconds, cut to a whole number, and whether something was cut off.
fn nanoseconds(text: &str) -> Result<(i128, bool), NoInstant> {
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent_of(exponent)?),
        None => (text, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: Vec<u8> = whole.bytes().chain(fraction.bytes()).collect();
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return Err(NoInstant::Unreadable);
    }
    scaled(&digits, exponent + 9 - fraction.len() as i64).ok_or(NoInstant::TooLarge)
}

fn exponent_of(text: &str) -> Result<i64, NoInstant> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return Err(NoInstant::Unreadable);
    }
    let magnitude = digits.bytes().fold(0_i64, |sum, digit| (sum * 10 + i64::from(digit - b'0')).min(1_000_000));
    Ok(if text.starts_with('-') { -magnitude } else { magnitude })
}

/// `digits` times 10^`power`, cut to a whole number, and whether something was cut off.
fn scaled(digits: &[u8], power: i64) -> Option<(i128, bool)> {
    let first = digits.iter().position(|digit| *digit != b'0').unwrap_or(digits.len());
    let digits = &digits[first..];
    let kept = &digits[..digits.len().min(MAX_DIGITS)];
    let mut inexact = digits[kept.len()..].iter().any(|digit| *digit != b'0');
    let mut value = kept.iter().fold(0_i128, |sum, digit| sum * 10 + i128::from(digit - b'0'));
    let mut power = power + (digits.len() - kept.len()) as i64;
    while power < 0 && value != 0 {
        inexact |= value % 10 != 0;
        value /= 10;
        power += 1;
    }
    while power > 0 && value != 0 {
        value = value.checked_mul(10).filter(|value| *value < i128::MAX / 20)?;
        power -= 1;
    }
    Some((value, inexact))
}

/// `scan` periods as seconds, exactly: `0`, `0.25`, `12`.
pub fn seconds(scan: u64, period: i64) -> String {
    const SECOND: u128 = 1_000_000_000;
    let nanoseconds = u128::from(scan) * u128::from(period.unsigned_abs());
    let (whole, rest) = (nanoseconds / SECOND, nanoseconds % SECOND);
    if rest == 0 {
        return whole.to_string();
    }
    let digits = format!("{rest:09}");
    format!("{whole}.{}", digits.trim_end_matches('0'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scan(text: &str, period: i64) -> Option<u64> {
        Instant::parse(text).ok()?.scan(period)
    }

    #[test]
    fn the_first_scan_at_or_after_a_time() {
        assert_eq!(scan("0.3", 100_000_000), Some(3));
        assert_eq!(scan("0.30000000001", 100_000_000), Some(4));
        assert_eq!(scan("0.3000000000000000000000000000000000000000000001", 100_000_000), Some(4));
        assert_eq!(scan("3e-1", 100_000_000), Some(3));
        assert_eq!(scan("1.", 250_000_000), Some(4));
        assert_eq!(scan(".6", 250_000_000), Some(3));
        assert_eq!(scan("0", 250_000_000), Some(0));
        assert_eq!(scan("-1.5", 250_000_000), Some(0));
        assert_eq!(scan("00000.000", 1), Some(0));
        assert_eq!(scan("1e9", 1), Some(1_000_000_000_000_000_000));
        assert_eq!(scan("1e-400", 7), Some(1));
    }

    #[test]
    fn what_is_no_time() {
        for text in ["", ".", "-", "1e", "1e+", "nan", "inf", "1,5", "0x10", "1 2", "e5"] {
            assert_eq!(Instant::parse(text), Err(NoInstant::Unreadable), "{text}");
        }
        assert_eq!(Instant::parse("1e30"), Err(NoInstant::TooLarge));
        assert_eq!(scan("1e20", 1), None);
    }

    #[test]
    fn periods_are_whole_nanoseconds_above_zero() {
        assert_eq!(period("0.25"), Some(250_000_000));
        assert_eq!(period("1e-9"), Some(1));
        assert_eq!(period("0.10"), Some(100_000_000));
        for text in ["0", "-1", "1e-10", "1.0000000005", "1e10", "ten", ""] {
            assert_eq!(period(text), None, "{text}");
        }
    }

    #[test]
    fn times_of_scans_are_exact_decimals() {
        assert_eq!(seconds(0, 250_000_000), "0");
        assert_eq!(seconds(1, 250_000_000), "0.25");
        assert_eq!(seconds(4, 250_000_000), "1");
        assert_eq!(seconds(3, 1), "0.000000003");
        assert_eq!(seconds(u64::MAX, 1_000_000_000), "18446744073709551615");
    }
}

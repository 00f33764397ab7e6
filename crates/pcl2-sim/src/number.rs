//! Values of single elements: how they are read from stimulus text and written into traces.

use pcl2_lang::types::{Real, Scalar, Width};
use std::fmt;
use std::str::FromStr;

/// One element of a point, in the width of the program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// An int.
    Int(i32),
    /// A real of a program with `--real f64`.
    Double(f64),
    /// A real of a program with `--real f32`.
    Single(f32),
    /// Nanoseconds.
    Time(i64),
}

impl Number {
    /// The value as a double, for drawing.
    pub fn to_f64(self) -> f64 {
        match self {
            Number::Int(value) => f64::from(value),
            Number::Double(value) => value,
            Number::Single(value) => f64::from(value),
            Number::Time(value) => value as f64,
        }
    }

    /// The value as a literal of both widths.
    pub fn to_real(self) -> Real {
        match self {
            Number::Int(value) => Real::from_int(value),
            Number::Double(wide) => Real { wide, narrow: wide as f32 },
            Number::Single(narrow) => Real { wide: f64::from(narrow), narrow },
            Number::Time(value) => Real { wide: value as f64, narrow: value as f32 },
        }
    }

    /// A real in a width.
    pub fn of_real(real: Real, width: Width) -> Number {
        match width {
            Width::F64 => Number::Double(real.wide),
            Width::F32 => Number::Single(real.narrow),
        }
    }
}

/// Ints as ints; reals as the shortest decimal that reads back in their width; `nan`, `inf`, `-inf`, `-0.0`.
impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Number::Int(value) => write!(f, "{value}"),
            Number::Time(value) => write!(f, "{value}"),
            Number::Double(value) if value.is_nan() => write!(f, "nan"),
            Number::Single(value) if value.is_nan() => write!(f, "nan"),
            Number::Double(value) => write!(f, "{value:?}"),
            Number::Single(value) => write!(f, "{value:?}"),
        }
    }
}

/// Reads the value of one cell. `names` are those of an enumeration.
pub fn parse(text: &str, scalar: Scalar, width: Width, names: &[String]) -> Result<Number, String> {
    match scalar {
        Scalar::Int => parse_int(text, names),
        Scalar::Real => match width {
            Width::F64 => parse_real::<f64>(text, f64::is_infinite).map(Number::Double),
            Width::F32 => parse_real::<f32>(text, f32::is_infinite).map(Number::Single),
        },
    }
}

fn parse_int(text: &str, names: &[String]) -> Result<Number, String> {
    if let Some(value) = names.iter().position(|name| name == text) {
        return Ok(Number::Int(value as i32));
    }
    text.parse().map(Number::Int).map_err(|_| match names {
        [] => format!("expected an int, found `{text}`"),
        names => format!("expected an int or one of {}, found `{text}`", names.join(", ")),
    })
}

/// Each width is read from the decimal text itself: one rounding.
fn parse_real<T: FromStr + Copy>(text: &str, is_infinite: impl Fn(T) -> bool) -> Result<T, String> {
    let value: T = text.parse().map_err(|_| format!("expected a number, found `{text}`"))?;
    let written = text.bytes().any(|byte| byte.is_ascii_digit());
    if is_infinite(value) && written { Err(format!("`{text}` does not fit a real")) } else { Ok(value) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn real(text: &str, width: Width) -> Result<String, String> {
        parse(text, Scalar::Real, width, &[]).map(|number| number.to_string())
    }

    #[test]
    fn reals_keep_their_shortest_form() {
        let same = ["0.1", "-0.0", "1.397082222306872", "1e300", "5e-324", "nan", "inf", "-inf", "1e16", "123456.0"];
        for text in same {
            assert_eq!(real(text, Width::F64).as_deref(), Ok(text));
        }
        assert_eq!(real("0.1", Width::F32).as_deref(), Ok("0.1"));
        assert_eq!(real("16777217", Width::F32).as_deref(), Ok("16777216.0"));
        assert_eq!(real("-NaN", Width::F64).as_deref(), Ok("nan"));
        assert_eq!(real("100.", Width::F64).as_deref(), Ok("100.0"));
        assert_eq!(real("3", Width::F64).as_deref(), Ok("3.0"));
    }

    #[test]
    fn what_is_no_real() {
        assert!(real("1e999", Width::F64).is_err());
        assert!(real("1e39", Width::F32).is_err());
        assert!(real("1e39", Width::F64).is_ok());
        for text in ["", "1,5", "one", "0x1p3", "1 2"] {
            assert!(real(text, Width::F64).is_err(), "{text}");
        }
    }

    #[test]
    fn ints_and_the_names_of_enumerations() {
        let names = ["man".to_owned(), "auto".to_owned()];
        let int = |text: &str| parse(text, Scalar::Int, Width::F64, &names);
        assert_eq!(int("auto"), Ok(Number::Int(1)));
        assert_eq!(int("-7"), Ok(Number::Int(-7)));
        assert_eq!(int("-0"), Ok(Number::Int(0)));
        assert_eq!(int("1.0"), Err("expected an int or one of man, auto, found `1.0`".to_owned()));
        assert!(int("2147483648").is_err());
        assert!(int("Auto").is_err());
    }
}

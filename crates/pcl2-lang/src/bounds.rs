//! Declared ranges: one rule at compile time and when an operator changes a parameter.

use crate::decl::{Bounds, Decl, Expr, Tail};
use crate::types::{Value, Width};

/// A value that its declaration refuses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// The parameter's index.
    pub param: usize,
    /// The element, counted from 0.
    pub element: usize,
    /// What was expected, in the declaration's terms with numbers filled in: `from 0.`.
    pub expected: String,
    /// What was found.
    pub found: String,
}

/// Checks all parameters of one block against their declared ranges. Non-finite values are refused.
pub fn check(decl: &Decl, sizes: &[i32], values: &[Value], width: Width) -> Result<(), Violation> {
    for (param, value) in values.iter().enumerate() {
        let tail = &decl.params[param].tail;
        for element in 0..elements(value) {
            let Some(number) = number(value, element, width) else {
                continue;
            };
            let expected = violated(tail, number, sizes, Some((values, width)));
            if let Some(expected) = expected {
                return Err(Violation { param, element, expected, found: show(number) });
            }
        }
    }
    Ok(())
}

/// Checks one integer constant; `Some` says what was expected.
pub fn check_constant(bounds: Option<&Bounds>, value: i64, sizes: &[i32]) -> Option<String> {
    let tail = Tail { unit: None, bounds: bounds.cloned(), names: Vec::new() };
    violated(&tail, value as f64, sizes, None)
}

/// Checks one value against the tail of a place, such as an operator cell's port; `Some` says what was expected.
pub fn check_value(tail: &Tail, value: f64, sizes: &[i32]) -> Option<String> {
    violated(tail, value, sizes, None)
}

fn violated(tail: &Tail, number: f64, sizes: &[i32], values: Option<(&[Value], Width)>) -> Option<String> {
    if !number.is_finite() {
        return Some("a finite number".to_owned());
    }
    if !tail.names.is_empty() && !(0.0..tail.names.len() as f64).contains(&number) {
        return Some(format!("one of {}", tail.names.join(", ")));
    }
    let bounds = tail.bounds.as_ref()?;
    let lower = bounds.lower.as_ref().and_then(|expr| evaluate(expr, sizes, values));
    let upper = bounds.upper.as_ref().and_then(|expr| evaluate(expr, sizes, values));
    let below = lower.is_some_and(|lower| number < lower || (bounds.above && number == lower));
    let over = upper.is_some_and(|upper| number > upper);
    (below || over).then(|| describe(bounds, lower, upper))
}

fn describe(bounds: &Bounds, lower: Option<f64>, upper: Option<f64>) -> String {
    let word = if bounds.above { "above" } else { "from" };
    let lower = lower.map(|value| format!("{word} {}", show(value)));
    let upper = upper.map(|value| format!("to {}", show(value)));
    [lower, upper].into_iter().flatten().collect::<Vec<_>>().join(" ")
}

pub(crate) fn show(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 { format!("{value:.0}") } else { format!("{value:?}") }
}

/// A bound's value. `None` when something it needs is not known.
pub fn evaluate(expr: &Expr, sizes: &[i32], values: Option<(&[Value], Width)>) -> Option<f64> {
    let both = |a: &Expr, b: &Expr| Some((evaluate(a, sizes, values)?, evaluate(b, sizes, values)?));
    match expr {
        Expr::Int(value) => Some(f64::from(*value)),
        Expr::Real(value) => Some(match values {
            Some((_, Width::F32)) => f64::from(value.narrow),
            Some((_, Width::F64)) | None => value.wide,
        }),
        Expr::Size(index) => sizes.get(*index).map(|value| f64::from(*value)),
        Expr::Param(index) => values.and_then(|(values, width)| number(values.get(*index)?, 0, width)),
        Expr::Negate(a) => evaluate(a, sizes, values).map(|a| -a),
        Expr::Add(a, b) => both(a, b).map(|(a, b)| a + b),
        Expr::Subtract(a, b) => both(a, b).map(|(a, b)| a - b),
        Expr::Multiply(a, b) => both(a, b).map(|(a, b)| a * b),
        Expr::Divide(a, b) => both(a, b).map(|(a, b)| a / b),
    }
}

fn elements(value: &Value) -> usize {
    match value {
        Value::Int(_) | Value::Real(_) => 1,
        Value::Ints(values) => values.len(),
        Value::Reals(values) => values.len(),
        Value::Text(_) => 0,
    }
}

fn number(value: &Value, element: usize, width: Width) -> Option<f64> {
    let real = |real: &crate::types::Real| match width {
        Width::F32 => f64::from(real.narrow),
        Width::F64 => real.wide,
    };
    match value {
        Value::Int(value) => Some(f64::from(*value)),
        Value::Real(value) => Some(real(value)),
        Value::Ints(values) => values.get(element).map(|value| f64::from(*value)),
        Value::Reals(values) => values.get(element).map(real),
        Value::Text(_) => None,
    }
}

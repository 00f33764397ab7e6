//! Types, ranges, values and rules in words.

use crate::decl::{BadRule, Bounds, Decl, Expr, Tail, TypeExpr};
use crate::types::{Real, Scalar, Value};

pub(super) fn type_text(decl: &Decl, ty: &TypeExpr) -> String {
    let name = |scalar: &Scalar, shape: &str| match scalar {
        Scalar::Int => format!("i{shape}"),
        Scalar::Real => shape.to_owned(),
    };
    match ty {
        TypeExpr::Scalar(Scalar::Int) => "int".to_owned(),
        TypeExpr::Scalar(Scalar::Real) => "real".to_owned(),
        TypeExpr::Vector(scalar, n) => format!("{}[{}]", name(scalar, "vec"), expr_text(decl, n)),
        TypeExpr::Matrix(scalar, r, c) => {
            format!("{}[{},{}]", name(scalar, "mat"), expr_text(decl, r), expr_text(decl, c))
        }
        TypeExpr::Text => "text".to_owned(),
        TypeExpr::Time => "time".to_owned(),
    }
}

pub(super) fn expr_text(decl: &Decl, expr: &Expr) -> String {
    let pair = |a: &Expr, sign: &str, b: &Expr| format!("{}{sign}{}", factor(decl, a), factor(decl, b));
    match expr {
        Expr::Int(value) => value.to_string(),
        Expr::Real(value) => real(*value),
        Expr::Size(i) => decl.sizes[*i].name.clone(),
        Expr::Param(i) => decl.params[*i].name.clone(),
        Expr::Negate(a) => format!("-{}", factor(decl, a)),
        Expr::Add(a, b) => format!("{}+{}", expr_text(decl, a), expr_text(decl, b)),
        Expr::Subtract(a, b) => format!("{}-{}", expr_text(decl, a), factor(decl, b)),
        Expr::Multiply(a, b) => pair(a, "*", b),
        Expr::Divide(a, b) => pair(a, "/", b),
    }
}

/// A sum stands in parentheses.
fn factor(decl: &Decl, expr: &Expr) -> String {
    let text = expr_text(decl, expr);
    match expr {
        Expr::Add(..) | Expr::Subtract(..) => format!("({text})"),
        Expr::Int(_) | Expr::Real(_) | Expr::Size(_) | Expr::Param(_) => text,
        Expr::Negate(_) | Expr::Multiply(..) | Expr::Divide(..) => text,
    }
}

/// `from 0 to umax`
pub fn range(decl: &Decl, bounds: Option<&Bounds>) -> String {
    let Some(bounds) = bounds else {
        return String::new();
    };
    let word = if bounds.above { "above" } else { "from" };
    let lower = bounds.lower.as_ref().map(|expr| format!("{word} {}", expr_text(decl, expr)));
    let upper = bounds.upper.as_ref().map(|expr| format!("to {}", expr_text(decl, expr)));
    [lower, upper].into_iter().flatten().collect::<Vec<_>>().join(" ")
}

/// A range, or the names of an enumeration.
pub(super) fn limits(decl: &Decl, tail: &Tail) -> String {
    if tail.names.is_empty() { range(decl, tail.bounds.as_ref()) } else { tail.names.join(", ") }
}

/// A number as sources write it, or by its name; `..` for many.
pub fn value_text(value: &Value, tail: &Tail) -> String {
    match value {
        Value::Int(value) => match usize::try_from(*value).ok().and_then(|index| tail.names.get(index)) {
            Some(name) => name.clone(),
            None => value.to_string(),
        },
        Value::Real(value) => real(*value),
        Value::Ints(_) | Value::Reals(_) => "..".to_owned(),
        Value::Text(text) => format!("{text:?}"),
    }
}

/// As sources write it: `2.`, `1e-7`, `bad`.
fn real(value: Real) -> String {
    if !value.wide.is_finite() {
        return "bad".to_owned();
    }
    let text = format!("{:?}", value.wide);
    text.strip_suffix(".0").map_or(text.clone(), |whole| format!("{whole}."))
}

/// What a code does with a bad signal.
pub(super) fn bad_text(rule: BadRule) -> &'static str {
    match rule {
        BadRule::Algebraic => "A bad input gives a bad output (rule A).",
        BadRule::Hold => "While an input is bad, the state is frozen and the output held (rule H).",
        BadRule::Select => "Bad inputs are left out; when all are bad, the output is held (rule S).",
        BadRule::Manual => {
            "While a measurement is bad, the output is held; the controller sheds after a time (rule M)."
        }
        BadRule::Freeze => "While an input is bad, the adaptation is frozen and the last parameters stay (rule F).",
        BadRule::Logic => "Ints are never bad (rule L).",
        BadRule::Output => "A bad value is never written; the last good one stays (rule O).",
    }
}

/// `a`, `a and b`, `a, b and c`
pub(super) fn list(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}

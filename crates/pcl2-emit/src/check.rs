//! Declared ranges as C tests.

use crate::args::{Call, Caller};
use crate::code::place_elements;
use crate::facts::element_scalar;
use crate::statics::Statics;
use crate::text;
use pcl2_lang::decl::{Bounds, Expr, Tail};
use pcl2_lang::program::Param;
use pcl2_lang::types::{Real, Scalar, Width};
use std::fmt::Write;

/// Writes a `return` for each parameter of a block that is out of its declared range.
pub(crate) fn ranges(out: &mut String, statics: &mut Statics, call: &Call<'_, '_>) {
    for (i, declared) in call.code().decl.params.iter().enumerate() {
        let elements = place_elements(&declared.ty, &call.block().sizes);
        if elements == 0 || !can_change(call, i) {
            continue;
        }
        let mut value = String::new();
        call.param(&mut value, statics, i);
        let operand = |out: &mut String, statics: &mut Statics, param: usize| operand(out, statics, call, param);
        let place = Checked { tail: &declared.tail, scalar: element_scalar(&declared.ty), number: i + 1 };
        let count = (!declared.ty.is_scalar()).then_some(elements);
        range(out, statics, &place, &value, count, &call.block().sizes, call.cx.program.width, &operand);
    }
}

/// Whether a parameter, or one that its range refers to, is more than a literal here.
fn can_change(call: &Call<'_, '_>, index: usize) -> bool {
    let declared = &call.code().decl.params[index];
    let mut refers = Vec::new();
    for expr in declared.tail.bounds.iter().flat_map(|bounds| [&bounds.lower, &bounds.upper]).flatten() {
        collect_params(expr, &mut refers);
    }
    refers.push(index);
    refers.into_iter().any(|index| match call.caller {
        Caller::Body(_) => matches!(call.block().params[index], Param::Own(_)),
        Caller::Adapter | Caller::Step(_) | Caller::Init(_) => !call.code().decl.params[index].fixed,
    })
}

/// The parameters that a bound refers to.
pub(crate) fn collect_params(expr: &Expr, params: &mut Vec<usize>) {
    match expr {
        Expr::Int(_) | Expr::Real(_) | Expr::Size(_) => {}
        Expr::Param(index) => params.push(*index),
        Expr::Negate(a) => collect_params(a, params),
        Expr::Add(a, b) | Expr::Subtract(a, b) | Expr::Multiply(a, b) | Expr::Divide(a, b) => {
            collect_params(a, params);
            collect_params(b, params);
        }
    }
}

/// The first element of a parameter, as an operand of a bound.
fn operand(out: &mut String, statics: &mut Statics, call: &Call<'_, '_>, param: usize) -> Scalar {
    call.param(out, statics, param);
    let ty = &call.code().decl.params[param].ty;
    if !ty.is_scalar() {
        out.push_str("[0]");
    }
    element_scalar(ty)
}

/// Writes a parameter as an operand; says which number type it has.
pub(crate) type Operand<'o> = dyn Fn(&mut String, &mut Statics, usize) -> Scalar + 'o;

/// A place with a range.
pub(crate) struct Checked<'t> {
    /// The range.
    pub(crate) tail: &'t Tail,
    /// The number type.
    pub(crate) scalar: Scalar,
    /// What a refusal returns, negated.
    pub(crate) number: usize,
}

/// Writes the test of one place; `count` for arrays.
#[expect(clippy::too_many_arguments, reason = "a plain function over what one test reads")]
pub(crate) fn range(
    out: &mut String,
    statics: &mut Statics,
    place: &Checked<'_>,
    value: &str,
    count: Option<usize>,
    sizes: &[i32],
    width: Width,
    operand: &Operand<'_>,
) {
    let element = if count.is_some() { format!("{value}[i]") } else { value.to_owned() };
    let mut tests = Vec::new();
    if !place.tail.names.is_empty() {
        tests.push(format!("{element} < 0 || {element} >= {}", place.tail.names.len()));
    }
    if let Some(bounds) = &place.tail.bounds {
        let terms = Terms { sizes, width, operand };
        tests.extend(bound_tests(statics, bounds, place.scalar, &element, &terms));
    }
    if tests.is_empty() {
        return;
    }
    let tests = tests.join(" || ");
    let _ = match count {
        None => writeln!(out, "    if ({tests}) {{\n        return -{};\n    }}", place.number),
        Some(count) => writeln!(
            out,
            "    for (int32_t i = 0; i < {count}; i++) {{\n        if ({tests}) {{\n            return -{};\n        }}\n    }}",
            place.number
        ),
    };
}

struct Terms<'t> {
    sizes: &'t [i32],
    width: Width,
    operand: &'t Operand<'t>,
}

/// The comparisons fail for what is not a number.
fn bound_tests(
    statics: &mut Statics,
    bounds: &Bounds,
    scalar: Scalar,
    element: &str,
    terms: &Terms<'_>,
) -> Vec<String> {
    let mut tests = Vec::new();
    let lower = if bounds.above { ">" } else { ">=" };
    for (sign, bound) in [(lower, &bounds.lower), ("<=", &bounds.upper)] {
        let Some(bound) = bound else {
            continue;
        };
        let mut limit = String::new();
        let found = term(&mut limit, statics, bound, scalar, terms);
        let left = match (scalar, found) {
            (Scalar::Int, Scalar::Real) => format!("(pcl2_real){element}"),
            (Scalar::Int | Scalar::Real, _) => element.to_owned(),
        };
        tests.push(format!("!({left} {sign} {limit})"));
    }
    tests
}

/// Writes a bound in this number type, or in reals when it needs them.
fn term(out: &mut String, statics: &mut Statics, expr: &Expr, want: Scalar, terms: &Terms<'_>) -> Scalar {
    let mut whole = String::new();
    if want == Scalar::Int && whole_term(&mut whole, statics, expr, terms) {
        out.push_str(&whole);
        return Scalar::Int;
    }
    real_term(out, statics, expr, terms);
    Scalar::Real
}

fn whole_term(out: &mut String, statics: &mut Statics, expr: &Expr, terms: &Terms<'_>) -> bool {
    match expr {
        Expr::Int(value) => {
            let _ = write!(out, "INT64_C({value})");
            true
        }
        Expr::Size(index) => {
            let _ = write!(out, "INT64_C({})", terms.sizes[*index]);
            true
        }
        Expr::Param(index) => {
            out.push_str("(int64_t)");
            (terms.operand)(out, statics, *index) == Scalar::Int
        }
        Expr::Real(_) | Expr::Divide(..) => false,
        Expr::Negate(a) => {
            out.push_str("(-");
            let whole = whole_term(out, statics, a, terms);
            out.push(')');
            whole
        }
        Expr::Add(a, b) | Expr::Subtract(a, b) | Expr::Multiply(a, b) => {
            out.push('(');
            let left = whole_term(out, statics, a, terms);
            let _ = write!(out, " {} ", sign(expr));
            let right = whole_term(out, statics, b, terms);
            out.push(')');
            left && right
        }
    }
}

fn real_term(out: &mut String, statics: &mut Statics, expr: &Expr, terms: &Terms<'_>) {
    match expr {
        Expr::Int(value) => text::real(out, Real::from_int(*value), terms.width),
        Expr::Real(value) => text::real(out, *value, terms.width),
        Expr::Size(index) => text::real(out, Real::from_int(terms.sizes[*index]), terms.width),
        Expr::Param(index) => {
            let start = out.len();
            if (terms.operand)(out, statics, *index) == Scalar::Int {
                out.insert_str(start, "(pcl2_real)");
            }
        }
        Expr::Negate(a) => {
            out.push_str("(-");
            real_term(out, statics, a, terms);
            out.push(')');
        }
        Expr::Add(a, b) | Expr::Subtract(a, b) | Expr::Multiply(a, b) | Expr::Divide(a, b) => {
            out.push('(');
            real_term(out, statics, a, terms);
            let _ = write!(out, " {} ", sign(expr));
            real_term(out, statics, b, terms);
            out.push(')');
        }
    }
}

fn sign(expr: &Expr) -> &'static str {
    match expr {
        Expr::Add(..) => "+",
        Expr::Subtract(..) => "-",
        Expr::Multiply(..) => "*",
        Expr::Divide(..) => "/",
        Expr::Int(_) | Expr::Real(_) | Expr::Size(_) | Expr::Param(_) | Expr::Negate(_) => "",
    }
}

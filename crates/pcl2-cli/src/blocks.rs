//! `pcl2 blocks`

use crate::args::{BlocksArgs, CommonArgs};
use crate::console;
use crate::outcome::Outcome;
use crate::project;
use pcl2_lang::catalogue::Catalogue;
use pcl2_lang::decl::{BadRule, Bounds, Decl, Expr, Item, Tail, TypeExpr};
use pcl2_lang::suggest;
use pcl2_lang::types::{Scalar, Value};
use std::fmt::Write;

/// Lists the catalogue, or describes one function code.
pub(crate) fn blocks(args: &BlocksArgs) -> Outcome {
    let common = CommonArgs { blocks: args.blocks.clone(), ..CommonArgs::default() };
    let Some(catalogue) = project::catalogue(&common) else {
        return Outcome::Errors;
    };
    match &args.name {
        None => {
            console::out(&list(&catalogue));
            Outcome::Done
        }
        Some(name) => describe(&catalogue, name),
    }
}

fn list(catalogue: &Catalogue) -> String {
    let mut text = String::new();
    let mut group = None;
    for decl in catalogue.decls() {
        if group != Some(&decl.group) {
            let title = if decl.group.is_empty() { "your own" } else { &decl.group };
            let _ = writeln!(text, "{}{title}", if text.is_empty() { "" } else { "\n" });
            group = Some(&decl.group);
        }
        let _ = writeln!(text, "  {:10} {}", decl.name, summary(decl));
    }
    text
}

/// The first sentence of the comment.
fn summary(decl: &Decl) -> String {
    let joined = decl.doc.lines().take_while(|line| !line.trim().is_empty()).collect::<Vec<_>>().join(" ");
    match joined.find(". ") {
        Some(end) => joined[..=end].to_owned(),
        None => joined,
    }
}

fn describe(catalogue: &Catalogue, name: &str) -> Outcome {
    let Some(decl) = catalogue.find(name) else {
        let help = suggest::help(name, catalogue.decls().map(|decl| decl.name.as_str()));
        let help = help.unwrap_or_else(|| "`pcl2 blocks` lists them".to_owned());
        console::error(&format!("no function code is called `{name}`; {help}"));
        return Outcome::Usage;
    };
    console::out(&page(decl));
    Outcome::Done
}

/// The manual page of one function code.
pub(crate) fn page(decl: &Decl) -> String {
    let mut text = format!("{}\n\n", signature(decl));
    for line in decl.doc.lines() {
        let _ = writeln!(text, "  {line}");
    }
    section(&mut text, "Inputs", inputs(decl));
    section(&mut text, "Parameters", parameters(decl));
    section(&mut text, "Outputs", outputs(decl));
    section(&mut text, "Rules", rules(decl));
    for example in &decl.examples {
        let period = example.period.as_ref().map(|period| format!(", period {period} s")).unwrap_or_default();
        let _ = writeln!(
            text,
            "\nExample (after {} scans{period}: {} = {})",
            example.after,
            example.signal,
            example.values.join(", ")
        );
        for line in example.program.lines().filter(|line| line.trim() != "END") {
            let _ = writeln!(text, "  {}", line.trim_start());
        }
    }
    text
}

/// `y = first ( u : a, b, x0 )`
pub(crate) fn signature(decl: &Decl) -> String {
    let outputs: Vec<String> =
        decl.outputs.iter().map(|o| if o.group.is_some() { format!("{}..", o.name) } else { o.name.clone() }).collect();
    let items: Vec<String> = decl
        .items
        .iter()
        .map(|item| match item {
            Item::Literal(value) => value.to_string(),
            Item::Constant(constant) => constant.name.clone(),
            Item::Port(port) if port.group.is_some() => format!("{}..", port.name),
            Item::Port(port) if port.default.is_some() => format!("[{}]", port.name),
            Item::Port(port) => port.name.clone(),
        })
        .collect();
    let params: Vec<&str> = decl.params.iter().map(|param| param.name.as_str()).collect();
    format!("{} = {} ( {} : {} )", outputs.join(", "), decl.name, items.join(", "), params.join(", "))
}

fn section(text: &mut String, title: &str, rows: Vec<[String; 4]>) {
    if rows.is_empty() {
        return;
    }
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let (a, b, c) = (width(0), width(1), width(2));
    let _ = writeln!(text, "\n{title}");
    for [name, ty, default, note] in rows {
        let line = format!("  {name:a$}  {ty:b$}  {default:c$}  {note}");
        let _ = writeln!(text, "{}", line.trim_end());
    }
}

fn inputs(decl: &Decl) -> Vec<[String; 4]> {
    let row = |item: &Item| match item {
        Item::Literal(value) => [value.to_string(), "written so".to_owned(), String::new(), String::new()],
        Item::Constant(constant) => {
            [constant.name.clone(), "constant".to_owned(), String::new(), range(decl, constant.bounds.as_ref())]
        }
        Item::Port(port) => {
            let default = port.default.as_ref().map(|value| format!("= {}", value_text(value, &port.tail)));
            let mut note = tail(decl, &port.tail);
            if port.cell {
                note.push_str(" operator cell");
            }
            if let Some(tracks) = &port.tracks {
                let _ = write!(note, ", tracks {tracks}");
            }
            [port.name.clone(), type_text(decl, &port.ty), default.unwrap_or_default(), note.trim().to_owned()]
        }
    };
    decl.items.iter().map(row).collect()
}

fn parameters(decl: &Decl) -> Vec<[String; 4]> {
    let row = |param: &pcl2_lang::decl::ParamDecl| {
        let default = param.default.as_ref().map(|value| format!("= {}", value_text(value, &param.tail)));
        let fixed = if param.fixed { " fixed" } else { "" };
        let note = format!("{}{fixed}", tail(decl, &param.tail));
        [param.name.clone(), type_text(decl, &param.ty), default.unwrap_or_default(), note.trim().to_owned()]
    };
    decl.params.iter().map(row).collect()
}

fn outputs(decl: &Decl) -> Vec<[String; 4]> {
    let row = |output: &pcl2_lang::decl::OutputDecl| {
        let inout = if output.inout { " changed in place" } else { "" };
        let note = format!("{}{inout}", tail(decl, &output.tail));
        [output.name.clone(), type_text(decl, &output.ty), String::new(), note.trim().to_owned()]
    };
    decl.outputs.iter().map(row).collect()
}

fn rules(decl: &Decl) -> Vec<[String; 4]> {
    let mut rows = Vec::new();
    let mut row = |name: &str, text: String| rows.push([name.to_owned(), text, String::new(), String::new()]);
    if let Some(bad) = decl.bad {
        row("bad signal", bad_text(bad).to_owned());
    }
    if !decl.retain.is_empty() {
        row("retained", decl.retain.join(", "));
    }
    if decl.period {
        row("period", "needs the scan period".to_owned());
    }
    if decl.simulated {
        row("section", "PLANT only".to_owned());
    }
    for fault in &decl.faults {
        row(&fault.name, fault.text.clone());
    }
    rows
}

fn bad_text(rule: BadRule) -> &'static str {
    match rule {
        BadRule::Algebraic => "A: bad in, bad out",
        BadRule::Hold => "H: the state is frozen and the output held while an input is bad",
        BadRule::Select => "S: bad inputs are skipped; when all are bad, the output is held",
        BadRule::Manual => "M: the output is held at once, and the controller sheds after a time",
        BadRule::Freeze => "F: adaptation is frozen, the last parameters are used",
        BadRule::Logic => "L: ints are never bad",
        BadRule::Output => "O: a bad value is never written: the last good one is held",
    }
}

fn type_text(decl: &Decl, ty: &TypeExpr) -> String {
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

fn expr_text(decl: &Decl, expr: &Expr) -> String {
    let pair = |a: &Expr, sign: &str, b: &Expr| format!("{}{sign}{}", expr_text(decl, a), expr_text(decl, b));
    match expr {
        Expr::Int(value) => value.to_string(),
        Expr::Real(value) => format!("{:?}", value.wide),
        Expr::Size(i) => decl.sizes[*i].name.clone(),
        Expr::Param(i) => decl.params[*i].name.clone(),
        Expr::Negate(a) => format!("-{}", expr_text(decl, a)),
        Expr::Add(a, b) => pair(a, "+", b),
        Expr::Subtract(a, b) => pair(a, "-", b),
        Expr::Multiply(a, b) => pair(a, "*", b),
        Expr::Divide(a, b) => pair(a, "/", b),
    }
}

pub(crate) fn range(decl: &Decl, bounds: Option<&Bounds>) -> String {
    let Some(bounds) = bounds else {
        return String::new();
    };
    let word = if bounds.above { "above" } else { "from" };
    let lower = bounds.lower.as_ref().map(|expr| format!("{word} {}", expr_text(decl, expr)));
    let upper = bounds.upper.as_ref().map(|expr| format!("to {}", expr_text(decl, expr)));
    [lower, upper].into_iter().flatten().collect::<Vec<_>>().join(" ")
}

fn tail(decl: &Decl, tail: &Tail) -> String {
    let unit = tail.unit.clone();
    let names = (!tail.names.is_empty()).then(|| format!("{{{}}}", tail.names.join(", ")));
    let bounds = Some(range(decl, tail.bounds.as_ref())).filter(|text| !text.is_empty());
    [unit, bounds, names].into_iter().flatten().collect::<Vec<_>>().join(", ")
}

fn value_text(value: &Value, tail: &Tail) -> String {
    match value {
        Value::Int(value) => match usize::try_from(*value).ok().and_then(|index| tail.names.get(index)) {
            Some(name) => name.clone(),
            None => value.to_string(),
        },
        Value::Real(value) if value.wide.is_nan() => "bad".to_owned(),
        Value::Real(value) => format!("{:?}", value.wide),
        Value::Ints(_) | Value::Reals(_) => "..".to_owned(),
        Value::Text(text) => format!("{text:?}"),
    }
}

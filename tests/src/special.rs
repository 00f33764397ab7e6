//! A program that feeds one special value to one port of one block at a time, made from the declarations.

use pcl2_lang::decl::{Decl, Direction, Item, PortDecl, TypeExpr};
use pcl2_lang::kernel;
use pcl2_lang::types::{Scalar, Shape, Type, Value};
use std::collections::BTreeMap;
use std::fmt::Write;

/// When the special value stands on the port.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Timeline {
    /// Never.
    Never,
    /// In the first scan, and later.
    First,
    /// Not before the block is running.
    Running,
}

/// How long one program runs: past every waiting time of 16 scans.
pub const SCANS: usize = 44;

impl Timeline {
    /// Whether the special value stands on the port in this scan.
    pub fn special(self, scan: usize) -> bool {
        let later = scan == 10 || (13..16).contains(&scan);
        match self {
            Timeline::Never => false,
            Timeline::First => scan == 0 || later,
            Timeline::Running => later,
        }
    }
}

/// One block under test.
#[derive(Clone, Debug)]
pub struct Probe {
    /// Its name.
    pub tag: String,
    /// Its function code.
    pub code: String,
    /// The port under test, by name and type; none: all inputs are good.
    pub port: Option<(String, Type)>,
    /// When that is.
    pub timeline: Timeline,
}

/// The program and what stands in it.
#[derive(Debug, Default)]
pub struct Bench {
    initialize: String,
    plant: String,
    sources: String,
    blocks: String,
    made: BTreeMap<String, String>,
    /// The columns of the stimulus: name, good value, number type, timeline.
    pub columns: Vec<(String, f64, Scalar, Timeline)>,
    /// The blocks, the good one of a code before the others of it.
    pub probes: Vec<Probe>,
    /// Memory of the blocks.
    pub memory: Vec<String>,
    images: usize,
}

impl Bench {
    /// A program over these codes.
    pub fn new<'d>(decls: impl Iterator<Item = &'d Decl>) -> Bench {
        let mut bench = Bench::default();
        for decl in decls.filter(|decl| !decl.is_composite()) {
            let Some(call) = Call::of_example(decl) else {
                continue;
            };
            bench.probe(decl, &call, None, Timeline::Never);
            let ports: usize =
                decl.ports().map(|port| kernel::count(port.group.as_ref(), &call.sizes).unwrap_or(0)).sum();
            for port in 0..ports {
                for timeline in [Timeline::First, Timeline::Running] {
                    bench.probe(decl, &call, Some(port), timeline);
                }
            }
        }
        bench
    }

    /// Its text.
    pub fn program(&self) -> String {
        format!("INITIALIZE\n{}PLANT\n{}CONTROL\n{}{}END\n", self.initialize, self.plant, self.sources, self.blocks)
    }

    /// The stimulus for one special real and one special int.
    pub fn stimulus(&self, real: &str, int: i32) -> String {
        let mut text = "k".to_owned();
        for (name, ..) in &self.columns {
            let _ = write!(text, ",\"{name}\"");
        }
        text.push('\n');
        for scan in 0..SCANS {
            let _ = write!(text, "{scan}");
            for (_, good, scalar, timeline) in &self.columns {
                let _ = match (timeline.special(scan), scalar) {
                    (true, Scalar::Real) => write!(text, ",{real}"),
                    (true, Scalar::Int) => write!(text, ",{int}"),
                    (false, _) => write!(text, ",{good}"),
                };
            }
            text.push('\n');
        }
        text
    }

    fn probe(&mut self, decl: &Decl, call: &Call, tested: Option<usize>, timeline: Timeline) {
        let tag = format!("b{}", self.probes.len());
        let mut inputs = Vec::new();
        let (mut expanded, mut under_test) = (0, None);
        for (index, item) in decl.items.iter().enumerate() {
            match item {
                Item::Literal(value) => inputs.push(value.to_string()),
                Item::Constant(_) => inputs.push(call.constants[index].clone()),
                Item::Port(port) => {
                    let Some(ty) = kernel::resolve(&port.ty, &call.sizes) else {
                        return;
                    };
                    for _ in 0..kernel::count(port.group.as_ref(), &call.sizes).unwrap_or(0) {
                        let now = if tested == Some(expanded) { timeline } else { Timeline::Never };
                        if tested == Some(expanded) {
                            under_test = Some((port.name.clone(), ty));
                        }
                        inputs.push(self.source(ty, good(port), now));
                        expanded += 1;
                    }
                }
            }
        }
        let params = if decl.image.is_some() { self.address(&call.params) } else { call.params.clone() };
        for output in decl.outputs.iter().filter(|output| output.inout) {
            if let Some(ty) = kernel::resolve(&output.ty, &call.sizes) {
                let _ = writeln!(self.initialize, "{tag} = {}", filled(ty, 0.25));
            }
        }
        let text = if decl.simulated { &mut self.plant } else { &mut self.blocks };
        let _ = writeln!(text, "{tag} = {} ( {} : {params} )", decl.name, named(decl, &inputs, call));
        self.memory
            .extend(decl.memory.iter().filter(|field| is_real(&field.ty)).map(|field| format!("{tag}.{}", field.name)));
        self.probes.push(Probe { tag, code: decl.name.clone(), port: under_test, timeline });
    }

    fn address(&mut self, params: &str) -> String {
        let rest = params.split(',').skip(3).collect::<Vec<_>>().join(",");
        self.images += 1;
        let address = format!("9, {}, {}", self.images / 100, self.images % 100);
        if rest.trim().is_empty() { address } else { format!("{address},{rest}") }
    }

    /// A signal of this type whose elements all have the value.
    fn source(&mut self, ty: Type, good: f64, timeline: Timeline) -> String {
        if ty.is_scalar() {
            return self.number(ty.scalar, good, timeline);
        }
        let (rows, columns) = ty.rows_columns();
        let key = format!("{ty} {good} {timeline:?}");
        if let Some(name) = self.made.get(&key) {
            return name.clone();
        }
        let name = format!("v{}", self.made.len());
        let of = if ty.scalar == Scalar::Int { "i" } else { "" };
        if timeline == Timeline::Never {
            let _ = writeln!(self.initialize, "{name} = {}", filled(ty, good));
        } else {
            let number = self.number(ty.scalar, good, timeline);
            let element = Type { scalar: ty.scalar, shape: Shape::Vector(1) };
            let row = Type { scalar: ty.scalar, shape: Shape::Matrix(1, columns) };
            let column = Type { scalar: ty.scalar, shape: Shape::Matrix(rows, 1) };
            let _ = writeln!(
                self.initialize,
                "{name}e = {}\n{name}o = {}\n{name}c = {}",
                filled(element, 0.0),
                filled(row, 1.0),
                filled(column, 1.0)
            );
            let put = if ty.scalar == Scalar::Int { "itov" } else { "ftov" };
            let _ = writeln!(self.sources, "{name}e = {put} ( 1, {number}, 1 : )");
            let _ = writeln!(self.sources, "{name}r = mul{of}mat ( 1, {columns}, {name}e, {name}o : )");
            let _ = writeln!(self.sources, "{name} = mul{of}mat ( {rows}, {columns}, {name}c, {name}r : )");
        }
        self.made.insert(key, name.clone());
        name
    }

    fn number(&mut self, scalar: Scalar, good: f64, timeline: Timeline) -> String {
        let key = format!("{scalar:?} {good} {timeline:?}");
        if let Some(name) = self.made.get(&key) {
            return name.clone();
        }
        let name = format!("s{}", self.made.len());
        let point = match scalar {
            Scalar::Real => {
                self.images += 1;
                let (slot, channel) = (self.images / 100, self.images % 100);
                let _ = writeln!(self.sources, "{name} = ain ( : 9, {slot}, {channel} )");
                format!("ain(9,{slot},{channel})")
            }
            Scalar::Int => {
                let _ = writeln!(self.sources, "{name} = msi ( : 0 )");
                format!("{name}.value")
            }
        };
        self.columns.push((point, good, scalar, timeline));
        self.made.insert(key, name.clone());
        name
    }
}

fn is_real(ty: &TypeExpr) -> bool {
    matches!(
        ty,
        TypeExpr::Scalar(Scalar::Real) | TypeExpr::Vector(Scalar::Real, _) | TypeExpr::Matrix(Scalar::Real, ..)
    )
}

/// What stands on a port else: its default, or a value that most codes take.
fn good(port: &PortDecl) -> f64 {
    match (&port.default, &port.ty) {
        (Some(Value::Int(value)), _) => f64::from(*value),
        (Some(Value::Real(value)), _) if value.wide.is_finite() => value.wide,
        (Some(_), TypeExpr::Vector(..)) => 0.0,
        (_, ty) if is_real(ty) => 0.5,
        (_, _) => 1.0,
    }
}

/// `setvec ( 2 : 0.5, 0.5 )`
fn filled(ty: Type, value: f64) -> String {
    let number = if ty.scalar == Scalar::Int { format!("{}", value as i32) } else { format!("{value:?}") };
    let of = if ty.scalar == Scalar::Int { "i" } else { "" };
    let list = vec![number; ty.elements()].join(", ");
    match ty.shape {
        Shape::Scalar => format!("ms{} ( : {list} )", if ty.scalar == Scalar::Int { "i" } else { "c" }),
        Shape::Vector(n) => format!("set{of}vec ( {n} : {list} )"),
        Shape::Matrix(r, c) => format!("set{of}mat ( {r}, {c} : {list} )"),
    }
}

/// After a group, optional ports go by name.
fn named(decl: &Decl, inputs: &[String], call: &Call) -> String {
    let mut parts = Vec::new();
    let mut inputs = inputs.iter();
    let mut after_group = false;
    for item in &decl.items {
        match item {
            Item::Literal(_) | Item::Constant(_) => parts.extend(inputs.next().cloned()),
            Item::Port(port) => {
                let by_name = after_group && port.default.is_some();
                for _ in 0..kernel::count(port.group.as_ref(), &call.sizes).unwrap_or(0) {
                    let input = inputs.next().cloned().unwrap_or_default();
                    parts.push(if by_name { format!("{} = {input}", port.name) } else { input });
                }
                after_group |= port.group.is_some();
            }
        }
    }
    parts.join(", ")
}

/// What an example says of its call: constants, sizes, parameters.
struct Call {
    constants: Vec<String>,
    sizes: Vec<i32>,
    params: String,
}

impl Call {
    fn of_example(decl: &Decl) -> Option<Call> {
        let plain =
            |text: &str| text.lines().map(|line| line.split('!').next().unwrap_or("")).collect::<Vec<_>>().join(" ");
        let texts = decl.examples.iter().map(|example| plain(&example.program));
        let inner = texts.filter_map(|text| {
            let start = [format!("= {} (", decl.name), format!("= {}(", decl.name)];
            let at = start.iter().find_map(|start| text.find(start).map(|at| at + start.len()))?;
            Some(text[at..text[at..].find(')')? + at].to_owned())
        });
        // Examples of operators are expressions: all is default then.
        let inner = inner.into_iter().next().or_else(|| decl.operator.is_some().then(String::new))?;
        let (inputs, params) = inner.split_once(':').unwrap_or((&inner, ""));
        let inputs: Vec<&str> = inputs.split(',').map(str::trim).filter(|input| !input.is_empty()).collect();
        // Constants are the inputs that are digits: examples name their signals.
        let mut digits = inputs.iter().filter(|input| input.bytes().all(|byte| byte.is_ascii_digit()));
        let mut constants = vec![String::new(); decl.items.len()];
        let mut sizes = vec![2; decl.sizes.len()];
        for (index, item) in decl.items.iter().enumerate() {
            match item {
                Item::Literal(_) => {
                    digits.next()?;
                }
                Item::Constant(constant) => {
                    let text = digits.next()?;
                    constants[index] = (*text).to_owned();
                    sizes[constant.size] = text.parse().ok()?;
                }
                Item::Port(_) => {}
            }
        }
        let ports_known = decl.image.is_none_or(|image| image.direction == Direction::Out || decl.ports().count() > 0);
        ports_known.then(|| Call { constants, sizes, params: params.trim().to_owned() })
    }
}

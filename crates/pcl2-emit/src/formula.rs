//! An expression: nested calls of the inline functions of its codes.

use crate::args::Call;
use crate::statics::Statics;
use crate::text;
use pcl2_lang::decl::Step;
use pcl2_lang::kernel::{self, Arg, Entry};
use pcl2_lang::program::DeclId;
use pcl2_lang::types::Scalar;

/// Writes the value of an expression.
pub(crate) fn value(out: &mut String, statics: &mut Statics, call: &Call<'_, '_>, formula: &[Step]) {
    if let Some(last) = formula.len().checked_sub(1) {
        Tree::new(call, formula).write(out, statics, last);
    }
}

/// Writes each real on the way to the value as a constant of its own. The results are their names, and the value.
pub(crate) fn value_in_steps(
    out: &mut String,
    statics: &mut Statics,
    call: &Call<'_, '_>,
    formula: &[Step],
    indent: &str,
) -> (Vec<String>, String) {
    let Some(last) = formula.len().checked_sub(1) else {
        return (Vec::new(), String::new());
    };
    let mut tree = Tree::new(call, formula);
    for (at, step) in formula[..last].iter().enumerate() {
        if matches!(step, Step::Apply(_)) && !tree.is_int(at) {
            let mut text = String::new();
            tree.write(&mut text, statics, at);
            let name = format!("r{}_{}", call.id.0, tree.named.iter().flatten().count() + 1);
            out.extend([indent, "const pcl2_real ", &name, " = ", &text, ";\n"]);
            tree.named[at] = Some(name);
        }
    }
    let mut text = String::new();
    tree.write(&mut text, statics, last);
    (tree.named.into_iter().flatten().collect(), text)
}

/// Where the operands of each step begin.
fn starts(call: &Call<'_, '_>, formula: &[Step]) -> Vec<usize> {
    let mut starts = Vec::with_capacity(formula.len());
    let mut results: Vec<usize> = Vec::new();
    for (i, step) in formula.iter().enumerate() {
        let start = match step {
            Step::Port => i,
            Step::Apply(code) => {
                let count = call.cx.code(*code).ports.len();
                let operands = results.split_off(results.len().saturating_sub(count));
                operands.first().copied().unwrap_or(i)
            }
        };
        starts.push(start);
        results.push(start);
    }
    starts
}

struct Tree<'t, 'c, 'a> {
    call: &'t Call<'c, 'a>,
    formula: &'t [Step],
    /// Where the operands of each step begin.
    starts: Vec<usize>,
    /// How many ports stand before each step.
    ports: Vec<usize>,
    /// The constants that have the result of a step.
    named: Vec<Option<String>>,
}

impl<'t, 'c, 'a> Tree<'t, 'c, 'a> {
    fn new(call: &'t Call<'c, 'a>, formula: &'t [Step]) -> Self {
        let mut next = 0;
        let ports = formula.iter().map(|step| {
            let port = next;
            next += usize::from(*step == Step::Port);
            port
        });
        let ports = ports.collect();
        Tree { call, formula, starts: starts(call, formula), ports, named: vec![None; formula.len()] }
    }

    fn write(&self, out: &mut String, statics: &mut Statics, at: usize) {
        if let Some(name) = &self.named[at] {
            out.push_str(name);
            return;
        }
        match self.formula[at] {
            Step::Port => self.call.port(out, statics, self.ports[at]),
            Step::Apply(code) => self.apply(out, statics, at, code),
        }
    }

    /// The steps whose results a step takes, in order.
    fn operands(&self, at: usize, count: usize) -> Vec<usize> {
        let mut operands = Vec::with_capacity(count);
        let mut end = at;
        for _ in 0..count {
            let Some(operand) = end.checked_sub(1) else {
                break;
            };
            operands.push(operand);
            end = self.starts[operand];
        }
        operands.reverse();
        operands
    }

    fn apply(&self, out: &mut String, statics: &mut Statics, at: usize, code: DeclId) {
        let code = self.call.cx.code(code);
        let operands = self.operands(at, code.ports.len());
        let wanted: Vec<Scalar> = code.decl.port_scalars().collect();
        out.push_str(code.name(Entry::Step));
        out.push('(');
        for (i, arg) in code.args(Entry::Step).iter().enumerate() {
            if i > 0 {
                out.push_str(", ");
            }
            match arg {
                Arg::Port(port) => {
                    let operand = operands[*port];
                    if wanted[*port] == Scalar::Real && self.is_int(operand) {
                        out.push_str("(pcl2_real)");
                    }
                    self.write(out, statics, operand);
                }
                Arg::Param(param) => self.default(out, code.decl, *param),
                Arg::Instance | Arg::Size(_) | Arg::Memory(_) | Arg::Tuned(_) | Arg::Work(_) => {}
                Arg::Image | Arg::Fail | Arg::Output(_) | Arg::Period | Arg::Left => {}
            }
        }
        out.push(')');
    }

    /// Whether a step is an operator that gives an int: ports have the type that is wanted of them.
    fn is_int(&self, at: usize) -> bool {
        match self.formula[at] {
            Step::Port => false,
            Step::Apply(code) => {
                let decl = self.call.cx.code(code).decl;
                kernel::c_element(&decl.outputs[0].ty) == kernel::c_scalar(Scalar::Int)
            }
        }
    }

    /// The parameters of operators have their defaults.
    fn default(&self, out: &mut String, decl: &pcl2_lang::decl::Decl, param: usize) {
        let param = &decl.params[param];
        if let Some(value) = &param.default {
            text::element(out, value, 0, crate::facts::element_scalar(&param.ty), self.call.cx.program.width);
        }
    }
}

//! A net as a program of its own: one block, whose inputs come from outside and whose outputs go there.

use crate::Input;
use crate::draft::{Scope, Wire};
use pcl2_lang::ast::{Line, Name, Operand, Output, Statement};
use pcl2_lang::decl::Decl;
use pcl2_lang::kernel;
use pcl2_lang::program::{Program, Role, SignalId};
use pcl2_lang::symbol::Symbols;
use pcl2_lang::syntax::Tree;

/// The program that calls a net.
pub fn tree(net: &Decl, symbols: &mut Symbols) -> Tree {
    let mut name = |text: &str| Name { symbol: symbols.intern(text), span: net.span };
    let code = name(&net.name);
    let operand = |port: &pcl2_lang::decl::PortDecl| match port.cell {
        true => Operand::Empty,
        false => Operand::Name(Name { symbol: symbols.intern(&port.name), span: net.span }),
    };
    let inputs = net.ports().map(operand).collect();
    let mut name = |text: &str| Name { symbol: symbols.intern(text), span: net.span };
    let numbered = net.outputs.iter().filter(|output| !output.by_name);
    let mut outputs: Vec<Output> = numbered.map(|output| Output::Name(name(&output.name))).collect();
    if outputs.is_empty() {
        outputs.push(Output::Name(code));
    }
    let call = Statement::call(outputs.into_boxed_slice(), code, inputs);
    let lines = vec![Line::Control(net.span, Box::default()), Line::Block(Box::new(call))];
    Tree { lines, end: Some(net.span), ..Tree::default() }
}

/// The net's inputs are signals without a writer.
pub(crate) fn inputs(input: &Input<'_>, scope: &mut Scope<'_>) {
    let Some(net) = input.alone.filter(|_| scope.owner.is_none()) else {
        return;
    };
    for port in net.ports().filter(|port| !port.cell) {
        let id = SignalId(scope.wires.len() as u32);
        if let Some(symbol) = input.symbols.find(&port.name) {
            scope.by_name.insert(symbol, id);
        }
        scope.wires.push(Wire {
            name: port.name.clone(),
            ty: kernel::resolve(&port.ty, &[]),
            spoiled: false,
            writers: Vec::new(),
            role: Role::Input,
            span: net.span,
        });
    }
}

/// The block and what is reached through it have the net's name; outputs leave the program.
pub(crate) fn name(program: &mut Program, net: &Decl) {
    let unit = &mut program.units[0];
    let Some(block) = unit.blocks.first_mut() else {
        return;
    };
    block.name.clone_from(&net.name);
    for (output, signal) in net.outputs.iter().zip(&block.outputs) {
        let signal = &mut unit.signals[signal.0 as usize];
        match output.by_name {
            true => signal.name = format!("{}.{}", net.name, output.name),
            false => signal.role = Role::Output,
        }
    }
    for cell in &mut unit.cells {
        if let Some((_, port)) = cell.name.rsplit_once('.') {
            cell.name = format!("{}.{port}", net.name);
        }
    }
}

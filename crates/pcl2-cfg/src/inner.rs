//! Ranges inside composites: what an inner block declares holds for the composite's parameter that it gets.

use pcl2_lang::bounds;
use pcl2_lang::codes;
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::model;
use pcl2_lang::program::{Block, Param, Program, UnitId};
use pcl2_lang::types::Value;

/// Checks the parameters of every composite in use against the ranges of the blocks inside it.
pub fn check_ranges(program: &Program, diagnostics: &mut Vec<Diagnostic>) {
    for block in &program.main().blocks {
        let (Some(unit), true) = (block.unit, !diagnostic::enough(diagnostics)) else {
            continue;
        };
        let values: Option<Vec<Value>> = block.params.iter().map(|param| model::value(param).cloned()).collect();
        if let Some(refused) = values.and_then(|values| refused(program, unit, &values)) {
            let code = &program.decl(block.decl).name;
            let message = format!("block {}: inside {code}: {refused}", block.number);
            diagnostics.push(Diagnostic::new(codes::OUT_OF_RANGE, block.span, message));
        }
    }
}

/// The first range inside a body that the composite's values violate.
fn refused(program: &Program, unit: UnitId, own: &[Value]) -> Option<String> {
    program.unit(unit).blocks.iter().find_map(|block| {
        let values = inner_values(block, own);
        match block.unit {
            Some(inner) => refused(program, inner, &values),
            None if block.params.iter().any(|param| matches!(param, Param::Own(_))) => {
                let decl = program.decl(block.decl);
                let violation = bounds::check(decl, &block.sizes, &values, program.width).err()?;
                let param = &decl.params[violation.param].name;
                Some(format!("expected `{param}` of {} {}, found {}", decl.name, violation.expected, violation.found))
            }
            None => None,
        }
    })
}

fn inner_values(block: &Block, own: &[Value]) -> Vec<Value> {
    let value = |param: &Param| match param {
        Param::Value(value) => value.clone(),
        Param::Own(index) => own.get(*index as usize).cloned().unwrap_or(Value::Int(0)),
    };
    block.params.iter().map(value).collect()
}

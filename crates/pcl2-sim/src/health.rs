//! What went wrong during a run, in the terms of the generated C's health record.

use pcl2_lang::program::{Block, BlockId, Program};
use pcl2_lang::types::Width;

/// One block scan that ended with a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaultAt {
    /// Index of the block in the program's own unit.
    pub block: u32,
    /// Status, from 1 in the order of the block's FAULTS.
    pub status: i32,
    /// The scan.
    pub scan: u32,
}

/// The health record. All counts stop at their ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Health {
    /// Block scans that ended with a fault.
    pub faults: u32,
    /// Sets of parameters that were refused as a whole.
    pub refused: u32,
    /// The first fault.
    pub first: Option<FaultAt>,
    /// The latest fault.
    pub last: Option<FaultAt>,
}

impl Health {
    /// Counts a fault. Those of one scan count in block order: the lowest is the first, the highest the latest.
    pub fn fault(&mut self, fault: FaultAt) {
        let FaultAt { block, scan, .. } = fault;
        if self.first.is_none_or(|first| scan == first.scan && block < first.block) {
            self.first = Some(fault);
        }
        if self.last.is_none_or(|last| scan != last.scan || block >= last.block) {
            self.last = Some(fault);
        }
        self.faults = self.faults.saturating_add(1);
    }

    /// Counts a refused set.
    pub fn refuse(&mut self) {
        self.refused = self.refused.saturating_add(1);
    }

    /// The record as lines for people; none when nothing went wrong.
    pub fn lines(&self, program: &Program) -> Vec<String> {
        let mut lines = Vec::new();
        if let Some(first) = self.first {
            lines.push(format!("first fault: {}", place(program, first)));
        }
        if let Some(last) = self.last.filter(|last| Some(*last) != self.first) {
            lines.push(format!("last fault: {}", place(program, last)));
        }
        if self.faults > 0 {
            lines.push(format!("faults: {}", self.faults));
        }
        if self.refused > 0 {
            lines.push(format!("refused sets: {}", self.refused));
        }
        lines
    }
}

fn place(program: &Program, fault: FaultAt) -> String {
    let FaultAt { block, status, scan } = fault;
    let unit = program.main();
    let Some(found) = unit.blocks.get(block as usize) else {
        return format!("scan {scan}, status {status}");
    };
    let text = text(program, found, status).unwrap_or_else(|| format!("status {status}"));
    format!("scan {scan}, {}: {text}", block_title(program, BlockId(block)))
}

/// How messages name a block: ``block 6 `u1` (gpc2)``.
pub fn block_title(program: &Program, id: BlockId) -> String {
    let block = program.main().block(id);
    let code = &program.decl(block.decl).name;
    if block.name == block.number.to_string() {
        format!("block {} ({code})", block.number)
    } else {
        format!("block {} `{}` ({code})", block.number, block.name)
    }
}

/// The text of a status. That of a composite comes from the blocks in it that have one with that number; several may.
fn text(program: &Program, block: &Block, status: i32) -> Option<String> {
    let decl = program.decl(block.decl);
    let index = usize::try_from(status).ok()?.checked_sub(1)?;
    if let Some(fault) = decl.faults.get(index) {
        return Some(fault.text.clone());
    }
    let inner = program.unit(block.unit?);
    let said = |inner: &Block| Some(format!("in `{}`: {}", inner.name, text(program, inner, status)?));
    let texts: Vec<String> = inner.blocks.iter().filter_map(said).collect();
    (!texts.is_empty()).then(|| texts.join(", or "))
}

/// A fault's text with the two reals that a check left in it.
pub fn with_reals(text: &str, left: [f64; 2], width: Width) -> String {
    let shown = left.map(|value| match width {
        Width::F64 => format!("{value}"),
        Width::F32 => format!("{}", value as f32),
    });
    text.replace("{1}", &shown[0]).replace("{2}", &shown[1])
}

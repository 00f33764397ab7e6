//! A program as a block diagram.
//!
//! The passes, and what is true after each:
//! 1. [`netlist`]: every block is a node with pins, every output that is read is a net.
//! 2. [`sheets`]: every node stands on one sheet, and a net either lies within a sheet or goes by name (flags).
//! 3. [`layers`]: on each sheet every node has a layer; readers of this scan's value stand right of their writer.
//! 4. [`order`]: nodes and passing wires of a layer have an order with few crossings.
//! 5. [`place`]: they have heights, most wires are straight.
//! 6. [`route`]: the wires between two layers have tracks of their own: no two nets share a segment.
//! 7. [`render`] makes text of it.

mod layers;
mod netlist;
pub(crate) mod order;
pub(crate) mod place;
mod render;
pub(crate) mod route;
pub(crate) mod sheet;
mod sheets;
mod text;

use pcl2_lang::verify::Verified;

/// The block diagram of a program.
pub fn svg(verified: &Verified) -> String {
    let program = verified.program();
    let mut list = netlist::read(program);
    let plan = sheets::plan(program, &mut list);
    let titles: Vec<i32> = (0..program.sections.len()).map(|section| render::title_width(program, section)).collect();
    let titles = matches!(plan.layout, sheets::Layout::Lanes).then_some(titles.as_slice());
    let drawn: Vec<sheet::Drawn> = plan.sheets.iter().map(|sheet| sheet::draw(&list, sheet, titles)).collect();
    render::picture(program, &list, &plan.layout, &drawn)
}

//! A net as a picture: boxes with the symbols of their kinds, gates as bars, arcs between them.
//!
//! The passes, and what is true after each:
//! 1. [`model`]: every box and gate is a node with its texts, every arc has two ends or is a tag at its gate.
//! 2. [`sheets`]: what tokens connect stands on one sheet; arcs between sheets are tags.
//! 3. [`layers`]: tokens run down from layer to layer, where they go round they come back beside.
//! 4. [`layout`]: everything on a sheet has its place. Layers, order and tracks are those of block diagrams, turned.
//! 5. [`scene`]: sheets stand in rows, those of the nets inside in frames.
//! 6. [`render`] makes text of it.

mod layers;
mod layout;
mod legend;
mod model;
mod render;
mod scene;
mod sheets;
mod symbol;
mod texts;

use pcl2_lang::net::written::Written;

/// The picture of a net.
pub fn svg(written: &Written<'_>) -> String {
    render::picture(written, &scene::scene(written))
}

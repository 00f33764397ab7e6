//! A verified program as C.
//!
//! Pure: text in, text out. One [`Context`](context) is looked up and laid out, then each file is written from it.

mod amalgamate;
mod args;
mod bodies;
mod calls;
mod check;
mod code;
mod context;
mod example;
mod expr;
mod facts;
mod formula;
mod header;
mod image;
mod init;
mod io;
mod json;
mod layout;
mod macros;
mod map;
mod names;
mod net;
mod points;
mod rows;
pub mod runner;
mod runtime;
mod shape;
mod size;
mod source;
mod statics;
mod step;
mod text;
mod tune;
mod unused;

pub use amalgamate::amalgamate;
pub use names::program_name;
pub use runtime::files as runtime_files;

use context::Context;
use pcl2_lang::decl::Decl;
use pcl2_lang::source::Sources;
use pcl2_lang::verify::Verified;

/// What else the emitter is handed.
#[derive(Clone, Debug, Default)]
pub struct Options<'a> {
    /// All known declarations: the header of a kernel's file lists every code of it. Without them, those in use.
    pub known: Vec<&'a Decl>,
    /// The C files of the user's own function codes: file name and text.
    pub user_files: Vec<(String, String)>,
    /// How nets become C.
    pub net_form: NetForm,
}

/// How nets become C. Both give the same trace.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NetForm {
    /// Code of each gate, tried only when its box is marked and its input is there.
    #[default]
    Fast,
    /// A table that the player of the runtime walks: less flash for many gates.
    Table,
}

/// The C that came out.
#[derive(Clone, Debug, Default)]
pub struct Emitted {
    /// The program's C name.
    pub name: String,
    /// Path below the output folder, and text.
    pub files: Vec<(String, String)>,
    /// The C files of the library, the example and what another file includes left out.
    pub sources: Vec<String>,
    /// The folders to search for headers.
    pub folders: Vec<String>,
    /// How large it is.
    pub sizes: Sizes,
}

/// How large a program is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Bytes of one instance, where every type is aligned to its size.
    pub instance: u64,
    /// Blocks of the program, composites counted once.
    pub blocks: usize,
    /// Named points in the map.
    pub points: usize,
}

/// Emits a program.
pub fn emit(verified: &Verified, sources: &Sources, options: &Options<'_>) -> Emitted {
    let mut files = Vec::new();
    let mut emitted = emit_each(verified, sources, options, &mut |path, text| files.push((path, text)));
    emitted.files = files;
    emitted
}

/// Emits a program file by file, so that a large one need not stand in memory as a whole.
pub fn emit_each(
    verified: &Verified,
    sources: &Sources,
    options: &Options<'_>,
    take: &mut dyn FnMut(String, String),
) -> Emitted {
    let program = verified.program();
    let cx = Context::new(program, sources, options.net_form);
    let name = cx.name.clone();
    let mut points = points::points(&cx);
    take(format!("{name}_map.c"), map::map(&cx, &mut points));
    take(format!("{name}.json"), json::json(&cx, &mut points));
    take(format!("{name}.h"), header::header(&cx, points.hash));
    let points_of_plant = io::io(&cx);
    let runtime = runtime::collect(&cx, &options.known, &options.user_files, points_of_plant.is_some());
    let (text, included) = source::source(&cx, &points, &|path| runtime.files.contains_key(path));
    take(format!("{name}.c"), text);
    take(format!("{name}_example.c"), example::example(&cx));
    let folders = runtime.folders();
    let mut c_files = vec![format!("{name}.c"), format!("{name}_map.c")];
    let linked = |path: &&str| !included.iter().any(|known| known == path) && !runtime::is_port(path);
    c_files.extend(runtime.sources().filter(linked).map(str::to_owned));
    if let Some(table) = points_of_plant {
        take(format!("{name}_io.c"), table);
    }
    take("Makefile".to_owned(), example::makefile(&name, &folders, &c_files));
    let sizes =
        Sizes { instance: cx.layout.extent.padded(), blocks: program.main().blocks.len(), points: points.count };
    for (path, text) in runtime.files {
        take(path, text);
    }
    Emitted { name, files: Vec::new(), sources: c_files, folders, sizes }
}

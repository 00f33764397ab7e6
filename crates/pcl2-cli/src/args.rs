//! The command line.

use clap::{Args, Parser, Subcommand, ValueEnum};
use pcl2_lang::types::Width;
use std::path::PathBuf;

/// Compiles PCL2, the process control language of function codes, to C.
#[derive(Parser, Debug)]
#[command(name = "pcl2", version, about, arg_required_else_help = true)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Subcommand, Debug)]
pub(crate) enum Command {
    /// Make a project to begin with
    New(crate::new::NewArgs),
    /// Check programs and print diagnostics
    Check(CheckArgs),
    /// Compile programs to C
    Build(BuildArgs),
    /// Run a program, with its simulated plant if it has one
    Run(crate::run::RunArgs),
    /// Give sources their canonical layout
    Fmt(FmtArgs),
    /// List parameters, compare them with the source, or save them in it
    Params(crate::params::ParamsArgs),
    /// Draw the block diagram of a program, or a net
    Graph(GraphArgs),
    /// Analyse Petri nets
    #[command(subcommand)]
    Net(crate::net::NetCommand),
    /// List the function codes, or describe one
    Blocks(BlocksArgs),
    /// Explain a diagnostic
    Explain(ExplainArgs),
}

/// What check, build, run and graph share. The command line wins over pcl2.toml.
#[derive(Args, Debug, Clone, Default)]
pub(crate) struct CommonArgs {
    /// The scan period in seconds
    #[arg(long, value_name = "S")]
    pub(crate) period: Option<String>,
    /// The width of reals
    #[arg(long, value_name = "f32|f64")]
    pub(crate) real: Option<Real>,
    /// Make every warning an error
    #[arg(long)]
    pub(crate) strict: bool,
    /// Numbers of the blocks that simulate the plant
    #[arg(long, value_name = "N,..", value_delimiter = ',')]
    pub(crate) plant: Vec<u32>,
    /// A folder with function codes of your own (.fc and .c)
    #[arg(long, value_name = "DIR")]
    pub(crate) blocks: Vec<PathBuf>,
    /// How nets become C: fast code, or a table for small flash
    #[arg(long, value_name = "fast|table")]
    pub(crate) net_form: Option<Form>,
}

/// How nets become C.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Form {
    /// Code of each gate
    Fast,
    /// A table that a player walks
    Table,
}

impl Form {
    /// As the emitter knows it.
    pub(crate) fn net_form(self) -> pcl2_emit::NetForm {
        match self {
            Form::Fast => pcl2_emit::NetForm::Fast,
            Form::Table => pcl2_emit::NetForm::Table,
        }
    }
}

/// The width of reals.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Real {
    /// C float
    F32,
    /// C double
    F64,
}

impl Real {
    /// As the compiler knows it.
    pub(crate) fn width(self) -> Width {
        match self {
            Real::F32 => Width::F32,
            Real::F64 => Width::F64,
        }
    }
}

/// `pcl2 check`
#[derive(Args, Debug)]
pub(crate) struct CheckArgs {
    /// A .cfg or .net file, or a folder with pcl2.toml
    #[arg(required = true, value_name = "PATH")]
    pub(crate) paths: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) common: CommonArgs,
    /// List order, rates, delays, border and memory
    #[arg(short, long)]
    pub(crate) verbose: bool,
    /// How diagnostics are printed
    #[arg(long, value_enum, default_value_t = Format::Text, conflicts_with = "verbose")]
    pub(crate) format: Format,
    /// Print how long each phase took
    #[arg(long)]
    pub(crate) timings: bool,
}

/// How diagnostics are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// For people, on standard error
    Text,
    /// For tools: one JSON object a line on standard output
    Json,
}

/// `pcl2 build`
#[derive(Args, Debug)]
pub(crate) struct BuildArgs {
    /// A .cfg or .net file, or a folder with pcl2.toml
    #[arg(required = true, value_name = "PATH")]
    pub(crate) paths: Vec<PathBuf>,
    /// The folder that takes the output
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// What to make
    #[arg(long, value_enum, default_value_t = Emit::C)]
    pub(crate) emit: Emit,
    /// Which part of a program with a PLANT
    #[arg(long, value_enum, default_value_t = Part::Control)]
    pub(crate) part: Part,
    /// A C compiler's target, such as cortex-m4
    #[arg(long, value_name = "NAME")]
    pub(crate) target: Option<String>,
    #[command(flatten)]
    pub(crate) common: CommonArgs,
}

/// What `build` makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Emit {
    /// C files, a Makefile and the runtime's used parts
    C,
    /// The C files compiled to objects
    Obj,
    /// A static library
    Lib,
    /// The example program
    Exe,
    /// One .c and one .h file
    Amalgamation,
}

/// Which part of a program is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Part {
    /// The controller
    Control,
    /// The simulated process
    Plant,
}

/// `pcl2 fmt`
#[derive(Args, Debug)]
pub(crate) struct FmtArgs {
    /// A .cfg or .net file, or a folder with pcl2.toml
    #[arg(required = true, value_name = "PATH")]
    pub(crate) paths: Vec<PathBuf>,
    /// Number the blocks 1, 2, 3 .. in order of execution, and change what refers to numbers
    #[arg(long)]
    pub(crate) renumber: bool,
    /// Write nothing; exit with 1 when a file would change
    #[arg(long)]
    pub(crate) check: bool,
    /// A folder with function codes of your own
    #[arg(long, value_name = "DIR")]
    pub(crate) blocks: Vec<PathBuf>,
}

/// `pcl2 graph`
#[derive(Args, Debug)]
pub(crate) struct GraphArgs {
    /// A .cfg, .net or .pnml file, or a folder with pcl2.toml
    pub(crate) path: PathBuf,
    /// The picture (`-`: to standard output)
    #[arg(short, long, value_name = "SVG")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) common: CommonArgs,
}

/// `pcl2 blocks`
#[derive(Args, Debug)]
pub(crate) struct BlocksArgs {
    /// A function code
    pub(crate) name: Option<String>,
    /// A folder with function codes of your own
    #[arg(long, value_name = "DIR")]
    pub(crate) blocks: Vec<PathBuf>,
}

/// `pcl2 explain`
#[derive(Args, Debug)]
pub(crate) struct ExplainArgs {
    /// The code of a diagnostic, such as P0203
    pub(crate) code: String,
}

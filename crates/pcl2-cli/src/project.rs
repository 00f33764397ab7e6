//! From a path to a verified program: finds and reads files, and hands their texts to the front end.

use crate::args::CommonArgs;
use crate::config::{self, Config};
use crate::console;
use crate::nets;
use crate::outcome::Outcome;
use pcl2_cfg::{FileText, Input, Options, wanted_files};
use pcl2_lang::catalogue::{Catalogue, UserFile};
use pcl2_lang::codes;
use pcl2_lang::decl::Decl;
use pcl2_lang::declare;
use pcl2_lang::diagnostic::{self, Diagnostic};
use pcl2_lang::net::written::{self, Written};
use pcl2_lang::source::{FileId, Sources, Span};
use pcl2_lang::symbol::Symbols;
use pcl2_lang::syntax;
use pcl2_lang::types::Width;
use pcl2_lang::verify::{Verified, verify};
use pcl2_sim::clock;
use rustc_hash::FxHashMap;
use std::fs;
use std::io::Read;
use std::path::{Component, Path, PathBuf};
use std::time::{Duration, Instant};

/// The largest source file in bytes.
pub(crate) const MAX_SOURCE: u64 = 256 << 20;
/// The largest parameter file in bytes.
pub(crate) const MAX_PARAMETERS: u64 = 64 << 20;

/// A program with everything that was read for it.
pub(crate) struct Project {
    /// All texts.
    pub(crate) sources: Sources,
    /// The program, if it has no errors.
    pub(crate) verified: Option<Verified>,
    /// Everything there is to say, in order.
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// Errors beyond the limit.
    pub(crate) left_out: usize,
    /// The known function codes.
    pub(crate) catalogue: Catalogue,
    /// All names.
    pub(crate) symbols: Symbols,
    /// The stem of the source's name: a net is called so.
    pub(crate) stem: String,
    /// C files of the user's own blocks: name and text.
    pub(crate) kernels: Vec<(String, String)>,
    /// The content of pcl2.toml.
    pub(crate) config: Config,
    /// How nets become C.
    pub(crate) net_form: pcl2_emit::NetForm,
    /// The source, if it could be read: its place and its text.
    pub(crate) source: Option<(PathBuf, FileId)>,
    /// How long each phase took.
    pub(crate) timings: Vec<(&'static str, Duration)>,
    /// Bytes of source, lines and blocks.
    pub(crate) lines: usize,
}

impl Project {
    /// The net that is the whole program, if it is one.
    pub(crate) fn net(&self) -> Option<Written<'_>> {
        self.source.as_ref().filter(|(path, _)| nets::is_net(path))?;
        written::read(self.catalogue.find(&self.stem)?, &self.sources, &self.catalogue)
    }

    /// What the emitter is handed beside the program.
    pub(crate) fn emit_options(&self) -> pcl2_emit::Options<'_> {
        let known = self.catalogue.decls().collect();
        pcl2_emit::Options { known, user_files: self.kernels.clone(), net_form: self.net_form }
    }
}

/// Reads and checks the program at a path.
pub(crate) fn load(path: &Path, common: &CommonArgs) -> Result<Project, Outcome> {
    load_for(path, common, Use::Check, None)
}

/// The same with another text in place of the source's.
pub(crate) fn load_replaced(path: &Path, common: &CommonArgs, text: Vec<u8>) -> Result<Project, Outcome> {
    load_for(path, common, Use::Check, Some(text))
}

/// What a program is loaded for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Use {
    /// To be checked: what depends on a period is checked when it is known.
    Check,
    /// To be built or run: a period that is needed must be given.
    Run,
}

fn load_for(path: &Path, common: &CommonArgs, purpose: Use, replaced: Option<Vec<u8>>) -> Result<Project, Outcome> {
    let mut loader = Loader { replaced, ..Loader::default() };
    let place = loader.place(path);
    let width = common.real.map(crate::args::Real::width).or(place.config.width).unwrap_or_default();
    let period = period(common, &place.config, &mut loader.diagnostics)?;
    let mut catalogue = loader.catalogue(&place, common);
    let (verified, lines) = match place.source {
        Some(file) => loader.compile(file, &place, &mut catalogue, common, (width, period), purpose),
        None => (None, 0),
    };
    let mut diagnostics = loader.diagnostics;
    let left_out = diagnostic::finish(&mut diagnostics, common.strict);
    let failed = diagnostics.iter().any(Diagnostic::is_error);
    Ok(Project {
        sources: loader.sources,
        verified: verified.filter(|_| !failed),
        diagnostics,
        left_out,
        catalogue,
        symbols: loader.symbols,
        stem: place.stem,
        kernels: loader.kernels,
        net_form: common.net_form.map(crate::args::Form::net_form).or(place.config.net_form).unwrap_or_default(),
        config: place.config,
        source: place.path.zip(place.source),
        timings: loader.timings,
        lines,
    })
}

/// A source that is to be written anew.
pub(crate) struct Draft {
    /// All texts.
    pub(crate) sources: Sources,
    /// The source, if it could be read: its place and its text.
    pub(crate) source: Option<(PathBuf, FileId)>,
    /// Everything there is to say, in order.
    pub(crate) diagnostics: Vec<Diagnostic>,
    /// Errors beyond the limit.
    pub(crate) left_out: usize,
    /// The changes that give its blocks new numbers, if they are asked for.
    pub(crate) edits: Vec<pcl2_cfg::Edit>,
}

/// Reads the source at a path and parses it; the program is looked at for new numbers alone.
pub(crate) fn load_draft(path: &Path, common: &CommonArgs, renumber: bool) -> Draft {
    let mut loader = Loader::default();
    let place = loader.place(path);
    let mut edits = Vec::new();
    if let (Some(file), true) = (place.source, place.path.as_deref().is_some_and(nets::is_net)) {
        let (symbols, diagnostics) = (&mut loader.symbols, &mut loader.diagnostics);
        let _ = declare::net::read(&loader.sources, file, &place.stem, symbols, diagnostics);
        if renumber {
            let report = Diagnostic::new(codes::UNREADABLE, start_of(file), "expected a .cfg file, found a net");
            loader.diagnostics.push(report.help("leave --renumber off: a net has no numbers"));
        }
    } else if let Some(file) = place.source {
        let tree = syntax::parse(&loader.sources, file, &mut loader.symbols, &mut loader.diagnostics);
        if renumber && !loader.diagnostics.iter().any(Diagnostic::is_error) {
            edits = loader.renumber(file, &tree, &place, common);
        }
    }
    let mut diagnostics = loader.diagnostics;
    let left_out = diagnostic::finish(&mut diagnostics, false);
    Draft { sources: loader.sources, source: place.path.zip(place.source), diagnostics, left_out, edits }
}

/// Loads a program for a command that needs it whole: prints the diagnostics, and stops at errors.
pub(crate) fn load_verified(path: &Path, common: &CommonArgs) -> Result<(Project, Verified), Outcome> {
    whole(path, common, Use::Run)
}

/// The same where a period need not be known.
pub(crate) fn load_checked(path: &Path, common: &CommonArgs) -> Result<(Project, Verified), Outcome> {
    whole(path, common, Use::Check)
}

fn whole(path: &Path, common: &CommonArgs, purpose: Use) -> Result<(Project, Verified), Outcome> {
    let mut project = load_for(path, common, purpose, None)?;
    console::diagnostics(&project.diagnostics, &project.sources, project.left_out);
    match project.verified.take() {
        Some(verified) => Ok((project, verified)),
        None => Err(Outcome::Errors),
    }
}

fn period(common: &CommonArgs, config: &Config, diagnostics: &mut Vec<Diagnostic>) -> Result<Option<i64>, Outcome> {
    if let Some(text) = &common.period {
        return clock::period(text).map(Some).ok_or_else(|| {
            console::error(&format!("--period needs seconds above 0 in whole nanoseconds, found `{text}`"));
            Outcome::Usage
        });
    }
    let Some((text, span)) = &config.period else {
        return Ok(None);
    };
    let period = clock::period(text);
    if period.is_none() {
        let message = format!("expected a period in seconds above 0 in whole nanoseconds, found {text}");
        diagnostics.push(Diagnostic::new(codes::PERIOD, *span, message));
    }
    Ok(period)
}

/// What a path leads to.
struct Place {
    /// The source's file, if it could be read.
    source: Option<FileId>,
    /// The source's path.
    path: Option<PathBuf>,
    /// The project's folder: parameter files live below it.
    root: PathBuf,
    /// The file's stem.
    stem: String,
    config: Config,
}

/// Reads what a program is made of.
#[derive(Default)]
pub(crate) struct Loader {
    /// All texts.
    pub(crate) sources: Sources,
    /// All names.
    pub(crate) symbols: Symbols,
    /// Everything there is to say.
    pub(crate) diagnostics: Vec<Diagnostic>,
    kernels: Vec<(String, String)>,
    timings: Vec<(&'static str, Duration)>,
    /// Stands for the source's text.
    replaced: Option<Vec<u8>>,
    /// The folders in which nets are looked for.
    pub(crate) net_folders: Vec<PathBuf>,
}

impl Loader {
    fn place(&mut self, path: &Path) -> Place {
        let (source, root, config) = if path.is_dir() {
            self.folder(path)
        } else {
            let root = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
            (Some(path.to_path_buf()), root.to_path_buf(), Config::default())
        };
        let named = config.source.as_ref().map(|(_, span)| *span);
        let stem = source.as_deref().and_then(Path::file_stem).unwrap_or(path.as_os_str());
        let stem = stem.to_string_lossy().into_owned();
        let path = source;
        let source = path.as_deref().and_then(|source| match self.replaced.take() {
            Some(text) => Some(self.sources.add(source.display().to_string(), text)),
            None => self.read_program(source, named),
        });
        Place { source, path, root, stem, config }
    }

    fn folder(&mut self, path: &Path) -> (Option<PathBuf>, PathBuf, Config) {
        let root = path.to_path_buf();
        let Some(file) = self.read_source(&path.join("pcl2.toml"), MAX_SOURCE, None) else {
            return (None, root, Config::default());
        };
        let config = config::read(&self.sources, file, &mut self.diagnostics);
        let source = config.source.as_ref().map(|(name, _)| path.join(name));
        if source.is_none() && !self.diagnostics.iter().any(Diagnostic::is_error) {
            let message = "expected `source` in [controller], found none";
            self.diagnostics.push(Diagnostic::new(codes::CONFIGURATION, start_of(file), message));
        }
        (source, root, config)
    }

    /// Reads a program, which XML cannot be: nets in PNML are for other commands.
    fn read_program(&mut self, path: &Path, named: Option<Span>) -> Option<FileId> {
        let file = self.read_source(path, MAX_SOURCE, named)?;
        if !nets::is_pnml(path) && !self.sources.file(file).bytes().trim_ascii_start().starts_with(b"<") {
            return Some(file);
        }
        let message = format!("expected a .cfg or .net file, found `{}`, which is XML", path.display());
        let report = Diagnostic::new(codes::UNREADABLE, named.unwrap_or_else(|| start_of(file)), message);
        self.diagnostics
            .push(report.help("a net in PNML is for `pcl2 graph` and `pcl2 net`: analyze, matrix, fire, export"));
        None
    }

    /// Reads a source; a file that cannot be read is a diagnostic, where the file is named if that is a place.
    fn read_source(&mut self, path: &Path, limit: u64, named: Option<Span>) -> Option<FileId> {
        let clock = Instant::now();
        let name = path.display().to_string();
        match read_regular(path, limit) {
            Ok(bytes) => {
                let file = self.sources.add(name, bytes);
                self.timings.push(("read", clock.elapsed()));
                Some(file)
            }
            Err(why) => {
                let message = format!("expected a readable file, found `{name}`: {why}");
                let span = named.unwrap_or_else(|| start_of(self.sources.add(name, Vec::new())));
                self.diagnostics.push(Diagnostic::new(codes::UNREADABLE, span, message));
                None
            }
        }
    }

    fn catalogue(&mut self, place: &Place, common: &CommonArgs) -> Catalogue {
        let clock = Instant::now();
        let mut catalogue = Catalogue::packed(&mut self.sources, &mut self.symbols, &mut self.diagnostics);
        for (folder, span) in &place.config.blocks {
            self.user_blocks(&place.root.join(folder), Some(*span), &mut catalogue);
        }
        for folder in &common.blocks {
            self.user_blocks(folder, None, &mut catalogue);
        }
        self.timings.push(("blocks", clock.elapsed()));
        catalogue
    }

    fn user_blocks(&mut self, folder: &Path, named: Option<Span>, catalogue: &mut Catalogue) {
        self.net_folders.push(folder.to_path_buf());
        let names = match sorted_names(folder) {
            Ok(names) => names,
            Err(error) => {
                let shown = folder.display().to_string();
                let message = format!("expected a folder with blocks, found `{shown}`: {error}");
                let span = named.unwrap_or_else(|| start_of(self.sources.add(shown, Vec::new())));
                self.diagnostics.push(Diagnostic::new(codes::UNREADABLE, span, message));
                return;
            }
        };
        let mut files = Vec::new();
        for path in names {
            let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or("");
            if !matches!(extension, "fc" | "c" | "h") {
                continue;
            }
            match read_regular(&path, MAX_PARAMETERS) {
                Ok(bytes) if extension == "fc" => files.push(UserFile {
                    name: path.display().to_string(),
                    stem: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
                    bytes,
                }),
                Ok(bytes) => {
                    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                    self.kernels.push((name, String::from_utf8_lossy(&bytes).into_owned()));
                }
                Err(why) => {
                    let file = self.sources.add(path.display().to_string(), Vec::new());
                    let message = format!("expected a readable file, found `{}`: {why}", path.display());
                    self.diagnostics.push(Diagnostic::new(codes::UNREADABLE, start_of(file), message));
                }
            }
        }
        catalogue.add_user(&files, &mut self.sources, &mut self.symbols, &mut self.diagnostics);
    }

    fn compile(
        &mut self,
        file: FileId,
        place: &Place,
        catalogue: &mut Catalogue,
        common: &CommonArgs,
        (width, period): (Width, Option<i64>),
        purpose: Use,
    ) -> (Option<Verified>, usize) {
        let clock = Instant::now();
        self.net_folders.insert(0, place.root.clone());
        let lines = self.sources.file(file).lines();
        let alone = place.path.as_deref().is_some_and(nets::is_net);
        let tree = match alone {
            true => nets::tree(self, file, &place.stem, catalogue),
            false => Some(syntax::parse(&self.sources, file, &mut self.symbols, &mut self.diagnostics)),
        };
        self.timings.push(("parse", clock.elapsed()));
        let Some(tree) = tree else {
            return (None, lines);
        };
        if !alone {
            nets::wanted(self, &tree, catalogue);
        }
        let catalogue = &*catalogue;
        let files = parameter_files(&wanted_files(&tree, &self.sources), &place.root);
        let options = Options {
            name: place.config.name.clone().unwrap_or_else(|| place.stem.clone()),
            period,
            width,
            plant: common.plant.clone(),
            substeps: place.config.substeps.unwrap_or(1),
            tunable: place.config.tunable.clone(),
        };
        let input = Input {
            sources: &self.sources,
            file,
            tree: &tree,
            symbols: &self.symbols,
            catalogue,
            files: &files,
            options: &options,
            alone: catalogue.find(&place.stem).filter(|_| alone),
        };
        let clock = Instant::now();
        let program = pcl2_cfg::compile(&input, &mut self.diagnostics);
        self.timings.push(("check", clock.elapsed()));
        let Some(mut program) = program else {
            return (None, lines);
        };
        crate::io::bind(&place.config, &mut program, &mut self.diagnostics);
        if let (Some(pattern), Some(span)) = (place.config.tunable.unmatched(&program), place.config.tunable_span) {
            let message = format!("expected names of blocks, found `{pattern}`, which no block has");
            self.diagnostics.push(Diagnostic::new(codes::CONFIGURATION, span, message));
        }
        self.missing_kernels(&program.decls);
        pcl2_cfg::check_period(&program, purpose == Use::Run, &mut self.diagnostics);
        let clock = Instant::now();
        let verified = match verify(program) {
            Ok(verified) => Some(verified),
            Err(defect) => {
                let message = format!("the compiler contradicts itself: {defect}");
                self.diagnostics.push(Diagnostic::new(codes::DEFECT, start_of(file), message));
                None
            }
        };
        self.timings.push(("verify", clock.elapsed()));
        if let Some(verified) = &verified {
            self.refusals(verified);
        }
        (verified, lines)
    }

    fn renumber(
        &mut self,
        file: FileId,
        tree: &syntax::Tree,
        place: &Place,
        common: &CommonArgs,
    ) -> Vec<pcl2_cfg::Edit> {
        let mut catalogue = self.catalogue(place, common);
        self.net_folders.insert(0, place.root.clone());
        nets::wanted(self, tree, &mut catalogue);
        let options = Options {
            name: place.stem.clone(),
            period: None,
            width: Width::default(),
            plant: Vec::new(),
            substeps: 1,
            tunable: pcl2_cfg::Tunable::All,
        };
        let input = Input {
            sources: &self.sources,
            file,
            tree,
            symbols: &self.symbols,
            catalogue: &catalogue,
            files: &FxHashMap::default(),
            options: &options,
            alone: None,
        };
        pcl2_cfg::renumber(&input, &mut self.diagnostics).unwrap_or_default()
    }

    /// What only kernels can judge: each is asked once about the parameters as written.
    fn refusals(&mut self, verified: &Verified) {
        let clock = Instant::now();
        for refusal in pcl2_sim::engine::judge(verified) {
            let span = verified.program().main().block(refusal.block).span;
            self.diagnostics.push(Diagnostic::new(codes::REFUSED, span, refusal.to_string()));
        }
        self.timings.push(("judge", clock.elapsed()));
    }

    /// A user's own code needs its C beside it.
    fn missing_kernels(&mut self, used: &[Decl]) {
        for decl in used.iter().filter(|decl| decl.user && decl.has_kernel()) {
            let file = if decl.inline { format!("{}_inline.h", decl.stem) } else { format!("{}.c", decl.stem) };
            if !self.kernels.iter().any(|(name, _)| *name == file) {
                let message =
                    format!("expected the C of `{}` in `{file}` beside its declaration, found no such file", decl.name);
                self.diagnostics.push(Diagnostic::new(codes::MISSING_KERNEL, decl.span, message));
            }
        }
    }
}

/// The start of a file.
pub(crate) fn start_of(file: FileId) -> Span {
    Span { file, start: 0, end: 0 }
}

/// Reads a regular file of bounded size; anything else is refused without being opened for long.
pub(crate) fn read_regular(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let data = fs::metadata(path).map_err(|error| plain(&error))?;
    if data.is_dir() {
        return Err("it is a folder".to_owned());
    }
    if !data.is_file() {
        return Err("it is not a regular file".to_owned());
    }
    if data.len() > limit {
        return Err(format!("it has {} bytes, more than {limit}", data.len()));
    }
    // Files of the system may block or have no end; their length is 0.
    let mut bytes = Vec::new();
    let file = fs::File::open(path).map_err(|error| plain(&error))?;
    file.take(data.len()).read_to_end(&mut bytes).map_err(|error| plain(&error))?;
    Ok(bytes)
}

/// An operating system's message in our own words, where it is a common one.
fn plain(error: &std::io::Error) -> String {
    match error.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
        std::io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    }
}

fn sorted_names(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(folder).map_err(|error| plain(&error))?;
    let mut names = Vec::new();
    for entry in entries {
        names.push(entry.map_err(|error| plain(&error))?.path());
    }
    names.sort();
    Ok(names)
}

fn parameter_files(names: &[String], root: &Path) -> FxHashMap<String, FileText> {
    let read = |name: &String| match read_parameters(name, root) {
        Ok(bytes) => FileText::Bytes(bytes),
        Err(why) => FileText::Unusable(why),
    };
    names.iter().map(|name| (name.clone(), read(name))).collect()
}

/// Reads a parameter file: a regular file inside the project's folder, no link out.
fn read_parameters(name: &str, root: &Path) -> Result<Vec<u8>, String> {
    let relative = Path::new(name);
    let leaves = relative.is_absolute() || relative.components().any(|part| matches!(part, Component::ParentDir));
    if leaves || name.is_empty() {
        return Err("it is outside the project's folder".to_owned());
    }
    let path = root.join(relative);
    let (root, target) = (root.canonicalize().map_err(|e| plain(&e))?, path.canonicalize().map_err(|e| plain(&e))?);
    if !target.starts_with(&root) {
        return Err("it is a link out of the project's folder".to_owned());
    }
    read_regular(&target, MAX_PARAMETERS)
}

/// The catalogue with the user's blocks of the command line; `None` after printing what is wrong with them.
pub(crate) fn catalogue(common: &CommonArgs) -> Option<Catalogue> {
    let mut loader = Loader::default();
    let place =
        Place { source: None, path: None, root: PathBuf::from("."), stem: String::new(), config: Config::default() };
    let catalogue = loader.catalogue(&place, common);
    let left_out = diagnostic::finish(&mut loader.diagnostics, common.strict);
    console::diagnostics(&loader.diagnostics, &loader.sources, left_out);
    let failed = loader.diagnostics.iter().any(Diagnostic::is_error);
    (!failed).then_some(catalogue)
}

//! The cc engine: the emitted C and a loop around it, compiled and run as a process of its own.

use super::embedded::refused;
use super::job::Job;
use super::progress::Progress;
use super::recorder::{Recorder, Recording};
use super::{Failure, Finished};
use crate::project::Project;
use crate::toolchain::{self, Board, Toolchain};
use pcl2_emit::runner::{self, Place, Script};
use pcl2_lang::model::Point;
use pcl2_lang::types::{Scalar, Width};
use pcl2_lang::verify::Verified;
use pcl2_sim::engine::Machine;
use pcl2_sim::health::{FaultAt, Health};
use pcl2_sim::names::Element;
use pcl2_sim::number::Number;
use std::fs;
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use tempfile::TempDir;

/// Runs a job.
pub(crate) fn run(
    job: &Job<'_>,
    verified: &Verified,
    project: &Project,
    toolchain: &Toolchain,
    recorder: &mut Recorder,
) -> Result<Finished, Failure> {
    let folder = tempfile::Builder::new().prefix("pcl2-").tempdir().map_err(|error| cannot("make a folder", &error))?;
    let program = build(verified, project, toolchain, &folder)?;
    let script = folder.path().join("script");
    write(&script, &script_of(job, recorder).bytes())?;
    let (mut child, output) = start(&program, &script, toolchain.board, &folder)?;
    let words = Words(BufReader::with_capacity(1 << 16, output));
    let refusals = Refusals { shadow: Machine::new(verified).ok(), next: 0 };
    let mut reader = Reader { job, words, progress: Progress::new(job.scans), refusals };
    match reader.read(recorder) {
        Ok(finished) => Ok(finished),
        Err(Ended::Failure(failure)) => Err(failure),
        Err(Ended::Early) => Err(Failure::failed(child.reason())),
    }
}

/// Starts the program; what it writes comes by a pipe, from an emulated board by a file when it is done.
fn start(
    program: &Path,
    script: &Path,
    board: Option<Board>,
    folder: &TempDir,
) -> Result<(Running, Box<dyn Read>), Failure> {
    let out = folder.path().join("out");
    let mut command = match board {
        Some(board) => board.run(program, &[script, &out]),
        None => Command::new(program),
    };
    if board.is_some() {
        toolchain::run(command).map_err(Failure::failed)?;
        let file = fs::File::open(&out).map_err(|error| cannot("read what the emulated program wrote", &error))?;
        return Ok((Running(None), Box::new(file)));
    }
    command.arg(script).stdin(Stdio::null()).stdout(Stdio::piped());
    let mut child = command.spawn().map_err(|error| cannot("start the compiled program", &error))?;
    match child.stdout.take() {
        Some(stdout) => Ok((Running(Some(child)), Box::new(stdout))),
        None => Err(Failure::failed("the compiled program has no output")),
    }
}

/// A process that does not outlive its reader.
struct Running(Option<Child>);

impl Running {
    fn reason(&mut self) -> String {
        let early = "the compiled program ended early";
        match self.0.as_mut().map(Child::wait) {
            Some(Ok(status)) => format!("{early} ({status})"),
            Some(Err(error)) => format!("{early} ({error})"),
            None => early.to_owned(),
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if let Some(child) = &mut self.0 {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

fn cannot(what: &str, error: &io::Error) -> Failure {
    Failure::failed(format!("cannot {what}: {error}"))
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    folder.and_then(|()| fs::write(path, bytes)).map_err(|error| cannot("write the program to compile", &error))
}

/// Emits, writes and compiles the program with its runner.
fn build(verified: &Verified, project: &Project, toolchain: &Toolchain, folder: &TempDir) -> Result<PathBuf, Failure> {
    let emitted = pcl2_emit::emit(verified, &project.sources, &project.emit_options());
    for (path, text) in &emitted.files {
        write(&folder.path().join(path), text.as_bytes())?;
    }
    write(&folder.path().join("pcl2_runner.c"), runner::runner(&emitted.name).as_bytes())?;
    let mut includes = vec![folder.path().to_path_buf()];
    includes.extend(emitted.folders.iter().map(|name| folder.path().join(name)));
    let mut command = toolchain.compile(&includes);
    let main = format!("{}.c", emitted.name);
    let sources = emitted.sources.iter().filter(|source| **source != main).map(String::as_str);
    command.args(sources.chain(["pcl2_runner.c"]).map(|source| folder.path().join(source)));
    let program = folder.path().join("pcl2_run");
    if let Some(board) = toolchain.board {
        for (name, text) in board.files() {
            write(&folder.path().join(name), text.as_bytes())?;
        }
        board.link(folder.path(), &mut command);
    }
    command.arg("-o").arg(&program).arg("-lm");
    toolchain::run(command).map_err(Failure::failed)?;
    Ok(program)
}

fn script_of(job: &Job<'_>, recorder: &Recorder) -> Script {
    let event = |event: &pcl2_sim::stimulus::Event| (event.scan, place(&event.element), bits(event.value));
    Script {
        scans: job.scans,
        columns: job.columns.iter().map(place).collect(),
        params: job.params.iter().map(place).collect(),
        rows: recorder.samples(),
        events: job.events.iter().map(event).collect(),
    }
}

fn place(element: &Element) -> Place {
    (element.point, element.element)
}

fn bits(value: Number) -> u64 {
    match value {
        Number::Int(value) => u64::from(value as u32),
        Number::Time(value) => value as u64,
        Number::Double(value) => value.to_bits(),
        Number::Single(value) => u64::from(value.to_bits()),
    }
}

fn number(bits: u64, point: &Point, width: Width) -> Number {
    match (point.time, point.ty.scalar, width) {
        (true, ..) => Number::Time(bits as i64),
        (false, Scalar::Int, _) => Number::Int(bits as u32 as i32),
        (false, Scalar::Real, Width::F64) => Number::Double(f64::from_bits(bits)),
        (false, Scalar::Real, Width::F32) => Number::Single(f32::from_bits(bits as u32)),
    }
}

/// Why reading stopped.
enum Ended {
    /// The process said too little.
    Early,
    /// An output failed.
    Failure(Failure),
}

struct Words<R: Read>(R);

impl<R: Read> Words<R> {
    fn next(&mut self) -> Result<u64, Ended> {
        let mut word = [0; 8];
        self.0.read_exact(&mut word).map_err(|_| Ended::Early)?;
        Ok(u64::from_ne_bytes(word))
    }
}

struct Reader<'a, R: Read> {
    job: &'a Job<'a>,
    words: Words<R>,
    progress: Progress,
    refusals: Refusals<'a>,
}

impl<R: Read> Reader<'_, R> {
    fn read(&mut self, recorder: &mut Recorder) -> Result<Finished, Ended> {
        let mut scan = 0;
        let mut row = Vec::with_capacity(self.job.columns.len());
        loop {
            match self.words.next()? {
                runner::ROW => {
                    let recorded = recorder.next(scan);
                    self.numbers(&self.job.columns, &mut row)?;
                    if recorder.row(recorded, &row).map_err(Ended::Failure)? == Recording::Closed {
                        return Ok(Finished::default());
                    }
                    scan = recorded + 1;
                    if scan % (1 << 12) == 0 {
                        self.progress.at(scan);
                    }
                }
                runner::REFUSED => {
                    let (scan, point) = (self.words.next()?, self.words.next()?);
                    self.progress.line(&refused(scan, &self.refusals.reason(self.job, scan, point as u32)));
                }
                runner::END => return self.end(),
                _ => return Err(Ended::Early),
            }
        }
    }

    fn numbers(&mut self, elements: &[Element], values: &mut Vec<Number>) -> Result<(), Ended> {
        values.clear();
        let width = self.job.names.program.width;
        for element in elements {
            values.push(number(self.words.next()?, self.job.names.point(*element), width));
        }
        Ok(())
    }

    fn end(&mut self) -> Result<Finished, Ended> {
        let (faults, refused) = (self.words.next()? as u32, self.words.next()? as u32);
        let (first, last) = (self.fault()?, self.fault()?);
        let mut params = Vec::with_capacity(self.job.params.len());
        self.numbers(&self.job.params, &mut params)?;
        Ok(Finished { health: Health { faults, refused, first, last }, params })
    }

    fn fault(&mut self) -> Result<Option<FaultAt>, Ended> {
        let (block, status) = (self.words.next()? as u32, self.words.next()? as u32 as i32);
        let scan = self.words.next()? as u32;
        Ok((status != 0).then_some(FaultAt { block, status, scan }))
    }
}

/// Says why a set was refused: parameters change by sets alone, so the embedded engine comes to the same verdict
/// without running a scan.
struct Refusals<'a> {
    /// None: the program has C of the user's own.
    shadow: Option<Machine<'a>>,
    /// The first event that the shadow has not seen.
    next: usize,
}

impl Refusals<'_> {
    fn reason(&mut self, job: &Job<'_>, scan: u64, point: u32) -> String {
        let mut reason = None;
        while let (Some(machine), Some(event)) = (&mut self.shadow, job.events.get(self.next)) {
            if event.scan > scan {
                break;
            }
            let rest = &job.events[self.next..];
            let due = rest.partition_point(|other| other.scan <= event.scan);
            reason = machine.apply(job.names, &rest[..due]).err().map(|refusal| refusal.to_string());
            self.next += due;
        }
        let known = job.names.points.get(point as usize);
        reason.unwrap_or_else(|| {
            known.map_or_else(|| "it names no parameter".to_owned(), |point| format!("`{}`", point.name))
        })
    }
}

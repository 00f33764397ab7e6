//! Output that appears whole or not at all.

use super::Failure;
use crate::output::Pending;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;

/// Whether a path stands for standard output.
pub(crate) fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

/// A file that takes its place when it is complete. What is no regular file is written as it stands.
#[derive(Debug)]
pub(crate) enum Output {
    /// Standard output.
    Stdout(io::Stdout),
    /// A device or a pipe.
    Direct(File),
    /// A file on the way to its place.
    Pending(Pending),
}

impl Output {
    /// Opens an output.
    pub(crate) fn open(path: &Path) -> Result<Output, Failure> {
        if is_stdout(path) {
            return Ok(Output::Stdout(io::stdout()));
        }
        open(path).map_err(|error| cannot_write(path, &error))
    }

    /// Moves a complete file to its place.
    pub(crate) fn keep(self) -> Result<(), Failure> {
        let Output::Pending(file) = self else {
            return Ok(());
        };
        let path = file.path().to_path_buf();
        file.keep().map_err(|error| cannot_write(&path, &error))
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Output::Stdout(stdout) => stdout.write(bytes),
            Output::Direct(file) => file.write(bytes),
            Output::Pending(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Output::Stdout(stdout) => stdout.flush(),
            Output::Direct(file) => file.flush(),
            Output::Pending(file) => file.flush(),
        }
    }
}

fn open(path: &Path) -> io::Result<Output> {
    match fs::metadata(path) {
        Ok(data) if !data.is_file() => Ok(Output::Direct(fs::OpenOptions::new().write(true).open(path)?)),
        Ok(_) => Pending::new(&path.canonicalize()?).map(Output::Pending),
        Err(_) => Pending::new(path).map(Output::Pending),
    }
}

/// Writes a whole text.
pub(crate) fn write(path: &Path, output: &mut Output, bytes: &[u8]) -> Result<(), Failure> {
    output.write_all(bytes).and_then(|()| output.flush()).map_err(|error| cannot_write(path, &error))
}

/// The message for an output that fails.
pub(crate) fn cannot_write(path: &Path, error: &io::Error) -> Failure {
    let reason = match error.kind() {
        io::ErrorKind::NotFound => "there is no such folder".to_owned(),
        io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
        _ => error.to_string(),
    };
    Failure::failed(format!("cannot write `{}`: {reason}", path.display()))
}

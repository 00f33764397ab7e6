//! Files that appear whole or not at all, whatever happens meanwhile.

use std::fs::{self, File, Permissions};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};

/// A file without a name, in the folder of the place that it takes when it is complete. A command that ends early, even
/// killed, leaves nothing.
#[derive(Debug)]
pub(crate) struct Pending {
    file: File,
    path: PathBuf,
}

impl Pending {
    /// Opens a file for a place.
    pub(crate) fn new(path: &Path) -> io::Result<Pending> {
        Ok(Pending { file: tempfile::tempfile_in(folder(path))?, path: path.to_path_buf() })
    }

    /// The place.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Moves the complete file to its place.
    pub(crate) fn keep(mut self) -> io::Result<()> {
        self.file.flush()?;
        set_readable(&self.file)?;
        match link(&self.file, &self.path) {
            Ok(()) => Ok(()),
            Err(_) => self.copy(),
        }
    }

    /// For systems that cannot give a nameless file a name.
    fn copy(mut self) -> io::Result<()> {
        self.file.rewind()?;
        let mut named = builder().tempfile_in(folder(&self.path))?;
        io::copy(&mut self.file, &mut named)?;
        set_readable(named.as_file())?;
        named.persist(&self.path).map(drop).map_err(|error| error.error)
    }
}

impl Write for Pending {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Writes a file at once.
pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = Pending::new(path)?;
    file.write_all(bytes)?;
    file.keep()
}

/// Writes a file that exists anew: behind links, with the permissions that it has.
pub(crate) fn rewrite_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let path = path.canonicalize()?;
    let permissions = fs::metadata(&path)?.permissions();
    if permissions.readonly() {
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only"));
    }
    let mut file = builder().permissions(permissions).tempfile_in(folder(&path))?;
    file.write_all(bytes)?;
    file.persist(&path).map(drop).map_err(|error| error.error)
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".pcl2-");
    builder
}

/// Gives a nameless file a name, and moves it: a name cannot be given where a file is.
#[cfg(target_os = "linux")]
fn link(file: &File, path: &Path) -> io::Result<()> {
    use rustix::fs::{AtFlags, CWD, linkat};
    use std::os::fd::AsRawFd;
    let open = format!("/proc/self/fd/{}", file.as_raw_fd());
    let name = |name: &Path| Ok(linkat(CWD, &open, CWD, name, AtFlags::SYMLINK_FOLLOW)?);
    let named = builder().make_in(folder(path), name)?;
    named.persist(path).map(drop).map_err(|error| error.error)
}

#[cfg(not(target_os = "linux"))]
fn link(_file: &File, _path: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Temporary files are private; what they become is an ordinary file.
#[cfg(unix)]
fn set_readable(file: &File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn set_readable(_file: &File) -> io::Result<()> {
    Ok(())
}

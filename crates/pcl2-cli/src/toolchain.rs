//! C compilers: the host's, and cross compilers by target name.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Flags of every compilation: the same bits everywhere.
const COMMON: [&str; 3] = ["-std=c99", "-O2", "-ffp-contract=off"];

/// A microcontroller or processor that a cross compiler makes code for.
struct Target {
    name: &'static str,
    prefix: &'static str,
    flags: &'static [&'static str],
    /// Small code counts more than speed.
    small: bool,
    /// The board that QEMU emulates, to run programs of this target.
    board: Option<&'static str>,
}

const TARGETS: [Target; 5] = [
    Target {
        name: "cortex-m0",
        prefix: "arm-none-eabi-",
        flags: &["-mcpu=cortex-m0", "-mthumb"],
        small: true,
        board: None,
    },
    Target {
        name: "cortex-m3",
        prefix: "arm-none-eabi-",
        flags: &["-mcpu=cortex-m3", "-mthumb"],
        small: true,
        board: Some("mps2-an385"),
    },
    Target {
        name: "cortex-m4",
        prefix: "arm-none-eabi-",
        flags: &["-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"],
        small: true,
        board: Some("mps2-an386"),
    },
    Target {
        name: "cortex-m7",
        prefix: "arm-none-eabi-",
        flags: &["-mcpu=cortex-m7", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv5-d16"],
        small: true,
        board: Some("mps2-an500"),
    },
    Target { name: "host", prefix: "", flags: &[], small: false, board: None },
];

/// A C compiler with its flags.
#[derive(Clone, Debug)]
pub(crate) struct Toolchain {
    compiler: Vec<String>,
    archiver: String,
    sizer: String,
    flags: Vec<String>,
    /// The board that an emulator has for the target.
    pub(crate) board: Option<Board>,
}

impl Toolchain {
    /// `$CC` or `cc`.
    pub(crate) fn host() -> Toolchain {
        let compiler =
            std::env::var("CC").ok().filter(|text| !text.trim().is_empty()).unwrap_or_else(|| "cc".to_owned());
        let archiver =
            std::env::var("AR").ok().filter(|text| !text.trim().is_empty()).unwrap_or_else(|| "ar".to_owned());
        let compiler = compiler.split_whitespace().map(str::to_owned).collect();
        Toolchain {
            compiler,
            archiver,
            sizer: "size".to_owned(),
            flags: COMMON.map(str::to_owned).to_vec(),
            board: None,
        }
    }

    /// The cross compiler of a target; `Err` lists the known names.
    pub(crate) fn of(target: Option<&str>) -> Result<Toolchain, String> {
        let Some(name) = target.filter(|name| *name != "host") else {
            return Ok(Toolchain::host());
        };
        let Some(target) = TARGETS.iter().find(|target| target.name == name) else {
            let known: Vec<&str> = TARGETS.iter().map(|target| target.name).collect();
            return Err(format!("unknown target `{name}`; known are {}", known.join(", ")));
        };
        let mut flags = COMMON.map(str::to_owned).to_vec();
        if target.small {
            flags[1] = "-Os".to_owned();
        }
        flags.extend(["-ffunction-sections", "-fdata-sections"].map(str::to_owned));
        flags.extend(target.flags.iter().map(|flag| (*flag).to_owned()));
        Ok(Toolchain {
            compiler: vec![format!("{}gcc", target.prefix)],
            archiver: format!("{}ar", target.prefix),
            sizer: format!("{}size", target.prefix),
            flags,
            board: target.board.map(Board),
        })
    }

    /// The compiler's name for messages.
    pub(crate) fn name(&self) -> &str {
        self.compiler.first().map_or("cc", String::as_str)
    }

    /// A compilation with the flags and the folders of headers; sources, output and libraries are added by the caller.
    pub(crate) fn compile(&self, includes: &[PathBuf]) -> Command {
        let mut command = Command::new(self.name());
        command.args(self.compiler.iter().skip(1)).args(&self.flags);
        for folder in includes {
            command.arg("-I").arg(folder);
        }
        command
    }

    /// The sizes of objects.
    pub(crate) fn size(&self, objects: &[PathBuf]) -> Command {
        let mut command = Command::new(&self.sizer);
        command.args(objects);
        command
    }

    /// An archive of objects.
    pub(crate) fn archive(&self, library: &Path, objects: &[PathBuf]) -> Command {
        let mut command = Command::new(&self.archiver);
        command.arg("rcs").arg(library).args(objects);
        command
    }
}

/// An emulated board. Its C library gets arguments and files from the emulator, by semihosting.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Board(&'static str);

impl Board {
    /// The board's port: start code and linker script, by file name. The MPS2 boards share one.
    pub(crate) fn files(self) -> impl Iterator<Item = (&'static str, &'static str)> {
        let files = pcl2_emit::runtime_files().iter();
        files.filter_map(|(path, text)| path.strip_prefix("ports/mps2/").map(|name| (name, *text)))
    }

    /// What the linker needs beside the objects, with the port's files in this folder.
    pub(crate) fn link(self, folder: &Path, command: &mut Command) {
        command.arg("--specs=rdimon.specs").arg("-T").arg(folder.join("link.ld")).arg(folder.join("start.c"));
    }

    /// Runs a program with arguments.
    pub(crate) fn run(self, program: &Path, arguments: &[&Path]) -> Command {
        let mut semihosting = "enable=on,target=native,arg=program".to_owned();
        for argument in arguments {
            semihosting.push_str(&format!(",arg={}", argument.display()));
        }
        let mut command = Command::new("qemu-system-arm");
        command.args(["-M", self.0, "-nographic", "-monitor", "none", "-serial", "none", "-semihosting-config"]);
        command.arg(semihosting).arg("-kernel").arg(program);
        command
    }
}

/// Runs a compiler; an error is what it said.
pub(crate) fn run(mut command: Command) -> Result<Output, String> {
    let name = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => format!("the C compiler `{name}` was not found; set CC, or install one"),
        _ => format!("`{name}` could not be started: {error}"),
    })?;
    if output.status.success() {
        return Ok(output);
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("`{name}` failed ({}):\n{}", output.status, said.trim_end()))
}

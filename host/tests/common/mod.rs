//! Running the command, and the scenes that lie outside the repository.
#![allow(dead_code, unreachable_pub)]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Runs the command in a directory.
pub fn whitted(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_whitted"))
        .current_dir(directory)
        .args(arguments)
        .output()
        .expect("the command starts")
}

/// What it said on stderr.
pub fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// What it said on stdout.
pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The names of the files in a directory.
pub fn files(directory: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(directory).expect("the directory is there");
    let mut names: Vec<String> =
        entries.map(|e| e.expect("readable").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The scenes of the Standard Procedural Databases, which lie beside the repository where they
/// are at hand. `None`, said aloud, where they aren't.
pub fn spd() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/scenes/spd");
    let place = std::env::var_os("WHITTED_SPD").map_or(beside, PathBuf::from);
    if place.is_dir() {
        return Some(place);
    }
    eprintln!("skipped: no SPD scenes at {} (set WHITTED_SPD)", place.display());
    None
}

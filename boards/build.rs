//! Shared by every board: puts the board's own memory map, and nobody else's, where the linker
//! finds it.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    let board = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let riscv = env::var("CARGO_CFG_TARGET_ARCH").is_ok_and(|arch| arch == "riscv32");
    // A chip with cores of two kinds has two, neither of them `memory.x`: the board is a workspace of its own,
    // and the linker, which looks in its directory first, would take that without what is added here.
    let other = board.join(if riscv { "memory-riscv32.x" } else { "memory-arm.x" });
    let map = if other.exists() { other } else { board.join("memory.x") };
    let mut parts = vec![map.clone()];
    // What is copied to RAM; riscv-rt has no such way for more than .data.
    if env::var_os("CARGO_FEATURE_RAM").is_some() && !riscv {
        parts.push(board.join("../ram.x"));
    }
    let mut text = String::new();
    for part in parts {
        text += &fs::read_to_string(&part).expect("a board has a memory.x");
        println!("cargo::rerun-if-changed={}", part.display());
    }
    fs::write(out.join("memory.x"), text).expect("cargo made the directory");
    println!("cargo::rustc-link-search={}", out.display());
    // Sections needn't start on a page: without this, gaps of up to 64 KiB appear in flash.
    println!("cargo::rustc-link-arg-bins=--nmagic");
    // riscv-rt's script doesn't include the map by itself. By its path, since a memory.x in the
    // linker's working directory wins over any other.
    if riscv {
        println!("cargo::rustc-link-arg-bins=-T{}", map.display());
    }
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    if env::var_os("CARGO_FEATURE_RTT").is_some() {
        println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
    }
}

//! Puts the reference board's memory map, with the second stage loader's section, where the
//! linker finds it.

use std::path::PathBuf;
use std::{env, fs};

fn main() {
    let board = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let mut map = String::new();
    let mut parts = vec![board.join("../../memory.x"), board.join("boot2.x")];
    if env::var_os("CARGO_FEATURE_RAM").is_some() {
        parts.push(board.join("../ram.x"));
    }
    for part in parts {
        map += &fs::read_to_string(&part).expect("the map is there");
        println!("cargo::rerun-if-changed={}", part.display());
    }
    fs::write(out.join("memory.x"), map).expect("cargo made the directory");
    println!("cargo::rustc-link-search={}", out.display());
    // Sections needn't start on a page: without this, gaps of up to 64 KiB appear in flash.
    println!("cargo::rustc-link-arg-bins=--nmagic");
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    if env::var_os("CARGO_FEATURE_RTT").is_some() {
        println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
    }
}

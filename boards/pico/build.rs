//! Puts the reference board's memory map, with the second stage loader's section, where the
//! linker finds it.

use std::path::{Path, PathBuf};
use std::{env, fs};

/// The programs whose frames may run from RAM.
const IN_RAM: [&str; 2] = ["pico", "depths"];
/// The one whose tracer, for every blob, is too large for that.
const IN_FLASH: &str = "flash";

fn main() {
    let board = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let parts = ["../../memory.x", "boot2.x", "scene.x"].map(|part| board.join(part));
    let map: String = parts.iter().map(|part| read(part)).collect();
    let plain = out.join("flash");
    fs::create_dir_all(&plain).expect("cargo made the directory");
    fs::write(plain.join("memory.x"), &map).expect("it has just been made");
    let ram = env::var_os("CARGO_FEATURE_RAM").map(|_| read(&board.join("../ram.x")));
    fs::write(out.join("memory.x"), map + &ram.unwrap_or_default())
        .expect("cargo made the directory");
    // A map for each: the linker takes the first of this name that it finds.
    println!("cargo::rustc-link-arg-bin={IN_FLASH}=-L{}", plain.display());
    for bin in IN_RAM {
        println!("cargo::rustc-link-arg-bin={bin}=-L{}", out.display());
    }
    // Sections needn't start on a page: without this, gaps of up to 64 KiB appear in flash.
    println!("cargo::rustc-link-arg-bins=--nmagic");
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    if env::var_os("CARGO_FEATURE_RTT").is_some() {
        println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
    }
}

/// A part of a map.
fn read(part: &Path) -> String {
    println!("cargo::rerun-if-changed={}", part.display());
    fs::read_to_string(part).expect("the map is there")
}

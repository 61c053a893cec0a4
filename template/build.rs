//! Bakes `scene.toml` into Rust source and puts the memory map where the linker finds it.

use std::path::PathBuf;
use std::{env, fs};

use whitted::math::Fixed;
use whitted_host::build;
use whitted_host::document::Size;

/// The display's; as in `src/main.rs`.
const SIZE: Size = Size { width: 240, height: 240 };

fn main() {
    build::source::<Fixed>("scene.toml", Some(SIZE));

    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    fs::copy("memory.x", out.join("memory.x")).expect("memory.x is there");
    println!("cargo::rerun-if-changed=memory.x");
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rustc-link-arg-bins=--nmagic");
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
    println!("cargo::rustc-link-arg-bins=-Tdefmt.x");
}

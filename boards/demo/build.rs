//! Bakes the bathroom, once for each arithmetic, for `src/scenes` to include, and the showcase as a
//! blob for `src/flash.rs`.

use std::{fs, path::Path};

use whitted::math::Fixed;
use whitted_host::bake::Construct;
use whitted_host::build;
use whitted_host::document::Size;

const SCENE: &str = "../../host/scenes/bathroom-small.toml";
const SIZE: Size = Size { width: 160, height: 120 };
const SHOWCASE: &str = "../../host/scenes/showcase.toml";
/// The display of the board that shows it.
const OLED: Size = Size { width: 128, height: 64 };

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    bake::<Fixed>("bathroom_fixed.rs");
    bake::<f32>("bathroom_f32.rs");
    build::blob::<Fixed>(SHOWCASE, Some(OLED));
}

/// Bakes under a name of its own: the scene's file has one name for both.
fn bake<A: Construct>(name: &str) {
    let baked = build::source::<A>(Path::new(SCENE), Some(SIZE));
    fs::rename(&baked, baked.with_file_name(name)).expect("it was just written");
}

//! Bakes the scene into a blob, renders it here to know what the board has to draw, and puts the
//! memory map where the linker finds it.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::{env, fs};

use whitted::frame::Sampling;
use whitted::math::Fixed;
use whitted_host::bake::Baked;
use whitted_host::document::Size;
use whitted_host::render::{Settings, render};
use whitted_host::{build, read};

const SIZE: Size = Size { width: 96, height: 64 };
/// The other program's scene, whose light is an area: some ten rays for each of another. Its
/// irradiance records are made here.
const BATHROOM: &str = "../../host/scenes/bathroom-indirect.toml";
const SMALL: Size = Size { width: 40, height: 30 };

fn main() {
    println!("cargo::rerun-if-env-changed=WHITTED_SCENE");
    let showcase = || PathBuf::from("../../host/scenes/showcase.toml");
    let scene = env::var_os("WHITTED_SCENE").map_or_else(showcase, PathBuf::from);
    let blob = build::blob::<Fixed>(&scene, Some(SIZE));
    println!("cargo::rustc-env=BLOB={}", blob.display());
    let (checksum, rays) = wanted(&scene, SIZE);
    println!("cargo::rustc-env=WANTED={checksum}");
    println!("cargo::rustc-env=RAYS={rays}");

    println!("cargo::rerun-if-env-changed=WHITTED_SOURCE");
    let bathroom = || PathBuf::from(BATHROOM);
    let scene = env::var_os("WHITTED_SOURCE").map_or_else(bathroom, PathBuf::from);
    let source = build::source::<Fixed>(&scene, Some(SMALL));
    let (checksum, rays) = wanted(&scene, SMALL);
    println!("cargo::rustc-env=SOURCE={}", source.display());
    println!("cargo::rustc-env=SOURCE_WANTED={checksum}");
    println!("cargo::rustc-env=SOURCE_RAYS={rays}");

    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let map = Path::new("memory.x");
    fs::copy(map, out.join("memory.x")).expect("the board has a memory.x");
    println!("cargo::rerun-if-changed={}", map.display());
    println!("cargo::rustc-link-search={}", out.display());
    println!("cargo::rustc-link-arg-bins=--nmagic");
    println!("cargo::rustc-link-arg-bins=-Tlink.x");
}

/// The checksum of the picture that the host renders, FNV-1a of the pixels' bytes, and its rays.
fn wanted(scene: &Path, size: Size) -> (u64, u64) {
    let document = read::read(scene).unwrap_or_else(|error| panic!("{error}"));
    let baked = Baked::<Fixed>::new(&document).unwrap_or_else(|flaw| panic!("{}", flaw.of(scene)));
    let settings = Settings {
        size,
        depth: document.rules.depth.min(8),
        sampling: Sampling::Center,
        indirect: document.indirect,
        show: None,
        threads: NonZeroUsize::MIN,
    };
    let rendered =
        render(&baked, &settings, |_| {}).unwrap_or_else(|flaw| panic!("{}", flaw.of(scene)));
    let mut picture = rendered.picture;
    let bytes = picture.rows_mut().flatten().flat_map(|pixel| *pixel);
    let checksum = bytes.fold(0xCBF2_9CE4_8422_2325, |sum: u64, byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
    });
    // The board makes no records: it has them.
    (checksum, rendered.counts.rays() - rendered.made.rays())
}

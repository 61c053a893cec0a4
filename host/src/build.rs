//! Baking from a build script.
//!
//! With `whitted-host` as a build-dependency, a firmware's `build.rs` is
//!
//! ```no_run
//! use whitted::math::Fixed;
//!
//! // For a chip without a floating-point unit, into OUT_DIR; `f32` for one with it.
//! whitted_host::build::blob::<Fixed>("scenes/room.toml", None);
//! ```
//!
//! and the firmware takes the scene in by
//! `whitted::include_blob!(concat!(env!("OUT_DIR"), "/room.bin"))`; or, for [`source`], by
//! `include!(concat!(env!("OUT_DIR"), "/room.rs"))` in a module of its own.

use std::path::{Path, PathBuf};
use std::{env, fs};

use crate::bake::{Baked, Construct, Thrift};
use crate::document::{Document, Size};
use crate::read;

/// The picture's size if nothing says another.
const SIZE: Size = Size { width: 320, height: 240 };

/// Bakes a scene file into a blob in `OUT_DIR`, of the file's name with the ending `.bin`, its
/// camera for pictures of `size`, or of the size that the scene asks for. The build is done again
/// when the scene, or a file in it, changes.
///
/// # Panics
/// The scene can't be read or baked, or the blob not written: the build fails and says why.
pub fn blob<A: Construct>(scene: impl AsRef<Path>, size: Option<Size>) -> PathBuf {
    bake::<A>(scene.as_ref(), size, "bin", |baked, size| Ok(baked.blob(size)?.bytes))
}

/// The same as Rust source, of the ending `.rs`.
///
/// # Panics
/// As [`blob`].
pub fn source<A: Construct>(scene: impl AsRef<Path>, size: Option<Size>) -> PathBuf {
    let scene = scene.as_ref();
    let name = scene.file_name().unwrap_or_default().to_string_lossy();
    bake::<A>(scene, size, "rs", |baked, size| Ok(baked.source(&name, size)?.into_bytes()))
}

fn bake<A: Construct>(
    scene: &Path,
    size: Option<Size>,
    ending: &str,
    make: impl FnOnce(&Baked<A>, Size) -> Result<Vec<u8>, crate::error::Flaw>,
) -> PathBuf {
    let document = read::read(scene).unwrap_or_else(|error| panic!("{error}"));
    watch(scene, &document);
    let size = size.or(document.size).unwrap_or(SIZE);
    let bytes = Baked::<A>::with(&document, Thrift::Flash)
        .and_then(|baked| make(&baked, size))
        .unwrap_or_else(|flaw| panic!("{}", flaw.of(scene)));
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR for build scripts"));
    let out = out.join(scene.file_stem().unwrap_or_default()).with_extension(ending);
    fs::write(&out, bytes).unwrap_or_else(|error| panic!("{}: {error}", out.display()));
    out
}

fn watch(scene: &Path, document: &Document) {
    let included = document.included.iter().map(|part| part.file.as_path());
    for file in included.chain([scene]) {
        println!("cargo::rerun-if-changed={}", file.display());
    }
}

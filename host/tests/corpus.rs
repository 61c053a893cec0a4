//! What fuzzing has found, and what it started from, once more: a scene or an error, never a panic.

#[expect(unreachable_pub, reason = "there, a library of its own")]
#[path = "../../fuzz/lib.rs"]
mod fuzz;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use whitted::math::Fixed;
use whitted_host::bake::{Baked, Construct, Thrift};
use whitted_host::document::Size;
use whitted_host::read::{self, Format};

/// The fewest inputs that a target's corpus holds: a directory that went missing is noticed.
const FEWEST: usize = 20;

fn fuzz() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz")
}

/// Has a target look at each input in its corpus.
fn replay(target: &str, survives: impl Fn(&[u8])) {
    let corpus = fuzz().join("corpus").join(target);
    let mut inputs = 0;
    for entry in corpus.read_dir().unwrap_or_else(|e| panic!("{}: {e}", corpus.display())) {
        let path = entry.unwrap().path();
        // What a panic is about stands before it.
        println!("{}", path.display());
        survives(&std::fs::read(path).unwrap());
        inputs += 1;
    }
    assert!(inputs >= FEWEST, "{target}: {inputs} inputs");
}

#[test]
fn blob() {
    replay("blob", |bytes| {
        fuzz::survives_blob(bytes);
    });
}

/// The blobs that fuzzing starts from are scenes. When the layout has changed they are refused, and
/// so is all that grows from them: `WHITTED_RENEW=1` bakes them anew from the scenes in
/// `fuzz/seeds`.
#[test]
fn seeds() {
    let mut scenes = 0;
    for entry in fuzz().join("seeds").read_dir().unwrap() {
        let scene = entry.unwrap().path();
        if scene.extension() == Some(OsStr::new("toml")) {
            sprouts::<Fixed>(&scene, "fixed");
            sprouts::<f32>(&scene, "f32");
            sprouts::<f64>(&scene, "f64");
            scenes += 1;
        }
    }
    assert!(scenes > 0);
}

fn sprouts<A: Construct>(scene: &Path, arithmetic: &str) {
    let name = scene.file_stem().unwrap().to_str().unwrap();
    let seed = fuzz().join("corpus/blob").join(format!("{name}-{arithmetic}.bin"));
    if std::env::var_os("WHITTED_RENEW").is_some() {
        let size = Size { width: 4, height: 4 };
        let baked = Baked::<A>::with(&read::read(scene).unwrap(), Thrift::Flash).unwrap();
        std::fs::write(&seed, baked.blob(size).unwrap().bytes).unwrap();
    }
    let bytes = std::fs::read(&seed).unwrap_or_else(|e| panic!("{}: {e}", seed.display()));
    let shows = fuzz::survives_blob(&bytes);
    assert!(shows, "{} isn't a scene: run this with WHITTED_RENEW=1", seed.display());
}

#[test]
fn gltf() {
    replay("gltf", |bytes| fuzz::survives(Format::Gltf, bytes));
}

#[test]
fn nff() {
    replay("nff", |bytes| fuzz::survives(Format::Nff, bytes));
}

#[test]
fn obj() {
    replay("obj", |bytes| fuzz::survives(Format::Obj, bytes));
}

#[test]
fn toml() {
    replay("toml", |bytes| fuzz::survives(Format::Toml, bytes));
}

//! What fuzzing has found, and what it started from, once more: a scene or an error, never a panic.

#[expect(unreachable_pub, reason = "there, a library of its own")]
#[path = "../../fuzz/lib.rs"]
mod fuzz;

use std::path::Path;

use whitted_host::read::Format;

/// The fewest inputs that a target's corpus holds: a directory that went missing is noticed.
const FEWEST: usize = 20;

/// Has a target look at each input in its corpus.
fn replay(target: &str, survives: impl Fn(&[u8])) {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus").join(target);
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
    replay("blob", fuzz::survives_blob);
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

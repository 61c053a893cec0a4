//! The host's side of `whitted`: scene files, rendering, pictures.
//!
//! A file is [`read`](read::read) into a [`Document`](document::Document), which says what the
//! file says and nothing else.

pub mod bake;
pub mod build;
pub mod document;
pub mod error;
pub mod flash;
pub mod gltf;
pub mod indirect;
mod mesh;
pub mod need;
pub mod nff;
pub mod number;
pub mod obj;
pub mod picture;
pub mod polygon;
pub mod pov;
pub mod read;
pub mod render;
pub mod sampling;
pub mod show;
pub mod stats;
pub mod terms;
pub mod toml;
pub mod tree;
mod words;

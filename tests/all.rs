//! All tests of scenes and pictures in one program: what they share, above all the renderer for every
//! arithmetic, is compiled once. Those of one file: `cargo test --test all sampling::`.

mod arithmetics;
mod common;

mod area_lights;
mod blob;
mod errors;
mod golden;
mod horizon;
mod instances;
mod interreflection;
mod light_order;
mod light_selection;
mod limits;
mod patterns;
mod pictures;
mod precision;
mod refraction;
mod rules;
mod sampling;
mod shading;
mod solids;
mod streaming;
mod surface;
mod tailored;
mod terms;
mod tree;

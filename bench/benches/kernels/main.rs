//! The kernels on the host, in all three arithmetics: shape tests, roots and the like, the walk, a
//! frame of each scene.
//!
//! What counts are the instructions of small cores (`cargo xtask bench`); these times tell within
//! seconds whether a change is worth counting. `cargo bench -- 'walk/fixed'` runs a part.

#![allow(clippy::duplicate_mod, reason = "each arithmetic needs the scenes anew")]

#[path = "../../../tests/common/mod.rs"]
mod common;
mod double;
mod fixed;
mod frames;
mod roots;
mod shapes;
mod single;
mod walk;

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use whitted::math::Fixed;

fn all(criterion: &mut Criterion) {
    shapes::bench::<Fixed>(criterion);
    shapes::bench::<f32>(criterion);
    shapes::bench::<f64>(criterion);
    roots::bench::<Fixed>(criterion);
    roots::bench::<f32>(criterion);
    roots::bench::<f64>(criterion);
    walk::bench::<Fixed>(criterion);
    walk::bench::<f32>(criterion);
    walk::bench::<f64>(criterion);
    frames::bench(criterion);
}

criterion_group! {
    name = kernels;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1));
    targets = all
}
criterion_main!(kernels);

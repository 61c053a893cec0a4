//! The scenes, once for each arithmetic.
//!
//! A scene's file is written over a type `A` that the module above it names, because a `static`
//! can't be generic.

#![allow(clippy::duplicate_mod, reason = "each arithmetic needs the scenes anew")]

mod fixed;
#[path = "f32.rs"]
mod float;

use whitted::frame::Output;
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Camera, Scene};

use crate::job::SceneName;

/// A scene, and how it is to be seen.
pub struct Shot<A: Arithmetic> {
    /// The scene.
    pub scene: &'static Scene<'static, A>,
    /// Where from.
    pub camera: &'static Camera<A>,
    /// How deep the tree of rays may be.
    pub depth: u8,
    /// How radiance becomes pixels.
    pub output: Output,
}

/// An arithmetic that the scenes are there in.
pub trait Shots: Arithmetic {
    /// The scene of a name.
    fn shot(name: SceneName) -> Shot<Self>;
}

impl Shots for Fixed {
    fn shot(name: SceneName) -> Shot<Self> {
        fixed::shot(name)
    }
}

impl Shots for f32 {
    fn shot(name: SceneName) -> Shot<Self> {
        float::shot(name)
    }
}

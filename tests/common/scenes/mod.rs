//! Scenes as `static`s, once for each arithmetic: a file is written over a type `A` that the
//! module above it names, because a `static` can't be generic.
#![allow(clippy::duplicate_mod, reason = "each arithmetic needs the scenes anew")]

pub mod double;
pub mod fixed;
pub mod single;

#[allow(unused_imports)]
pub use fixed::small::{CAMERA, SCENE};

use whitted::frame::Tone;
use whitted::math::Arithmetic;
use whitted::scene::{Camera, Scene};

/// A scene, and how it is to be seen.
pub struct Shot<A: Arithmetic> {
    pub name: &'static str,
    pub scene: &'static Scene<'static, A>,
    pub camera: &'static Camera<A>,
    pub depth: u8,
    pub tone: Tone,
}

/// What is to be done with scenes whose types say what they use.
pub trait Tailored<A: Arithmetic> {
    fn scene<const USES: u64>(
        &mut self,
        name: &str,
        scene: &'static Scene<'static, A, USES>,
        camera: &'static Camera<A>,
    );
}

/// An arithmetic that the scenes are there in.
pub trait Shots: Arithmetic {
    const SHOTS: &'static [Shot<Self>; 6];
}

impl Shots for whitted::math::Fixed {
    const SHOTS: &'static [Shot<Self>; 6] = &fixed::SHOTS;
}

impl Shots for f32 {
    const SHOTS: &'static [Shot<Self>; 6] = &single::SHOTS;
}

impl Shots for f64 {
    const SHOTS: &'static [Shot<Self>; 6] = &double::SHOTS;
}

//! Moves an object from frame to frame, as firmware does: `cargo run --example moving`.
//!
//! The scene lies in a `static`, checked by the compiler. What moves is an instance of a group, in
//! memory of the caller's: each frame has a new one, and nothing else is made anew.

use std::error::Error;

use whitted::frame::{Gray8, Output, Renderer, Settings};
use whitted::scene::{Ambient, Background, Camera, Group, Instance, Light, Material};
use whitted::scene::{MaterialSpec, Parts, Scene, Shapes, Transform};
use whitted::shape::{Cuboid, Cylinder, Plane, Sphere};
use whitted::trace::Work;

/// The arithmetic: fixed point, for cores without a floating-point unit.
type A = whitted::math::Fixed;

/// A windmill's sails around the z axis, in a space of their own.
static SAILS: Group<A> = Group::<A>::new(Shapes {
    spheres: &[Sphere::<A>::new([0.0; 3], 0.3, 1)],
    cuboids: &[
        Cuboid::<A>::new([0.2, -0.05, -0.05], [2.0, 0.45, 0.05], 1),
        Cuboid::<A>::new([-2.0, -0.45, -0.05], [-0.2, 0.05, 0.05], 1),
        Cuboid::<A>::new([-0.45, 0.2, -0.05], [0.05, 2.0, 0.05], 1),
        Cuboid::<A>::new([-0.05, -2.0, -0.05], [0.45, -0.2, 0.05], 1),
    ],
    ..Shapes::EMPTY
});

/// Where the sails are after they have turned by an angle.
const fn turned(degrees: f64) -> Transform {
    Transform::IDENTITY.rotated([0.0, 0.0, 1.0], degrees).moved([0.0, 3.0, -1.1])
}

const PARTS: Parts<A> = Parts {
    cylinders: &[Cylinder::<A>::new([0.0; 3], [0.0, 3.6, 0.0], 0.8, 0).with_caps()],
    instances: &[Instance::<A>::new(&SAILS, turned(0.0))],
    planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 0)],
    materials: &[
        Material::<A>::new(MaterialSpec {
            ambient: [0.4; 3],
            diffuse: [0.4; 3],
            ..MaterialSpec::BLACK
        }),
        Material::<A>::new(MaterialSpec {
            ambient: [0.9; 3],
            diffuse: [0.9; 3],
            ..MaterialSpec::BLACK
        }),
    ],
    lights: &[Light::<A>::point([-4.0, 7.0, -7.0], [50.0; 3])],
    ambient: Ambient::<A>::new([0.25; 3]),
    background: Background::<A>::uniform([0.02; 3]),
    ..Parts::EMPTY
};

/// Code for what the scene doesn't use isn't there.
static SCENE: Scene<A, { PARTS.uses() }> = Scene::tailored(PARTS);

static CAMERA: Camera<A> =
    Camera::<A>::look_at([2.2, 3.2, -8.5], [0.0, 2.4, 0.0], [0.0, 1.0, 0.0], 38.0);

/// From black to white.
const INK: [char; 10] = [' ', '.', ':', '-', '=', '+', '*', '#', '%', '@'];

fn main() -> Result<(), Box<dyn Error>> {
    let mut work = Work::<A, 3>::new();
    let mut line = [Gray8::default(); 64];
    let settings = Settings { depth: 3, ..Settings::new(64, 60) };
    for frame in 0..6 {
        let sails = [Instance::<A>::try_new(&SAILS, &turned(f64::from(frame) * 15.0))?];
        let scene = SCENE.with_instances(&sails)?;
        let mut renderer = Renderer::new(&scene, &CAMERA, settings, &mut work, &mut [])?;
        // Characters are twice as high as wide: every other line will do.
        for y in (0..settings.height).step_by(2) {
            renderer.line(y, &Output::SRGB, &mut line);
            let text: String = line
                .iter()
                .map(|&Gray8(level)| INK[usize::from(level) * INK.len() / 256])
                .collect();
            println!("{text}");
        }
        println!();
    }
    Ok(())
}

//! The spheres of FTB's "business card" ray tracer, as hirakuni45 has it for RX processors. z is
//! up.
//!
//! Where the original's formulas are none of our model's, the nearest of ours: it squares the
//! cosine of the diffuse term; its highlight takes the half vector, of which the 32nd power is
//! about Phong's 8th; its sky follows a fourth power, here a line through the sky's colours at the
//! horizon and above; and its shadow is jittered.

use super::A;
use whitted::scene::{Ambient, Background, Camera, Falloff, Light, LightSpec, Material};
use whitted::scene::{MaterialSpec, Parts, PatternSpec, Rules, Scene};
use whitted::shape::{Plane, Sphere};

pub(super) static SCENE: Scene<A, { PARTS.uses() }> = Scene::tailored(PARTS);

pub(super) const PARTS: Parts<A> = Parts {
    spheres: &[
        Sphere::<A>::new([5.0, 15.0, 8.0], 5.0, 0),
        Sphere::<A>::new([-6.0, 12.0, 4.0], 3.0, 0),
        Sphere::<A>::new([1.0, 10.0, 2.0], 2.0, 1),
        Sphere::<A>::new([0.0, 9.0, 5.0], 1.0, 2),
    ],
    planes: &[Plane::<A>::new([0.0, 0.0, 1.0], 0.0, 3)],
    materials: &[
        ball([0.8, 0.8, 0.8], 0.5),
        ball([0.0, 0.8, 0.0], 0.2),
        ball([0.0, 0.8, 0.8], 0.3),
        Material::<A>::new(MaterialSpec {
            pattern: Some(PatternSpec { cell: [5.0, 5.0, 0.0], offset: [0.0; 3], other: 4 }),
            ..cell([1.0; 3])
        }),
        Material::<A>::new(cell([1.0, 1.0 / 3.0, 1.0 / 3.0])),
    ],
    lights: &[Light::<A>::new(LightSpec::Point {
        position: [9.0, 6.0, 16.0],
        intensity: [1.0; 3],
        falloff: Falloff::None,
    })],
    ambient: Ambient::<A>::new([1.0; 3]),
    background: Background::<A>::gradient([0.0, 0.0, 1.0], [1.5, 0.4, 1.3], [0.1, 0.0, 0.3]),
    rules: Rules::NFF,
    ..Parts::EMPTY
};

/// A pixel is 0.45/(height/2) wide at distance 1.
pub(super) static CAMERA: Camera<A> =
    match Camera::<A>::try_look_at([0.0, 0.0, 3.0], [1.0, 8.0, 4.0], [0.0, 0.0, 1.0], 0.45) {
        Ok(camera) => camera,
        Err(_) => panic!("a view with an up"),
    };

const fn ball(color: [f64; 3], mirror: f64) -> Material<A> {
    let [r, g, b] = color;
    Material::<A>::new(MaterialSpec {
        ambient: [0.05 * r, 0.05 * g, 0.05 * b],
        diffuse: color,
        specular: [1.0; 3],
        shininess: 8.0,
        reflection: [mirror; 3],
        ..MaterialSpec::BLACK
    })
}

/// Three times 0.2 d + 0.1.
const fn cell(color: [f64; 3]) -> MaterialSpec {
    let [r, g, b] = color;
    MaterialSpec {
        ambient: [0.3 * r, 0.3 * g, 0.3 * b],
        diffuse: [0.6 * r, 0.6 * g, 0.6 * b],
        ..MaterialSpec::BLACK
    }
}

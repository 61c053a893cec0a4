//! A scene like that of gfxcat's ray tracer by Sylvain Lefebvre: three spheres that stand on a
//! chequered plane, all of them mirrors, one bounce, one light with a shadow ray from every hit.
//!
//! Where the original's formulas are none of our model's, the nearest of ours: its plane is
//! coloured by an exclusive or of coordinates, here by a checker of the size of that pattern's
//! coarsest squares in the means of its darker and its brighter half; light doesn't weaken along the ray.

use super::A;
use whitted::scene::Scene;
use whitted::scene::{Camera, Light, LightSpec, Material, MaterialSpec, Parts, PatternSpec, Rules};
use whitted::shape::{Plane, Sphere};

pub(super) static SCENE: Scene<A, { PARTS.uses() }> = Scene::tailored(PARTS);

pub(super) const PARTS: Parts<A> = Parts {
    // On a circle of radius 15 about the y axis, a third of a turn apart.
    spheres: &[
        Sphere::<A>::new([-14.354, -8.0, -4.354], 6.0, 0),
        Sphere::<A>::new([10.951, -6.0, -10.25], 8.0, 1),
        Sphere::<A>::new([3.421, -4.0, 14.604], 10.0, 2),
    ],
    planes: &[Plane::<A>::new([0.0, 1.0, 0.0], -14.0, 3)],
    materials: &[
        mirror([1.0, DIM, DIM]),
        mirror([DIM, 1.0, DIM]),
        mirror([DIM, DIM, 1.0]),
        Material::<A>::new(MaterialSpec {
            pattern: Some(PatternSpec { cell: [16.0, 0.0, 16.0], offset: [0.0; 3], other: 4 }),
            ..spec([0.25; 3])
        }),
        mirror([0.75; 3]),
    ],
    lights: &[Light::<A>::new(LightSpec::Directional {
        direction: [16.0, -64.0, -32.0],
        intensity: [1.0; 3],
    })],
    rules: Rules::NFF,
    ..Parts::EMPTY
};

/// A screen 64 away and 60 high, tilted down by 4.2° and looked at from above its middle; all in 64ths.
pub(super) static CAMERA: Camera<A> = Camera::<A>::from_vectors(
    [0.0, 8.0, -64.0],
    [0.0, -0.1982, 0.9881],
    [0.46875, 0.0, 0.0],
    [0.0, -0.4675, -0.0345],
);

const DIM: f64 = 31.0 / 255.0;

const fn mirror(color: [f64; 3]) -> Material<A> {
    Material::<A>::new(spec(color))
}

const fn spec(diffuse: [f64; 3]) -> MaterialSpec {
    MaterialSpec {
        diffuse,
        specular: [1.0; 3],
        shininess: 4.0,
        reflection: [1.0; 3],
        ..MaterialSpec::BLACK
    }
}

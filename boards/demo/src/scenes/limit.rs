//! The scene that budgets are counted on: three spheres over a checker, one of them of glass,
//! one light, four generations of rays. x right, y up, z forward.
//!
//! The camera is off the axis on purpose: looking straight ahead, whole rows of pixels fall on
//! lines of the checker, which no two arithmetics decide alike.

use super::{A, LIMIT_CUTOFF};
use whitted::scene::{Ambient, Background, Camera, Light, Material, MaterialSpec, Parts, Rules};
use whitted::scene::{PatternSpec, Scene};
use whitted::shape::{Plane, Sphere};

pub(super) static SCENE: Scene<A, { PARTS.uses() }> = Scene::tailored(PARTS);

pub(super) const PARTS: Parts<A> = Parts {
    spheres: &[
        Sphere::<A>::new([0.0, 0.0, 4.0], 1.0, 0),
        Sphere::<A>::new([-2.25, 0.0, 5.0], 1.0, 1),
        Sphere::<A>::new([1.5, -0.4, 2.75], 0.6, 2),
    ],
    planes: &[Plane::<A>::new([0.0, 1.0, 0.0], -1.0, 3)],
    materials: &[
        Material::<A>::new(material([230.0, 40.0, 40.0], 150.0, 90.0, 80.0)),
        Material::<A>::new(material([40.0, 230.0, 60.0], 190.0, 90.0, 40.0)),
        Material::<A>::new(MaterialSpec {
            transmission: [200.0 / 256.0; 3],
            index_behind: 1.5,
            ..material([255.0; 3], 20.0, 120.0, 30.0)
        }),
        Material::<A>::new(MaterialSpec {
            pattern: Some(PatternSpec { cell: [1.0, 0.0, 1.0], offset: [0.0; 3], other: 4 }),
            ..material([230.0; 3], 200.0, 0.0, 40.0)
        }),
        Material::<A>::new(material([30.0, 30.0, 40.0], 200.0, 0.0, 40.0)),
    ],
    lights: &[Light::<A>::point([-4.0, 5.0, -3.0], [40.0; 3])],
    ambient: Ambient::<A>::new([0.1; 3]),
    background: Background::<A>::gradient(
        [0.0, 1.0, 0.0],
        [0.0, 10.0 / 255.0, 127.0 / 255.0],
        [128.0 / 255.0, 138.0 / 255.0, 127.0 / 255.0],
    ),
    rules: Rules { cutoff: LIMIT_CUTOFF, ..Rules::WHITTED },
    ..Parts::EMPTY
};

pub(super) static CAMERA: Camera<A> = Camera::<A>::from_vectors(
    [0.0137, 0.5, -1.0],
    [1.5 * 0.0623, -0.2113, 1.5],
    [1.0, 0.0, -0.0623],
    [0.0, -1.0, 0.0],
);

/// Colours in 1/255, coefficients in 1/256, as the scene is published.
const fn material(rgb: [f64; 3], diffuse: f64, specular: f64, mirror: f64) -> MaterialSpec {
    let [r, g, b] = rgb;
    let k = diffuse / 256.0 / 255.0;
    let diffuse = [r * k, g * k, b * k];
    MaterialSpec {
        ambient: diffuse,
        diffuse,
        specular: [specular / 256.0; 3],
        shininess: 32.0,
        reflection: [mirror / 256.0; 3],
        ..MaterialSpec::BLACK
    }
}

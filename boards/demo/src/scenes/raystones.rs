//! The scene of raystones.c, a ray tracer for small processors after Sokolov's tinyraytracer:
//! four spheres, three lights without falloff, reflection and refraction.
//!
//! The original sends both child rays from every hit, even where a coefficient is 0; here no ray
//! is sent for nothing.

use super::A;
use whitted::scene::{Background, Camera, Falloff, Light, LightSpec, Material, MaterialSpec};
use whitted::scene::{Parts, PatternSpec, Rules, Scene};
use whitted::shape::{Polygon, Sphere};

pub(super) static SCENE: Scene<A, { PARTS.uses() }> = Scene::tailored(PARTS);

pub(super) const PARTS: Parts<A> = Parts {
    spheres: &[
        Sphere::<A>::new([-3.0, 0.0, -16.0], 2.0, 0),
        Sphere::<A>::new([-1.0, -1.5, -12.0], 2.0, 1),
        Sphere::<A>::new([1.5, -0.5, -18.0], 3.0, 2),
        Sphere::<A>::new([7.0, 5.0, -18.0], 4.0, 3),
    ],
    polygons: &[Polygon::<A>::new(&FLOOR, 0, 4)],
    edges: &Polygon::<A>::edges(&FLOOR),
    materials: &[
        // Ivory, glass, red rubber, mirror.
        material([0.6, 0.3, 0.1, 0.0], [0.4, 0.4, 0.3], 50.0, 1.0),
        material([0.0, 0.5, 0.1, 0.8], [0.6, 0.7, 0.8], 125.0, 1.5),
        material([0.9, 0.1, 0.0, 0.0], [0.3, 0.1, 0.1], 10.0, 1.0),
        material([0.0, 10.0, 0.8, 0.0], [1.0; 3], 142.0, 1.0),
        Material::<A>::new(MaterialSpec {
            diffuse: [0.3; 3],
            pattern: Some(PatternSpec { cell: [2.0, 0.0, 2.0], offset: [0.0; 3], other: 5 }),
            ..MaterialSpec::BLACK
        }),
        Material::<A>::new(MaterialSpec { diffuse: [0.3, 0.2, 0.1], ..MaterialSpec::BLACK }),
    ],
    lights: &[
        light([-20.0, 20.0, 20.0], 1.5),
        light([30.0, 50.0, -25.0], 1.8),
        light([30.0, 20.0, 30.0], 1.7),
    ],
    background: Background::<A>::gradient([0.0, 1.0, 0.0], [0.0; 3], [0.2, 0.7, 1.3]),
    rules: Rules::NFF,
    ..Parts::EMPTY
};

pub(super) static CAMERA: Camera<A> =
    Camera::<A>::look_at([0.0; 3], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], 60.0);

const FLOOR: [[f64; 3]; 4] =
    [[-10.0, -4.0, -10.0], [10.0, -4.0, -10.0], [10.0, -4.0, -30.0], [-10.0, -4.0, -30.0]];

/// `albedo` is diffuse, highlight, mirror, transmission; the last three are white.
const fn material(
    albedo: [f64; 4],
    color: [f64; 3],
    shininess: f64,
    index_behind: f64,
) -> Material<A> {
    let [diffuse, specular, mirror, transmission] = albedo;
    Material::<A>::new(MaterialSpec {
        diffuse: [diffuse * color[0], diffuse * color[1], diffuse * color[2]],
        specular: [specular; 3],
        shininess,
        reflection: [mirror; 3],
        transmission: [transmission; 3],
        index_behind,
        ..MaterialSpec::BLACK
    })
}

const fn light(position: [f64; 3], intensity: f64) -> Light<A> {
    Light::<A>::new(LightSpec::Point {
        position,
        intensity: [intensity; 3],
        falloff: Falloff::None,
    })
}

//! A small scene of spheres and a plane, one of each sort of material, as a `static`.

use super::A;
use whitted::scene::{
    Ambient, Background, Camera, Light, Material, MaterialSpec, Parts, PatternSpec, Scene,
};
use whitted::shape::{Plane, Sphere};

const fn matt(r: f64, g: f64, b: f64) -> MaterialSpec {
    MaterialSpec { ambient: [r, g, b], diffuse: [r, g, b], ..MaterialSpec::BLACK }
}

pub static SCENE: Scene<A> = Scene::checked(Parts {
    spheres: &[
        Sphere::<A>::new([0.0, 1.0, 4.0], 1.0, 0),
        Sphere::<A>::new([-1.8, 0.7, 3.2], 0.7, 1),
        Sphere::<A>::new([1.6, 0.6, 2.8], 0.6, 2),
    ],
    planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, 3)],
    materials: &[
        Material::<A>::new(MaterialSpec {
            reflection: [0.5; 3],
            specular: [0.4; 3],
            shininess: 40.0,
            ..matt(0.5, 0.1, 0.1)
        }),
        Material::<A>::new(matt(0.1, 0.5, 0.2)),
        Material::<A>::new(MaterialSpec {
            transmission: [0.85, 0.9, 0.95],
            reflection: [0.1; 3],
            index_behind: 1.5,
            ..MaterialSpec::BLACK
        }),
        Material::<A>::new(MaterialSpec {
            pattern: Some(PatternSpec { cell: [0.7, 0.0, 0.7], offset: [0.1, 0.0, 0.2], other: 4 }),
            ..matt(0.8, 0.8, 0.7)
        }),
        Material::<A>::new(matt(0.1, 0.1, 0.15)),
    ],
    lights: &[Light::<A>::point([-3.0, 5.0, -1.0], [30.0, 28.0, 25.0])],
    ambient: Ambient::<A>::new([0.15; 3]),
    background: Background::<A>::gradient([0.0, 1.0, 0.0], [0.3; 3], [0.1, 0.3, 0.9]),
    ..Parts::EMPTY
});

pub static CAMERA: Camera<A> =
    Camera::<A>::look_at([0.3, 1.4, -2.0], [0.0, 0.9, 3.0], [0.0, 1.0, 0.0], 50.0);

//! A small scene with a bit of everything that the first shapes can do, as a `static`.

use whitted::math::Fixed;
use whitted::scene::{
    Ambient, Background, Camera, Light, Material, MaterialSpec, Parts, PatternSpec, Scene,
};
use whitted::shape::{Plane, Sphere};

const fn matt(r: f64, g: f64, b: f64) -> MaterialSpec {
    MaterialSpec { ambient: [r, g, b], diffuse: [r, g, b], ..MaterialSpec::BLACK }
}

pub static SCENE: Scene<Fixed> = Scene::checked(Parts {
    spheres: &[
        Sphere::<Fixed>::new([0.0, 1.0, 4.0], 1.0, 0),
        Sphere::<Fixed>::new([-1.8, 0.7, 3.2], 0.7, 1),
        Sphere::<Fixed>::new([1.6, 0.6, 2.8], 0.6, 2),
    ],
    planes: &[Plane::<Fixed>::new([0.0, 1.0, 0.0], 0.0, 3)],
    materials: &[
        Material::<Fixed>::new(MaterialSpec {
            reflection: [0.5; 3],
            specular: [0.4; 3],
            shininess: 40.0,
            ..matt(0.5, 0.1, 0.1)
        }),
        Material::<Fixed>::new(matt(0.1, 0.5, 0.2)),
        Material::<Fixed>::new(MaterialSpec {
            transmission: [0.85, 0.9, 0.95],
            reflection: [0.1; 3],
            index_behind: 1.5,
            ..MaterialSpec::BLACK
        }),
        Material::<Fixed>::new(MaterialSpec {
            pattern: Some(PatternSpec { cell: [0.7, 0.0, 0.7], offset: [0.1, 0.0, 0.2], other: 4 }),
            ..matt(0.8, 0.8, 0.7)
        }),
        Material::<Fixed>::new(matt(0.1, 0.1, 0.15)),
    ],
    lights: &[Light::<Fixed>::point([-3.0, 5.0, -1.0], [30.0, 28.0, 25.0])],
    ambient: Ambient::<Fixed>::new([0.15; 3]),
    background: Background::<Fixed>::gradient([0.0, 1.0, 0.0], [0.3; 3], [0.1, 0.3, 0.9]),
    ..Parts::EMPTY
});

pub static CAMERA: Camera<Fixed> =
    Camera::<Fixed>::look_at([0.3, 1.4, -2.0], [0.0, 0.9, 3.0], [0.0, 1.0, 0.0], 50.0);

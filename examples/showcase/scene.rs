//! Glass and a mirror over a checker floor: a scene as a static, in flash, checked when it is
//! compiled.
//!
//! The arithmetic is whatever the module above calls `A`, so that one file serves fixed point on
//! a small core and single precision on a larger one.

use super::A;
use whitted::scene::{Ambient, Background, Camera, Light, Material, MaterialSpec, Parts, Rules};
use whitted::scene::{PatternSpec, Scene};
use whitted::shape::{Plane, Sphere};

/// x to the right, y up, z towards the viewer.
pub(crate) static SCENE: Scene<A> = Scene::checked(Parts {
    spheres: &[
        Sphere::<A>::new([-1.25, 1.2, -5.2], 1.2, MIRROR),
        Sphere::<A>::new([0.95, 0.8, -3.6], 0.8, GLASS),
        Sphere::<A>::new([2.6, 0.7, -5.8], 0.7, RED),
        Sphere::<A>::new([-0.45, 0.35, -3.0], 0.35, BLUE),
        Sphere::<A>::new([-2.35, 0.45, -3.9], 0.45, YELLOW),
    ],
    planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, LIGHT_CELL)],
    materials: &MATERIALS,
    lights: &[
        Light::<A>::point([-4.0, 6.0, 0.0], [38.0, 36.0, 32.0]),
        Light::<A>::point([5.0, 3.5, -1.0], [7.0, 8.0, 10.0]),
    ],
    ambient: Ambient::<A>::new([0.10, 0.11, 0.13]),
    background: Background::<A>::gradient([0.0, 1.0, 0.0], [0.75, 0.80, 0.85], [0.05, 0.16, 0.45]),
    rules: Rules::WHITTED,
    ..Parts::EMPTY
});

/// From a little above, with the horizon in the upper third.
pub(crate) static CAMERA: Camera<A> =
    Camera::<A>::look_at([0.15, 1.9, 1.6], [0.15, 0.8, -4.0], [0.0, 1.0, 0.0], 42.0);

const MIRROR: u16 = 0;
const GLASS: u16 = 1;
const RED: u16 = 2;
const BLUE: u16 = 3;
const YELLOW: u16 = 4;
const LIGHT_CELL: u16 = 5;
const DARK_CELL: u16 = 6;

static MATERIALS: [Material<A>; 7] = [
    Material::<A>::new(MaterialSpec {
        diffuse: [0.05; 3],
        specular: [0.6; 3],
        shininess: 120.0,
        reflection: [0.82, 0.84, 0.86],
        ..MaterialSpec::BLACK
    }),
    Material::<A>::new(MaterialSpec {
        specular: [0.7; 3],
        shininess: 160.0,
        reflection: [0.08; 3],
        transmission: [0.86, 0.90, 0.88],
        index_behind: 1.5,
        ..MaterialSpec::BLACK
    }),
    glossy([0.75, 0.07, 0.05]),
    glossy([0.06, 0.17, 0.62]),
    glossy([0.85, 0.55, 0.06]),
    Material::<A>::new(MaterialSpec {
        pattern: Some(PatternSpec { cell: [1.0, 0.0, 1.0], offset: [0.0; 3], other: DARK_CELL }),
        ..tile([0.72, 0.70, 0.66])
    }),
    Material::<A>::new(tile([0.09, 0.10, 0.13])),
];

/// Paint with a coat of lacquer.
const fn glossy(color: [f64; 3]) -> Material<A> {
    Material::<A>::new(MaterialSpec {
        ambient: color,
        diffuse: color,
        specular: [0.35; 3],
        shininess: 40.0,
        reflection: [0.08; 3],
        ..MaterialSpec::BLACK
    })
}

/// A polished tile.
const fn tile(color: [f64; 3]) -> MaterialSpec {
    MaterialSpec { ambient: color, diffuse: color, reflection: [0.12; 3], ..MaterialSpec::BLACK }
}

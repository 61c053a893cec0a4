//! Glass and mirror over a checker floor: the showcase of the command `whitted`, as a static in
//! flash, checked when it is compiled.
//!
//! The arithmetic is whatever the module above calls `A`, so that one file serves fixed point on
//! a small core and single precision on a larger one.

use super::A;
use whitted::scene::{Ambient, Background, Camera, Falloff, Light, LightSpec, Material};
use whitted::scene::{MaterialSpec, Parts, PatternSpec, Rules, Scene, Shadow};
use whitted::shape::{Plane, Sphere};

/// y is up. The scene's type names what it uses; code for anything else isn't compiled.
pub(crate) static SCENE: Scene<A, { PARTS.uses() }> = Scene::tailored(PARTS);

pub(crate) const PARTS: Parts<A> = Parts {
    spheres: &[
        Sphere::<A>::new([-0.95, 1.15, 1.35], 1.15, MIRROR),
        Sphere::<A>::new([0.95, 0.72, -0.75], 0.72, GLASS),
        Sphere::<A>::new([1.75, 0.62, 1.75], 0.62, VERMILION),
        Sphere::<A>::new([-0.62, 0.40, -1.45], 0.40, SAFFRON),
        Sphere::<A>::new([-2.15, 0.46, -0.55], 0.46, JADE),
        Sphere::<A>::new([0.10, 0.24, -2.35], 0.24, COBALT),
        Sphere::<A>::new([2.42, 0.30, -0.35], 0.30, COBALT),
        Sphere::<A>::new([0.42, 0.33, 3.45], 0.33, SAFFRON),
    ],
    planes: &[Plane::<A>::new([0.0, 1.0, 0.0], 0.0, LIGHT_TILE)],
    materials: &MATERIALS,
    lights: &[
        light([-5.5, 7.5, -5.0], [1.0, 0.93, 0.82], 72.0),
        light([6.5, 4.5, -4.0], [0.70, 0.82, 1.0], 16.0),
    ],
    ambient: Ambient::<A>::new([0.12; 3]),
    background: Background::<A>::gradient([0.0, 1.0, 0.0], [0.93, 0.83, 0.70], [0.10, 0.27, 0.62]),
    rules: Rules { specular_cosine: false, ..Rules::COURSE },
    ..Parts::EMPTY
};

/// It looks along no line of the checker: rows of pixels on a line would be decided by luck.
pub(crate) static CAMERA: Camera<A> =
    Camera::<A>::look_at([1.7, 2.1, -7.3], [0.12, 0.72, 0.4], [0.0, 1.0, 0.0], 33.0);

const LIGHT_TILE: u16 = 0;
const DARK_TILE: u16 = 1;
const MIRROR: u16 = 2;
const GLASS: u16 = 3;
const VERMILION: u16 = 4;
const JADE: u16 = 5;
const SAFFRON: u16 = 6;
const COBALT: u16 = 7;

const MATERIALS: [Material<A>; 8] = [
    Material::<A>::new(MaterialSpec {
        pattern: Some(PatternSpec { cell: [1.0, 0.0, 1.0], offset: [0.0; 3], other: DARK_TILE }),
        ..painted([0.78, 0.76, 0.70], [0.10; 3])
    }),
    Material::<A>::new(painted([0.10, 0.13, 0.17], [0.16; 3])),
    Material::<A>::new(MaterialSpec {
        specular: [0.9; 3],
        shininess: 220.0,
        ..painted([0.02; 3], [0.90, 0.92, 0.94])
    }),
    Material::<A>::new(MaterialSpec {
        specular: [0.9; 3],
        shininess: 260.0,
        reflection: [0.10; 3],
        transmission: [0.88, 0.93, 0.92],
        index_behind: 1.5,
        shadow: Shadow::Filtered,
        ..MaterialSpec::BLACK
    }),
    lacquered([0.78, 0.10, 0.05]),
    lacquered([0.06, 0.46, 0.24]),
    lacquered([0.86, 0.52, 0.05]),
    lacquered([0.05, 0.13, 0.55]),
];

const fn painted(color: [f64; 3], reflection: [f64; 3]) -> MaterialSpec {
    MaterialSpec { ambient: color, diffuse: color, reflection, ..MaterialSpec::BLACK }
}

const fn lacquered(color: [f64; 3]) -> Material<A> {
    Material::<A>::new(MaterialSpec {
        specular: [0.5; 3],
        shininess: 60.0,
        ..painted(color, [0.08; 3])
    })
}

const fn light(position: [f64; 3], color: [f64; 3], intensity: f64) -> Light<A> {
    let [r, g, b] = color;
    Light::<A>::new(LightSpec::Point {
        position,
        intensity: [r * intensity, g * intensity, b * intensity],
        falloff: Falloff::InverseSquare,
    })
}

//! Fixed point.

#[path = "every.rs"]
pub mod every;
#[path = "../../../boards/demo/src/scenes/ftb.rs"]
mod ftb;
#[path = "../../../boards/demo/src/scenes/limit.rs"]
mod limit;
#[path = "../../../boards/demo/src/scenes/raystones.rs"]
mod raystones;
#[path = "../../../examples/showcase/scene.rs"]
mod showcase;
#[path = "small.rs"]
pub mod small;

use super::Shot;
use whitted::frame::Tone;

pub type A = whitted::math::Fixed;

/// The limit scene's cut-off, 4.5/256.
const LIMIT_CUTOFF: <A as whitted::math::Arithmetic>::Weight = fixed::FixedI32::from_bits(288);

pub static SHOTS: [Shot<A>; 6] = [
    Shot {
        name: "small",
        scene: &small::SCENE,
        camera: &small::CAMERA,
        depth: 5,
        tone: Tone::SRGB,
    },
    Shot {
        name: "every",
        scene: &every::SCENE,
        camera: &every::CAMERA,
        depth: 5,
        tone: Tone::SRGB,
    },
    Shot {
        name: "showcase",
        scene: &showcase::SCENE,
        camera: &showcase::CAMERA,
        depth: 5,
        tone: Tone::SRGB,
    },
    Shot {
        name: "limit",
        scene: &limit::SCENE,
        camera: &limit::CAMERA,
        depth: 4,
        tone: Tone::LINEAR,
    },
    Shot {
        name: "raystones",
        scene: &raystones::SCENE,
        camera: &raystones::CAMERA,
        depth: 3,
        tone: Tone::LINEAR,
    },
    Shot { name: "ftb", scene: &ftb::SCENE, camera: &ftb::CAMERA, depth: 3, tone: Tone::LINEAR },
];

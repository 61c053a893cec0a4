//! Single precision.

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

use super::{Shot, Tailored};
use whitted::frame::Tone;
use whitted::scene::Scene;

pub type A = f32;

/// The limit scene's cut-off, 4.5/256.
const LIMIT_CUTOFF: <A as whitted::math::Arithmetic>::Weight = 4.5 / 256.0;

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
        scene: &Scene::checked(*showcase::SCENE.parts()),
        camera: &showcase::CAMERA,
        depth: 5,
        tone: Tone::SRGB,
    },
    Shot {
        name: "limit",
        scene: &Scene::checked(*limit::SCENE.parts()),
        camera: &limit::CAMERA,
        depth: 4,
        tone: Tone::LINEAR,
    },
    Shot {
        name: "raystones",
        scene: &Scene::checked(*raystones::SCENE.parts()),
        camera: &raystones::CAMERA,
        depth: 3,
        tone: Tone::LINEAR,
    },
    Shot {
        name: "ftb",
        scene: &Scene::checked(*ftb::SCENE.parts()),
        camera: &ftb::CAMERA,
        depth: 3,
        tone: Tone::LINEAR,
    },
];

/// Every scene, its type naming what it uses.
pub fn tailored(view: &mut impl Tailored<A>) {
    static SMALL: Scene<A, { small::SCENE.parts().uses() }> =
        Scene::tailored(*small::SCENE.parts());
    static EVERY: Scene<A, { every::SCENE.parts().uses() }> =
        Scene::tailored(*every::SCENE.parts());
    view.scene("small", &SMALL, &small::CAMERA);
    view.scene("every", &EVERY, &every::CAMERA);
    view.scene("showcase", &showcase::SCENE, &showcase::CAMERA);
    view.scene("limit", &limit::SCENE, &limit::CAMERA);
    view.scene("raystones", &raystones::SCENE, &raystones::CAMERA);
    view.scene("ftb", &ftb::SCENE, &ftb::CAMERA);
}

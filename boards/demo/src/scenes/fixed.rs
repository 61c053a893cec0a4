//! Fixed point.

#[path = "ftb.rs"]
mod ftb;
#[path = "limit.rs"]
mod limit;
#[path = "raystones.rs"]
mod raystones;
#[path = "../../../../examples/showcase/scene.rs"]
mod showcase;

use whitted::frame::{Output, Tone};

use super::Shot;
use crate::job::SceneName;

type A = whitted::math::Fixed;

/// The limit scene's cut-off, 4.5/256 (14 fraction bits).
const LIMIT_CUTOFF: <A as whitted::math::Arithmetic>::Weight = fixed::FixedI32::from_bits(288);

/// The old programs' colours are display values.
const LINEAR: Output = Output { tone: Tone::LINEAR, ..Output::SRGB };

pub(super) fn shot(name: SceneName) -> Shot<A> {
    let (scene, camera, depth, output) = match name {
        SceneName::Showcase => (&showcase::SCENE, &showcase::CAMERA, 5, Output::SRGB),
        SceneName::Limit => (&limit::SCENE, &limit::CAMERA, 4, LINEAR),
        SceneName::Raystones => (&raystones::SCENE, &raystones::CAMERA, 3, LINEAR),
        SceneName::Ftb => (&ftb::SCENE, &ftb::CAMERA, 3, LINEAR),
    };
    Shot { scene, camera, depth, output }
}

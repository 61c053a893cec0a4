//! Fixed point.

/// The bathroom, as the build script baked it.
#[allow(dead_code, unreachable_pub, reason = "as it was baked")]
mod bathroom {
    include!(concat!(env!("OUT_DIR"), "/bathroom_fixed.rs"));
}
#[path = "ftb.rs"]
mod ftb;
#[cfg(any(feature = "counted", not(target_os = "none")))]
#[path = "gfxcat.rs"]
mod gfxcat;
#[path = "limit.rs"]
mod limit;
#[path = "mirrors.rs"]
mod mirrors;
#[path = "raystones.rs"]
mod raystones;
#[path = "../../../../examples/showcase/scene.rs"]
mod showcase;
#[cfg(any(feature = "counted", not(target_os = "none")))]
#[path = "spheres64.rs"]
mod spheres64;

use whitted::frame::{Output, Tone};

use whitted::scene::Scene;

use super::{SAMPLINGS, Shot, View};
use crate::job::SceneName;

type A = whitted::math::Fixed;

/// The limit scene's cut-off, 4.5/256 (14 fraction bits).
const LIMIT_CUTOFF: <A as whitted::math::Arithmetic>::Weight = fixed::FixedI32::from_bits(288);

/// The old programs' colours are display values.
const LINEAR: Output = Output { tone: Tone::LINEAR, ..Output::SRGB };

/// The limit scene with the code for every sampling.
static SAMPLED: Scene<A, { limit::PARTS.uses() | SAMPLINGS }> = Scene::tailored(limit::PARTS);

pub(super) fn sampled<V: View<A>>(view: V) -> V::Output {
    view.view(Shot { scene: &SAMPLED, camera: &limit::CAMERA, depth: 4, output: LINEAR })
}

pub(super) fn mirrors<V: View<A>>(view: V) -> V::Output {
    let (scene, camera) = (&mirrors::SCENE, &mirrors::CAMERA);
    view.view(Shot { scene, camera, depth: 8, output: Output::SRGB })
}

#[inline(always)]
pub(super) fn shot<V: View<A>>(name: SceneName, view: V) -> V::Output {
    match name {
        SceneName::Showcase => {
            let (scene, camera) = (&showcase::SCENE, &showcase::CAMERA);
            view.view(Shot { scene, camera, depth: 5, output: Output::SRGB })
        }
        SceneName::Limit => {
            let (scene, camera) = (&limit::SCENE, &limit::CAMERA);
            view.view(Shot { scene, camera, depth: 4, output: LINEAR })
        }
        SceneName::Raystones => {
            let (scene, camera) = (&raystones::SCENE, &raystones::CAMERA);
            view.view(Shot { scene, camera, depth: 3, output: LINEAR })
        }
        SceneName::Ftb => {
            let (scene, camera) = (&ftb::SCENE, &ftb::CAMERA);
            view.view(Shot { scene, camera, depth: 3, output: LINEAR })
        }
        #[cfg(any(feature = "counted", not(target_os = "none")))]
        SceneName::Gfxcat => {
            let (scene, camera) = (&gfxcat::SCENE, &gfxcat::CAMERA);
            view.view(Shot { scene, camera, depth: 2, output: LINEAR })
        }
        #[cfg(any(feature = "counted", not(target_os = "none")))]
        SceneName::Spheres64 => {
            let (scene, camera) = (&spheres64::SCENE, &spheres64::CAMERA);
            view.view(Shot { scene, camera, depth: 1, output: LINEAR })
        }
        SceneName::Bathroom => {
            let (scene, camera) = (&bathroom::SCENE, &bathroom::CAMERA);
            view.view(Shot { scene, camera, depth: bathroom::DEPTH, output: Output::SRGB })
        }
        // Not carried there: no job asks for them.
        #[cfg(not(any(feature = "counted", not(target_os = "none"))))]
        SceneName::Gfxcat | SceneName::Spheres64 => shot(SceneName::Limit, view),
    }
}

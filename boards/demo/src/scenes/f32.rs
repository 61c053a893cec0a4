//! Single precision.

/// The bathroom, as the build script baked it.
#[allow(dead_code, unreachable_pub, reason = "as it was baked")]
#[cfg(not(all(target_arch = "arm", target_abi = "eabi")))]
mod bathroom {
    include!(concat!(env!("OUT_DIR"), "/bathroom_f32.rs"));
}
#[path = "ftb.rs"]
mod ftb;
#[cfg(all(
    any(feature = "counted", not(target_os = "none")),
    not(all(target_arch = "arm", target_abi = "eabi"))
))]
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
#[cfg(all(
    any(feature = "counted", not(target_os = "none")),
    not(all(target_arch = "arm", target_abi = "eabi"))
))]
#[path = "spheres64.rs"]
mod spheres64;

use whitted::frame::{Output, Tone};

use whitted::scene::Scene;

use super::{SAMPLINGS, Shot, View};
use crate::job::SceneName;

type A = f32;

/// The limit scene's cut-off, 4.5/256.
const LIMIT_CUTOFF: <A as whitted::math::Arithmetic>::Weight = 4.5 / 256.0;

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
        #[cfg(all(
            any(feature = "counted", not(target_os = "none")),
            not(all(target_arch = "arm", target_abi = "eabi"))
        ))]
        SceneName::Gfxcat => {
            let (scene, camera) = (&gfxcat::SCENE, &gfxcat::CAMERA);
            view.view(Shot { scene, camera, depth: 2, output: LINEAR })
        }
        #[cfg(all(
            any(feature = "counted", not(target_os = "none")),
            not(all(target_arch = "arm", target_abi = "eabi"))
        ))]
        SceneName::Spheres64 => {
            let (scene, camera) = (&spheres64::SCENE, &spheres64::CAMERA);
            view.view(Shot { scene, camera, depth: 1, output: LINEAR })
        }
        #[cfg(not(all(target_arch = "arm", target_abi = "eabi")))]
        SceneName::Bathroom => {
            let (scene, camera) = (&bathroom::SCENE, &bathroom::CAMERA);
            view.view(Shot { scene, camera, depth: bathroom::DEPTH, output: Output::SRGB })
        }
        // Not carried there: no job asks for them.
        #[cfg(all(target_arch = "arm", target_abi = "eabi"))]
        SceneName::Bathroom => shot(SceneName::Limit, view),
        #[cfg(not(all(
            any(feature = "counted", not(target_os = "none")),
            not(all(target_arch = "arm", target_abi = "eabi"))
        )))]
        SceneName::Gfxcat | SceneName::Spheres64 => shot(SceneName::Limit, view),
    }
}

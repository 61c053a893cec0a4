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

use whitted::frame::{Output, Sampling, Tone};

use whitted::scene::Scene;

use super::{SAMPLINGS, SPARSE_APART, View};
use crate::job::SceneName;

type A = whitted::math::Fixed;

/// The limit scene's cut-off, 4.5/256 (14 fraction bits).
const LIMIT_CUTOFF: <A as whitted::math::Arithmetic>::Weight = fixed::FixedI32::from_bits(288);

/// The old programs' colours are display values.
const LINEAR: Output = Output { tone: Tone::LINEAR, ..Output::SRGB };

scene_types! {
    Showcase = showcase;
    Limit = limit;
    Raystones = raystones;
    Ftb = ftb;
    Mirrors = mirrors;
}
#[cfg(any(feature = "counted", not(target_os = "none")))]
scene_types! {
    Gfxcat = gfxcat;
    Spheres64 = spheres64;
}
scene_types! {
    Bathroom = bathroom;
}

/// The limit scene with the code for every sampling, or for all but the sparse.
static SAMPLED: Scene<A, { limit::PARTS.uses() | SAMPLINGS }> = Scene::tailored(limit::PARTS);

whitted::scene_type! {
    struct Sampled: Scene<'static, A, { limit::PARTS.uses() | SAMPLINGS }> = SAMPLED;
}

pub(super) fn sampled<V: View<A>>(view: V) -> V::Output {
    view.view_parts(Sampled, &limit::CAMERA, 4, LINEAR)
}

/// The limit scene with the code for sparse sampling.
static SPARSE: Scene<A, { limit::PARTS.uses() | Sampling::SPARSE.uses() }> =
    Scene::tailored(limit::PARTS);

whitted::scene_type! {
    struct Sparse: Scene<'static, A, { limit::PARTS.uses() | Sampling::SPARSE.uses() }> = SPARSE;
}

pub(super) fn sparse<V: View<A>>(view: V) -> V::Output {
    if SPARSE_APART { view.view_parts(Sparse, &limit::CAMERA, 4, LINEAR) } else { sampled(view) }
}

pub(super) fn mirrors<V: View<A>>(view: V) -> V::Output {
    view.view_parts(Mirrors, &mirrors::CAMERA, 8, Output::SRGB)
}

#[inline(always)]
pub(super) fn shot<V: View<A>>(name: SceneName, view: V) -> V::Output {
    match name {
        SceneName::Showcase => view.view_parts(Showcase, &showcase::CAMERA, 5, Output::SRGB),
        SceneName::Limit => view.view_parts(Limit, &limit::CAMERA, 4, LINEAR),
        SceneName::Raystones => view.view_parts(Raystones, &raystones::CAMERA, 3, LINEAR),
        SceneName::Ftb => view.view_parts(Ftb, &ftb::CAMERA, 3, LINEAR),
        #[cfg(any(feature = "counted", not(target_os = "none")))]
        SceneName::Gfxcat => view.view_parts(Gfxcat, &gfxcat::CAMERA, 2, LINEAR),
        #[cfg(any(feature = "counted", not(target_os = "none")))]
        SceneName::Spheres64 => view.view_parts(Spheres64, &spheres64::CAMERA, 1, LINEAR),
        SceneName::Bathroom => {
            view.view_parts(Bathroom, &bathroom::CAMERA, bathroom::DEPTH, Output::SRGB)
        }
        // Not carried there: no job asks for them.
        #[cfg(not(any(feature = "counted", not(target_os = "none"))))]
        SceneName::Gfxcat | SceneName::Spheres64 => shot(SceneName::Limit, view),
    }
}

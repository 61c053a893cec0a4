//! Diffuse interreflection at a point.

use crate::gather::Indirect;
use crate::math::{Arithmetic, Rgb};
use crate::scene::Scene;

/// The irradiance that other surfaces send to a point, divided by π; `None` where the constant
/// ambient term stands for it.
#[inline(always)]
pub(super) fn indirect<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    p: [A::Length; 3],
    normal: [A::Unit; 3],
) -> Option<Rgb<A::Radiance>> {
    match &scene.parts.indirect {
        Indirect::None => None,
        Indirect::Cache(cache) => Some(cache.irradiance(p, normal)),
    }
}

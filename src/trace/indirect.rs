//! Diffuse interreflection at a point.

use super::area::front_before;
use super::visible::visible;
use super::work::{NO_LIGHT, Scratch};
use crate::gather::{Indirect, VirtualLights};
use crate::math::{Arithmetic, Rgb, rgb, sub};
use crate::scene::uses::{self, has};
use crate::scene::{Scene, SceneRef};
use crate::shape::Ray;
use crate::tally::{RayKind, Tally};

/// A point that is lit by others.
#[derive(Clone, Copy)]
pub(super) struct Spot<A: Arithmetic> {
    /// A ray from there, complete but for its direction.
    pub(super) ray: Ray<A>,
    pub(super) p: [A::Length; 3],
    pub(super) normal: [A::Unit; 3],
    pub(super) depth: u8,
    /// The pixel's place among those that take turns.
    pub(super) turn: u8,
}

/// The irradiance that other surfaces send to a point, divided by π; `None` where the constant
/// ambient term stands for it.
#[inline(always)]
pub(super) fn indirect<'s, A: Arithmetic, T: Tally, S, const USES: u64>(
    scene: S,
    spot: Spot<A>,
    scratch: &mut Scratch<A>,
    tally: &mut T,
) -> Option<Rgb<A::Radiance>>
where
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    match &scene.parts.indirect {
        Indirect::Cache(cache) if has(USES, uses::IRRADIANCE_CACHE) => {
            Some(cache.irradiance(spot.p, spot.normal))
        }
        Indirect::VirtualLights(lights) if has(USES, uses::VIRTUAL_LIGHTS) => {
            Some(virtual_lights(scene, lights, spot, scratch, tally))
        }
        _ => None,
    }
}

/// What the virtual lights of a pixel's part send.
#[inline(never)]
fn virtual_lights<'s, A: Arithmetic, T: Tally, S, const USES: u64>(
    scene: S,
    lights: &VirtualLights<'_, A>,
    spot: Spot<A>,
    scratch: &mut Scratch<A>,
    tally: &mut T,
) -> Rgb<A::Radiance>
where
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    let mut sum = [A::BLACK; 3];
    let mut ray = spot.ray;
    for light in lights.part(spot.turn) {
        if light.is_dark() {
            continue;
        }
        let (direction, distance, mut inverse) = A::normalize(&sub(&light.position, &ray.origin));
        let here = A::cosine(&spot.normal, &direction);
        let there = -A::cosine(&light.normal(), &direction);
        if here <= A::NO_WEIGHT || there <= A::NO_WEIGHT {
            continue;
        }
        if distance < lights.nearest() {
            inverse = A::normalize(&[lights.nearest(), A::NO_LENGTH, A::NO_LENGTH]).2;
        }
        let irradiance = A::falloff(&light.intensity, &inverse);
        ray.direction = direction;
        // What lies behind an area light doesn't add to what the light sends itself.
        if front_before(&scene, &ray, distance).is_some() {
            continue;
        }
        tally.ray(RayKind::Shadow, spot.depth, &ray, &[A::FULL; 3]);
        // Not quite to the light, which lies on a surface.
        let end = distance - A::scale(distance, A::fraction(32));
        let Some(share) = visible(scene, &ray, end, NO_LIGHT, None, scratch, tally) else {
            continue;
        };
        let cosines = A::weight(here, there);
        let factor = rgb(&light.color(), &share, A::weight).map(|c| A::weight(c, cosines));
        sum = rgb(&sum, &factor.map(|f| A::dim(irradiance, f)), A::gather);
    }
    sum.map(|sum| lights.scaled(sum))
}

//! Direct light: Lambert and Phong for each light that a shadow ray finds visible.

use super::area::{Point, areas};
use super::select::selected;
use super::sight::{Sights, may_be_few};
use super::visible::visible;
use super::work::Scratch;
use crate::math::{Arithmetic, Rgb, rgb};
use crate::scene::uses::{self, each, grey, has};
use crate::scene::{Incident, Light, Material, Rules, Scene, SceneRef, Selection};
use crate::shape::{Leaving, Ray, Surface};
use crate::tally::{RayKind, Tally, Term};

/// A point being shaded.
pub(super) struct Shading<'s, A: Arithmetic> {
    pub(super) surface: &'s Surface<A>,
    pub(super) material: &'s Material<A>,
    /// The mirror image of the ray about the shading normal.
    pub(super) mirror: &'s [A::Unit; 3],
    /// The shadow ray, complete but for its direction.
    pub(super) shadow: Ray<A>,
    /// The product of the coefficients down the tree.
    pub(super) weight: &'s Rgb<A::Weight>,
    pub(super) depth: u8,
    /// Phong's highlight counts: not where irradiance is gathered.
    pub(super) highlights: bool,
    /// Where random numbers come from: another one for each point that is shaded.
    pub(super) key: u32,
    /// What can be seen from the lights, if that is known.
    pub(super) sights: Option<&'s Sights<A>>,
}

/// Adds what the point sends back along the ray of each light's direct light.
#[inline(always)]
pub(super) fn direct<'s, A: Arithmetic, T: Tally, S, const USES: u64>(
    scene: S,
    mut at: Shading<'_, A>,
    sum: &mut Rgb<A::Radiance>,
    scratch: &mut Scratch<A>,
    tally: &mut T,
) where
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    if has(USES, uses::LIGHT_SELECTION) && !matches!(scene.parts.selection, Selection::All) {
        *sum = rgb(sum, &selected(scene, Point::of(&at), scratch, tally), A::gather);
        return;
    }
    each!(scene.parts.lights, has(USES, uses::SEVERAL_LIGHTS), 0, |light, number| {
        if let Some(radiance) = of_light(scene, &mut at, light, number, scratch, tally) {
            *sum = rgb(sum, &radiance, A::gather);
        }
    });
    if has(USES, uses::AREA_LIGHTS) && !scene.parts.area_lights.is_empty() {
        *sum = rgb(sum, &areas(scene, Point::of(&at), scratch, tally), A::gather);
    }
}

/// What one light adds, if it is visible.
#[inline(always)]
fn of_light<'s, A: Arithmetic, T: Tally, S, const USES: u64>(
    scene: S,
    at: &mut Shading<'_, A>,
    light: &Light<A>,
    number: u16,
    scratch: &mut Scratch<A>,
    tally: &mut T,
) -> Option<Rgb<A::Radiance>>
where
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    let sight = at.sights.filter(|_| may_be_few::<USES>());
    let sight = sight.and_then(|sights| sights.light(number));
    // Within an opaque sphere no light from outside arrives.
    let opaque = !has(USES, uses::PASSING_SHADOWS) || scene.opaque_shadows;
    let Leaving { shape, inwards, .. } = at.shadow.leaving;
    if inwards && opaque && sight.is_some_and(|sight| sight.hides_from(shape)) {
        return None;
    }
    let Incident { direction, distance, irradiance } = light.at::<USES>(&at.shadow.origin)?;
    let cosine = A::cosine(&at.surface.normal, &direction);
    if cosine <= A::NO_WEIGHT {
        return None;
    }
    // A dent doesn't see a light that lies below the surface.
    if has(USES, uses::BUMPS)
        && at.material.bump().is_some()
        && A::cosine(&at.surface.geometric, &direction) <= A::NO_WEIGHT
    {
        return None;
    }
    at.shadow.direction = direction;
    tally.ray(RayKind::Shadow, at.depth, &at.shadow, at.weight);
    let Some(share) = visible(scene, &at.shadow, distance, number, sight, scratch, tally) else {
        tally.shadowed(number, at.depth);
        return None;
    };
    let above = grey::<A, USES>(at.weight);
    // The first product is one for all colours where rays are grey.
    let part = |cosine: A::Weight, coefficient: &Rgb<A::Weight>| {
        rgb(&above.map(|w| A::weight(w, cosine)), coefficient, A::weight)
    };
    let mut factor = part(cosine, &at.material.diffuse);
    if at.highlights
        && let Some(highlight) =
            highlight::<A, USES>(&scene.parts.rules, at.material, at.mirror, cosine, &direction)
    {
        factor = rgb(&factor, &part(highlight, &at.material.specular), |a, b| a + b);
    }
    if has(USES, uses::COLORED_LIGHTS) {
        factor = rgb(&factor, &light.color, A::weight);
    }
    if !opaque {
        factor = rgb(&factor, &share, A::weight);
    }
    let radiance = factor.map(|f| A::dim(irradiance, f));
    tally.term::<A>(Term::Direct { light: number }, &radiance);
    Some(radiance)
}

/// The part of the irradiance from a direction (over π) that goes back along the ray: Lambert's
/// term and, given the mirror direction of the ray, Phong's highlight. `cosine` is the one between normal and direction, positive.
#[inline(always)]
pub(super) fn factor<A: Arithmetic, const USES: u64>(
    rules: &Rules<A>,
    material: &Material<A>,
    mirror: Option<&[A::Unit; 3]>,
    cosine: A::Weight,
    direction: &[A::Unit; 3],
) -> Rgb<A::Weight> {
    let factor = material.diffuse.map(|k| A::weight(k, cosine));
    match mirror.and_then(|m| highlight::<A, USES>(rules, material, m, cosine, direction)) {
        Some(highlight) => rgb(&factor, &material.specular, |f, k| f + A::weight(k, highlight)),
        None => factor,
    }
}

/// Phong's highlight, (R·L)ⁿ, or times the cosine, as the rules have it; `None` on the far side.
#[inline(always)]
fn highlight<A: Arithmetic, const USES: u64>(
    rules: &Rules<A>,
    material: &Material<A>,
    mirror: &[A::Unit; 3],
    cosine: A::Weight,
    direction: &[A::Unit; 3],
) -> Option<A::Weight> {
    if !has(USES, uses::HIGHLIGHTS) || !material.shines {
        return None;
    }
    // R_l·V, R_l being the mirror direction of L, is the same as L·R_v
    let lobe = A::cosine(mirror, direction);
    if lobe <= A::NO_WEIGHT {
        return None;
    }
    let highlight = A::power(lobe, &material.shininess);
    let with_cosine = has(USES, uses::HIGHLIGHT_COSINE) && rules.highlight_cosine;
    Some(if with_cosine { A::weight(highlight, cosine) } else { highlight })
}

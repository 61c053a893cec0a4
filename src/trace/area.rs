//! Direct light from areas: shadow rays to points of equal sub-areas. (The formulas are in
//! `scene/area_light.rs`.)

mod front;
mod place;

use super::direct::Shading;
use super::visible::visible_beside;
use super::work::Scratch;
use crate::math::{Arithmetic, Rgb, hash, largest, rgb, spread, sub};
use crate::scene::uses::{self, has};
use crate::scene::{AreaLight, Material, Scene, SceneRef};
use crate::shape::{Ray, Surface};
use crate::tally::{RayKind, Tally, Term};
pub(super) use front::front_before;
use place::Seen;
pub(crate) use place::point_of_light;

/// A point being shaded, by value: what a reference is taken of can't stay in registers.
#[derive(Clone, Copy)]
pub(super) struct Point<'s, A: Arithmetic> {
    pub(super) surface: Surface<A>,
    pub(super) material: &'s Material<A>,
    pub(super) mirror: [A::Unit; 3],
    pub(super) shadow: Ray<A>,
    pub(super) weight: Rgb<A::Weight>,
    pub(super) depth: u8,
    pub(super) highlights: bool,
    pub(super) key: u32,
}

impl<'s, A: Arithmetic> Point<'s, A> {
    #[inline(always)]
    pub(super) fn of(at: &Shading<'s, A>) -> Self {
        Self {
            surface: *at.surface,
            material: at.material,
            mirror: *at.mirror,
            shadow: at.shadow,
            weight: *at.weight,
            depth: at.depth,
            highlights: at.highlights,
            key: at.key,
        }
    }
}

/// What the point sends back along the ray of all area lights.
#[inline(never)]
pub(super) fn areas<'s, A: Arithmetic, T: Tally, S, const USES: u64>(
    scene: S,
    at: Point<'_, A>,
    scratch: &mut Scratch<A>,
    tally: &mut T,
) -> Rgb<A::Radiance>
where
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    let mut sum = [A::BLACK; 3];
    let mut number = scene.parts.lights.len() as u16;
    for light in scene.parts.area_lights {
        if let Some(radiance) = area(scene, light, number, &at, scratch, tally) {
            tally.term::<A>(Term::Direct { light: number }, &radiance);
            sum = rgb(&sum, &radiance, A::gather);
        }
        number = number.wrapping_add(1);
    }
    sum
}

/// What the light would add to the largest channel of the point, were nothing in its way: by its
/// centre, and never 0 where some of it can be seen.
pub(super) fn expected<A: Arithmetic, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    light: &AreaLight<A>,
    at: &Point<'_, A>,
) -> A::Radiance {
    let normal = &at.surface.normal;
    let Some(seen) = Seen::from(light, scene.parts.light_corners, &at.shadow.origin) else {
        return A::BLACK;
    };
    if A::project(&seen.way, normal) + light.half <= A::NO_LENGTH {
        return A::BLACK;
    }
    let k = rgb(&at.material.diffuse, &at.material.specular, |d, s| d + s);
    let k = rgb(&rgb(&k, &light.color, A::weight), &at.weight, A::weight);
    A::dim(seen.irradiance(light, normal), largest(&k))
}

/// What the point sends back of one light's; `None` where the light can't reach it.
pub(super) fn area<'s, A: Arithmetic, T: Tally, S, const USES: u64>(
    scene: S,
    light: &AreaLight<A>,
    number: u16,
    at: &Point<'_, A>,
    scratch: &mut Scratch<A>,
    tally: &mut T,
) -> Option<Rgb<A::Radiance>>
where
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    let parts = &scene.parts;
    let normal = &at.surface.normal;
    let seen = Seen::from(light, parts.light_corners, &at.shadow.origin)?;
    // Wholly below the horizon?
    if A::project(&seen.way, normal) + light.half <= A::NO_LENGTH {
        return None;
    }
    let (across, down) = grid(seen.samples(light), light.aspect);
    let step = |count: u16| 65536u32.checked_div(u32::from(count)).unwrap_or(0);
    let (step_s, step_t) = (step(across), step(down));
    let seed = parts
        .light_jitter
        .map(|seed| hash(spread(at.key, u32::from(seed) << 16 | u32::from(number))));

    let shines = has(USES, uses::HIGHLIGHTS)
        && at.material.shines
        && at.highlights
        // A mirror shows the light itself.
        && !(light.body().is_some() && at.material.mirrors);
    let mut shadowed = true;
    let (mut matt, mut gloss) = ([A::BLACK; 3], [A::BLACK; 3]);
    let mut ray = at.shadow;
    let mut sample = 0u32;
    for j in 0..u32::from(down) {
        for i in 0..u32::from(across) {
            // The middle of the cell, or anywhere in it.
            let bits = seed.map_or(0x8000_8000, |seed| hash(seed.wrapping_add(sample)));
            sample = sample.wrapping_add(1);
            let within = |i: u32, step: u32, part: u32| {
                i.wrapping_mul(step).wrapping_add(step.wrapping_mul(part) >> 16)
            };
            let s = within(i, step_s, bits & 0xffff);
            let t = within(j, step_t, bits >> 16);
            // In front of the light by what positions may be wrong, so that the ray ends there.
            let place = match seed {
                None => seen.middle(light, s, t, [step_s, step_t]),
                Some(_) => seen.point(s, t),
            };
            let y = A::leave(&place, &seen.normal, seen.distance);
            let (direction, distance, inverse) = A::normalize(&sub(&y, &ray.origin));
            let cosine = A::cosine(normal, &direction);
            let facing = -A::cosine(&seen.normal, &direction);
            if cosine <= A::NO_WEIGHT || facing <= A::NO_WEIGHT {
                continue;
            }
            ray.direction = direction;
            let limit = seen.end(light, &direction, distance);
            tally.ray(RayKind::Shadow, at.depth, &ray, &at.weight);
            let Some(share) =
                visible_beside(scene, &ray, limit, number, light.body, scratch, tally)
            else {
                continue;
            };
            shadowed = false;
            let facing = A::weight(facing, seen.share);
            let irradiance = A::dim(A::falloff(&light.intensity, &inverse), facing);
            let add = |sum: &Rgb<A::Radiance>, radiance: A::Radiance| {
                rgb(sum, &share, |sum, share| {
                    let radiance =
                        if share == A::FULL { radiance } else { A::dim(radiance, share) };
                    A::gather(sum, radiance)
                })
            };
            matt = add(&matt, A::dim(irradiance, cosine));
            if shines {
                // R_l·V, R_l being the mirror direction of L, is the same as L·R_v
                let lobe = A::cosine(&at.mirror, &direction);
                if lobe > A::NO_WEIGHT {
                    let mut highlight = A::power(lobe, &at.material.shininess);
                    if has(USES, uses::HIGHLIGHT_COSINE) && parts.rules.highlight_cosine {
                        highlight = A::weight(highlight, cosine);
                    }
                    gloss = add(&gloss, A::dim(irradiance, highlight));
                }
            }
        }
    }
    if shadowed {
        tally.shadowed(number, at.depth);
    }
    let count = across.wrapping_mul(down);
    let of = |sum: Rgb<A::Radiance>, k: &Rgb<A::Weight>| {
        let k = rgb(&rgb(k, &light.color, A::weight), &at.weight, A::weight);
        rgb(&sum.map(|sum| A::mean(sum, count)), &k, A::dim)
    };
    let mut radiance = of(matt, &at.material.diffuse);
    if shines {
        radiance = rgb(&radiance, &of(gloss, &at.material.specular), A::gather);
    }
    Some(radiance)
}

/// Cells across and down, together no fewer than `count`, about as long as wide on a light whose
/// sides are as `aspect` to 1 (Q8).
#[inline(always)]
pub(super) fn grid(count: u16, aspect: u16) -> (u16, u16) {
    let wanted = u32::from(count).wrapping_mul(u32::from(aspect));
    let mut across = 1u32;
    while across < u32::from(count) && (across.wrapping_mul(across) << 8) < wanted {
        across += 1;
    }
    let down = u32::from(count).wrapping_add(across - 1).checked_div(across).unwrap_or(1);
    (across as u16, down as u16)
}

#[cfg(test)]
mod tests {
    use super::grid;

    #[test]
    fn grids_hold_the_count_and_follow_the_light() {
        assert_eq!(grid(1, 256), (1, 1));
        assert_eq!(grid(4, 256), (2, 2));
        assert_eq!(grid(5, 256), (3, 2));
        assert_eq!(grid(64, 256), (8, 8));
        assert_eq!(grid(16, 1024), (8, 2));
        assert_eq!(grid(16, 64), (2, 8));
        assert_eq!(grid(3, 4096), (3, 1));
        for count in 1..=1024 {
            for aspect in [16, 100, 256, 700, 4096] {
                let (a, b) = grid(count, aspect);
                assert!(a * b >= count && a * (b - 1) < count, "{count}: {a}×{b}");
            }
        }
    }
}

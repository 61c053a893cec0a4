//! What a shadow ray finds between a point and a light.

use super::nearest::nearest;
use crate::math::{Arithmetic, Rgb, largest, neg, rgb};
use crate::scene::{Scene, Shadow, with_shape};
use crate::shape::{Leaving, Meeting, Ray, Shape};
use crate::tally::{RayKind, Tally};

/// More sheets of glass than this between a point and a light are taken for opaque.
const MAX_SHEETS: usize = 32;

/// Whether anything lies along the ray nearer than `limit`; its number.
#[inline(always)]
fn occluder<A: Arithmetic, T: Tally>(
    scene: &Scene<'_, A>,
    ray: &Ray<A>,
    limit: A::Length,
    tally: &mut T,
) -> Option<u32> {
    let coarse = A::coarse(&ray.origin, &ray.direction);
    let leaving = ray.leaving;
    macro_rules! test {
        ($shape:expr, $id:expr, $flat:expr) => {
            if $id != leaving.shape || (!$flat && leaving.inwards) {
                tally.test();
                if $shape.occludes(ray, &coarse, $id == leaving.shape, limit) {
                    return Some($id);
                }
            }
        };
    }
    let parts = &scene.parts;
    let mut id = 0;
    for sphere in parts.spheres {
        test!(sphere, id, false);
        id += 1;
    }
    for plane in parts.planes {
        test!(plane, id, true);
        id += 1;
    }
    None
}

/// How much of a light comes along the shadow ray from nearer than `limit`; `None` for nothing.
#[inline(always)]
pub(super) fn visible<A: Arithmetic, T: Tally>(
    scene: &Scene<'_, A>,
    ray: &Ray<A>,
    limit: A::Length,
    tally: &mut T,
) -> Option<Rgb<A::Weight>> {
    if !scene.opaque_shadows {
        return filtered(scene, ray, limit, tally);
    }
    match occluder(scene, ray, limit, tally) {
        Some(shape) => {
            tally.hit::<A>(RayKind::Shadow, shape, limit);
            None
        }
        None => Some([A::FULL; 3]),
    }
}

/// The product of the coefficients of transmission along the straight line.
#[inline(never)]
fn filtered<A: Arithmetic, T: Tally>(
    scene: &Scene<'_, A>,
    ray: &Ray<A>,
    limit: A::Length,
    tally: &mut T,
) -> Option<Rgb<A::Weight>> {
    let mut share = [A::FULL; 3];
    let (mut ray, mut left) = (*ray, limit);
    for _ in 0..MAX_SHEETS {
        let Some(hit) = nearest(scene, &ray, left, tally) else { return Some(share) };
        let p = A::along(&ray.origin, hit.distance, &ray.direction);
        let meeting = Meeting { distance: hit.distance, detail: hit.detail };
        let (surface, id) = with_shape!(&scene.parts, hit.shape, shape => {
            (shape.surface(&ray, &meeting, &p), shape.material())
        }, return None);
        let material = scene.material_at(id, &p)?;
        match material.shadow {
            Shadow::None => {}
            Shadow::Filtered if material.transmits => {
                share = rgb(&share, &material.transmission, A::weight);
            }
            Shadow::Opaque | Shadow::Filtered => share = [A::NO_WEIGHT; 3],
        }
        if largest(&share) <= A::NO_WEIGHT {
            tally.hit::<A>(RayKind::Shadow, hit.shape, limit);
            return None;
        }
        ray.origin = A::leave(&p, &neg(&surface.geometric), hit.distance);
        ray.leaving = Leaving { shape: hit.shape, inwards: !surface.behind };
        left = left - hit.distance;
    }
    None
}

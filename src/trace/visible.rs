//! What a shadow ray finds between a point and a light.

use super::nearest::nearest;
use crate::math::{Arithmetic, Rgb, largest, neg, rgb};
use crate::octree::{Octree, Visitor, WalkStack};
use crate::scene::{Parts, Scene, Shadow, for_each_other, with_shape};
use crate::shape::{Leaving, Meeting, Ray, Shape};
use crate::tally::{RayKind, Tally};

/// More sheets of glass than this between a point and a light are taken for opaque.
const MAX_SHEETS: usize = 32;

/// Looks for any shape along a shadow ray.
struct Occluder<'r, 'a, A: Arithmetic, T> {
    parts: &'r Parts<'a, A>,
    ray: &'r Ray<A>,
    coarse: A::Coarse,
    limit: A::Length,
    found: Option<u32>,
    tally: &'r mut T,
}

impl<A: Arithmetic, T: Tally> Occluder<'_, '_, A, T> {
    /// Tests a shape, and says whether the search is over.
    #[inline(always)]
    fn test<S: Shape<A>>(&mut self, shape: &S, id: u32) -> bool {
        let leaving = self.ray.leaving;
        if id == leaving.shape && (S::FLAT || !leaving.inwards) {
            return false;
        }
        self.tally.test();
        let blocked = shape.occludes(self.ray, &self.coarse, id == leaving.shape, self.limit);
        if blocked {
            self.found = Some(id);
        }
        blocked
    }
}

// Out of line, so that a scene of some spheres gets the registers for its short loop.
impl<A: Arithmetic, T: Tally> Occluder<'_, '_, A, T> {
    #[inline(never)]
    fn walk(&mut self, tree: &Octree<'_, A>, walk: &mut WalkStack<A>) {
        let ray = self.ray;
        tree.walk(&ray.origin, &ray.direction, walk, self);
    }

    /// Tests all bounded shapes but spheres, the first of which has the number `id`.
    #[inline(never)]
    fn others(&mut self, mut id: u32) {
        for_each_other!(self.parts, id, shape => if self.test(shape, id) {
            return;
        });
    }
}

impl<A: Arithmetic, T: Tally> Visitor<A> for Occluder<'_, '_, A, T> {
    #[inline(always)]
    fn limit(&self) -> A::Length {
        self.limit
    }

    #[inline(always)]
    fn visit(&mut self, id: u32) -> bool {
        let parts = self.parts;
        with_shape!(parts, id, shape => self.test(shape, id), false)
    }

    #[inline(always)]
    fn node(&mut self) {
        self.tally.node();
    }
}

/// The number of any shape along the ray nearer than `limit`.
#[inline(always)]
fn occluder<A: Arithmetic, T: Tally>(
    scene: &Scene<'_, A>,
    ray: &Ray<A>,
    limit: A::Length,
    walk: &mut WalkStack<A>,
    tally: &mut T,
) -> Option<u32> {
    let coarse = A::coarse(&ray.origin, &ray.direction);
    let parts = &scene.parts;
    let mut search = Occluder { parts, ray, coarse, limit, found: None, tally };
    match &parts.tree {
        Some(tree) => search.walk(tree, walk),
        None => {
            let mut id = 0;
            for sphere in parts.spheres {
                if search.test(sphere, id) {
                    return search.found;
                }
                id += 1;
            }
            if id != scene.bounded {
                search.others(id);
            }
        }
    }
    if search.found.is_some() {
        return search.found;
    }
    let mut id = scene.bounded;
    for plane in parts.planes {
        if search.test(plane, id) {
            return search.found;
        }
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
    walk: &mut WalkStack<A>,
    tally: &mut T,
) -> Option<Rgb<A::Weight>> {
    if !scene.opaque_shadows {
        return filtered(scene, ray, limit, walk, tally);
    }
    match occluder(scene, ray, limit, walk, tally) {
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
    walk: &mut WalkStack<A>,
    tally: &mut T,
) -> Option<Rgb<A::Weight>> {
    let mut share = [A::FULL; 3];
    let (mut ray, mut left) = (*ray, limit);
    for _ in 0..MAX_SHEETS {
        let Some(hit) = nearest(scene, &ray, left, walk, tally) else { return Some(share) };
        let mut p = A::along(&ray.origin, hit.distance, &ray.direction);
        let meeting = Meeting { distance: hit.distance, detail: hit.detail };
        let (surface, id) = with_shape!(&scene.parts, hit.shape, shape => {
            (shape.surface(&ray, &meeting, &mut p), shape.material())
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
        ray.origin = A::leave(&p, &neg(&surface.geometric), surface.carried);
        ray.leaving = Leaving { shape: hit.shape, inwards: !surface.behind };
        left = left - hit.distance;
    }
    None
}

//! What a shadow ray finds between a point and a light.

use super::meet::{meet, meet_any, surface_at};
use super::nearest::nearest;
use crate::math::{Arithmetic, Rgb, largest, neg, rgb};
use crate::octree::{Octree, Visitor, WalkStack};
use crate::scene::{Parts, Scene, Shadow};
use crate::shape::{Leaving, Meeting, Plane, Ray, Shape, Sphere};
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
    /// Notes whether a shape blocks the ray, and says whether the search is over.
    #[inline(always)]
    fn note(&mut self, blocked: bool, id: u32) -> bool {
        if blocked {
            self.found = Some(id);
        }
        blocked
    }

    #[inline(always)]
    fn sphere(&mut self, sphere: &Sphere<A>, id: u32) -> bool {
        self.tally.test();
        let (ray, leaving) = (self.ray, self.ray.leaving);
        let left = id == leaving.shape;
        let blocked =
            (leaving.inwards || !left) && sphere.occludes(ray, &self.coarse, left, self.limit);
        self.note(blocked, id)
    }

    #[inline(always)]
    fn plane(&mut self, plane: &Plane<A>, id: u32) -> bool {
        self.tally.test();
        let meeting = meet(plane, id, self.ray, &self.coarse, self.limit);
        self.note(meeting.is_some_and(|m| m.distance < self.limit), id)
    }

    #[inline(always)]
    fn any(&mut self, id: u32) -> bool {
        self.tally.test();
        let meeting = meet_any(self.parts, id, self.ray, &self.coarse, self.limit);
        self.note(meeting.is_some_and(|m| m.distance < self.limit), id)
    }

    #[inline(never)]
    fn walk(&mut self, tree: &Octree<'_, A>, walk: &mut WalkStack<A>) {
        let ray = self.ray;
        tree.walk(&ray.origin, &ray.direction, walk, self);
    }
}

impl<A: Arithmetic, T: Tally> Visitor<A> for Occluder<'_, '_, A, T> {
    #[inline(always)]
    fn limit(&self) -> A::Length {
        self.limit
    }

    #[inline(always)]
    fn visit(&mut self, id: u32) -> bool {
        match self.parts.spheres.get(id as usize) {
            Some(sphere) => self.sphere(sphere, id),
            None => self.any(id),
        }
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
                if search.sphere(sphere, id) {
                    return search.found;
                }
                id += 1;
            }
            while id < scene.bounded {
                if search.any(id) {
                    return search.found;
                }
                id += 1;
            }
        }
    }
    if search.found.is_some() {
        return search.found;
    }
    let mut id = scene.bounded;
    for plane in parts.planes {
        if search.plane(plane, id) {
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
        let (surface, id) = surface_at(scene, hit.shape, &ray, &meeting, &mut p)?;
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

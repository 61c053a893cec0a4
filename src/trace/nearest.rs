//! The nearest hit along a ray.

use crate::math::Arithmetic;
use crate::octree::{Octree, Visitor, WalkStack};
use crate::scene::{Parts, Scene, for_each_other, with_shape};
use crate::shape::{Ray, Shape};
use crate::tally::Tally;

/// The nearest hit along a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit<A: Arithmetic> {
    /// From the ray's origin.
    pub distance: A::Length,
    /// See [`Meeting::detail`](crate::shape::Meeting::detail).
    pub(crate) detail: A::Length,
    /// The shape's number in the scene.
    pub shape: u32,
}

/// Looks at shapes one by one and keeps the nearest hit.
struct Nearest<'r, 'a, A: Arithmetic, T> {
    parts: &'r Parts<'a, A>,
    ray: &'r Ray<A>,
    coarse: A::Coarse,
    best: Hit<A>,
    tally: &'r mut T,
}

impl<A: Arithmetic, T: Tally> Nearest<'_, '_, A, T> {
    #[inline(always)]
    fn test<S: Shape<A>>(&mut self, shape: &S, id: u32) {
        let leaving = self.ray.leaving;
        if id == leaving.shape && (S::FLAT || !leaving.inwards) {
            return;
        }
        self.tally.test();
        let inwards = id == leaving.shape;
        let limit = self.best.distance;
        if let Some(meeting) = shape.nearest(self.ray, &self.coarse, inwards, limit)
            && (meeting.distance < limit || id < self.best.shape)
        {
            self.best = Hit { distance: meeting.distance, detail: meeting.detail, shape: id };
        }
    }
}

// Out of line, so that a scene of some spheres gets the registers for its short loop.
impl<A: Arithmetic, T: Tally> Nearest<'_, '_, A, T> {
    #[inline(never)]
    fn walk(&mut self, tree: &Octree<'_, A>, walk: &mut WalkStack<A>) {
        let ray = self.ray;
        tree.walk(&ray.origin, &ray.direction, walk, self);
    }

    /// Tests all bounded shapes but spheres, the first of which has the number `id`.
    #[inline(never)]
    fn others(&mut self, mut id: u32) {
        for_each_other!(self.parts, id, shape => self.test(shape, id));
    }
}

impl<A: Arithmetic, T: Tally> Visitor<A> for Nearest<'_, '_, A, T> {
    #[inline(always)]
    fn limit(&self) -> A::Length {
        self.best.distance
    }

    #[inline(always)]
    fn visit(&mut self, id: u32) -> bool {
        let parts = self.parts;
        with_shape!(parts, id, shape => self.test(shape, id), {});
        false
    }

    #[inline(always)]
    fn node(&mut self) {
        self.tally.node();
    }
}

/// The nearest hit in front of `limit`; the lowest number among equals.
#[inline(always)]
pub(crate) fn nearest<A: Arithmetic, T: Tally>(
    scene: &Scene<'_, A>,
    ray: &Ray<A>,
    limit: A::Length,
    walk: &mut WalkStack<A>,
    tally: &mut T,
) -> Option<Hit<A>> {
    let coarse = A::coarse(&ray.origin, &ray.direction);
    let best = Hit { distance: limit, detail: A::NO_LENGTH, shape: u32::MAX };
    let parts = &scene.parts;
    let mut search = Nearest { parts, ray, coarse, best, tally };
    // Planes first: their distance bounds the walk.
    let mut id = scene.bounded;
    for plane in parts.planes {
        search.test(plane, id);
        id += 1;
    }
    if let Some(tree) = &parts.tree {
        search.walk(tree, walk);
    } else {
        let mut id = 0;
        for sphere in parts.spheres {
            search.test(sphere, id);
            id += 1;
        }
        if id != scene.bounded {
            search.others(id);
        }
    }
    if search.best.distance < limit { Some(search.best) } else { None }
}

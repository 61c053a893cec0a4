//! The nearest hit along a ray.

use super::meet::{meet, meet_any};
use crate::math::Arithmetic;
use crate::octree::{Octree, Visitor, WalkStack};
use crate::scene::{Parts, Scene};
use crate::shape::{Meeting, Ray, Shape};
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
    /// Keeps a meeting that is nearer than the best so far, or as near with a lower number.
    #[inline(always)]
    fn keep(&mut self, meeting: Option<Meeting<A>>, id: u32) {
        if let Some(Meeting { distance, detail }) = meeting
            && (distance < self.best.distance || id < self.best.shape)
        {
            self.best = Hit { distance, detail, shape: id };
        }
    }

    #[inline(always)]
    fn test<S: Shape<A>>(&mut self, shape: &S, id: u32) {
        self.tally.test();
        self.keep(meet(shape, id, self.ray, &self.coarse, self.best.distance), id);
    }

    #[inline(always)]
    fn test_any(&mut self, id: u32) {
        self.tally.test();
        self.keep(meet_any(self.parts, id, self.ray, &self.coarse, self.best.distance), id);
    }

    #[inline(never)]
    fn walk(&mut self, tree: &Octree<'_, A>, walk: &mut WalkStack<A>) {
        let ray = self.ray;
        tree.walk(&ray.origin, &ray.direction, walk, self);
    }
}

impl<A: Arithmetic, T: Tally> Visitor<A> for Nearest<'_, '_, A, T> {
    #[inline(always)]
    fn limit(&self) -> A::Length {
        self.best.distance
    }

    #[inline(always)]
    fn visit(&mut self, id: u32) -> bool {
        match self.parts.spheres.get(id as usize) {
            Some(sphere) => self.test(sphere, id),
            None => self.test_any(id),
        }
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
        while id < scene.bounded {
            search.test_any(id);
            id += 1;
        }
    }
    if search.best.distance < limit { Some(search.best) } else { None }
}

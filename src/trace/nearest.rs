//! The nearest hit along a ray.

use super::meet::meet_any;
use super::sight::{Ahead, CONES_FIRST, are_few, each_ahead};
use crate::math::Arithmetic;
use crate::octree::{Visitor, WalkStack};
use crate::scene::uses::{self, each, has, has_others};
use crate::scene::{Scene, SceneRef, Shapes, ShapesOf, is_known};
use crate::shape::{Leaving, Meeting, Ray};
use crate::tally::Tally;
use core::ops::{Deref, Range};

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

impl<A: Arithmetic> Hit<A> {
    /// Takes a meeting that is nearer than this hit, or as near with a lower number.
    #[inline(always)]
    fn take(&mut self, meeting: Option<Meeting<A>>, id: u32) {
        if let Some(Meeting { distance, detail }) = meeting
            && (distance < self.distance || id < self.shape)
        {
            *self = Self { distance, detail, shape: id };
        }
    }
}

/// Where a ray meets a sphere that the coarse test lets through, as few are. The distance is 0 for nowhere:
/// two numbers come back in registers.
///
/// Out of line where there are few of those, since all that the walk keeps would have to make way for this.
/// By number, for a scene that the compiler knows is known here, too.
#[cfg_attr(narrow_multiply, cold, inline(never))]
#[cfg_attr(not(narrow_multiply), inline(always))]
fn meet_sphere<'s, A: Arithmetic, L>(
    shapes: L,
    id: u32,
    ray: &Ray<A>,
    limit: A::Length,
) -> Meeting<A>
where
    L: Copy + Deref<Target = Shapes<'s, A>>,
{
    let left = id == ray.leaving.shape;
    if (!left || ray.leaving.inwards)
        && let Some(sphere) = shapes.spheres.get(id as usize)
        && let Some(meeting) = sphere.meet_likely::<{ uses::ALL }>(ray, left, limit)
    {
        return meeting;
    }
    Meeting { distance: A::NO_LENGTH, detail: A::NO_LENGTH }
}

/// The search that goes on where spheres and planes are not all, or lie in a tree.
struct Search<'r, A: Arithmetic, T, L, const USES: u64> {
    shapes: L,
    ray: &'r Ray<A>,
    coarse: A::Coarse,
    best: Hit<A>,
    tally: &'r mut T,
}

impl<'s, A: Arithmetic, T: Tally, L, const USES: u64> Search<'_, A, T, L, USES>
where
    L: Copy + Deref<Target = Shapes<'s, A>>,
{
    #[inline(always)]
    fn test_any(&mut self, id: u32) {
        self.tally.test();
        let limit = self.best.distance;
        self.best.take(meet_any::<A, USES>(&self.shapes, id, self.ray, &self.coarse, limit), id);
    }
}

impl<'s, A: Arithmetic, T: Tally, L, const USES: u64> Visitor<A> for Search<'_, A, T, L, USES>
where
    L: Copy + Deref<Target = Shapes<'s, A>>,
{
    #[inline(always)]
    fn limit(&self) -> A::Length {
        self.best.distance
    }

    #[inline(always)]
    fn visit(&mut self, id: u32) -> bool {
        match self.shapes.spheres.get(id as usize) {
            Some(sphere) => {
                self.tally.test();
                let limit = self.best.distance;
                if sphere.may_be_met(&self.coarse, limit) {
                    let meeting = meet_sphere(self.shapes, id, self.ray, limit);
                    if meeting.distance > A::NO_LENGTH {
                        self.best.take(Some(meeting), id);
                    }
                }
            }
            None => self.test_any(id),
        }
        false
    }

    #[inline(always)]
    fn node(&mut self) {
        self.tally.node();
    }
}

/// The nearest hit no farther than `limit` in the tree, or of those shapes that nobody tests else.
/// Out of line and by value, so that the short loops keep their numbers in registers.
#[inline(never)]
fn search<'s, A: Arithmetic, T: Tally, L, const USES: u64>(
    shapes: L,
    rest: Range<u32>,
    ray: Ray<A>,
    limit: A::Length,
    walk: &mut WalkStack<A>,
    tally: &mut T,
) -> Hit<A>
where
    L: Copy + Deref<Target = Shapes<'s, A>>,
{
    let coarse = A::coarse(&ray.origin, &ray.direction);
    let best = Hit { distance: limit, detail: A::NO_LENGTH, shape: u32::MAX };
    let mut search = Search::<A, T, L, USES> { shapes, ray: &ray, coarse, best, tally };
    if has(USES, uses::TREE)
        && let Some(tree) = &shapes.tree
    {
        tree.walk(&ray.origin, &ray.direction, walk, &mut search);
    } else {
        for id in rest {
            search.test_any(id);
        }
    }
    search.best
}

/// Goes on with the instances.
#[inline(never)]
fn in_instances<'s, A: Arithmetic, T: Tally, S, const USES: u64>(
    scene: S,
    ray: Ray<A>,
    mut best: Hit<A>,
    walk: &mut WalkStack<A>,
    tally: &mut T,
) -> Hit<A>
where
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    let coarse = A::coarse(&ray.origin, &ray.direction);
    let mut first = scene.bounded;
    for instance in scene.parts.instances {
        tally.test();
        let group = instance.group();
        if let Some(inside) = instance.enter(first, &ray, &coarse, best.distance) {
            let limit = instance.distance_inside(&inside, best.distance);
            let rest = 0..group.count;
            let hit = search::<A, T, _, USES>(&group.shapes, rest, inside.ray, limit, walk, tally);
            if hit.shape != u32::MAX && hit.distance < A::FAR {
                let distance = instance.distance_outside(&inside, hit.distance);
                let id = first.wrapping_add(hit.shape);
                // Rounding can take it a step beyond.
                if distance <= best.distance {
                    best.take(Some(Meeting { distance, detail: hit.detail }), id);
                }
            }
        }
        first = first.wrapping_add(group.count);
    }
    best
}

/// The nearest hit in front of `limit`; the lowest number among equals. Also, what is
/// known of what lies ahead.
#[inline(always)]
pub(crate) fn nearest<'s, A: Arithmetic, T: Tally, S, const USES: u64>(
    scene: S,
    ray: &Ray<A>,
    limit: A::Length,
    Ahead { sight, clear }: Ahead<'_, A>,
    walk: &mut WalkStack<A>,
    tally: &mut T,
) -> Option<Hit<A>>
where
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    let (parts, shapes) = (&scene.parts, &scene.shapes);
    let coarse = A::coarse(&ray.origin, &ray.direction);
    let mut best = Hit { distance: limit, detail: A::NO_LENGTH, shape: u32::MAX };
    // Planes first: their distance bounds the walk.
    let planes = if has(USES, uses::PLANES) { parts.planes } else { &[] };
    each!(planes, has(USES, uses::SEVERAL_PLANES), scene.first_plane, |plane, id| {
        tally.test();
        if id != ray.leaving.shape {
            let meeting = plane.meet::<USES>(ray, best.distance);
            // Of two planes at the horizon it is the detail that tells which is nearer.
            if has(USES, uses::SEVERAL_PLANES)
                && let Some(Meeting { distance, detail }) = meeting
                && distance == best.distance
                && detail < best.detail
            {
                best.shape = u32::MAX;
            }
            best.take(meeting, id);
        }
    });
    let tree = has(USES, uses::TREE) && shapes.tree.is_some();
    if !tree {
        let Leaving { shape: left, inwards, .. } = ray.leaving;
        // The sphere that the ray leaves apart from the rest, which then needn't know.
        if inwards && let Some(sphere) = shapes.spheres.get(left as usize) {
            best.take(sphere.meet_likely::<USES>(ray, true, best.distance), left);
        }
        if clear {
            shapes.spheres.iter().for_each(|_| tally.test());
        } else if (sight.is_some() || !CONES_FIRST) && are_few(&scene) {
            // Where cones don't come first there is one loop, known vantage or not: less code.
            each_ahead!(sight, shapes.spheres, &ray.direction, tally, |sphere, id| if id != left {
                best.take(
                    if CONES_FIRST {
                        sphere.meet_likely::<USES>(ray, false, best.distance)
                    } else {
                        sphere.meet::<USES>(ray, &coarse, false, best.distance)
                    },
                    id,
                );
            });
        } else {
            let mut id = 0;
            for sphere in shapes.spheres {
                tally.test();
                if id != left {
                    best.take(sphere.meet::<USES>(ray, &coarse, false, best.distance), id);
                }
                id += 1;
            }
        }
    }
    let count = shapes.spheres.len() as u32;
    if tree || has_others(USES) && count != scene.bounded {
        let rest = count..scene.bounded;
        let limit = best.distance;
        let Hit { distance, detail, shape } = if is_known::<S>() {
            search::<A, T, _, USES>(ShapesOf(scene), rest, *ray, limit, walk, tally)
        } else {
            search::<A, T, _, USES>(shapes, rest, *ray, limit, walk, tally)
        };
        best.take(Some(Meeting { distance, detail }), shape);
    }
    if has(USES, uses::INSTANCES) && !parts.instances.is_empty() {
        best = in_instances(scene, *ray, best, walk, tally);
    }
    if best.distance < limit { Some(best) } else { None }
}

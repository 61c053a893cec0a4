//! A shape that a test describes, made in each arithmetic.

use super::*;
use crate::octree::Extent;

/// `f` of the shape in an arithmetic; `None` where it can't be made.
pub(super) fn with<A: Test + Make, R>(
    solid: &Solid,
    f: impl FnOnce(&dyn Probe<A>) -> R,
) -> Option<R> {
    A::make(solid).map(|shape| f(&*shape))
}

/// [`Shape`] without its constant, so that it can be a trait object.
pub(super) trait Probe<A: Arithmetic> {
    fn nearest(&self, ray: &Ray<A>, inwards: bool, limit: A::Length) -> Option<Meeting<A>>;
    fn occludes(&self, ray: &Ray<A>, limit: A::Length) -> bool;
    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>) -> Surface<A>;
    fn flat(&self) -> bool;
}

impl<A: Arithmetic, S: Shape<A>> Probe<A> for S {
    fn nearest(&self, ray: &Ray<A>, inwards: bool, limit: A::Length) -> Option<Meeting<A>> {
        Shape::nearest(self, ray, &A::coarse(&ray.origin, &ray.direction), inwards, limit)
    }
    fn occludes(&self, ray: &Ray<A>, limit: A::Length) -> bool {
        Shape::occludes(self, ray, &A::coarse(&ray.origin, &ray.direction), false, limit)
    }
    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>) -> Surface<A> {
        let mut p = A::along(&ray.origin, meeting.distance, &ray.direction);
        Shape::surface(self, ray, meeting, &mut p)
    }
    fn flat(&self) -> bool {
        S::FLAT
    }
}

/// A polygon that keeps its edges.
struct Owned<A: Arithmetic>(Polygon<A>, Vec<PolygonEdge<A>>);

impl<A: Arithmetic> Shape<A> for Owned<A> {
    const FLAT: bool = true;
    fn nearest(&self, r: &Ray<A>, c: &A::Coarse, i: bool, l: A::Length) -> Option<Meeting<A>> {
        Shape::nearest(&self.0.view(&self.1), r, c, i, l)
    }
    fn surface(&self, r: &Ray<A>, m: &Meeting<A>, p: &mut [A::Length; 3]) -> Surface<A> {
        Shape::surface(&self.0.view(&self.1), r, m, p)
    }
    fn material(&self) -> MaterialId {
        self.0.view(&self.1).material()
    }
}

pub(super) trait Make: Arithmetic {
    fn make(solid: &Solid) -> Option<Box<dyn Probe<Self>>>;
    fn extent(solid: &Solid, log2_step: i8) -> Option<Extent>;
    /// The least slope of a plane to a ray at which its shapes have no cracks, at distances of
    /// tens of their size.
    const GLANCE: f64;
}

macro_rules! make {
    ($a:ty, $glance:literal) => {
        impl Make for $a {
            const GLANCE: f64 = $glance;

            fn make(solid: &Solid) -> Option<Box<dyn Probe<$a>>> {
                Some(match solid {
                    Solid::Sphere(c, r) => Box::new(Sphere::<$a>::try_new(*c, *r, 0).ok()?),
                    Solid::Disc(c, n, r) => Box::new(Disc::<$a>::try_new(*c, *n, *r, 0).ok()?),
                    Solid::Cuboid(a, b) => Box::new(Cuboid::<$a>::try_new(*a, *b, 0).ok()?),
                    Solid::Triangle(c) => Box::new(Triangle::<$a>::try_new(*c, 0).ok()?),
                    Solid::Polygon(c) => {
                        let edge = |i| Polygon::<$a>::try_edge(c, i).ok();
                        let edges = (0..c.len()).map(edge).collect::<Option<_>>()?;
                        Box::new(Owned(Polygon::<$a>::try_new(c, 0, 0).ok()?, edges))
                    }
                    Solid::Cylinder(b, a, r) => {
                        Box::new(Cylinder::<$a>::try_new(*b, *a, *r, 0).ok()?)
                    }
                    Solid::Cone(b, r, a, s) => {
                        Box::new(Cone::<$a>::try_new(*b, *r, *a, *s, 0).ok()?)
                    }
                })
            }

            fn extent(solid: &Solid, step: i8) -> Option<Extent> {
                Some(match solid {
                    Solid::Sphere(c, r) => Sphere::<$a>::try_new(*c, *r, 0).ok()?.extent(step),
                    Solid::Disc(c, n, r) => Disc::<$a>::try_new(*c, *n, *r, 0).ok()?.extent(step),
                    Solid::Cuboid(a, b) => Cuboid::<$a>::try_new(*a, *b, 0).ok()?.extent(step),
                    Solid::Triangle(c) => Triangle::<$a>::try_new(*c, 0).ok()?.extent(step),
                    Solid::Polygon(c) => Polygon::<$a>::try_new(c, 0, 0).ok()?.extent(step),
                    Solid::Cylinder(b, a, r) => {
                        Cylinder::<$a>::try_new(*b, *a, *r, 0).ok()?.extent(step)
                    }
                    Solid::Cone(b, r, a, s) => {
                        Cone::<$a>::try_new(*b, *r, *a, *s, 0).ok()?.extent(step)
                    }
                })
            }
        }
    };
}
make!(Fixed, 0.02);
make!(f32, 0.001);
make!(f64, 0.001);

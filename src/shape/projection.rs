//! The plane of a flat shape, seen along its dominant axis.
//!
//! Where the normal's largest component lies along axis k, the plane is written x_k + n_u·x_u +
//! n_v·x_v = offset with |n_u|, |n_v| ≤ 1 (Wald, "Realtime Ray Tracing and Interactive Global
//! Illumination", 2004), u and v being the axes after k in cyclic order. A ray meets it at
//! t = (offset − o_k − n_u·o_u − n_v·o_v)/(d_k + n_u·d_u + n_v·d_v): four products and a quotient.
//!
//! The offset is that of the rounded n_u and n_v through the shape's middle, so that rounding
//! tilts the plane but doesn't move it. In fixed point the quotient's dividend must stay below
//! [`FAR`](Arithmetic::FAR): a slanted plane can be lost from 591 units on.

use bytemuck::AnyBitPattern;

use super::{Meeting, Ray, Surface, meets_plane, turned_to};
use crate::blob::stored;
use crate::math::{Arithmetic, for_each_arithmetic};

/// A plane, and the cosine that makes its normal a unit vector.
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(C)]
pub(crate) struct Projection<A: Arithmetic> {
    slopes: [A::Unit; 2],
    offset: A::Length,
    /// The unit normal's component along the dominant axis, whose sign says where the front is.
    cosine: A::Unit,
}

stored!(Projection { slopes: units, offset: length, cosine: unit });

/// Where a ray meets the plane.
pub(crate) struct Crossing<A: Arithmetic> {
    pub(crate) distance: A::Length,
    /// The point's two other coordinates.
    pub(crate) point: [A::Length; 2],
    /// How fast the ray nears the plane, along the dominant axis; positive.
    pub(crate) slope: A::Unit,
}

/// The components from the dominant one on.
#[inline(always)]
pub(crate) const fn cycled<T: Copy>(v: &[T; 3], axis: u8) -> [T; 3] {
    match axis {
        0 => [v[0], v[1], v[2]],
        1 => [v[1], v[2], v[0]],
        _ => [v[2], v[0], v[1]],
    }
}

/// The reverse of [`cycled`].
#[inline(always)]
pub(crate) const fn uncycled<T: Copy>(v: &[T; 3], axis: u8) -> [T; 3] {
    match axis {
        0 => [v[0], v[1], v[2]],
        1 => [v[2], v[0], v[1]],
        _ => [v[1], v[2], v[0]],
    }
}

/// `a − b`.
pub(crate) const fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `a·b`.
pub(crate) const fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `|x|`.
pub(crate) const fn abs(x: f64) -> f64 {
    if x < 0.0 { -x } else { x }
}

/// The axis along which a vector is longest.
pub(crate) const fn dominant(n: [f64; 3]) -> u8 {
    let n = [abs(n[0]), abs(n[1]), abs(n[2])];
    if n[0] > n[1] && n[0] > n[2] {
        0
    } else if n[1] > n[2] {
        1
    } else {
        2
    }
}

/// The largest absolute value of a point's coordinates, or `most` if that is larger.
pub(crate) const fn reach(p: [f64; 3], most: f64) -> f64 {
    let axis = dominant(p);
    let x = abs(cycled(&p, axis)[0]);
    if x > most { x } else { most }
}

for_each_arithmetic! {
    impl Projection<A> {
        /// The plane across `normal`, of any length and positive on the front, through a point.
        pub(crate) const fn new(normal: [f64; 3], through: [f64; 3]) -> Option<Self> {
            let Some(unit) = crate::math::unit_f64(normal) else { return None };
            let axis = dominant(unit);
            let n = cycled(&unit, axis);
            let p = cycled(&through, axis);
            let (Some(u), Some(v), Some(cosine)) =
                (make::unit(n[1] / n[0]), make::unit(n[2] / n[0]), make::unit(n[0]))
            else {
                return None;
            };
            let offset = p[0] + make::from_unit(u) * p[1] + make::from_unit(v) * p[2];
            Some(Self { slopes: [u, v], offset: make::sum(offset), cosine })
        }

        /// Positive where the front lies towards larger coordinates of the dominant axis.
        pub(crate) const fn facing(&self) -> <A as Arithmetic>::Unit {
            self.cosine
        }

        /// The coordinate along the dominant axis over a point of the plane.
        pub(crate) const fn over(&self, u: f64, v: f64) -> f64 {
            let n = self.tilt();
            make::from_length(self.offset) - n[0] * u - n[1] * v
        }

        /// The normal's two other components, its dominant one being 1.
        pub(crate) const fn tilt(&self) -> [f64; 2] {
            [make::from_unit(self.slopes[0]), make::from_unit(self.slopes[1])]
        }
    }
}

impl<A: Arithmetic> Projection<A> {
    #[inline(always)]
    fn slope(&self, d: &[A::Unit; 3]) -> A::Unit {
        d[0] + A::product(d[1], self.slopes[0]) + A::product(d[2], self.slopes[1])
    }

    #[inline(always)]
    pub(crate) fn crossing(&self, axis: u8, ray: &Ray<A>, limit: A::Length) -> Option<Crossing<A>> {
        let d = cycled(&ray.direction, axis);
        let speed = self.slope(&d);
        let o = cycled(&ray.origin, axis);
        let left =
            self.offset - o[0] - A::scale(o[1], self.slopes[0]) - A::scale(o[2], self.slopes[1]);
        // It is the corrected distance that counts: whether a plane lies within the limit must not
        // depend on what else was hit before, or a tree and a list would differ.
        let reach = if A::REFINE { A::FAR } else { limit };
        let (mut t, slope) = meets_plane::<A>(left, speed, reach)?;
        let at = |t: A::Length| [o[1] + A::scale(t, d[1]), o[2] + A::scale(t, d[2])];
        let mut point = at(t);
        if A::REFINE {
            // The slope is a sum of rounded products, the point is exact to a step: how far it is
            // from the plane tells by how much the distance is wrong.
            let height = o[0] + A::scale(t, d[0]);
            let left = self.offset
                - height
                - A::scale(point[0], self.slopes[0])
                - A::scale(point[1], self.slopes[1]);
            let ahead = (left > A::NO_LENGTH) == (speed > A::NO_UNIT);
            let off = if left > A::NO_LENGTH { left } else { -left };
            let step = A::ratio(off, slope);
            // Wrong by as much as the range: it is none of the ray's, and the sum might not fit.
            if step >= A::FAR {
                return None;
            }
            t = if ahead { t + step } else { t - step };
            if t <= A::NO_LENGTH || t > limit {
                return None;
            }
            point = at(t);
        }
        Some(Crossing { distance: t, point, slope })
    }

    #[inline(always)]
    pub(crate) fn surface(&self, axis: u8, ray: &Ray<A>) -> Surface<A> {
        let slope = self.slope(&cycled(&ray.direction, axis));
        let dn = A::product(slope, self.cosine);
        let u = A::product(self.cosine, self.slopes[0]);
        let v = A::product(self.cosine, self.slopes[1]);
        // The side is that of the crossing, which knows nothing of the product's rounding.
        let behind = (slope > A::NO_UNIT) == (self.cosine > A::NO_UNIT);
        turned_to(&uncycled(&[self.cosine, u, v], axis), dn, behind)
    }
}

impl<A: Arithmetic> Crossing<A> {
    pub(crate) fn meeting(&self) -> Meeting<A> {
        Meeting { distance: self.distance, detail: A::NO_LENGTH }
    }
}

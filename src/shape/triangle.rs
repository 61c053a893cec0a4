//! Triangle.
//!
//! The ray meets the triangle's plane, written along its dominant axis, and the point's two other
//! coordinates relative to the first corner go to two linear forms, the weights of the second and
//! third corner (Wald 2004): the point is inside where neither they nor the first corner's weight
//! is negative.
//!
//! In fixed point the first corner is the one opposite the longest side, wherever a needle starts.
//!
//! The weights are rounded, and so is the point; neighbours round differently. To leave no cracks
//! along shared edges, a triangle is larger than it is by what a hit may be off (see
//! [`Arithmetic::barycentric`]): two neighbours overlap by some steps of their precision.

use bytemuck::AnyBitPattern;

use super::projection::{Projection, abs, cycled, dominant, dot, minus, reach, uncycled};
use super::{MaterialId, Meeting, Ray, Shape, ShapeError, Surface};
use super::{ok_or_panic, rounded_point, some_or};
use crate::blob::stored;
use crate::math::{Arithmetic, cross_f64, for_each_arithmetic};
use crate::octree::Extent;

/// A flat triangle. From its front the corners go counter-clockwise.
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(C)]
pub struct Triangle<A: Arithmetic> {
    plane: Projection<A>,
    /// The first corner, without the plane's dominant axis.
    corner: [A::Length; 2],
    form: A::Barycentric,
    material: MaterialId,
    /// The dominant axis; and, times 4, which of the corners is the first.
    axis_and_turn: u8,
}

stored!(Triangle { plane: nested, corner: lengths, form: nested, material: whole, axis_and_turn: whole }
    if *axis_and_turn < 12 && *axis_and_turn & 3 < 3);

/// The corner opposite the longest side. With it as the first no form is steeper than a short side
/// needs, and rounded coefficients move no edge by more than the precision of points.
const fn opposite_longest(corners: &[[f64; 3]; 3]) -> u8 {
    let [a, b, c] = *corners;
    let (ab, bc, ca) = (minus(b, a), minus(c, b), minus(a, c));
    let (ab, bc, ca) = (dot(ab, ab), dot(bc, bc), dot(ca, ca));
    if bc >= ca && bc >= ab {
        0
    } else if ca >= ab {
        1
    } else {
        2
    }
}

for_each_arithmetic! {
    impl Triangle<A> {
        /// A triangle, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(corners: [[f64; 3]; 3], material: u16) -> Self {
            ok_or_panic!(Self::try_new(corners, material))
        }

        /// A triangle.
        ///
        /// # Errors
        /// Corners out of range, or on a line: in fixed point, a triangle flatter than 2⁻¹⁴ of its
        /// size.
        pub const fn try_new(corners: [[f64; 3]; 3], material: u16) -> Result<Self, ShapeError> {
            if material >= MaterialId::LIMIT {
                return Err(ShapeError::Material);
            }
            // Neighbours share the rounded corners.
            let corners = [
                rounded_point!(make, corners[0]),
                rounded_point!(make, corners[1]),
                rounded_point!(make, corners[2]),
            ];
            let turn = if <A as Arithmetic>::REFINE { opposite_longest(&corners) } else { 0 };
            let [a, b, c] = cycled(&corners, turn);
            let (ab, ac) = (minus(b, a), minus(c, a));
            let normal = cross_f64(ab, ac);
            let third = 1.0 / 3.0;
            let middle = [
                a[0] + (ab[0] + ac[0]) * third,
                a[1] + (ab[1] + ac[1]) * third,
                a[2] + (ab[2] + ac[2]) * third,
            ];
            let axis = dominant(normal);
            let plane = some_or!(Projection::<A>::new(normal, middle), Degenerate);
            let (b2, c2) = (cycled(&ab, axis), cycled(&ac, axis));
            let most = reach(a, reach(b, reach(c, 0.0)));
            let form = make::barycentric([b2[1], b2[2]], [c2[1], c2[2]], most);
            let first = cycled(&a, axis);
            Ok(Self {
                plane,
                corner: [
                    some_or!(make::length(first[1]), Coordinate),
                    some_or!(make::length(first[2]), Coordinate),
                ],
                form: some_or!(form, Degenerate),
                material: MaterialId::new(material),
                axis_and_turn: axis | turn << 2,
            })
        }

        /// A box around it. The corners are not stored but computed from the two forms: the box is
        /// larger by what they may be wrong. Who has the corners asks
        /// [`extent_of`](Self::extent_of).
        pub const fn extent(&self, log2_step: i8) -> Extent {
            let (b, c, error) = make::corners(&self.form);
            let u = make::from_length(self.corner[0]);
            let v = make::from_length(self.corner[1]);
            let all = [[u, v], [u + b[0], v + b[1]], [u + c[0], v + c[1]]];
            let tilt = self.plane.tilt();
            let errors = [error * (abs(tilt[0]) + abs(tilt[1])), error, error];
            let (mut min, mut max) = ([f64::MAX; 3], [-f64::MAX; 3]);
            let mut i = 0;
            while i < 3 {
                let p = [self.plane.over(all[i][0], all[i][1]), all[i][0], all[i][1]];
                let mut j = 0;
                while j < 3 {
                    let (low, high) = (p[j] - errors[j], p[j] + errors[j]);
                    min[j] = if low < min[j] { low } else { min[j] };
                    max[j] = if high > max[j] { high } else { max[j] };
                    j += 1;
                }
                i += 1;
            }
            let (min, max) = (uncycled(&min, self.axis()), uncycled(&max, self.axis()));
            Extent::Box {
                min: [
                    make::grid(min[0], log2_step),
                    make::grid(min[1], log2_step),
                    make::grid(min[2], log2_step),
                ],
                max: [
                    make::grid(max[0], log2_step),
                    make::grid(max[1], log2_step),
                    make::grid(max[2], log2_step),
                ],
            }
        }

        /// Where the triangle of these corners lies, exactly.
        pub const fn extent_of(corners: [[f64; 3]; 3], log2_step: i8) -> Extent {
            let mut on_grid = [[0; 3]; 3];
            let mut i = 0;
            while i < 9 {
                on_grid[i / 3][i % 3] = make::grid(corners[i / 3][i % 3], log2_step);
                i += 1;
            }
            Extent::Triangle { corners: on_grid }
        }
    }
}

impl<A: Arithmetic> Triangle<A> {
    #[inline(always)]
    const fn axis(&self) -> u8 {
        self.axis_and_turn & 3
    }

    /// The weights of the second and third corner at a point of the triangle.
    #[inline(always)]
    pub(crate) fn weights(&self, p: &[A::Length; 3]) -> (A::Weight, A::Weight) {
        let p = cycled(p, self.axis());
        let (b, c) = A::weights(&self.form, p[1] - self.corner[0], p[2] - self.corner[1]);
        // Back to the order that the corners were given in.
        let a = A::FULL - b - c;
        match self.axis_and_turn >> 2 {
            0 => (b, c),
            1 => (a, b),
            _ => (c, a),
        }
    }
}

impl<A: Arithmetic> Triangle<A> {
    pub(crate) const fn material_id(&self) -> MaterialId {
        self.material
    }
}

impl<A: Arithmetic> Shape<A> for Triangle<A> {
    const FLAT: bool = true;

    #[inline(always)]
    fn nearest(
        &self,
        ray: &Ray<A>,
        _: &A::Coarse,
        _: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        let hit = self.plane.crossing(self.axis(), ray, limit)?;
        let (x, y) = (hit.point[0] - self.corner[0], hit.point[1] - self.corner[1]);
        A::barycentric(&self.form, x, y, hit.distance, hit.slope)?;
        Some(hit.meeting())
    }

    #[inline(always)]
    fn surface(&self, ray: &Ray<A>, _: &Meeting<A>, _: &mut [A::Length; 3]) -> Surface<A> {
        self.plane.surface(self.axis(), ray)
    }

    #[inline(always)]
    fn material(&self) -> MaterialId {
        self.material
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;
    use crate::shape::testing::{distance, ray};

    #[test]
    fn forty_bytes() {
        assert!(size_of::<Triangle<Fixed>>() <= 40);
        assert_eq!(size_of::<Triangle<f32>>(), 56);
    }

    #[test]
    fn front_back_and_outside() {
        let t = Triangle::<f64>::new([[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [0.0, 2.0, 1.0]], 7);
        let up = [0.0, 0.0, 1.0];
        assert_eq!(distance(&t, &ray([0.5, 0.5, 0.0], up)), Some(1.0));
        assert_eq!(distance(&t, &ray([1.5, 1.5, 0.0], up)), None);
        assert_eq!(distance(&t, &ray([-0.1, 0.5, 0.0], up)), None);
        assert_eq!(distance(&t, &ray([0.5, 0.5, 2.0], up)), None);
        let r = ray([0.5, 0.5, 0.0], up);
        let s = t.surface(&r, &t.nearest(&r, &(), false, 9.0).unwrap(), &mut [0.5, 0.5, 1.0]);
        assert!(s.behind && s.normal == [0.0, 0.0, -1.0] && s.cosine == 1.0);
        assert_eq!(t.material().index(), 7);
    }

    #[test]
    fn slivers_and_points_are_refused() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]];
        assert_eq!(Triangle::<Fixed>::try_new(corners, 0).unwrap_err(), ShapeError::Degenerate);
        assert_eq!(Triangle::<f64>::try_new(corners, 0).unwrap_err(), ShapeError::Degenerate);
        let nan = [[0.0, 0.0, f64::NAN], [1.0, 0.0, 1.0], [2.0, 2.0, 2.0]];
        assert_eq!(Triangle::<f32>::try_new(nan, 0).unwrap_err(), ShapeError::Coordinate);
    }
}

//! Smooth triangle: a flat one that shades as if it were curved (Phong 1975).
//!
//! The normals of the three corners are blended by the weights of the point. Where the blend faces
//! away from the ray, as happens near a mesh's silhouette, the flat normal takes its place: a
//! cosine is never negative, and a mirror ray never starts into the surface.

use bytemuck::AnyBitPattern;

use super::projection::dot;
use super::{MaterialId, Meeting, Ray, Shape, ShapeError, Surface, Triangle};
use super::{ok_or_panic, some_or};
use crate::blob::stored;
use crate::math::{Arithmetic, cross_f64, for_each_arithmetic, neg, unit_f64};
use crate::octree::Extent;

/// A triangle with a normal at each corner.
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(C)]
pub struct SmoothTriangle<A: Arithmetic> {
    flat: Triangle<A>,
    normals: [A::Normal; 3],
}

stored!(SmoothTriangle { flat: nested, normals: normals });

for_each_arithmetic! {
    impl SmoothTriangle<A> {
        /// A smooth triangle, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(corners: [[f64; 3]; 3], normals: [[f64; 3]; 3], material: u16) -> Self {
            ok_or_panic!(Self::try_new(corners, normals, material))
        }

        /// A smooth triangle. Its front is that of the corners, counter-clockwise; normals that
        /// together point backwards are turned.
        ///
        /// # Errors
        /// As for [`Triangle`]; a null normal.
        pub const fn try_new(
            corners: [[f64; 3]; 3],
            normals: [[f64; 3]; 3],
            material: u16,
        ) -> Result<Self, ShapeError> {
            let flat = match Triangle::<A>::try_new(corners, material) {
                Ok(flat) => flat,
                Err(error) => return Err(error),
            };
            let a = some_or!(unit_f64(normals[0]), Direction);
            let b = some_or!(unit_f64(normals[1]), Direction);
            let c = some_or!(unit_f64(normals[2]), Direction);
            let sum = [a[0] + b[0] + c[0], a[1] + b[1] + c[1], a[2] + b[2] + c[2]];
            let front = cross_f64(
                super::projection::minus(corners[1], corners[0]),
                super::projection::minus(corners[2], corners[0]),
            );
            let s = if dot(sum, front) < 0.0 { -1.0 } else { 1.0 };
            Ok(Self {
                flat,
                normals: [
                    make::normal([s * a[0], s * a[1], s * a[2]]),
                    make::normal([s * b[0], s * b[1], s * b[2]]),
                    make::normal([s * c[0], s * c[1], s * c[2]]),
                ],
            })
        }

        /// See [`Triangle`]; [`Triangle`]'s `extent_of` serves both.
        pub const fn extent(&self, log2_step: i8) -> Extent {
            self.flat.extent(log2_step)
        }
    }
}

impl<A: Arithmetic> SmoothTriangle<A> {
    pub(crate) const fn material_id(&self) -> MaterialId {
        self.flat.material_id()
    }

    /// The weights of the second and third corner at a point of the triangle.
    #[inline(always)]
    pub(crate) fn weights(&self, p: &[A::Length; 3]) -> (A::Weight, A::Weight) {
        self.flat.weights(p)
    }
}

impl<A: Arithmetic> Shape<A> for SmoothTriangle<A> {
    const FLAT: bool = true;

    #[inline(always)]
    fn nearest(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        inwards: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        self.flat.nearest(ray, coarse, inwards, limit)
    }

    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>, p: &mut [A::Length; 3]) -> Surface<A> {
        let flat = self.flat.surface(ray, meeting, p);
        let (b, c) = self.flat.weights(p);
        let [first, second, third] = &self.normals;
        let corners = [A::unpack(first), A::unpack(second), A::unpack(third)];
        let blend = A::blend(&corners, b, c);
        let normal = if flat.behind { neg(&blend) } else { blend };
        let cosine = -A::dot(&ray.direction, &normal);
        if cosine > A::NO_UNIT { Surface { normal, cosine, smooth: true, ..flat } } else { flat }
    }

    #[inline(always)]
    fn material(&self) -> MaterialId {
        self.flat.material()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;
    use crate::shape::testing::ray;

    const CORNERS: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [0.0, 2.0, 1.0]];

    #[test]
    fn sixty_bytes() {
        assert_eq!(size_of::<SmoothTriangle<Fixed>>(), 60);
    }

    #[test]
    fn normals_are_blended_and_turned() {
        let n = [[-0.6, 0.0, -0.8], [0.6, 0.0, -0.8], [0.0, 0.0, -1.0]];
        let t = SmoothTriangle::<f64>::new(CORNERS, n, 0);
        let r = ray([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        let m = t.nearest(&r, &(), false, 9.0).unwrap();
        // Halfway between the first two corners; the corners' order makes this the back.
        let s = t.surface(&r, &m, &mut [1.0, 0.0, 1.0]);
        assert!(s.behind && s.normal == [0.0, 0.0, -1.0] && s.cosine == 1.0);
        let s = t.surface(&r, &m, &mut [2.0, 0.0, 1.0]);
        assert!((s.normal[0] - 0.6).abs() < 1e-12 && (s.cosine - 0.8).abs() < 1e-12);
    }

    #[test]
    fn a_normal_that_faces_away_gives_way() {
        let n = [[0.8, 0.0, 0.6]; 3];
        let t = SmoothTriangle::<f64>::new(CORNERS, n, 0);
        let r = ray([0.0, 0.5, 1.4], [0.8, 0.0, -0.6]);
        let m = t.nearest(&r, &(), false, 9.0).unwrap();
        let s = t.surface(&r, &m, &mut [0.5, 0.5, 1.0]);
        assert_eq!(s.normal, [0.0, 0.0, 1.0]);
        assert!((s.cosine - 0.6).abs() < 1e-12);
    }
}

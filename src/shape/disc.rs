//! Disc.
//!
//! The ray meets the disc's plane as it does any plane (see [`Plane`](super::Plane)); the point
//! is on the disc if r² − |c − t·d|² is positive, c being the centre relative to the ray's origin:
//! the expression that a sphere asks for where the ray comes nearest to it.

use bytemuck::AnyBitPattern;

use super::{MaterialId, Meeting, Ray, Shape, ShapeError, Surface};
use super::{meets_plane, ok_or_panic, point, some_or, turned, unit_vector};
use crate::blob::stored;
use crate::math::{Arithmetic, for_each_arithmetic, sqrt_f64, sub};
use crate::octree::Extent;

/// A flat disc. Its front is where the normal points.
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(C)]
pub struct Disc<A: Arithmetic> {
    center: [A::Length; 3],
    normal: [A::Unit; 3],
    radius: A::Radius,
    material: MaterialId,
}

stored!(Disc { center: lengths, normal: units, radius: nested, material: whole });

for_each_arithmetic! {
    impl Disc<A> {
        /// A disc, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(center: [f64; 3], normal: [f64; 3], radius: f64, material: u16) -> Self {
            ok_or_panic!(Self::try_new(center, normal, radius, material))
        }

        /// A disc around `center`, across `normal` (of any length).
        ///
        /// # Errors
        /// Centre or radius out of range; a null normal.
        pub const fn try_new(
            center: [f64; 3],
            normal: [f64; 3],
            radius: f64,
            material: u16,
        ) -> Result<Self, ShapeError> {
            if material >= MaterialId::LIMIT {
                return Err(ShapeError::Material);
            }
            Ok(Self {
                center: point!(make, center),
                normal: unit_vector!(make, normal),
                radius: some_or!(make::radius(radius), Size),
                material: MaterialId::new(material),
            })
        }

        /// The smallest box around it: along an axis it reaches r·√(1 − n²).
        pub const fn extent(&self, log2_step: i8) -> Extent {
            let r = make::from_radius(&self.radius);
            let (mut min, mut max) = ([0; 3], [0; 3]);
            let mut i = 0;
            while i < 3 {
                let c = make::from_length(self.center[i]);
                let n = make::from_unit(self.normal[i]);
                let reach = r * sqrt_f64(1.0 - n * n);
                min[i] = make::grid(c - reach, log2_step);
                max[i] = make::grid(c + reach, log2_step);
                i += 1;
            }
            Extent::Box { min, max }
        }
    }
}

impl<A: Arithmetic> Disc<A> {
    pub(crate) const fn material_id(&self) -> MaterialId {
        self.material
    }
}

impl<A: Arithmetic> Shape<A> for Disc<A> {
    const FLAT: bool = true;

    #[inline(always)]
    fn nearest(
        &self,
        ray: &Ray<A>,
        _: &A::Coarse,
        _: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        let c = sub(&self.center, &ray.origin);
        let slope = A::dot(&ray.direction, &self.normal);
        let (distance, _) = meets_plane::<A>(A::project(&c, &self.normal), slope, limit)?;
        A::leg2(&self.radius, &c, distance, &ray.direction)?;
        Some(Meeting { distance, detail: A::NO_LENGTH })
    }

    #[inline(always)]
    fn surface(&self, ray: &Ray<A>, _: &Meeting<A>, _: &mut [A::Length; 3]) -> Surface<A> {
        turned(&self.normal, A::dot(&ray.direction, &self.normal))
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
    fn thirty_six_bytes() {
        assert_eq!(size_of::<Disc<Fixed>>(), 36);
    }

    #[test]
    fn rim_and_sides() {
        let disc = Disc::<f64>::new([0.0, 0.0, 2.0], [0.0, 0.0, -1.0], 1.0, 0);
        let at = |o, d| distance(&disc, &ray(o, d));
        assert_eq!(at([0.9, 0.0, 0.0], [0.0, 0.0, 1.0]), Some(2.0));
        assert_eq!(at([0.8, 0.8, 0.0], [0.0, 0.0, 1.0]), None);
        assert_eq!(at([0.0, 0.0, 0.0], [0.0, 0.0, -1.0]), None);
        assert_eq!(at([0.0, 0.0, 3.0], [0.0, 0.0, -1.0]), Some(1.0));
        let seen = ray([0.0, 0.0, 3.0], [0.0, 0.0, -1.0]);
        let m = disc.nearest(&seen, &(), false, 9.0).unwrap();
        let s = disc.surface(&seen, &m, &mut [0.0, 0.0, 2.0]);
        assert!(s.behind && s.normal == [0.0, 0.0, 1.0] && s.cosine == 1.0);
    }
}

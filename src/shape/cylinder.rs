//! Cylinder: the lateral surface between two circles, and the caps if asked for.
//!
//! Without their components along the axis a, the ray's direction and the way c to the base make
//! a ray and a circle in the plane across it: dp = d − (d·a)a, cp = c − (c·a)a. With m the unit
//! vector along dp and q its length, the sphere's derivation holds: t₂ = cp·m, the half chord
//! h = √(r² − |cp − t₂·m|²), and the roots are (t₂ ∓ h)/q. Taking components out of vectors, not
//! squares out of squares, keeps thin and far cylinders exact.
//!
//! With caps it is what the endless cylinder and the slab between two planes have in common.

use bytemuck::AnyBitPattern;

use super::chord::{Chord, Convex, signed_ratio};
use super::{MaterialId, Meeting, Open, Ray, Shape, ShapeError, Surface};
use super::{ok_or_panic, point, some_or, turned_to, unit_vector};
use crate::blob::stored;
use crate::math::{Arithmetic, for_each_arithmetic, sqrt_f64, sub};
use crate::octree::Extent;

/// A cylinder, without caps unless [made with them](Self::with_caps).
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(C)]
pub struct Cylinder<A: Arithmetic> {
    base: [A::Length; 3],
    axis: [A::Unit; 3],
    length: A::Length,
    radius: A::Radius,
    material: MaterialId,
    /// 1 with caps, else 0: a type that any bits may be.
    capped: u8,
}

stored!(Cylinder { base: lengths, axis: units, length: length, radius: nested, material: whole, capped: whole } if *capped <= 1);

for_each_arithmetic! {
    impl Cylinder<A> {
        /// A cylinder, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(base: [f64; 3], apex: [f64; 3], radius: f64, material: u16) -> Self {
            ok_or_panic!(Self::try_new(base, apex, radius, material))
        }

        /// A cylinder around the line from `base` to `apex`. A negative radius shows the inside
        /// alone.
        ///
        /// # Errors
        /// Coordinates, radius or length out of range; both points the same.
        pub const fn try_new(
            base: [f64; 3],
            apex: [f64; 3],
            radius: f64,
            material: u16,
        ) -> Result<Self, ShapeError> {
            if material >= MaterialId::LIMIT {
                return Err(ShapeError::Material);
            }
            let id = MaterialId::new(material);
            let _ = point!(make, apex);
            let way = super::projection::minus(apex, base);
            let length = sqrt_f64(super::projection::dot(way, way));
            Ok(Self {
                base: point!(make, base),
                axis: unit_vector!(make, way),
                length: some_or!(make::length(length), Size),
                radius: some_or!(make::radius(if radius < 0.0 { -radius } else { radius }), Size),
                material: if radius < 0.0 { id.showing_inside() } else { id },
                capped: 0,
            })
        }

        /// The box around both circles, in plain numbers.
        pub(crate) const fn reach(&self) -> ([f64; 3], [f64; 3]) {
            let r = make::from_radius(&self.radius);
            let (mut min, mut max) = ([0.0; 3], [0.0; 3]);
            let mut i = 0;
            while i < 3 {
                let b = make::from_length(self.base[i]);
                let n = make::from_unit(self.axis[i]);
                let a = b + make::from_length(self.length) * n;
                let reach = r * sqrt_f64(1.0 - n * n);
                let (low, high) = if a < b { (a, b) } else { (b, a) };
                (min[i], max[i]) = (low - reach, high + reach);
                i += 1;
            }
            (min, max)
        }

        /// Its two circles.
        pub const fn extent(&self, log2_step: i8) -> Extent {
            let r = make::grid(make::from_radius(&self.radius), log2_step);
            let (mut base, mut apex) = ([0; 3], [0; 3]);
            let mut i = 0;
            while i < 3 {
                let b = make::from_length(self.base[i]);
                base[i] = make::grid(b, log2_step);
                let a = b + make::from_length(self.length) * make::from_unit(self.axis[i]);
                apex[i] = make::grid(a, log2_step);
                i += 1;
            }
            Extent::Round { ends: [base, apex], radii: [r, r], hollow: self.capped == 0 }
        }
    }
}

impl<A: Arithmetic> Cylinder<A> {
    pub(crate) const fn material_id(&self) -> MaterialId {
        self.material
    }
}

impl<A: Arithmetic> Cylinder<A> {
    /// The same, closed by a disc at each end.
    #[must_use]
    pub const fn with_caps(mut self) -> Self {
        self.capped = 1;
        self
    }

    pub(crate) const fn has_caps(&self) -> bool {
        self.capped != 0
    }

    /// The direction's part across the axis as a unit vector and its length, and the part along it.
    #[inline(always)]
    fn split(&self, direction: &[A::Unit; 3]) -> ([A::Unit; 3], A::Unit, A::Unit) {
        let da = A::dot(direction, &self.axis);
        let across = |d: A::Unit, a: A::Unit| d - A::product(da, a);
        let [x, y, z] = *direction;
        let [ax, ay, az] = self.axis;
        let dp = [across(x, ax), across(y, ay), across(z, az)];
        let (m, _) = A::renormalize(&dp);
        // Rather than the length as such: what m is short of a unit vector then cancels.
        (m, A::dot(&dp, &m), da)
    }

    #[inline(never)]
    fn nearest_with_caps(
        &self,
        ray: Ray<A>,
        coarse: A::Coarse,
        inwards: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        self.chord(&ray, &coarse)?.nearest(inwards || self.material.inside_only(), limit)
    }
}

impl<A: Arithmetic> Convex<A> for Cylinder<A> {
    fn chord(&self, ray: &Ray<A>, _: &A::Coarse) -> Option<Chord<A>> {
        let (m, q, da) = self.split(&ray.direction);
        let c = sub(&self.base, &ray.origin);
        let ca = A::project(&c, &self.axis);
        let across = A::along(&c, -ca, &self.axis);
        let slab = Chord::<A>::slab(ca, ca + self.length, da, A::FAR);
        if q <= A::NO_UNIT {
            // A ray along the axis stays as far from it as it is.
            A::leg2(&self.radius, &across, A::NO_LENGTH, &m)?;
            return Chord::endless().and(slab);
        }
        let middle = A::project(&across, &m);
        let half = A::leg(&self.radius, A::leg2(&self.radius, &across, middle, &m)?);
        let end = |way, detail| Meeting { distance: signed_ratio::<A>(way, q), detail };
        let wall = Chord { entry: end(middle - half, -half), exit: end(middle + half, half) };
        wall.and(slab)
    }
}

/// The surface of a cap around an axis.
#[inline(always)]
pub(super) fn cap<A: Arithmetic>(axis: &[A::Unit; 3], ray: &Ray<A>, leaves: bool) -> Surface<A> {
    let da = A::dot(&ray.direction, axis);
    // Outwards is where the ray goes if it leaves, and where it comes from if not.
    let (outward, dn) =
        if leaves == (da > A::NO_UNIT) { (*axis, da) } else { (crate::math::neg(axis), -da) };
    turned_to(&outward, dn, leaves)
}

impl<A: Arithmetic> Shape<A> for Cylinder<A> {
    const FLAT: bool = false;

    #[inline(always)]
    fn nearest(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        inwards: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        if !A::may_pass(coarse, &self.base, &self.axis, &self.radius) {
            return None;
        }
        if self.capped != 0 {
            return self.nearest_with_caps(*ray, *coarse, inwards, limit);
        }
        Open(self).nearest(ray, coarse, inwards, limit)
    }

    #[inline(always)]
    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>, p: &mut [A::Length; 3]) -> Surface<A> {
        if meeting.detail >= A::FAR || -meeting.detail >= A::FAR {
            return cap(&self.axis, ray, meeting.detail > A::NO_LENGTH);
        }
        Open(self).surface(ray, meeting, p)
    }

    #[inline(always)]
    fn material(&self) -> MaterialId {
        self.material
    }
}

impl<A: Arithmetic> Shape<A> for Open<'_, Cylinder<A>> {
    const FLAT: bool = false;

    #[inline(always)]
    fn nearest(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        inwards: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        let it = self.0;
        if !A::may_pass(coarse, &it.base, &it.axis, &it.radius) {
            return None;
        }
        let (m, q, da) = it.split(&ray.direction);
        // A ray along the axis stays as far from it as it is.
        if q <= A::NO_UNIT {
            return None;
        }
        let c = sub(&it.base, &ray.origin);
        let ca = A::project(&c, &it.axis);
        let c = A::along(&c, -ca, &it.axis);
        let middle = A::project(&c, &m);
        let leg2 = A::leg2(&it.radius, &c, middle, &m)?;
        let half = A::leg(&it.radius, leg2);
        // The distance at which the ray crosses the circle, if it is ahead and between the ends.
        let at = |way: A::Length| {
            if way <= A::NO_LENGTH {
                return None;
            }
            let t = A::ratio(way, q);
            if t > limit || t <= A::NO_LENGTH {
                return None;
            }
            let height = A::scale(t, da) - ca;
            if height >= A::NO_LENGTH && height <= it.length { Some(t) } else { None }
        };
        if !inwards
            && !it.material.inside_only()
            && let Some(distance) = at(middle - half)
        {
            return Some(Meeting { distance, detail: -half });
        }
        at(middle + half).map(|distance| Meeting { distance, detail: half })
    }

    #[inline(always)]
    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>, p: &mut [A::Length; 3]) -> Surface<A> {
        let it = self.0;
        let v = sub(p, &it.base);
        let v = A::along(&v, -A::project(&v, &it.axis), &it.axis);
        let mut outward = A::over(&it.radius, &v);
        A::settle(&it.radius, &mut outward, p);
        let dn = A::dot(&ray.direction, &outward);
        turned_to(&outward, dn, meeting.detail >= A::NO_LENGTH)
    }

    #[inline(always)]
    fn material(&self) -> MaterialId {
        self.0.material
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;
    use crate::shape::testing::{distance, ray};

    #[test]
    fn forty_bytes() {
        assert_eq!(size_of::<Cylinder<Fixed>>(), 40);
    }

    #[test]
    fn through_the_side_and_the_end() {
        let c = Cylinder::<f64>::new([0.0; 3], [0.0, 0.0, 2.0], 1.0, 0);
        let (x, z) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        assert_eq!(distance(&c, &ray([-3.0, 0.0, 1.0], x)), Some(2.0));
        assert_eq!(distance(&c, &ray([-3.0, 0.0, 2.1], x)), None);
        assert_eq!(distance(&c, &ray([0.0, 0.0, 1.0], x)), Some(1.0));
        assert_eq!(distance(&c, &ray([3.0, 0.0, 1.0], x)), None);
        assert_eq!(distance(&c, &ray([0.5, 0.0, -1.0], z)), None);
        assert_eq!(c.nearest(&ray([-1.0, 0.0, 1.0], x), &(), true, 9.0).unwrap().distance, 2.0);
        // in at the open end, out through the wall
        let r = ray([0.0, 0.0, -0.75], [0.6, 0.0, 0.8]);
        let m = c.nearest(&r, &(), false, 9.0).unwrap();
        assert!((m.distance - 1.0 / 0.6).abs() < 1e-12);
        let s = c.surface(&r, &m, &mut f64::along(&r.origin, m.distance, &r.direction));
        assert!(s.behind && (s.normal[0] + 1.0).abs() < 1e-12 && (s.cosine - 0.6).abs() < 1e-12);
    }

    #[test]
    fn a_negative_radius_shows_the_inside() {
        let c = Cylinder::<f64>::new([0.0; 3], [0.0, 0.0, 2.0], -1.0, 0);
        assert_eq!(distance(&c, &ray([-3.0, 0.0, 1.0], [1.0, 0.0, 0.0])), Some(4.0));
    }
}

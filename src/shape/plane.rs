//! Infinite plane.
//!
//! n·p = offset. With h the height of the ray's origin over the plane and c = d·n, the ray meets
//! it at −h/c, if h and c have opposite signs. A plane across an axis needs no products: the
//! height is a difference of two numbers and the cosine a component of the direction.

use bytemuck::AnyBitPattern;

use super::chord::{Chord, Convex, signed_ratio};
use super::{MaterialId, Meeting, Ray, Shape, ShapeError, Surface};
use super::{meets_plane, ok_or_panic, some_or, turned};
use crate::blob::stored;
use crate::math::{Arithmetic, axis_of, for_each_arithmetic, unit_f64};
use crate::scene::uses;

/// An infinite plane. It lies outside the octree; its front is where the normal points.
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(C)]
pub struct Plane<A: Arithmetic> {
    normal: [A::Unit; 3],
    /// n·p of its points.
    offset: A::Length,
    material: MaterialId,
    /// 0 to 2: the normal is this axis, in positive direction; 3: any.
    axis: u8,
}

stored!(Plane { normal: units, offset: length, material: whole, axis: whole } if *axis < 4);

for_each_arithmetic! {
    impl Plane<A> {
        /// The plane n·p = `offset`, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(normal: [f64; 3], offset: f64, material: u16) -> Self {
            ok_or_panic!(Self::try_new(normal, offset, material))
        }

        /// The plane n·p = `offset`, n being the unit vector along `normal`.
        ///
        /// # Errors
        /// A null normal; an offset out of range.
        pub const fn try_new(
            normal: [f64; 3],
            offset: f64,
            material: u16,
        ) -> Result<Self, ShapeError> {
            if material >= MaterialId::LIMIT {
                return Err(ShapeError::Material);
            }
            let n = some_or!(unit_f64(normal), Direction);
            let mut axis = 3;
            let mut i = 0;
            while i < 3 {
                if n[i] == 1.0 {
                    axis = i as u8;
                }
                i += 1;
            }
            Ok(Self {
                normal: [
                    some_or!(make::unit(n[0]), Direction),
                    some_or!(make::unit(n[1]), Direction),
                    some_or!(make::unit(n[2]), Direction),
                ],
                offset: some_or!(make::length(offset), Coordinate),
                material: MaterialId::new(material),
                axis,
            })
        }
    }
}

impl<A: Arithmetic> Plane<A> {
    pub(crate) const fn material_id(&self) -> MaterialId {
        self.material
    }

    /// Which bit of a scene's uses stands for such a plane.
    pub(crate) const fn uses(&self) -> u64 {
        match self.axis {
            0 => uses::PLANES_ACROSS_X,
            1 => uses::PLANES_ACROSS_Y,
            2 => uses::PLANES_ACROSS_Z,
            _ => uses::SLOPING_PLANES,
        }
    }

    /// The axis, where all planes that there may be have one.
    #[inline(always)]
    fn axis<const USES: u64>(&self) -> u8 {
        let all = uses::PLANES_ACROSS_X | uses::PLANES_ACROSS_Y | uses::PLANES_ACROSS_Z;
        match USES & (all | uses::SLOPING_PLANES) {
            uses::PLANES_ACROSS_X => 0,
            uses::PLANES_ACROSS_Y => 1,
            uses::PLANES_ACROSS_Z => 2,
            _ => self.axis,
        }
    }

    /// See [`Shape::nearest`].
    #[inline(always)]
    pub(crate) fn meet<const USES: u64>(
        &self,
        ray: &Ray<A>,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        let axis = self.axis::<USES>();
        let (height, slope) = if axis < 3 {
            (axis_of(&ray.origin, axis), axis_of(&ray.direction, axis))
        } else {
            (A::project(&ray.origin, &self.normal), A::dot(&ray.direction, &self.normal))
        };
        let (distance, _) = meets_plane::<A>(height - self.offset, -slope, limit)?;
        Some(Meeting { distance, detail: A::NO_LENGTH })
    }

    /// See [`Shape::surface`].
    #[inline(always)]
    pub(crate) fn surface_seen<const USES: u64>(&self, ray: &Ray<A>) -> Surface<A> {
        let axis = self.axis::<USES>();
        if axis >= 3 {
            return turned(&self.normal, A::dot(&ray.direction, &self.normal));
        }
        let mut normal = [A::NO_UNIT; 3];
        for i in 0..3 {
            if i == usize::from(axis) {
                normal[i] = A::ONE_UNIT;
            }
        }
        turned(&normal, axis_of(&ray.direction, axis))
    }
}

impl<A: Arithmetic> Plane<A> {
    /// The mirror image of a ray that meets it at `p`, `t` away, and where rays start that go back:
    /// what [`Arithmetic::reflect`] and [`Arithmetic::leave`] give, of which nothing but a sign is left
    /// where the plane lies across an axis.
    #[inline(always)]
    pub(crate) fn back<const USES: u64>(
        &self,
        ray: &Ray<A>,
        surface: &Surface<A>,
        p: &[A::Length; 3],
        t: A::Length,
    ) -> ([A::Unit; 3], [A::Length; 3]) {
        let axis = self.axis::<USES>();
        if axis >= 3 {
            return (
                A::reflect(&ray.direction, &surface.normal, -surface.cosine),
                A::leave(p, &surface.geometric, t),
            );
        }
        let (mut mirror, mut start) = (ray.direction, *p);
        let step = A::clearance(p, t);
        let step = if surface.behind { -step } else { step };
        for i in 0..3 {
            if i == usize::from(axis) {
                mirror[i] = -mirror[i];
                start[i] = start[i] + step;
            }
        }
        (mirror, start)
    }
}

/// All that lies behind it.
impl<A: Arithmetic> Convex<A> for Plane<A> {
    fn chord(&self, ray: &Ray<A>, _: &A::Coarse) -> Option<Chord<A>> {
        let height = A::project(&ray.origin, &self.normal) - self.offset;
        let slope = A::dot(&ray.direction, &self.normal);
        let mut chord = Chord::endless();
        if slope > A::NO_UNIT {
            chord.exit.distance = signed_ratio::<A>(-height, slope);
        } else if slope < A::NO_UNIT {
            chord.entry.distance = signed_ratio::<A>(height, -slope);
        } else if height > A::NO_LENGTH {
            return None;
        }
        Some(chord)
    }
}

impl<A: Arithmetic> Shape<A> for Plane<A> {
    const FLAT: bool = true;

    #[inline(always)]
    fn nearest(
        &self,
        ray: &Ray<A>,
        _: &A::Coarse,
        _: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        self.meet::<{ uses::ALL }>(ray, limit)
    }

    #[inline(always)]
    fn surface(&self, ray: &Ray<A>, _: &Meeting<A>, _: &mut [A::Length; 3]) -> Surface<A> {
        self.surface_seen::<{ uses::ALL }>(ray)
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
    use crate::shape::Leaving;

    #[test]
    fn floor_and_slope() {
        let ray = |o, d| Ray::<f64> { origin: o, direction: d, leaving: Leaving::NOTHING };
        let floor = Plane::<f64>::new([0.0, 2.0, 0.0], -1.0, 0);
        let at = |p: &Plane<f64>, o, d| p.nearest(&ray(o, d), &(), false, 1e9).map(|m| m.distance);
        assert_eq!(at(&floor, [3.0, 1.0, 0.0], [0.0, -1.0, 0.0]), Some(2.0));
        assert_eq!(at(&floor, [3.0, 1.0, 0.0], [0.0, 1.0, 0.0]), None);
        assert_eq!(at(&floor, [3.0, -3.0, 0.0], [0.0, 1.0, 0.0]), Some(2.0));
        let slope = Plane::<f64>::new([0.6, 0.8, 0.0], 1.0, 0);
        assert!((at(&slope, [0.0; 3], [0.6, 0.8, 0.0]).unwrap() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_horizon_is_a_miss() {
        let floor = Plane::<Fixed>::new([0.0, 1.0, 0.0], 0.0, 0);
        let unit = |x: f64| fixed::FixedI32::from_num(x);
        let num = |x: f64| fixed::types::I16F16::from_num(x);
        let ray = Ray::<Fixed> {
            origin: [num(0.0), num(2.0), num(0.0)],
            direction: [unit(0.0), unit(-0.00001), unit(1.0)],
            leaving: Leaving::NOTHING,
        };
        let coarse = Fixed::coarse(&ray.origin, &ray.direction);
        let hit = floor.nearest(&ray, &coarse, false, Fixed::FAR);
        assert!(hit.is_none_or(|m| m.distance >= Fixed::FAR));
    }
}

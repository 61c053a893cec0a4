//! Infinite plane.
//!
//! n·p = offset. With h the height of the ray's origin over the plane and c = d·n, the ray meets
//! it at −h/c, if h and c have opposite signs. A plane across an axis needs no products: the
//! height is a difference of two numbers and the cosine a component of the direction.
//!
//! **The horizon.** A plane has no end, but positions have. A ray that nears a plane meets it, however
//! far away: beyond the arithmetic's range at [`HORIZON`](Arithmetic::HORIZON), behind every bounded
//! shape, at a point that is put back on the plane. Patterns alone are asked for where it would be. Shadow
//! rays ask for no distance but on which side of the plane the light is.

use bytemuck::AnyBitPattern;

use super::chord::{Chord, Convex, signed_ratio};
use super::{MaterialId, Meeting, Ray, Shape, ShapeError, Surface};
use super::{ok_or_panic, some_or, turned};
use crate::blob::stored;
use crate::math::{Arithmetic, axis_of, for_each_arithmetic, unit_f64};
use crate::scene::uses::{self, has};

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

    /// How far away the plane is from where the ray starts, and how fast the ray nears it; the ray meets
    /// it if both are positive.
    #[inline(always)]
    fn ahead<const USES: u64>(&self, ray: &Ray<A>) -> (A::Length, A::Unit) {
        let axis = self.axis::<USES>();
        let (height, slope) = if axis < 3 {
            (axis_of(&ray.origin, axis), axis_of(&ray.direction, axis))
        } else {
            (A::project(&ray.origin, &self.normal), A::dot(&ray.direction, &self.normal))
        };
        let left = height - self.offset;
        if left > A::NO_LENGTH { (left, -slope) } else { (-left, slope) }
    }

    /// See [`Shape::nearest`]. At the horizon the detail tells planes apart: the less, the nearer.
    #[inline(always)]
    pub(crate) fn meet<const USES: u64>(
        &self,
        ray: &Ray<A>,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        let (left, slope) = self.ahead::<USES>(ray);
        if slope <= A::NO_UNIT {
            return None;
        }
        let distance = A::endless_ratio(left, slope);
        if distance <= A::NO_LENGTH || distance > limit {
            return None;
        }
        let mut detail = A::NO_LENGTH;
        if A::REFINE && distance >= A::HORIZON {
            // A light may be farther away than that, and yet on this side.
            if limit > A::FAR && left >= A::scale(limit, slope) {
                return None;
            }
            if has(USES, uses::SEVERAL_PLANES) {
                detail = A::beyond_horizon(left, slope);
            }
        }
        Some(Meeting { distance, detail })
    }

    /// Whether it lies across the ray nearer than `limit`, or anywhere where that is
    /// [`FAR`](Arithmetic::FAR).
    #[inline(always)]
    pub(crate) fn blocks<const USES: u64>(&self, ray: &Ray<A>, limit: A::Length) -> bool {
        let (left, slope) = self.ahead::<USES>(ray);
        if left <= A::NO_LENGTH || slope <= A::NO_UNIT {
            return false;
        }
        left < A::scale(limit, slope) || has(USES, uses::DIRECTIONAL_LIGHTS) && limit == A::FAR
    }

    /// Puts a point back on it where a ray met it `t` away; and the place on it where patterns lie, which is
    /// the same but beyond the horizon. Floats leave points alone.
    #[inline(always)]
    pub(crate) fn settle<const USES: u64>(
        &self,
        ray: &Ray<A>,
        t: A::Length,
        p: &mut [A::Length; 3],
    ) -> [A::Length; 3] {
        if !A::REFINE {
            return *p;
        }
        let axis = self.axis::<USES>();
        for i in 0..3 {
            if i == usize::from(axis) {
                p[i] = self.offset;
            }
        }
        if t < A::HORIZON {
            return *p;
        }
        let (settled, local) = self.settle_far(*ray, *p);
        *p = settled;
        local
    }

    /// The same beyond the horizon: both places. The point keeps within positions' range. By value: what
    /// a reference is taken of can't stay in registers.
    #[inline(never)]
    fn settle_far(&self, ray: Ray<A>, mut p: [A::Length; 3]) -> ([A::Length; 3], [A::Length; 3]) {
        for x in &mut p {
            *x = if *x > A::FAR { A::FAR } else { *x };
            *x = if *x < -A::FAR { -A::FAR } else { *x };
        }
        if self.axis >= 3 {
            let height = A::project(&p, &self.normal) - self.offset;
            p = A::along(&p, -height, &self.normal);
        }
        let (left, slope) = self.ahead::<{ uses::ALL }>(&ray);
        let mut local = A::endless_point(&ray.origin, left, slope, &ray.direction);
        for i in 0..3 {
            if i == usize::from(self.axis) {
                local[i] = self.offset;
            }
        }
        (p, local)
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
    /// The mirror image of a point.
    pub(crate) fn image(&self, p: &[A::Length; 3]) -> [A::Length; 3] {
        let height = A::project(p, &self.normal) - self.offset;
        A::along(p, -(height + height), &self.normal)
    }

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

    /// From one up and two right of the origin, in steps of 2⁻¹⁷.
    fn far_ray(direction: [i32; 3]) -> Ray<Fixed> {
        let origin = [2.0, 1.0, 0.0].map(fixed::types::I16F16::from_num::<f64>);
        let direction = direction.map(fixed::FixedI32::from_bits);
        Ray { origin, direction, leaving: Leaving::NOTHING }
    }

    #[test]
    fn it_ends_where_the_ray_is_level() {
        const ONE: i32 = 1 << 17;
        // The second falls by a thousandth, 131 steps.
        let floor = Plane::<Fixed>::new([0.0, 1.0, 0.0], -1.0, 0);
        let slope = Plane::<Fixed>::new([0.0, 1.0, -0.001], -1.0, 0);
        for (plane, level) in [(&floor, 0), (&slope, 131)] {
            let meet = |up| plane.meet::<{ uses::ALL }>(&far_ray([0, up, ONE]), Fixed::FAR);
            assert!([1, 2, 100].iter().all(|off| meet(level - off).is_some()));
            assert!([1, 2, 100].iter().all(|off| meet(level + off).is_none()));
        }
    }

    #[test]
    fn beyond_the_range_points_lie_on_it() {
        const ONE: i32 = 1 << 17;
        // Three units of height at 2⁻¹⁴: 49,152 units away.
        let floor = Plane::<Fixed>::new([0.0, 1.0, 0.0], -2.0, 0);
        let ray = far_ray([0, -8, ONE]);
        let t = floor.meet::<{ uses::ALL }>(&ray, Fixed::FAR).unwrap().distance;
        assert!(t == Fixed::HORIZON && t < Fixed::FAR);
        let mut p = Fixed::along(&ray.origin, t, &ray.direction);
        let local = floor.settle::<{ uses::ALL }>(&ray, t, &mut p).map(|x| x.to_num::<f64>());
        assert_eq!([local[0], local[1]], [2.0, -2.0]);
        assert!((local[2] - (49152.0 - 65536.0)).abs() < 0.5, "{}", local[2]);
        let [x, y, z] = p.map(|x| x.to_num::<f64>());
        assert!(x == 2.0 && y == -2.0 && z > 1023.0 && z <= 1024.0);

        let slope = Plane::<Fixed>::new([0.0, 1.0, -0.001], -2.0, 0);
        let ray = far_ray([0, 123, ONE]);
        let t = slope.meet::<{ uses::ALL }>(&ray, Fixed::FAR).unwrap().distance;
        let mut p = Fixed::along(&ray.origin, t, &ray.direction);
        slope.settle::<{ uses::ALL }>(&ray, t, &mut p);
        let [_, y, z] = p.map(|x| x.to_num::<f64>());
        assert!(t == Fixed::HORIZON && (y + 2.0 - 0.001 * z).abs() < 0.01, "{y} {z}");
    }

    #[test]
    fn it_blocks_on_this_side_of_the_light_alone() {
        let wall = Plane::<Fixed>::new([0.0, 0.0, 1.0], 500.0, 0);
        let blocks = |plane: &Plane<Fixed>, d, limit: f64| {
            plane.blocks::<{ uses::ALL }>(&far_ray(d), fixed::types::I16F16::from_num(limit))
        };
        let across = [0, 0, 1 << 17];
        assert!(blocks(&wall, across, 501.0) && !blocks(&wall, across, 499.0));
        assert!(!blocks(&wall, [0, 0, -1 << 17], 2000.0));
        // A floor that is met 1,500 units away; a directional light is at `FAR`, and beyond everything.
        let floor = Plane::<Fixed>::new([0.0, 1.0, 0.0], 0.0, 0);
        let down = [0, -87, 1 << 17];
        assert!(blocks(&floor, down, 1600.0) && !blocks(&floor, down, 1400.0));
        assert!(blocks(&floor, down, 1024.0) && !blocks(&floor, down, 1023.0));
    }
}

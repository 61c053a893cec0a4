//! Cone or frustum: the lateral surface between two circles, and the caps if asked for.
//!
//! At the height s over its middle, the cone's radius is (waist + sin α·s)/cos α, α being the angle
//! between axis and surface, and the points p around the middle are those with
//! cos²α·|p − s·a|² = (waist + sin α·s)². That stays bounded when α goes to 0, where the form
//! around the apex doesn't: a cylinder is a cone with α = 0.
//!
//! Before the quadratic the ray is moved to where it comes nearest to the middle, and both are
//! measured in the radius of the sphere around the cone: all operands are components no larger
//! than 1 (see [`Arithmetic::cone`]), and a ray that misses the sphere is done.
//!
//! With F = cos²α·|…|² − (…)² = a·τ² + 2b·τ + c, negative inside, the derivative at the root
//! (−b ∓ h)/a is ∓2h: the first root always enters and the second always leaves, even where a is
//! negative and they lie on the double cone's two halves. The heights of the two circles choose
//! the half. With caps it is what the double cone's inside and the slab between the circles have in
//! common: where the roots are in order, what lies between them; where not, what lies beyond either,
//! of which the slab meets one.

use bytemuck::AnyBitPattern;

use super::chord::{Chord, Convex};
use super::cylinder::cap;
use super::projection::{dot, minus};
use super::{MaterialId, Meeting, Open, Ray, Shape, ShapeError, Surface};
use super::{ok_or_panic, point, some_or, turned_to, unit_vector};
use crate::blob::stored;
use crate::math::{Arithmetic, for_each_arithmetic, sqrt_f64, sub};
use crate::octree::Extent;

/// A cone or frustum, without caps unless [made with them](Self::with_caps).
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(C)]
pub struct Cone<A: Arithmetic> {
    middle: [A::Length; 3],
    axis: [A::Unit; 3],
    /// The sphere around both circles.
    bound: A::Radius,
    sin_cos: [A::Unit; 2],
    /// The radius in the middle times cos α, in bounding radii.
    waist: A::Unit,
    /// Half the height, in bounding radii.
    half: A::Unit,
    material: MaterialId,
    /// 1 with caps, else 0: a type that any bits may be.
    capped: u8,
}

stored!(Cone {
    middle: lengths,
    axis: units,
    bound: nested,
    sin_cos: units,
    waist: unit,
    half: unit,
    material: whole, capped: whole
} if *capped <= 1);

for_each_arithmetic! {
    impl Cone<A> {
        /// A cone, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(
            base: [f64; 3],
            base_radius: f64,
            apex: [f64; 3],
            apex_radius: f64,
            material: u16,
        ) -> Self {
            ok_or_panic!(Self::try_new(base, base_radius, apex, apex_radius, material))
        }

        /// A cone around the line from `base` to `apex`, with the radius at each end; either may be
        /// 0, and equal ones make a cylinder (which [`Cylinder`](super::Cylinder) traces faster).
        /// Radii that are negative show the inside alone.
        ///
        /// # Errors
        /// Coordinates or size out of range; both points the same; both radii 0, or of
        /// different sign.
        pub const fn try_new(
            base: [f64; 3],
            base_radius: f64,
            apex: [f64; 3],
            apex_radius: f64,
            material: u16,
        ) -> Result<Self, ShapeError> {
            if material >= MaterialId::LIMIT {
                return Err(ShapeError::Material);
            }
            let id = MaterialId::new(material);
            let inside = base_radius < 0.0 || apex_radius < 0.0;
            let (r0, r1) =
                if inside { (-base_radius, -apex_radius) } else { (base_radius, apex_radius) };
            let largest = if r0 > r1 { r0 } else { r1 };
            let sized = r0 >= 0.0 && r1 >= 0.0 && largest > 0.0;
            if !sized {
                return Err(ShapeError::Size);
            }
            let _ = (point!(make, base), point!(make, apex));
            let way = minus(apex, base);
            let length = sqrt_f64(dot(way, way));
            let slant = sqrt_f64(length * length + (r1 - r0) * (r1 - r0));
            let (sin, cos) = ((r1 - r0) / slant, length / slant);
            let middle = [
                base[0] + way[0] * 0.5,
                base[1] + way[1] * 0.5,
                base[2] + way[2] * 0.5,
            ];
            // A little larger: the circles lie on the sphere.
            let bound = sqrt_f64(length * length * 0.25 + largest * largest) * (1.0 + 1e-4);
            let bound = some_or!(make::radius(bound), Size);
            let size = make::from_radius(&bound);
            Ok(Self {
                middle: point!(make, middle),
                axis: unit_vector!(make, way),
                bound,
                sin_cos: [some_or!(make::unit(sin), Size), some_or!(make::unit(cos), Size)],
                waist: some_or!(make::unit((r0 + r1) * 0.5 * cos / size), Size),
                half: some_or!(make::unit(length * 0.5 / size), Size),
                material: if inside { id.showing_inside() } else { id },
                capped: 0,
            })
        }

        /// The box around both circles, in plain numbers.
        pub(crate) const fn reach(&self) -> ([f64; 3], [f64; 3]) {
            let size = make::from_radius(&self.bound);
            let (sin, cos) =
                (make::from_unit(self.sin_cos[0]), make::from_unit(self.sin_cos[1]));
            let (waist, half) = (make::from_unit(self.waist), make::from_unit(self.half));
            let (mut min, mut max) = ([0.0; 3], [0.0; 3]);
            let mut i = 0;
            while i < 3 {
                let c = make::from_length(self.middle[i]);
                let n = make::from_unit(self.axis[i]);
                let across = sqrt_f64(1.0 - n * n);
                let (mut low, mut high) = (f64::MAX, -f64::MAX);
                let mut end = 0;
                while end < 2 {
                    let s = if end == 0 { -half } else { half };
                    // cos is at least 2⁻¹⁷ of anything: length and radius have the same range.
                    let r = if cos > 0.0 { (waist + sin * s) / cos } else { 1.0 };
                    let r = if r > 1.0 { 1.0 } else { r };
                    let reach = size * (if r > 0.0 { r } else { 0.0 }) * across;
                    let at = c + size * s * n;
                    low = if at - reach < low { at - reach } else { low };
                    high = if at + reach > high { at + reach } else { high };
                    end += 1;
                }
                // Radii are stored to 17 bits of the size.
                let off = size / 32768.0;
                (min[i], max[i]) = (low - off, high + off);
                i += 1;
            }
            (min, max)
        }

        /// Its two circles.
        pub const fn extent(&self, log2_step: i8) -> Extent {
            let size = make::from_radius(&self.bound);
            let (sin, cos) =
                (make::from_unit(self.sin_cos[0]), make::from_unit(self.sin_cos[1]));
            let (waist, half) = (make::from_unit(self.waist), make::from_unit(self.half));
            let (mut ends, mut radii) = ([[0; 3]; 2], [0; 2]);
            let mut end = 0;
            while end < 2 {
                let s = if end == 0 { -half } else { half };
                // cos is at least 2⁻¹⁷ of anything: length and radius have the same range.
                let r = if cos > 0.0 { (waist + sin * s) / cos } else { 1.0 };
                let r = if r > 1.0 { 1.0 } else { r };
                // Radii are stored to 17 bits of the size.
                let r = (if r > 0.0 { r } else { 0.0 }) + 1.0 / 32768.0;
                radii[end] = make::grid(size * r, log2_step);
                let mut i = 0;
                while i < 3 {
                    let at = make::from_length(self.middle[i])
                        + size * s * make::from_unit(self.axis[i]);
                    ends[end][i] = make::grid(at, log2_step);
                    i += 1;
                }
                end += 1;
            }
            Extent::Round { ends, radii, hollow: self.capped == 0 }
        }
    }
}

impl<A: Arithmetic> Cone<A> {
    pub(crate) const fn material_id(&self) -> MaterialId {
        self.material
    }
}

impl<A: Arithmetic> Cone<A> {
    /// The same, closed by a disc at each end.
    #[must_use]
    pub const fn with_caps(mut self) -> Self {
        self.capped = 1;
        self
    }

    pub(crate) const fn has_caps(&self) -> bool {
        self.capped != 0
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

    /// Where the ray enters and leaves the double cone, in bounding radii from where it comes
    /// nearest to the middle, and how far away that is.
    #[inline(always)]
    fn roots(&self, ray: &Ray<A>, c: &[A::Length; 3]) -> Option<([A::Unit; 2], A::Length)> {
        let closest = A::project(c, &ray.direction);
        A::leg2(&self.bound, c, closest, &ray.direction)?;
        let w = sub(&A::along(&ray.origin, closest, &ray.direction), &self.middle);
        let w = A::over(&self.bound, &w);
        Some((A::cone(&w, &ray.direction, &self.axis, self.sin_cos, self.waist)?, closest))
    }
}

impl<A: Arithmetic> Convex<A> for Cone<A> {
    fn chord(&self, ray: &Ray<A>, coarse: &A::Coarse) -> Option<Chord<A>> {
        if !A::may_hit::<false>(coarse, &self.middle, &self.bound, A::FAR) {
            return None;
        }
        let c = sub(&self.middle, &ray.origin);
        let (roots, closest) = self.roots(ray, &c)?;
        let size = A::radius(&self.bound);
        let (ca, half) = (A::project(&c, &self.axis), A::scale(size, self.half));
        let da = A::dot(&ray.direction, &self.axis);
        let slab = Chord::<A>::slab(ca - half, ca + half, da, A::FAR);
        let end = |root, detail| Meeting { distance: closest + A::scale(size, root), detail };
        let (enters, leaves) = (end(roots[0], -size), end(roots[1], size));
        if roots[0] <= roots[1] {
            return Chord { entry: enters, exit: leaves }.and(slab);
        }
        let before = Chord { exit: leaves, ..Chord::endless() }.and(slab);
        let behind = Chord { entry: enters, ..Chord::endless() }.and(slab);
        // Rounding can leave the slab a sliver of the other half.
        let length = |chord: &Chord<A>| chord.exit.distance - chord.entry.distance;
        match (before, behind) {
            (Some(a), Some(b)) => Some(if length(&a) > length(&b) { a } else { b }),
            (a, b) => a.or(b),
        }
    }
}

impl<A: Arithmetic> Shape<A> for Cone<A> {
    const FLAT: bool = false;

    #[inline(always)]
    fn nearest(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        inwards: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
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

impl<A: Arithmetic> Shape<A> for Open<'_, Cone<A>> {
    const FLAT: bool = false;

    #[inline]
    fn nearest(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        inwards: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        let it = self.0;
        if !A::may_hit::<false>(coarse, &it.middle, &it.bound, limit) {
            return None;
        }
        let c = sub(&it.middle, &ray.origin);
        let closest = A::project(&c, &ray.direction);
        A::leg2(&it.bound, &c, closest, &ray.direction)?;
        let size = A::radius(&it.bound);
        let w = sub(&A::along(&ray.origin, closest, &ray.direction), &it.middle);
        let w = A::over(&it.bound, &w);
        let roots = A::cone(&w, &ray.direction, &it.axis, it.sin_cos, it.waist)?;
        let (s, da) = (A::dot(&w, &it.axis), A::dot(&ray.direction, &it.axis));
        let at = |root: A::Unit| {
            let height = s + A::product(root, da);
            let t = closest + A::scale(size, root);
            let between = height <= it.half && -height <= it.half;
            // Both circles lie in the sphere; a root that was clipped is a point of its own, which
            // may be between them too.
            let between = between && root <= A::ONE_UNIT && -root <= A::ONE_UNIT;
            if between && t > A::NO_LENGTH && t <= limit { Some(t) } else { None }
        };
        if !inwards
            && !it.material.inside_only()
            && let Some(distance) = at(roots[0])
        {
            return Some(Meeting { distance, detail: -size });
        }
        at(roots[1]).map(|distance| Meeting { distance, detail: size })
    }

    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>, p: &mut [A::Length; 3]) -> Surface<A> {
        let it = self.0;
        let v = sub(p, &it.middle);
        let v = A::along(&v, -A::project(&v, &it.axis), &it.axis);
        let (across, length, _) = A::normalize(&v);
        let [sin, cos] = it.sin_cos;
        let outward = if length > A::NO_LENGTH {
            let f = |x: A::Unit, a: A::Unit| A::product(x, cos) - A::product(a, sin);
            let [x, y, z] = across;
            let [ax, ay, az] = it.axis;
            [f(x, ax), f(y, ay), f(z, az)]
        } else if sin > A::NO_UNIT {
            // the very tip
            crate::math::neg(&it.axis)
        } else {
            it.axis
        };
        let dn = A::dot(&ray.direction, &outward);
        turned_to(&outward, dn, meeting.detail > A::NO_LENGTH)
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
    use crate::shape::testing::{Test, distance, ray};

    #[test]
    fn fifty_two_bytes() {
        assert_eq!(size_of::<Cone<Fixed>>(), 52);
    }

    #[test]
    fn below_a_flat_cone_there_is_nothing() {
        // On the way in the ray crosses the slab between the circles outside of both, and meets
        // the double cone far away: where |x| = 0.02 + 6·y and x = 0.09 − τ, y = h − 0.2·τ, at
        // τ = (0.07 − 6h)/−0.2 and, below the slab, at τ = (0.11 + 6h)/2.2.
        fn all_miss<A: Test>(cone: &Cone<A>)
        where
            Cone<A>: Shape<A>,
        {
            let length = 1.04f64.sqrt();
            let way = [-1.0 / length, -0.2 / length, 0.0];
            for step in 0..40 {
                let h = -0.02 + 0.0005 * f64::from(step);
                let from = [0.09 + 2.0, h + 0.2 * 2.0, 0.0];
                assert_eq!(distance(cone, &ray(from, way)), None, "{h}");
            }
        }
        let (base, apex) = ([0.0; 3], [0.0, 0.01, 0.0]);
        all_miss(&Cone::<f64>::new(base, 0.02, apex, 0.08, 0));
        all_miss(&Cone::<f32>::new(base, 0.02, apex, 0.08, 0));
        all_miss(&Cone::<Fixed>::new(base, 0.02, apex, 0.08, 0));
    }

    #[test]
    fn wall_tip_and_the_other_half() {
        let c = Cone::<f64>::new([0.0; 3], 1.0, [0.0, 0.0, 1.0], 0.0, 0);
        let x = [1.0, 0.0, 0.0];
        let near = |a: Option<f64>, b: f64| a.is_some_and(|a| (a - b).abs() < 1e-9);
        assert!(near(distance(&c, &ray([-3.0, 0.0, 0.25], x)), 2.25));
        assert!(near(distance(&c, &ray([0.0, 0.0, 0.25], x)), 0.75));
        assert_eq!(distance(&c, &ray([3.0, 0.0, 0.25], x)), None);
        assert_eq!(distance(&c, &ray([-3.0, 0.0, 1.25], x)), None);
        assert_eq!(distance(&c, &ray([-3.0, 0.0, -0.25], x)), None);
        // down beside the axis: the double cone's upper half isn't there
        let down = [0.0, 0.0, -1.0];
        assert!(near(distance(&c, &ray([0.5, 0.0, 3.0], down)), 2.5));
        let up = [0.0, 0.0, 1.0];
        let r = ray([0.5, 0.0, -3.0], up);
        let m = c.nearest(&r, &(), false, 9.0).unwrap();
        assert!((m.distance - 3.5).abs() < 1e-9);
        let s = c.surface(&r, &m, &mut [0.5, 0.0, 0.5]);
        let half = 0.5f64.sqrt();
        assert!(s.behind && (s.normal[0] + half).abs() < 1e-9 && (s.cosine - half).abs() < 1e-9);
        assert!(near(
            c.nearest(&ray([-0.75, 0.0, 0.25], x), &(), true, 9.0).map(|m| m.distance),
            1.5
        ));
    }
}

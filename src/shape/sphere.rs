//! Sphere.
//!
//! With c the centre relative to the ray's origin, the ray comes nearest to it at t = c·d, and
//! f = c − t·d is the way from there to the centre. The half chord is h = √(r² − |f|²), the
//! roots t ∓ h. Taking |f|² rather than |c|² − t² avoids the cancellation that ruins the classic
//! form for small or far spheres (Haines, Günther et al., "Precision improvements for ray/sphere
//! intersection", Ray Tracing Gems, 2019).
//!
//! The cosine at the hit needs no product of vectors: it is the half chord over the radius. A
//! shadow ray needs no root: a sphere whose near point lies beyond the segment blocks it if the
//! squared half chord exceeds the square of what lies beyond.

use bytemuck::AnyBitPattern;

use super::chord::{Chord, Convex};
use super::{MaterialId, Meeting, Ray, Shape, ShapeError, Surface};
use super::{ok_or_panic, point, some_or, turned};
use crate::blob::stored;
use crate::math::{Arithmetic, for_each_arithmetic, sub};
use crate::octree::Extent;
use crate::scene::uses::{self, has};

/// A sphere.
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(C)]
pub struct Sphere<A: Arithmetic> {
    center: [A::Length; 3],
    radius: A::Radius,
    material: MaterialId,
}

stored!(Sphere { center: lengths, radius: nested, material: whole });

for_each_arithmetic! {
    impl Sphere<A> {
        /// A sphere, for scenes in `const`s: a mistake doesn't compile.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(center: [f64; 3], radius: f64, material: u16) -> Self {
            ok_or_panic!(Self::try_new(center, radius, material))
        }

        /// A sphere. A negative radius shows the inside alone.
        ///
        /// # Errors
        /// Coordinates or radius out of the arithmetic's range.
        pub const fn try_new(
            center: [f64; 3],
            radius: f64,
            material: u16,
        ) -> Result<Self, ShapeError> {
            if material >= MaterialId::LIMIT {
                return Err(ShapeError::Material);
            }
            let id = MaterialId::new(material);
            Ok(Self {
                center: point!(make, center),
                radius: some_or!(make::radius(if radius < 0.0 { -radius } else { radius }), Size),
                material: if radius < 0.0 { id.showing_inside() } else { id },
            })
        }

        /// The box around it.
        pub(crate) const fn reach(&self) -> ([f64; 3], [f64; 3]) {
            let r = make::from_radius(&self.radius);
            let (mut min, mut max) = ([0.0; 3], [0.0; 3]);
            let mut i = 0;
            while i < 3 {
                let c = make::from_length(self.center[i]);
                (min[i], max[i]) = (c - r, c + r);
                i += 1;
            }
            (min, max)
        }

        /// The sphere itself.
        pub const fn extent(&self, log2_step: i8) -> Extent {
            Extent::Sphere {
                center: [
                    make::to_grid(self.center[0], log2_step),
                    make::to_grid(self.center[1], log2_step),
                    make::to_grid(self.center[2], log2_step),
                ],
                radius: make::grid(make::from_radius(&self.radius), log2_step),
            }
        }
    }
}

impl<A: Arithmetic> Sphere<A> {
    pub(crate) const fn material_id(&self) -> MaterialId {
        self.material
    }

    /// The centre.
    pub fn center(&self) -> [A::Length; 3] {
        self.center
    }

    /// The radius and what is made of it.
    pub(crate) fn bound(&self) -> &A::Radius {
        &self.radius
    }

    /// The radius, not negative.
    pub fn radius(&self) -> A::Length {
        A::radius(&self.radius)
    }

    /// The same sphere somewhere else: nothing that is precomputed depends on the centre.
    #[must_use]
    pub fn at(self, center: [A::Length; 3]) -> Self {
        Self { center, ..self }
    }
}

impl<A: Arithmetic> Convex<A> for Sphere<A> {
    fn chord(&self, ray: &Ray<A>, coarse: &A::Coarse) -> Option<Chord<A>> {
        if !A::may_hit::<false>(coarse, &self.center, &self.radius, A::FAR) {
            return None;
        }
        let c = sub(&self.center, &ray.origin);
        let t = A::project(&c, &ray.direction);
        let leg2 = A::leg2(&self.radius, &c, t, &ray.direction)?;
        let t = if A::REFINE { t + A::ahead(&self.radius, &c, t, &ray.direction) } else { t };
        let half = A::leg(&self.radius, leg2);
        Some(Chord {
            entry: Meeting { distance: t - half, detail: -half },
            exit: Meeting { distance: t + half, detail: half },
        })
    }
}

impl<A: Arithmetic> Sphere<A> {
    #[inline(always)]
    pub(crate) fn shows_inside_only<const USES: u64>(&self) -> bool {
        has(USES, uses::INSIDES) && self.material.inside_only()
    }

    /// See [`Shape::nearest`].
    #[inline(always)]
    pub(crate) fn meet<const USES: u64>(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        inwards: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        if !A::may_hit::<false>(coarse, &self.center, &self.radius, limit) {
            return None;
        }
        self.meet_likely::<USES>(ray, inwards, limit)
    }

    /// Whether a ray that passes near may meet it: see [`Arithmetic::may_hit`].
    #[inline(always)]
    pub(crate) fn may_be_met(&self, coarse: &A::Coarse, limit: A::Length) -> bool {
        A::may_hit::<true>(coarse, &self.center, &self.radius, limit)
    }

    /// The same for a ray that probably meets it.
    #[inline(always)]
    pub(crate) fn meet_likely<const USES: u64>(
        &self,
        ray: &Ray<A>,
        inwards: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        let c = sub(&self.center, &ray.origin);
        let t = A::project(&c, &ray.direction);
        let leg2 = A::leg2(&self.radius, &c, t, &ray.direction)?;
        let t = if A::REFINE { t + A::ahead(&self.radius, &c, t, &ray.direction) } else { t };
        let half = A::leg(&self.radius, leg2);
        let near = t - half;
        let (distance, detail) =
            if near > A::NO_LENGTH && !inwards && !self.shows_inside_only::<USES>() {
                (near, -half)
            } else {
                (t + half, half)
            };
        if distance > A::NO_LENGTH && distance <= limit {
            Some(Meeting { distance, detail })
        } else {
            None
        }
    }

    /// See [`Shape::occludes`].
    #[inline(always)]
    pub(crate) fn blocks<const USES: u64>(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        inwards: bool,
        limit: A::Length,
    ) -> bool {
        A::may_hit::<false>(coarse, &self.center, &self.radius, limit)
            && self.blocks_likely::<USES>(ray, inwards, limit)
    }

    /// The same for a ray that probably meets it.
    #[inline(always)]
    pub(crate) fn blocks_likely<const USES: u64>(
        &self,
        ray: &Ray<A>,
        inwards: bool,
        limit: A::Length,
    ) -> bool {
        if inwards || self.shows_inside_only::<USES>() {
            return match self.meet_likely::<USES>(ray, inwards, limit) {
                Some(meeting) => meeting.distance < limit,
                None => false,
            };
        }
        let c = sub(&self.center, &ray.origin);
        let t = A::project(&c, &ray.direction);
        let Some(leg2) = A::leg2(&self.radius, &c, t, &ray.direction) else { return false };
        // The chord reaches from t − h to t + h: does an end lie within the segment 0 to limit?
        let beyond = |way: A::Length| leg2 > A::square(&self.radius, way);
        if t < A::NO_LENGTH {
            beyond(t) && !beyond(limit - t)
        } else if t > limit {
            beyond(t - limit) && !beyond(t)
        } else {
            // The nearest point lies within the segment; so does a root, unless the segment is
            // all inside.
            !beyond(t) || !beyond(limit - t)
        }
    }
}

impl<A: Arithmetic> Shape<A> for Sphere<A> {
    const FLAT: bool = false;

    #[inline(always)]
    fn nearest(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        inwards: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        self.meet::<{ uses::ALL }>(ray, coarse, inwards, limit)
    }

    /// Most rays miss: whether they start on it is asked afterwards.
    #[inline(always)]
    fn nearest_from(
        &self,
        ray: &Ray<A>,
        coarse: &A::Coarse,
        left: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        if !A::may_hit::<false>(coarse, &self.center, &self.radius, limit)
            || left && !ray.leaving.inwards
        {
            return None;
        }
        self.meet_likely::<{ uses::ALL }>(ray, left, limit)
    }

    #[inline(always)]
    fn occludes(&self, ray: &Ray<A>, coarse: &A::Coarse, inwards: bool, limit: A::Length) -> bool {
        self.blocks::<{ uses::ALL }>(ray, coarse, inwards, limit)
    }

    #[inline(always)]
    fn surface(&self, _: &Ray<A>, meeting: &Meeting<A>, p: &mut [A::Length; 3]) -> Surface<A> {
        let mut outward = A::over(&self.radius, &sub(p, &self.center));
        A::settle(&self.radius, &mut outward, p);
        turned(&outward, A::part(&self.radius, meeting.detail))
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

    const BALL: Sphere<Fixed> = Sphere::<Fixed>::new([0.0, 0.0, 5.0], 1.0, 3);

    #[test]
    fn twenty_four_bytes_in_flash() {
        assert_eq!(size_of::<Sphere<Fixed>>(), 24);
    }

    fn ray(o: [f64; 3], d: [f64; 3]) -> Ray<f64> {
        Ray { origin: o, direction: d, leaving: Leaving::NOTHING }
    }

    #[test]
    fn near_far_and_behind() {
        let ball = Sphere::<f64>::new([0.0, 0.0, 5.0], 1.0, 0);
        let hit = |o, d, inwards| ball.nearest(&ray(o, d), &(), inwards, 100.0).map(|m| m.distance);
        let z = [0.0, 0.0, 1.0];
        assert_eq!(hit([0.0; 3], z, false), Some(4.0));
        assert_eq!(hit([0.0, 0.0, 5.0], z, false), Some(1.0));
        assert_eq!(hit([0.0, 0.0, 7.0], z, false), None);
        assert_eq!(hit([0.0, 0.0, 4.0], z, true), Some(2.0));
        assert_eq!(hit([0.0, 1.5, 0.0], z, false), None);
        assert_eq!(BALL.material().index(), 3);
    }

    #[test]
    fn a_segment_inside_is_not_blocked() {
        let ball = Sphere::<f64>::new([0.0, 0.0, 0.0], 2.0, 0);
        let blocked = |o, limit| ball.occludes(&ray(o, [0.0, 0.0, 1.0]), &(), false, limit);
        assert!(!blocked([0.0, 0.0, -1.0], 2.0));
        assert!(blocked([0.0, 0.0, -1.0], 3.5));
        assert!(blocked([0.0, 0.0, -3.0], 3.0));
        assert!(!blocked([0.0, 0.0, -3.0], 0.5));
        assert!(!blocked([0.0, 0.0, -1.0], 0.5));
        assert!(!blocked([0.0, 0.0, 1.0], 0.5));
        assert!(blocked([0.0, 0.0, 1.0], 1.5));
    }

    #[test]
    fn a_negative_radius_shows_the_inside() {
        let ball = Sphere::<f64>::new([0.0, 0.0, 5.0], -1.0, 0);
        let m = ball.nearest(&ray([0.0; 3], [0.0, 0.0, 1.0]), &(), false, 100.0).unwrap();
        assert_eq!(m.distance, 6.0);
        let r = ray([0.0; 3], [0.0, 0.0, 1.0]);
        let s = ball.surface(&r, &m, &mut [0.0, 0.0, 6.0]);
        assert!(s.behind);
        assert_eq!(s.normal, [0.0, 0.0, -1.0]);
    }
}

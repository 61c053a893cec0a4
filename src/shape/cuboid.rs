//! Cuboid: a box along the axes.
//!
//! The ray is inside of three pairs of planes at once (the slabs of Kay and Kajiya 1986) from the
//! farthest of the planes that face it to the nearest of those that face away. The planes' distances
//! are quotients of a length and a component of the direction, both not negative: a component of 0
//! gives the farthest distance there is, which says the right thing on either side. Entry and exit
//! through one edge are compared as the same two numbers, so that no ray slips in between faces.

use bytemuck::AnyBitPattern;

use super::chord::{Chord, Convex};
use super::{MaterialId, Meeting, Ray, Shape, ShapeError, Surface};
use super::{ok_or_panic, point};
use crate::blob::stored;
use crate::math::{Arithmetic, axis_of, for_each_arithmetic};
use crate::octree::Extent;

/// A box whose sides are parallel to the coordinate planes.
#[derive(Clone, Copy, Debug, AnyBitPattern)]
#[repr(C)]
pub struct Cuboid<A: Arithmetic> {
    min: [A::Length; 3],
    max: [A::Length; 3],
    material: MaterialId,
}

stored!(Cuboid { min: lengths, max: lengths, material: whole } if min.iter().zip(max).all(|(low, high)| low <= high));

impl<A: Arithmetic> Cuboid<A> {
    /// One without a size, which no constructor makes.
    pub(crate) const NONE: Self =
        Self { min: [A::NO_LENGTH; 3], max: [A::NO_LENGTH; 3], material: MaterialId::new(0) };
}

for_each_arithmetic! {
    impl Cuboid<A> {
        /// A box, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(min: [f64; 3], max: [f64; 3], material: u16) -> Self {
            ok_or_panic!(Self::try_new(min, max, material))
        }

        /// The box from its smallest to its largest coordinates.
        ///
        /// # Errors
        /// Coordinates out of range; a side that is not positive.
        pub const fn try_new(
            min: [f64; 3],
            max: [f64; 3],
            material: u16,
        ) -> Result<Self, ShapeError> {
            if material >= MaterialId::LIMIT {
                return Err(ShapeError::Material);
            }
            let cuboid = Self {
                min: point!(make, min),
                max: point!(make, max),
                material: MaterialId::new(material),
            };
            let mut i = 0;
            while i < 3 {
                if make::from_length(cuboid.min[i]) >= make::from_length(cuboid.max[i]) {
                    return Err(ShapeError::Size);
                }
                i += 1;
            }
            Ok(cuboid)
        }

        /// The box itself, in plain numbers.
        pub(crate) const fn reach(&self) -> ([f64; 3], [f64; 3]) {
            let (mut min, mut max) = ([0.0; 3], [0.0; 3]);
            let mut i = 0;
            while i < 3 {
                min[i] = make::from_length(self.min[i]);
                max[i] = make::from_length(self.max[i]);
                i += 1;
            }
            (min, max)
        }

        /// The box itself.
        pub const fn extent(&self, log2_step: i8) -> Extent {
            let (mut min, mut max) = ([0; 3], [0; 3]);
            let mut i = 0;
            while i < 3 {
                min[i] = make::to_grid(self.min[i], log2_step);
                max[i] = make::to_grid(self.max[i], log2_step);
                i += 1;
            }
            Extent::Box { min, max }
        }
    }
}

/// What [`Meeting::detail`] holds: a length that stands for the axis across which the ray meets
/// the box, negative where it enters.
#[inline(always)]
fn mark<A: Arithmetic>(axis: u8) -> A::Length {
    A::side(axis as i8)
}

impl<A: Arithmetic> Cuboid<A> {
    pub(crate) const fn material_id(&self) -> MaterialId {
        self.material
    }
}

impl<A: Arithmetic> Convex<A> for Cuboid<A> {
    fn chord(&self, ray: &Ray<A>, _: &A::Coarse) -> Option<Chord<A>> {
        let slab = |i: usize| {
            let o = ray.origin[i];
            let mark = mark::<A>(i as u8);
            Chord::<A>::slab(self.min[i] - o, self.max[i] - o, ray.direction[i], mark)
        };
        slab(0).and(slab(1))?.and(slab(2))
    }
}

impl<A: Arithmetic> Shape<A> for Cuboid<A> {
    const FLAT: bool = false;

    #[inline(always)]
    fn nearest(
        &self,
        ray: &Ray<A>,
        _: &A::Coarse,
        inwards: bool,
        limit: A::Length,
    ) -> Option<Meeting<A>> {
        let (mut near, mut far) = ([A::NO_LENGTH; 3], [A::NO_LENGTH; 3]);
        let mut speed = [A::NO_UNIT; 3];
        for i in 0..3 {
            let (o, d) = (ray.origin[i], ray.direction[i]);
            (near[i], far[i], speed[i]) = if d >= A::NO_UNIT {
                (self.min[i] - o, self.max[i] - o, d)
            } else {
                (o - self.max[i], o - self.min[i], -d)
            };
            // It takes at least so far along the ray.
            if far[i] < A::NO_LENGTH || near[i] > limit && !inwards {
                return None;
            }
        }
        if !inwards && !A::may_cross(&near, &far, &speed) {
            return None;
        }
        let (mut entry, mut exit) = (A::NO_LENGTH, A::FAR);
        let (mut entry_mark, mut exit_mark) = (A::NO_LENGTH, mark::<A>(2));
        for i in 0..3 {
            let leaves = A::ratio(far[i], speed[i]);
            if leaves < exit {
                exit = leaves;
                exit_mark = mark::<A>(i as u8);
            }
            if near[i] > A::NO_LENGTH {
                let enters = A::ratio(near[i], speed[i]);
                if enters > limit {
                    if !inwards {
                        return None;
                    }
                } else if enters > entry {
                    entry = enters;
                    entry_mark = -mark::<A>(i as u8);
                }
            }
            if entry > exit && !inwards {
                return None;
            }
        }
        let (distance, detail) =
            if entry > A::NO_LENGTH && !inwards { (entry, entry_mark) } else { (exit, exit_mark) };
        if distance > A::NO_LENGTH && distance <= exit && distance <= limit {
            Some(Meeting { distance, detail })
        } else {
            None
        }
    }

    #[inline(always)]
    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>, _: &mut [A::Length; 3]) -> Surface<A> {
        let behind = meeting.detail > A::NO_LENGTH;
        let which = if behind { meeting.detail } else { -meeting.detail };
        let axis = if which < mark::<A>(1) {
            0
        } else if which < mark::<A>(2) {
            1
        } else {
            2
        };
        let d = axis_of(&ray.direction, axis);
        let (back, cosine) = if d > A::NO_UNIT { (-A::ONE_UNIT, d) } else { (A::ONE_UNIT, -d) };
        let normal = match axis {
            0 => [back, A::NO_UNIT, A::NO_UNIT],
            1 => [A::NO_UNIT, back, A::NO_UNIT],
            _ => [A::NO_UNIT, A::NO_UNIT, back],
        };
        Surface { geometric: normal, normal, cosine, behind, smooth: false, part: 0 }
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
    use proptest::{array, prelude::*};

    #[test]
    fn twenty_eight_bytes() {
        assert_eq!(size_of::<Cuboid<Fixed>>(), 28);
    }

    #[test]
    fn faces_from_both_sides() {
        let cuboid = Cuboid::<f64>::new([-1.0, -2.0, -3.0], [1.0, 2.0, 3.0], 0);
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                let (mut o, mut d) = ([0.5, 0.25, 0.125], [0.0; 3]);
                d[axis] = sign;
                let inside = cuboid.nearest(&ray(o, d), &(), false, 100.0).unwrap();
                let size = (axis + 1) as f64;
                assert_eq!(inside.distance, size - sign * o[axis]);
                let s = cuboid.surface(&ray(o, d), &inside, &mut { o });
                assert!(s.behind && s.cosine == 1.0 && s.normal[axis] == -sign);
                o[axis] = -5.0 * sign;
                let hit = cuboid.nearest(&ray(o, d), &(), false, 100.0).unwrap();
                assert_eq!(hit.distance, 5.0 - size);
                let s = cuboid.surface(&ray(o, d), &hit, &mut { o });
                assert!(!s.behind && s.cosine == 1.0 && s.normal[axis] == -sign);
                o[axis] = 5.0 * sign;
                assert_eq!(distance(&cuboid, &ray(o, d)), None);
                o[axis] = -5.0 * sign;
                o[(axis + 1) % 3] = 4.0;
                assert_eq!(distance(&cuboid, &ray(o, d)), None);
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]
        #[test]
        fn quick_rejection_loses_no_hit(
            low in array::uniform3(-300.0..300.0f64),
            log_size in array::uniform3(-6.0..8.0f64),
            o in array::uniform3(-300.0..300.0f64),
            within in array::uniform3(-0.2..1.2f64),
        ) {
            // Towards a place in the box or near it, often past an edge.
            let high = [0, 1, 2].map(|i| low[i] + log_size[i].exp2());
            let cuboid = Cuboid::<Fixed>::new(low, high, 0);
            let way = [0, 1, 2].map(|i| low[i] + within[i] * (high[i] - low[i]) - o[i]);
            let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
            prop_assume!(length > 0.01);
            let ray = ray::<Fixed>(o, way.map(|x| x / length));
            let coarse = Fixed::coarse(&ray.origin, &ray.direction);
            // The same quotients, without the rejection.
            let chord = cuboid.chord(&ray, &coarse);
            let slow = chord.and_then(|c| c.nearest(false, Fixed::FAR));
            let quick = cuboid.nearest(&ray, &coarse, false, Fixed::FAR);
            if let Some(slow) = slow {
                prop_assert_eq!(quick.map(|m| m.distance), Some(slow.distance));
            }
        }
    }
}

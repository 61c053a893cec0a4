//! What can be seen from a point: for each of the first few spheres the cone of directions in which
//! a ray through the point can meet it.
//!
//! The camera's rays all start at the eye, and shadow rays all end at a light: a product with the
//! direction tells which spheres such a ray needn't be tested with (Haines and Greenberg's light
//! buffer, 1986, without its raster). A cone is wide enough for every rounding, so the picture
//! is the same to the bit.

use crate::math::{Arithmetic, sub};
use crate::scene::uses::{self, has};
use crate::scene::{Scene, Source};

/// So many spheres have their cones remembered. A list of more is better off with an octree.
pub(crate) const FEW: usize = 8;
/// So many lights are.
const LIGHTS: usize = 2;

/// Whether all cones come before the first sphere: what is kept for a sphere's test then needn't make way for each
/// cone, where registers are few. Elsewhere a sphere's cone comes right before its test.
pub(super) const CONES_FIRST: bool = cfg!(narrow_multiply);

/// What can be seen from a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight<A: Arithmetic> {
    pub(super) cones: [A::DirectionCone; FEW],
    /// A bit for each sphere that the point certainly lies outside of, and whose outside shows.
    outside: u8,
}

impl<A: Arithmetic> Sight<A> {
    /// Anything, in any direction.
    const ANY: Self = Self { cones: [A::EVERY_DIRECTION; FEW], outside: 0 };

    /// Looks from a point: for rays that start there, or, `towards` it, for rays that end there.
    fn look<const USES: u64>(
        &mut self,
        scene: &Scene<'_, A, USES>,
        point: &[A::Length; 3],
        towards: bool,
    ) {
        *self = Self::ANY;
        let mut bit = 1;
        for (cone, sphere) in self.cones.iter_mut().zip(scene.shapes.spheres) {
            let center = sphere.center();
            let way = if towards { sub(point, &center) } else { sub(&center, point) };
            if let Some(found) = A::direction_cone(&way, sphere.bound(), towards) {
                *cone = found;
                // One that shows its inside alone hides nothing from within.
                self.outside |= if sphere.shows_inside_only::<USES>() { 0 } else { bit };
            }
            bit <<= 1;
        }
    }

    /// A bit for each of the first spheres that a ray in a direction may meet.
    #[inline(always)]
    pub(super) fn ahead(&self, direction: &[A::Unit; 3], count: usize) -> u32 {
        let (mut found, mut bit) = (0, 1);
        for cone in self.cones.iter().take(count) {
            if A::in_cone(cone, direction) {
                found |= bit;
            }
            bit <<= 1;
        }
        found
    }

    /// Whether the shape is a sphere that hides the point from all who are within.
    #[inline(always)]
    pub(super) fn hides_from(&self, shape: u32) -> bool {
        shape < FEW as u32 && self.outside >> (shape & 7) & 1 != 0
    }
}

/// Does something with all spheres, and their numbers, that a ray in a direction may meet, of those that a point
/// sees. A macro, since an iterator takes 4 to 8 % more instructions.
macro_rules! each_ahead {
    ($sight:expr, $spheres:expr, $direction:expr, $tally:expr, |$sphere:ident, $id:ident| $act:expr) => {
        let mut spheres = $spheres.iter().zip(&$sight.cones);
        let mut ahead = if $crate::trace::sight::CONES_FIRST {
            $sight.ahead($direction, $spheres.len())
        } else {
            1
        };
        let mut $id = 0;
        while ahead != 0
            && let Some(($sphere, cone)) = spheres.next()
        {
            $tally.test();
            let found = if $crate::trace::sight::CONES_FIRST {
                ahead & 1 != 0
            } else {
                A::in_cone(cone, $direction)
            };
            if found {
                $act;
            }
            if $crate::trace::sight::CONES_FIRST {
                ahead >>= 1;
            }
            $id += 1;
        }
        for _ in spheres {
            $tally.test();
        }
    };
}
pub(super) use each_ahead;

/// What can be seen from the eye and from the first lights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sights<A: Arithmetic> {
    pub(super) eye: Sight<A>,
    lights: [Sight<A>; LIGHTS],
}

impl<A: Arithmetic> Sights<A> {
    /// Of no scene.
    pub(super) const NONE: Self = Self { eye: Sight::ANY, lights: [Sight::ANY; LIGHTS] };

    /// Looks from an eye and from the scene's lights. Nothing is left of the scene before.
    pub(super) fn look<const USES: u64>(
        &mut self,
        scene: &Scene<'_, A, USES>,
        eye: &[A::Length; 3],
    ) {
        if !may_be_few::<USES>() {
            // Nobody will ask.
            return;
        }
        if !are_few(scene) {
            *self = Self::NONE;
            return;
        }
        self.eye.look(scene, eye, false);
        let mut lights = scene.parts.lights.iter();
        for sight in &mut self.lights {
            match lights.next().map(|light| &light.source) {
                Some(Source::Point { position } | Source::Spot { position, .. }) => {
                    sight.look(scene, position, true);
                }
                _ => *sight = Sight::ANY,
            }
        }
    }

    /// What can be seen from a light, if that is remembered.
    #[inline(always)]
    pub(super) fn light(&self, number: u16) -> Option<&Sight<A>> {
        self.lights.get(usize::from(number))
    }
}

/// Whether the spheres of a scene of this type may be few: code for that is worth having.
#[inline(always)]
pub(super) const fn may_be_few<const USES: u64>() -> bool {
    !has(USES, uses::TREE) || has(USES, uses::MANY_SPHERES)
}

/// Whether all spheres have cones: they are few, and nothing but their list finds them.
#[inline(always)]
pub(super) fn are_few<A: Arithmetic, const USES: u64>(scene: &Scene<'_, A, USES>) -> bool {
    may_be_few::<USES>()
        && !(has(USES, uses::TREE) && scene.shapes.tree.is_some())
        && (!has(USES, uses::MANY_SPHERES) || scene.shapes.spheres.len() <= FEW)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;
    use crate::shape::testing::Test;
    use crate::shape::{Leaving, Ray, Sphere};
    use proptest::array::uniform3;
    use proptest::prelude::*;
    extern crate std;

    fn unit(v: [f64; 3]) -> Option<[f64; 3]> {
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        (length > 1e-3).then(|| v.map(|x| x / length))
    }

    /// Whether a ray that meets the sphere is in its cone: one that starts at the point, and one
    /// that ends there, coming from `back` away.
    fn is_found<A: Test>(sphere: &Sphere<A>, point: [f64; 3], d: [f64; 3], back: f64) {
        let from = point.map(A::length);
        let start = Ray::<A> { origin: from, direction: d.map(A::unit), leaving: Leaving::NOTHING };
        let way = sub(&sphere.center(), &from);
        let meets = sphere.meet_likely::<{ uses::ALL }>(&start, false, A::FAR).is_some();
        if let Some(cone) = A::direction_cone(&way, sphere.bound(), false) {
            assert!(!meets || A::in_cone(&cone, &start.direction), "from {point:?} along {d:?}");
        }
        let origin = [0, 1, 2].map(|i| A::length(point[i] + d[i] * back));
        let (direction, distance, _) = A::normalize(&sub(&from, &origin));
        let end = Ray::<A> { origin, direction, leaving: Leaving::NOTHING };
        let blocked = sphere.blocks_likely::<{ uses::ALL }>(&end, false, distance);
        if let Some(cone) = A::direction_cone(&sub(&from, &sphere.center()), sphere.bound(), true) {
            assert!(!blocked || A::in_cone(&cone, &direction), "to {point:?} along {d:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]
        #[test]
        fn no_sphere_is_missed(
            center in uniform3(-200.0f64..200.0),
            log_r in -6.0f64..6.0,
            log_way in -3.0f64..6.0,
            towards in uniform3(-1.0f64..1.0),
            aside in uniform3(-1.0f64..1.0),
            part in 0.9f64..1.1,
            log_back in -3.0f64..8.0,
        ) {
            // Points anywhere around it, and directions that just meet it or just don't.
            let (r, way, back) = (log_r.exp2(), log_r.exp2() + log_way.exp2(), log_back.exp2());
            let Some(t) = unit(towards) else { return Ok(()) };
            let along = (0..3).map(|i| aside[i] * t[i]).sum::<f64>();
            let Some(s) = unit([0, 1, 2].map(|i| aside[i] - along * t[i])) else { return Ok(()) };
            let sine = (r / way * part).min(1.0);
            let cosine = (1.0 - sine * sine).sqrt();
            let d = [0, 1, 2].map(|i| t[i] * cosine + s[i] * sine);
            let point = [0, 1, 2].map(|i| center[i] - t[i] * way);
            is_found::<Fixed>(&Sphere::<Fixed>::new(center, r, 0), point, d, back);
            is_found::<f32>(&Sphere::<f32>::new(center, r, 0), point, d, back);
            is_found::<f64>(&Sphere::<f64>::new(center, r, 0), point, d, back);
        }
    }

    #[test]
    fn most_directions_are_out() {
        let sphere = Sphere::<Fixed>::new([0.0, 0.0, 5.0], 1.0, 0);
        let cone = |point: [f64; 3], towards| {
            let point = point.map(Fixed::length);
            let way = sub(&sphere.center(), &point);
            Fixed::direction_cone(&way, sphere.bound(), towards)
        };
        assert!(cone([0.0, 0.0, 4.5], false).is_none());
        let cone = cone([0.0; 3], false).expect("outside");
        let meets = |angle: f64| {
            let d = [0.0, angle.to_radians().sin(), angle.to_radians().cos()];
            Fixed::in_cone(&cone, &d.map(Fixed::unit))
        };
        // asin(1/5) is 11.54 degrees, and a few steps for rounding are half a degree.
        assert!(meets(0.0) && meets(11.5) && !meets(12.5) && !meets(90.0) && !meets(180.0));
    }
}

//! What can be seen from where rays start or end: for each of the first few spheres the cone of
//! directions in which such a ray can meet it.
//!
//! The camera's rays all start at the eye, shadow rays all end at a light (Haines and Greenberg's light
//! buffer, 1986, without its raster). Rays that leave a sphere start on it, and those that the first plane
//! mirrors come from the eye's image behind it. A product with the direction tells which spheres such a
//! ray needn't be tested with. A cone is wide enough for every rounding, so the picture is the same to
//! the bit.

use crate::math::{Arithmetic, sub};
use crate::scene::uses::{self, has};
use crate::scene::{Row, Scene, Source, View};
use crate::shape::Sphere;

/// So many spheres have their cones remembered. A list of more is better off with an octree.
pub(crate) const FEW: usize = 8;
/// So many lights are.
const LIGHTS: usize = 2;

/// Where a ray comes from, as far as it is known what can be seen from there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Vantage(u8);

/// So many vantage points that are no spheres have what is seen from them remembered,
const POINTS: usize = 2;
/// and so many spheres: each takes 132 bytes of memory.
const SPHERES: usize = 4;

impl Vantage {
    /// Nothing is known.
    pub(super) const ANYWHERE: Self = Self(u8::MAX);
    /// The eye.
    pub(super) const EYE: Self = Self(0);
    /// The eye's image behind the first plane.
    pub(super) const IMAGE: Self = Self(1);

    /// The surface of the sphere of this number, which rays leave to either side.
    #[inline(always)]
    pub(super) fn sphere(number: u32) -> Self {
        if number < SPHERES as u32 { Self(number as u8 + POINTS as u8) } else { Self::ANYWHERE }
    }
}

/// Whether all cones come before the first sphere: what is kept for a sphere's test then needn't make way for each
/// cone, where registers are few. Elsewhere a sphere's cone comes right before its test.
pub(super) const CONES_FIRST: bool = cfg!(narrow_multiply);

/// What rays have to do with a point.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Rays {
    /// They start there.
    Start,
    /// A plane has mirrored them: they would have started at this image of the eye.
    Mirrored,
    /// They end there.
    End,
}

/// Whether a sphere, so far away, is out of reach for rays that a plane beyond the horizon mirrors. Those start at points
/// that have been moved, at half that distance or more from the image, and lead away from it.
fn ends_before_horizon<A: Arithmetic>(way: &[A::Length; 3], radius: A::Length) -> bool {
    let whole = sum_of_sizes::<A>(way) + radius;
    whole + whole <= A::HORIZON
}

/// No less than the length of a vector.
fn sum_of_sizes<A: Arithmetic>(v: &[A::Length; 3]) -> A::Length {
    v.iter().fold(A::NO_LENGTH, |sum, &x| if x < A::NO_LENGTH { sum - x } else { sum + x })
}

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

    /// Looks from a point.
    fn look<const USES: u64>(
        &mut self,
        scene: &Scene<'_, A, USES>,
        point: &[A::Length; 3],
        rays: Rays,
    ) {
        *self = Self::ANY;
        let mut bit = 1;
        for (cone, sphere) in self.cones.iter_mut().zip(scene.shapes.spheres) {
            let center = sphere.center();
            let way = if rays == Rays::End { sub(point, &center) } else { sub(&center, point) };
            let is_known =
                rays != Rays::Mirrored || ends_before_horizon::<A>(&way, sphere.radius());
            if is_known
                && let Some(found) = A::direction_cone(&way, sphere.bound(), rays != Rays::Start)
            {
                *cone = found;
                // One that shows its inside alone hides nothing from within.
                self.outside |= if sphere.shows_inside_only::<USES>() { 0 } else { bit };
            }
            bit <<= 1;
        }
    }

    /// Looks from anywhere on the sphere of this number at the others: whether a ray meets that one itself,
    /// nobody asks here.
    fn look_from<const USES: u64>(&mut self, scene: &Scene<'_, A, USES>, number: usize) {
        *self = Self::ANY;
        let spheres = scene.shapes.spheres;
        let Some(from) = spheres.get(number) else { return };
        let from = (from.center(), from.bound());
        for (i, (cone, to)) in self.cones.iter_mut().zip(spheres).enumerate() {
            if i == number {
                *cone = A::NO_DIRECTION;
            } else if let Some(found) = A::pair_cone(&from, &(to.center(), to.bound())) {
                *cone = found;
            }
        }
    }

    /// A bit for each of the first spheres that a ray in a direction may meet.
    #[inline(always)]
    pub(super) fn ahead(&self, direction: &[A::Unit; 3], count: usize) -> u32 {
        self.cones
            .iter()
            .take(count)
            .rev()
            .fold(0, |found, cone| found << 1 | u32::from(A::in_cone(cone, direction)))
    }

    /// Whether a ray in a direction may meet the sphere of this number.
    #[inline(always)]
    pub(super) fn is_ahead(&self, number: u32, direction: &[A::Unit; 3]) -> bool {
        // A mask that is below the length: no check is left.
        A::in_cone(&self.cones[number as usize & (FEW - 1)], direction)
    }

    /// Whether the shape is a sphere that hides the point from all who are within.
    #[inline(always)]
    pub(super) fn hides_from(&self, shape: u32) -> bool {
        shape < FEW as u32 && self.outside >> (shape & 7) & 1 != 0
    }
}

/// Does something with all spheres, and their numbers, that a ray in a direction may meet, of those that are seen
/// from where it starts or ends: all, where that isn't known. A macro, since an iterator takes 4 to 8 % more
/// instructions.
macro_rules! each_ahead {
    ($sight:expr, $spheres:expr, $direction:expr, $tally:expr, |$sphere:ident, $id:ident| $act:expr) => {
        let first = $crate::trace::sight::CONES_FIRST;
        let mut ahead = match $sight {
            Some(sight) if first => sight.ahead($direction, $spheres.len()),
            _ => u32::MAX,
        };
        let mut spheres = $spheres.iter();
        let mut $id = 0;
        while ahead != 0
            && let Some($sphere) = spheres.next()
        {
            $tally.test();
            let found = if first {
                ahead & 1 != 0
            } else {
                $sight.is_none_or(|sight| sight.is_ahead($id, $direction))
            };
            if found {
                $act;
            }
            if first {
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

/// What can be seen from the eye, from its image behind the first plane, from the first spheres, and from the
/// first lights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sights<A: Arithmetic> {
    from: [Sight<A>; POINTS + SPHERES],
    lights: [Sight<A>; LIGHTS],
}

impl<A: Arithmetic> Sights<A> {
    /// Of no scene.
    pub(super) const NONE: Self =
        Self { from: [Sight::ANY; POINTS + SPHERES], lights: [Sight::ANY; LIGHTS] };

    /// Looks from an eye and from what stands in the scene. Nothing is left of the scene before.
    pub(super) fn look<const USES: u64>(
        &mut self,
        scene: &Scene<'_, A, USES>,
        eye: &[A::Length; 3],
    ) {
        if !may_be_few::<USES>() {
            // Nobody will ask.
            return;
        }
        *self = Self::NONE;
        if !are_few(scene) {
            return;
        }
        let [own, image, spheres @ ..] = &mut self.from;
        own.look(scene, eye, Rays::Start);
        if knows_all::<USES>() {
            if let Some(plane) = scene.parts.planes.first() {
                image.look(scene, &plane.image(eye), Rays::Mirrored);
            }
            for (number, sight) in spheres.iter_mut().enumerate() {
                sight.look_from(scene, number);
            }
        }
        for (sight, light) in self.lights.iter_mut().zip(scene.parts.lights) {
            if let Source::Point { position } | Source::Spot { position, .. } = &light.source {
                sight.look(scene, position, Rays::End);
            }
        }
    }

    /// What can be seen from where a ray comes from, if that is remembered.
    #[inline(always)]
    pub(super) fn from(&self, vantage: Vantage) -> Option<&Sight<A>> {
        self.from.get(usize::from(vantage.0))
    }

    /// What can be seen from a light, if that is remembered.
    #[inline(always)]
    pub(super) fn light(&self, number: u16) -> Option<&Sight<A>> {
        self.lights.get(usize::from(number))
    }
}

/// What is known of the spheres that a ray may meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ahead<'w, A: Arithmetic> {
    /// What can be seen from where it comes from.
    pub(super) sight: Option<&'w Sight<A>>,
    /// It meets none.
    pub(super) clear: bool,
}

impl<A: Arithmetic> Ahead<'_, A> {
    /// Nothing.
    pub(super) const ANYTHING: Self = Self { sight: None, clear: false };
}

/// The direction of a row's ray, out of line.
#[inline(never)]
fn towards<A: Arithmetic>(view: View<A>, row: Row<A>, x: u16) -> [A::Unit; 3] {
    view.ray(&row, x, 0).direction
}

/// Whether all spheres lie off the plane that the rays of a row lie in. By value: what a reference is taken of can't
/// stay in registers.
#[inline(never)]
pub(super) fn pass_all<A: Arithmetic>(
    spheres: &[Sphere<A>],
    view: View<A>,
    row: Row<A>,
    width: u16,
) -> bool {
    let (d, e) = (towards(view, row, 0), towards(view, row, width));
    let across = |i: usize, j: usize| A::product(d[i], e[j]) - A::product(d[j], e[i]);
    let normal = [across(1, 2), across(2, 0), across(0, 1)];
    let (_, length) = A::renormalize(&normal);
    spheres.iter().all(|sphere| {
        let way = sub(&sphere.center(), view.eye());
        let height = A::project(&way, &normal);
        // The normal and its length are wrong by less than six steps of a direction, and the rays by less
        // than one: eight times what rounding takes from a way as long as this.
        let slack = A::clearance(&way, sum_of_sizes::<A>(&way));
        let slack = slack + slack;
        let slack = slack + slack;
        let reach = A::scale(sphere.radius(), length) + slack + slack;
        height > reach || -height > reach
    })
}

/// Whether the spheres of a scene of this type may be few: code for that is worth having.
#[inline(always)]
pub(super) const fn may_be_few<const USES: u64>() -> bool {
    !has(USES, uses::TREE) || has(USES, uses::MANY_SPHERES)
}

/// Whether more is known than what is seen from the eye and the lights: in scenes of a type without a tree. Where
/// there may be one, all this would be code for scenes that have none.
#[inline(always)]
pub(super) const fn knows_all<const USES: u64>() -> bool {
    !has(USES, uses::TREE)
}

/// Whether all spheres have cones: they are few, and nothing but their list finds them.
#[inline(always)]
pub(super) fn are_few<A: Arithmetic, const USES: u64>(scene: &Scene<'_, A, USES>) -> bool {
    may_be_few::<USES>()
        && !(has(USES, uses::TREE) && scene.shapes.tree.is_some())
        && (!has(USES, uses::MANY_SPHERES) || scene.shapes.spheres.len() <= FEW)
}

#[cfg(test)]
mod tests;

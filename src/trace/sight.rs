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

    /// From a point: for rays that start there, or, `towards` it, for rays that end there.
    fn new<const USES: u64>(
        scene: &Scene<'_, A, USES>,
        point: &[A::Length; 3],
        towards: bool,
    ) -> Self {
        let mut sight = Self::ANY;
        let mut bit = 1;
        for (cone, sphere) in sight.cones.iter_mut().zip(scene.shapes.spheres) {
            let center = sphere.center();
            let way = if towards { sub(point, &center) } else { sub(&center, point) };
            if let Some(found) = A::direction_cone(&way, sphere.bound(), towards) {
                *cone = found;
                // One that shows its inside alone hides nothing from within.
                sight.outside |= if sphere.shows_inside_only::<USES>() { 0 } else { bit };
            }
            bit <<= 1;
        }
        sight
    }

    /// Whether the shape is a sphere that hides the point from all who are within.
    #[inline(always)]
    pub(super) fn hides_from(&self, shape: u32) -> bool {
        shape < FEW as u32 && self.outside >> (shape & 7) & 1 != 0
    }
}

/// What can be seen from the eye and from the first lights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sights<A: Arithmetic> {
    pub(super) eye: Sight<A>,
    lights: [Sight<A>; LIGHTS],
}

impl<A: Arithmetic> Sights<A> {
    /// From an eye and the scene's lights.
    pub(crate) fn new<const USES: u64>(scene: &Scene<'_, A, USES>, eye: &[A::Length; 3]) -> Self {
        let mut sights = Self { eye: Sight::ANY, lights: [Sight::ANY; LIGHTS] };
        if !are_few(scene) {
            return sights;
        }
        sights.eye = Sight::new(scene, eye, false);
        for (sight, light) in sights.lights.iter_mut().zip(scene.parts.lights) {
            if let Source::Point { position } | Source::Spot { position, .. } = &light.source {
                *sight = Sight::new(scene, position, true);
            }
        }
        sights
    }

    /// What can be seen from a light, if that is remembered.
    #[inline(always)]
    pub(super) fn light(&self, number: u16) -> Option<&Sight<A>> {
        self.lights.get(usize::from(number))
    }
}

/// Whether all spheres have cones: they are few, and nothing but their list finds them.
#[inline(always)]
pub(super) fn are_few<A: Arithmetic, const USES: u64>(scene: &Scene<'_, A, USES>) -> bool {
    !(has(USES, uses::TREE) && scene.shapes.tree.is_some())
        && (!has(USES, uses::MANY_SPHERES) || scene.shapes.spheres.len() <= FEW)
}

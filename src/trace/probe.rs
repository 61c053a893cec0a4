//! What a ray meets first, for tools that show more than radiance.

use super::{Hit, Tracer, Work};
use crate::math::Arithmetic;
use crate::scene::with_shape;
use crate::shape::{Meeting, Ray, Shape, Surface};
use crate::tally::Tally;

impl<A: Arithmetic> Tracer<'_, A> {
    /// The surface at the nearest hit along a ray, seen from where the ray starts.
    pub fn surface<T: Tally, const MAX_DEPTH: usize>(
        &self,
        ray: &Ray<A>,
        work: &mut Work<A, MAX_DEPTH>,
        tally: &mut T,
    ) -> Option<(Hit<A>, Surface<A>)> {
        let hit = self.nearest(ray, work, tally)?;
        let mut p = A::along(&ray.origin, hit.distance, &ray.direction);
        let meeting = Meeting { distance: hit.distance, detail: hit.detail };
        with_shape!(&self.scene.parts, hit.shape, shape => Some((hit, shape.surface(ray, &meeting, &mut p))), None)
    }
}

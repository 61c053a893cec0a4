//! What a ray meets first, for tools that show more than radiance.

use super::meet::surface_at;
use super::{Hit, Tracer, Work};
use crate::math::Arithmetic;
use crate::scene::{Scene, SceneRef};
use crate::shape::{Meeting, Ray, Surface};
use crate::tally::Tally;

impl<'s, A, S, const USES: u64> Tracer<S>
where
    A: Arithmetic,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
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
        surface_at(&self.scene, hit.shape, ray, &meeting, &mut p).map(|place| (hit, place.surface))
    }
}

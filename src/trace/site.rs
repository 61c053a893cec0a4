//! Places where diffuse light is wanted, for what fills irradiance caches and lays virtual lights.

use super::area::front_before;
use super::detail::painted;
use super::meet::surface_at;
use super::{Tracer, Work};
use crate::math::{Arithmetic, Rgb, largest, neg};
use crate::scene::uses::{self, has};
use crate::scene::{Scene, SceneRef};
use crate::shape::{Leaving, Meeting, Ray, Surface};
use crate::tally::{RayKind, Tally};

/// A point that a ray found.
pub(crate) struct Site<A: Arithmetic> {
    pub(crate) position: [A::Length; 3],
    pub(crate) surface: Surface<A>,
    /// A ray from there outwards; its direction is the mirror's.
    pub(crate) outside: Ray<A>,
    pub(crate) diffuse: Rgb<A::Weight>,
    /// Where a specular path goes on: through the surface if it transmits, else along the mirror
    /// direction if it reflects.
    pub(crate) next: Option<(RayKind, Ray<A>)>,
}

impl<A: Arithmetic> Site<A> {
    /// Whether the surface sends diffuse light back.
    pub(crate) fn is_diffuse(&self) -> bool {
        largest(&self.diffuse) > A::NO_WEIGHT
    }
}

impl<'s, A, S, const USES: u64> Tracer<S>
where
    A: Arithmetic,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    /// The point that a ray finds; one that gathers ends at the front of an invisible area light.
    #[inline(never)]
    pub(crate) fn site<T: Tally, const MAX_DEPTH: usize>(
        &self,
        kind: RayKind,
        ray: Ray<A>,
        work: &mut Work<A, MAX_DEPTH>,
        tally: &mut T,
    ) -> Option<Site<A>> {
        tally.ray(kind, 1, &ray, &[A::FULL; 3]);
        let hit = self.nearest(&ray, work, tally)?;
        if self.gathering && front_before(&self.scene, &ray, hit.distance).is_some() {
            return None;
        }
        tally.hit::<A>(kind, hit.shape, hit.distance);
        let mut position = A::along(&ray.origin, hit.distance, &ray.direction);
        let meeting = Meeting { distance: hit.distance, detail: hit.detail };
        let place = surface_at(&self.scene, hit.shape, &ray, &meeting, &mut position)?;
        let surface = place.surface;
        let material = self.scene.material_at(place.material, &place.local)?;
        let outside = Ray {
            origin: place.outside,
            direction: place.mirror,
            leaving: Leaving::back(hit.shape, &surface),
        };
        let mut next = None;
        if has(USES, uses::REFLECTION) && material.reflects {
            next = Some((RayKind::Reflection, outside));
        }
        if has(USES, uses::TRANSMISSION) && material.transmits {
            let eta = if surface.behind { &material.eta[1] } else { &material.eta[0] };
            let through = A::refract(&ray.direction, &surface.normal, surface.cosine, eta);
            next = Some(match through {
                Some(direction) => {
                    let origin = A::leave(&position, &neg(&surface.geometric), hit.distance);
                    let leaving = Leaving::through(hit.shape, &surface);
                    (RayKind::Transmission, Ray { origin, direction, leaving })
                }
                None => (RayKind::Reflection, outside),
            });
        }
        let diffuse = match material.texture() {
            Some(texture) if has(USES, uses::TEXTURES) => {
                painted(&self.scene, *material, texture, hit.shape, place.local).diffuse
            }
            _ => material.diffuse,
        };
        Some(Site { position, surface, outside, diffuse, next })
    }
}

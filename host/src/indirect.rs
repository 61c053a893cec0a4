//! Making the light that surfaces send each other, before a picture is rendered.

use whitted::gather::{
    Draft, Gatherer, GatheringSpec, Indirect, Record, VirtualLight, VirtualLights,
    VirtualLightsSpec,
};
use whitted::scene::{Camera, Scene};
use whitted::tally::Counts;
use whitted::trace::Work;

use crate::bake::{Baked, Construct};
use crate::document::{self, Size, distances};
use crate::error::{Flaw, Problem};
use crate::render::MAX_DEPTH;

/// How deep gathering rays see in mirrors and glass.
const GATHERING_DEPTH: u8 = 4;

/// The memory of irradiance records or virtual lights.
#[derive(Clone, Debug)]
pub struct Pools<A: Construct> {
    records: Vec<Record<A>>,
    lights: Vec<VirtualLight<A>>,
}

impl<A: Construct> Default for Pools<A> {
    fn default() -> Self {
        Self { records: Vec::new(), lights: Vec::new() }
    }
}

impl<A: Construct> Pools<A> {
    /// The scene with the light that `wanted` asks for, made for pictures of a size.
    ///
    /// # Errors
    /// The arithmetic can't hold the settings.
    pub fn light<'s>(
        &'s mut self,
        baked: &Baked<A>,
        scene: &Scene<'s, A>,
        camera: &Camera<A>,
        size: Size,
        wanted: Option<document::Indirect>,
        counts: &mut Counts,
    ) -> Result<Scene<'s, A>, Flaw> {
        let mut work = Work::<A, MAX_DEPTH>::new();
        let refused = |why: String| {
            Problem::Unrepresentable { what: "the settings of indirect light".into(), why }
                .anywhere()
        };
        let bounds = baked.document().bounds();
        let [near, far] = distances(bounds);
        let placed = |given: Option<f64>, default: f64| {
            given.map_or(default, |given| baked.placement.length(given))
        };
        let made = match wanted {
            None => Indirect::None,
            Some(document::Indirect::Cache(cache)) => {
                let (rings, sectors) = cache.strata();
                let nearest = placed(cache.nearest, near);
                let farthest = placed(cache.farthest, far.max(nearest)).max(nearest);
                // Sixty places each way at the end, and at least one in four pixels.
                let fine = (size.width.max(size.height) / 80).clamp(1, 4) as u8;
                let gathering = A::new_gathering(&GatheringSpec {
                    error: cache.error,
                    rings,
                    sectors,
                    nearest,
                    farthest,
                    bounces: cache.bounces as u8,
                    depth: GATHERING_DEPTH,
                    coarse: fine * 8,
                    fine,
                    seed: cache.seed as u16,
                })
                .map_err(|error| refused(error.to_string()))?;
                let room = cache.records as usize;
                self.records = vec![Record::NONE; room];
                let mut drafts = vec![Draft::NONE; if cache.bounces > 1 { room } else { 0 }];
                let side = |n: u32| u16::try_from(n).unwrap_or(u16::MAX);
                let filled = Gatherer::new(scene, gathering, &mut work, counts)
                    .and_then(|mut gatherer| {
                        let size = (side(size.width), side(size.height));
                        gatherer.fill(camera, size, &mut self.records, &mut drafts)
                    })
                    .map_err(|error| refused(error.to_string()))?;
                Indirect::Cache(filled)
            }
            Some(document::Indirect::VirtualLights(lights)) => {
                let settings = A::new_virtual_lights(&virtual_lights(baked, &lights))
                    .map_err(|error| refused(error.to_string()))?;
                self.lights = vec![VirtualLight::NONE; lights.lights as usize];
                let laid =
                    VirtualLights::lay(scene, &settings, &mut self.lights, &mut work, counts);
                Indirect::VirtualLights(laid)
            }
        };
        scene.with_indirect(made).map_err(|error| refused(error.to_string()))
    }
}

/// The core's settings of virtual lights, for the scene as it was placed.
pub(crate) fn virtual_lights<A: Construct>(
    baked: &Baked<A>,
    lights: &document::VirtualLights,
) -> VirtualLightsSpec {
    let bounds = baked.document().bounds();
    let [near, _] = distances(bounds);
    VirtualLightsSpec {
        bounces: lights.bounces as u8,
        tile: lights.tile as u8,
        nearest: lights.nearest.map_or(near, |given| baked.placement.length(given)),
        center: bounds.map_or([0.0; 3], |bounds| bounds.center()),
        radius: bounds.map_or(0.0, |bounds| bounds.side() * 0.75f64.sqrt()),
    }
}

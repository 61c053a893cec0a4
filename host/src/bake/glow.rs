//! The light that surfaces send each other, made on the host for a board that only reads it.

use whitted::gather::{
    Indirect, Record, RecordSpec, VirtualLight, VirtualLightSpec, VirtualLightsSpec,
};
use whitted::tally::Counts;

use super::{Baked, Construct};
use crate::document::{self, Size};
use crate::error::Flaw;
use crate::indirect::{Pools, virtual_lights};

/// Irradiance records or virtual lights, as the numbers that make them again to the bit.
#[derive(Clone, Debug, PartialEq)]
pub enum Glow {
    /// The scene asks for neither.
    None,
    /// An irradiance cache.
    Cache {
        /// Its records, in the order that they are asked in.
        records: Vec<RecordSpec>,
        /// Ward's limit of the error.
        error: f64,
    },
    /// Virtual lights.
    VirtualLights {
        /// Those, dark ones among them.
        lights: Vec<VirtualLightSpec>,
        /// How they are used.
        settings: VirtualLightsSpec,
    },
}

impl Glow {
    /// What it is, how many, and the bytes that they take in flash; `None` if there is none.
    pub fn size<A: Construct>(&self) -> Option<(&'static str, usize, usize)> {
        match self {
            Self::None => None,
            Self::Cache { records, .. } => {
                let count = records.len();
                Some(("irradiance records", count, count * size_of::<Record<A>>()))
            }
            Self::VirtualLights { lights, .. } => {
                let count = lights.len();
                Some(("virtual lights", count, count * size_of::<VirtualLight<A>>()))
            }
        }
    }
}

impl<A: Construct> Baked<A> {
    /// Makes what the scene asks for in `[indirect]`, as it is made to render pictures of this size.
    ///
    /// # Errors
    /// The arithmetic can't hold the settings.
    pub fn glow(&self, size: Size) -> Result<Glow, Flaw> {
        let Some(wanted) = self.placed.indirect else { return Ok(Glow::None) };
        let camera = self.camera(size)?;
        self.with_scene(|scene| {
            let (mut pools, mut counts) = (Pools::default(), Counts::default());
            let lit = pools.light(self, scene, &camera, size, Some(wanted), &mut counts)?;
            Ok(match (&lit.parts().indirect, wanted) {
                (Indirect::Cache(cache), document::Indirect::Cache(settings)) => Glow::Cache {
                    records: cache.records().iter().map(Record::spec).collect(),
                    error: settings.error,
                },
                (Indirect::VirtualLights(lights), document::Indirect::VirtualLights(settings)) => {
                    Glow::VirtualLights {
                        lights: lights.lights().iter().map(A::virtual_light_spec).collect(),
                        settings: virtual_lights(self, &settings),
                    }
                }
                _ => Glow::None,
            })
        })?
    }
}

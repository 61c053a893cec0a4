//! Diffuse interreflection: the light that surfaces send each other.
//!
//! The plain loop adds a constant ambient term for it. A scene can instead have an irradiance
//! cache ([`IrradianceCache`]), filled once by a [`Gatherer`] or laid in flash, or
//! virtual lights ([`VirtualLights`]); [`Scene::with_indirect`](crate::scene::Scene::with_indirect) gives it to
//! the scene. Then a point's diffuse coefficient times that irradiance is added, and the ambient
//! term isn't: the ambient irradiance is what the last bounce sees.

mod cache;
mod fill;
mod gradient;
mod halton;
mod hemisphere;
mod order;
mod record;
mod settings;
#[cfg(test)]
mod tests;
mod virtual_light;
mod walk;

pub use cache::IrradianceCache;
pub use fill::{Draft, FillError, Gatherer};
pub use record::{Record, RecordSpec};
pub use settings::{Gathering, GatheringSpec};
pub use virtual_light::{
    VirtualLight, VirtualLightSpec, VirtualLights, VirtualLightsSettings, VirtualLightsSpec,
};

use crate::math::Arithmetic;
use crate::scene::uses;

/// Where a scene's diffuse interreflection comes from.
#[derive(Clone, Copy, Debug, Default)]
pub enum Indirect<'a, A: Arithmetic> {
    /// The constant ambient term.
    #[default]
    None,
    /// Irradiance records.
    Cache(IrradianceCache<'a, A>),
    /// Virtual lights.
    VirtualLights(VirtualLights<'a, A>),
}

impl<A: Arithmetic> Indirect<'_, A> {
    /// The bits of [`uses`] that a scene needs for it.
    pub const fn uses(&self) -> u64 {
        match self {
            Self::None => 0,
            Self::Cache(_) => uses::IRRADIANCE_CACHE,
            Self::VirtualLights(_) => uses::VIRTUAL_LIGHTS,
        }
    }
}

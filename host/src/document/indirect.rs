//! The light that surfaces send each other.

use super::Bounds;

/// How it is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Indirect {
    /// By irradiance records that rays gather.
    Cache(Cache),
    /// By virtual lights.
    VirtualLights(VirtualLights),
}

/// An irradiance cache: see the core's `GatheringSpec`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cache {
    /// Ward's limit of the error.
    pub error: f64,
    /// Rays a record, about.
    pub rays: u32,
    /// How often light is passed on.
    pub bounces: u32,
    /// How many records there may be.
    pub records: u32,
    /// The harmonic mean distance is taken for no less…
    pub nearest: Option<f64>,
    /// …and for no more.
    pub farthest: Option<f64>,
    /// Which of the random directions.
    pub seed: u32,
}

impl Cache {
    /// What isn't said.
    pub const DEFAULT: Self = Self {
        error: 0.2,
        rays: 64,
        bounces: 2,
        records: 2000,
        nearest: None,
        farthest: None,
        seed: 0,
    };

    /// Rings and sectors of about so many rays: cells as wide as they are high.
    pub fn strata(&self) -> (u8, u8) {
        let rays = f64::from(self.rays);
        let rings = (rays / std::f64::consts::PI).sqrt().round().clamp(1.0, 16.0);
        (rings as u8, (rays / rings).round().clamp(1.0, 64.0) as u8)
    }
}

/// Virtual lights: see the core's `VirtualLightsSpec`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VirtualLights {
    /// How many.
    pub lights: u32,
    /// How often light is passed on.
    pub bounces: u32,
    /// The side of the tile whose pixels take turns.
    pub tile: u32,
    /// A distance is taken for no less.
    pub nearest: Option<f64>,
}

impl VirtualLights {
    /// What isn't said.
    pub const DEFAULT: Self = Self { lights: 256, bounces: 2, tile: 1, nearest: None };
}

/// A fortieth and a third of the scene's side, where it doesn't say: the least and the largest
/// distance that counts.
pub fn distances(bounds: Option<Bounds>) -> [f64; 2] {
    let side = bounds.map(|bounds| bounds.side()).filter(|side| *side > 0.0).unwrap_or(20.0);
    [side / 40.0, side / 3.0]
}

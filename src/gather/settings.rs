//! How an irradiance cache is filled.

use super::cache::OVERLAP;
use super::hemisphere::{MAX_RINGS, Strata};
use crate::math::{Arithmetic, for_each_arithmetic};
use crate::shape::{ShapeError, ok_or_panic, some_or};

/// How an irradiance cache is filled, in plain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GatheringSpec {
    /// The limit a of Ward's error, 0.05 to 1: smaller gives more records.
    pub error: f64,
    /// Rings that the hemisphere is cut into, 1 to 16.
    pub rings: u8,
    /// Sectors, 1 to 64. A ray is sent through each cell; three times as many sectors as rings
    /// give cells that are as wide as they are high.
    pub sectors: u8,
    /// The harmonic mean distance is taken for at least this, so that corners don't take all
    /// records…
    pub nearest: f64,
    /// …and for at most this.
    pub farthest: f64,
    /// How many times light is passed from surface to surface, 1 to 16.
    pub bounces: u8,
    /// How deep the tree of a gathering ray may be: 1 sees no mirrors and no glass.
    pub depth: u8,
    /// The camera's rays that look for places for records start so many pixels apart…
    pub coarse: u8,
    /// …and end so many apart, each time with half the distance; at least 1.
    pub fine: u8,
    /// Which of the random directions.
    pub seed: u16,
}

impl GatheringSpec {
    /// 65 rays a record, a = 0.2, one bounce, for a scene some ten units across.
    pub const DEFAULT: Self = Self {
        error: 0.2,
        rings: 5,
        sectors: 13,
        nearest: 0.25,
        farthest: 4.0,
        bounces: 1,
        depth: 2,
        coarse: 32,
        fine: 4,
        seed: 0,
    };
}

/// How an irradiance cache is filled.
#[derive(Clone, Copy, Debug)]
pub struct Gathering<A: Arithmetic> {
    pub(super) strata: Strata,
    /// The smallest and the largest harmonic mean distance.
    pub(super) nearest: A::Length,
    pub(super) farthest: A::Length,
    /// The limit of the error with the overlap, over 2: below 1.
    pub(super) half_limit: A::Unit,
    pub(super) sharpness: A::Weight,
    pub(super) bounces: u8,
    pub(super) depth: u8,
    pub(super) coarse: u8,
    pub(super) fine: u8,
    pub(super) seed: u16,
}

impl<A: Arithmetic> Gathering<A> {
    /// Rays a record.
    pub fn rays(&self) -> u16 {
        self.strata.count() as u16
    }

    /// How many times light is passed on.
    pub fn bounces(&self) -> u8 {
        self.bounces
    }

    /// How deep the tree of a gathering ray may be.
    pub fn depth(&self) -> u8 {
        self.depth
    }
}

for_each_arithmetic! {
    impl Gathering<A> {
        /// The settings, for `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(spec: GatheringSpec) -> Self {
            ok_or_panic!(Self::try_new(&spec))
        }

        /// The settings.
        ///
        /// # Errors
        /// A number that is out of its range.
        pub const fn try_new(spec: &GatheringSpec) -> Result<Self, ShapeError> {
            let error = spec.error;
            if !(error >= 0.05 && error <= 1.0)
                || spec.rings == 0
                || spec.rings as usize > MAX_RINGS
                || spec.sectors == 0
                || spec.sectors > 64
                || spec.bounces == 0
                || spec.bounces > 16
                || spec.depth == 0
                || spec.fine == 0
                || spec.coarse < spec.fine
            {
                return Err(ShapeError::Coefficient);
            }
            if !(spec.nearest > 0.0 && spec.nearest <= spec.farthest) {
                return Err(ShapeError::Size);
            }
            let sharpness = 1.0 / (core::f64::consts::SQRT_2 * OVERLAP * error);
            Ok(Self {
                strata: Strata { rings: spec.rings as u32, sectors: spec.sectors as u32 },
                nearest: some_or!(make::length(spec.nearest), Size),
                farthest: some_or!(make::length(spec.farthest), Size),
                half_limit: some_or!(make::unit(error * OVERLAP / 2.0), Coefficient),
                sharpness: some_or!(make::weight(sharpness), Coefficient),
                bounces: spec.bounces,
                depth: spec.depth,
                coarse: spec.coarse,
                fine: spec.fine,
                seed: spec.seed,
            })
        }
    }
}

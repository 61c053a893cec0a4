//! Which lights a point asks.
//!
//! Where there are many lights, most give a point little. What a light would give, were nothing in
//! its way, is known before a shadow ray is sent: for a point light exactly, for an area by its
//! centre. Lights below a threshold can be left out; or one light, or a few, are chosen at random,
//! each with a probability p proportional to what it would give, and what it does give is divided
//! by p, so that the mean is right (Shirley, Wang, Zimmerman, "Monte Carlo techniques for direct
//! lighting calculations", 1996).

use crate::math::{Arithmetic, for_each_arithmetic};
use crate::shape::{ShapeError, ok_or_panic, some_or};

/// Which lights a point asks.
#[derive(Clone, Copy, Debug)]
pub enum Selection<A: Arithmetic> {
    /// All.
    All,
    /// Those that would add at least this to some channel of the pixel.
    Above(A::Radiance),
    /// So many, chosen at random by what they would add; none for 0. The random numbers come from
    /// the pixel's coordinates and the scene's seed ([`light_jitter`](super::Parts::light_jitter)).
    Choose(u8),
}

for_each_arithmetic! {
    impl Selection<A> {
        /// Lights that would add at least `radiance` to a channel, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_above`](Self::try_above) has an error.
        pub const fn above(radiance: f64) -> Self {
            ok_or_panic!(Self::try_above(radiance))
        }

        /// Lights that would add at least `radiance` to a channel.
        ///
        /// # Errors
        /// A radiance that is negative, no number or above 1024.
        pub const fn try_above(radiance: f64) -> Result<Self, ShapeError> {
            Ok(Self::Above(some_or!(make::radiance(radiance), Coefficient)))
        }
    }
}

//! What a ray that hits nothing sees.

use super::{Point, Rgb};

/// The radiance of a direction d.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// The same everywhere.
    Color(Rgb),
    /// `bottom + (top − bottom)·(d·up + 1)/2`.
    Gradient {
        /// Opposite to `up`.
        bottom: Rgb,
        /// In the direction of `up`.
        top: Rgb,
        /// The axis, of any length.
        up: Point,
    },
}

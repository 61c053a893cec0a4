//! Where a shape lies, in whole numbers: what the builder, a const fn, can compute with.
//!
//! The numbers are in steps: 2⁻¹⁶ for fixed point, whose coordinates they are; for
//! floating point a power of two chosen so that the scene spans about 2²⁶ steps.

/// Where a shape lies, in steps: 2⁻¹⁶ in fixed point, a power of two of one's choice in floating point,
/// such that the scene spans about 2²⁶ of them. Rounded to nearest, so the builder adds a margin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Anywhere within a box.
    Box {
        /// The smallest coordinates.
        min: [i32; 3],
        /// The largest coordinates.
        max: [i32; 3],
    },
    /// On a sphere.
    Sphere {
        /// The centre.
        center: [i32; 3],
        /// The radius.
        radius: i32,
    },
    /// On the wall of a cone, a frustum or a cylinder, or within it.
    Round {
        /// The middles of its two circles.
        ends: [[i32; 3]; 2],
        /// Their radii.
        radii: [i32; 2],
        /// Whether there is nothing inside of the wall, nor at the ends.
        hollow: bool,
    },
    /// Within a triangle.
    Triangle {
        /// The corners.
        corners: [[i32; 3]; 3],
    },
}

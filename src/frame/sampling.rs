//! The samplings: how a picture's rays are chosen.

use super::FrameError;
use crate::scene::uses;

/// Where a picture's rays go, and what becomes of them.
///
/// Every pixel's value depends on its place and these settings alone: a picture is the same to the
/// bit drawn whole, by lines in any order, by bands, or in part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampling {
    /// One ray through the centre of each pixel.
    #[default]
    Center,
    /// One through each pixel's corner, the mean of four making a pixel: (W + 1)·(H + 1) rays, as
    /// the Standard Procedural Databases ask. Remembers a row of W + 2 samples.
    Corners,
    /// One through the middle of each of `side`×`side` cells of the pixel, averaged.
    Grid {
        /// 1 to 8.
        side: u8,
    },
    /// One at random within each of `side`×`side` cells, averaged: regular patterns turn into
    /// noise. The same seed gives the same picture on every machine.
    Jittered {
        /// 1 to 8.
        side: u8,
        /// Which of the random pictures.
        seed: u16,
    },
    /// One through each pixel's corner; where a pixel's four differ in colour, object or shadow it
    /// is halved both ways, and its quarters likewise (Whitted 1980). Remembers a row of W + 2
    /// samples and the (2^depth + 1)² of one pixel.
    Adaptive {
        /// How often a pixel may be halved, 1 to 4: up to (2^depth + 1)² rays.
        depth: u8,
        /// Colours differ if one channel of 8-bit sRGB does by more than this.
        threshold: u8,
    },
    /// One through the centre of every `side`-th pixel of every `side`-th row; where the four
    /// corners of such a block differ in colour, object or shadow it is halved both ways, down to
    /// single pixels; the others are interpolated (Akimoto et al., "Pixel-selected ray tracing",
    /// 1991). Remembers `side`/2 + 1 rows of W/2 + 1 samples, W being rounded up to whole blocks.
    Sparse {
        /// 2, 4, 8 or 16.
        side: u8,
        /// Colours differ if one channel of 8-bit sRGB does by more than this.
        threshold: u8,
    },
}

impl Sampling {
    /// Adaptive sampling as it serves most scenes.
    pub const ADAPTIVE: Self = Self::Adaptive { depth: 3, threshold: 8 };
    /// Sparse sampling as it serves most scenes.
    pub const SPARSE: Self = Self::Sparse { side: 4, threshold: 8 };

    /// How many samples the renderer must remember for pictures of this width.
    pub const fn samples(self, width: u16) -> usize {
        match self {
            Self::Center | Self::Grid { .. } | Self::Jittered { .. } => 0,
            Self::Corners => width as usize + 2,
            Self::Adaptive { depth, .. } => width as usize + 2 + lattice(depth),
            Self::Sparse { side, .. } => stride(width, side) * (side as usize / 2 + 1),
        }
    }

    /// What a tailored scene must name among its uses besides [its parts'
    /// own](crate::scene::Parts::uses) to be rendered like this: `{ PARTS.uses() |
    /// Sampling::SPARSE.uses() }`.
    pub const fn uses(self) -> u64 {
        match self {
            Self::Center => 0,
            Self::Corners => uses::CORNERS,
            Self::Grid { .. } | Self::Jittered { .. } => uses::CELLS,
            Self::Adaptive { .. } => uses::ADAPTIVE,
            Self::Sparse { .. } => uses::SPARSE,
        }
    }

    /// Whether the numbers are within their ranges.
    pub(super) const fn check(self) -> Result<(), FrameError> {
        match self {
            Self::Grid { side } | Self::Jittered { side, .. } if side < 1 || side > 8 => {
                Err(FrameError::Cells { side })
            }
            Self::Adaptive { depth, .. } if depth < 1 || depth > 4 => {
                Err(FrameError::Halvings { depth })
            }
            Self::Sparse { side, .. } if side < 2 || side > 16 || !side.is_power_of_two() => {
                Err(FrameError::Block { side })
            }
            _ => Ok(()),
        }
    }
}

/// How many samples the finest lattice of a pixel has.
pub(super) const fn lattice(depth: u8) -> usize {
    let points = (1usize << (depth & 7)) + 1;
    points * points
}

/// How many samples a row of sparse sampling has: every other pixel's, and the end of the last
/// block.
#[inline(always)]
pub(super) const fn stride(width: u16, side: u8) -> usize {
    let shift = side.trailing_zeros();
    let blocks = (width as usize + side as usize).wrapping_sub(1) >> shift;
    (blocks << shift) / 2 + 1
}

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
    /// One through each pixel's corner and one through its centre; where the five differ in colour,
    /// object or shadow, in the pixel or in the one beside it, the pixel is cut into cells: 2×2, or
    /// 4×4 and those that differ from their neighbours again. Remembers a row of W + 28 samples.
    Adaptive {
        /// How often a pixel may be halved, 1 to 3: the smallest cells are 2×2, 4×4 or 8×8.
        depth: u8,
        /// Colours differ if one channel of 8-bit sRGB does by more than this; those of cells if by
        /// more than half as much again.
        threshold: u8,
    },
    /// One through the centre of every `side`-th pixel of every `side`-th row; then one in the middle of
    /// such a block, and of its sides, where the samples around it differ, and so on in its quarters down
    /// to single pixels; the others are interpolated (after Akimoto et al., "Pixel-selected ray tracing",
    /// 1991). It goes by what is shown: by the output's exposure and curve. Remembers `side`/2 + 2 rows of
    /// W/2 + 1 rays, one of W/`side` + 1, and one of W pixels, W being rounded up to whole blocks, four
    /// pixels at least; four rays take three samples, two pixels one.
    Sparse {
        /// 2, 4, 8 or 16.
        side: u8,
        /// Colours differ if one channel does by more than this, of 255; by half as much again if they cost
        /// many rays each.
        threshold: u8,
    },
}

impl Sampling {
    /// Adaptive sampling as it serves most scenes.
    pub const ADAPTIVE: Self = Self::Adaptive { depth: 3, threshold: 14 };
    /// Sparse sampling as it serves most scenes.
    pub const SPARSE: Self = Self::Sparse { side: 4, threshold: 19 };

    /// How many samples the renderer must remember for pictures of this width.
    pub const fn samples(self, width: u16) -> usize {
        match self {
            Self::Center | Self::Grid { .. } | Self::Jittered { .. } => 0,
            Self::Corners => width as usize + 2,
            Self::Adaptive { .. } => width as usize + 28,
            // Four words each.
            Self::Sparse { side, .. } => {
                (3 * slots(width, side) + 2 * row(width, side)).div_ceil(4)
            }
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
            Self::Adaptive { depth, .. } if depth < 1 || depth > 3 => {
                Err(FrameError::Halvings { depth })
            }
            Self::Sparse { side, .. } if side < 2 || side > 16 || !side.is_power_of_two() => {
                Err(FrameError::Block { side })
            }
            _ => Ok(()),
        }
    }
}

/// How many blocks of sparse sampling there are in a row.
#[inline(always)]
pub(super) const fn blocks(width: u16, side: u8) -> usize {
    (width as usize + side as usize).wrapping_sub(1) >> side.trailing_zeros()
}

/// How many pixels a row of sparse sampling has: whole blocks, and four at a time.
#[inline(always)]
pub(super) const fn row(width: u16, side: u8) -> usize {
    let side = if side < 4 { 4 } else { side };
    blocks(width, side) << side.trailing_zeros()
}

/// How many slots it has: every other pixel's, and the end of the last block.
#[inline(always)]
pub(super) const fn stride(width: u16, side: u8) -> usize {
    row(width, side) / 2 + 1
}

/// How many rays sparse sampling remembers: at even coordinates for a row of blocks and its lower edge,
/// the middles of the smallest blocks of two rows of pixels, and the corners of the next row of blocks.
#[inline(always)]
pub(super) const fn slots(width: u16, side: u8) -> usize {
    stride(width, side) * (side as usize / 2 + 2) + blocks(width, side) + 1
}

//! Where sparse sampling remembers what.

use crate::frame::sampling::{blocks, stride};

/// How the memory is laid out: samples at even coordinates for a row of blocks, its lower edge among
/// them; the middles of the smallest blocks of two rows of pixels; the corners of the next row of
/// blocks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub(super) side: u16,
    pub(super) log2_side: u32,
    /// Samples in a row.
    pub(super) stride: usize,
    /// Blocks in a row.
    pub(super) blocks: usize,
    /// From a block's corner to the next, in a row.
    pub(super) step: usize,
    /// The lower edge.
    pub(super) lower: usize,
    /// The middles of the smallest blocks.
    pub(super) middles: usize,
    /// The corners of the next row of blocks, one after the other.
    pub(super) next: usize,
    /// How many samples that is.
    pub(super) all: usize,
}

impl Layout {
    pub(super) const fn new(width: u16, side: u8) -> Self {
        let (stride, blocks) = (stride(width, side), blocks(width, side));
        let step = (side >> 1) as usize;
        let lower = step.wrapping_mul(stride);
        let next = lower + 2 * stride;
        Self {
            side: side as u16,
            log2_side: side.trailing_zeros(),
            stride,
            blocks,
            step,
            lower,
            middles: lower + stride,
            next,
            all: next + blocks + 1,
        }
    }

    /// From a sample to that so many pixels right of and below it.
    #[inline(always)]
    pub(super) fn offset(&self, right: u16, down: u16) -> usize {
        usize::from(down >> 1).wrapping_mul(self.stride).wrapping_add(usize::from(right >> 1))
    }
}

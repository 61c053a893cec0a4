//! Where sparse sampling remembers what.

use crate::frame::sampling::{blocks, row, slots, stride};

/// How the memory is laid out, in words: first the row of pixels that is shown, two words each; then, for
/// each *slot*, the word that is compared, and after all of these the two words of its display values.
///
/// Slots are samples at even coordinates for a row of blocks, its lower edge among them; the middles of
/// the smallest blocks of two rows of pixels; the corners of the next row of blocks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub(super) side: u16,
    pub(super) log2_side: u32,
    /// Slots in a row.
    pub(super) stride: usize,
    /// Blocks in a row.
    pub(super) blocks: usize,
    /// From a block's corner to the next, in a row.
    pub(super) step: usize,
    /// The lower edge.
    pub(super) lower: usize,
    /// The middles of the smallest blocks, behind one that stays empty.
    middles: usize,
    /// The corners of the next row of blocks, one after the other.
    pub(super) next: usize,
    /// How many slots that is.
    pub(super) all: usize,
    /// Words of the row of pixels.
    pub(super) row: usize,
    /// The first word of the slots' display values.
    pub(super) values: usize,
}

impl Layout {
    pub(super) const fn new(width: u16, side: u8) -> Self {
        let (stride, blocks) = (stride(width, side), blocks(width, side));
        let step = (side >> 1) as usize;
        let lower = step.wrapping_mul(stride);
        let (all, row) = (slots(width, side), 2 * row(width, side));
        Self {
            side: side as u16,
            log2_side: side.trailing_zeros(),
            stride,
            blocks,
            step,
            lower,
            middles: lower + stride,
            next: lower + 2 * stride,
            all,
            row,
            values: row + all,
        }
    }

    /// From a slot to that so many pixels right of and below it.
    #[inline(always)]
    pub(super) fn offset(&self, right: u16, down: u16) -> usize {
        usize::from(down >> 1).wrapping_mul(self.stride).wrapping_add(usize::from(right >> 1))
    }

    /// The middle of the smallest block at a column.
    #[inline(always)]
    pub(super) fn middle_at(&self, x: u16) -> usize {
        self.middles + 1 + usize::from(x >> 1)
    }

    /// The corners of a block, row by row.
    #[inline(always)]
    pub(super) fn corners(&self, corner: usize, side: u16) -> [usize; 4] {
        let below = corner + self.offset(0, side);
        let right = self.offset(side, 0);
        [corner, corner + right, below, below + right]
    }

    /// The middle of a block.
    #[inline(always)]
    pub(super) fn middle(&self, corner: usize, side: u16) -> usize {
        corner + self.offset(side >> 1, side >> 1)
    }

    /// The middles of a block's sides: left, right, above, below.
    #[inline(always)]
    pub(super) fn sides(&self, corner: usize, side: u16) -> [usize; 4] {
        let half = side >> 1;
        let (right, down) = (self.offset(side, half), self.offset(half, side));
        [
            corner + self.offset(0, half),
            corner + right,
            corner + self.offset(half, 0),
            corner + down,
        ]
    }
}

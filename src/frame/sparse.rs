//! Sparse sampling: a ray for some pixels, the others interpolated.
//!
//! The picture is cut into blocks of side s. Rays go through the centres of the pixels at the
//! blocks' corners. Where the four differ, five more go through the middles of the sides and of the
//! block, which makes four blocks of half the side; the pixels of a block whose corners don't differ
//! are interpolated between them, first down, then across. Beyond the right and the lower edge a block's
//! corners are the last pixels' samples.
//!
//! Blocks of side 2 and more have their corners at even coordinates: only those samples are
//! remembered, for a row of blocks. A pixel at an odd one that isn't interpolated is traced when it
//! is asked for. A block's middle is known just if the block was divided, which is how a pixel finds
//! the block it belongs to.

use super::renderer::Remembered;
use super::sample::differ;
use super::sampling::stride;
use super::{Renderer, Sample};
use crate::math::{Arithmetic, Rgb, rgb};
use crate::tally::Tally;

/// The value `i`/`side` of the way from `a` to `b`, by halving: `side` is a power of two.
#[inline(always)]
fn between<A: Arithmetic>(
    a: Rgb<A::Radiance>,
    b: Rgb<A::Radiance>,
    i: u16,
    side: u16,
) -> Rgb<A::Radiance> {
    let (mut low, mut high, mut left, mut half) = (a, b, i, side >> 1);
    while left != 0 && half != 0 {
        let middle = rgb(&low, &high, |a, b| A::mean(A::gather(a, b), 2));
        if left >= half {
            low = middle;
            left -= half;
        } else {
            high = middle;
        }
        half >>= 1;
    }
    low
}

impl<A: Arithmetic, const MAX_DEPTH: usize, T: Tally, const USES: u64>
    Renderer<'_, A, MAX_DEPTH, T, USES>
{
    /// The pixel at (x, y), traced or interpolated.
    #[inline(never)]
    pub(super) fn sparse(
        &mut self,
        x: u16,
        y: u16,
        columns: (u16, u16),
        side: u8,
        threshold: u8,
    ) -> Rgb<A::Radiance> {
        let mask = u16::from(side) - 1;
        if x == columns.0 {
            let wanted = Remembered { y: y & !mask, columns };
            if self.remembered != Some(wanted) {
                self.fill(wanted, side, threshold);
            }
        }
        let stride = stride(self.settings.width, side);
        // Where the pixel lies in the smallest block around it, and where that begins.
        let (mut right, mut down, mut side) = (x & mask, y & mask, u16::from(side));
        let place = |x: u16, row: u16| usize::from(row >> 1) * stride + usize::from(x >> 1);
        let mut corner = place(x - right, 0);
        loop {
            let half = side >> 1;
            let steps = usize::from(half);
            let corners = [0, steps, steps * stride, steps * stride + steps]
                .map(|offset| self.remembered(corner + offset));
            // The middle tells whether the block was divided; the smallest ones have none.
            let divided = if side > 2 {
                let middle = corner + place(half, half);
                self.remembered(middle).is_known()
            } else {
                differ(&corners, threshold)
            };
            if !divided {
                let [a, b, c, d] = corners.map(|sample| sample.radiance);
                let left = between::<A>(a, c, down, side);
                return between::<A>(left, between::<A>(b, d, down, side), right, side);
            }
            if side == 2 {
                if right | down == 0 {
                    return corners[0].radiance;
                }
                return self.trace(&self.view.row(y, 128), x, 128);
            }
            if right >= half {
                right -= half;
                corner += place(half, 0);
            }
            if down >= half {
                down -= half;
                corner += place(0, half);
            }
            side = half;
        }
    }

    /// Traces what a row of blocks needs, at even coordinates.
    fn fill(&mut self, wanted: Remembered, side: u8, threshold: u8) {
        let stride = stride(self.settings.width, side);
        let last = usize::from(side >> 1) * stride;
        let Remembered { y, columns } = wanted;
        let side = u16::from(side);
        // The lower edge of the row above is the upper edge of this one.
        let above = Remembered { y: y.wrapping_sub(side), columns };
        let follows = self.remembered == Some(above);
        for i in 0..stride {
            let edge = if follows { self.remembered(last + i) } else { Sample::NONE };
            self.remember(i, edge);
        }
        for i in stride..stride + last {
            self.remember(i, Sample::NONE);
        }
        let mut x = columns.0 & !(side - 1);
        while x < columns.1 {
            self.divide(x, y, side, stride, threshold);
            x += side;
        }
        self.remembered = Some(wanted);
    }

    /// Traces the corners of a block and of the blocks in it that are worth dividing.
    fn divide(&mut self, x: u16, y: u16, whole: u16, stride: usize, threshold: u8) {
        for (right, down) in [(0, 0), (whole, 0), (0, whole), (whole, whole)] {
            self.corner(x + right, y, down, stride);
        }
        let place =
            |right: u16, down: u16| usize::from(down >> 1) * stride + usize::from((x + right) >> 1);
        let mut side = whole;
        while side > 2 {
            let half = side >> 1;
            let mut down = 0;
            while down < whole {
                let mut right = 0;
                while right < whole {
                    // The middle of the block that this is a quarter of.
                    let middle = place(right & !side | side, down & !side | side);
                    if side == whole || self.remembered(middle).is_known() {
                        let four = [(0, 0), (side, 0), (0, side), (side, side)]
                            .map(|(i, j)| self.remembered(place(right + i, down + j)));
                        if differ(&four, threshold) {
                            for (i, j) in
                                [(half, 0), (0, half), (half, half), (side, half), (half, side)]
                            {
                                self.corner(x + right + i, y, down + j, stride);
                            }
                        }
                    }
                    right += side;
                }
                down += side;
            }
            side = half;
        }
    }

    /// Traces the pixel at x of row `y + down`, if it hasn't been; beyond an edge, the last pixel.
    fn corner(&mut self, x: u16, y: u16, down: u16, stride: usize) {
        let place = usize::from(down >> 1) * stride + usize::from(x >> 1);
        if self.remembered(place).is_known() {
            return;
        }
        let row = (y + down).min(self.settings.height - 1);
        let x = x.min(self.settings.width - 1);
        let sample = self.sample(&self.view.row(row, 128), x, 128);
        self.remember(place, sample);
    }
}

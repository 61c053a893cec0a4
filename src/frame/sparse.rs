//! Sparse sampling: a ray for some pixels, the others interpolated.
//!
//! The picture is cut into blocks of side s. Rays go through the centres of the pixels at the
//! blocks' corners. A block is divided where its four differ, or those of a block beside it: what
//! passes between the corners of one rarely does so of all. Five more rays, through the middles of the
//! sides and of the block, make four blocks of half the side, and those whose corners differ are
//! divided again. Of the smallest, of side 2, the middle is traced if the corners differ in colour, and
//! the pixel between two corners if these or the middle do. What isn't traced is interpolated between
//! the corners of its block, first down, then across. Beyond the right and the lower edge a block's
//! corners are the last pixels' samples.
//!
//! Blocks have their corners at even coordinates: those samples are remembered for a row of
//! blocks, the lower edge becoming the next row's upper one. Behind them lie the middles of the
//! smallest blocks of two rows of pixels, and the corners of the next row of blocks, which say
//! whether those of this one are to be divided. The mark of a block's upper left corner says that
//! it is; for smaller ones their middle does, which is known just if they were.

use super::renderer::Remembered;
use super::sample::{differ, differ_in_color};
use super::sampling::{blocks, stride};
use super::{Renderer, Sample};
use crate::math::{Arithmetic, Rgb, rgb};
use crate::tally::Tally;

/// The middle between two.
#[inline(always)]
fn mean<A: Arithmetic>(a: &Rgb<A::Radiance>, b: &Rgb<A::Radiance>) -> Rgb<A::Radiance> {
    rgb(a, b, |a, b| A::mean(A::gather(a, b), 2))
}

/// How the memory is laid out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    side: u16,
    log2_side: u32,
    /// Samples in a row.
    stride: usize,
    /// Blocks in a row.
    blocks: usize,
    /// From a block's corner to the next, in a row.
    step: usize,
    /// The lower edge.
    lower: usize,
    /// The middles of the smallest blocks.
    middles: usize,
    /// The corners of the next row of blocks, one after the other.
    next: usize,
}

impl Layout {
    const fn new(width: u16, side: u8) -> Self {
        let stride = stride(width, side);
        let step = (side >> 1) as usize;
        let lower = step * stride;
        Self {
            side: side as u16,
            log2_side: side.trailing_zeros(),
            stride,
            blocks: blocks(width, side),
            step,
            lower,
            middles: lower + stride,
            next: lower + 2 * stride,
        }
    }

    /// From a sample to that so many pixels right of and below it.
    #[inline(always)]
    fn offset(&self, right: u16, down: u16) -> usize {
        usize::from(down >> 1) * self.stride + usize::from(right >> 1)
    }
}

/// Pixels of a row that lie in one undivided block.
#[derive(Clone, Copy, Debug)]
struct Run<A: Arithmetic> {
    /// At the block's left edge.
    left: Rgb<A::Radiance>,
    /// From a pixel to the next.
    step: Rgb<A::Radiance>,
    /// The block's first column.
    start: u16,
    /// The column behind the last; 0 for none.
    end: u16,
}

/// What sparse sampling remembers besides samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sparse<A: Arithmetic> {
    layout: Layout,
    run: Run<A>,
    /// For which pair of rows the middles of the smallest blocks are remembered.
    middles: Option<Remembered>,
}

impl<A: Arithmetic> Sparse<A> {
    /// For pictures of this width; a side of 0 where sampling isn't sparse.
    pub(super) const fn new(width: u16, side: u8) -> Self {
        let run = Run { left: [A::BLACK; 3], step: [A::BLACK; 3], start: 0, end: 0 };
        let side = if side == 0 { 2 } else { side };
        Self { layout: Layout::new(width, side), run, middles: None }
    }

    /// The pixel at x if it lies in the same undivided block as the one before.
    #[inline(always)]
    pub(super) fn goes_on(&self, x: u16, columns: (u16, u16)) -> Option<Rgb<A::Radiance>> {
        let Run { left, step, start, end } = &self.run;
        (x < *end && x != columns.0).then(|| rgb(left, step, |a, b| A::steps(a, b, x - start)))
    }
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
        threshold: u8,
    ) -> Rgb<A::Radiance> {
        if x == columns.0 {
            self.begin_sparse(y, columns, threshold);
        }
        let layout = self.sparse.layout;
        let mask = layout.side - 1;
        // Where the pixel lies in the smallest block around it, and where that begins.
        let (mut right, mut down, mut side) = (x & mask, y & mask, layout.side);
        let mut corner = usize::from((x - right) >> 1);
        let mut divided = self.at(corner).is_marked();
        while divided && side > 2 {
            // Into the quarter around the pixel.
            side >>= 1;
            if right >= side {
                right -= side;
                corner += layout.offset(side, 0);
            }
            if down >= side {
                down -= side;
                corner += layout.offset(0, side);
            }
            // The smallest have no middle of their own.
            divided = side == 2 || self.at(corner + layout.offset(side >> 1, side >> 1)).is_known();
        }
        if !divided {
            let log2 = side.trailing_zeros();
            let edge = |right: u16| {
                let top = self.at(corner + layout.offset(right, 0));
                let bottom = self.at(corner + layout.offset(right, side));
                rgb(&top.radiance, &bottom.radiance, |a, b| A::steps(a, A::step(a, b, log2), down))
            };
            let left = edge(0);
            let step = rgb(&left, &edge(side), |a, b| A::step(a, b, log2));
            let start = x - right;
            self.sparse.run = Run { left, step, start, end: start + side };
            return rgb(&left, &step, |a, b| A::steps(a, b, right));
        }
        if right | down == 0 {
            return self.at(corner).radiance;
        }
        let (beside, below) = (corner + 1, corner + layout.stride);
        let place = layout.middles + usize::from(x >> 1);
        let mut middle = *self.at(place);
        if !middle.is_known() && !middle.is_marked() {
            // Whether it is traced is decided once; the mark says that it isn't.
            let corners = [corner, beside, below, below + 1].map(|place| *self.at(place));
            middle = if differ_in_color(&corners, threshold) {
                self.pixel(x | 1, y | 1)
            } else {
                Sample::NONE.marked()
            };
            self.remember(place, middle);
        }
        let other = *self.at(if right == 0 { below } else { beside });
        let known = middle.is_known();
        if right & down != 0 {
            if known {
                return middle.radiance;
            }
            let [a, b, c, d] =
                [corner, below, beside, below + 1].map(|place| &self.at(place).radiance);
            return mean::<A>(&mean::<A>(a, b), &mean::<A>(c, d));
        }
        let first = self.at(corner);
        if known && differ_in_color(&[*first, other, middle], threshold) {
            return self.trace(&self.view.row(y, 128), x, 128);
        }
        mean::<A>(&first.radiance, &other.radiance)
    }

    /// Begins a row of pixels between two columns.
    fn begin_sparse(&mut self, y: u16, columns: (u16, u16), threshold: u8) {
        let layout = self.sparse.layout;
        self.sparse.run.end = 0;
        let wanted = Remembered { y: y & !(layout.side - 1), columns };
        if self.remembered != Some(wanted) {
            self.fill(wanted, layout, threshold);
        }
        let pair = Remembered { y: y & !1, columns };
        if self.sparse.middles != Some(pair) {
            for i in layout.middles..layout.next {
                self.remember(i, Sample::NONE);
            }
            self.sparse.middles = Some(pair);
        }
    }

    /// The sample at a pixel's centre; beyond an edge, the last pixel's.
    fn pixel(&mut self, x: u16, y: u16) -> Sample<A> {
        let (x, y) = (x.min(self.settings.width - 1), y.min(self.settings.height - 1));
        self.sample(x, 128, y, 128)
    }

    /// Traces what a row of blocks needs, at even coordinates.
    fn fill(&mut self, wanted: Remembered, layout: Layout, threshold: u8) {
        let Remembered { y, columns } = wanted;
        let side = layout.side;
        let shift = layout.log2_side;
        let (first, last) =
            (usize::from(columns.0 >> shift), usize::from((columns.1 - 1) >> shift));
        // The blocks beside the area count, too.
        let counting = (first.saturating_sub(1), (last + 1).min(layout.blocks - 1));
        if y < side || self.remembered != Some(Remembered { y: y - side, columns }) {
            // From the row of blocks above.
            let top = y.saturating_sub(side);
            for i in 0..layout.next + layout.blocks + 1 {
                self.remember(i, Sample::NONE);
            }
            self.sparse.middles = None;
            self.ahead(top, counting, &layout);
            let mut next = top + side;
            while next <= y + side {
                self.advance(next, counting, &layout, threshold);
                next += side;
            }
        }
        self.advance(y + 2 * side, counting, &layout, threshold);
        for block in first..=last {
            if self.remembered(block * layout.step).is_marked() {
                self.divide(block, y, &layout, threshold);
            }
        }
        self.remembered = Some(wanted);
    }

    /// Traces the corners at y of the row of blocks after the remembered one.
    fn ahead(&mut self, y: u16, (first, last): (usize, usize), layout: &Layout) {
        for block in first..=last + 1 {
            let sample = self.pixel(block as u16 * layout.side, y);
            self.remember(layout.next + block, sample);
        }
    }

    /// Goes to the next row of blocks: its lower edge is that of the corners known ahead; traces
    /// those at y, and marks which blocks differ, with those around them.
    fn advance(&mut self, y: u16, counting: (usize, usize), layout: &Layout, threshold: u8) {
        let Layout { stride, step, lower, next, .. } = *layout;
        for i in 0..stride {
            let edge = self.remembered(lower + i);
            self.remember(i, edge);
        }
        for i in stride..lower + stride {
            self.remember(i, Sample::NONE);
        }
        for block in 0..=layout.blocks {
            let corner = self.remembered(next + block);
            self.remember(lower + block * step, corner);
            self.remember(next + block, Sample::NONE);
        }
        // Blocks below the picture have nothing to say.
        if y - layout.side >= self.settings.height {
            return;
        }
        self.ahead(y, counting, layout);
        let (first, last) = counting;
        for block in first..=last {
            let corner = lower + block * step;
            let corners = [corner, corner + step, next + block, next + block + 1]
                .map(|place| self.remembered(place));
            if differ(&corners, threshold) {
                self.put_mark(block * step);
                self.put_mark(corner);
                self.put_mark(next + block);
                if block > first {
                    self.put_mark(corner - step);
                }
                if block < last {
                    self.put_mark(corner + step);
                }
            }
        }
    }

    #[inline(always)]
    fn put_mark(&mut self, place: usize) {
        let marked = self.remembered(place).marked();
        self.remember(place, marked);
    }

    /// Traces what divides a block, and the smaller ones in it that are worth it.
    fn divide(&mut self, block: usize, y: u16, layout: &Layout, threshold: u8) {
        let whole = layout.side;
        let x = block as u16 * whole;
        let corner = block * layout.step;
        let mut side = whole;
        while side > 2 {
            let half = side >> 1;
            let mut down = 0;
            while down < whole {
                let mut right = 0;
                while right < whole {
                    // The middle of the block that this is a quarter of.
                    let middle = corner + layout.offset(right & !side | side, down & !side | side);
                    let four = [(0, 0), (side, 0), (0, side), (side, side)]
                        .map(|(i, j)| self.remembered(corner + layout.offset(right + i, down + j)));
                    if side == whole
                        || self.remembered(middle).is_known() && differ(&four, threshold)
                    {
                        for (i, j) in
                            [(half, 0), (0, half), (half, half), (side, half), (half, side)]
                        {
                            let place = corner + layout.offset(right + i, down + j);
                            if !self.remembered(place).is_known() {
                                let sample = self.pixel(x + right + i, y + down + j);
                                self.remember(place, sample);
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
}

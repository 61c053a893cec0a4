//! Sparse sampling: a ray for some pixels, the others interpolated.
//!
//! After Akimoto, Mase and Suenaga ("Pixel-selected ray tracing", IEEE Computer Graphics and
//! Applications 11(4), 1991) the picture is cut into blocks of side s, with rays through the centres of
//! the pixels at their corners. Here each further ray is decided alone, by four samples around it, as
//! heights are in the diamond-square algorithm (Fournier, Fussell and Carpenter, 1982): the middle of
//! a block by its corners, then the middle of a side by the side's ends and the middles of the blocks
//! that share it. The blocks become four of half the side each, and so on down to single pixels. What
//! passes between the corners of one block rarely does so of all: the middle of a block of side s is
//! traced also if one of the four blocks beside it would be, and that of one of the smallest, side 2,
//! also if the one beside, above or below in the same block of side 4 would be and three of its corners
//! are samples. What isn't traced is the mean of what lies around it.
//!
//! Samples are told apart by colour: where the rays hit different things or shadows, three quarters of the
//! difference is enough; where all four took many rays, a ray is worth it from half as much again. Whether
//! a side is traced that two rows of blocks share, the upper one says, since it is drawn
//! first. Beyond the right and the lower edge of the picture a block's corners are the last pixels' samples.
//!
//! The sampler traces nothing itself: it is asked for one pixel after the other, and says which ray it
//! wants first. So the tracer is called from one place, in the loop over pixels.

mod grid;
mod layout;

use super::{Sample, Sampling};
use crate::math::{Arithmetic, Rgb, rgb};
use layout::Layout;

/// The middle between two.
#[inline(always)]
fn mean<A: Arithmetic>(a: &Rgb<A::Radiance>, b: &Rgb<A::Radiance>) -> Rgb<A::Radiance> {
    rgb(a, b, |a, b| A::mean(A::gather(a, b), 2))
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

/// What the sampler says when it is asked for a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) enum Answer<A: Arithmetic> {
    /// This is it.
    Pixel(Rgb<A::Radiance>),
    /// A ray through the centre of the pixel at (x, y), of which the sampler is to be
    /// [told](Sparse::tell) before it is asked again.
    Sample(u16, u16),
    /// A ray through the pixel's own centre: what that finds is the pixel.
    Traced,
}

/// What is ready.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    /// The corners below the next row of blocks are being traced.
    Corners,
    /// The middles of blocks of a side are.
    Middles,
    /// The middles of their sides are.
    Sides,
    /// The row of blocks is ready.
    Ready,
}

/// The sampler: where it stands. What it has been told lies in the caller's memory.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sparse<A: Arithmetic> {
    layout: Layout,
    threshold: u8,
    /// The picture's last column and row.
    last: (u16, u16),
    run: Run<A>,
    /// The columns that are asked for, nothing being known of others; the first behind the last for
    /// none.
    columns: (u16, u16),
    /// The row of blocks that is ready or being made.
    row: i16,
    /// The row of pixels that all but single pixels is ready for, and the pair of rows for which the
    /// smallest blocks' middles are.
    ready: Option<u16>,
    pair: Option<u16>,
    stage: Stage,
    /// The side of the blocks that are being divided.
    side: u16,
    /// The next place to look at: pixels from the picture's left edge and the block's upper one.
    x: u16,
    down: u16,
    /// Which of the sides there.
    which: u8,
    /// Where the sample goes that was asked for.
    slot: usize,
}

impl<A: Arithmetic> Sparse<A> {
    /// For pictures of this size.
    pub(super) const fn new(width: u16, height: u16, sampling: Sampling) -> Self {
        let (side, threshold) = match sampling {
            Sampling::Sparse { side, threshold } => (side, threshold),
            _ => (2, 0),
        };
        Self {
            layout: Layout::new(width, side),
            threshold,
            last: (width - 1, height - 1),
            run: Run { left: [A::BLACK; 3], step: [A::BLACK; 3], start: 0, end: 0 },
            columns: (1, 0),
            row: 0,
            ready: None,
            pair: None,
            stage: Stage::Ready,
            side: 0,
            x: 0,
            down: 0,
            which: 0,
            slot: 0,
        }
    }

    /// The sampler, which is left behind knowing nothing.
    #[inline(always)]
    pub(super) fn take(&mut self) -> Self {
        let taken = *self;
        self.columns = (1, 0);
        self.ready = None;
        taken
    }

    /// The pixel at x if it lies in the same undivided block as the one before.
    #[inline(always)]
    pub(super) fn goes_on(&self, x: u16, columns: (u16, u16)) -> Option<Rgb<A::Radiance>> {
        let Run { left, step, start, end } = &self.run;
        (x < *end && x != columns.0)
            .then(|| rgb(left, step, |a, b| A::steps(a, b, x.wrapping_sub(*start))))
    }

    /// The pixel at (x, y), or what is missing. `columns` are those that are asked for in this row, from
    /// the first to the last, one after the other.
    #[inline(never)]
    pub(super) fn ask(
        &mut self,
        x: u16,
        y: u16,
        columns: (u16, u16),
        samples: &mut [Sample<A>],
    ) -> Answer<A> {
        if (self.ready != Some(y) || self.columns != columns)
            && let Some((x, y)) = self.prepare(y, columns, samples)
        {
            return Answer::Sample(x, y);
        }
        let at = |place: usize| samples.get(place).copied().unwrap_or(Sample::NONE);
        let layout = &self.layout;
        let mask = layout.side - 1;
        // Where the pixel lies in the smallest block around it, and where that begins.
        let (mut right, mut down, mut side) = (x & mask, y & mask, layout.side);
        let mut corner = usize::from((x - right) >> 1);
        while side > 2 {
            if !layout.is_open(corner, side, samples) {
                let log2 = side.trailing_zeros();
                let edge = |right: u16| {
                    let top = at(corner + layout.offset(right, 0));
                    let bottom = at(corner + layout.offset(right, side));
                    rgb(&top.radiance, &bottom.radiance, |a, b| {
                        A::steps(a, A::step(a, b, log2), down)
                    })
                };
                let left = edge(0);
                let step = rgb(&left, &edge(side), |a, b| A::step(a, b, log2));
                let start = x - right;
                self.run = Run { left, step, start, end: start + side };
                return Answer::Pixel(rgb(&left, &step, |a, b| A::steps(a, b, right)));
            }
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
        }
        let first = at(corner);
        if right | down == 0 {
            return Answer::Pixel(first.radiance);
        }
        let place = layout.middles + usize::from(x >> 1);
        let middle = at(place);
        if right & down != 0 {
            if middle.is_known() {
                return Answer::Pixel(middle.radiance);
            }
            let other = [corner + layout.stride, corner + 1, corner + layout.stride + 1].map(at);
            let left = mean::<A>(&first.radiance, &other[0].radiance);
            let right = mean::<A>(&other[1].radiance, &other[2].radiance);
            return Answer::Pixel(mean::<A>(&left, &right));
        }
        // Between two: the middles beside say whether it is worth a ray.
        let (other, beside) = if right == 0 {
            let left = if x == 0 { Sample::NONE } else { at(place - 1) };
            (at(corner + layout.stride), left)
        } else {
            (at(corner + 1), Sample::NONE)
        };
        let (one, two) = match (middle.is_known(), beside.is_known()) {
            (true, true) => (middle, beside),
            (true, false) => (middle, middle),
            (false, true) => (beside, beside),
            (false, false) => {
                return Answer::Pixel(mean::<A>(&first.radiance, &other.radiance));
            }
        };
        if first.is_worth_a_ray(&other, &one, &two, self.threshold) {
            return Answer::Traced;
        }
        Answer::Pixel(mean::<A>(&first.radiance, &other.radiance))
    }

    /// What the ray has found that the sampler asked for.
    #[inline(always)]
    pub(super) fn tell(&self, sample: Sample<A>, samples: &mut [Sample<A>]) {
        if let Some(place) = samples.get_mut(self.slot) {
            *place = sample.known();
        }
    }
}

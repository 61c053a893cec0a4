//! From coarse to fine, until it is done or time is up.
//!
//! The first pass traces every s-th pixel of every s-th row and paints it as a block of s×s pixels
//! to its right and below. Each further pass halves s and traces the pixels that are new, until s
//! is 1. A pixel is traced once, and what it is then is final: the block that is painted with it holds
//! no other that has been traced, since those lie at multiples of 2s. After the pass of single pixels
//! the screen shows the picture of one ray through each pixel's centre; where the settings ask for
//! another sampling, a last pass puts its pixels in their place, row by row.
//!
//! The pixels live on the display alone. What is remembered is where the render stands.

use super::renderer::Asked;
use super::{FrameError, Output, Pixel, Renderer, Sampling, Settings};
use crate::math::Arithmetic;
use crate::scene::{Scene, SceneRef};
use crate::tally::Tally;
use crate::trace::call_site;
use core::convert::Infallible;
use core::ops::Range;

/// Some pixels of one colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block<P> {
    /// The first column.
    pub x: u16,
    /// The first row.
    pub y: u16,
    /// Pixels across, at least 1.
    pub width: u16,
    /// Pixels down, at least 1.
    pub height: u16,
    /// What all of them show.
    pub pixel: P,
}

/// Where a render from coarse to fine stands: the pass and the place in it, eight bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Passes {
    /// Where the pass goes on.
    x: u16,
    y: u16,
    /// The side of this pass's blocks; 0 in the last pass, if the sampling wants one.
    side: u8,
    first: bool,
    done: bool,
}

/// Whether the picture is finished.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// The display shows the picture as it would be drawn at once.
    Done,
    /// The deadline came first.
    Interrupted,
}

impl Passes {
    /// From the start, with blocks of `side` pixels.
    ///
    /// # Errors
    /// A side that isn't 1, 2, 4, 8, 16, 32, 64 or 128.
    pub const fn new(side: u8) -> Result<Self, FrameError> {
        if !side.is_power_of_two() {
            return Err(FrameError::Pass { side });
        }
        Ok(Self { x: 0, y: 0, side, first: true, done: false })
    }

    /// The side of the blocks being painted; 0 in the last pass of a sampling that isn't one ray
    /// through each pixel's centre.
    pub const fn side(&self) -> u8 {
        self.side
    }

    /// Whether all is done.
    pub const fn is_done(&self) -> bool {
        self.done
    }
}

impl<'s, A, const MAX_DEPTH: usize, T, S, const USES: u64> Renderer<'_, A, MAX_DEPTH, T, S>
where
    A: Arithmetic,
    T: Tally,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    /// Goes on with a render from coarse to fine, and gives `paint` each block that changes, until
    /// the picture is finished or `deadline`, asked before every block, says that time is up. It is
    /// shown the tally: a number of rays is `|counts| counts.rays() >= 10_000`, a time is
    /// `|_| timer.now() >= end`.
    ///
    /// Pixels with coordinates that are multiples of a pass's side are final once the pass is done,
    /// and no later block paints over them; what the last pass leaves is the picture of
    /// [`line`](Self::line) to the bit.
    pub fn refine<P: Pixel>(
        &mut self,
        passes: &mut Passes,
        output: &Output,
        deadline: impl FnMut(&T) -> bool,
        mut paint: impl FnMut(&Block<P>),
    ) -> Progress {
        let Settings { width, height, .. } = self.settings;
        let painted = self.refine_area(passes, output, (0..width, 0..height), deadline, |block| {
            paint(block);
            Ok::<(), Infallible>(())
        });
        match painted {
            Ok(progress) => progress,
            Err(never) => match never {},
        }
    }

    /// The same of an area within the picture, which is the same each time; after an error the block
    /// that couldn't be painted comes again.
    pub(crate) fn refine_area<P: Pixel, E>(
        &mut self,
        passes: &mut Passes,
        output: &Output,
        (columns, rows): (Range<u16>, Range<u16>),
        mut deadline: impl FnMut(&T) -> bool,
        mut paint: impl FnMut(&Block<P>) -> Result<(), E>,
    ) -> Result<Progress, E> {
        if columns.is_empty() || rows.is_empty() {
            passes.done = true;
        }
        // A row of the last pass that was left in its middle begins anew there.
        let mut begin = passes.x.max(columns.start);
        while !passes.done {
            let side = u16::from(passes.side.max(1));
            let start = |from: u16| from & !(side - 1);
            passes.x = passes.x.max(start(columns.start));
            passes.y = passes.y.max(start(rows.start));
            let (x, y) = (passes.x, passes.y);
            // Pixels of earlier passes are skipped.
            if passes.first || passes.side == 0 || (x | y) & (side * 2 - 1) != 0 {
                if deadline(&self.tally) {
                    return Ok(Progress::Interrupted);
                }
                let row = self.view.row(y, 128);
                let values = if passes.side == 0 {
                    let mut sparse = self.sparse.take();
                    let asked = Asked { row: &row, x, y, columns: (begin, columns.end) };
                    let values =
                        self.values::<{ call_site::ANY }>(&mut sparse, asked, &output.tone);
                    self.sparse = sparse;
                    values
                } else {
                    let radiance = self.trace::<{ call_site::PASS }>(&row, x, 128);
                    output.tone.values::<A>(&radiance)
                };
                let (left, top) = (x.max(columns.start), y.max(rows.start));
                let (right, bottom) = ((x + side).min(columns.end), (y + side).min(rows.end));
                let (width, height) = (right - left, bottom - top);
                let pixel = output.shown(values, left, top);
                paint(&Block { x: left, y: top, width, height, pixel })?;
            }
            passes.x += side;
            if passes.x >= columns.end {
                passes.x = 0;
                begin = columns.start;
                passes.y += side;
            }
            if passes.y >= rows.end {
                passes.y = 0;
                passes.first = false;
                match passes.side {
                    1 if self.settings.sampling != Sampling::Center => passes.side = 0,
                    0 | 1 => passes.done = true,
                    side => passes.side = side >> 1,
                }
            }
        }
        Ok(Progress::Done)
    }
}

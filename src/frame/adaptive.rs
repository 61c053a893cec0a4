//! Adaptive supersampling: more rays where the picture changes.
//!
//! Whitted ("An improved illumination model for shaded display", CACM 23(6), 1980) compares a pixel's
//! corners. Here its centre is compared with them, and a pixel is divided too if one beside it would
//! be: what passes between the corners of one rarely does so of all. A divided pixel is cut into 2×2 cells
//! or 4×4, with a ray through the middle of each. Of 4×4, four that share no row and no column go
//! first; where they and the corners don't differ after all, they are the pixel. In the end a cell that
//! differs in colour from one beside it gets 2×2 rays in place of its one, as fine as 8×8 over the pixel.
//!
//! A row is gone through one pixel ahead, so that the one to the right is known.

use super::corners::sum;
use super::sample::{differ, differ_in_color};
use super::{Renderer, Sample};
use crate::math::{Arithmetic, Rgb, rgb};
use crate::scene::{Scene, SceneRef};
use crate::tally::Tally;
use crate::trace::call_site;

/// Of 4×4 cells, the four that go first; numbered row by row.
const FIRST: [usize; 4] = [1, 7, 8, 14];

impl<'s, A, const MAX_DEPTH: usize, T, S, const USES: u64> Renderer<'_, A, MAX_DEPTH, T, S>
where
    A: Arithmetic,
    T: Tally,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    /// The pixel at (x, y).
    #[inline(never)]
    pub(super) fn adaptive(
        &mut self,
        x: u16,
        y: u16,
        columns: (u16, u16),
        depth: u8,
        threshold: u8,
    ) -> Rgb<A::Radiance> {
        // The pixels beside the area count, too.
        let (first, end) = (columns.0.saturating_sub(1), (columns.1 + 1).min(self.settings.width));
        if x == columns.0 {
            self.flags = 0;
            self.begin(first, y, (first, end), |renderer, x, y| renderer.sample(x, 0, y, 0));
            for x in first..=x {
                self.look(x, y, threshold);
            }
        }
        if x + 1 < end {
            self.look(x + 1, y, threshold);
        } else {
            self.flags <<= 1;
        }
        if x + 1 == columns.1 {
            self.end(y, (first, end));
        }
        let found = self.found(x);
        let [a, b, c, d, center] = [0, 1, 2, 3, 4].map(|i| self.remembered(found + i));
        if self.flags & 7 == 0 {
            // A pixel's corners weigh as much as its centre.
            let corners = sum(&[a, b, c, d]);
            let both = rgb(&corners, &sum(&[center; 4]), A::gather);
            return both.map(|sum| A::mean(sum, 8));
        }
        self.cut(x, y, &[a, b, c, d, center], depth, threshold)
    }

    /// Where the five samples of a pixel are: those of two neighbours are remembered.
    #[inline(always)]
    fn found(&self, x: u16) -> usize {
        usize::from(self.settings.width) + 2 + if x & 1 == 0 { 0 } else { 5 }
    }

    /// Traces and compares the corners and the centre of the next pixel.
    fn look(&mut self, x: u16, y: u16, threshold: u8) {
        let [a, b, c, d] = self.quad(x, y, |renderer, x, y| renderer.sample(x, 0, y, 0));
        let five = [a, b, c, d, self.sample(x, 128, y, 128)];
        let found = self.found(x);
        for (i, sample) in (0..).zip(five) {
            self.remember(found + i, sample);
        }
        self.flags = self.flags << 1 | u8::from(differ(&five, threshold));
    }

    /// The middle of a cell.
    #[inline(always)]
    fn cell(&mut self, x: u16, y: u16, cell: usize) -> Sample<A> {
        let place = |i: usize| (i as u8) << 6 | 32;
        self.sample(x, place(cell & 3), y, place(cell >> 2))
    }

    /// The mean of 2×2 rays, their places given by the first and the distance, in 1/256.
    fn four(&mut self, x: u16, y: u16, first: (u8, u8), step: u8) -> Rgb<A::Radiance> {
        let mut sum = [A::BLACK; 3];
        for (right, down) in [(0, 0), (step, 0), (0, step), (step, step)] {
            let (right, down) = (first.0.wrapping_add(right), first.1.wrapping_add(down));
            let radiance = self.trace::<{ call_site::ANY }>(&self.view.row(y, down), x, right);
            sum = rgb(&sum, &radiance, A::gather);
        }
        sum.map(|sum| A::mean(sum, 4))
    }

    /// The mean of the cells of a pixel that is worth dividing.
    fn cut(
        &mut self,
        x: u16,
        y: u16,
        five: &[Sample<A>; 5],
        depth: u8,
        threshold: u8,
    ) -> Rgb<A::Radiance> {
        if depth == 1 {
            return self.four(x, y, (64, 64), 128);
        }
        let cells = usize::from(self.settings.width) + 12;
        let four = FIRST.map(|cell| {
            let sample = self.cell(x, y, cell);
            self.remember(cells + cell, sample);
            sample
        });
        let ([a, b, c, d, center], [p, q, r, s]) = (*five, four);
        if !differ(&[a, b, c, d, center, p, q, r, s], threshold) {
            return sum(&four).map(|sum| A::mean(sum, 4));
        }
        for cell in 0..16 {
            if !FIRST.contains(&cell) {
                let sample = self.cell(x, y, cell);
                self.remember(cells + cell, sample);
            }
        }
        // A bit for each cell that is worth four rays.
        let mut coarse = 0u32;
        if depth > 2 {
            let limit = threshold.saturating_add(threshold >> 1);
            // The samples that were there before lie beside cells, too.
            let old = [(0, a), (3, b), (12, c), (15, d)];
            for (cell, old) in old {
                if differ_in_color(&[self.remembered(cells + cell), old], limit) {
                    coarse |= 1 << cell;
                }
            }
            for cell in 0..16 {
                let own = self.remembered(cells + cell);
                for (has, step) in [(cell & 3 != 3, 1), (cell < 12, 4)] {
                    let beside = self.remembered(cells + cell + step);
                    if has && differ_in_color(&[own, beside], limit) {
                        coarse |= 1 << cell | 1 << (cell + step);
                    }
                }
            }
        }
        let mut sum = [A::BLACK; 3];
        for cell in 0..16 {
            let radiance = if coarse >> cell & 1 == 0 {
                self.remembered(cells + cell).radiance()
            } else {
                let place = |i: usize| (i as u8) << 6 | 16;
                self.four(x, y, (place(cell & 3), place(cell >> 2)), 32)
            };
            sum = rgb(&sum, &radiance, A::gather);
        }
        sum.map(|sum| A::mean(sum, 16))
    }
}

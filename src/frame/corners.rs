//! Samplings by pixel corners: their mean, and adaptive supersampling.
//!
//! Corners are shared by the pixels around them: a row of them is remembered, and replaced from
//! left to right by the one below while the pixels between the two are made.
//!
//! A pixel whose corners differ is cut into quarters, and those whose corners differ again
//! (Whitted, "An improved illumination model for shaded display", CACM 23(6), 1980); its value is
//! the mean of the quarters', and that of an undivided part the mean of its four corners. All corners
//! that can occur form a lattice, where each is traced once. The parts are gone through in the order
//! of the bits of x and y interleaved (Morton 1966), so that no stack is needed but a sum a level.

use super::renderer::Remembered;
use super::sample::differ;
use super::sampling::lattice;
use super::{Renderer, Sample};
use crate::math::{Arithmetic, Rgb, rgb};
use crate::scene::Row;
use crate::tally::Tally;

/// A pixel may be halved so often.
const MAX_HALVINGS: usize = 4;

/// The mean of four radiances.
#[inline(always)]
fn mean<A: Arithmetic>(four: &[Sample<A>; 4]) -> Rgb<A::Radiance> {
    let [a, b, c, d] = four;
    let top = rgb(&a.radiance, &b.radiance, A::gather);
    let bottom = rgb(&c.radiance, &d.radiance, A::gather);
    rgb(&top, &bottom, |a, b| A::mean(A::gather(a, b), 4))
}

/// Every other bit of a Morton number, from the first.
#[inline(always)]
fn every_other(i: usize) -> usize {
    (i & 1) | (i >> 1 & 2) | (i >> 2 & 4) | (i >> 3 & 8)
}

impl<A: Arithmetic, const MAX_DEPTH: usize, T: Tally, const USES: u64>
    Renderer<'_, A, MAX_DEPTH, T, USES>
{
    /// The mean of the pixel's corners.
    #[inline(never)]
    pub(super) fn corners(&mut self, x: u16, y: u16, columns: (u16, u16)) -> Rgb<A::Radiance> {
        let four =
            self.quad(x, y, columns, |renderer, row, x| Sample::plain(renderer.trace(row, x, 0)));
        mean(&four)
    }

    /// The mean of the pixel's parts.
    #[inline(never)]
    pub(super) fn adaptive(
        &mut self,
        x: u16,
        y: u16,
        columns: (u16, u16),
        depth: u8,
        threshold: u8,
    ) -> Rgb<A::Radiance> {
        let four = self.quad(x, y, columns, |renderer, row, x| renderer.sample(row, x, 0));
        if differ(&four, threshold) {
            self.parts(x, y, &four, depth, threshold)
        } else {
            mean(&four)
        }
    }

    /// The four corners of a pixel; those above come from memory, those below go there. `corner`
    /// traces one, at the left end of a pixel of a row of rays.
    #[inline(always)]
    fn quad(
        &mut self,
        x: u16,
        y: u16,
        columns: (u16, u16),
        corner: impl Fn(&mut Self, &Row<A>, u16) -> Sample<A>,
    ) -> [Sample<A>; 4] {
        // The corner below and to the left waits behind the row.
        let waiting = usize::from(self.settings.width) + 1;
        let below = self.view.row(y + 1, 0);
        if x == columns.0 {
            if self.remembered != Some(Remembered { y, columns }) {
                let row = self.view.row(y, 0);
                for x in columns.0..=columns.1 {
                    let sample = corner(self, &row, x);
                    self.remember(usize::from(x), sample);
                }
            }
            // A row that isn't finished is of no use to the next.
            self.remembered = None;
            let left = corner(self, &below, x);
            self.remember(waiting, left);
        }
        let i = usize::from(x);
        let right = corner(self, &below, x + 1);
        let left = self.remembered(waiting);
        let four = [self.remembered(i), self.remembered(i + 1), left, right];
        self.remember(i, left);
        self.remember(waiting, right);
        if x + 1 == columns.1 {
            self.remember(i + 1, right);
            self.remembered = Some(Remembered { y: y + 1, columns });
        }
        four
    }

    /// The mean of the parts of a pixel that is worth dividing.
    fn parts(
        &mut self,
        x: u16,
        y: u16,
        corners: &[Sample<A>; 4],
        depth: u8,
        threshold: u8,
    ) -> Rgb<A::Radiance> {
        let depth = usize::from(depth).min(MAX_HALVINGS);
        let side = 1 << depth;
        let first = usize::from(self.settings.width) + 2;
        for i in 0..lattice(depth as u8) {
            self.remember(first + i, Sample::NONE);
        }
        for (i, corner) in (0..).zip(corners) {
            self.remember(first + (i >> 1) * side * (side + 1) + (i & 1) * side, *corner);
        }
        // The sums of the parts of a level that are done, and the part that is next: its level and
        // its first cell's number.
        let mut sums = [[A::BLACK; 3]; MAX_HALVINGS];
        let (mut level, mut cell) = (0, 0usize);
        loop {
            let step = side >> level;
            let (u, v) = (every_other(cell), every_other(cell >> 1));
            let four = [(0, 0), (step, 0), (0, step), (step, step)]
                .map(|(right, down)| self.point(x, y, u + right, v + down, depth));
            let mut value = mean(&four);
            if level < depth && differ(&four, threshold) {
                if let Some(sum) = sums.get_mut(level) {
                    *sum = [A::BLACK; 3];
                }
                level += 1;
                continue;
            }
            cell += step * step;
            // Up as long as this part was its whole's last.
            loop {
                if level == 0 {
                    return value;
                }
                let Some(sum) = sums.get_mut(level - 1) else { return value };
                *sum = rgb(sum, &value, A::gather);
                let whole = side >> (level - 1);
                if cell & (whole * whole - 1) != 0 {
                    break;
                }
                value = sum.map(|sum| A::mean(sum, 4));
                level -= 1;
            }
        }
    }

    /// A point of a pixel's lattice, traced if it hasn't been.
    fn point(&mut self, x: u16, y: u16, u: usize, v: usize, depth: usize) -> Sample<A> {
        let side = 1 << depth;
        let place = usize::from(self.settings.width) + 2 + v * (side + 1) + u;
        let known = self.remembered(place);
        if known.is_known() {
            return known;
        }
        // The lattice's last points are the next pixels' first.
        let part = |i: usize| ((i >> depth) as u16, (i << (8 - depth)) as u8);
        let ((right, across), (lower, down)) = (part(u), part(v));
        let sample = self.sample(&self.view.row(y + lower, down), x + right, across);
        self.remember(place, sample);
        sample
    }
}

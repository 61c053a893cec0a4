//! Sampling by pixel corners: their mean.
//!
//! Corners are shared by the pixels around them: a row of them is remembered, and replaced from
//! left to right by the one below while the pixels between the two are made.

use super::renderer::Remembered;
use super::{Renderer, Sample};
use crate::math::{Arithmetic, Rgb, rgb};
use crate::scene::{Scene, SceneRef};
use crate::tally::Tally;
use crate::trace::call_site;

/// The sum of four radiances.
#[inline(always)]
pub(super) fn sum<A: Arithmetic>(four: &[Sample<A>; 4]) -> Rgb<A::Radiance> {
    let [a, b, c, d] = four;
    let top = rgb(&a.radiance(), &b.radiance(), A::gather);
    let bottom = rgb(&c.radiance(), &d.radiance(), A::gather);
    rgb(&top, &bottom, A::gather)
}

impl<'s, A, const MAX_DEPTH: usize, T, S, const USES: u64> Renderer<'_, A, MAX_DEPTH, T, S>
where
    A: Arithmetic,
    T: Tally,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    /// The mean of the pixel's corners.
    #[inline(never)]
    pub(super) fn corners(&mut self, x: u16, y: u16, columns: (u16, u16)) -> Rgb<A::Radiance> {
        let corner = |renderer: &mut Self, x, y| {
            Sample::plain(renderer.trace::<{ call_site::ANY }>(&renderer.view.row(y, 0), x, 0))
        };
        if x == columns.0 {
            self.begin(x, y, columns, corner);
        }
        let four = self.quad(x, y, corner);
        if x + 1 == columns.1 {
            self.end(y, columns);
        }
        sum(&four).map(|sum| A::mean(sum, 4))
    }

    /// Begins a row of pixels between two columns: its upper corners are remembered, or traced;
    /// `corner` traces that of the pixel at (x, y).
    #[inline(always)]
    pub(super) fn begin(
        &mut self,
        x: u16,
        y: u16,
        columns: (u16, u16),
        corner: impl Fn(&mut Self, u16, u16) -> Sample<A>,
    ) {
        if self.remembered != Some(Remembered { y, columns }) {
            for x in columns.0..=columns.1 {
                let sample = corner(self, x, y);
                self.remember(usize::from(x), sample);
            }
        }
        // A row that isn't finished is of no use to the next.
        self.remembered = None;
        let left = corner(self, x, y + 1);
        self.remember(usize::from(self.settings.width) + 1, left);
    }

    /// The four corners of the next pixel of a row that was begun; those above come from memory,
    /// those below go there. The one below and to the left waits behind the row.
    #[inline(always)]
    pub(super) fn quad(
        &mut self,
        x: u16,
        y: u16,
        corner: impl Fn(&mut Self, u16, u16) -> Sample<A>,
    ) -> [Sample<A>; 4] {
        let (i, waiting) = (usize::from(x), usize::from(self.settings.width) + 1);
        let right = corner(self, x + 1, y + 1);
        let left = self.remembered(waiting);
        let four = [self.remembered(i), self.remembered(i + 1), left, right];
        self.remember(i, left);
        self.remember(waiting, right);
        four
    }

    /// Ends a row of pixels: its lower corners are those of the next.
    #[inline(always)]
    pub(super) fn end(&mut self, y: u16, columns: (u16, u16)) {
        let last = self.remembered(usize::from(self.settings.width) + 1);
        self.remember(usize::from(columns.1), last);
        self.remembered = Some(Remembered { y: y + 1, columns });
    }
}

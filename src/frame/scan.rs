//! The pixels of an area, traced as they are taken.

use super::renderer::Asked;
use super::sparse::Sparse;
use super::{Output, Pixel, Renderer};
use crate::math::{Arithmetic, Rgb};
use crate::scene::{Row, Scene, SceneRef};
use crate::tally::Tally;
use crate::trace::call_site;
use core::marker::PhantomData;
use core::ops::Range;

impl<'a, 's, A, const MAX_DEPTH: usize, T, S, const USES: u64> Renderer<'a, A, MAX_DEPTH, T, S>
where
    A: Arithmetic,
    T: Tally,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    /// Traces the radiances of an area, row by row, as they are taken; what of it lies outside the
    /// picture is left out. What sparse sampling interpolates are no radiances but what is shown: here each
    /// of its pixels has a ray, as by [`Sampling::Center`](super::Sampling::Center).
    #[inline(always)]
    pub fn scan(
        &mut self,
        columns: Range<u16>,
        rows: Range<u16>,
    ) -> Scan<'_, 'a, A, MAX_DEPTH, T, S> {
        let area = Area::new(self, columns, rows);
        Scan { renderer: self, area }
    }

    /// The same as pixels, by any sampling.
    #[inline(always)]
    pub fn pixels<P: Pixel>(
        &mut self,
        columns: Range<u16>,
        rows: Range<u16>,
        output: &Output,
    ) -> Pixels<'_, 'a, A, P, MAX_DEPTH, T, S> {
        let area = Area::new(self, columns, rows);
        let sparse = self.sparse.take();
        Pixels { renderer: self, sparse, area, output: *output, pixel: PhantomData }
    }
}

/// Where the next pixel lies.
#[derive(Debug)]
struct Area<A: Arithmetic> {
    columns: Range<u16>,
    /// The current row and the end.
    rows: Range<u16>,
    x: u16,
    row: Row<A>,
    begun: bool,
}

impl<A: Arithmetic> Area<A> {
    #[inline(always)]
    fn new<const MAX_DEPTH: usize, T, S>(
        renderer: &Renderer<'_, A, MAX_DEPTH, T, S>,
        columns: Range<u16>,
        rows: Range<u16>,
    ) -> Self {
        let columns = columns.start..columns.end.min(renderer.settings.width);
        let rows = rows.start..rows.end.min(renderer.settings.height);
        let row = renderer.view.row(rows.start, 128);
        // As if the row above had just ended: the first `next` begins a row.
        let x = columns.end;
        Self { columns, rows, x, row, begun: false }
    }

    /// The pixel that was next.
    #[inline(always)]
    fn asked(&self, x: u16, y: u16) -> Asked<'_, A> {
        Asked { row: &self.row, x, y, columns: (self.columns.start, self.columns.end) }
    }

    /// The next pixel; none below the last row.
    #[inline(always)]
    fn next<'s, const MAX_DEPTH: usize, T, S, const USES: u64>(
        &mut self,
        renderer: &Renderer<'_, A, MAX_DEPTH, T, S>,
    ) -> Option<(u16, u16)>
    where
        T: Tally,
        S: SceneRef<Target = Scene<'s, A, USES>>,
    {
        if self.x >= self.columns.end {
            if self.begun {
                self.rows.start += 1;
            }
            self.begun = true;
            if self.rows.is_empty() || self.columns.is_empty() {
                return None;
            }
            self.x = self.columns.start;
            self.row = renderer.row(self.rows.start);
        }
        let x = self.x;
        self.x += 1;
        Some((x, self.rows.start))
    }
}

/// The radiances of an area, traced as they are taken: column, row, radiance.
#[derive(Debug)]
pub struct Scan<'r, 'a, A: Arithmetic, const MAX_DEPTH: usize, T, S> {
    renderer: &'r mut Renderer<'a, A, MAX_DEPTH, T, S>,
    area: Area<A>,
}

impl<'s, A, const MAX_DEPTH: usize, T, S, const USES: u64> Iterator
    for Scan<'_, '_, A, MAX_DEPTH, T, S>
where
    A: Arithmetic,
    T: Tally,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    type Item = (u16, u16, Rgb<A::Radiance>);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        let (x, y) = self.area.next(self.renderer)?;
        Some((x, y, self.renderer.seen::<{ call_site::SCAN }>(self.area.asked(x, y))))
    }
}

/// The pixels of an area, traced as they are taken: column, row, pixel.
#[derive(Debug)]
pub struct Pixels<'r, 'a, A: Arithmetic, P, const MAX_DEPTH: usize, T, S> {
    renderer: &'r mut Renderer<'a, A, MAX_DEPTH, T, S>,
    sparse: Sparse,
    area: Area<A>,
    output: Output,
    pixel: PhantomData<P>,
}

impl<'s, A, P, const MAX_DEPTH: usize, T, S, const USES: u64> Iterator
    for Pixels<'_, '_, A, P, MAX_DEPTH, T, S>
where
    A: Arithmetic,
    P: Pixel,
    T: Tally,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    type Item = (u16, u16, P);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        let Some((x, y)) = self.area.next(self.renderer) else {
            // Of a scan that is dropped before, the sampler forgets where it stood.
            self.renderer.sparse = self.sparse.take();
            return None;
        };
        let (asked, output) = (self.area.asked(x, y), self.output);
        let sparse = &mut self.sparse;
        let values = self.renderer.values::<{ call_site::SCAN }>(sparse, asked, &output.tone);
        Some((x, y, output.shown(values, x, y)))
    }
}

//! The renderer: rows of radiance, in any order, in the caller's memory.

use super::{FrameError, Output, Pixel, Sampling, Settings, jitter};
use crate::math::{Arithmetic, Rgb, rgb};
use crate::scene::{Camera, Row, Scene, View, uses};
use crate::shape::Ray;
use crate::tally::Tally;
use crate::trace::{Tracer, Work};
use core::ops::Range;

/// The larger side of a picture at most.
const MAX_SIDE: u16 = 16_384;

/// Which row of corners is remembered, between which columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Remembered {
    y: u16,
    columns: (u16, u16),
}

/// Renders one frame of a scene, row by row.
///
/// Rows may be asked for in any order and as often as one likes, each gives the same radiances;
/// from top to bottom is the cheapest.
#[derive(Debug)]
pub struct Renderer<
    'a,
    A: Arithmetic,
    const MAX_DEPTH: usize,
    T = (),
    const USES: u64 = { uses::ALL },
> {
    tracer: Tracer<'a, A, USES>,
    view: View<A>,
    settings: Settings,
    work: &'a mut Work<A, MAX_DEPTH>,
    /// The last row of corners traced, if the sampling wants one.
    samples: &'a mut [Rgb<A::Radiance>],
    remembered: Option<Remembered>,
    tally: T,
}

impl<'a, A: Arithmetic, const MAX_DEPTH: usize, const USES: u64>
    Renderer<'a, A, MAX_DEPTH, (), USES>
{
    /// A renderer that counts nothing. `samples` is memory for [`Sampling::samples`] radiances;
    /// what it holds doesn't matter.
    ///
    /// # Errors
    /// A size, depth or memory that doesn't fit.
    pub fn new(
        scene: &'a Scene<'a, A, USES>,
        camera: &Camera<A>,
        settings: Settings,
        work: &'a mut Work<A, MAX_DEPTH>,
        samples: &'a mut [Rgb<A::Radiance>],
    ) -> Result<Self, FrameError> {
        Self::with_tally(scene, camera, settings, work, samples, ())
    }
}

impl<'a, A: Arithmetic, const MAX_DEPTH: usize, T: Tally, const USES: u64>
    Renderer<'a, A, MAX_DEPTH, T, USES>
{
    /// A renderer that reports to `tally`.
    ///
    /// # Errors
    /// A size, depth or memory that doesn't fit.
    pub fn with_tally(
        scene: &'a Scene<'a, A, USES>,
        camera: &Camera<A>,
        settings: Settings,
        work: &'a mut Work<A, MAX_DEPTH>,
        samples: &'a mut [Rgb<A::Radiance>],
        tally: T,
    ) -> Result<Self, FrameError> {
        let Settings { width, height, depth, sampling } = settings;
        if width == 0 || height == 0 || width > MAX_SIDE || height > MAX_SIDE {
            return Err(FrameError::Size);
        }
        if depth == 0 || usize::from(depth) > MAX_DEPTH {
            let max = if MAX_DEPTH > 255 { 255 } else { MAX_DEPTH as u8 };
            return Err(FrameError::Depth { depth, max });
        }
        if let Sampling::Grid { side } | Sampling::Jittered { side, .. } = sampling
            && !(1..=8).contains(&side)
        {
            return Err(FrameError::Cells { side });
        }
        let needed = sampling.samples(width);
        if samples.len() < needed {
            return Err(FrameError::Samples { needed });
        }
        Ok(Self {
            tracer: Tracer::new(scene, depth),
            view: View::new(camera, width, height),
            settings,
            work,
            samples,
            remembered: None,
            tally,
        })
    }

    /// What the frame is.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// What has been counted so far.
    pub fn tally(&self) -> &T {
        &self.tally
    }

    /// The same, to be changed.
    pub fn tally_mut(&mut self) -> &mut T {
        &mut self.tally
    }

    /// Traces the pixels of an area, row by row, as they are taken; what of it lies outside the
    /// picture is left out.
    #[inline(always)]
    pub fn scan(
        &mut self,
        columns: Range<u16>,
        rows: Range<u16>,
    ) -> Scan<'_, 'a, A, MAX_DEPTH, T, USES> {
        let columns = columns.start..columns.end.min(self.settings.width);
        let rows = rows.start..rows.end.min(self.settings.height);
        let row = self.view.row(rows.start, 128);
        // As if the row above had just ended: the first `next` begins a row.
        let x = columns.end;
        Scan { renderer: self, columns, rows, x, row, left: [A::BLACK; 3], begun: false }
    }

    /// Writes the pixels of row `y`, as many as the slice holds.
    #[inline(always)]
    pub fn line<P: Pixel>(&mut self, y: u16, output: &Output, pixels: &mut [P]) {
        let rows = y..y.saturating_add(1);
        let width = self.settings.width;
        for (pixel, (x, y, radiance)) in pixels.iter_mut().zip(self.scan(0..width, rows)) {
            *pixel = output.pixel::<A, P>(&radiance, x, y);
        }
    }

    /// The camera's ray through a pixel's centre, for tools that look at one pixel.
    pub fn ray(&self, x: u16, y: u16) -> Ray<A> {
        self.view.ray(&self.view.row(y, 128), x, 128)
    }

    /// The radiance along any ray.
    pub fn radiance(&mut self, ray: &Ray<A>) -> Rgb<A::Radiance> {
        self.tracer.radiance(*ray, self.work, &mut self.tally)
    }

    #[inline(always)]
    fn trace(&mut self, row: &Row<A>, x: u16, fraction: u8) -> Rgb<A::Radiance> {
        let ray = self.view.ray(row, x, fraction);
        if USES & uses::AREA_LIGHTS != 0 {
            self.tracer.set_key(row.key(x, fraction));
        }
        self.tracer.radiance(ray, self.work, &mut self.tally)
    }
}

/// The pixels of an area, traced as they are taken: column, row, radiance.
#[derive(Debug)]
pub struct Scan<'r, 'a, A: Arithmetic, const MAX_DEPTH: usize, T, const USES: u64> {
    renderer: &'r mut Renderer<'a, A, MAX_DEPTH, T, USES>,
    columns: Range<u16>,
    /// The current row and the end.
    rows: Range<u16>,
    x: u16,
    row: Row<A>,
    /// The corner below and left of the next pixel.
    left: Rgb<A::Radiance>,
    begun: bool,
}

impl<A: Arithmetic, const MAX_DEPTH: usize, T: Tally, const USES: u64>
    Scan<'_, '_, A, MAX_DEPTH, T, USES>
{
    /// Goes to the start of the next row; `false` below the last.
    #[inline(always)]
    fn next_row(&mut self) -> bool {
        if self.begun {
            self.rows.start += 1;
        }
        self.begun = true;
        if self.rows.is_empty() || self.columns.is_empty() {
            return false;
        }
        self.x = self.columns.start;
        let y = self.rows.start;
        match self.renderer.settings.sampling {
            Sampling::Center => self.row = self.renderer.view.row(y, 128),
            Sampling::Grid { .. } | Sampling::Jittered { .. } => {}
            Sampling::Corners => {
                let wanted = Remembered { y, columns: (self.columns.start, self.columns.end) };
                if self.renderer.remembered != Some(wanted) {
                    let row = self.renderer.view.row(y, 0);
                    for x in self.columns.start..=self.columns.end {
                        let corner = self.renderer.trace(&row, x, 0);
                        self.remember(x, corner);
                    }
                }
                // A scan that isn't finished leaves a row that is of no use.
                self.renderer.remembered = None;
                self.row = self.renderer.view.row(y + 1, 0);
                self.left = self.renderer.trace(&self.row, self.x, 0);
            }
        }
        true
    }

    #[inline(always)]
    fn remember(&mut self, x: u16, corner: Rgb<A::Radiance>) {
        if let Some(place) = self.renderer.samples.get_mut(usize::from(x)) {
            *place = corner;
        }
    }

    /// The mean of a ray to each of `side`×`side` cells of the pixel at x, at the place that
    /// `place` gives.
    #[inline(always)]
    fn cells(
        &mut self,
        x: u16,
        side: u8,
        place: impl Fn((u8, u8)) -> (u8, u8),
    ) -> Rgb<A::Radiance> {
        let mut sum = [A::BLACK; 3];
        for j in 0..side {
            for i in 0..side {
                let (right, down) = place((i, j));
                let row = self.renderer.view.row(self.rows.start, down);
                let radiance = self.renderer.trace(&row, x, right);
                sum = rgb(&sum, &radiance, A::gather);
            }
        }
        sum.map(|sum| A::mean(sum, u16::from(side) * u16::from(side)))
    }

    /// The mean of the four corners of the pixel at x.
    #[inline(always)]
    fn corners(&mut self, x: u16) -> Rgb<A::Radiance> {
        let right = self.renderer.trace(&self.row, x + 1, 0);
        let samples = &self.renderer.samples;
        let above = |i: u16| samples.get(usize::from(i)).copied().unwrap_or([A::BLACK; 3]);
        let top = rgb(&above(x), &above(x + 1), A::gather);
        let bottom = rgb(&self.left, &right, A::gather);
        self.remember(x, self.left);
        self.left = right;
        if x + 1 == self.columns.end {
            self.remember(x + 1, right);
            let columns = (self.columns.start, self.columns.end);
            self.renderer.remembered = Some(Remembered { y: self.rows.start + 1, columns });
        }
        rgb(&top, &bottom, |a, b| A::mean(A::gather(a, b), 4))
    }
}

impl<A: Arithmetic, const MAX_DEPTH: usize, T: Tally, const USES: u64> Iterator
    for Scan<'_, '_, A, MAX_DEPTH, T, USES>
{
    type Item = (u16, u16, Rgb<A::Radiance>);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        if self.x >= self.columns.end && !self.next_row() {
            return None;
        }
        let x = self.x;
        self.x += 1;
        let radiance = match self.renderer.settings.sampling {
            Sampling::Center => self.renderer.trace(&self.row, x, 128),
            Sampling::Corners => self.corners(x),
            Sampling::Grid { side } => self.cells(x, side, |cell| jitter::middle(cell, side)),
            Sampling::Jittered { side, seed } => {
                let pixel = (x, self.rows.start);
                self.cells(x, side, |cell| jitter::jittered(cell, side, pixel, seed))
            }
        };
        Some((x, self.rows.start, radiance))
    }
}

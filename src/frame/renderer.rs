//! The renderer: rows of radiance, in any order, in the caller's memory.

use super::sample::Watch;
use super::sparse::{FEW_RAYS, Sparse};
use super::{FrameError, Output, Pixel, Sample, Sampling, Settings, Tone, jitter};
use crate::math::{Arithmetic, Rgb, rgb};
use crate::scene::uses::{self, has};
use crate::scene::{Camera, Row, Scene, SceneRef, View};
use crate::shape::Ray;
use crate::tally::Tally;
use crate::trace::{Terms, Tracer, Work, call_site};

/// The larger side of a picture at most.
const MAX_SIDE: u16 = 16_384;

/// Which row of corners or of blocks is remembered, between which columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Remembered {
    pub(super) y: u16,
    pub(super) columns: (u16, u16),
}

/// A pixel that is asked for.
#[derive(Clone, Copy)]
pub(super) struct Asked<'r, A: Arithmetic> {
    /// The rays through the centres of its row.
    pub(super) row: &'r Row<A>,
    pub(super) x: u16,
    pub(super) y: u16,
    /// The columns that are asked for in this row, the first and the one behind the last, one after the
    /// other.
    pub(super) columns: (u16, u16),
}

/// Renders one frame of a scene, row by row.
///
/// Rows may be asked for in any order and as often as one likes, each gives the same radiances;
/// from top to bottom is the cheapest.
#[derive(Debug)]
pub struct Renderer<'a, A: Arithmetic, const MAX_DEPTH: usize, T = (), S = &'a Scene<'a, A>> {
    tracer: Tracer<S>,
    pub(super) view: View<A>,
    pub(super) settings: Settings,
    work: &'a mut Work<A, MAX_DEPTH>,
    /// What the sampling remembers, if it does.
    samples: &'a mut [Sample<A>],
    pub(super) remembered: Option<Remembered>,
    pub(super) sparse: Sparse,
    /// Of adaptive sampling: whether the pixel's corners differ, from the pixel to the right (bit 0) to
    /// the one to the left (bit 2).
    pub(super) flags: u8,
    pub(super) tally: T,
}

impl<'a, 's, A, const MAX_DEPTH: usize, S, const USES: u64> Renderer<'a, A, MAX_DEPTH, (), S>
where
    A: Arithmetic,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    /// A renderer that counts nothing. `samples` is memory for [`Sampling::samples`] samples;
    /// what it holds doesn't matter.
    ///
    /// # Errors
    /// A size, depth, sampling or memory that doesn't fit.
    // In line, so that what draws knows which scene it is.
    #[inline(always)]
    pub fn new(
        scene: S,
        camera: &Camera<A>,
        settings: Settings,
        work: &'a mut Work<A, MAX_DEPTH>,
        samples: &'a mut [Sample<A>],
    ) -> Result<Self, FrameError> {
        Self::with_tally(scene, camera, settings, work, samples, ())
    }
}

impl<'a, 's, A, const MAX_DEPTH: usize, T, S, const USES: u64> Renderer<'a, A, MAX_DEPTH, T, S>
where
    A: Arithmetic,
    T: Tally,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    /// A renderer that reports to `tally`.
    ///
    /// # Errors
    /// A size, depth, sampling or memory that doesn't fit.
    #[inline(always)]
    pub fn with_tally(
        scene: S,
        camera: &Camera<A>,
        settings: Settings,
        work: &'a mut Work<A, MAX_DEPTH>,
        samples: &'a mut [Sample<A>],
        tally: T,
    ) -> Result<Self, FrameError> {
        let Settings { width, height, depth, sampling, terms } = settings;
        if width == 0 || height == 0 || width > MAX_SIDE || height > MAX_SIDE {
            return Err(FrameError::Size);
        }
        if depth == 0 || usize::from(depth) > MAX_DEPTH {
            let max = if MAX_DEPTH > 255 { 255 } else { MAX_DEPTH as u8 };
            return Err(FrameError::Depth { depth, max });
        }
        sampling.check()?;
        if !has(USES, sampling.uses()) || (terms != Terms::ALL && !has(USES, uses::TERMS)) {
            return Err(FrameError::Tailored);
        }
        let needed = sampling.samples(width);
        if samples.len() < needed {
            return Err(FrameError::Samples { needed });
        }
        work.look(&scene, camera.eye());
        Ok(Self {
            tracer: Tracer::new(scene, depth).with_terms(terms),
            view: View::new(camera, width, height),
            settings,
            work,
            samples,
            remembered: None,
            sparse: Sparse::new(width, height, sampling),
            flags: 0,
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

    /// The rays through the centres of the row of pixels at y, many of which follow.
    #[inline(always)]
    pub(super) fn row(&self, y: u16) -> Row<A> {
        let mut row = self.view.row(y, 128);
        // By sparse sampling few follow.
        let many = !matches!(self.settings.sampling, Sampling::Sparse { .. });
        row.clear = many && self.tracer.is_clear(self.view, row, self.settings.width);
        row
    }

    /// Writes the pixels of row `y`, as many as the slice holds.
    #[inline(always)]
    pub fn line<P: Pixel>(&mut self, y: u16, output: &Output, pixels: &mut [P]) {
        if y >= self.settings.height {
            return;
        }
        let row = self.row(y);
        let width = self.settings.width;
        // In a place of its own: the renderer itself isn't lent to what is out of line, so that the
        // compiler knows which scene the tracer is given.
        let mut sparse = self.sparse.take();
        let tone = &output.tone;
        let mut ready = false;
        for (x, pixel) in (0..width).zip(pixels.iter_mut()) {
            let asked = Asked { row: &row, x, y, columns: (0, width) };
            let traced = self.traced::<{ call_site::LINE }>(&mut sparse, asked, tone);
            let Some(values) = traced else {
                ready = true;
                break;
            };
            *pixel = output.shown(values, x, y);
        }
        if ready {
            for ((x, pixel), values) in (0..width).zip(pixels).zip(self.ready()) {
                *pixel = output.shown(values, x, y);
            }
        }
        self.sparse = sparse;
    }

    /// The display values of the row of pixels that sparse sampling has made ready.
    #[inline(always)]
    pub(super) fn ready(&self) -> impl Iterator<Item = [u16; 3]> {
        Sparse::pixels_of(Sample::words(self.samples))
    }

    /// The display values of a pixel, by whatever sampling.
    #[inline(always)]
    pub(super) fn values<const SITE: u8>(
        &mut self,
        sparse: &mut Sparse,
        asked: Asked<'_, A>,
        tone: &Tone,
    ) -> [u16; 3] {
        let is_sparse = matches!(self.settings.sampling, Sampling::Sparse { .. });
        let traced = if has(USES, uses::SPARSE) && is_sparse && asked.x != asked.columns.0 {
            None
        } else {
            self.traced::<SITE>(sparse, asked, tone)
        };
        traced.unwrap_or_else(|| Sparse::pixel(asked.x, Sample::words(self.samples)))
    }

    /// The same by any sampling but the sparse; by sparse sampling, makes the row of pixels ready and says
    /// nothing.
    #[inline(always)]
    pub(super) fn traced<const SITE: u8>(
        &mut self,
        sparse: &mut Sparse,
        asked: Asked<'_, A>,
        tone: &Tone,
    ) -> Option<[u16; 3]> {
        let sampling = self.settings.sampling;
        if has(USES, uses::SPARSE) && matches!(sampling, Sampling::Center | Sampling::Sparse { .. })
        {
            self.sparse::<SITE>(sparse, asked, tone)
        } else {
            Some(tone.values::<A>(&self.seen::<SITE>(asked)))
        }
    }

    /// The radiance of a pixel, by any sampling but the sparse.
    #[inline(always)]
    pub(super) fn seen<const SITE: u8>(&mut self, asked: Asked<'_, A>) -> Rgb<A::Radiance> {
        let Asked { row, x, y, columns } = asked;
        let center = matches!(self.settings.sampling, Sampling::Center | Sampling::Sparse { .. });
        if !uses::has_samplings(USES & !uses::SPARSE) || center {
            self.trace::<SITE>(row, x, 128)
        } else {
            self.sampled(x, y, columns)
        }
    }

    /// Traces the rays that sparse sampling wants for a row of pixels; or one through the pixel's centre: the
    /// tracer stands here once for both.
    #[inline(always)]
    fn sparse<const SITE: u8>(
        &mut self,
        sparse: &mut Sparse,
        asked: Asked<'_, A>,
        tone: &Tone,
    ) -> Option<[u16; 3]> {
        let every = self.settings.sampling == Sampling::Center;
        let Asked { row, x, y, columns } = asked;
        let mut row = *row;
        loop {
            let (mut at_x, mut at_y) = (x, y);
            if !every {
                (at_x, at_y) = sparse.next(y, columns, tone, Sample::words_mut(self.samples))?;
            }
            if row.number() != u32::from(at_y) {
                row = self.view.row(at_y, 128);
            }
            let ray = self.view.ray(&row, at_x, 128);
            self.prepare(&row, at_x, 128);
            let mut nothing = T::NOTHING;
            let tally = nothing.as_mut().unwrap_or(&mut self.tally);
            let (radiance, rays) = if uses::has_samplings(USES & !uses::SPARSE) {
                // As in `trace`.
                let mut watch = Watch::<T>::new(tally);
                let seen = self
                    .tracer
                    .seen::<{ call_site::ANY }, _, _>(ray, row.clear, self.work, &mut watch);
                (seen, watch.rays())
            } else {
                let mut watch = Watch::<T, false>::new(tally);
                let seen = self.tracer.seen::<SITE, _, _>(ray, row.clear, self.work, &mut watch);
                (seen, watch.rays())
            };
            let values = tone.values::<A>(&radiance);
            if every {
                return Some(values);
            }
            sparse.tell(values, rays > FEW_RAYS, Sample::words_mut(self.samples));
        }
    }

    /// The camera's ray through a pixel's centre, for tools that look at one pixel.
    pub fn ray(&self, x: u16, y: u16) -> Ray<A> {
        self.view.ray(&self.view.row(y, 128), x, 128)
    }

    /// The radiance along any ray.
    #[inline(always)]
    pub fn radiance(&mut self, ray: &Ray<A>) -> Rgb<A::Radiance> {
        // The tracer is compiled once: for samplings that compare what rays hit, if there may be
        // any.
        if has(USES, uses::ADAPTIVE) {
            self.tracer.radiance(*ray, self.work, &mut Watch::<T>::new(&mut self.tally))
        } else {
            self.tracer.radiance(*ray, self.work, &mut self.tally)
        }
    }

    /// The radiance of the ray that is `fraction`/256 pixels right of the left edge of the pixel at
    /// x, in a row of rays.
    #[inline(always)]
    pub(super) fn trace<const SITE: u8>(
        &mut self,
        row: &Row<A>,
        x: u16,
        fraction: u8,
    ) -> Rgb<A::Radiance> {
        let ray = self.view.ray(row, x, fraction);
        self.prepare(row, x, fraction);
        if has(USES, uses::ADAPTIVE) {
            // As in `radiance`.
            let mut watch = Watch::<T>::new(&mut self.tally);
            self.tracer.seen::<{ call_site::ANY }, _, _>(ray, row.clear, self.work, &mut watch)
        } else if uses::has_samplings(USES) {
            self.tracer.seen::<{ call_site::ANY }, _, _>(ray, row.clear, self.work, &mut self.tally)
        } else {
            // The renderer isn't lent to what is out of line where nothing is counted: so the compiler knows
            // what stands in it, the scene above all.
            let mut nothing = T::NOTHING;
            let tally = nothing.as_mut().unwrap_or(&mut self.tally);
            self.tracer.seen::<SITE, _, _>(ray, row.clear, self.work, tally)
        }
    }

    /// Prepares for a ray.
    #[inline(always)]
    fn prepare(&mut self, row: &Row<A>, x: u16, fraction: u8) {
        if uses::has_random(USES) {
            self.tracer.set_key(row.key(x, fraction));
        }
        if has(USES, uses::TREE) {
            self.work.begin_row(row.number());
        }
        if has(USES, uses::VIRTUAL_LIGHTS) {
            self.tracer.set_turn(row.in_tile(x));
        }
    }

    /// What the ray finds that is so many 1/256 of a pixel right of and below the upper left corner
    /// of the pixel at (x, y).
    #[inline(never)]
    pub(super) fn sample(&mut self, x: u16, right: u8, y: u16, down: u8) -> Sample<A> {
        let row = self.view.row(y, down);
        let ray = self.view.ray(&row, x, right);
        self.prepare(&row, x, right);
        let mut watch = Watch::<T>::new(&mut self.tally);
        let radiance =
            self.tracer.seen::<{ call_site::ANY }, _, _>(ray, row.clear, self.work, &mut watch);
        watch.sample(radiance)
    }

    /// A remembered sample.
    #[inline(always)]
    pub(super) fn remembered(&self, index: usize) -> Sample<A> {
        self.samples.get(index).copied().unwrap_or(Sample::NONE)
    }

    /// Remembers a sample.
    #[inline(always)]
    pub(super) fn remember(&mut self, index: usize, sample: Sample<A>) {
        if let Some(place) = self.samples.get_mut(index) {
            *place = sample;
        }
    }

    /// The pixel at (x, y), by any sampling but one ray through its centre. `columns` are those
    /// that are asked for in this row, from the first to the last, one after the other.
    #[inline(always)]
    pub(super) fn sampled(&mut self, x: u16, y: u16, columns: (u16, u16)) -> Rgb<A::Radiance> {
        match self.settings.sampling {
            Sampling::Grid { side } if has(USES, uses::CELLS) => self.cells(x, y, side, None),
            Sampling::Jittered { side, seed } if has(USES, uses::CELLS) => {
                self.cells(x, y, side, Some(seed))
            }
            Sampling::Corners if has(USES, uses::CORNERS) => self.corners(x, y, columns),
            Sampling::Adaptive { depth, threshold } if has(USES, uses::ADAPTIVE) => {
                self.adaptive(x, y, columns, depth, threshold)
            }
            // The renderer isn't made for a sampling that the scene isn't tailored to.
            _ => self.trace::<{ call_site::ANY }>(&self.view.row(y, 128), x, 128),
        }
    }

    /// The mean of a ray to each of `side`×`side` cells of the pixel: through its middle, or moved
    /// as the seed says.
    #[inline(never)]
    fn cells(&mut self, x: u16, y: u16, side: u8, seed: Option<u16>) -> Rgb<A::Radiance> {
        let mut sum = [A::BLACK; 3];
        for j in 0..side {
            for i in 0..side {
                let (right, down) = match seed {
                    None => jitter::middle((i, j), side),
                    Some(seed) => jitter::jittered((i, j), side, (x, y), seed),
                };
                let radiance = self.trace::<{ call_site::ANY }>(&self.view.row(y, down), x, right);
                sum = rgb(&sum, &radiance, A::gather);
            }
        }
        sum.map(|sum| A::mean(sum, u16::from(side) * u16::from(side)))
    }
}

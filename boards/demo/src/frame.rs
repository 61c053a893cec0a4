//! The frame loop: one row after another, through one row buffer.

use whitted::frame::{Output, Renderer, Rgb888, Sample, Sampling, Settings};
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Camera, Scene};
use whitted::tally::{Counts, Tally};
use whitted::trace::Work;

use crate::checksum::Checksum;
use crate::job::{ArithName, Job, MAX_SAMPLES, MAX_WIDTH, sampled};
use crate::scenes::{Shot, Shots, View};

/// The depth that there is memory for.
pub const MAX_DEPTH: usize = 5;

/// Who wants to know about rows. A board counts between the two calls.
pub trait Watch {
    /// A row is about to be traced.
    fn before(&mut self) {}
    /// It has been.
    fn after(&mut self) {}
}

/// Nobody does.
impl Watch for () {}

/// Draws a job, giving each row to `show`. The checksum is that of the pixels, three bytes each,
/// red first, row by row.
pub fn draw(job: &Job, watch: &mut impl Watch, show: impl FnMut(&[Rgb888])) -> Checksum {
    run::<()>(job, watch, show).0
}

/// The same, counting rays, which costs a little.
pub fn count(job: &Job) -> (Checksum, Counts) {
    run::<Counts>(job, &mut (), |_| {})
}

fn run<T: Tally + Copy + Default>(
    job: &Job,
    watch: &mut impl Watch,
    show: impl FnMut(&[Rgb888]),
) -> (Checksum, T) {
    let frame = Frame { job, watch, show, tally: T::default() };
    match (job.arith, job.sampling) {
        (ArithName::Fixed, Sampling::Center) => Fixed::shot(job.scene, frame),
        (ArithName::Fixed, _) => Fixed::sampled(frame),
        (ArithName::F32, sampling) if sampling != Sampling::Center && sampled(ArithName::F32) => {
            f32::sampled(frame)
        }
        (ArithName::F32, _) => f32::shot(job.scene, frame),
    }
}

/// A frame to draw.
struct Frame<'a, W, S, T> {
    job: &'a Job,
    watch: &'a mut W,
    show: S,
    tally: T,
}

impl<A, W, S, T> View<A> for Frame<'_, W, S, T>
where
    A: Arithmetic,
    W: Watch,
    S: FnMut(&[Rgb888]),
    T: Tally + Copy,
{
    type Output = (Checksum, T);

    fn view<const USES: u64>(self, shot: Shot<A, USES>) -> (Checksum, T) {
        if self.job.sampling == Sampling::Center {
            self.draw(shot, &mut [])
        } else {
            self.sampled(shot)
        }
    }
}

impl<W, S, T> Frame<'_, W, S, T>
where
    W: Watch,
    S: FnMut(&[Rgb888]),
    T: Tally + Copy,
{
    /// With room for samples.
    #[inline(never)]
    fn sampled<A: Arithmetic, const USES: u64>(self, shot: Shot<A, USES>) -> (Checksum, T) {
        self.draw(shot, &mut [Sample::NONE; MAX_SAMPLES])
    }

    /// The shot's parts one by one: the compiler then sees that they are always the same statics,
    /// as they are in a firmware that draws but one scene, and reads them where they are used.
    #[inline(always)]
    fn draw<A: Arithmetic, const USES: u64>(
        self,
        shot: Shot<A, USES>,
        samples: &mut [Sample<A>],
    ) -> (Checksum, T) {
        self.draw_scene(shot.scene, shot.camera, shot.depth, shot.output, samples)
    }

    /// Not inlined, so that its stack frame, with the row and the tracer's memory, is its own.
    ///
    /// # Panics
    /// Never: a job's size fits, and no scene is deeper than the memory.
    #[inline(never)]
    fn draw_scene<A: Arithmetic, const USES: u64>(
        mut self,
        scene: &Scene<'_, A, USES>,
        camera: &Camera<A>,
        depth: u8,
        output: Output,
        samples: &mut [Sample<A>],
    ) -> (Checksum, T) {
        let job = self.job;
        let mut work = Work::<A, MAX_DEPTH>::new();
        let mut settings = Settings::new(job.width, job.height);
        (settings.depth, settings.sampling) = (depth, job.sampling);
        let mut renderer =
            Renderer::with_tally(scene, camera, settings, &mut work, samples, self.tally)
                .expect("a job fits");

        let mut checksum = Checksum::EMPTY;
        let mut row = [Rgb888::default(); MAX_WIDTH as usize];
        let row = row.get_mut(..usize::from(job.width)).unwrap_or_default();
        for y in 0..job.height {
            self.watch.before();
            renderer.line(y, &output, row);
            self.watch.after();
            checksum.add(row.iter().flat_map(|&Rgb888(rgb)| rgb));
            (self.show)(row);
        }
        (checksum, *renderer.tally())
    }
}

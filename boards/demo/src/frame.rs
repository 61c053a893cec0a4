//! The frame loop: one row after another, through one row buffer.

use whitted::frame::{Renderer, Rgb888, Sample, Sampling, Settings};
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Scene, SceneRef};
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
#[cfg_attr(target_os = "none", inline)]
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
        (ArithName::Fixed, Sampling::Sparse { .. }) => Fixed::sparse(Sampled(frame)),
        (ArithName::Fixed, _) => Fixed::sampled(Sampled(frame)),
        (ArithName::F32, Sampling::Sparse { .. }) if sampled(ArithName::F32) => {
            f32::sparse(Sampled(frame))
        }
        (ArithName::F32, sampling) if sampling != Sampling::Center && sampled(ArithName::F32) => {
            f32::sampled(Sampled(frame))
        }
        (ArithName::F32, _) => f32::shot(job.scene, frame),
    }
}

/// A frame to draw.
struct Frame<'a, W, F, T> {
    job: &'a Job,
    watch: &'a mut W,
    show: F,
    tally: T,
}

impl<A, W, F, T> View<A> for Frame<'_, W, F, T>
where
    A: Arithmetic,
    W: Watch,
    F: FnMut(&[Rgb888]),
    T: Tally + Copy,
{
    type Output = (Checksum, T);

    #[inline(always)]
    fn view<S, const USES: u64>(self, shot: Shot<A, S>) -> (Checksum, T)
    where
        S: SceneRef<Target = Scene<'static, A, USES>>,
    {
        self.draw_scene(&shot, &mut [])
    }
}

/// A frame to draw with room for samples.
struct Sampled<'a, W, F, T>(Frame<'a, W, F, T>);

impl<A, W, F, T> View<A> for Sampled<'_, W, F, T>
where
    A: Arithmetic,
    W: Watch,
    F: FnMut(&[Rgb888]),
    T: Tally + Copy,
{
    type Output = (Checksum, T);

    #[inline(always)]
    fn view<S, const USES: u64>(self, shot: Shot<A, S>) -> (Checksum, T)
    where
        S: SceneRef<Target = Scene<'static, A, USES>>,
    {
        self.0.draw_scene(&shot, &mut [Sample::NONE; MAX_SAMPLES])
    }
}

impl<W, F, T> Frame<'_, W, F, T>
where
    W: Watch,
    F: FnMut(&[Rgb888]),
    T: Tally + Copy,
{
    /// # Panics
    /// Never: a job's size fits, and no scene is deeper than the memory.
    #[inline(always)]
    fn draw_scene<A: Arithmetic, S, const USES: u64>(
        mut self,
        shot: &Shot<A, S>,
        samples: &mut [Sample<A>],
    ) -> (Checksum, T)
    where
        S: SceneRef<Target = Scene<'static, A, USES>>,
    {
        let job = self.job;
        let mut work = Work::<A, MAX_DEPTH>::new();
        let mut settings = Settings::new(job.width, job.height);
        (settings.depth, settings.sampling) = (shot.depth, job.sampling);
        let (scene, camera) = (shot.scene, shot.camera);
        let mut renderer =
            Renderer::with_tally(scene, camera, settings, &mut work, samples, self.tally)
                .expect("a job fits");

        let mut checksum = Checksum::EMPTY;
        let mut row = [Rgb888::default(); MAX_WIDTH as usize];
        let row = row.get_mut(..usize::from(job.width)).unwrap_or_default();
        for y in 0..job.height {
            self.watch.before();
            renderer.line(y, &shot.output, row);
            self.watch.after();
            checksum.add(row.iter().flat_map(|&Rgb888(rgb)| rgb));
            (self.show)(row);
        }
        (checksum, *renderer.tally())
    }
}

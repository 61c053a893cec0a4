//! What a colour display of 16-bit pixels shows, on the chip and on the host that compares.

use whitted::frame::{Renderer, Rgb565, Sample, Sampling, Settings};
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Scene, SceneRef};
use whitted::trace::Work;

use crate::frame::MAX_DEPTH;
use crate::job::{ArithName, Job, MAX_SAMPLES};
use crate::scenes::{Shot, Shots, View};

/// Bytes a pixel takes.
pub const BYTES: usize = 2;

/// A renderer of a shot.
///
/// # Panics
/// If a side is 0: no scene is deeper than the memory.
pub fn renderer<'a, A: Arithmetic, S, const USES: u64>(
    shot: &Shot<A, S>,
    width: u16,
    height: u16,
    work: &'a mut Work<A, MAX_DEPTH>,
) -> Renderer<'a, A, MAX_DEPTH, (), S>
where
    S: SceneRef<Target = Scene<'static, A, USES>>,
{
    sampled(shot, (width, height), Sampling::Center, work, &mut [])
}

/// The same by a sampling, which has memory for its samples.
///
/// # Panics
/// If a side is 0, or there are fewer samples than the sampling takes: no scene is deeper than the memory.
pub fn sampled<'a, A: Arithmetic, S, const USES: u64>(
    shot: &Shot<A, S>,
    (width, height): (u16, u16),
    sampling: Sampling,
    work: &'a mut Work<A, MAX_DEPTH>,
    samples: &'a mut [Sample<A>],
) -> Renderer<'a, A, MAX_DEPTH, (), S>
where
    S: SceneRef<Target = Scene<'static, A, USES>>,
{
    let settings = Settings { depth: shot.depth, sampling, ..Settings::new(width, height) };
    Renderer::new(shot.scene, shot.camera, settings, work, samples)
        .expect("a picture with sides, and samples as it takes")
}

/// Adds pixels to a sum that tells pictures apart, of 32 bits (FNV-1a over pixels), since on a
/// small core it must cost little beside tracing.
#[must_use]
pub fn sum(sum: u32, bytes: &[u8]) -> u32 {
    bytes.as_chunks::<BYTES>().0.iter().fold(sum, |sum, &pixel| {
        (sum ^ u32::from(u16::from_be_bytes(pixel))).wrapping_mul(0x0100_0193)
    })
}

/// Draws a job into bytes, big-endian, row by row; as many rows as there is room for.
#[cfg_attr(target_os = "none", inline)]
pub fn draw(job: &Job, bytes: &mut [u8]) {
    match job.arith {
        ArithName::Fixed => draw_in::<Fixed>(job, bytes),
        ArithName::F32 => draw_in::<f32>(job, bytes),
    }
}

fn draw_in<A: Shots>(job: &Job, bytes: &mut [u8]) {
    match job.sampling {
        Sampling::Center => A::shot(job.scene, Bytes { job, bytes }),
        Sampling::Sparse { .. } => A::sparse(Bytes { job, bytes }),
        _ => A::sampled(Bytes { job, bytes }),
    }
}

struct Bytes<'a> {
    job: &'a Job,
    bytes: &'a mut [u8],
}

impl<A: Arithmetic> View<A> for Bytes<'_> {
    type Output = ();

    fn view<S, const USES: u64>(self, shot: Shot<A, S>)
    where
        S: SceneRef<Target = Scene<'static, A, USES>>,
    {
        let &Job { width, height, sampling, .. } = self.job;
        let mut work = Work::new();
        let mut samples = [Sample::NONE; MAX_SAMPLES];
        let mut renderer = sampled(&shot, (width, height), sampling, &mut work, &mut samples);
        renderer.band::<Rgb565>(0, &shot.output, self.bytes);
    }
}

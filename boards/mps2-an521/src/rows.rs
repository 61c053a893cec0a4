//! The picture that both cores work on: rows are dealt out by a counter, and pixels are stored where
//! either core reads them.

use core::sync::atomic::{AtomicU8, AtomicU16, AtomicU32, Ordering};

use cortex_m::peripheral::SYST;
use whitted::frame::{Renderer, Rgb888, Settings};
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Scene, SceneRef};
use whitted::trace::Work;
use whitted_demo::checksum::Checksum;
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::job::{ArithName, Job, MAX_WIDTH, SceneName};
use whitted_demo::scenes::{Shot, Shots, View};

/// The cores' clock.
pub(crate) const CLOCK_KHZ: u32 = 20_000;
/// SysTick has 24 bits.
const TICKS: u32 = 0x00FF_FFFF;
/// The most rows there is memory for.
const MAX_HEIGHT: usize = 240;

static NEXT: AtomicU16 = AtomicU16::new(0);
static SCENE: AtomicU8 = AtomicU8::new(0);
static ARITH: AtomicU8 = AtomicU8::new(0);
static SIZE: AtomicU32 = AtomicU32::new(0);
static PIXELS: [AtomicU32; MAX_WIDTH as usize * MAX_HEIGHT] =
    [const { AtomicU32::new(0) }; MAX_WIDTH as usize * MAX_HEIGHT];

/// Begins a job, while no core is at work.
pub(crate) fn begin(job: &Job) {
    let place = |found: Option<usize>| found.unwrap_or(0) as u8;
    SCENE.store(place(SceneName::ALL.iter().position(|&s| s == job.scene)), Ordering::Relaxed);
    ARITH.store(place(ArithName::ALL.iter().position(|&a| a == job.arith)), Ordering::Relaxed);
    let height = job.height.min(MAX_HEIGHT as u16);
    SIZE.store(u32::from(job.width) << 16 | u32::from(height), Ordering::Relaxed);
    NEXT.store(0, Ordering::Release);
}

fn size() -> (u16, u16) {
    let size = SIZE.load(Ordering::Relaxed);
    ((size >> 16) as u16, size as u16)
}

/// Traces rows of the job until none is left; returns the instructions that took.
pub(crate) fn work() -> u32 {
    let scene = SceneName::ALL[usize::from(SCENE.load(Ordering::Relaxed)) % SceneName::ALL.len()];
    match ArithName::ALL[usize::from(ARITH.load(Ordering::Relaxed)) % ArithName::ALL.len()] {
        ArithName::Fixed => Fixed::shot(scene, Rows),
        ArithName::F32 => f32::shot(scene, Rows),
    }
}

struct Rows;

impl<A: Arithmetic> View<A> for Rows {
    type Output = u32;

    #[inline(always)]
    fn view<S, const USES: u64>(self, shot: Shot<A, S>) -> u32
    where
        S: SceneRef<Target = Scene<'static, A, USES>>,
    {
        let (width, height) = size();
        let mut work = Work::<A, MAX_DEPTH>::new();
        let settings = Settings { depth: shot.depth, ..Settings::new(width, height) };
        let mut renderer = Renderer::new(shot.scene, shot.camera, settings, &mut work, &mut [])
            .expect("a job fits");
        let mut row = [Rgb888::default(); MAX_WIDTH as usize];
        let row = &mut row[..usize::from(width)];
        let mut ticks = 0;
        loop {
            let y = NEXT.fetch_add(1, Ordering::AcqRel);
            if y >= height {
                // A tick is 50 instructions of a nanosecond.
                return ticks * (1_000_000 / CLOCK_KHZ);
            }
            let start = SYST::get_current();
            renderer.line(y, &shot.output, row);
            // It counts downwards.
            ticks += start.wrapping_sub(SYST::get_current()) & TICKS;
            let line = PIXELS.iter().skip(usize::from(y) * usize::from(width));
            for (place, &Rgb888([r, g, b])) in line.zip(&*row) {
                place.store(u32::from_be_bytes([0, r, g, b]), Ordering::Relaxed);
            }
            // Gives the other core its turn, in an emulator that runs one at a time.
            // SAFETY: changes nothing.
            unsafe { core::arch::asm!("yield", options(nomem, nostack, preserves_flags)) };
        }
    }
}

/// The checksum of the picture, once no core is at work.
pub(crate) fn checksum() -> Checksum {
    let (width, height) = size();
    let mut checksum = Checksum::EMPTY;
    for pixel in PIXELS.iter().take(usize::from(width) * usize::from(height)) {
        let [_, rgb @ ..] = pixel.load(Ordering::Relaxed).to_be_bytes();
        checksum.add(rgb);
    }
    checksum
}

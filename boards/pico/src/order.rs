//! What to draw, if somebody says so.

use core::ptr;

use whitted::frame::Sampling;
use whitted_demo::job::{Job, SceneName};
use whitted_demo::{rgb565, scenes};

use crate::chip::ARITH;
use crate::panel;

/// A job and a way to draw it, as `limit:fixed:60x45 bands`, filled up with blanks; all blank in
/// the image that is built. The emulator, or whoever patches the image, writes here.
// SAFETY: nothing else has this name.
#[unsafe(no_mangle)]
#[used]
static ORDER: [u8; 48] = [b' '; 48];

/// How a frame gets to the display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// Bands of bytes, traced into one buffer while the other is sent.
    Bands,
    /// As an image of embedded-graphics.
    Graphics,
    /// Traced, but not sent, nor is the display started: to know what sending costs, and for an
    /// emulator that has no SPI.
    Trace,
}

/// A picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) scene: SceneName,
    pub(crate) width: u16,
    pub(crate) height: u16,
    /// One ray a pixel, or sparse where there is code for that.
    pub(crate) sampling: Sampling,
}

impl Frame {
    /// How many words it takes to tell the other core, which helps with one ray a pixel.
    pub(crate) const WORDS: usize = 2;

    pub(crate) fn words(self) -> [u32; Self::WORDS] {
        let scene = SceneName::ALL.iter().position(|&s| s == self.scene).unwrap_or(0);
        [scene as u32, u32::from(self.width) << 16 | u32::from(self.height)]
    }

    pub(crate) fn from_words([scene, size]: [u32; Self::WORDS]) -> Self {
        let scene = SceneName::ALL.get(scene as usize).copied().unwrap_or(SceneName::Showcase);
        let (width, height) = ((size >> 16) as u16, size as u16);
        Self { scene, width, height, sampling: Sampling::Center }
    }

    /// Bytes in a row.
    pub(crate) fn line(self) -> usize {
        usize::from(self.width) * rgb565::BYTES
    }
}

/// A picture and how it gets to the display.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Order {
    pub(crate) frame: Frame,
    pub(crate) way: Way,
}

impl Order {
    /// What [`ORDER`] says.
    ///
    /// # Panics
    /// If it says what can't be done: a misspelt word, another arithmetic, a frame larger than
    /// the display, or a sampling that the image has no code for.
    pub(crate) fn given() -> Option<Self> {
        // SAFETY: a reference is readable. Volatile, because the image is patched after the
        // compiler has seen the blanks.
        let text = unsafe { ptr::read_volatile(&raw const ORDER) };
        let text = core::str::from_utf8(&text).expect("an order in ASCII");
        let mut words = text.split_ascii_whitespace();
        let job: Job = words.next()?.parse().expect("a job, as limit:fixed:60x45");
        let way = match words.next() {
            Some("bands") | None => Way::Bands,
            Some("graphics") => Way::Graphics,
            Some("trace") => Way::Trace,
            Some(_) => panic!("ways are bands, graphics and trace"),
        };
        assert!(job.arith == ARITH, "this image draws in another arithmetic");
        let (across, down) = panel::SIZE;
        assert!(job.width <= across && job.height <= down, "the display is smaller");
        let Job { scene, width, height, sampling, .. } = job;
        match sampling {
            Sampling::Center => {}
            Sampling::Sparse { .. } if scenes::SPARSE_APART && way != Way::Graphics => {}
            _ => panic!("this image draws one ray a pixel"),
        }
        let frame = Frame { scene, width, height, sampling };
        Some(Self { frame, way })
    }
}

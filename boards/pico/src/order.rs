//! What to draw, if somebody says so.

use core::ptr;

use whitted_demo::job::{ArithName, Job, SceneName};

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
    /// Traced, but not sent: to know what sending costs.
    Trace,
}

/// One frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Order {
    pub(crate) scene: SceneName,
    pub(crate) width: u16,
    pub(crate) height: u16,
    pub(crate) way: Way,
}

impl Order {
    /// What [`ORDER`] says.
    ///
    /// # Panics
    /// If it says what can't be done: a misspelt word, software floating point, or a frame larger
    /// than the display.
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
        assert!(job.arith == ArithName::Fixed, "this board draws in fixed point");
        let (width, height) = panel::SIZE;
        assert!(job.width <= width && job.height <= height, "the display is smaller");
        Some(Self { scene: job.scene, width: job.width, height: job.height, way })
    }
}

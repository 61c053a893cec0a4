//! The frame loop: one row after another, through one row buffer.

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};

use crate::checksum::Checksum;
use crate::job::{Job, MAX_WIDTH};

/// Who wants to know about rows. A board counts between the two calls.
pub trait Watch {
    /// A row is about to be traced.
    fn before(&mut self) {}
    /// It has been.
    fn after(&mut self) {}
}

/// Nobody does.
impl Watch for () {}

/// What came out of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// Of the pixels, three bytes each, red first, row by row.
    pub checksum: Checksum,
    /// Rays by kind: primary, reflection, transmission, shadow, ambient.
    pub rays: [u32; 5],
}

/// Draws a job, giving each row to `show`.
///
/// Not inlined, so that its stack frame is the frame's and not the caller's.
#[inline(never)]
pub fn draw(job: &Job, watch: &mut impl Watch, mut show: impl FnMut(&[Rgb888])) -> Outcome {
    let mut checksum = Checksum::EMPTY;
    let mut row = [Rgb888::BLACK; MAX_WIDTH as usize];
    let row = row.get_mut(..usize::from(job.width)).unwrap_or_default();
    for y in 0..job.height {
        watch.before();
        for (x, pixel) in (0u16..).zip(row.iter_mut()) {
            *pixel = Rgb888::new(x as u8, y as u8, (x ^ y) as u8);
        }
        watch.after();
        checksum.add(row.iter().flat_map(|p| [p.r(), p.g(), p.b()]));
        show(row);
    }
    Outcome { checksum, rays: [0; 5] }
}

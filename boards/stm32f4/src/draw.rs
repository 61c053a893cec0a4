//! A frame: each row is traced, then sent.

use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::pixelcolor::raw::RawU16;
use mipidsi::interface::Interface;
use whitted::frame;
use whitted::math::{Arithmetic, Fixed};
use whitted::trace::Work;
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::job::{ArithName, Job, MAX_WIDTH};
use whitted_demo::rgb565::{self, BYTES};
use whitted_demo::scenes::{Shot, Shots, View};

use crate::board::{Display, Link};

/// Whether a frame got to the display; if not, why.
pub(crate) type Sent = Result<(), <Link as Interface>::Error>;

/// Draws a job in the display's upper left corner, one ray a pixel. After an error nothing more is sent;
/// each row opens its own window, so that the next frame is whole.
pub(crate) fn frame(display: &mut Display, job: &Job) -> Sent {
    let rows = Rows { display, job };
    match job.arith {
        ArithName::Fixed => Fixed::shot(job.scene, rows),
        ArithName::F32 => f32::shot(job.scene, rows),
    }
}

struct Rows<'a> {
    display: &'a mut Display,
    job: &'a Job,
}

impl<A: Arithmetic> View<A> for Rows<'_> {
    type Output = Sent;

    /// Not inlined, so that the stack it takes is its own.
    #[inline(never)]
    fn view<const USES: u64>(self, shot: Shot<A, USES>) -> Sent {
        let Job { width, height, .. } = *self.job;
        let mut work = Work::<A, MAX_DEPTH>::new();
        let mut renderer = rgb565::renderer(&shot, width, height, &mut work);
        let mut row = [0; MAX_WIDTH as usize * BYTES];
        let row = row.get_mut(..usize::from(width) * BYTES).unwrap_or_default();
        for y in 0..height {
            renderer.band::<frame::Rgb565>(y, &shot.output, row);
            let pixels = row.as_chunks::<BYTES>().0;
            let colors = pixels.iter().map(|&p| Rgb565::from(RawU16::new(u16::from_be_bytes(p))));
            self.display.set_pixels(0, y, width - 1, y, colors)?;
        }
        Ok(())
    }
}

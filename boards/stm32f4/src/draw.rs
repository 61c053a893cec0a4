//! A frame: bands of rows, traced and sent.

use core::iter;

use whitted::frame;
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Scene, SceneRef};
use whitted::trace::Work;
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::job::{ArithName, Job};
use whitted_demo::rgb565::{self, BYTES};
use whitted_demo::scenes::{Shot, Shots, View};

use crate::board::Display;
use crate::sender::Error;

/// Whether a frame got to the display; if not, why.
pub(crate) type Sent = Result<(), Error>;

/// Draws a job in the display's upper left corner, one ray a pixel. After an error nothing more is sent;
/// each frame opens its window anew, so that the next frame is whole.
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

    #[inline(always)]
    fn view<S, const USES: u64>(self, shot: Shot<A, S>) -> Sent
    where
        S: SceneRef<Target = Scene<'static, A, USES>>,
    {
        let Job { width, height, .. } = *self.job;
        let mut work = Work::<A, MAX_DEPTH>::new();
        let mut renderer = rgb565::renderer(&shot, width, height, &mut work);
        // The driver opens the window, the link fills it.
        self.display.set_pixels(0, 0, width - 1, height - 1, iter::empty())?;
        // SAFETY: only the pixels of the window that has just been opened are sent, so the driver
        // goes on knowing the controller's settings.
        let link = unsafe { self.display.dcs() };
        let mut y = 0;
        link.send_bands(|bytes| {
            let rows = renderer.band::<frame::Rgb565>(y, &shot.output, bytes);
            y += rows;
            usize::from(rows) * usize::from(width) * BYTES
        })
    }
}

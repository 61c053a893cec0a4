//! A frame: bands of rows, traced and sent.

use core::convert::Infallible;
use core::iter;

use embedded_hal::digital::OutputPin;
use embedded_hal_async::spi::SpiBus;
use mipidsi::Display;
use mipidsi::interface::InterfacePixelFormat;
use mipidsi::models::Model;
use whitted::frame::Rgb565;
use whitted::scene::{Scene, SceneRef};
use whitted::trace::Work;
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::job::SceneName;
use whitted_demo::rgb565::{self, BYTES};
use whitted_demo::scenes::{Shot, Shots, View};

use crate::link::{Buffers, Fault, Link};

/// A frame is to be drawn so many times until it is whole; then it is another scene's turn.
pub const TRIES: usize = 5;

/// A picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Of what.
    pub scene: SceneName,
    /// Pixels in a row, at least 1 and at most the display's, nor more than a band holds.
    pub width: u16,
    /// Rows, at least 1 and at most the display's.
    pub height: u16,
}

/// Draws a frame in the display's upper left corner, one ray a pixel, in an arithmetic.
///
/// # Errors
/// If the bus fails or stands still; the next frame is whole again.
pub async fn draw<A: Shots, S, C, D, M, R>(
    display: &mut Display<Link<S, C, D>, M, R>,
    frame: Frame,
    buffers: &mut Buffers,
) -> Result<(), Fault<S::Error>>
where
    S: SpiBus,
    C: OutputPin<Error = Infallible>,
    D: OutputPin<Error = Infallible>,
    M: Model,
    M::ColorFormat: InterfacePixelFormat<u8>,
    R: OutputPin,
{
    // The driver opens the window, the link fills it.
    display.set_pixels(0, 0, frame.width - 1, frame.height - 1, iter::empty())?;
    // SAFETY: only the pixels of the window that has just been opened are sent, so the driver goes
    // on knowing the controller's settings.
    let link = unsafe { display.dcs() };
    let mut y = 0;
    link.send(buffers, |bytes| {
        let rows = A::shot(frame.scene, Band { frame, y, bytes });
        y += rows;
        usize::from(rows) * usize::from(frame.width) * BYTES
    })
    .await
}

/// Tracing the rows from `y` on, as many as there is room for.
struct Band<'a> {
    frame: Frame,
    y: u16,
    bytes: &'a mut [u8],
}

impl<A: Shots> View<A> for Band<'_> {
    type Output = u16;

    /// The tracer's memory is on the stack while a band is traced, and isn't kept in the task for
    /// the time in between.
    #[inline(always)]
    fn view<S, const USES: u64>(self, shot: Shot<A, S>) -> u16
    where
        S: SceneRef<Target = Scene<'static, A, USES>>,
    {
        let Frame { width, height, .. } = self.frame;
        let mut work = Work::<A, MAX_DEPTH>::new();
        let mut renderer = rgb565::renderer(&shot, width, height, &mut work);
        renderer.band::<Rgb565>(self.y, &shot.output, self.bytes)
    }
}

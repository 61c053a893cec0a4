//! A frame, by each way.

use core::convert::Infallible;

use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor;
use embedded_graphics::prelude::*;
use embedded_hal::digital::OutputPin;
use whitted::Picture;
use whitted::frame::{Output, Renderer, Rgb565};
use whitted::math::Fixed;
use whitted::trace::Work;
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::rgb565;
use whitted_demo::scenes::{Shot, Shots, View};
use whitted_demo::stack;

use crate::board::{Board, Display};
use crate::log;
use crate::order::{Order, Way};

impl Board {
    /// Clears the display and draws a frame in its upper left corner, between two edges of the
    /// mark. The stack is painted below `top`.
    pub(crate) fn frame(&mut self, order: &Order, top: usize) {
        let Ok(()) = self.display.clear(RgbColor::BLACK);
        let start = self.timer.get_counter();
        let Ok(()) = self.mark.set_high();
        let Ok(()) = Fixed::shot(order.scene, Frame { display: &mut self.display, order });
        let Ok(()) = self.mark.set_low();
        let time = self.timer.get_counter() - start;
        let (stack, memory) = (stack::used(top), stack::static_bytes());
        log::frame(order, time.to_micros(), stack, memory);
    }
}

/// Where a frame goes, and how.
struct Frame<'a> {
    display: &'a mut Display,
    order: &'a Order,
}

impl View<Fixed> for Frame<'_> {
    type Output = Result<(), Infallible>;

    /// Not inlined, so that the stack it takes is its own.
    #[inline(never)]
    fn view<const USES: u64>(self, shot: Shot<Fixed, USES>) -> Result<(), Infallible> {
        let Self { display, order: &Order { width, height, way, .. } } = self;
        let mut work = Work::<_, MAX_DEPTH>::new();
        let mut renderer = rgb565::renderer(&shot, width, height, &mut work);
        let mut y = 0;
        let next = |bytes: &mut [u8]| band(&mut renderer, &mut y, &shot.output, bytes);
        match way {
            Way::Bands => {
                // The driver opens the window, the link fills it.
                display.set_pixels(0, 0, width - 1, height - 1, core::iter::empty())?;
                // SAFETY: only the pixels of the window that has just been opened are sent, so
                // the driver goes on knowing the controller's settings.
                unsafe { display.dcs() }.send_bands(next)
            }
            Way::Graphics => {
                let picture = Picture::<_, pixelcolor::Rgb565, MAX_DEPTH, (), USES>::from_renderer(
                    renderer,
                    shot.output,
                );
                Image::new(&picture, Point::zero()).draw(display)
            }
            Way::Trace => {
                // SAFETY: nothing is sent at all.
                unsafe { display.dcs() }.keep_bands(next);
                Ok(())
            }
        }
    }
}

/// Traces the rows from `y` on, as many as fit, and returns how many bytes that were. Not inlined:
/// the tracer is large, and two ways need it.
#[inline(never)]
fn band<const USES: u64>(
    renderer: &mut Renderer<'_, Fixed, MAX_DEPTH, (), USES>,
    y: &mut u16,
    output: &Output,
    bytes: &mut [u8],
) -> usize {
    let rows = renderer.band::<Rgb565>(*y, output, bytes);
    *y += rows;
    usize::from(rows) * usize::from(renderer.settings().width) * rgb565::BYTES
}

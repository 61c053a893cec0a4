//! A frame, by each way.

use core::sync::atomic::{AtomicU32, Ordering};

use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor;
use embedded_graphics::prelude::*;
use embedded_hal::digital::OutputPin;
use whitted::Picture;
use whitted::frame::{Output, Renderer, Rgb565};
use whitted::trace::Work;
use whitted_demo::deal::Claim;
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::rgb565;
use whitted_demo::scenes::{Shot, Shots, View};
use whitted_demo::stack;

use crate::board::{Board, Display};
use crate::chip::Number;
use crate::cores::Second;
use crate::link::Fault;
use crate::log;
use crate::order::{Frame, Order, Way};
use crate::rows::{self, Band};

/// A frame is drawn so many times until it is whole; then it is another scene's turn.
const TRIES: usize = 5;

impl Board {
    /// Draws a frame in the upper left corner of a display, between two edges of the mark; without
    /// one it is only traced. The stack is painted below `top`. If it can't be sent, the log says why and
    /// it is drawn again, a few times.
    pub(crate) fn frame(&mut self, mut display: Option<&mut Display>, order: &Order, top: usize) {
        for _ in 0..TRIES {
            match self.once(display.as_deref_mut(), order, top) {
                Ok(()) => break,
                Err(fault) => log::fault(order, fault),
            }
        }
    }

    fn once(
        &mut self,
        display: Option<&mut Display>,
        order: &Order,
        top: usize,
    ) -> Result<(), Fault> {
        let start = self.timer.get_counter();
        let Ok(()) = self.mark.set_high();
        let sent = match display {
            Some(display) => draw(display, &mut self.second, order),
            None => {
                keep(&mut self.second, order.frame);
                Ok(())
            }
        };
        let Ok(()) = self.mark.set_low();
        sent?;
        let time = self.timer.get_counter() - start;
        let (stack, memory) = (stack::used(top), stack::static_bytes());
        log::frame(order, time.to_micros(), stack, memory);
        Ok(())
    }
}

/// Not inlined, so that the stack it takes is its own.
#[inline(never)]
fn draw(display: &mut Display, second: &mut Second, order: &Order) -> Result<(), Fault> {
    let Order { frame, way } = *order;
    match way {
        Way::Bands => {
            // The driver opens the window, the link fills it.
            display.set_pixels(0, 0, frame.width - 1, frame.height - 1, core::iter::empty())?;
            rows::begin(frame.height);
            let mut sent = Ok(());
            second.help(frame, || {
                // SAFETY: only the pixels of the window that has just been opened are sent, so the
                // driver goes on knowing the controller's settings.
                let link = unsafe { display.dcs() };
                trace(frame, |line, row| sent = link.send_rows(line, row));
            });
            sent
        }
        Way::Graphics => Number::shot(frame.scene, Graphics { display, frame }),
        Way::Trace => {
            keep(second, frame);
            Ok(())
        }
    }
}

/// Drawing with embedded-graphics.
struct Graphics<'a> {
    display: &'a mut Display,
    frame: Frame,
}

impl View<Number> for Graphics<'_> {
    type Output = Result<(), Fault>;

    #[inline(never)]
    fn view<const USES: u64>(self, shot: Shot<Number, USES>) -> Result<(), Fault> {
        let mut work = Work::<_, MAX_DEPTH>::new();
        let Frame { width, height, .. } = self.frame;
        let renderer = rgb565::renderer(&shot, width, height, &mut work);
        let picture = Picture::<_, pixelcolor::Rgb565, MAX_DEPTH, (), USES>::from_renderer(
            renderer,
            shot.output,
        );
        Image::new(&picture, Point::zero()).draw(self.display)
    }
}

/// The sum over the pixels of the frame that was traced last and not sent, for an emulator to read.
// SAFETY: nothing else has this name.
#[unsafe(no_mangle)]
#[used]
static TRACED: AtomicU32 = AtomicU32::new(0);

/// Traces a frame that nobody sees.
#[inline(never)]
fn keep(second: &mut Second, frame: Frame) {
    rows::begin(frame.height);
    let mut sum = 0;
    second.help(frame, || {
        trace(frame, |line, row| {
            while !rows::is_over() {
                if let Some(band) = rows::take_band() {
                    sum = Band::of(&band, line).read(|bytes| rgb565::sum(sum, bytes));
                    rows::free(&band);
                }
                let (Claim::Row(_) | Claim::Wait | Claim::Over) = rows::work(line, &mut *row);
            }
        });
    });
    TRACED.store(sum, Ordering::Relaxed);
}

/// Makes a tracer of a frame's rows, and has `share` give it rows of so many bytes.
pub(crate) fn trace(frame: Frame, share: impl FnOnce(usize, &mut dyn FnMut(u16, &mut [u8]))) {
    Number::shot(frame.scene, Rows { frame, share });
}

/// Tracing a frame's rows.
struct Rows<S> {
    frame: Frame,
    share: S,
}

impl<S: FnOnce(usize, &mut dyn FnMut(u16, &mut [u8]))> View<Number> for Rows<S> {
    type Output = ();

    /// Not inlined: either core has the tracer's memory on its stack.
    #[inline(never)]
    fn view<const USES: u64>(self, shot: Shot<Number, USES>) {
        let Self { frame, share } = self;
        let mut work = Work::<_, MAX_DEPTH>::new();
        let mut renderer = rgb565::renderer(&shot, frame.width, frame.height, &mut work);
        share(frame.line(), &mut |y, bytes| row(&mut renderer, y, &shot.output, bytes));
    }
}

/// Traces a row: one copy of a scene's tracer for all ways but that of embedded-graphics.
#[inline(never)]
fn row<const USES: u64>(
    renderer: &mut Renderer<'_, Number, MAX_DEPTH, (), USES>,
    y: u16,
    output: &Output,
    bytes: &mut [u8],
) {
    renderer.band::<Rgb565>(y, output, bytes);
}

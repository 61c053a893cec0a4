//! A frame, by each way.

use core::sync::atomic::{AtomicU32, Ordering};

use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor;
use embedded_graphics::prelude::*;
use embedded_hal::digital::OutputPin;
use whitted::Picture;
use whitted::frame::{Renderer, Rgb565, Sample, Sampling, Settings};
use whitted::scene::{Scene, SceneRef};
use whitted::trace::Work;
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::job::MAX_SAMPLES;
use whitted_demo::rgb565;
use whitted_demo::scenes::{self, Shot, Shots, View};
use whitted_demo::stack;

use crate::board::{Board, Display};
use crate::chip::Number;
use crate::cores::Second;
use crate::link::Fault;
use crate::log;
use crate::order::{Frame, Order, Way};
use crate::rows::{self, Band, Row, Source};

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

    /// Not inlined, so that what happens between the edges is this module's code, which is in RAM.
    #[inline(never)]
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
                sent = link.send_rows(frame.line(), |source| trace(frame, source));
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

    #[inline(always)]
    fn view<S, const USES: u64>(self, shot: Shot<Number, S>) -> Result<(), Fault>
    where
        S: SceneRef<Target = Scene<'static, Number, USES>>,
    {
        let Shot { scene, camera, depth, output } = shot;
        let mut work = Work::<_, MAX_DEPTH>::new();
        let Frame { width, height, .. } = self.frame;
        let settings = Settings { depth, ..Settings::new(width, height) };
        let renderer = Renderer::new(scene, camera, settings, &mut work, &mut [])
            .expect("a picture with sides");
        let picture =
            Picture::<_, pixelcolor::Rgb565, MAX_DEPTH, (), S>::from_renderer(renderer, output);
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
    let mut unseen = Unseen { line: frame.line(), sum: 0 };
    second.help(frame, || trace(frame, &mut unseen));
    TRACED.store(unseen.sum, Ordering::Relaxed);
}

/// A frame whose bands are summed up instead of sent.
struct Unseen {
    /// Bytes in a row.
    line: usize,
    sum: u32,
}

impl Source for Unseen {
    fn next(&mut self) -> Option<Row> {
        while !rows::is_over() {
            if let Some(band) = rows::take_band() {
                self.sum = Band::of(&band, self.line).read(|bytes| rgb565::sum(self.sum, bytes));
                rows::free(&band);
            }
            if let Ok(row) = rows::claim(self.line) {
                return Some(row);
            }
        }
        None
    }
}

/// Traces rows of a frame until the source has no more. Not inlined, so that the memory lies apart from what the
/// tracer keeps on the stack: only its first 1,020 bytes are reached by one instruction.
#[inline(never)]
pub(crate) fn trace(frame: Frame, source: &mut dyn Source) {
    let work = &mut Work::new();
    if scenes::SPARSE_APART && frame.sampling != Sampling::Center {
        let samples = &mut [Sample::NONE; MAX_SAMPLES];
        Number::sparse(Rows { frame, source, work, samples });
    } else {
        Number::shot(frame.scene, Rows { frame, source, work, samples: &mut [] });
    }
}

/// Tracing a frame's rows.
struct Rows<'a> {
    frame: Frame,
    source: &'a mut dyn Source,
    work: &'a mut Work<Number, MAX_DEPTH>,
    samples: &'a mut [Sample<Number>],
}

impl View<Number> for Rows<'_> {
    type Output = ();

    #[inline(always)]
    fn view<S, const USES: u64>(self, shot: Shot<Number, S>)
    where
        S: SceneRef<Target = Scene<'static, Number, USES>>,
    {
        let Self { frame, source, work, samples } = self;
        let Frame { width, height, sampling, .. } = frame;
        let mut renderer = rgb565::sampled(&shot, (width, height), sampling, work, samples);
        while let Some(row) = source.next() {
            renderer.band::<Rgb565>(row.y, &shot.output, row.bytes);
        }
    }
}

//! Pins, clocks and the display.

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::pixelcolor::RgbColor;
use embedded_hal::delay::DelayNs;
use mipidsi::Builder;
use mipidsi::models::ILI9341Rgb565;
use mipidsi::options::{ColorOrder, Orientation, Rotation};
use stm32f4xx_hal::gpio::{Output, Pin, Speed};
use stm32f4xx_hal::pac::{self, SPI1};
use stm32f4xx_hal::prelude::*;
use stm32f4xx_hal::rcc::Config;
use stm32f4xx_hal::spi::{Mode, Phase, Polarity, Spi};

use crate::link::{self, Link};
use crate::sender::Sender;

/// The core's clock.
#[cfg(feature = "f411")]
pub(crate) const CLOCK_MHZ: u32 = 100;
/// The emulator has the internal oscillator and no PLL.
#[cfg(feature = "f405")]
pub(crate) const CLOCK_MHZ: u32 = 16;
/// SPI's clock at most; the chip divides its own by a power of two.
#[cfg(feature = "f411")]
const SPI_MHZ: u32 = 25;
#[cfg(feature = "f405")]
const SPI_MHZ: u32 = 8;

/// The display, with the driver that knows its commands.
pub(crate) type Display = mipidsi::Display<Link, ILI9341Rgb565, Pin<'A', 2, Output>>;

/// The board.
pub(crate) struct Board {
    pub(crate) display: Display,
    /// Low while the button is held.
    #[cfg(feature = "f411")]
    pub(crate) button: Pin<'A', 0>,
}

impl Board {
    /// The one board there is, its display black.
    ///
    /// # Panics
    /// When called twice, or if SPI fails while the display starts.
    pub(crate) fn take() -> Self {
        let chip = pac::Peripherals::take().expect("a board is taken once");
        #[cfg(feature = "f411")]
        let clocks = Config::hse(25.MHz()).sysclk(CLOCK_MHZ.MHz());
        #[cfg(feature = "f405")]
        let clocks = Config::hsi();
        let mut rcc = chip.RCC.freeze(clocks);

        let port = chip.GPIOA.split(&mut rcc);
        let clock = port.pa5.into_alternate().speed(Speed::VeryHigh);
        let data = port.pa7.into_alternate().speed(Speed::VeryHigh);
        let mode = Mode { polarity: Polarity::IdleLow, phase: Phase::CaptureOnFirstTransition };
        let pins = (Some(clock), SPI1::NoMiso, Some(data));
        let spi = Spi::new(chip.SPI1, pins, mode, SPI_MHZ.MHz(), &mut rcc);
        let [band, other] = link::bands();
        #[cfg(feature = "f411")]
        let sender = Sender::new(spi, chip.DMA2, other, &mut rcc);
        #[cfg(feature = "f405")]
        let sender = Sender::new(spi, other);
        let select = port.pa4.into_push_pull_output();
        let link = Link::new(sender, band, select, port.pa3.into_push_pull_output());
        let mut display = Builder::new(ILI9341Rgb565, link)
            .orientation(Orientation::new().rotate(Rotation::Deg90).flip_horizontal())
            .color_order(ColorOrder::Bgr)
            .reset_pin(port.pa2.into_push_pull_output())
            .init(&mut Wait)
            .expect("SPI sends");
        display.clear(RgbColor::BLACK).expect("SPI sends");
        Self {
            display,
            #[cfg(feature = "f411")]
            button: port.pa0.into_pull_up_input(),
        }
    }
}

/// Waits by counting cycles: at least as long as it is told.
pub(crate) struct Wait;

impl DelayNs for Wait {
    fn delay_ns(&mut self, ns: u32) {
        let cycles = u64::from(ns) * u64::from(CLOCK_MHZ) / 1_000 + 1;
        cortex_m::asm::delay(u32::try_from(cycles).unwrap_or(u32::MAX));
    }
}

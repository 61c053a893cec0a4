//! Pins and clocks.

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::pixelcolor::RgbColor;
use mipidsi::Builder;

use crate::chip::hal::clocks::{Clock, init_clocks_and_plls};
use crate::chip::hal::dma::DMAExt;
use crate::chip::hal::gpio::bank0::{Gpio12, Gpio14, Gpio15};
use crate::chip::hal::gpio::{
    FunctionSioInput, FunctionSioOutput, Pin, PinState, Pins, PullDown, PullUp,
};
use crate::chip::hal::{Sio, Spi, Watchdog, pac};
use crate::chip::{self, Sleep, Timer};
use crate::cores::Second;
use crate::link::Link;
use crate::panel;

/// The crystal of either board.
const CRYSTAL_HZ: u32 = 12_000_000;

/// The display, with the driver that knows its commands.
pub(crate) type Display =
    mipidsi::Display<Link, panel::Model, Pin<Gpio12, FunctionSioOutput, PullDown>>;

/// The board.
pub(crate) struct Board {
    /// High while a frame is drawn, for the emulator or an oscilloscope.
    pub(crate) mark: Pin<Gpio15, FunctionSioOutput, PullDown>,
    /// Low while the button is held.
    pub(crate) button: Pin<Gpio14, FunctionSioInput, PullUp>,
    pub(crate) timer: Timer,
    pub(crate) sleep: Sleep,
    pub(crate) second: Second,
}

/// The display's connection, and its reset line, before it is started.
pub(crate) struct Unstarted {
    link: Link,
    reset: Pin<Gpio12, FunctionSioOutput, PullDown>,
}

impl Unstarted {
    /// Starts the display, black.
    ///
    /// # Panics
    /// If the display's first commands can't be sent.
    pub(crate) fn start(self, sleep: &mut Sleep) -> Display {
        let mut display = panel::options(Builder::new(panel::MODEL, self.link))
            .reset_pin(self.reset)
            .init(sleep)
            .expect("SPI sends");
        display.clear(RgbColor::BLACK).expect("SPI sends");
        display
    }
}

impl Board {
    /// The one board there is.
    ///
    /// # Panics
    /// When called twice, or if clocks can't be started.
    pub(crate) fn take() -> (Self, Unstarted) {
        let mut chip = pac::Peripherals::take().expect("a board is taken once");
        let mut watchdog = Watchdog::new(chip.WATCHDOG);
        let clocks = init_clocks_and_plls(
            CRYSTAL_HZ,
            chip.XOSC,
            chip.CLOCKS,
            chip.PLL_SYS,
            chip.PLL_USB,
            &mut chip.RESETS,
            &mut watchdog,
        )
        .expect("the crystal of a Pico");
        let mut timer = chip::timer!(chip, clocks);
        let sleep = Sleep::new(&mut timer);

        let sio = Sio::new(chip.SIO);
        let pins = Pins::new(chip.IO_BANK0, chip.PADS_BANK0, sio.gpio_bank0, &mut chip.RESETS);
        let spi = Spi::new(chip.SPI1, (pins.gpio11.into_function(), pins.gpio10.into_function()))
            .init(
                &mut chip.RESETS,
                clocks.peripheral_clock.freq(),
                panel::SPI,
                embedded_hal::spi::MODE_0,
            );
        let link = Link::new(
            spi,
            chip.DMA.split(&mut chip.RESETS).ch0,
            pins.gpio9.into_push_pull_output_in_state(PinState::High),
            pins.gpio8.into_push_pull_output(),
            timer,
        );
        let reset = pins.gpio12.into_push_pull_output_in_state(PinState::High);
        let board = Self {
            mark: pins.gpio15.into_push_pull_output(),
            button: pins.gpio14.into_pull_up_input(),
            timer,
            sleep,
            second: Second::start(sio.fifo, &mut chip.PSM, &mut chip.PPB),
        };
        (board, Unstarted { link, reset })
    }
}

//! Pins and clocks.

use mipidsi::Builder;
use rp2040_hal::clocks::{Clock, init_clocks_and_plls};
use rp2040_hal::dma::DMAExt;
use rp2040_hal::gpio::bank0::{Gpio12, Gpio15};
use rp2040_hal::gpio::{FunctionSioOutput, Pin, PinState, Pins, PullDown};
use rp2040_hal::{Sio, Spi, Timer, Watchdog, pac};

use crate::link::{Bands, Link};
use crate::panel;
use crate::sleep::Sleep;

/// The crystal of the Pico.
const CRYSTAL_HZ: u32 = 12_000_000;

/// The display, with the driver that knows its commands.
pub(crate) type Display =
    mipidsi::Display<Link, panel::Model, Pin<Gpio12, FunctionSioOutput, PullDown>>;

/// The board with its display on.
pub(crate) struct Board {
    pub(crate) display: Display,
    /// High while a frame is drawn, for the emulator or an oscilloscope.
    pub(crate) mark: Pin<Gpio15, FunctionSioOutput, PullDown>,
    pub(crate) timer: Timer,
    pub(crate) sleep: Sleep,
}

impl Board {
    /// The one board there is.
    ///
    /// # Panics
    /// When called twice, or if clocks or display can't be started.
    pub(crate) fn take() -> Self {
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
        let mut timer = Timer::new(chip.TIMER, &mut chip.RESETS, &clocks);
        let mut sleep = Sleep::new(timer.alarm_0().expect("nobody has taken an alarm"));

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
            Bands::take(),
            pins.gpio9.into_push_pull_output_in_state(PinState::High),
            pins.gpio8.into_push_pull_output(),
        );
        let reset = pins.gpio12.into_push_pull_output_in_state(PinState::High);
        let display = panel::options(Builder::new(panel::MODEL, link))
            .reset_pin(reset)
            .init(&mut sleep)
            .expect("neither pins nor SPI can fail");
        Self { display, mark: pins.gpio15.into_push_pull_output(), timer, sleep }
    }
}

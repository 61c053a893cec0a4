//! A scene of your own on a Raspberry Pi Pico with an ST7789 of 240×240 pixels.
//!
//! The LED is on while the picture is traced and blinks when it is finished.
#![no_std]
#![no_main]

use defmt_rtt as _;
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{OutputPin, StatefulOutputPin};
use embedded_hal::spi::MODE_3;
use embedded_hal_bus::spi::ExclusiveDevice;
use mipidsi::Builder;
use mipidsi::interface::SpiInterface;
use mipidsi::models::ST7789;
use mipidsi::options::ColorInversion;
use panic_probe as _;
use rp2040_hal::clocks::{Clock, init_clocks_and_plls};
use rp2040_hal::fugit::RateExtU32;
use rp2040_hal::gpio::{FunctionSpi, PinState, Pins};
use rp2040_hal::{Sio, Spi, Timer, Watchdog, pac};
use whitted::Picture;
use whitted::frame::Settings;
use whitted::trace::Work;

/// What `build.rs` made of `scene.toml`.
#[allow(dead_code)]
mod scene {
    include!(concat!(env!("OUT_DIR"), "/scene.rs"));
}
use scene::{Baked, CAMERA, DEPTH};

/// The display's pixels; as in `build.rs`.
const SIZE: (u16, u16) = (240, 240);

/// The second stage loader: it makes the flash readable.
// SAFETY: `memory.x` places this section where the boot ROM looks for the loader.
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

#[rp2040_hal::entry]
fn main() -> ! {
    let mut chip = pac::Peripherals::take().expect("taken once");
    let mut watchdog = Watchdog::new(chip.WATCHDOG);
    let clocks = init_clocks_and_plls(
        12_000_000,
        chip.XOSC,
        chip.CLOCKS,
        chip.PLL_SYS,
        chip.PLL_USB,
        &mut chip.RESETS,
        &mut watchdog,
    )
    .expect("the crystal of a Pico");
    let mut timer = Timer::new(chip.TIMER, &mut chip.RESETS, &clocks);
    let sio = Sio::new(chip.SIO);
    let pins = Pins::new(chip.IO_BANK0, chip.PADS_BANK0, sio.gpio_bank0, &mut chip.RESETS);
    let mut led = pins.gpio25.into_push_pull_output();

    // The display.
    let data = pins.gpio11.into_function::<FunctionSpi>();
    let clock = pins.gpio10.into_function::<FunctionSpi>();
    let select = pins.gpio9.into_push_pull_output_in_state(PinState::High);
    let data_command = pins.gpio8.into_push_pull_output();
    let reset = pins.gpio12.into_push_pull_output_in_state(PinState::High);
    // Mode 3 works with and without a select line.
    let spi = Spi::<_, _, _, 8>::new(chip.SPI1, (data, clock)).init(
        &mut chip.RESETS,
        clocks.peripheral_clock.freq(),
        16.MHz(),
        MODE_3,
    );
    let device = ExclusiveDevice::new_no_delay(spi, select).expect("pins can't fail");
    let mut buffer = [0; 480];
    let mut display = Builder::new(ST7789, SpiInterface::new(device, data_command, &mut buffer))
        .display_size(SIZE.0, SIZE.1)
        .invert_colors(ColorInversion::Inverted)
        .reset_pin(reset)
        .init(&mut timer)
        .expect("pins and SPI can't fail");

    // The picture.
    defmt::info!("tracing {}x{}", SIZE.0, SIZE.1);
    let start = timer.get_counter();
    let _ = led.set_high();
    let mut work = Work::<scene::A, { DEPTH as usize }>::new();
    let settings = Settings { depth: DEPTH, ..Settings::new(SIZE.0, SIZE.1) };
    let picture = Picture::<_, Rgb565, { DEPTH as usize }, (), _>::new(
        Baked,
        &CAMERA,
        settings,
        &mut work,
        &mut [],
    )
    .expect("the memory is as deep as the scene");
    Image::new(&picture, Point::zero()).draw(&mut display).expect("pins and SPI can't fail");
    let _ = led.set_low();
    defmt::info!("finished after {} ms", (timer.get_counter() - start).to_millis());

    loop {
        timer.delay_ms(500);
        let _ = led.toggle();
    }
}

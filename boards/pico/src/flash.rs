//! The same board with a scene that lies in flash by itself, as a blob: at [`SCENE`], where whoever wants another scene writes
//! another one, and leaves the firmware as it is. If the bytes are no scene, the log says why and the
//! display shows stripes.
#![no_std]
#![no_main]

use core::{ptr, slice};

use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::MODE_0;
use embedded_hal_bus::spi::ExclusiveDevice;
use mipidsi::Builder;
use mipidsi::interface::SpiInterface;
use rp2040_hal::clocks::{Clock, init_clocks_and_plls};
use rp2040_hal::gpio::{FunctionSpi, PinState, Pins};
use rp2040_hal::{Sio, Spi, Timer, Watchdog, pac};
use whitted_demo::{flash, stack};
use {defmt_rtt as _, panic_probe as _};

mod panel;

/// What the displays' settings want of the chip.
mod chip {
    pub(crate) use rp2040_hal as hal;
}

/// The second stage loader: it makes the flash readable.
// SAFETY: the linker's map places this section where the boot ROM looks for the loader.
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// The crystal of the board.
const CRYSTAL_HZ: u32 = 12_000_000;
/// Where the scene begins: the flash's second half, which `scene.x` keeps free of the firmware.
const SCENE: usize = 0x1010_0000;
/// Bytes from there to the flash's end.
const ROOM: usize = 1 << 20;

/// How large the picture is to be, as `60x45`, filled up with blanks; all blank for the whole display.
/// An emulator writes here.
// SAFETY: nothing else has this name.
#[unsafe(no_mangle)]
#[used]
static ORDER: [u8; 16] = [b' '; 16];

/// The display's part that is drawn on, from its upper left corner.
///
/// # Panics
/// If [`ORDER`] isn't a size.
fn size() -> Size {
    // SAFETY: a reference is readable. Volatile, because the image is patched after the compiler
    // has seen the blanks.
    let text = unsafe { ptr::read_volatile(&raw const ORDER) };
    let text = core::str::from_utf8(&text).expect("an order in ASCII").trim();
    let (width, height) = panel::SIZE;
    let whole = Size::new(width.into(), height.into());
    if text.is_empty() {
        return whole;
    }
    let (width, height) = text.split_once('x').expect("a size, as 60x45");
    let side = |text: &str| text.parse().expect("a number of pixels");
    Size::new(side(width), side(height)).component_min(whole)
}

#[rp2040_hal::entry]
fn main() -> ! {
    let top = stack::paint();
    let mut chip = pac::Peripherals::take().expect("taken once");
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
    let sio = Sio::new(chip.SIO);
    let pins = Pins::new(chip.IO_BANK0, chip.PADS_BANK0, sio.gpio_bank0, &mut chip.RESETS);
    let mut mark = pins.gpio15.into_push_pull_output();
    let data = pins.gpio11.into_function::<FunctionSpi>();
    let clock = pins.gpio10.into_function::<FunctionSpi>();
    let select = pins.gpio9.into_push_pull_output_in_state(PinState::High);
    let data_command = pins.gpio8.into_push_pull_output();
    let reset = pins.gpio12.into_push_pull_output_in_state(PinState::High);
    let frequency = clocks.peripheral_clock.freq();
    let spi = Spi::<_, _, _, 8>::new(chip.SPI1, (data, clock)).init(
        &mut chip.RESETS,
        frequency,
        panel::SPI,
        MODE_0,
    );
    let device = ExclusiveDevice::new_no_delay(spi, select).expect("pins can't fail");
    let mut buffer = [0; 480];
    let link = SpiInterface::new(device, data_command, &mut buffer);
    let mut display = panel::options(Builder::new(panel::MODEL, link))
        .reset_pin(reset)
        .init(&mut timer)
        .expect("pins and SPI can't fail");

    // SAFETY: flash is readable from one end to the other, the linker puts nothing there (`scene.x`),
    // and nothing writes to it while this runs.
    let bytes = unsafe { slice::from_raw_parts(ptr::without_provenance(SCENE), ROOM) };
    let area = Rectangle::new(Point::zero(), size());
    let start = timer.get_counter();
    let Ok(()) = mark.set_high();
    flash::show(bytes, &mut display.cropped(&area), |error| {
        defmt::error!("scene in flash: {}", defmt::Display2Format(error));
    })
    .expect("pins and SPI can't fail");
    let Ok(()) = mark.set_low();
    let time = timer.get_counter() - start;
    let (stack, memory) = (stack::used(top), stack::static_bytes());
    defmt::info!(
        "{=u32}x{=u32}: {=u64} us, stack {=usize} bytes, static RAM {=usize} bytes",
        area.size.width,
        area.size.height,
        time.to_micros(),
        stack,
        memory
    );
    loop {
        cortex_m::asm::wfi();
    }
}

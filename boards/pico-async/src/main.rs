//! Raspberry Pi Pico on embassy: sending a band of rows by DMA is awaited while the next is traced.
//!
//! Left to itself it goes from scene to scene, and on at a button's press; the emulator writes into
//! `ORDER` what it wants. GPIO 15 is high while a frame is drawn.
#![no_std]
#![no_main]

mod bus;

use core::{future, ptr, str};

use embassy_executor::Spawner;
use embassy_futures::select::select;
use embassy_rp::gpio::{Input, Level, Output, Pull};
use embassy_rp::peripherals::DMA_CH0;
use embassy_rp::spi::{self, Spi};
use embassy_rp::{bind_interrupts, dma};
use embassy_time::{Delay, Instant, Timer};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::pixelcolor::RgbColor;
use mipidsi::Builder;
use mipidsi::models::ST7789;
use mipidsi::options::ColorInversion;
use whitted::math::Fixed;
use whitted_bands::{BAND, Frame, Link, TRIES, draw};
use whitted_demo::job::{ArithName, Job, SceneName};
use whitted_demo::stack;

use crate::bus::Bus;
use {defmt_rtt as _, panic_probe as _};

/// What to draw, as `limit:fixed:60x45 bands`, filled up with blanks; all blank in the image that
/// is built. The emulator, or whoever patches the image, writes here.
// SAFETY: nothing else has this name.
#[unsafe(no_mangle)]
#[used]
static ORDER: [u8; 48] = [b' '; 48];

/// The display's pixels across and down.
const SIZE: (u16, u16) = (240, 240);
/// SPI's clock.
const SPI_HZ: u32 = 62_500_000;
/// How long a picture stays, unless the button is pressed.
const PAUSE_S: u64 = 3;

bind_interrupts!(struct Interrupts {
    DMA_IRQ_0 => dma::InterruptHandler<DMA_CH0>;
});

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    let top = stack::paint();
    let chip = embassy_rp::init(embassy_rp::config::Config::default());
    let mut mark = Output::new(chip.PIN_15, Level::Low);
    let mut button = Input::new(chip.PIN_14, Pull::Up);
    let mut config = spi::Config::default();
    config.frequency = SPI_HZ;
    let spi = Spi::new_blocking_txonly(chip.SPI1, chip.PIN_10, chip.PIN_11, config);
    let bus = Bus::new(spi, dma::Channel::new(chip.DMA_CH0, Interrupts));
    let select_line = Output::new(chip.PIN_9, Level::High);
    let link = Link::new(bus, select_line, Output::new(chip.PIN_8, Level::Low));
    let mut display = Builder::new(ST7789, link)
        .display_size(SIZE.0, SIZE.1)
        .invert_colors(ColorInversion::Inverted)
        .reset_pin(Output::new(chip.PIN_12, Level::High))
        .init(&mut Delay)
        .expect("SPI sends");
    display.clear(RgbColor::BLACK).expect("SPI sends");

    let buffers = cortex_m::singleton!(: [[u8; BAND]; 2] = [[0; BAND]; 2]).expect("taken once");
    let order = order();
    for scene in SceneName::ALL.into_iter().cycle() {
        let frame = order.unwrap_or(Frame { scene, width: SIZE.0, height: SIZE.1 });
        for _ in 0..TRIES {
            let start = Instant::now();
            mark.set_high();
            let sent = draw::<Fixed, _, _, _, _, _>(&mut display, frame, buffers).await;
            mark.set_low();
            let name = frame.scene.name();
            match sent {
                Ok(()) => {
                    defmt::info!(
                        "{=str} {=u16}x{=u16}: {=u64} us, stack {=usize} bytes, static RAM {=usize} bytes",
                        name,
                        frame.width,
                        frame.height,
                        start.elapsed().as_micros(),
                        stack::used(top),
                        stack::static_bytes()
                    );
                    break;
                }
                Err(fault) => {
                    defmt::error!("{=str}: {=str}; the frame is drawn again", name, fault.words());
                }
            }
        }
        if order.is_some() {
            future::pending::<()>().await;
        }
        select(Timer::after_secs(PAUSE_S), button.wait_for_falling_edge()).await;
    }
}

/// What [`ORDER`] says.
///
/// # Panics
/// If it says what can't be done: a misspelt word, software floating point, or a frame larger than
/// the display.
fn order() -> Option<Frame> {
    // SAFETY: a reference is readable. Volatile, because the image is patched after the compiler
    // has seen the blanks.
    let text = unsafe { ptr::read_volatile(&raw const ORDER) };
    let text = str::from_utf8(&text).expect("an order in ASCII");
    let mut words = text.split_ascii_whitespace();
    let Job { scene, arith, width, height, .. } =
        words.next()?.parse().expect("a job, as limit:fixed:60x45");
    assert!(matches!(words.next(), None | Some("bands")), "this board draws by bands");
    assert!(arith == ArithName::Fixed, "this board draws in fixed point");
    assert!(width <= SIZE.0 && height <= SIZE.1, "the display is smaller");
    Some(Frame { scene, width, height })
}

//! BBC micro:bit v2 (nRF52833) on embassy: traces in `f32` on the floating-point unit; sending a
//! band of rows by DMA is awaited while the next is traced. It goes from scene to scene, and on at
//! a press of button A.
#![no_std]
#![no_main]

use embassy_executor::Spawner;
use embassy_futures::select::select;
use embassy_nrf::bind_interrupts;
use embassy_nrf::gpio::{Input, Level, Output, OutputDrive, Pull};
use embassy_nrf::peripherals::SPI3;
use embassy_nrf::spim::{self, Spim};
use embassy_time::{Delay, Instant, Timer};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::pixelcolor::RgbColor;
use mipidsi::Builder;
use mipidsi::models::ST7789;
use mipidsi::options::ColorInversion;
use whitted_bands::{BAND, Frame, Link, TRIES, draw};
use whitted_demo::job::SceneName;
use whitted_demo::stack;
use {defmt_rtt as _, panic_probe as _};

/// The display's pixels across and down.
const SIZE: (u16, u16) = (240, 240);
/// How long a picture stays, unless the button is pressed.
const PAUSE_S: u64 = 3;

bind_interrupts!(struct Interrupts {
    SPIM3 => spim::InterruptHandler<SPI3>;
});

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    let top = stack::paint();
    let chip = embassy_nrf::init(embassy_nrf::config::Config::default());
    let mut button = Input::new(chip.P0_14, Pull::Up);
    let mut config = spim::Config::default();
    config.frequency = spim::Frequency::M16;
    let bus = Spim::new_txonly(chip.SPI3, Interrupts, chip.P0_17, chip.P0_13, config);
    let select_line = Output::new(chip.P1_02, Level::High, OutputDrive::Standard);
    let data_command = Output::new(chip.P0_12, Level::Low, OutputDrive::Standard);
    let reset = Output::new(chip.P0_01, Level::High, OutputDrive::Standard);
    let mut display = Builder::new(ST7789, Link::new(bus, select_line, data_command))
        .display_size(SIZE.0, SIZE.1)
        .invert_colors(ColorInversion::Inverted)
        .reset_pin(reset)
        .init(&mut Delay)
        .expect("SPI sends");
    display.clear(RgbColor::BLACK).expect("SPI sends");

    let buffers = cortex_m::singleton!(: [[u8; BAND]; 2] = [[0; BAND]; 2]).expect("taken once");
    for scene in SceneName::ALL.into_iter().cycle() {
        let frame = Frame { scene, width: SIZE.0, height: SIZE.1 };
        for _ in 0..TRIES {
            let start = Instant::now();
            match draw::<f32, _, _, _, _, _>(&mut display, frame, buffers).await {
                Ok(()) => {
                    defmt::info!(
                        "{=str}: {=u64} us, stack {=usize} bytes, static RAM {=usize} bytes",
                        scene.name(),
                        start.elapsed().as_micros(),
                        stack::used(top),
                        stack::static_bytes()
                    );
                    break;
                }
                Err(fault) => defmt::error!(
                    "{=str}: {=str}; the frame is drawn again",
                    scene.name(),
                    fault.words()
                ),
            }
        }
        select(Timer::after_secs(PAUSE_S), button.wait_for_falling_edge()).await;
    }
}

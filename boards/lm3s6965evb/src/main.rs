//! LM3S6965 evaluation board: real SPI traffic to a display of 128×64 pixels in 16 greys.
#![no_std]
#![no_main]

mod ssd0323;
mod stellaris;

use embedded_hal_bus::spi::ExclusiveDevice;
use whitted_demo::board::{self, Board};
use whitted_demo::oled;

#[cortex_m_rt::entry]
fn main() -> ! {
    // 200 MHz / 16, which the system control chooses at reset.
    let mut board = Board::new("lm3s6965evb", 12_500);
    board.draw_all();

    let stellaris::Peripherals { ssi, data_command, select } = stellaris::Peripherals::new();
    let spi = ExclusiveDevice::new_no_delay(ssi, select).unwrap();
    let mut display = ssd0323::Ssd0323::new(spi, data_command).unwrap();
    board.shown(|| oled::draw(&mut display).unwrap());
    board::idle()
}

//! The same board with its scene in flash as a blob. Where the bytes are damaged it says so in its
//! log and shows stripes.
#![no_std]
#![no_main]

mod ssd0323;
mod stellaris;

use core::hint::black_box;

use embedded_hal_bus::spi::ExclusiveDevice;
use semihosting::println;
use whitted_demo::board::{self, Board};
use whitted_demo::flash;

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut board = Board::new("flash", 12_500);
    let stellaris::Peripherals { ssi, data_command, select } = stellaris::Peripherals::new();
    let spi = ExclusiveDevice::new_no_delay(ssi, select).unwrap();
    let mut display = ssd0323::Ssd0323::new(spi, data_command).unwrap();
    // The compiler has seen these bytes; the chip may find others.
    let bytes = black_box(flash::BLOB);
    board.shown(|| {
        flash::show(bytes, &mut display, |error| println!("error scene in flash: {error}"))
            .unwrap();
    });
    board::idle()
}

//! Draws a room on an LM3S6965 (Cortex-M3, 64 KiB of RAM): lit by a lamp with an area, floored with
//! a texture, furnished with a group placed twice; what its walls send each other lies in a cache
//! that the chip has filled before.
#![no_std]
#![no_main]

use semihosting::println;
use whitted_demo::board::{self, Board};
use whitted_demo::room;

#[cortex_m_rt::entry]
fn main() -> ! {
    // 200 MHz / 16, which the system control chooses at reset.
    let mut board = Board::new("room", 12_500);
    let mut drawn = None;
    board.shown(|| drawn = Some(room::draw(|_| {})));
    match drawn {
        Some(room::Drawn { checksum, records }) => {
            println!("result board=room checksum={:016x} records={records}", checksum.value());
            board::exit(true)
        }
        None => board::exit(false),
    }
}

//! BBC micro:bit: the smallest memory, and the instructions of ARMv6-M.
#![no_std]
#![no_main]

use whitted_demo::board::{self, Board};

#[cortex_m_rt::entry]
fn main() -> ! {
    // The nRF51 runs at 16 MHz and nothing else.
    let mut board = Board::new("microbit", 16_000);
    board.draw_all();
    board::exit(true)
}

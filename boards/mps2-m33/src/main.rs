//! Arm MPS2 with a Cortex-M33: ARMv8-M.
#![no_std]
#![no_main]

use whitted_demo::board::{self, Board};

#[cortex_m_rt::entry]
fn main() -> ! {
    // The image AN505 clocks its core with 20 MHz.
    let mut board = Board::new("mps2-m33", 20_000);
    board.draw_all();
    board::exit(true)
}

//! Arm MPS2: one image for Cortex-M3, M4F and M7 each, as the target and the machine say.
#![no_std]
#![no_main]

use whitted_demo::board::{self, Board};

#[cortex_m_rt::entry]
fn main() -> ! {
    // All three images of the board clock their core with 25 MHz.
    let mut board = Board::new("mps2", 25_000);
    board.draw_all();
    board::exit(true)
}

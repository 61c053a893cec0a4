//! The stack that a frame takes on this board, with memory for each depth from 1 to 8.
#![no_std]
#![no_main]

use whitted_demo::board::{self, Board};

#[cortex_m_rt::entry]
fn main() -> ! {
    Board::new("microbit", 16_000).depths();
    board::exit(true)
}

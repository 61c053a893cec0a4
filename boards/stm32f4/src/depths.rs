//! The stack that a frame takes on the emulated chip, with memory for each depth from 1 to 8.
#![no_std]
#![no_main]

use stm32f4xx_hal as _;
use whitted_demo::board::{self, Board};

#[cortex_m_rt::entry]
fn main() -> ! {
    // Out of reset the chip runs at 16 MHz.
    Board::new("stm32f4", 16_000).depths();
    board::exit(true)
}

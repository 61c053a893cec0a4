//! The stack that a frame takes on this board, with memory for each depth from 1 to 8.
#![no_std]
#![no_main]

use whitted_demo::board::{self, Board};

/// One small frame for each depth.
#[riscv_rt::entry]
fn main() -> ! {
    Board::new("virt", 1_000_000).depths();
    board::exit(true)
}

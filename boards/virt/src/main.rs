//! RISC-V without a floating-point unit: the instruction set of the RP2350's other two cores.
#![no_std]
#![no_main]

use whitted_demo::board::{self, Board};

/// Draws the jobs of the command line.
#[riscv_rt::entry]
fn main() -> ! {
    // Instructions are counted themselves: a nanosecond each.
    let mut board = Board::new("virt", 1_000_000);
    board.draw_all();
    board::exit(true)
}

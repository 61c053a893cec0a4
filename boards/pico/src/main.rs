//! Raspberry Pi Pico: traces a scene on both cores and sends it to a display, by DMA from two
//! bands of rows, so that one is sent while the other is traced.
//!
//! Left to itself it goes from scene to scene, and on at a button's press; the emulator writes into [`order::ORDER`] what it
//! wants. The pin [`MARK`](board::Board::mark) is high while a frame is drawn.
//!
//! The Pico 2 has all modules but [`chip`] in common with it.
#![no_std]
#![no_main]

mod board;
mod chip;
mod cores;
mod draw;
mod link;
mod log;
mod order;
mod panel;
mod rows;
mod run;

#[rp2040_hal::entry]
fn main() -> ! {
    run::run()
}

//! The stack that a frame takes on this board, with memory for each depth from 1 to 8.
#![no_std]
#![no_main]

#[path = "../../pico/src/stacks.rs"]
mod stacks;

// Its arithmetic and critical sections, and the second stage loader.
use embassy_rp as _;
use {defmt_rtt as _, panic_probe as _};

#[cortex_m_rt::entry]
fn main() -> ! {
    stacks::run()
}

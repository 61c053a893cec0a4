//! Raspberry Pi Pico 2: the [Pico's](../../pico) firmware on the RP2350, on its Arm cores in `f32` or in
//! fixed point, or on a RISC-V core in fixed point. All modules but [`chip`] are the Pico's.
#![no_std]
#![no_main]

#[path = "../../pico/src/board.rs"]
mod board;
mod chip;
#[path = "../../pico/src/cores.rs"]
mod cores;
#[path = "../../pico/src/draw.rs"]
mod draw;
#[path = "../../pico/src/link.rs"]
mod link;
#[path = "../../pico/src/log.rs"]
mod log;
#[path = "../../pico/src/order.rs"]
mod order;
#[path = "../../pico/src/panel.rs"]
mod panel;
#[path = "../../pico/src/rows.rs"]
mod rows;
#[path = "../../pico/src/run.rs"]
mod run;

/// From reset on.
#[rp235x_hal::entry]
fn main() -> ! {
    run::run()
}

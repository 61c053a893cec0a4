//! Raspberry Pi Pico: traces a scene on both cores and sends it to a display, by DMA from two
//! bands of rows, so that one is sent while the other is traced.
//!
//! Left to itself it goes from scene to scene, and on at a button's press; the emulator writes into [`order::ORDER`] what it
//! wants. The pin [`MARK`](board::Board::mark) is high while a frame is drawn.
#![no_std]
#![no_main]

mod board;
mod cores;
mod draw;
mod link;
mod log;
mod order;
mod panel;
mod rows;
mod sleep;

use whitted_demo::job::SceneName;
use whitted_demo::stack;

use board::Board;
use embedded_hal::digital::InputPin;
use order::{Frame, Order, Way};

/// The second stage loader: it makes the flash readable.
// SAFETY: the linker's map places this section where the boot ROM looks for the loader.
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// How long a picture stays, unless the button is pressed.
const PAUSE_MS: u32 = 3_000;
/// How often the button is looked at.
const GLANCE_MS: u32 = 20;

#[rp2040_hal::entry]
fn main() -> ! {
    let top = stack::paint();
    let (mut board, display) = Board::take();
    let (width, height) = panel::SIZE;
    match Order::given() {
        Some(order) if order.way == Way::Trace => board.frame(None, &order, top),
        Some(order) => {
            let mut display = display.start(&mut board.sleep);
            board.frame(Some(&mut display), &order, top);
        }
        None => {
            let mut display = display.start(&mut board.sleep);
            for scene in SceneName::ALL.into_iter().cycle() {
                let frame = Frame { scene, width, height };
                board.frame(Some(&mut display), &Order { frame, way: Way::Bands }, top);
                board.pause();
            }
        }
    }
    loop {
        cortex_m::asm::wfi();
    }
}

impl Board {
    /// Waits for the next scene's turn: some seconds, or until the button has been pressed and let
    /// go.
    fn pause(&mut self) {
        let mut pressed = false;
        for _ in 0..PAUSE_MS / GLANCE_MS {
            // The pin can't fail.
            let low = self.button.is_low().unwrap_or(false);
            if pressed && !low {
                return;
            }
            pressed |= low;
            self.sleep.ms(GLANCE_MS);
        }
    }
}

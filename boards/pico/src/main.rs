//! Raspberry Pi Pico: traces a scene and sends it to a display, by DMA from two buffers, so that
//! one is sent while the other is traced.
//!
//! Left to itself it goes from scene to scene; the emulator writes into [`order::ORDER`] what it
//! wants. The pin [`MARK`](board::Board::mark) is high while a frame is drawn.
#![no_std]
#![no_main]

mod board;
mod draw;
mod link;
mod log;
mod order;
mod panel;
mod sleep;

use whitted_demo::job::SceneName;
use whitted_demo::stack;

use board::Board;
use order::{Order, Way};

/// The second stage loader: it makes the flash readable.
// SAFETY: the linker's map places this section where the boot ROM looks for the loader.
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// How long a picture stays.
const PAUSE_MS: u32 = 3_000;

#[rp2040_hal::entry]
fn main() -> ! {
    let top = stack::paint();
    let mut board = Board::take();
    let (width, height) = panel::SIZE;
    let Some(order) = Order::given() else {
        loop {
            for scene in SceneName::ALL {
                board.frame(&Order { scene, width, height, way: Way::Bands }, top);
                board.sleep.ms(PAUSE_MS);
            }
        }
    };
    board.frame(&order, top);
    loop {
        cortex_m::asm::wfi();
    }
}

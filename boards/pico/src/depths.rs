//! The stack that a frame takes on this board, with memory for each depth from 1 to 8.
#![no_std]
#![no_main]

mod stacks;

use {defmt_rtt as _, panic_probe as _};

/// The second stage loader: it makes the flash readable.
// SAFETY: the linker's map places this section where the boot ROM looks for the loader.
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

#[rp2040_hal::entry]
fn main() -> ! {
    stacks::run()
}

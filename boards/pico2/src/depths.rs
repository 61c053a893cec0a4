//! The stack that a frame takes on this board, with memory for each depth from 1 to 8, in fixed point.
#![no_std]
#![no_main]

#[path = "../../pico/src/stacks.rs"]
mod stacks;

use defmt_rtt as _;
#[cfg(target_arch = "arm")]
use panic_probe as _;
// Its critical sections are linked.
#[cfg(target_arch = "riscv32")]
use riscv as _;
use rp235x_hal::block::ImageDef;

/// What the boot ROM wants to know: an image for cores of this kind, in their secure state.
// SAFETY: the linker's map places this section where the boot ROM looks for the definition.
#[unsafe(link_section = ".start_block")]
#[used]
static IMAGE: ImageDef = ImageDef::secure_exe();

/// From reset on.
#[rp235x_hal::entry]
fn main() -> ! {
    stacks::run()
}

/// `panic-probe` knows Arm's cores alone.
#[cfg(target_arch = "riscv32")]
#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    defmt::error!("{}", defmt::Display2Format(info));
    loop {
        core::hint::spin_loop();
    }
}

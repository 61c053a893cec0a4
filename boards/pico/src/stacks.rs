//! The stack that frames take, left in memory for an emulator and told to whoever listens.

use core::sync::atomic::{AtomicU32, Ordering};

use whitted_demo::depths::{self, DEEPEST, Depth, Words};
use whitted_demo::job::ArithName;
use whitted_demo::stack;

/// A line for each depth, once it is known.
// SAFETY: nothing else has this name.
#[unsafe(no_mangle)]
#[used]
static DEPTHS: [[AtomicU32; size_of::<Words>() / 4]; DEEPEST] =
    [const { [const { AtomicU32::new(0) }; size_of::<Words>() / 4] }; DEEPEST];

/// Draws a small frame with memory for each depth, in fixed point, and sleeps.
pub(crate) fn run() -> ! {
    for (line, Depth { depth, memory, draw }) in DEPTHS.iter().zip(depths::all(ArithName::Fixed)) {
        let top = stack::paint();
        let sum = draw().value();
        let stack = stack::used(top);
        defmt::info!("depth {=usize}: stack {=usize} bytes", depth, stack);
        let words: Words =
            [depth as u32, memory as u32, stack as u32, sum as u32, (sum >> 32) as u32];
        // The depth, which says that the line is there, last.
        line.iter().zip(words).rev().for_each(|(place, word)| place.store(word, Ordering::Relaxed));
    }
    loop {
        core::hint::spin_loop();
    }
}

//! The second core.

use core::cell::UnsafeCell;
use core::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use cortex_m::Peripherals;
use cortex_m::peripheral::syst::SystClkSource;

use crate::rows;

/// Where the second core finds its vectors (subsystem controller of the SSE-200, INITSVTOR1).
const VECTORS: *mut u32 = 0x5002_1114 as *mut u32;
/// Which cores wait (CPUWAIT).
const WAIT: *mut u32 = 0x5002_1118 as *mut u32;
/// Bytes of stack.
const STACK: usize = 16 * 1024;

#[repr(align(8))]
struct Memory(UnsafeCell<[u8; STACK]>);

// SAFETY: nobody but the second core, as its stack, touches it.
unsafe impl Sync for Memory {}

static MEMORY: Memory = Memory(UnsafeCell::new([0; STACK]));

/// The stack's end, the entry, and nothing for faults.
#[repr(C, align(512))]
struct Vectors {
    stack: *const u8,
    entry: extern "C" fn() -> !,
    faults: [usize; 14],
}

// SAFETY: it is read alone.
unsafe impl Sync for Vectors {}

static TABLE: Vectors = Vectors {
    // SAFETY: one past the end of the stack's memory.
    stack: unsafe { MEMORY.0.get().cast::<u8>().cast_const().add(STACK) },
    entry: serve,
    faults: [0; 14],
};

static BUSY: AtomicBool = AtomicBool::new(false);
static INSTRUCTIONS: AtomicU32 = AtomicU32::new(0);

/// Lets the second core run. It waits for work.
pub(crate) fn start() {
    // SAFETY: the registers are there on this machine, and the table is as the core wants it.
    unsafe {
        VECTORS.write_volatile((&raw const TABLE) as u32);
        cortex_m::asm::dsb();
        WAIT.write_volatile(0);
    }
}

/// Has the second core work on the job that has begun.
pub(crate) fn begin() {
    BUSY.store(true, Ordering::Release);
}

/// Waits until it has no more to do; returns the instructions it took.
pub(crate) fn end() -> u32 {
    while BUSY.load(Ordering::Acquire) {
        turn();
    }
    INSTRUCTIONS.load(Ordering::Relaxed)
}

extern "C" fn serve() -> ! {
    // SAFETY: this core's own SysTick, which nobody else has: registers of that block are each
    // core's.
    let mut syst = unsafe { Peripherals::steal() }.SYST;
    syst.set_clock_source(SystClkSource::Core);
    syst.set_reload(0x00FF_FFFF);
    syst.clear_current();
    syst.enable_counter();
    loop {
        while !BUSY.load(Ordering::Acquire) {
            turn();
        }
        INSTRUCTIONS.store(rows::work(), Ordering::Relaxed);
        BUSY.store(false, Ordering::Release);
    }
}

/// Gives the other core its turn.
fn turn() {
    // SAFETY: changes nothing.
    unsafe { core::arch::asm!("yield", options(nomem, nostack, preserves_flags)) };
}

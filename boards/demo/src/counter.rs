//! Counting instructions with SysTick.
//!
//! Under QEMU's `-icount shift=0` every instruction takes one nanosecond of virtual time, and
//! SysTick counts the core clock's periods of that time: at 25 MHz one tick is 40 instructions.
//! The count is exact but for the tick at either end, and the same in every run. (Real chips
//! count cycles this way.)

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;

use crate::frame::Watch;

/// SysTick has 24 bits.
const MASK: u32 = 0x00FF_FFFF;

/// Adds up the ticks between [`before`](Watch::before) and [`after`](Watch::after). What lies
/// between them may take at most 2²⁴ ticks, 671 million instructions at 25 MHz.
pub(crate) struct Counter {
    /// Nobody else may set it to something else.
    _syst: SYST,
    start: u32,
    ticks: u64,
}

impl Counter {
    pub(crate) fn new(mut syst: SYST) -> Self {
        syst.set_clock_source(SystClkSource::Core);
        syst.set_reload(MASK);
        syst.clear_current();
        syst.enable_counter();
        Self { _syst: syst, start: 0, ticks: 0 }
    }

    /// The ticks so far, and back to none.
    pub(crate) fn take(&mut self) -> u64 {
        core::mem::take(&mut self.ticks)
    }
}

impl Watch for Counter {
    fn before(&mut self) {
        self.start = SYST::get_current();
    }

    fn after(&mut self) {
        // It counts downwards.
        let passed = self.start.wrapping_sub(SYST::get_current()) & MASK;
        self.ticks += u64::from(passed);
    }
}

/// Spins for some rounds of two instructions (a subtraction and a branch), to check the tick's
/// length against.
#[inline(never)]
pub(crate) fn spin(rounds: u32) {
    // SAFETY: changes a register that is declared, and the flags.
    unsafe {
        core::arch::asm!(
            "2:",
            "subs {n}, #1",
            "bne 2b",
            n = inout(reg) rounds => _,
            options(nomem, nostack),
        );
    }
}

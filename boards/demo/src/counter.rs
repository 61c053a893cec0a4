//! Counting instructions with the core's own counter.
//!
//! **Arm: SysTick.** Under QEMU's `-icount shift=0` every instruction takes one nanosecond of virtual time, and
//! SysTick counts the core clock's periods of that time: at 25 MHz one tick is 40 instructions.
//! The count is exact but for the tick at either end, and the same in every run. (Real chips
//! count cycles this way.)
//!
//! **RISC-V: `minstret`**, which counts instructions anyway, and exactly so under `-icount` only.

use crate::frame::Watch;

#[cfg(target_arch = "arm")]
mod ticks {
    use cortex_m::Peripherals;
    use cortex_m::peripheral::SYST;
    use cortex_m::peripheral::syst::SystClkSource;

    /// SysTick has 24 bits: what is counted may take 2²⁴ ticks, 671 million instructions at
    /// 25 MHz.
    const MASK: u32 = 0x00FF_FFFF;

    /// The counter, which nobody else may set to something else.
    pub(super) struct Ticks {
        _syst: SYST,
    }

    impl Ticks {
        pub(super) fn take() -> Self {
            let mut syst = Peripherals::take().expect("a board is made once").SYST;
            syst.set_clock_source(SystClkSource::Core);
            syst.set_reload(MASK);
            syst.clear_current();
            syst.enable_counter();
            Self { _syst: syst }
        }

        pub(super) fn now(&self) -> u32 {
            SYST::get_current()
        }

        pub(super) fn since(&self, start: u32) -> u32 {
            // It counts downwards.
            start.wrapping_sub(SYST::get_current()) & MASK
        }
    }
}

#[cfg(target_arch = "riscv32")]
mod ticks {
    use riscv::register::minstret;

    /// The counter, which runs from the start.
    pub(super) struct Ticks;

    impl Ticks {
        pub(super) fn take() -> Self {
            Self
        }

        pub(super) fn now(&self) -> u32 {
            minstret::read() as u32
        }

        pub(super) fn since(&self, start: u32) -> u32 {
            self.now().wrapping_sub(start)
        }
    }
}

/// Adds up the ticks between [`before`](Watch::before) and [`after`](Watch::after).
pub(crate) struct Counter {
    ticks: ticks::Ticks,
    start: u32,
    sum: u64,
}

impl Counter {
    /// The counter there is.
    ///
    /// # Panics
    /// When called twice.
    pub(crate) fn new() -> Self {
        Self { ticks: ticks::Ticks::take(), start: 0, sum: 0 }
    }

    /// The ticks so far, and back to none.
    pub(crate) fn take(&mut self) -> u64 {
        core::mem::take(&mut self.sum)
    }
}

impl Watch for Counter {
    fn before(&mut self) {
        self.start = self.ticks.now();
    }

    fn after(&mut self) {
        self.sum += u64::from(self.ticks.since(self.start));
    }
}

/// Spins for some rounds of two instructions (a subtraction and a branch), to check the tick's
/// length against.
#[inline(never)]
pub(crate) fn spin(rounds: u32) {
    // SAFETY: changes a register that is declared, and the flags.
    #[cfg(target_arch = "arm")]
    unsafe {
        core::arch::asm!(
            "2:",
            "subs {n}, #1",
            "bne 2b",
            n = inout(reg) rounds => _,
            options(nomem, nostack),
        );
    }
    // SAFETY: changes a register that is declared.
    #[cfg(target_arch = "riscv32")]
    unsafe {
        core::arch::asm!(
            "2:",
            "addi {n}, {n}, -1",
            "bnez {n}, 2b",
            n = inout(reg) rounds => _,
            options(nomem, nostack),
        );
    }
}

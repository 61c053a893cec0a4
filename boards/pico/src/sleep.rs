//! Waiting without spinning: the core sleeps until the timer wakes it, which saves power on a
//! board and time in an emulator.

use embedded_hal::delay::DelayNs;
use rp2040_hal::fugit::MicrosDurationU32;
use rp2040_hal::pac::{Interrupt, NVIC, interrupt};
use rp2040_hal::timer::{Alarm, Alarm0};

/// An alarm of the timer's.
pub(crate) struct Sleep(Alarm0);

impl Sleep {
    pub(crate) fn new(mut alarm: Alarm0) -> Self {
        alarm.enable_interrupt();
        Self(alarm)
    }

    fn us(&mut self, us: u32) {
        cortex_m::interrupt::free(|_| {
            // It has already passed, at worst, and then the alarm is finished.
            let _ = self.0.schedule(MicrosDurationU32::micros(us));
            // SAFETY: interrupts are off until it is masked again, so it wakes the core and no
            // more; and its handler does nothing but mask it.
            unsafe { NVIC::unmask(Interrupt::TIMER_IRQ_0) };
            while !self.0.finished() {
                cortex_m::asm::wfi();
            }
            NVIC::mask(Interrupt::TIMER_IRQ_0);
            self.0.clear_interrupt();
            NVIC::unpend(Interrupt::TIMER_IRQ_0);
        });
    }

    pub(crate) fn ms(&mut self, ms: u32) {
        self.us(ms.saturating_mul(1_000));
    }
}

impl DelayNs for Sleep {
    fn delay_ns(&mut self, ns: u32) {
        // One more, since the current microsecond has begun.
        self.us(ns.div_ceil(1_000) + 1);
    }

    fn delay_us(&mut self, us: u32) {
        self.us(us.saturating_add(1));
    }
}

/// Never taken on a chip: interrupts are off while it is waited for. The emulator takes it.
#[interrupt]
fn TIMER_IRQ_0() {
    NVIC::mask(Interrupt::TIMER_IRQ_0);
}

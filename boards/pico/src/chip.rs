//! What differs between the Pico and the Pico 2: the chip's crate, its timer and how it sleeps, and
//! the arithmetic. This is the Pico's, the RP2040.

use embedded_hal::delay::DelayNs;
use hal::fugit::MicrosDurationU32;
use hal::pac::{Interrupt, NVIC, interrupt};
use hal::timer::{Alarm, Alarm0};
use whitted_demo::job::ArithName;

pub(crate) use hal::timer::Timer;
pub(crate) use rp2040_hal as hal;

/// What pictures are computed in.
pub(crate) type Number = whitted::math::Fixed;
/// Its name.
pub(crate) const ARITH: ArithName = ArithName::Fixed;

/// The second stage loader: it makes the flash readable.
// SAFETY: the linker's map places this section where the boot ROM looks for the loader.
#[unsafe(link_section = ".boot2")]
#[used]
static BOOT2: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// The timer, of the chip's parts and its clocks.
macro_rules! timer {
    ($chip:ident, $clocks:ident) => {
        $crate::chip::Timer::new($chip.TIMER, &mut $chip.RESETS, &$clocks)
    };
}
pub(crate) use timer;

/// Sleeps until an interrupt, of which there may be none.
pub(crate) fn wait() {
    cortex_m::asm::wfi();
}

/// Waiting without spinning: the core sleeps until the timer's alarm wakes it, which saves power on
/// a board and time in an emulator.
pub(crate) struct Sleep(Alarm0);

impl Sleep {
    /// With the timer's first alarm.
    ///
    /// # Panics
    /// If somebody has it.
    pub(crate) fn new(timer: &mut Timer) -> Self {
        let mut alarm = timer.alarm_0().expect("nobody has taken an alarm");
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

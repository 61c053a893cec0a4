//! What differs between the Pico and the Pico 2: the chip's crate, its timer and how it sleeps, and
//! the arithmetic. This is the Pico 2's, the RP2350, with cores of either kind.

use embedded_hal::delay::DelayNs;
use hal::block::ImageDef;
use hal::timer::CopyableTimer0;
// Its critical sections are linked.
#[cfg(target_arch = "riscv32")]
use riscv as _;
use whitted_demo::job::ArithName;

pub(crate) use rp235x_hal as hal;

/// What pictures are computed in: single precision where the core has it, unless it isn't wanted.
#[cfg(not(any(feature = "fixed", target_arch = "riscv32")))]
pub(crate) type Number = f32;
/// What pictures are computed in: the RISC-V cores have no floating point.
#[cfg(any(feature = "fixed", target_arch = "riscv32"))]
pub(crate) type Number = whitted::math::Fixed;
/// Its name.
pub(crate) const ARITH: ArithName = if cfg!(any(feature = "fixed", target_arch = "riscv32")) {
    ArithName::Fixed
} else {
    ArithName::F32
};

/// What the boot ROM wants to know: an image for cores of this kind, in their secure state.
// SAFETY: the linker's map places this section where the boot ROM looks for the definition.
#[unsafe(link_section = ".start_block")]
#[used]
static IMAGE: ImageDef = ImageDef::secure_exe();

pub(crate) type Timer = hal::Timer<CopyableTimer0>;

/// The timer, of the chip's parts and its clocks.
macro_rules! timer {
    ($chip:ident, $clocks:ident) => {
        $crate::chip::Timer::new_timer0($chip.TIMER0, &mut $chip.RESETS, &$clocks)
    };
}
pub(crate) use timer;

/// Sleeps until an interrupt, of which there may be none.
pub(crate) fn wait() {
    hal::arch::wfi();
}

/// Waiting, by looking at the timer.
pub(crate) struct Sleep(Timer);

impl Sleep {
    pub(crate) fn new(timer: &mut Timer) -> Self {
        Self(*timer)
    }

    pub(crate) fn ms(&mut self, ms: u32) {
        self.0.delay_ms(ms);
    }
}

impl DelayNs for Sleep {
    fn delay_ns(&mut self, ns: u32) {
        self.0.delay_ns(ns);
    }
}

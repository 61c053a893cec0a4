//! How much stack a frame takes: what is free is painted, and read again afterwards.

use core::ptr;

/// Neither an address in any board's memory nor a likely number.
const PAINT: u32 = 0xA5C3_3C5A;
/// What the painting itself may be using below the stack pointer it read.
const MARGIN: usize = 128;

unsafe extern "C" {
    /// Start of initialised data, as the linker scripts of cortex-m-rt and riscv-rt name it.
    static mut __sdata: u32;
    /// End of everything static, where the free memory starts.
    static mut __sheap: u32;
}

/// Bytes of RAM that hold statics.
#[must_use]
pub fn static_bytes() -> usize {
    (&raw const __sheap).addr() - (&raw const __sdata).addr()
}

/// Paints what is free below this call; [`used`] tells what was used since.
#[inline(never)]
#[must_use]
pub fn paint() -> usize {
    let top = stack_pointer();
    let mut p = &raw mut __sheap;
    while p.addr() + MARGIN < top {
        // SAFETY: between the end of the statics and the stack pointer lies memory that nothing
        // owns (there is no heap), aligned to words by the linker script. Volatile, so that the
        // write stays.
        unsafe {
            ptr::write_volatile(p, PAINT);
            p = p.add(1);
        }
    }
    top
}

/// How far below `top` the stack has reached since [`paint`] returned it.
#[inline(never)]
#[must_use]
pub fn used(top: usize) -> usize {
    let mut p = &raw const __sheap;
    // SAFETY: reads memory that `paint` has written.
    while p.addr() < top && unsafe { ptr::read_volatile(p) } == PAINT {
        // SAFETY: stays between the end of the statics and `top`.
        p = unsafe { p.add(1) };
    }
    top.saturating_sub(p.addr())
}

#[cfg(any(target_arch = "arm", target_arch = "riscv32"))]
fn stack_pointer() -> usize {
    let pointer;
    // SAFETY: reads a register, and nothing else.
    unsafe {
        #[cfg(target_arch = "arm")]
        core::arch::asm!("mov {}, sp", out(reg) pointer, options(nomem, nostack, preserves_flags));
        #[cfg(target_arch = "riscv32")]
        core::arch::asm!("mv {}, sp", out(reg) pointer, options(nomem, nostack));
    }
    pointer
}

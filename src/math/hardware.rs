//! The one `unsafe` of the library: the square root instruction of Arm's floating-point units,
//! which `core` does not offer and `libm` does not use.
#![allow(unsafe_code)]

/// `vsqrt.f32`, through core registers so that no register class beyond `reg` is needed.
#[inline(always)]
pub(crate) fn sqrt(x: f32) -> f32 {
    let root: u32;
    // SAFETY: touches no memory and only the registers named; the target has the unit, since
    // its ABI passes floats in its registers.
    unsafe {
        core::arch::asm!(
            "vmov s0, {x}",
            "vsqrt.f32 s0, s0",
            "vmov {root}, s0",
            x = in(reg) x.to_bits(),
            root = lateout(reg) root,
            out("s0") _,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    f32::from_bits(root)
}

//! A panic handler that can't be linked.

use core::panic::PanicInfo;

unsafe extern "C" {
    /// Defined nowhere.
    fn THE_LIBRARY_CAN_PANIC() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    // SAFETY: never runs: a program that could call it doesn't link.
    unsafe { THE_LIBRARY_CAN_PANIC() }
}

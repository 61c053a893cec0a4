//! What the board says, where somebody listens.

use crate::link::Fault;
use crate::order::Order;

/// A frame has been drawn.
#[cfg(feature = "rtt")]
pub(crate) fn frame(order: &Order, us: u64, stack: usize, memory: usize) {
    defmt::info!(
        "{=str} {=u16}x{=u16}: {=u64} us, stack {=usize} bytes, static RAM {=usize} bytes",
        order.frame.scene.name(),
        order.frame.width,
        order.frame.height,
        us,
        stack,
        memory
    );
}

/// A frame couldn't be sent.
#[cfg(feature = "rtt")]
pub(crate) fn fault(order: &Order, fault: Fault) {
    defmt::error!(
        "{=str}: {=str}; the frame is drawn again",
        order.frame.scene.name(),
        fault.words()
    );
}

/// Nobody listens.
#[cfg(not(feature = "rtt"))]
pub(crate) fn fault(_: &Order, fault: Fault) {
    let _ = fault.words();
}

/// Nobody listens.
#[cfg(not(feature = "rtt"))]
pub(crate) fn frame(_: &Order, _: u64, _: usize, _: usize) {}

#[cfg(feature = "rtt")]
use defmt_rtt as _;
#[cfg(all(feature = "rtt", target_arch = "arm"))]
use panic_probe as _;

/// Says why, as `panic-probe` does, which knows Arm's cores alone.
#[cfg(all(feature = "rtt", not(target_arch = "arm")))]
#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    defmt::error!("{}", defmt::Display2Format(info));
    loop {
        crate::chip::wait();
    }
}

/// Stops; the display keeps what it shows.
#[cfg(not(feature = "rtt"))]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {
        crate::chip::wait();
    }
}

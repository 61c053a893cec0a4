//! The control of the experiment: a program that can panic, so that it must not link.
#![no_std]
#![no_main]

mod unlinkable;

use core::hint::black_box;

/// Where linking starts from.
#[unsafe(no_mangle)]
pub extern "C" fn probe() -> u8 {
    // An index that the compiler doesn't know.
    black_box([1, 2, 3])[black_box(1_usize)]
}

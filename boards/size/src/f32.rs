//! Single precision.
#![no_std]
#![no_main]

mod kernel;

use whitted::frame::Rgb565;
use whitted::trace::Work;
use whitted_demo::frame::MAX_DEPTH;

/// Where linking starts from.
#[unsafe(no_mangle)]
pub extern "C" fn probe(work: &mut Work<f32, MAX_DEPTH>, y: u16, row: &mut [Rgb565; 240]) {
    kernel::row(work, y, row);
}

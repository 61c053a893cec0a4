//! What boards on embassy share: a display on SPI whose bus sends by DMA, and a frame that goes
//! there in bands of rows. Sending a band is awaited while the next is traced.
//!
//! Tracing isn't interrupted for other tasks: they get their turn between bands.
#![no_std]

mod frame;
mod link;

pub use frame::{Frame, TRIES, draw};
pub use link::{BAND, Buffers, Fault, Link};

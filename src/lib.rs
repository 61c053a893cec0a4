//! Classic ray tracing (Whitted 1980) on microcontrollers.
#![no_std]
#![deny(unsafe_code)]

mod draw;
pub mod frame;
pub mod math;
pub mod octree;
pub mod scene;
pub mod shape;
pub mod tally;
pub mod trace;

pub use draw::{Color, Picture};

//! What every firmware of this project shares: the scenes, the frame loop, checksums, and, on a
//! chip, counting and reporting. The host uses the same scenes and the same frame loop to know
//! what a board has to print, so all but the module `board` runs anywhere.
//!
//! A function that draws any scene is a copy of the tracer for each. Those that only some firmware calls are
//! `inline` on chips, so that they are compiled where they are called: nobody waits for them in vain.
#![no_std]

pub mod checksum;
pub mod deal;
pub mod depths;
pub mod fault;
pub mod flash;
pub mod frame;
pub mod job;
pub mod oled;
pub mod rebuild;
pub mod rgb565;
pub mod room;
pub mod scenes;

#[cfg(all(target_os = "none", feature = "semihosting"))]
pub mod board;
#[cfg(all(target_os = "none", feature = "semihosting"))]
mod counter;
#[cfg(target_os = "none")]
pub mod stack;

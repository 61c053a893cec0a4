//! Blobs: what was baked is what is read, and hostile bytes are refused or harmless.
//!
//! The tests' files are written over a type `A` that the module above them names, one for each arithmetic.

#![allow(clippy::duplicate_mod, reason = "each arithmetic needs the tests anew")]

mod aligned;
mod fixed;
mod single;
mod specs;

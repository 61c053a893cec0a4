//! Where rays are traced from. A tracer that is called from one place the compiler puts in line there, and then it
//! knows which scene is traced, if it was given a reference; called from two, it is a function that reads the scene from memory,
//! and takes a third more cycles. (A scene given as a type is known in either.) So each site has a tracer of its own; ways
//! of drawing that a firmware doesn't use cost nothing.

/// Wherever code is dearer than time.
pub(crate) const ANY: u8 = 0;
/// A line of pixels.
pub(crate) const LINE: u8 = 1;
/// A band of bytes.
pub(crate) const BAND: u8 = 2;
/// Pixels as an iterator.
pub(crate) const SCAN: u8 = 3;
/// Blocks from coarse to fine.
pub(crate) const PASS: u8 = 4;

/// Whether the tracer of scenes of spheres and planes alone is always in line there.
pub(crate) const fn is_in_line<const SITE: u8>() -> bool {
    matches!(SITE, LINE | BAND)
}

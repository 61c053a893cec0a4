//! A tree with the memory it lies in: for scenes in `static`s.

use super::Extent;
use super::builder::build_into;
use super::limits::{BuildError, Built, Limits};

/// Scratch memory for trees in `const`s.
const SCRATCH: usize = 8192;

/// A tree and the memory it lies in, for a `static`.
#[derive(Clone, Copy, Debug)]
pub struct OctreeBuffer<const WORDS: usize> {
    words: [u32; WORDS],
    shapes: usize,
    built: Built,
}

impl<const WORDS: usize> OctreeBuffer<WORDS> {
    /// The tree over the extents, for `static`s: too few words don't compile. (The compiler may
    /// want `#[allow(long_running_const_eval)]` for large scenes.)
    ///
    /// # Panics
    /// Where [`try_build`](Self::try_build) has an error.
    pub const fn build(extents: &[Extent]) -> Self {
        match Self::try_build(extents, Limits::DEFAULT) {
            Ok(buffer) => buffer,
            Err(error) => panic!("{}", error.message()),
        }
    }

    /// The tree over the extents. Meant for `const` context: it takes 32 KiB of scratch memory
    /// from the stack; [`build_into`] takes the caller's.
    ///
    /// # Errors
    /// A shape out of range, or too little memory.
    pub const fn try_build(extents: &[Extent], limits: Limits) -> Result<Self, BuildError> {
        let mut words = [0; WORDS];
        let mut scratch = [0; SCRATCH];
        match build_into(extents, &mut words, &mut scratch, limits) {
            Ok(built) => Ok(Self { words, shapes: extents.len(), built }),
            Err(error) => Err(error),
        }
    }

    /// What was built.
    pub const fn built(&self) -> &Built {
        &self.built
    }

    /// For how many shapes.
    pub const fn shapes(&self) -> usize {
        self.shapes
    }

    /// The tree's words.
    pub const fn words(&self) -> &[u32] {
        match self.words.split_at_checked(self.built.words) {
            Some((words, _)) => words,
            None => &[],
        }
    }
}

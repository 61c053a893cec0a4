//! The memory a tracer writes: all there is, bounded by MAX_DEPTH.

use super::radiance::Path;
use crate::math::Arithmetic;
use crate::octree::WalkStack;

/// The working memory of a tracer: a ray waiting for each level of the tree, and the octree
/// walk's stack. Initialised once; nothing is cleared between rays.
#[derive(Clone, Debug)]
pub struct Work<A: Arithmetic, const MAX_DEPTH: usize> {
    pub(super) waiting: [Path<A>; MAX_DEPTH],
    pub(super) scratch: Scratch<A>,
}

/// What searches along rays write.
#[derive(Clone, Debug)]
pub(super) struct Scratch<A: Arithmetic> {
    pub(super) walk: WalkStack<A>,
}

impl<A: Arithmetic> Scratch<A> {
    const fn new() -> Self {
        Self { walk: WalkStack::new() }
    }
}

impl<A: Arithmetic, const MAX_DEPTH: usize> Work<A, MAX_DEPTH> {
    /// Memory for trees of rays up to `MAX_DEPTH` deep, the camera's ray being depth 1.
    pub const fn new() -> Self {
        Self { waiting: [const { Path::NONE }; MAX_DEPTH], scratch: Scratch::new() }
    }
}

impl<A: Arithmetic, const MAX_DEPTH: usize> Default for Work<A, MAX_DEPTH> {
    fn default() -> Self {
        Self::new()
    }
}

//! How far a builder goes, and what it says.

use core::fmt;

/// How far to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// So many levels; the grid counts as those that it stands for, up to three. Below it there are at
    /// most [`MAX_LEVELS`](super::MAX_LEVELS).
    pub levels: u8,
    /// A cell of so many shapes or fewer is never cut.
    pub leaf: u8,
    /// Cells are enlarged by 2^−precision of what eight cells of the grid span, up to twice that; 6 to 24,
    /// and what lies beyond counts as these. Fixed point needs 12; floats can do with 16, unless rays start
    /// hundreds of sides away.
    pub precision: u8,
}

impl Limits {
    /// Good for all arithmetics: ten levels (where the margin is a quarter of a cell or more), leaves as
    /// the cost wants them.
    pub const DEFAULT: Self = Self { levels: 10, leaf: 2, precision: 12 };
}

impl Default for Limits {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// The cube that a tree lies in: the grid starts at its smallest coordinates, and may be shorter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cube {
    /// The smallest coordinates, in steps (see [`Extent`](super::Extent)).
    pub origin: [i32; 3],
    /// The side is 2 to this power, in steps.
    pub log2_side: u8,
}

/// What was built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Built {
    /// Words used.
    pub words: usize,
    /// Words of scratch used.
    pub scratch: usize,
    /// Levels, those that the grid stands for among them.
    pub levels: u8,
    /// The cube.
    pub cube: Cube,
}

/// Why a tree can't be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum BuildError {
    /// The words don't suffice.
    Words,
    /// The scratch memory doesn't suffice.
    Scratch,
    /// A shape reaches beyond ±2²⁷ steps, or its numbers make no sense.
    Extent,
    /// More shapes than there are ids.
    TooManyShapes,
}

impl BuildError {
    /// What is wrong, in words: for `const` panics and logs.
    pub const fn message(self) -> &'static str {
        match self {
            Self::Words => "too few words for the octree",
            Self::Scratch => "too little scratch memory to build the octree",
            Self::Extent => "a shape is out of the octree's range",
            Self::TooManyShapes => "an octree holds at most 8388607 shapes",
        }
    }
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.message())
    }
}

impl core::error::Error for BuildError {}

//! The octree: a grid of cells, each cut in eight, again and again (Glassner 1984; the walk after
//! Amanatides and Woo 1987, and within a cell after Revelles, Ureña and Lastra 2000 and Laine and Karras
//! 2010).

mod buffer;
mod builder;
mod extent;
mod grid;
mod limits;
mod node;
mod overlap;
mod round;
mod walk;

pub use buffer::OctreeBuffer;
pub use builder::build_into;
pub use extent::Extent;
pub use limits::{BuildError, Built, Cube, Limits};
pub use node::{MAX_ID_BITS, MAX_LEVELS, TreeError, validate};
pub(crate) use overlap::bounds;
pub use walk::{Octree, Visitor, WalkStack};

#[cfg(test)]
mod tests;

//! What readers of meshes share: faces, and a view for files that say nothing of one.

mod face;
mod frame;
mod map;

pub(crate) use face::{Faces, Skipped};
pub(crate) use frame::frame;
pub(crate) use map::{bare, repeated, texture};

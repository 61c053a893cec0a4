//! Fixed point.

#[path = "bytes.rs"]
mod bytes;
#[path = "groups.rs"]
mod groups;
#[path = "kinds.rs"]
mod kinds;
#[path = "picture.rs"]
mod picture;
#[path = "tree.rs"]
mod tree;

type A = whitted::math::Fixed;

/// Whether a value is tried in the place of another.
fn is_tried(_: [u8; 2]) -> bool {
    true
}

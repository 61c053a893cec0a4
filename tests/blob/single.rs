//! Single precision.

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

type A = f32;

/// Whether a value is tried in the place of another: here a bit at a time, since the layout is the same.
fn is_tried([value, right]: [u8; 2]) -> bool {
    u8::count_ones(value ^ right) == 1
}

//! The trees that blobs hold.

use super::A;
use whitted::octree::{Built, Cube, Limits, build_into};
use whitted::scene::Parts;

/// The grid's steps: 2 to this power.
pub(super) const STEP: i8 = -16;

/// The words of a tree over these parts' `SHAPES` bounded shapes, and its cube.
pub(super) fn grown<const SHAPES: usize>(parts: &Parts<'_, A>, levels: u8) -> (Vec<u32>, Cube) {
    let extents = parts.extents::<SHAPES>(STEP);
    let (mut words, mut scratch) = (vec![0; 4096], vec![0; 4096]);
    let limits = Limits { levels, ..Limits::DEFAULT };
    let Built { words: used, cube, .. } =
        build_into(&extents, &mut words, &mut scratch, limits).unwrap();
    words.truncate(used);
    (words, cube)
}

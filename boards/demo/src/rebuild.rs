//! What it takes to build a tree anew on a chip: for scenes whose shapes move on their own.

use whitted::math::Fixed;
use whitted::octree::{Extent, Limits, Octree, build_into};

use crate::checksum::Checksum;
use crate::frame::Watch;

/// The most shapes there is memory for.
pub const MAX_SHAPES: usize = 256;
/// So many shapes are built for when all is counted.
pub const SHAPES: [usize; 2] = [64, MAX_SHAPES];
/// What trees of them may take.
const WORDS: usize = 8 * MAX_SHAPES;
const SCRATCH: usize = 8 * MAX_SHAPES;

/// A tree that was built.
#[derive(Clone, Copy, Debug)]
pub struct Rebuilt {
    /// Of its words.
    pub checksum: Checksum,
    /// Its words.
    pub words: usize,
    /// Words of scratch memory that it took.
    pub scratch: usize,
}

/// Builds the tree over so many spheres at random in a cube of side 8, in memory of the caller's,
/// and checks it, as a scene would have it; `watch` sees that and nothing else.
///
/// # Panics
/// With more than [`MAX_SHAPES`].
#[inline(never)]
pub fn rebuild(shapes: usize, watch: &mut impl Watch) -> Rebuilt {
    let mut extents = [Extent::Sphere { center: [0; 3], radius: 0 }; MAX_SHAPES];
    let extents = extents.get_mut(..shapes).expect("so many shapes");
    let mut state = 1;
    for extent in extents.iter_mut() {
        // Steps are 2⁻¹⁶. The more spheres, the smaller: radii up to ⅝ and half of that.
        let center = [0; 3].map(|_| (random(&mut state) << 3) - (4 << 16));
        let radius = (random(&mut state) + (1 << 14)) >> if shapes > 64 { 2 } else { 1 };
        *extent = Extent::Sphere { center, radius };
    }
    let (mut words, mut scratch) = ([0; WORDS], [0; SCRATCH]);
    watch.before();
    let built = build_into(extents, &mut words, &mut scratch, Limits::DEFAULT).expect("room");
    let used = words.get(..built.words).unwrap_or_default();
    let tree = Octree::<Fixed>::try_new(used, shapes, &built.cube, -16).expect("a tree");
    watch.after();
    assert!(tree.shapes() as usize == shapes);
    let mut checksum = Checksum::EMPTY;
    checksum.add(used.iter().flat_map(|word| word.to_le_bytes()));
    Rebuilt { checksum, words: built.words, scratch: built.scratch }
}

/// 0 to 2¹⁶: a congruential generator with Knuth's constants for MMIX.
fn random(state: &mut u64) -> i32 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 48) as i32
}

#[cfg(test)]
mod tests {
    use super::{SHAPES, rebuild};

    #[test]
    fn fits() {
        for shapes in SHAPES {
            let built = rebuild(shapes, &mut ());
            // A word a shape, about, and room that grows with them.
            assert!(built.words > shapes / 2 && built.words <= 8 * shapes, "{built:?}");
            assert!(built.scratch > 0 && built.scratch <= 4 * shapes, "{built:?}");
        }
    }
}

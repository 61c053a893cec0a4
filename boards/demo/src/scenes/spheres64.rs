//! What a ray through an octree takes: 64 spheres at random in a cube, which glow and do nothing
//! else, so that each pixel is one ray and its walk.

use super::A;
use whitted::octree::{Octree, OctreeBuffer};
use whitted::scene::{Camera, Material, MaterialSpec, Parts, Scene};
use whitted::shape::Sphere;

const COUNT: usize = 64;
/// Steps of the tree's grid in floating point: ±128 units.
const LOG2_STEP: i8 = -20;

pub(super) static SCENE: Scene<A, { PARTS.uses() }> = Scene::tailored(PARTS);

pub(super) const PARTS: Parts<A> = Parts { tree: Some(TREE), ..LIST };

const LIST: Parts<A> = Parts {
    spheres: &SPHERES,
    materials: &[glow([0.9, 0.3, 0.1]), glow([0.2, 0.7, 0.3]), glow([0.1, 0.3, 0.8])],
    ..Parts::EMPTY
};

static SPHERES: [Sphere<A>; COUNT] = spheres();

const TREE: Octree<'static, A> = Octree::<A>::of(&BUFFER, LOG2_STEP);
static BUFFER: OctreeBuffer<512> = OctreeBuffer::build(&LIST.extents::<COUNT>(LOG2_STEP));

pub(super) static CAMERA: Camera<A> =
    Camera::<A>::look_at([1.3, 2.7, -13.1], [0.1, 0.2, 0.3], [0.0, 1.0, 0.0], 40.0);

/// Centres within ±4, radii from 0.2 to 0.8.
const fn spheres() -> [Sphere<A>; COUNT] {
    let mut all = [Sphere::<A>::new([0.0; 3], 1.0, 0); COUNT];
    let mut state = 1;
    let mut i = 0;
    while i < COUNT {
        let mut random = [0.0; 4];
        let mut k = 0;
        while k < 4 {
            random[k] = next(&mut state);
            k += 1;
        }
        let center = [8.0 * random[0] - 4.0, 8.0 * random[1] - 4.0, 8.0 * random[2] - 4.0];
        all[i] = Sphere::<A>::new(center, 0.2 + 0.6 * random[3], (i % 3) as u16);
        i += 1;
    }
    all
}

/// Evenly distributed in 0 to 1: a congruential generator with Knuth's constants for MMIX, of which
/// the upper bits are taken.
const fn next(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 40) as f64 / (1_u64 << 24) as f64
}

const fn glow(emission: [f64; 3]) -> Material<A> {
    Material::<A>::new(MaterialSpec { emission, ..MaterialSpec::BLACK })
}

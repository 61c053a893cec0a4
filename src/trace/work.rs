//! The memory a tracer writes: all there is, bounded by MAX_DEPTH.

use super::radiance::Path;
use super::sight::Sights;
use crate::math::Arithmetic;
use crate::octree::WalkStack;
use crate::scene::Scene;

/// The working memory of a tracer: a ray waiting for each level of the tree, and the octree
/// walk's stack, what last stood before each of eight lights, and in which directions the first few
/// spheres are seen from the eye and from two lights. Initialised once; nothing is cleared
/// between rays.
#[derive(Clone, Debug)]
pub struct Work<A: Arithmetic, const MAX_DEPTH: usize> {
    pub(super) waiting: [Path<A>; MAX_DEPTH],
    pub(super) scratch: Scratch<A>,
    /// What can be seen in the scene that a renderer traces with this memory.
    pub(super) sights: Sights<A>,
}

/// No shape's number.
pub(super) const NO_SHAPE: u32 = u32::MAX;

/// So many lights have what last stood in their way remembered; others share.
const LIGHTS: usize = 8;

/// The number of lights that have none: they share the last place.
pub(super) const NO_LIGHT: u16 = u16::MAX;

/// What searches along rays write.
#[derive(Clone, Debug)]
pub(super) struct Scratch<A: Arithmetic> {
    pub(super) walk: WalkStack<A>,
    /// The shape in an octree that last stood in each light's way: likely the next one's, too. It is
    /// tested first, which changes how soon a shadow ray is answered, not how.
    occluders: [u32; LIGHTS],
    /// The picture's row that they are of.
    row: u32,
}

impl<A: Arithmetic> Scratch<A> {
    const fn new() -> Self {
        Self { walk: WalkStack::new(), occluders: [NO_SHAPE; LIGHTS], row: u32::MAX }
    }

    /// The walk's memory, and the remembered occluder of a light.
    #[inline(always)]
    pub(super) fn of_light(&mut self, light: u16) -> (&mut WalkStack<A>, &mut u32) {
        // A mask that is below the length: no check is left.
        (&mut self.walk, &mut self.occluders[usize::from(light) & (LIGHTS - 1)])
    }
}

impl<A: Arithmetic, const MAX_DEPTH: usize> Work<A, MAX_DEPTH> {
    /// Begins a row of the picture: forgets what stood before lights in another one, so that what is
    /// counted doesn't depend on which rows were traced before.
    #[inline(always)]
    pub(crate) fn begin_row(&mut self, row: u32) {
        if self.scratch.row != row {
            self.scratch.row = row;
            self.scratch.occluders = [NO_SHAPE; LIGHTS];
        }
    }

    /// Looks around from an eye and from the lights: what [`Tracer::seen`](super::Tracer::seen) asks.
    pub(crate) fn look<const USES: u64>(
        &mut self,
        scene: &Scene<'_, A, USES>,
        eye: &[A::Length; 3],
    ) {
        self.sights.look(scene, eye);
    }

    /// Memory for trees of rays up to `MAX_DEPTH` deep, the camera's ray being depth 1.
    pub const fn new() -> Self {
        Self {
            waiting: [const { Path::NONE }; MAX_DEPTH],
            scratch: Scratch::new(),
            sights: Sights::NONE,
        }
    }
}

impl<A: Arithmetic, const MAX_DEPTH: usize> Default for Work<A, MAX_DEPTH> {
    fn default() -> Self {
        Self::new()
    }
}

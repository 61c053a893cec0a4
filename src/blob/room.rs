//! Memory for what a blob's scene isn't read in place.

use crate::math::Arithmetic;
use crate::scene::{Absorption, AreaLight, FanCorner, Group, Instance, Light, Material, Texture};
use crate::shape::{Operand, Solid};

/// Memory of the caller's for what is made anew of a blob: slices as long as
/// [`Blob::counts`](super::Blob::counts) says, or longer, of whatever values. What a scene has none
/// of needs none: `Room { materials, lights, ..Room::default() }`.
#[derive(Debug)]
pub struct Room<'r, 'b, A: Arithmetic> {
    /// For materials.
    pub materials: &'r mut [Material<A>],
    /// For lights.
    pub lights: &'r mut [Light<A>],
    /// For lights with an area.
    pub area_lights: &'r mut [AreaLight<A>],
    /// For the fans of those that are polygons.
    pub fans: &'r mut [FanCorner<A>],
    /// For textures; their pictures stay where the blob lies.
    pub textures: &'r mut [Texture<'b, A>],
    /// For media.
    pub absorptions: &'r mut [Absorption<A>],
    /// For solids, those of groups among them.
    pub solids: &'r mut [Solid<A>],
    /// For their operands.
    pub operands: &'r mut [Operand<A>],
    /// For groups; their shapes stay where the blob lies, but for solids.
    pub groups: &'r mut [Group<'r, A>],
    /// For what stands where of them.
    pub instances: &'r mut [Instance<'r, A>],
}

impl<A: Arithmetic> Default for Room<'_, '_, A> {
    fn default() -> Self {
        Self {
            materials: &mut [],
            lights: &mut [],
            area_lights: &mut [],
            fans: &mut [],
            textures: &mut [],
            absorptions: &mut [],
            solids: &mut [],
            operands: &mut [],
            groups: &mut [],
            instances: &mut [],
        }
    }
}

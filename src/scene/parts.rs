//! What a scene is put together from.

use super::{
    Absorption, Ambient, AreaLight, Background, FanCorner, Instance, Light, Material, Rules,
    Selection, Texture, TriangleUv,
};
use crate::gather::Indirect;
use crate::math::Arithmetic;
use crate::octree::Octree;
use crate::shape::{Cone, Cuboid, Cylinder, Disc, Operand, Plane, Polygon};
use crate::shape::{PolygonEdge, SmoothTriangle, Solid, Sphere, Triangle};

/// What a scene is put together from. Shapes are numbered through in the order of the fields,
/// those of each instance after each other, planes last; where two are hit at the same distance,
/// the lower number counts.
#[derive(Clone, Copy, Debug)]
pub struct Parts<'a, A: Arithmetic> {
    /// Spheres.
    pub spheres: &'a [Sphere<A>],
    /// Flat triangles.
    pub triangles: &'a [Triangle<A>],
    /// Triangles with a normal at each corner.
    pub smooth_triangles: &'a [SmoothTriangle<A>],
    /// Convex polygons.
    pub polygons: &'a [Polygon<A>],
    /// The edges of all polygons.
    pub edges: &'a [PolygonEdge<A>],
    /// Texture coordinates of the triangles, then of the smooth triangles, in their order; none for
    /// those beyond its end.
    pub uvs: &'a [TriangleUv],
    /// Boxes along the axes.
    pub cuboids: &'a [Cuboid<A>],
    /// Discs.
    pub discs: &'a [Disc<A>],
    /// Cylinders.
    pub cylinders: &'a [Cylinder<A>],
    /// Cones.
    pub cones: &'a [Cone<A>],
    /// Solids of several shapes.
    pub solids: &'a [Solid<A>],
    /// The operands of all solids.
    pub operands: &'a [Operand<A>],
    /// Groups of shapes, placed. They lie outside the octree, each in a bounding sphere: a short
    /// list.
    pub instances: &'a [Instance<'a, A>],
    /// Infinite planes; they lie outside the octree.
    pub planes: &'a [Plane<A>],
    /// The octree over all shapes but instances and planes. Without one every ray tests every shape, which is
    /// quicker for fewer than ten.
    pub tree: Option<Octree<'a, A>>,
    /// Materials, by the index that shapes give.
    pub materials: &'a [Material<A>],
    /// What materials' surfaces are coloured and bent by.
    pub textures: &'a [Texture<'a, A>],
    /// What absorbs light before and behind surfaces.
    pub absorptions: &'a [Absorption<A>],
    /// Lights.
    pub lights: &'a [Light<A>],
    /// Lights with an area, numbered after the others.
    pub area_lights: &'a [AreaLight<A>],
    /// The fans of all area lights that are polygons.
    pub light_corners: &'a [FanCorner<A>],
    /// Where in its part of an area light a shadow ray goes: through the middle, or at random,
    /// given a seed. The same seed gives the same picture on every machine.
    pub light_jitter: Option<u16>,
    /// Which lights a point asks.
    pub selection: Selection<A>,
    /// The ambient irradiance.
    pub ambient: Ambient<A>,
    /// What surfaces send each other, instead of the ambient term.
    pub indirect: Indirect<'a, A>,
    /// What rays see that hit nothing.
    pub background: Background<A>,
    /// Where the classic programs differ.
    pub rules: Rules<A>,
}

impl<A: Arithmetic> Parts<'_, A> {
    /// Nothing, in the dark: the base for `Parts { spheres: …, ..Parts::EMPTY }`.
    pub const EMPTY: Self = Self {
        spheres: &[],
        triangles: &[],
        smooth_triangles: &[],
        polygons: &[],
        edges: &[],
        cuboids: &[],
        discs: &[],
        cylinders: &[],
        cones: &[],
        solids: &[],
        operands: &[],
        instances: &[],
        planes: &[],
        tree: None,
        materials: &[],
        textures: &[],
        uvs: &[],
        absorptions: &[],
        lights: &[],
        area_lights: &[],
        light_corners: &[],
        light_jitter: None,
        selection: Selection::All,
        ambient: Ambient([A::BLACK; 3]),
        indirect: Indirect::None,
        background: Background::BLACK,
        rules: Rules::COURSE,
    };
}

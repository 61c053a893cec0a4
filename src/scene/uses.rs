//! What of the library a scene uses, as bits of a const parameter.
//!
//! A [`Scene`](super::Scene) of the default, [`ALL`], may hold anything. A scene in a `static` can
//! name what its own parts use ([`Parts::uses`]); the code for everything else is then not
//! compiled, which makes it smaller and faster. The picture is the same to the bit.
//!
//! ```
//! use whitted::math::Fixed;
//! use whitted::scene::{Material, MaterialSpec, Parts, Scene};
//! use whitted::shape::Sphere;
//!
//! const PARTS: Parts<Fixed> = Parts {
//!     spheres: &[Sphere::<Fixed>::new([0.0, 1.0, 4.0], 1.0, 0)],
//!     materials: &[Material::<Fixed>::new(MaterialSpec::BLACK)],
//!     ..Parts::EMPTY
//! };
//! static SCENE: Scene<Fixed, { PARTS.uses() }> = Scene::tailored(PARTS);
//! ```

use super::light::Source;
use super::{Background, Falloff, Instance, Parts, Selection, Shadow, Shapes};
use crate::math::{Arithmetic, Rgb};
use crate::trace::FEW;

/// Anything.
pub const ALL: u64 = u64::MAX;
/// Triangles.
pub const TRIANGLES: u64 = 1;
/// Triangles with normals at their corners.
pub const SMOOTH_TRIANGLES: u64 = 1 << 1;
/// Polygons.
pub const POLYGONS: u64 = 1 << 2;
/// Boxes.
pub const CUBOIDS: u64 = 1 << 3;
/// Discs.
pub const DISCS: u64 = 1 << 4;
/// Cylinders.
pub const CYLINDERS: u64 = 1 << 5;
/// Cones.
pub const CONES: u64 = 1 << 6;
/// Planes.
pub const PLANES: u64 = 1 << 7;
/// An octree.
pub const TREE: u64 = 1 << 8;
/// Patterns.
pub const PATTERNS: u64 = 1 << 9;
/// Highlights.
pub const HIGHLIGHTS: u64 = 1 << 10;
/// Mirrors.
pub const REFLECTION: u64 = 1 << 11;
/// Glass.
pub const TRANSMISSION: u64 = 1 << 12;
/// Shadow rays that pass through some surfaces.
pub const PASSING_SHADOWS: u64 = 1 << 13;
/// Directional lights.
pub const DIRECTIONAL_LIGHTS: u64 = 1 << 14;
/// Spots.
pub const SPOTS: u64 = 1 << 15;
/// Lights that fall off with the square of the distance.
pub const INVERSE_SQUARE: u64 = 1 << 16;
/// Lights that don't fall off.
pub const NO_FALLOFF: u64 = 1 << 17;
/// A background that isn't the same everywhere.
pub const GRADIENT: u64 = 1 << 18;
/// [`Rules::specular_cosine`](super::Rules::specular_cosine).
pub const SPECULAR_COSINE: u64 = 1 << 19;
/// [`Rules::highlight_cosine`](super::Rules::highlight_cosine).
pub const HIGHLIGHT_COSINE: u64 = 1 << 20;
/// [`Rules::transmitters_reflect`](super::Rules::transmitters_reflect).
pub const TRANSMITTERS_REFLECT: u64 = 1 << 21;
/// [`MaterialSpec::texture`](super::MaterialSpec::texture).
pub const TEXTURES: u64 = 1 << 48;
/// [`MaterialSpec::bump`](super::MaterialSpec::bump).
pub const BUMPS: u64 = 1 << 49;
/// [`MaterialSpec::fresnel`](super::MaterialSpec::fresnel).
pub const FRESNEL: u64 = 1 << 50;
/// [`MaterialSpec::absorption`](super::MaterialSpec::absorption).
pub const ABSORPTION: u64 = 1 << 51;
/// Lights with an area.
pub const AREA_LIGHTS: u64 = 1 << 22;
/// Materials that emit.
pub const EMISSION: u64 = 1 << 23;
/// Points that don't ask all lights.
pub const LIGHT_SELECTION: u64 = 1 << 24;
/// Renders that leave [`Terms`](crate::trace::Terms) out. No scene needs it: a tailored one names it
/// beside what it uses.
pub const TERMS: u64 = 1 << 25;

/// Instances of groups.
pub const INSTANCES: u64 = 1 << 40;
/// Solids.
pub const SOLIDS: u64 = 1 << 41;
/// Cylinders and cones with caps.
pub const CAPS: u64 = 1 << 42;
/// [`Indirect::Cache`](crate::gather::Indirect::Cache).
pub const IRRADIANCE_CACHE: u64 = 1 << 52;
/// [`Indirect::VirtualLights`](crate::gather::Indirect::VirtualLights).
pub const VIRTUAL_LIGHTS: u64 = 1 << 53;

// What of the things above is of the simplest kind is cheaper; these say that some isn't.

/// More than one plane.
pub const SEVERAL_PLANES: u64 = 1 << 30;
/// A plane across the x axis, its normal pointing along it.
pub const PLANES_ACROSS_X: u64 = 1 << 31;
/// A plane across the y axis, its normal pointing along it.
pub const PLANES_ACROSS_Y: u64 = 1 << 32;
/// A plane across the z axis, its normal pointing along it.
pub const PLANES_ACROSS_Z: u64 = 1 << 33;
/// Another plane.
pub const SLOPING_PLANES: u64 = 1 << 34;
/// More than one light.
pub const SEVERAL_LIGHTS: u64 = 1 << 35;
/// A light that isn't white.
pub const COLORED_LIGHTS: u64 = 1 << 36;
/// A reflection or transmission that isn't grey.
pub const COLORED_RAYS: u64 = 1 << 37;
/// Spheres that show their inside alone.
pub const INSIDES: u64 = 1 << 38;
/// More spheres than have their directions remembered, and no octree.
pub const MANY_SPHERES: u64 = 1 << 39;

// The samplings count down from the last bit. No part of a scene uses them: whoever tailors a scene
// adds what its pictures are sampled by, see `Sampling::uses`.

/// [`Sampling::Grid`](crate::frame::Sampling::Grid) and
/// [`Sampling::Jittered`](crate::frame::Sampling::Jittered).
pub const CELLS: u64 = 1 << 63;
/// [`Sampling::Corners`](crate::frame::Sampling::Corners).
pub const CORNERS: u64 = 1 << 62;
/// [`Sampling::Adaptive`](crate::frame::Sampling::Adaptive).
pub const ADAPTIVE: u64 = 1 << 61;
/// [`Sampling::Sparse`](crate::frame::Sampling::Sparse).
pub const SPARSE: u64 = 1 << 60;

/// Whether `uses` has all bits of `what`.
#[inline(always)]
pub(crate) const fn has(uses: u64, what: u64) -> bool {
    uses & what == what
}

/// Whether there may be other bounded shapes than spheres.
#[inline(always)]
pub(crate) const fn has_others(uses: u64) -> bool {
    uses & (TRIANGLES | SMOOTH_TRIANGLES | POLYGONS | CUBOIDS | DISCS | CYLINDERS | CONES | SOLIDS)
        != 0
}

/// Whether spheres and planes have a copy of the shading each: where there is nothing else, the spheres in
/// a list.
#[inline(always)]
pub(crate) const fn splits_shading(uses: u64) -> bool {
    let alone = !has_others(uses) && !has(uses, TREE) && !has(uses, INSTANCES);
    has(uses, PLANES) && alone
}

/// Whether there may be diffuse interreflection.
#[inline(always)]
pub(crate) const fn has_indirect(uses: u64) -> bool {
    uses & (IRRADIANCE_CACHE | VIRTUAL_LIGHTS) != 0
}

/// Whether pictures may be sampled otherwise than by a ray through each pixel's centre.
#[inline(always)]
pub(crate) const fn has_samplings(uses: u64) -> bool {
    uses & (CELLS | CORNERS | ADAPTIVE | SPARSE) != 0
}

/// The coefficients of a ray, of which the first stands for all where none are coloured.
#[inline(always)]
pub(crate) fn grey<A: Arithmetic, const USES: u64>(k: &Rgb<A::Weight>) -> Rgb<A::Weight> {
    if has(USES, COLORED_RAYS) || has(USES, ABSORPTION) { *k } else { [k[0]; 3] }
}

/// Does something with all of a slice and their numbers, counted on from one; or with the first alone,
/// where there is no more: no loop is left then. A macro, since a closure that two places call
/// becomes a function, and what it captures then lies in memory.
macro_rules! each {
    ($all:expr, $several:expr, $from:expr, |$one:ident, $number:ident| $act:expr) => {
        if $several {
            let mut $number = $from;
            for $one in $all {
                $act;
                $number += 1;
            }
        } else if let Some($one) = $all.first() {
            let $number = $from;
            $act;
        }
    };
}
pub(crate) use each;

/// Whether anything is random about rays.
#[inline(always)]
pub(crate) const fn has_random(uses: u64) -> bool {
    uses & (AREA_LIGHTS | LIGHT_SELECTION) != 0
}

const fn bit(wanted: bool, what: u64) -> u64 {
    if wanted { what } else { 0 }
}

impl<A: Arithmetic> Shapes<'_, A> {
    /// The bits of these shapes.
    pub(crate) const fn uses(&self) -> u64 {
        let mut caps = false;
        let mut i = 0;
        while i < self.cylinders.len() {
            caps |= self.cylinders[i].has_caps();
            i += 1;
        }
        let mut i = 0;
        while i < self.cones.len() {
            caps |= self.cones[i].has_caps();
            i += 1;
        }
        bit(!self.triangles.is_empty(), TRIANGLES)
            | bit(!self.smooth_triangles.is_empty(), SMOOTH_TRIANGLES)
            | bit(!self.polygons.is_empty(), POLYGONS)
            | bit(!self.cuboids.is_empty(), CUBOIDS)
            | bit(!self.discs.is_empty(), DISCS)
            | bit(!self.cylinders.is_empty(), CYLINDERS)
            | bit(!self.cones.is_empty(), CONES)
            | bit(!self.solids.is_empty(), SOLIDS)
            | bit(caps, CAPS)
            | bit(self.tree.is_some(), TREE)
            | bit(self.spheres.len() > FEW && self.tree.is_none(), MANY_SPHERES)
            | self.uses_of_spheres()
    }

    const fn uses_of_spheres(&self) -> u64 {
        let mut i = 0;
        while i < self.spheres.len() {
            if self.spheres[i].material_id().inside_only() {
                return INSIDES;
            }
            i += 1;
        }
        0
    }
}

/// The bits of instances and of their groups.
pub(crate) const fn of_instances<A: Arithmetic>(instances: &[Instance<'_, A>]) -> u64 {
    let mut uses = 0;
    let mut i = 0;
    while i < instances.len() {
        uses |= INSTANCES | instances[i].group().uses();
        i += 1;
    }
    uses
}

impl<A: Arithmetic> Parts<'_, A> {
    const fn uses_of_planes(&self) -> u64 {
        let mut uses = bit(!self.planes.is_empty(), PLANES);
        uses |= bit(self.planes.len() > 1, SEVERAL_PLANES);
        let mut i = 0;
        while i < self.planes.len() {
            uses |= self.planes[i].uses();
            i += 1;
        }
        uses
    }

    /// What the parts use: the bits that a [`Scene`](super::Scene) of them needs at least.
    pub const fn uses(&self) -> u64 {
        let mut uses = self.shapes().uses()
            | of_instances(self.instances)
            | self.uses_of_planes()
            | bit(self.lights.len() > 1, SEVERAL_LIGHTS)
            | self.indirect.uses()
            | bit(matches!(self.background, Background::Gradient { .. }), GRADIENT)
            | bit(self.rules.specular_cosine, SPECULAR_COSINE)
            | bit(self.rules.highlight_cosine, HIGHLIGHT_COSINE)
            | bit(self.rules.transmitters_reflect, TRANSMITTERS_REFLECT)
            | bit(!self.area_lights.is_empty(), AREA_LIGHTS)
            | bit(!matches!(self.selection, Selection::All), LIGHT_SELECTION);
        let mut i = 0;
        while i < self.materials.len() {
            let material = &self.materials[i];
            uses |= bit(material.pattern.is_some(), PATTERNS)
                | bit(material.texture().is_some(), TEXTURES)
                | bit(material.bump().is_some(), BUMPS)
                | bit(material.fresnel, FRESNEL)
                | bit(material.absorption().is_some(), ABSORPTION)
                | bit(material.shines, HIGHLIGHTS)
                | bit(material.reflects, REFLECTION)
                | bit(material.transmits, TRANSMISSION)
                | bit(material.colored, COLORED_RAYS)
                | bit(material.emits, EMISSION)
                | bit(!matches!(material.shadow, Shadow::Opaque), PASSING_SHADOWS);
            i += 1;
        }
        let mut i = 0;
        while i < self.lights.len() {
            let light = &self.lights[i];
            uses |= match light.source {
                Source::Point { .. } => 0,
                Source::Directional { .. } => DIRECTIONAL_LIGHTS,
                Source::Spot { .. } => SPOTS,
            };
            uses |= match light.falloff {
                Falloff::InverseSquare => INVERSE_SQUARE,
                Falloff::None => NO_FALLOFF,
            };
            uses |= bit(light.colored, COLORED_LIGHTS);
            i += 1;
        }
        uses
    }
}

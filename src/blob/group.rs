//! Groups, what stands where of them, and solids, as a blob holds them. A group's shapes lie among
//! those of the scene, in front of them, list by list, its tree's words likewise; what says how many
//! they are is read here. Solids and their operands are made anew on the chip.

use bytemuck::try_pod_read_unaligned;

use super::spec::{Reader, Writer};
use super::stored::Stored;
use crate::gather::VirtualLightsSpec;
use crate::math::{Arithmetic, for_each_arithmetic};
use crate::octree::Cube;
use crate::scene::{Shapes, Transform};
use crate::shape::{Cone, Cuboid, Cylinder, Operand, Plane, Region, Solid, Sphere};

/// What a group is made of, borrowed.
#[derive(Clone, Copy, Debug)]
pub struct GroupContent<'c, A: Arithmetic> {
    /// The shapes, without the tree.
    pub shapes: Shapes<'c, A>,
    /// The tree's words, its cube and the step of its grid, if there is a tree.
    pub tree: Option<(&'c [u32], Cube, i8)>,
}

/// Where a group stands: what an [`Instance`](crate::scene::Instance) is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstanceSpec {
    /// The index of its group.
    pub group: u16,
    /// How the group stands in the scene.
    pub transform: Transform,
    /// The material that all its shapes have, if it isn't their own.
    pub material: Option<u16>,
}

/// How many of what a group has, and where its tree lies.
pub(super) struct GroupHead {
    /// Shapes by kind, edges among them, as the header counts them, without planes.
    pub(super) shapes: [u32; Self::LISTS],
    pub(super) uvs: u32,
    pub(super) words: u32,
    pub(super) solids: u32,
    pub(super) tree: Option<(Cube, i8)>,
}

impl GroupHead {
    pub(super) const LISTS: usize = 9;

    pub(super) fn of<A: Arithmetic>(group: &GroupContent<'_, A>) -> Self {
        let s = &group.shapes;
        let shapes = [
            s.spheres.len(),
            s.triangles.len(),
            s.smooth_triangles.len(),
            s.polygons.len(),
            s.edges.len(),
            s.cuboids.len(),
            s.discs.len(),
            s.cylinders.len(),
            s.cones.len(),
        ];
        Self {
            shapes: shapes.map(|n| n as u32),
            uvs: s.uvs.len() as u32,
            words: group.tree.map_or(0, |(words, ..)| words.len() as u32),
            solids: s.solids.len() as u32,
            tree: group.tree.map(|(_, cube, step)| (cube, step)),
        }
    }

    pub(super) fn write(&self, to: &mut Writer<'_>) {
        self.shapes.iter().for_each(|&n| to.long(n));
        [self.uvs, self.words, self.solids].into_iter().for_each(|n| to.long(n));
        to.byte(self.tree.is_some().into());
        if let Some((cube, step)) = self.tree {
            to.byte(cube.log2_side);
            to.byte(step as u8);
            cube.origin.iter().for_each(|&x| to.long(x as u32));
        }
    }

    pub(super) fn read(from: &mut Reader<'_>) -> Option<Self> {
        let mut shapes = [0; Self::LISTS];
        for count in &mut shapes {
            *count = from.long()?;
        }
        let (uvs, words, solids) = (from.long()?, from.long()?, from.long()?);
        let tree = if from.switch()? {
            let (log2_side, step) = (from.byte()?, from.byte()? as i8);
            let mut at = || from.long().map(|x| x as i32);
            Some((Cube { origin: [at()?, at()?, at()?], log2_side }, step))
        } else {
            None
        };
        Some(Self { shapes, uvs, words, solids, tree })
    }
}

pub(super) fn write_instance(spec: &InstanceSpec, to: &mut Writer<'_>) {
    let InstanceSpec { group, transform, material } = spec;
    to.whole(*group);
    transform.rotation.iter().for_each(|row| to.numbers(row));
    to.number(transform.scale);
    to.numbers(&transform.position);
    to.maybe(*material);
}

pub(super) fn read_instance(from: &mut Reader<'_>) -> Option<InstanceSpec> {
    let group = from.whole()?;
    let rotation = [from.numbers()?, from.numbers()?, from.numbers()?];
    let transform = Transform { rotation, scale: from.number()?, position: from.numbers()? };
    Some(InstanceSpec { group, transform, material: from.maybe()? })
}

pub(super) fn write_virtual_lights(spec: &VirtualLightsSpec, to: &mut Writer<'_>) {
    let VirtualLightsSpec { bounces, tile, nearest, center, radius } = spec;
    to.byte(*bounces);
    to.byte(*tile);
    to.number(*nearest);
    to.numbers(center);
    to.number(*radius);
}

pub(super) fn read_virtual_lights(from: &mut Reader<'_>) -> Option<VirtualLightsSpec> {
    Some(VirtualLightsSpec {
        bounces: from.byte()?,
        tile: from.byte()?,
        nearest: from.number()?,
        center: from.numbers()?,
        radius: from.number()?,
    })
}

/// The operands of a list's solids, in the solids' order: solids that share some have them each.
pub(super) fn operands<'s, A: Arithmetic>(
    shapes: &'s Shapes<'_, A>,
) -> impl Iterator<Item = &'s [Operand<A>]> {
    shapes.solids.iter().map(|solid| operands_of(solid, shapes.operands))
}

fn operands_of<'s, A: Arithmetic>(solid: &Solid<A>, all: &'s [Operand<A>]) -> &'s [Operand<A>] {
    let rest = all.get(solid.first_operand() as usize..).unwrap_or(&[]);
    rest.get(..solid.operand_count().into()).unwrap_or(&[])
}

pub(super) fn write_solids<A: Arithmetic>(shapes: &Shapes<'_, A>, to: &mut Writer<'_>) {
    for (solid, operands) in shapes.solids.iter().zip(operands(shapes)) {
        solid.region().words().iter().for_each(|&word| to.long(word));
        to.byte(operands.len() as u8);
        for operand in operands {
            match operand {
                Operand::Sphere(shape) => write_shape(0, shape, to),
                Operand::Cuboid(shape) => write_shape(1, shape, to),
                Operand::Cylinder(shape) => write_shape(2, shape, to),
                Operand::Cone(shape) => write_shape(3, shape, to),
                Operand::HalfSpace(shape) => write_shape(4, shape, to),
            }
        }
    }
}

fn write_shape<T: Stored>(kind: u8, shape: &T, to: &mut Writer<'_>) {
    to.byte(kind);
    super::content::with_bytes(shape, |bytes| (to.0)(bytes));
}

fn read_shape<T: Stored>(from: &mut Reader<'_>) -> Option<T> {
    let (bytes, rest) = from.0.split_at_checked(size_of::<T>())?;
    from.0 = rest;
    try_pod_read_unaligned::<T>(bytes).ok().filter(T::is_sound)
}

fn read_operand<A: Arithmetic>(from: &mut Reader<'_>) -> Option<Operand<A>> {
    Some(match from.byte()? {
        0 => Operand::Sphere(read_shape::<Sphere<A>>(from)?),
        1 => Operand::Cuboid(read_shape::<Cuboid<A>>(from)?),
        2 => Operand::Cylinder(read_shape::<Cylinder<A>>(from)?),
        3 => Operand::Cone(read_shape::<Cone<A>>(from)?),
        4 => Operand::HalfSpace(read_shape::<Plane<A>>(from)?),
        _ => return None,
    })
}

/// A solid's operands, up to as many as a solid may have, and how many they are.
type Operands<A> = ([Operand<A>; Region::OPERANDS], u8);

for_each_arithmetic! {
    impl Solid<A> {
        /// The next solid, its operands counted from `first` on.
        pub(super) fn read(from: &mut Reader<'_>, first: u32) -> Option<(Self, Operands<A>)> {
            let mut words = [0; 8];
            for word in &mut words {
                *word = from.long()?;
            }
            let count = from.byte()?;
            let mut operands = [Operand::<A>::NONE; Region::OPERANDS];
            for place in operands.get_mut(..count.into())? {
                *place = read_operand::<A>(from)?;
            }
            let region = Region::of_words(words);
            // What it takes of the operands is where they lie, not their number.
            let solid = Self::try_new(region, &operands, 0, count).ok()?;
            Some((solid.starting_at(first), (operands, count)))
        }
    }
}

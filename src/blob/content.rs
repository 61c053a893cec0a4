//! What goes into a blob, and writing it.

use super::group::{self, GroupHead};
use super::header::{self, Header};
use super::spec::{Spec, Writer};
use super::{AbsorptionSpec, Counts, GroupContent, InstanceSpec, SettingSpec, Stored, detail};
use crate::gather::{Record, VirtualLight, VirtualLightsSpec};
use crate::math::Arithmetic;
use crate::octree::Cube;
use crate::scene::{Area, AreaLightSpec, Image, LightSpec, MaterialSpec, Shapes, TextureSpec};
use crate::shape::Plane;

/// What a blob is made of, borrowed.
#[derive(Clone, Copy, Debug)]
pub struct Content<'c, A: Arithmetic> {
    /// The shapes, without the tree and those of groups.
    pub shapes: Shapes<'c, A>,
    /// The groups.
    pub groups: &'c [GroupContent<'c, A>],
    /// What stands where of them.
    pub instances: &'c [InstanceSpec],
    /// The planes.
    pub planes: &'c [Plane<A>],
    /// The tree's words, its cube and the step of its grid, if there is a tree.
    pub tree: Option<(&'c [u32], Cube, i8)>,
    /// What the materials are made from.
    pub materials: &'c [MaterialSpec],
    /// What the lights are made from.
    pub lights: &'c [LightSpec],
    /// What the media are made from.
    pub absorptions: &'c [AbsorptionSpec],
    /// What the textures are made from. The pictures of those that have the same are written once.
    pub textures: &'c [TextureSpec<'c>],
    /// What the lights with an area are made from. Fans follow each other in their order.
    pub area_lights: &'c [AreaLightSpec<'c>],
    /// Irradiance records, and the limit of the error that they were gathered with.
    pub cache: Option<(&'c [Record<A>], f64)>,
    /// Virtual lights, and how they are used; a scene has these or records.
    pub virtual_lights: Option<(&'c [VirtualLight<A>], VirtualLightsSpec)>,
    /// Rules, camera and surroundings.
    pub setting: SettingSpec,
    /// What the scene uses: [`Parts::uses`](crate::scene::Parts::uses).
    pub uses: u64,
}

/// Calls `$one` for each list of shapes but planes, in the order of the layout, with `$of` what
/// gives that list of some shapes.
macro_rules! each_list {
    ($of:ident => $one:expr) => {
        each_list!(@ $of => $one; spheres triangles smooth_triangles polygons edges
            cuboids discs cylinders cones)
    };
    (@ $of:ident => $one:expr; $($kind:ident)*) => {
        $({
            let $of = |shapes: &Shapes<'c, A>| shapes.$kind;
            $one
        })*
    };
}

impl<'c, A: Arithmetic> Content<'c, A> {
    /// The shapes of groups, then those of the scene itself.
    fn all(&self) -> impl Iterator<Item = &Shapes<'c, A>> {
        self.groups.iter().map(|group| &group.shapes).chain([&self.shapes])
    }

    /// How many of what the blob will hold.
    pub fn counts(&self) -> Counts {
        let mut specs = 0;
        self.write_specs(&mut Writer(&mut |bytes| specs += bytes.len()));
        let mut counts = [0; header::LISTS];
        let mut places = counts.iter_mut();
        each_list!(of => {
            if let Some(count) = places.next() {
                *count = self.all().map(|shapes| of(shapes).len() as u32).sum();
            }
        });
        if let Some(count) = places.next() {
            *count = self.planes.len() as u32;
        }
        let operands = self.all().flat_map(group::operands);
        Counts {
            shapes: counts,
            words: self.trees().map(|words| words.len() as u32).sum(),
            materials: self.materials.len() as u16,
            lights: self.lights.len() as u16,
            specs: specs as u32,
            uvs: self.all().map(|shapes| shapes.uvs.len() as u32).sum(),
            records: self.records().len() as u32,
            corners: self.polygons().map(|corners| corners.len() as u32).sum(),
            pictures: self.pictures().map(|(_, image)| detail::bytes(&image) as u32).sum(),
            area_lights: self.area_lights.len() as u16,
            fans: self.polygons().map(|corners| corners.len().saturating_sub(1) as u16).sum(),
            textures: self.textures.len() as u16,
            absorptions: self.absorptions.len() as u16,
            virtual_lights: self.virtual_lights().len() as u32,
            solids: self.all().map(|shapes| shapes.solids.len() as u32).sum(),
            operands: operands.map(|operands| operands.len() as u32).sum(),
            groups: self.groups.len() as u16,
            instances: self.instances.len() as u16,
        }
    }

    /// The words of the trees of groups, then those of the scene's own.
    fn trees(&self) -> impl Iterator<Item = &'c [u32]> {
        let trees = self.groups.iter().map(|group| group.tree).chain([self.tree]);
        trees.map(|tree| tree.map_or(&[][..], |(words, ..)| words))
    }

    fn virtual_lights(&self) -> &[VirtualLight<A>] {
        self.virtual_lights.map_or(&[], |(lights, _)| lights)
    }

    fn records(&self) -> &[Record<A>] {
        self.cache.map_or(&[], |(records, _)| records)
    }

    /// The corners of each polygon that is a light.
    fn polygons(&self) -> impl Iterator<Item = &[[f64; 3]]> {
        self.area_lights.iter().filter_map(|light| match light.area {
            Area::Polygon { corners, .. } => Some(corners),
            _ => None,
        })
    }

    /// Each picture once, and the texture that shows it first.
    fn pictures(&self) -> impl Iterator<Item = (usize, Image<'_>)> {
        let textures = self.textures.iter().enumerate();
        textures
            .filter_map(|(i, texture)| Some((i, detail::picture(texture)?)))
            .filter(|(i, _)| detail::place(self.textures, *i).is_first)
    }

    /// Writes the blob, piece by piece; the checksum stands 0, for [`seal`](super::seal).
    pub fn write(&self, to: &mut dyn FnMut(&[u8])) {
        let (_, cube, step) = self.tree.unwrap_or((&[], header::NO_CUBE, 0));
        let counts = self.counts();
        let header = Header { counts, cube, step, has_tree: self.tree.is_some(), uses: self.uses };
        header.write::<A>(to);
        each_list!(of => write_lists(self.all().map(of), to));
        write_list(self.planes, to);
        write_lists(self.all().map(|shapes| shapes.uvs), to);
        write_list(self.records(), to);
        write_list(self.virtual_lights(), to);
        // Of three numbers of eight bytes: nothing is left to fill up.
        let corners = self.polygons().flatten().flatten();
        corners.for_each(|x| to(&x.to_le_bytes()));
        write_lists(self.trees(), to);
        for (_, image) in self.pictures() {
            detail::palette(&image).iter().for_each(|color| to(color));
            to(image.bytes());
        }
        pad(counts.pictures as usize, to);
        self.write_specs(&mut Writer(to));
        pad(counts.specs as usize, to);
    }

    fn write_specs(&self, to: &mut Writer<'_>) {
        self.setting.write(to);
        self.materials.iter().for_each(|material| material.write(to));
        self.lights.iter().for_each(|light| light.write(to));
        self.absorptions.iter().for_each(|media| detail::write_absorption(media, to));
        for (i, texture) in self.textures.iter().enumerate() {
            detail::write_texture(texture, detail::place(self.textures, i).at, to);
        }
        self.area_lights.iter().for_each(|light| detail::write_area_light(light, to));
        to.byte(self.cache.is_some().into());
        if let Some((_, error)) = self.cache {
            to.number(error);
        }
        to.byte(self.virtual_lights.is_some().into());
        if let Some((_, settings)) = self.virtual_lights {
            group::write_virtual_lights(&settings, to);
        }
        for one in self.groups {
            GroupHead::of(one).write(to);
            group::write_solids(&one.shapes, to);
        }
        group::write_solids(&self.shapes, to);
        self.instances.iter().for_each(|instance| group::write_instance(instance, to));
    }
}

fn write_list<T: Stored>(list: &[T], to: &mut dyn FnMut(&[u8])) {
    write_lists([list].into_iter(), to);
}

/// Writes lists as one.
fn write_lists<'l, T: Stored>(lists: impl Iterator<Item = &'l [T]>, to: &mut dyn FnMut(&[u8])) {
    let mut count = 0usize;
    for value in lists.flatten() {
        with_bytes(value, &mut *to);
        count = count.wrapping_add(1);
    }
    pad(size_of::<T>().wrapping_mul(count), to);
}

/// A value's bytes as they lie in memory.
pub(super) fn with_bytes<T: Stored>(value: &T, then: impl FnOnce(&[u8])) {
    const LARGEST: usize = 256;
    let mut bytes = [0; LARGEST];
    if let Some(part) = bytes.get_mut(..size_of::<T>()) {
        value.store(part);
        then(part);
    }
}

/// Zeros up to the next multiple of the alignment.
fn pad(bytes: usize, to: &mut dyn FnMut(&[u8])) {
    (bytes..header::up(bytes)).for_each(|_| to(&[0]));
}

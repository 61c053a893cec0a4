//! A scene in one piece of flash, read where it lies.
//!
//! `whitted bake SCENE -o scene.bin` writes it; [`Blob::open`] checks it, all of it and once, and
//! [`Blob::scene`] gives the [`Scene`]. Shapes, the tree, irradiance records and pictures stay in
//! flash. Materials and lights are few; they are made in memory of the caller's. What also has
//! area lights, textures, media, solids or groups is made by [`Blob::scene_in`] a [`Room`].
//!
//! ```
//! use whitted::blob::{Blob, BlobError};
//! use whitted::math::Fixed;
//! use whitted::scene::{Light, Material, MaterialSpec, uses};
//!
//! fn picture(bytes: &[u8]) -> Result<(), BlobError> {
//!     let blob = Blob::<Fixed>::open(bytes)?;
//!     let mut materials = [Material::<Fixed>::new(MaterialSpec::BLACK); 8];
//!     let mut lights = [Light::<Fixed>::point([0.0; 3], [0.0; 3]); 4];
//!     let scene = blob.scene::<{ uses::ALL }>(&mut materials, &mut lights)?;
//!     let camera = blob.camera()?;
//!     // render
//!     Ok(())
//! }
//! # assert_eq!(picture(b"no blob"), Err(BlobError::Length { wanted: 144 }));
//! ```
//!
//! The layout, byte by byte, is in `docs/blob.md`. Hostile bytes give an error: every index, count
//! and value is checked, the checksum apart.

mod detail;
mod error;
mod group;
mod header;
mod room;
mod spec;
pub(crate) mod stored;

pub use detail::AbsorptionSpec;
pub use error::BlobError;
pub use group::{GroupContent, InstanceSpec};
pub use header::{Counts, VERSION};
pub use room::Room;
pub use spec::{BackgroundSpec, CameraSpec, SelectionSpec, SettingSpec};
pub use stored::Stored;
pub(crate) use stored::{put, stored, stored_numbers, within};

use bytemuck::AnyBitPattern;
use group::GroupHead;
use header::Header;
use spec::{Reader, Spec, Writer};
use uses::has;

use crate::gather::{
    Indirect, IrradianceCache, Record, VirtualLight, VirtualLights, VirtualLightsSettings,
    VirtualLightsSpec,
};
use crate::math::{Arithmetic, for_each_arithmetic};
use crate::octree::{Cube, Octree};
use crate::scene::{
    Absorption, Ambient, Area, AreaLight, AreaLightSpec, Background, Camera, FanCorner, Group,
    Image, Instance, Light, LightSpec, Material, MaterialSpec, Parts, Rules, Scene, SceneError,
    Selection, Shapes, Texture, TextureSpec, TriangleUv, uses,
};
use crate::shape::{
    Cone, Cuboid, Cylinder, Disc, Operand, Plane, Polygon, PolygonEdge, SmoothTriangle, Solid,
    Sphere, Triangle,
};

/// A blob's bytes start at a multiple of this ([`include_blob!`](crate::include_blob) sees to it).
pub const ALIGNMENT: usize = 8;

/// The bytes of a file as a static slice that starts where a blob may: a `static`'s value.
#[macro_export]
macro_rules! include_blob {
    ($file:expr $(,)?) => {{
        #[repr(C, align(8))]
        struct Aligned<B: ?Sized>(B);
        static ALIGNED: &Aligned<[u8]> = &Aligned(*include_bytes!($file));
        &ALIGNED.0
    }};
}

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
    /// What the scene uses: [`Parts::uses`].
    pub uses: u64,
}

/// A blob that has been checked.
#[derive(Clone, Copy, Debug)]
pub struct Blob<'b, A: Arithmetic> {
    header: Header,
    /// Those of the scene itself, but for solids.
    shapes: Shapes<'b, A>,
    /// Those of groups in front of them.
    all: Shapes<'b, A>,
    words: &'b [u32],
    planes: &'b [Plane<A>],
    setting: SettingSpec,
    indirect: Indirect<'b, A>,
    /// The corners of the polygons that are lights.
    corners: &'b [[f64; 3]],
    /// The bytes of the textures' pictures.
    pictures: &'b [u8],
    /// Materials, lights, media, textures, area lights, groups, solids, as specifications.
    specs: &'b [u8],
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

    /// Writes the blob, piece by piece; the checksum stands 0, for [`seal`].
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
fn with_bytes<T: Stored>(value: &T, then: impl FnOnce(&[u8])) {
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

/// Puts the checksum into the bytes of a blob.
pub fn seal(bytes: &mut [u8]) {
    let sum = header::checksum(bytes);
    if let Some(place) = bytes.get_mut(header::CHECKSUM..header::CHECKSUM + 4) {
        place.iter_mut().zip(sum.to_le_bytes()).for_each(|(to, from)| *to = from);
    }
}

/// The next list of a blob, its values not looked at.
fn raw<'b, T: AnyBitPattern>(bytes: &mut &'b [u8], count: u32) -> Result<&'b [T], BlobError> {
    let size = (count as usize).checked_mul(size_of::<T>()).ok_or(BlobError::Parts)?;
    // Rounding up a size near the largest number gives less.
    let whole = header::up(size);
    if whole < size {
        return Err(BlobError::Parts);
    }
    let (part, rest) = bytes.split_at_checked(whole).ok_or(BlobError::Parts)?;
    let values = part.get(..size).ok_or(BlobError::Parts)?;
    *bytes = rest;
    bytemuck::try_cast_slice(values).map_err(|_| BlobError::Alignment)
}

/// The next list of a blob.
fn list<'b, T: Stored>(
    bytes: &mut &'b [u8],
    count: u32,
    index: &mut u32,
) -> Result<&'b [T], BlobError> {
    let values = raw::<T>(bytes, count)?;
    match values.iter().position(|value| !value.is_sound()) {
        Some(at) => return Err(BlobError::Shape { index: index.wrapping_add(at as u32) }),
        None => *index = index.wrapping_add(count),
    }
    Ok(values)
}

/// The first of a list, which are then not in it any more.
fn first<'b, T>(list: &mut &'b [T], count: u32) -> Result<&'b [T], BlobError> {
    let (own, rest) = list.split_at_checked(count as usize).ok_or(BlobError::Parts)?;
    *list = rest;
    Ok(own)
}

/// The same of memory to be filled.
fn first_mut<'r, T>(list: &mut &'r mut [T], count: u32) -> Result<&'r mut [T], BlobError> {
    let all = core::mem::take(list);
    let (own, rest) = all.split_at_mut_checked(count as usize).ok_or(BlobError::Parts)?;
    *list = rest;
    Ok(own)
}

/// A group's shapes and its tree's words, the first of those that are left.
fn grouped<'b, A: Arithmetic>(
    head: &GroupHead,
    left: &mut Shapes<'b, A>,
    words: &mut &'b [u32],
) -> Result<(Shapes<'b, A>, &'b [u32]), BlobError> {
    let [a, b, c, d, e, f, g, h, i] = head.shapes;
    let shapes = Shapes {
        spheres: first(&mut left.spheres, a)?,
        triangles: first(&mut left.triangles, b)?,
        smooth_triangles: first(&mut left.smooth_triangles, c)?,
        polygons: first(&mut left.polygons, d)?,
        edges: first(&mut left.edges, e)?,
        cuboids: first(&mut left.cuboids, f)?,
        discs: first(&mut left.discs, g)?,
        cylinders: first(&mut left.cylinders, h)?,
        cones: first(&mut left.cones, i)?,
        uvs: first(&mut left.uvs, head.uvs)?,
        ..Shapes::EMPTY
    };
    Ok((shapes, first(words, head.words)?))
}

impl<'b, A: Arithmetic> Blob<'b, A> {
    /// How many of what there are.
    pub fn counts(&self) -> &Counts {
        &self.header.counts
    }

    /// What the scene uses, as a [`tailored`](Scene::tailored) scene's type says it.
    pub fn uses(&self) -> u64 {
        self.header.uses
    }

    /// The depth that the scene asks for.
    pub fn depth(&self) -> u8 {
        self.setting.depth
    }

    /// The rules, the camera and the surroundings.
    pub fn setting(&self) -> &SettingSpec {
        &self.setting
    }

    /// The specifications of the scene's materials and lights, in their order.
    fn reader(&self) -> Reader<'b> {
        Reader(self.specs)
    }
}

for_each_arithmetic! {
    impl<'b> Blob<'b, A> {
        /// Checks the bytes of a blob: all but how materials, lights and shapes name each other,
        /// which [`scene`](Self::scene) does. Bytes behind the blob's end are not looked at.
        ///
        /// # Errors
        /// What is wrong with them, the first thing found.
        pub fn open(bytes: &'b [u8]) -> Result<Self, BlobError> {
            let (header, mut rest) = Header::read::<A>(bytes)?;
            let (from, index) = (&mut rest, &mut 0);
            let [a, b, c, d, e, f, g, h, i, j] = header.counts.shapes;
            let mut all = Shapes {
                spheres: list::<Sphere<A>>(from, a, index)?,
                triangles: list::<Triangle<A>>(from, b, index)?,
                smooth_triangles: list::<SmoothTriangle<A>>(from, c, index)?,
                polygons: list::<Polygon<A>>(from, d, index)?,
                edges: list::<PolygonEdge<A>>(from, e, index)?,
                cuboids: list::<Cuboid<A>>(from, f, index)?,
                discs: list::<Disc<A>>(from, g, index)?,
                cylinders: list::<Cylinder<A>>(from, h, index)?,
                cones: list::<Cone<A>>(from, i, index)?,
                ..Shapes::EMPTY
            };
            let planes = list::<Plane<A>>(from, j, index)?;
            let counts = header.counts;
            all.uvs = list::<TriangleUv>(from, counts.uvs, index)?;
            let records = list::<Record<A>>(from, counts.records, index)?;
            let virtual_lights = list::<VirtualLight<A>>(from, counts.virtual_lights, index)?;
            let corners = raw::<[f64; 3]>(from, counts.corners)?;
            let words = list::<u32>(from, header.counts.words, index)?;
            let pictures = raw::<u8>(from, counts.pictures)?;
            let specs = counts.specs as usize;
            if rest.len() != header::up(specs) {
                return Err(BlobError::Parts);
            }
            let mut reader = Reader(rest);
            let setting = SettingSpec::read(&mut reader).ok_or(BlobError::Unknown)?;
            let specs = reader.0;
            let indirect = Indirect::None;
            let shapes = Shapes::EMPTY;
            let mut blob = Self {
                header,
                shapes,
                all,
                words,
                planes,
                setting,
                indirect,
                corners,
                pictures,
                specs,
            };
            blob.surroundings()?;
            blob.selection()?;
            blob.camera()?;
            let mut reader = blob.reader();
            for _ in 0..header.counts.materials {
                Self::material(&mut reader)?;
            }
            for _ in 0..header.counts.lights {
                Self::light(&mut reader)?;
            }
            for _ in 0..counts.absorptions {
                Self::absorption(&mut reader)?;
            }
            for _ in 0..counts.textures {
                blob.texture(&mut reader)?;
            }
            let (mut left, mut fans) = (corners, 0);
            for _ in 0..counts.area_lights {
                let spec = detail::read_area_light(&mut reader, &mut left, &mut fans);
                Self::area_light(&spec.ok_or(BlobError::Unknown)?, &mut [].iter_mut())?;
            }
            if !left.is_empty() || fans != u32::from(counts.fans) {
                return Err(BlobError::Parts);
            }
            if reader.switch().ok_or(BlobError::Unknown)? {
                let error = reader.number().ok_or(BlobError::Unknown)?;
                let cache = IrradianceCache::<A>::try_new(records, error);
                blob.indirect = Indirect::Cache(cache.map_err(BlobError::Value)?);
            } else if !records.is_empty() {
                return Err(BlobError::Parts);
            }
            if reader.switch().ok_or(BlobError::Unknown)? {
                let spec = group::read_virtual_lights(&mut reader).ok_or(BlobError::Unknown)?;
                let settings = VirtualLightsSettings::<A>::try_new(&spec);
                let settings = settings.map_err(BlobError::Value)?;
                if !matches!(blob.indirect, Indirect::None) {
                    return Err(BlobError::Parts);
                }
                let lights = VirtualLights::new(virtual_lights, &settings);
                blob.indirect = Indirect::VirtualLights(lights);
            } else if !virtual_lights.is_empty() {
                return Err(BlobError::Parts);
            }
            let (mut left, mut words) = (all, words);
            let (mut solids, mut operands) = (0u32, 0u32);
            for _ in 0..counts.groups {
                let head = GroupHead::read(&mut reader).ok_or(BlobError::Unknown)?;
                let (group, words) = grouped(&head, &mut left, &mut words)?;
                Self::tree(head.tree, words, &group, head.solids)?;
                operands = operands.wrapping_add(Self::solids(&mut reader, head.solids)?);
                solids = solids.wrapping_add(head.solids);
            }
            // The scene's own are those that no group has.
            let own = counts.solids.checked_sub(solids).ok_or(BlobError::Parts)?;
            let tree = header.has_tree.then_some((header.cube, header.step));
            let tree = Self::tree(tree, words, &left, own)?;
            blob.shapes = Shapes { tree, ..left };
            operands = operands.wrapping_add(Self::solids(&mut reader, own)?);
            if operands != counts.operands {
                return Err(BlobError::Parts);
            }
            for _ in 0..counts.instances {
                let spec = group::read_instance(&mut reader).ok_or(BlobError::Unknown)?;
                if spec.group >= counts.groups {
                    return Err(BlobError::Parts);
                }
            }
            if reader.is_over() { Ok(blob) } else { Err(BlobError::Parts) }
        }

        /// The tree over the shapes and as many solids, which are not yet among them.
        fn tree(
            place: Option<(Cube, i8)>,
            words: &'b [u32],
            shapes: &Shapes<'b, A>,
            solids: u32,
        ) -> Result<Option<Octree<'b, A>>, BlobError> {
            let Some((cube, step)) = place else {
                return if words.is_empty() { Ok(None) } else { Err(BlobError::Parts) };
            };
            let bounded = shapes.bounded().checked_add(solids).ok_or(BlobError::Parts)?;
            let tree = Octree::<A>::try_new(words, bounded as usize, &cube, step);
            tree.map(Some).map_err(BlobError::Tree)
        }

        /// Reads over solids; how many operands they have.
        fn solids(reader: &mut Reader<'_>, count: u32) -> Result<u32, BlobError> {
            let mut operands = 0u32;
            for _ in 0..count {
                let (_, (_, n)) = Solid::<A>::read(reader, 0).ok_or(BlobError::Solid)?;
                operands = operands.wrapping_add(n.into());
            }
            Ok(operands)
        }

        /// The next solids, and their operands, from these memories' beginnings.
        #[allow(clippy::type_complexity)]
        fn solids_in<'s>(
            reader: &mut Reader<'_>,
            count: u32,
            solids: &mut &'s mut [Solid<A>],
            operands: &mut &'s mut [Operand<A>],
        ) -> Result<(&'s [Solid<A>], &'s [Operand<A>]), BlobError> {
            let own = first_mut(solids, count)?;
            let mut used = 0;
            for place in own.iter_mut() {
                let (solid, (its, n)) = Solid::<A>::read(reader, used).ok_or(BlobError::Solid)?;
                *place = solid;
                let places = operands.get_mut(used as usize..).unwrap_or(&mut []);
                places.iter_mut().zip(its).take(n.into()).for_each(|(to, from)| *to = from);
                used = used.wrapping_add(n.into());
            }
            Ok((own, first_mut(operands, used)?))
        }

        /// The scene, over materials and lights in memory of the caller's: as many as
        /// [`counts`](Self::counts) says, or more.
        ///
        /// # Errors
        /// Too little room, none for area lights, textures and media among it; parts that don't fit
        /// together.
        pub fn scene<'s, const USES: u64>(
            &self,
            materials: &'s mut [Material<A>],
            lights: &'s mut [Light<A>],
        ) -> Result<Scene<'s, A, USES>, BlobError>
        where
            'b: 's,
        {
            self.scene_in(Room { materials, lights, ..Room::default() })
        }

        /// The scene, over whatever of it isn't read in place in memory of the caller's: as much of
        /// each as [`counts`](Self::counts) says, or more.
        ///
        /// # Errors
        /// Too little room; parts that don't fit together.
        pub fn scene_in<'s, const USES: u64>(
            &self,
            room: Room<'s, 'b, A>,
        ) -> Result<Scene<'s, A, USES>, BlobError>
        where
            'b: 's,
        {
            let Room { materials, lights, area_lights, fans, textures, absorptions, .. } = room;
            let Room { mut solids, mut operands, groups, instances, .. } = room;
            let counts = &self.header.counts;
            let room = BlobError::Room { materials: counts.materials, lights: counts.lights };
            let materials = materials.get_mut(..counts.materials.into()).ok_or(room)?;
            let lights = lights.get_mut(..counts.lights.into()).ok_or(room)?;
            let mut reader = self.reader();
            for material in materials.iter_mut() {
                *material = Self::material(&mut reader)?;
            }
            for light in lights.iter_mut() {
                *light = Self::light(&mut reader)?;
            }
            let room = BlobError::RoomBesides {
                area_lights: counts.area_lights,
                fans: counts.fans,
                textures: counts.textures,
                absorptions: counts.absorptions,
            };
            let absorptions = absorptions.get_mut(..counts.absorptions.into()).ok_or(room)?;
            let textures = textures.get_mut(..counts.textures.into()).ok_or(room)?;
            let area_lights = area_lights.get_mut(..counts.area_lights.into()).ok_or(room)?;
            let light_corners = fans.get_mut(..counts.fans.into()).ok_or(room)?;
            for absorption in absorptions.iter_mut() {
                *absorption = Self::absorption(&mut reader)?;
            }
            for texture in textures.iter_mut() {
                *texture = self.texture(&mut reader)?;
            }
            let (mut left, mut first, mut fans) = (self.corners, 0, light_corners.iter_mut());
            for light in area_lights.iter_mut() {
                let spec = detail::read_area_light(&mut reader, &mut left, &mut first);
                *light = Self::area_light(&spec.ok_or(BlobError::Unknown)?, &mut fans)?;
            }
            let mut shapes = self.shapes;
            let mut placed: &'s [Instance<'s, A>] = &[];
            let room = BlobError::RoomForGroups {
                solids: counts.solids,
                operands: counts.operands,
                groups: counts.groups,
                instances: counts.instances,
            };
            if has(USES, uses::SOLIDS) || has(USES, uses::INSTANCES) {
                let groups = groups.get_mut(..counts.groups.into()).ok_or(room)?;
                let instances = instances.get_mut(..counts.instances.into()).ok_or(room)?;
                if counts.solids as usize > solids.len()
                    || counts.operands as usize > operands.len()
                {
                    return Err(room);
                }
                if reader.switch() == Some(true) {
                    reader.number();
                }
                if reader.switch() == Some(true) {
                    group::read_virtual_lights(&mut reader);
                }
                let (mut left, mut words, mut own) = (self.all, self.words, counts.solids);
                for place in groups.iter_mut() {
                    let head = GroupHead::read(&mut reader).ok_or(BlobError::Unknown)?;
                    let (shapes, words) = grouped(&head, &mut left, &mut words)?;
                    let tree = Self::tree(head.tree, words, &shapes, head.solids)?;
                    own = own.wrapping_sub(head.solids);
                    let (solids, operands) =
                        Self::solids_in(&mut reader, head.solids, &mut solids, &mut operands)?;
                    let shapes = Shapes { solids, operands, tree, ..shapes };
                    *place = Group::<A>::try_new(shapes).map_err(BlobError::Scene)?;
                }
                let groups: &'s [Group<'s, A>] = groups;
                let (solids, operands) =
                    Self::solids_in(&mut reader, own, &mut solids, &mut operands)?;
                shapes = Shapes { solids, operands, ..shapes };
                for place in instances.iter_mut() {
                    let spec = group::read_instance(&mut reader).ok_or(BlobError::Unknown)?;
                    let group = groups.get(usize::from(spec.group)).ok_or(BlobError::Parts)?;
                    let made = Instance::<A>::try_new(group, &spec.transform);
                    let made = made.map_err(BlobError::Value)?;
                    *place = match spec.material {
                        Some(material) => made.with_material(material),
                        None => made,
                    };
                }
                placed = instances;
            } else if counts.solids != 0 || counts.instances != 0 {
                let missing = uses::SOLIDS | uses::INSTANCES;
                return Err(BlobError::Scene(SceneError::Uses { missing }));
            }
            let (ambient, background, rules) = self.surroundings()?;
            let Shapes {
                spheres,
                triangles,
                smooth_triangles,
                polygons,
                edges,
                cuboids,
                discs,
                cylinders,
                cones,
                tree,
                uvs,
                solids,
                operands,
            } = shapes;
            Scene::<A, USES>::try_tailored(Parts {
                spheres,
                triangles,
                smooth_triangles,
                polygons,
                edges,
                cuboids,
                discs,
                cylinders,
                cones,
                tree,
                uvs,
                solids,
                operands,
                instances: placed,
                planes: self.planes,
                materials,
                lights,
                absorptions,
                textures,
                area_lights,
                light_corners,
                light_jitter: self.setting.light_jitter,
                selection: self.selection()?,
                indirect: self.indirect,
                ambient,
                background,
                rules,
            })
            .map_err(|error: SceneError| BlobError::Scene(error))
        }

        /// The camera.
        ///
        /// # Errors
        /// None that [`open`](Self::open) hasn't seen.
        pub fn camera(&self) -> Result<Camera<A>, BlobError> {
            let CameraSpec { eye, at, up, tangent } = self.setting.camera;
            Camera::<A>::try_look_at(eye, at, up, tangent).map_err(BlobError::Value)
        }

        #[allow(clippy::type_complexity)]
        fn surroundings(&self) -> Result<(Ambient<A>, Background<A>, Rules<A>), BlobError> {
            let setting = &self.setting;
            let background = match setting.background {
                BackgroundSpec::Uniform(color) => Background::<A>::try_uniform(color),
                BackgroundSpec::Gradient { up, bottom, top } => {
                    Background::<A>::try_gradient(up, bottom, top)
                }
            };
            let rules = Rules {
                specular_cosine: setting.specular_cosine,
                highlight_cosine: setting.highlight_cosine,
                transmitters_reflect: setting.transmitters_reflect,
                lossy: setting.lossy,
                ..Rules::<A>::try_with_cutoff(setting.cutoff).ok_or(BlobError::Unknown)?
            };
            Ok((
                Ambient::<A>::try_new(setting.ambient).map_err(BlobError::Value)?,
                background.map_err(BlobError::Value)?,
                rules,
            ))
        }

        fn selection(&self) -> Result<Selection<A>, BlobError> {
            match self.setting.selection {
                SelectionSpec::All => Ok(Selection::All),
                SelectionSpec::Choose(count) => Ok(Selection::Choose(count)),
                SelectionSpec::Above(radiance) => {
                    Selection::<A>::try_above(radiance).map_err(BlobError::Value)
                }
            }
        }

        fn absorption(from: &mut Reader<'_>) -> Result<Absorption<A>, BlobError> {
            let [front, behind] = detail::read_absorption(from).ok_or(BlobError::Unknown)?;
            Absorption::<A>::try_new(front, behind).map_err(BlobError::Value)
        }

        fn texture(&self, from: &mut Reader<'_>) -> Result<Texture<'b, A>, BlobError> {
            let spec = detail::read_texture(from, self.pictures).ok_or(BlobError::Unknown)?;
            Texture::<A>::try_new(&spec).map_err(BlobError::Value)
        }

        /// A light, and its fan if it is a polygon; where there are no more places for the fan, its
        /// corners are checked alone.
        fn area_light(
            spec: &AreaLightSpec<'_>,
            fans: &mut core::slice::IterMut<'_, FanCorner<A>>,
        ) -> Result<AreaLight<A>, BlobError> {
            let light = AreaLight::<A>::try_new(spec).map_err(BlobError::Value)?;
            if let Area::Polygon { corners, .. } = spec.area {
                for i in 1..corners.len() {
                    let corner = AreaLight::<A>::try_fan(corners, i.wrapping_sub(1));
                    let corner = corner.map_err(BlobError::Value)?;
                    if let Some(place) = fans.next() {
                        *place = corner;
                    }
                }
            }
            Ok(light)
        }

        fn material(from: &mut Reader<'_>) -> Result<Material<A>, BlobError> {
            let spec = MaterialSpec::read(from).ok_or(BlobError::Unknown)?;
            Material::<A>::try_new(&spec).map_err(BlobError::Value)
        }

        fn light(from: &mut Reader<'_>) -> Result<Light<A>, BlobError> {
            let spec = LightSpec::read(from).ok_or(BlobError::Unknown)?;
            Light::<A>::try_new(&spec).map_err(BlobError::Value)
        }
    }
}

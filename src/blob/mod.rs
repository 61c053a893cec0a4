//! A scene in one piece of flash, read where it lies.
//!
//! `whitted bake SCENE -o scene.bin` writes it; [`Blob::open`] checks it, all of it and once, and
//! [`Blob::scene`] gives the [`Scene`]. Shapes, the tree, irradiance records and pictures stay in
//! flash. Materials and lights are few; they are made in memory of the caller's. What also has
//! area lights, textures or media is made by [`Blob::scene_in`] a [`Room`].
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
//! # assert_eq!(picture(b"no blob"), Err(BlobError::Length { wanted: 128 }));
//! ```
//!
//! The layout, byte by byte, is in `docs/blob.md`. Hostile bytes give an error: every index, count
//! and value is checked, the checksum apart.

mod detail;
mod error;
mod header;
mod room;
mod spec;
pub(crate) mod stored;

pub use detail::AbsorptionSpec;
pub use error::BlobError;
pub use header::{Counts, VERSION};
pub use room::Room;
pub use spec::{BackgroundSpec, CameraSpec, SelectionSpec, SettingSpec};
pub use stored::Stored;
pub(crate) use stored::{put, stored, stored_numbers, within};

use bytemuck::AnyBitPattern;
use header::Header;
use spec::{Reader, Spec, Writer};

use crate::gather::{Indirect, IrradianceCache, Record};
use crate::math::{Arithmetic, for_each_arithmetic};
use crate::octree::{Cube, Octree};
use crate::scene::{
    Absorption, Ambient, Area, AreaLight, AreaLightSpec, Background, Camera, FanCorner, Image,
    Light, LightSpec, Material, MaterialSpec, Parts, Rules, Scene, SceneError, Selection, Shapes,
    Texture, TextureSpec, TriangleUv,
};
use crate::shape::{
    Cone, Cuboid, Cylinder, Disc, Plane, Polygon, PolygonEdge, SmoothTriangle, Sphere, Triangle,
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
    /// The shapes, without the tree.
    pub shapes: Shapes<'c, A>,
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
    /// Rules, camera and surroundings.
    pub setting: SettingSpec,
    /// What the scene uses: [`Parts::uses`].
    pub uses: u64,
}

/// A blob that has been checked.
#[derive(Clone, Copy, Debug)]
pub struct Blob<'b, A: Arithmetic> {
    header: Header,
    shapes: Shapes<'b, A>,
    planes: &'b [Plane<A>],
    setting: SettingSpec,
    cache: Option<IrradianceCache<'b, A>>,
    /// The corners of the polygons that are lights.
    corners: &'b [[f64; 3]],
    /// The bytes of the textures' pictures.
    pictures: &'b [u8],
    /// Materials, lights, media, textures and area lights, as specifications.
    specs: &'b [u8],
}

/// Calls `$one` for each list of shapes, in the order of the layout.
macro_rules! each_list {
    ($from:expr, $planes:expr, $list:ident => $one:expr) => {{
        each_list!(@ $from, $list => $one; spheres triangles smooth_triangles polygons edges
            cuboids discs cylinders cones);
        {
            let $list = $planes;
            $one
        }
    }};
    (@ $from:expr, $list:ident => $one:expr; $($kind:ident)*) => {
        $({
            let $list = $from.$kind;
            $one
        })*
    };
}

impl<A: Arithmetic> Content<'_, A> {
    /// How many of what the blob will hold.
    pub fn counts(&self) -> Counts {
        let mut specs = 0;
        self.write_specs(&mut Writer(&mut |bytes| specs += bytes.len()));
        let mut counts = [0; header::LISTS];
        let mut places = counts.iter_mut();
        each_list!(self.shapes, self.planes, list => {
            if let Some(count) = places.next() {
                *count = list.len() as u32;
            }
        });
        Counts {
            shapes: counts,
            words: self.tree.map_or(0, |(words, ..)| words.len() as u32),
            materials: self.materials.len() as u16,
            lights: self.lights.len() as u16,
            specs: specs as u32,
            uvs: self.shapes.uvs.len() as u32,
            records: self.records().len() as u32,
            corners: self.polygons().map(|corners| corners.len() as u32).sum(),
            pictures: self.pictures().map(|(_, image)| detail::bytes(&image) as u32).sum(),
            area_lights: self.area_lights.len() as u16,
            fans: self.polygons().map(|corners| corners.len().saturating_sub(1) as u16).sum(),
            textures: self.textures.len() as u16,
            absorptions: self.absorptions.len() as u16,
        }
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
        let (words, cube, step) = self.tree.unwrap_or((&[], header::NO_CUBE, 0));
        let counts = self.counts();
        let header = Header { counts, cube, step, has_tree: self.tree.is_some(), uses: self.uses };
        header.write::<A>(to);
        each_list!(self.shapes, self.planes, list => write_list(list, to));
        write_list(self.shapes.uvs, to);
        write_list(self.records(), to);
        // Of three numbers of eight bytes: nothing is left to fill up.
        let corners = self.polygons().flatten().flatten();
        corners.for_each(|x| to(&x.to_le_bytes()));
        write_list(words, to);
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
    }
}

fn write_list<T: Stored>(list: &[T], to: &mut dyn FnMut(&[u8])) {
    const LARGEST: usize = 256;
    let size = size_of::<T>();
    for value in list {
        let mut bytes = [0; LARGEST];
        if let Some(part) = bytes.get_mut(..size) {
            value.store(part);
            to(part);
        }
    }
    pad(size.wrapping_mul(list.len()), to);
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
            let mut shapes = Shapes {
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
            shapes.uvs = list::<TriangleUv>(from, counts.uvs, index)?;
            let records = list::<Record<A>>(from, counts.records, index)?;
            let corners = raw::<[f64; 3]>(from, counts.corners)?;
            let words = list::<u32>(from, header.counts.words, index)?;
            if header.has_tree {
                let bounded = shapes.bounded() as usize;
                let tree = Octree::<A>::try_new(words, bounded, &header.cube, header.step);
                shapes.tree = Some(tree.map_err(BlobError::Tree)?);
            } else if !words.is_empty() {
                return Err(BlobError::Parts);
            }
            let pictures = raw::<u8>(from, counts.pictures)?;
            let specs = counts.specs as usize;
            if rest.len() != header::up(specs) {
                return Err(BlobError::Parts);
            }
            let mut reader = Reader(rest);
            let setting = SettingSpec::read(&mut reader).ok_or(BlobError::Unknown)?;
            let specs = reader.0;
            let cache = None;
            let mut blob =
                Self { header, shapes, planes, setting, cache, corners, pictures, specs };
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
                blob.cache = Some(cache.map_err(BlobError::Value)?);
            } else if !records.is_empty() {
                return Err(BlobError::Parts);
            }
            if reader.is_over() { Ok(blob) } else { Err(BlobError::Parts) }
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
            let Room { materials, lights, area_lights, fans, textures, absorptions } = room;
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
                ..
            } = self.shapes;
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
                planes: self.planes,
                materials,
                lights,
                absorptions,
                textures,
                area_lights,
                light_corners,
                light_jitter: self.setting.light_jitter,
                selection: self.selection()?,
                indirect: self.cache.map_or(Indirect::None, Indirect::Cache),
                ambient,
                background,
                rules,
                ..Parts::EMPTY
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

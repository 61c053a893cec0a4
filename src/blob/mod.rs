//! A scene in one piece of flash, read where it lies.
//!
//! `whitted bake SCENE -o scene.bin` writes it; [`Blob::open`] checks it, all of it and once, and
//! [`Blob::scene`] gives the [`Scene`]. Shapes and the tree stay in flash. Materials and lights
//! are few; they are made in memory of the caller's.
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
//! # assert_eq!(picture(b"no blob"), Err(BlobError::Length { wanted: 104 }));
//! ```
//!
//! The layout, byte by byte, is in `docs/blob.md`. Hostile bytes give an error: every index, count
//! and value is checked, the checksum apart.

mod error;
mod header;
mod spec;
pub(crate) mod stored;

pub use error::BlobError;
pub use header::{Counts, VERSION};
pub use spec::{BackgroundSpec, CameraSpec, SettingSpec};
pub use stored::Stored;
pub(crate) use stored::{stored, stored_numbers, within};

use header::Header;
use spec::{Reader, Spec, Writer};

use crate::math::{Arithmetic, for_each_arithmetic};
use crate::octree::{Cube, Octree};
use crate::scene::{
    Ambient, Background, Camera, Light, LightSpec, Material, MaterialSpec, Parts, Rules, Scene,
    SceneError, Shapes,
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
    /// Materials, then lights, as specifications.
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
        }
    }

    /// Writes the blob, piece by piece; the checksum stands 0, for [`seal`].
    pub fn write(&self, to: &mut dyn FnMut(&[u8])) {
        let (words, cube, step) = self.tree.unwrap_or((&[], header::NO_CUBE, 0));
        let counts = self.counts();
        let header = Header { counts, cube, step, has_tree: self.tree.is_some(), uses: self.uses };
        header.write::<A>(to);
        each_list!(self.shapes, self.planes, list => write_list(list, to));
        write_list(words, to);
        self.write_specs(&mut Writer(to));
        pad(counts.specs as usize, to);
    }

    fn write_specs(&self, to: &mut Writer<'_>) {
        self.setting.write(to);
        self.materials.iter().for_each(|material| material.write(to));
        self.lights.iter().for_each(|light| light.write(to));
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

/// The next list of a blob.
fn list<'b, T: Stored>(
    bytes: &mut &'b [u8],
    count: u32,
    index: &mut u32,
) -> Result<&'b [T], BlobError> {
    let size = (count as usize).checked_mul(size_of::<T>()).ok_or(BlobError::Parts)?;
    // Rounding up a size near the largest number gives less.
    let whole = header::up(size);
    if whole < size {
        return Err(BlobError::Parts);
    }
    let (part, rest) = bytes.split_at_checked(whole).ok_or(BlobError::Parts)?;
    let values = part.get(..size).ok_or(BlobError::Parts)?;
    let values: &[T] = bytemuck::try_cast_slice(values).map_err(|_| BlobError::Alignment)?;
    match values.iter().position(|value| !value.is_sound()) {
        Some(at) => return Err(BlobError::Shape { index: index.wrapping_add(at as u32) }),
        None => *index = index.wrapping_add(count),
    }
    *bytes = rest;
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
            let words = list::<u32>(from, header.counts.words, index)?;
            if header.has_tree {
                let bounded = shapes.bounded() as usize;
                let tree = Octree::<A>::try_new(words, bounded, &header.cube, header.step);
                shapes.tree = Some(tree.map_err(BlobError::Tree)?);
            } else if !words.is_empty() {
                return Err(BlobError::Parts);
            }
            let specs = header.counts.specs as usize;
            if rest.len() != header::up(specs) {
                return Err(BlobError::Parts);
            }
            let mut reader = Reader(rest);
            let setting = SettingSpec::read(&mut reader).ok_or(BlobError::Unknown)?;
            let blob = Self { header, shapes, planes, setting, specs: reader.0 };
            blob.surroundings()?;
            blob.camera()?;
            let mut reader = blob.reader();
            for _ in 0..header.counts.materials {
                Self::material(&mut reader)?;
            }
            for _ in 0..header.counts.lights {
                Self::light(&mut reader)?;
            }
            if reader.is_over() { Ok(blob) } else { Err(BlobError::Parts) }
        }

        /// The scene, over materials and lights in memory of the caller's: as many as
        /// [`counts`](Self::counts) says, or more.
        ///
        /// # Errors
        /// Too little room; parts that don't fit together.
        pub fn scene<'s, const USES: u64>(
            &self,
            materials: &'s mut [Material<A>],
            lights: &'s mut [Light<A>],
        ) -> Result<Scene<'s, A, USES>, BlobError>
        where
            'b: 's,
        {
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
                planes: self.planes,
                materials,
                lights,
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

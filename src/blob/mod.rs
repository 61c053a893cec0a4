//! A scene in one piece of flash, read where it lies.
//!
//! `whitted bake SCENE -o scene.bin` writes it; [`Blob::open`] checks it, all of it and once, and
//! [`Blob::scene`] gives the [`Scene`](crate::scene::Scene). Shapes, the tree, irradiance records and pictures stay in
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

mod content;
mod detail;
mod error;
mod group;
mod header;
mod lists;
mod made;
mod open;
mod room;
mod scene;
mod spec;
pub(crate) mod stored;

pub use content::Content;
pub use detail::AbsorptionSpec;
pub use error::BlobError;
pub use group::{GroupContent, InstanceSpec};
pub use header::{Counts, VERSION};
pub use room::Room;
pub use spec::{BackgroundSpec, CameraSpec, SelectionSpec, SettingSpec};
pub use stored::Stored;
pub(crate) use stored::{put, stored, stored_numbers, within};

use crate::gather::Indirect;
use crate::math::Arithmetic;
use crate::scene::Shapes;
use crate::shape::Plane;
use header::Header;
use spec::Reader;

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

/// Puts the checksum into the bytes of a blob.
pub fn seal(bytes: &mut [u8]) {
    let sum = header::checksum(bytes);
    if let Some(place) = bytes.get_mut(header::CHECKSUM..header::CHECKSUM + 4) {
        place.iter_mut().zip(sum.to_le_bytes()).for_each(|(to, from)| *to = from);
    }
}

impl<'b, A: Arithmetic> Blob<'b, A> {
    /// How many of what there are.
    pub fn counts(&self) -> &Counts {
        &self.header.counts
    }

    /// What the scene uses, as a [`tailored`](crate::scene::Scene::tailored) scene's type says it.
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

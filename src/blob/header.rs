//! The first bytes of a blob.

use crc::{CRC_32_ISO_HDLC, Crc, NoTable};

use super::{ALIGNMENT, BlobError};
use crate::gather::{Record, VirtualLight};
use crate::math::Arithmetic;
use crate::octree::Cube;
use crate::scene::TriangleUv;
use crate::shape::{
    Cone, Cuboid, Cylinder, Disc, Plane, Polygon, PolygonEdge, SmoothTriangle, Sphere, Triangle,
};

/// The version of the layout that this library writes and reads.
pub const VERSION: u16 = 5;

/// Kinds of lists of shapes, edges and planes included.
pub(super) const LISTS: usize = 10;

const MAGIC: [u8; 8] = *b"whitted\x1a";
/// Where the checksum stands; what is behind it is summed.
pub(super) const CHECKSUM: usize = 16;
const SUMMED: usize = 20;
/// The bytes of the header.
const SIZE: usize = 144;

pub(super) const NO_CUBE: Cube = Cube { origin: [0; 3], log2_side: 0 };

/// How many of what a blob holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// Those of the scene and of its groups: spheres, triangles, smooth triangles, polygons, edges of polygons, boxes, discs, cylinders,
    /// cones, planes.
    pub shapes: [u32; 10],
    /// Words of the octrees.
    pub words: u32,
    /// Materials.
    pub materials: u16,
    /// Lights.
    pub lights: u16,
    /// Bytes of the setting, materials and lights, and of what they name but for pictures.
    pub specs: u32,
    /// Texture coordinates of triangles.
    pub uvs: u32,
    /// Irradiance records.
    pub records: u32,
    /// Corners of polygons that are lights.
    pub corners: u32,
    /// Bytes of pictures, with their palettes.
    pub pictures: u32,
    /// Lights with an area.
    pub area_lights: u16,
    /// Corners of their fans: one less for each polygon than it has corners.
    pub fans: u16,
    /// Textures.
    pub textures: u16,
    /// Media.
    pub absorptions: u16,
    /// Virtual lights.
    pub virtual_lights: u32,
    /// Solids, those of groups among them.
    pub solids: u32,
    /// Operands of solids.
    pub operands: u32,
    /// Groups.
    pub groups: u16,
    /// Instances of groups.
    pub instances: u16,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Header {
    pub(super) counts: Counts,
    pub(super) cube: Cube,
    pub(super) step: i8,
    pub(super) has_tree: bool,
    pub(super) uses: u64,
}

/// The next multiple of the alignment; less than `bytes` where that is beyond all numbers.
pub(super) const fn up(bytes: usize) -> usize {
    bytes.wrapping_add(ALIGNMENT - 1) & !(ALIGNMENT - 1)
}

/// The sizes of the elements of the lists of shapes.
const fn sizes<A: Arithmetic>() -> [usize; LISTS] {
    [
        size_of::<Sphere<A>>(),
        size_of::<Triangle<A>>(),
        size_of::<SmoothTriangle<A>>(),
        size_of::<Polygon<A>>(),
        size_of::<PolygonEdge<A>>(),
        size_of::<Cuboid<A>>(),
        size_of::<Disc<A>>(),
        size_of::<Cylinder<A>>(),
        size_of::<Cone<A>>(),
        size_of::<Plane<A>>(),
    ]
}

/// A number that changes with any of the sizes (FNV's hash).
const fn layout<A: Arithmetic>() -> u32 {
    let sizes = sizes::<A>();
    let mut hash = 0x811c_9dc5u32;
    let mut i = 0;
    while i < LISTS {
        hash = (hash ^ sizes[i] as u32).wrapping_mul(0x0100_0193);
        i += 1;
    }
    let hash = (hash ^ size_of::<TriangleUv>() as u32).wrapping_mul(0x0100_0193);
    let hash = (hash ^ size_of::<Record<A>>() as u32).wrapping_mul(0x0100_0193);
    (hash ^ size_of::<VirtualLight<A>>() as u32).wrapping_mul(0x0100_0193)
}

fn arithmetic<A: Arithmetic>() -> u16 {
    match A::NAME {
        "fixed" => 1,
        "f32" => 2,
        _ => 3,
    }
}

/// CRC-32 (ISO-HDLC, as in zip and PNG), without a table: a blob is summed once, flash is dear.
pub(super) fn checksum(bytes: &[u8]) -> u32 {
    const SUM: Crc<u32, NoTable> = Crc::<u32, NoTable>::new(&CRC_32_ISO_HDLC);
    SUM.checksum(bytes.get(SUMMED..).unwrap_or(&[]))
}

impl Header {
    /// The bytes of the whole blob.
    fn length<A: Arithmetic>(&self) -> usize {
        let lists = sizes::<A>().into_iter().zip(self.counts.shapes);
        let shapes = lists.map(|(size, count)| up(size.wrapping_mul(count as usize)));
        let shapes = shapes.fold(0, usize::wrapping_add);
        let list = |count: u32, size: usize| up(size.wrapping_mul(count as usize));
        let Counts { uvs, records, virtual_lights, corners, words, pictures, specs, .. } =
            self.counts;
        let rest = [
            list(uvs, size_of::<TriangleUv>()),
            list(records, size_of::<Record<A>>()),
            list(virtual_lights, size_of::<VirtualLight<A>>()),
            list(corners, size_of::<[f64; 3]>()),
            list(words, 4),
            list(pictures, 1),
            list(specs, 1),
        ];
        rest.into_iter().fold(SIZE.wrapping_add(shapes), usize::wrapping_add)
    }

    pub(super) fn write<A: Arithmetic>(&self, to: &mut dyn FnMut(&[u8])) {
        let Counts { shapes, words, materials, lights, specs, .. } = self.counts;
        let Counts { uvs, records, corners, pictures, .. } = self.counts;
        let Counts { area_lights, fans, textures, absorptions, .. } = self.counts;
        let Counts { virtual_lights, solids, operands, groups, instances, .. } = self.counts;
        to(&MAGIC);
        to(&VERSION.to_le_bytes());
        to(&arithmetic::<A>().to_le_bytes());
        to(&(self.length::<A>() as u32).to_le_bytes());
        to(&[0; 4]);
        to(&layout::<A>().to_le_bytes());
        to(&self.uses.to_le_bytes());
        to(&[u8::from(self.has_tree), self.cube.log2_side, self.step as u8, 0]);
        self.cube.origin.iter().for_each(|x| to(&x.to_le_bytes()));
        shapes.iter().for_each(|count| to(&count.to_le_bytes()));
        to(&words.to_le_bytes());
        to(&materials.to_le_bytes());
        to(&lights.to_le_bytes());
        [specs, uvs, records, corners, pictures].iter().for_each(|n| to(&n.to_le_bytes()));
        [area_lights, fans, textures, absorptions].iter().for_each(|n| to(&n.to_le_bytes()));
        [virtual_lights, solids, operands].iter().for_each(|n| to(&n.to_le_bytes()));
        [groups, instances].iter().for_each(|n| to(&n.to_le_bytes()));
        to(&[0; 4]);
    }

    /// The header, and the bytes behind it up to the blob's end.
    pub(super) fn read<A: Arithmetic>(bytes: &[u8]) -> Result<(Self, &[u8]), BlobError> {
        if cfg!(target_endian = "big") {
            return Err(BlobError::Endian);
        }
        let Some((head, _)) = bytes.split_first_chunk::<SIZE>() else {
            return Err(BlobError::Length { wanted: SIZE as u32 });
        };
        if !head.starts_with(&MAGIC) {
            return Err(BlobError::Magic);
        }
        let whole = |at: usize| Some(u32::from_le_bytes(*head.get(at..)?.first_chunk()?));
        let half = |at: usize| Some(u16::from_le_bytes(*head.get(at..)?.first_chunk()?));
        let byte = |at: usize| head.get(at).copied().unwrap_or(0);
        let (whole, half) = (|at| whole(at).unwrap_or(0), |at| half(at).unwrap_or(0));
        if half(8) != VERSION {
            return Err(BlobError::Version { found: half(8) });
        }
        if half(10) != arithmetic::<A>() {
            return Err(BlobError::Arithmetic { found: half(10) });
        }
        let wanted = whole(12);
        let all = bytes.get(..wanted as usize).ok_or(BlobError::Length { wanted })?;
        let body = all.get(SIZE..).ok_or(BlobError::Length { wanted: SIZE as u32 })?;
        if checksum(all) != whole(CHECKSUM) {
            return Err(BlobError::Checksum);
        }
        if whole(20) != layout::<A>() {
            return Err(BlobError::Layout);
        }
        if !bytes.as_ptr().addr().is_multiple_of(align_of::<A::Length>()) {
            return Err(BlobError::Alignment);
        }
        let mut shapes = [0; LISTS];
        shapes.iter_mut().enumerate().for_each(|(i, count)| *count = whole(48 + 4 * i));
        let has_tree = match byte(32) {
            0 => false,
            1 => true,
            _ => return Err(BlobError::Unknown),
        };
        if byte(35) != 0 || whole(140) != 0 {
            return Err(BlobError::Unknown);
        }
        let header = Self {
            counts: Counts {
                shapes,
                words: whole(88),
                materials: half(92),
                lights: half(94),
                specs: whole(96),
                uvs: whole(100),
                records: whole(104),
                corners: whole(108),
                pictures: whole(112),
                area_lights: half(116),
                fans: half(118),
                textures: half(120),
                absorptions: half(122),
                virtual_lights: whole(124),
                solids: whole(128),
                operands: whole(132),
                groups: half(136),
                instances: half(138),
            },
            cube: Cube {
                origin: [whole(36) as i32, whole(40) as i32, whole(44) as i32],
                log2_side: byte(33),
            },
            step: byte(34) as i8,
            has_tree,
            uses: u64::from(whole(24)) | u64::from(whole(28)) << 32,
        };
        Ok((header, body))
    }
}

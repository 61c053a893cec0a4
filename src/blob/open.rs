//! Checking a blob.

use super::group::{self, GroupHead};
use super::header::{self, Header};
use super::lists::{grouped, list, raw};
use super::spec::{Reader, Spec};
use super::{Blob, BlobError, SettingSpec, detail};
use crate::gather::{
    Indirect, IrradianceCache, Record, VirtualLight, VirtualLights, VirtualLightsSettings,
};
use crate::math::for_each_arithmetic;
use crate::octree::{Cube, Octree};
use crate::scene::{Shapes, TriangleUv};
use crate::shape::{
    Cone, Cuboid, Cylinder, Disc, Plane, Polygon, PolygonEdge, SmoothTriangle, Solid, Sphere,
    Triangle,
};

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
        pub(super) fn tree(
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
        pub(super) fn solids(reader: &mut Reader<'_>, count: u32) -> Result<u32, BlobError> {
            let mut operands = 0u32;
            for _ in 0..count {
                let (_, (_, n)) = Solid::<A>::read(reader, 0).ok_or(BlobError::Solid)?;
                operands = operands.wrapping_add(n.into());
            }
            Ok(operands)
        }
    }
}

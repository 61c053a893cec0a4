//! A scene as one piece of bytes, for flash.

use whitted::blob::{Content, Counts, GroupContent, InstanceSpec, seal};
use whitted::gather::{Record, VirtualLight};
use whitted::scene::{Area, AreaLight, TriangleUv, uses};

use super::{Baked, Construct, Glow, light, specs};
use crate::document::Size;
use crate::error::{Flaw, Problem};

/// A blob, and what is in it.
#[derive(Clone, Debug)]
pub struct Flash {
    /// The blob.
    pub bytes: Vec<u8>,
    /// How many of what it holds.
    pub counts: Counts,
}

impl<A: Construct> Baked<A> {
    /// The blob of the scene (see `docs/blob.md`), its camera for pictures of a size.
    ///
    /// # Errors
    /// More of something than a blob can number.
    pub fn blob(&self, size: Size) -> Result<Flash, Flaw> {
        let mut bits = self.with_scene(|scene| scene.parts().uses())?;
        let parts = self.shapes.parts()?;
        let refused = |what, error| super::refused::<A>(what, error, None);
        let materials = specs::materials(&self.placed).map_err(|e| refused("the material", e))?;
        let textures = specs::textures(&self.placed).map_err(|e| refused("the texture", e))?;
        let absorbing = self.placed.materials.iter().filter(|m| m.absorbs());
        let absorptions: Vec<_> = absorbing.map(|m| m.absorption).collect();
        let lights: Vec<_> = self.placed.lights.iter().filter_map(specs::light).collect();
        let bodies = self.lights.areas.iter().map(AreaLight::body);
        let area_lights = light::specs(&self.placed.lights, bodies);
        let fans = area_lights.iter().map(|light| match light.area {
            Area::Polygon { corners, .. } => corners.len(),
            _ => 0,
        });
        if u16::try_from(fans.sum::<usize>()).is_err() {
            let what = "the corners of the area lights".into();
            let why = "a blob holds 65535 of them".into();
            return Err(Problem::Unrepresentable { what, why }.anywhere());
        }
        // Groups that stand nowhere are left out: the others move up.
        let (mut groups, mut numbers) = (Vec::new(), Vec::new());
        for shapes in self.groups.all() {
            numbers.push(groups.len() as u16);
            if let Some(shapes) = shapes {
                let tree = shapes.words();
                groups.push(GroupContent { shapes: shapes.parts()?.shapes(), tree });
            }
        }
        let places = self.groups.places();
        let instances: Vec<_> = places
            .map(|(group, transform, material)| InstanceSpec {
                group: numbers.get(group).copied().unwrap_or(0),
                transform: *transform,
                material,
            })
            .collect();
        for (what, count) in [("the groups", groups.len()), ("the instances", instances.len())] {
            if u16::try_from(count).is_err() {
                let (what, why) = (what.into(), "a blob holds 65535 of them".into());
                return Err(Problem::Unrepresentable { what, why }.anywhere());
            }
        }
        let (mut cache, mut virtual_lights) = (None, None);
        match self.glow(size)? {
            Glow::Cache { records, error } => {
                bits |= uses::IRRADIANCE_CACHE;
                let records: Result<Vec<_>, _> = records.iter().map(A::new_record).collect();
                cache = Some((records.map_err(|e| refused("an irradiance record", e))?, error));
            }
            Glow::VirtualLights { lights, settings } => {
                bits |= uses::VIRTUAL_LIGHTS;
                let lights: Result<Vec<_>, _> = lights.iter().map(A::new_virtual_light).collect();
                let lights = lights.map_err(|e| refused("a virtual light", e))?;
                virtual_lights = Some((lights, settings));
            }
            Glow::None => {}
        }
        let content = Content {
            shapes: parts.shapes(),
            groups: &groups,
            instances: &instances,
            planes: parts.planes,
            tree: self.shapes.words(),
            materials: &materials,
            lights: &lights,
            absorptions: &absorptions,
            textures: &textures,
            area_lights: &area_lights,
            cache: cache.as_ref().map(|(records, error)| (records.as_slice(), *error)),
            virtual_lights: virtual_lights
                .as_ref()
                .map(|(lights, settings)| (lights.as_slice(), *settings)),
            setting: specs::setting(&self.placed, size),
            uses: bits,
        };
        let mut bytes = Vec::new();
        content.write(&mut |part| bytes.extend_from_slice(part));
        if u32::try_from(bytes.len()).is_err() {
            let why = format!("it would take {} bytes", bytes.len());
            return Err(Problem::Unrepresentable { what: "the blob".into(), why }.anywhere());
        }
        seal(&mut bytes);
        Ok(Flash { bytes, counts: content.counts() })
    }
}

/// Bytes of a blob by part: what, how many, how many bytes.
pub fn parts_of<A: Construct>(counts: &Counts) -> Vec<(&'static str, usize, usize)> {
    use whitted::shape::{
        Cone, Cuboid, Cylinder, Disc, Plane, Polygon, PolygonEdge, SmoothTriangle, Sphere, Triangle,
    };
    // What one is called, and several.
    let sizes = [
        ("sphere", "spheres", size_of::<Sphere<A>>()),
        ("triangle", "triangles", size_of::<Triangle<A>>()),
        ("smooth triangle", "smooth triangles", size_of::<SmoothTriangle<A>>()),
        ("polygon", "polygons", size_of::<Polygon<A>>()),
        ("edge", "edges", size_of::<PolygonEdge<A>>()),
        ("box", "boxes", size_of::<Cuboid<A>>()),
        ("disc", "discs", size_of::<Disc<A>>()),
        ("cylinder", "cylinders", size_of::<Cylinder<A>>()),
        ("cone", "cones", size_of::<Cone<A>>()),
        ("plane", "planes", size_of::<Plane<A>>()),
    ];
    let mut all: Vec<_> = sizes
        .into_iter()
        .zip(counts.shapes)
        .map(|((one, several, size), count)| {
            (if count == 1 { one } else { several }, count as usize, size * count as usize)
        })
        .collect();
    let words = counts.words as usize;
    all.push((if words == 1 { "octree word" } else { "octree words" }, words, 4 * words));
    let list = |count: u32, size: usize| (count as usize, size * count as usize);
    for (one, several, (count, bytes)) in [
        (
            "texture coordinates",
            "texture coordinates",
            list(counts.uvs, size_of::<TriangleUv>()),
        ),
        ("irradiance record", "irradiance records", list(counts.records, size_of::<Record<A>>())),
        (
            "virtual light",
            "virtual lights",
            list(counts.virtual_lights, size_of::<VirtualLight<A>>()),
        ),
        (
            "corner of area lights",
            "corners of area lights",
            list(counts.corners, size_of::<[f64; 3]>()),
        ),
    ] {
        all.push((if count == 1 { one } else { several }, count, bytes));
    }
    let Counts { materials, lights, absorptions, textures, area_lights, .. } = *counts;
    let Counts { groups, instances, solids, .. } = *counts;
    let specs = [materials, lights, absorptions, textures, area_lights, groups, instances];
    let specs = specs.map(usize::from).iter().sum::<usize>() + solids as usize;
    let pictures = counts.pictures as usize;
    all.push(("bytes of pictures", pictures, pictures));
    let name = if solids > 0 || groups > 0 {
        "materials, lights, setting, groups, solids"
    } else {
        "materials, lights, setting"
    };
    all.push((name, specs, counts.specs as usize));
    all.retain(|(_, count, _)| *count > 0);
    all
}

//! A scene as one piece of bytes, for flash.

use whitted::blob::{Content, Counts, seal};
use whitted::scene::{Selection, Shapes};

use super::{Baked, Construct, specs};
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
    /// The scene holds what a blob can't.
    pub fn blob(&self, size: Size) -> Result<Flash, Flaw> {
        self.fits_blob()?;
        self.flash(size)
    }

    fn flash(&self, size: Size) -> Result<Flash, Flaw> {
        let uses = self.with_scene(|scene| scene.parts().uses())?;
        let parts = self.shapes.parts()?;
        let materials: Result<Vec<_>, _> =
            self.placed.materials.iter().map(specs::material).collect();
        let materials = materials.map_err(|e| super::refused::<A>("the material", e, None))?;
        let lights: Vec<_> = self.placed.lights.iter().filter_map(specs::light).collect();
        let content = Content {
            shapes: Shapes {
                spheres: parts.spheres,
                triangles: parts.triangles,
                smooth_triangles: parts.smooth_triangles,
                polygons: parts.polygons,
                edges: parts.edges,
                cuboids: parts.cuboids,
                discs: parts.discs,
                cylinders: parts.cylinders,
                cones: parts.cones,
                ..Shapes::EMPTY
            },
            planes: parts.planes,
            tree: self.shapes.words(),
            materials: &materials,
            lights: &lights,
            setting: specs::setting(&self.placed, size),
            uses,
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

    /// Whether a blob can hold all of the scene.
    fn fits_blob(&self) -> Result<(), Flaw> {
        let without = self.with_scene(|scene| {
            let parts = scene.parts();
            [
                ("instances of groups", parts.instances.is_empty()),
                ("solids", parts.solids.is_empty()),
                ("textures and bumps", parts.textures.is_empty()),
                ("interreflection", self.placed.indirect.is_none()),
                ("area lights", parts.area_lights.is_empty()),
                ("absorption", parts.absorptions.is_empty()),
                ("a selection of lights", matches!(parts.selection, Selection::All)),
            ]
        })?;
        refuse(&without, "a blob can't hold them; Rust source (`-o scene.rs`) can")
    }
}

/// Refuses the first that isn't empty.
fn refuse(without: &[(&str, bool)], why: &str) -> Result<(), Flaw> {
    match without.iter().find(|(_, empty)| !empty) {
        None => Ok(()),
        Some(&(what, _)) => {
            let (what, why) = (what.into(), why.into());
            Err(Problem::Unrepresentable { what, why }.anywhere())
        }
    }
}

/// Bytes of a blob by part: what, how many, how many bytes.
pub fn parts_of<A: Construct>(counts: &Counts) -> Vec<(&'static str, usize, usize)> {
    use whitted::shape::{
        Cone, Cuboid, Cylinder, Disc, Plane, Polygon, PolygonEdge, SmoothTriangle, Sphere, Triangle,
    };
    let sizes = [
        ("spheres", size_of::<Sphere<A>>()),
        ("triangles", size_of::<Triangle<A>>()),
        ("smooth triangles", size_of::<SmoothTriangle<A>>()),
        ("polygons", size_of::<Polygon<A>>()),
        ("edges", size_of::<PolygonEdge<A>>()),
        ("boxes", size_of::<Cuboid<A>>()),
        ("discs", size_of::<Disc<A>>()),
        ("cylinders", size_of::<Cylinder<A>>()),
        ("cones", size_of::<Cone<A>>()),
        ("planes", size_of::<Plane<A>>()),
    ];
    let mut all: Vec<_> = sizes
        .into_iter()
        .zip(counts.shapes)
        .map(|((name, size), count)| (name, count as usize, size * count as usize))
        .collect();
    all.push(("octree words", counts.words as usize, 4 * counts.words as usize));
    let specs = usize::from(counts.materials) + usize::from(counts.lights);
    all.push(("materials, lights, setting", specs, counts.specs as usize));
    all.retain(|(_, count, _)| *count > 0);
    all
}

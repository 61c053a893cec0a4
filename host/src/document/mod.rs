//! What a scene file says, in `f64` and in no format's terms.
//!
//! Readers make a [`Document`], [`bake`](crate::bake) turns it into the core's scene, writers
//! ([`pov`](crate::pov)) into other programs' files. Everything in it is as the file has it:
//! nothing is scaled, split into the core's primitives or rounded. Radiances and coefficients
//! are linear.
//!
//! A new kind of light or shape is a variant here, then one arm in each reader that knows it, in
//! `bake` and in each writer; the compiler lists the places.

mod background;
mod camera;
mod group;
mod indirect;
mod light;
mod material;
mod place;
mod rules;
mod shape;
mod solid;
mod texture;
mod transform;
mod vector;

pub use background::Background;
pub use camera::{Camera, Span};
pub use group::{Group, Instance};
pub use indirect::{Cache, Indirect, VirtualLights, distances};
pub use light::{Area, Falloff, Light, LightKind};
pub use material::{Checker, Material, ShadowThrough};
pub use place::Misplaced;
pub use rules::{LightSelection, Rules};
pub use shape::{Body, Shape};
pub use solid::{Made, Solid};
pub use texture::Texture;
pub use transform::Transform;
pub use vector::{Bounds, Point, Rgb, add, cross, dot, length, normalized, scaled, sub};

use std::ops::Range;
use std::path::{Path, PathBuf};

/// Beyond this no arithmetic takes a coordinate.
pub const FARTHEST: f64 = 1e8;

/// Width and height of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Size {
    /// The largest width and height: the core counts pixels of a side in 15 bits.
    pub const LARGEST: u32 = 16384;
}

impl std::fmt::Display for Size {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

/// Something a person should know about the file that doesn't keep it from being rendered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The line it is about, from 1.
    pub line: usize,
    /// What it says.
    pub text: String,
}

/// A scene as its file has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Where it is seen from.
    pub camera: Camera,
    /// How large a picture the file asks for.
    pub size: Option<Size>,
    /// What a ray that hits nothing sees.
    pub background: Background,
    /// E_amb of the model: the irradiance that comes from everywhere, divided by π.
    pub ambient: Rgb,
    /// The light that surfaces send each other, instead of the ambient term.
    pub indirect: Option<Indirect>,
    /// What the classic programs differ in.
    pub rules: Rules,
    /// The materials; shapes and checkers name them by index.
    pub materials: Vec<Material>,
    /// The lights.
    pub lights: Vec<Light>,
    /// The shapes, in the order of the file.
    pub shapes: Vec<Shape>,
    /// Groups of shapes; instances name them by index.
    pub groups: Vec<Group>,
    /// Groups in the scene.
    pub instances: Vec<Instance>,
    /// What the reader noticed.
    pub warnings: Vec<Warning>,
    /// What came from other files than the document's own.
    pub included: Vec<Included>,
}

/// Which shapes, materials and lights of a document came from another file: their lines are that
/// file's. Where ranges lie one within the other, the last counts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Included {
    /// The file.
    pub file: PathBuf,
    /// Its shapes.
    pub shapes: Range<usize>,
    /// Its materials.
    pub materials: Range<usize>,
    /// Its lights.
    pub lights: Range<usize>,
    /// Its groups.
    pub groups: Range<usize>,
}

impl Document {
    /// The box around all shapes that end, and visible lights; `None` where there are none.
    pub fn bounds(&self) -> Option<Bounds> {
        let shown = self.lights.iter().filter_map(|light| light.body()?.bounds());
        let shapes = self.shapes.iter().filter_map(|shape| shape.body.bounds());
        let instances = self.instances.iter().filter_map(|instance| instance.bounds(self));
        shapes.chain(shown).chain(instances).reduce(Bounds::union)
    }

    /// Adds the shapes that show visible lights, of materials that emit the same; for each light
    /// the index of its shape.
    pub fn embody(&mut self) -> Vec<Option<usize>> {
        let mut indices = Vec::new();
        for light in &self.lights {
            let Some(body) = light.body() else {
                indices.push(None);
                continue;
            };
            let like = Material::matt(light.line);
            let (emission, black) = (light.color, [0.0; 3]);
            indices.push(Some(self.shapes.len()));
            let material = self.materials.len();
            self.shapes.push(Shape { body, material, uv: None, line: light.line });
            self.materials.push(Material {
                name: "light".into(),
                emission,
                diffuse: black,
                ambient: black,
                ..like
            });
        }
        indices
    }

    /// The file that a shape came from, if it isn't the document's own.
    pub fn file_of_shape(&self, index: usize) -> Option<&Path> {
        self.file_where(|part| part.shapes.contains(&index))
    }

    /// The file that a material came from, if it isn't the document's own.
    pub fn file_of_material(&self, index: usize) -> Option<&Path> {
        self.file_where(|part| part.materials.contains(&index))
    }

    /// The file that a light came from, if it isn't the document's own.
    pub fn file_of_light(&self, index: usize) -> Option<&Path> {
        self.file_where(|part| part.lights.contains(&index))
    }

    /// The file that a group came from, if it isn't the document's own.
    pub fn file_of_group(&self, index: usize) -> Option<&Path> {
        self.file_where(|part| part.groups.contains(&index))
    }

    fn file_where(&self, holds: impl Fn(&Included) -> bool) -> Option<&Path> {
        self.included.iter().rfind(|part| holds(part)).map(|part| part.file.as_path())
    }

    /// How many shapes there are of each kind, in the order in which the kinds first appear.
    pub fn census(&self) -> Vec<(&'static str, usize)> {
        let mut counts: Vec<(&'static str, usize)> = Vec::new();
        for shape in &self.shapes {
            let name = shape.body.name();
            match counts.iter_mut().find(|(known, _)| *known == name) {
                Some((_, count)) => *count += 1,
                None => counts.push((name, 1)),
            }
        }
        counts
    }
}

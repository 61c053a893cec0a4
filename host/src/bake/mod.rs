//! From a [`Document`] to the core's scene in one of its arithmetics, in memory.

mod blob;
mod construct;
mod group;
mod place;
mod shapes;
mod source;
mod specs;

pub use blob::{Flash, parts_of};
pub use construct::Construct;
use group::Groups;
pub use place::Placement;
use shapes::Shapes;
pub use shapes::Thrift;

use whitted::blob::CameraSpec;
use whitted::scene::{Ambient, Background, Camera, Light, Material, Parts, Rules, Scene};
use whitted::shape::ShapeError;

use crate::document::{self, Document, Size};
use crate::error::{Flaw, Problem};
use std::path::Path;

/// A scene in an arithmetic, owned.
#[derive(Debug)]
pub struct Baked<A: Construct> {
    /// How the document's coordinates became these.
    pub placement: Placement,
    placed: Document,
    shapes: Shapes<A>,
    groups: Groups<A>,
    materials: Vec<Material<A>>,
    lights: Vec<Light<A>>,
    ambient: Ambient<A>,
    background: Background<A>,
}

impl<A: Construct> Baked<A> {
    /// Bakes a document.
    ///
    /// # Errors
    /// What of it the arithmetic can't hold, with its line.
    pub fn new(document: &Document) -> Result<Self, Flaw> {
        Self::with(document, Thrift::Time)
    }

    /// Bakes a document, its octree as large as is wanted.
    ///
    /// # Errors
    /// What of it the arithmetic can't hold, with its line.
    pub fn with(document: &Document, thrift: Thrift) -> Result<Self, Flaw> {
        let placement = if A::NARROW { Placement::filling(document) } else { Placement::IDENTITY };
        let placed = placement.place(document);
        let background = match placed.background {
            document::Background::Color(color) => A::new_uniform(color),
            document::Background::Gradient { bottom, top, up } => A::new_gradient(up, bottom, top),
        };
        let baked = Self {
            placement,
            shapes: Shapes::new(
                &placed.shapes,
                placed.bounds(),
                |i| placed.file_of_shape(i),
                thrift,
            )?,
            groups: Groups::new(&placed, thrift)?,
            materials: materials(&placed)?,
            lights: lights(&placed)?,
            ambient: A::new_ambient(placed.ambient)
                .map_err(|e| refused::<A>("the ambient", e, None))?,
            background: background.map_err(|e| refused::<A>("the background", e, None))?,
            placed,
        };
        baked.with_scene(|_| ())?;
        Ok(baked)
    }

    /// Does something with the scene, borrowed as the core wants it.
    ///
    /// # Errors
    /// None that [`new`](Self::new) hasn't seen.
    pub fn with_scene<T>(&self, then: impl FnOnce(&Scene<'_, A>) -> T) -> Result<T, Flaw> {
        let rules = &self.placed.rules;
        let groups = self.groups.groups()?;
        let instances = self.groups.instances(&groups)?;
        let scene: Result<Scene<'_, A>, _> = A::new_scene(Parts {
            instances: &instances,
            materials: &self.materials,
            lights: &self.lights,
            ambient: self.ambient,
            background: self.background,
            rules: Rules {
                specular_cosine: rules.specular_cosine,
                highlight_cosine: rules.highlight_cosine,
                transmitters_reflect: rules.transmitters_reflect,
                lossy: rules.lossy_total_reflection,
                ..A::rules_with_cutoff(rules.cutoff)
            },
            ..self.shapes.parts()?
        });
        scene.map(|scene| then(&scene)).map_err(|error| {
            let why = error.to_string();
            Problem::Unrepresentable { what: "the scene".into(), why }.anywhere()
        })
    }

    /// The camera for pictures of a size.
    ///
    /// # Errors
    /// The arithmetic can't hold it.
    pub fn camera(&self, size: Size) -> Result<Camera<A>, Flaw> {
        let CameraSpec { eye, at, up, tangent } = specs::camera(&self.placed.camera, size);
        A::new_camera(eye, at, up, tangent).map_err(|error| refused::<A>("the camera", error, None))
    }

    /// The document's shape that has this number in the core's scene, and the file that it came
    /// from if it isn't the document's own.
    pub fn origin(&self, number: u32) -> Option<(&document::Shape, Option<&Path>)> {
        let document = &self.placed;
        let own = |i: usize| Some((document.shapes.get(i)?, document.file_of_shape(i)));
        let beyond = match self.shapes.origin(number) {
            Ok(index) => return own(index),
            Err(beyond) => beyond,
        };
        match self.groups.origin(beyond) {
            Ok((group, index)) => {
                let shape = document.groups.get(group)?.shapes.get(index)?;
                Some((shape, document.file_of_group(group)))
            }
            Err(beyond) => own(self.shapes.plane_origin(beyond)?),
        }
    }

    /// Words and levels of the octree; `None` for scenes so small that they have none.
    pub fn tree(&self) -> Option<(usize, u8)> {
        self.shapes.tree()
    }

    /// Words of the octrees of all groups.
    pub fn group_tree_words(&self) -> usize {
        self.groups.tree_words()
    }

    /// The document as it was placed.
    pub fn document(&self) -> &Document {
        &self.placed
    }
}

fn refused<A: Construct>(what: &str, error: ShapeError, line: Option<usize>) -> Flaw {
    let why = format!("{error} (in {} arithmetic)", A::NAME);
    Flaw { line, file: None, problem: Problem::Unrepresentable { what: what.into(), why } }
}

fn materials<A: Construct>(document: &Document) -> Result<Vec<Material<A>>, Flaw> {
    let make = |m: &document::Material| {
        let made = specs::material(m).and_then(|spec| A::new_material(&spec));
        made.map_err(|error| refused::<A>("the material", error, Some(m.line)))
    };
    let from = |i| document.file_of_material(i);
    let all = document.materials.iter().enumerate();
    all.map(|(i, m)| make(m).map_err(|flaw| flaw.within(from(i)))).collect()
}

fn lights<A: Construct>(document: &Document) -> Result<Vec<Light<A>>, Flaw> {
    let make = |l: &document::Light| {
        A::new_light(&specs::light(l))
            .map_err(|error| refused::<A>("the light", error, Some(l.line)))
    };
    let from = |i| document.file_of_light(i);
    let all = document.lights.iter().enumerate();
    all.map(|(i, l)| make(l).map_err(|flaw| flaw.within(from(i)))).collect()
}

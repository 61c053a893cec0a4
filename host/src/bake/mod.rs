//! From a [`Document`] to the core's scene in one of its arithmetics, in memory.

mod construct;
mod place;
mod shapes;

pub use construct::Construct;
pub use place::Placement;
use shapes::Shapes;

use whitted::scene::{
    Ambient, Background, Camera, Falloff, Light, LightSpec, Material, MaterialSpec, Parts,
    PatternSpec, Rules, Scene, Shadow,
};
use whitted::shape::ShapeError;

use crate::document::{self, Document, LightKind, ShadowThrough, Size};
use crate::error::{Flaw, Problem};

/// A scene in an arithmetic, owned.
#[derive(Debug)]
pub struct Baked<A: Construct> {
    /// How the document's coordinates became these.
    pub placement: Placement,
    placed: Document,
    shapes: Shapes<A>,
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
        let placement = if A::NARROW { Placement::filling(document) } else { Placement::IDENTITY };
        let placed = placement.place(document);
        let background = match placed.background {
            document::Background::Color(color) => A::new_uniform(color),
            document::Background::Gradient { bottom, top, up } => A::new_gradient(up, bottom, top),
        };
        let baked = Self {
            placement,
            shapes: Shapes::new(&placed)?,
            materials: materials(&placed)?,
            lights: lights(&placed)?,
            ambient: A::new_ambient(placed.ambient)
                .map_err(|e| refused::<A>("the ambient", e, None))?,
            background: background.map_err(|e| refused::<A>("the background", e, None))?,
            placed,
        };
        baked.scene()?;
        Ok(baked)
    }

    /// The scene, borrowed as the core wants it.
    ///
    /// # Errors
    /// None that [`new`](Self::new) hasn't seen.
    pub fn scene(&self) -> Result<Scene<'_, A>, Flaw> {
        let rules = &self.placed.rules;
        A::new_scene(Parts {
            materials: &self.materials,
            lights: &self.lights,
            ambient: self.ambient,
            background: self.background,
            rules: Rules {
                specular_cosine: rules.specular_cosine,
                highlight_cosine: rules.highlight_cosine,
                transmitters_reflect: rules.transmitters_reflect,
                lossy: rules.lossy_total_reflection,
                cutoff: A::coefficient(rules.cutoff),
            },
            ..self.shapes.parts()?
        })
        .map_err(|error| {
            let why = error.to_string();
            Problem::Unrepresentable { what: "the scene".into(), why }.anywhere()
        })
    }

    /// The camera for pictures of a size.
    ///
    /// # Errors
    /// The arithmetic can't hold it.
    pub fn camera(&self, size: Size) -> Result<Camera<A>, Flaw> {
        let camera = &self.placed.camera;
        let tangent = (camera.edge_angle(size).to_radians() / 2.0).tan();
        A::new_camera(camera.eye, camera.look_at, camera.up, tangent)
            .map_err(|error| refused::<A>("the camera", error, None))
    }

    /// The document's index of the shape that has this number in the core's scene.
    pub fn origin(&self, shape: u32) -> Option<usize> {
        self.shapes.origin(shape)
    }

    /// Words and levels of the octree; `None` for scenes so small that they have none.
    pub fn tree(&self) -> Option<(usize, u8)> {
        self.shapes.tree()
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
        let refuse = |error| refused::<A>("the material", error, Some(m.line));
        let pattern = match &m.checker {
            None => None,
            Some(checker) => Some(PatternSpec {
                cell: checker.cell,
                offset: checker.offset,
                other: u16::try_from(checker.other).map_err(|_| refuse(ShapeError::Material))?,
            }),
        };
        A::new_material(&MaterialSpec {
            ambient: m.ambient,
            diffuse: m.diffuse,
            specular: m.specular,
            shininess: m.shininess,
            reflection: m.reflection,
            transmission: m.transmission,
            index_front: m.index_front,
            index_behind: m.index_behind,
            emission: m.emission,
            shadow: match m.shadow {
                ShadowThrough::Opaque => Shadow::Opaque,
                ShadowThrough::Filtered => Shadow::Filtered,
                ShadowThrough::None => Shadow::None,
            },
            pattern,
        })
        .map_err(refuse)
    };
    let from = |i| document.file_of_material(i);
    let all = document.materials.iter().enumerate();
    all.map(|(i, m)| make(m).map_err(|flaw| flaw.within(from(i)))).collect()
}

fn lights<A: Construct>(document: &Document) -> Result<Vec<Light<A>>, Flaw> {
    let from = |i| document.file_of_light(i);
    let all = document.lights.iter().enumerate();
    all.map(|(i, l)| light(l).map_err(|flaw: Flaw| flaw.within(from(i)))).collect()
}

fn light<A: Construct>(light: &document::Light) -> Result<Light<A>, Flaw> {
    let weakens = |falloff| match falloff {
        document::Falloff::None => Falloff::None,
        document::Falloff::InverseSquare => Falloff::InverseSquare,
    };
    let intensity = light.color;
    let spec = match light.kind {
        LightKind::Point { position, falloff } => {
            LightSpec::Point { position, intensity, falloff: weakens(falloff) }
        }
        LightKind::Directional { direction } => LightSpec::Directional { direction, intensity },
        LightKind::Spot { position, direction, inner, outer, falloff } => LightSpec::Spot {
            position,
            direction,
            intensity,
            falloff: weakens(falloff),
            cos_inner: inner.to_radians().cos(),
            cos_outer: outer.to_radians().cos(),
        },
    };
    A::new_light(&spec).map_err(|error| refused::<A>("the light", error, Some(light.line)))
}

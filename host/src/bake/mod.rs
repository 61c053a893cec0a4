//! From a [`Document`] to the core's scene in one of its arithmetics, in memory.

mod construct;
mod place;

pub use construct::Construct;
pub use place::Placement;

use whitted::scene::{
    Ambient, Background, Camera, Falloff, Light, LightSpec, Material, MaterialSpec, Parts,
    PatternSpec, Rules, Scene, Shadow,
};
use whitted::shape::{Plane, ShapeError, Sphere};

use crate::document::{self, Body, Document, LightKind, ShadowThrough, Size, dot, normalized};
use crate::error::{Flaw, Problem};

/// A scene in an arithmetic, owned.
#[derive(Debug)]
pub struct Baked<A: Construct> {
    /// How the document's coordinates became these.
    pub placement: Placement,
    placed: Document,
    spheres: Vec<Sphere<A>>,
    planes: Vec<Plane<A>>,
    materials: Vec<Material<A>>,
    lights: Vec<Light<A>>,
    ambient: Ambient<A>,
    background: Background<A>,
    /// The document's index of each shape, by kinds as the core numbers them.
    origins: Origins,
}

/// For each kind, in the core's order, the document's index of each of its shapes.
#[derive(Debug, Default)]
struct Origins {
    spheres: Vec<usize>,
    planes: Vec<usize>,
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
            document::Background::Color(color) => A::uniform(color),
            document::Background::Gradient { bottom, top, up } => A::gradient(up, bottom, top),
        };
        let mut baked = Self {
            placement,
            spheres: Vec::new(),
            planes: Vec::new(),
            materials: materials(&placed)?,
            lights: placed.lights.iter().map(light).collect::<Result<_, _>>()?,
            ambient: A::ambient(placed.ambient)
                .map_err(|e| refused::<A>("the ambient", e, None))?,
            background: background.map_err(|e| refused::<A>("the background", e, None))?,
            origins: Origins::default(),
            placed,
        };
        for index in 0..baked.placed.shapes.len() {
            baked.add(index)?;
        }
        baked.scene()?;
        Ok(baked)
    }

    /// The scene, borrowed as the core wants it.
    ///
    /// # Errors
    /// None that [`new`](Self::new) hasn't seen.
    pub fn scene(&self) -> Result<Scene<'_, A>, Flaw> {
        let rules = &self.placed.rules;
        A::scene(Parts {
            spheres: &self.spheres,
            planes: &self.planes,
            materials: &self.materials,
            lights: &self.lights,
            ambient: self.ambient,
            background: self.background,
            rules: Rules {
                specular_cosine: rules.specular_cosine,
                highlight_cosine: rules.highlight_cosine,
                transmitters_reflect: rules.transmitters_reflect,
                lossy: rules.lossy_total_reflection,
                cutoff: A::cutoff(rules.cutoff),
            },
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
        A::camera(camera.eye, camera.look_at, camera.up, tangent)
            .map_err(|error| refused::<A>("the camera", error, None))
    }

    /// The document's index of the shape that has this number in the core's scene.
    pub fn origin(&self, shape: u32) -> Option<usize> {
        let Origins { spheres, planes } = &self.origins;
        spheres.iter().chain(planes).nth(shape as usize).copied()
    }

    /// The document as it was placed.
    pub fn document(&self) -> &Document {
        &self.placed
    }

    fn add(&mut self, index: usize) -> Result<(), Flaw> {
        let shape = &self.placed.shapes[index];
        let refuse = |error| refused::<A>(shape.body.name(), error, Some(shape.line));
        let material = u16::try_from(shape.material).map_err(|_| refuse(ShapeError::Material))?;
        match &shape.body {
            Body::Sphere { center, radius } => {
                self.spheres.push(A::sphere(*center, *radius, material).map_err(refuse)?);
                self.origins.spheres.push(index);
            }
            Body::Plane { point, normal } => {
                let offset = normalized(*normal).map_or(0.0, |n| dot(n, *point));
                self.planes.push(A::plane(*normal, offset, material).map_err(refuse)?);
                self.origins.planes.push(index);
            }
            _ => {
                let why = "the core has no such shape yet".to_string();
                let what = shape.body.name().to_string();
                return Err(Problem::Unrepresentable { what, why }.at(shape.line));
            }
        }
        Ok(())
    }
}

fn refused<A: Construct>(what: &str, error: ShapeError, line: Option<usize>) -> Flaw {
    let why = format!("{error} (in {} arithmetic)", A::NAME);
    Flaw { line, problem: Problem::Unrepresentable { what: what.into(), why } }
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
        A::material(&MaterialSpec {
            ambient: m.ambient,
            diffuse: m.diffuse,
            specular: m.specular,
            shininess: m.shininess,
            reflection: m.reflection,
            transmission: m.transmission,
            index_front: m.index_front,
            index_behind: m.index_behind,
            shadow: match m.shadow {
                ShadowThrough::Opaque => Shadow::Opaque,
                ShadowThrough::Filtered => Shadow::Filtered,
                ShadowThrough::None => Shadow::None,
            },
            pattern,
        })
        .map_err(refuse)
    };
    document.materials.iter().map(make).collect()
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
    A::light(&spec).map_err(|error| refused::<A>("the light", error, Some(light.line)))
}

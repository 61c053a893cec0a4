//! From a [`Document`] to the core's scene in one of its arithmetics, in memory.

mod blob;
mod construct;
mod glow;
mod group;
mod light;
mod place;
mod precision;
mod shapes;
mod source;
mod specs;

pub use blob::{Flash, parts_of};
pub use construct::Construct;
pub use glow::Glow;
use group::Groups;
use light::Lights;
pub use place::Placement;
use shapes::Shapes;
pub use shapes::Thrift;

use whitted::blob::CameraSpec;
use whitted::scene::{
    Absorption, Ambient, Background, Camera, Material, MaterialSpec, Parts, PatternSpec, Rules,
    Scene, Selection, Shadow, Texture, TextureSpec,
};
use whitted::shape::ShapeError;

use crate::document::{self, Document, LightSelection, ShadowThrough, Size};
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
    textures: Vec<Texture<'static, A>>,
    absorptions: Vec<Absorption<A>>,
    lights: Lights<A>,
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
        let (placement, mut placed) = if A::NARROW {
            let placement = Placement::filling(document);
            let placed = placement.place(document);
            precision::check(document, &placement, &placed)?;
            (placement, placed)
        } else {
            let placement = Placement::near(document);
            let placed = match placement {
                Placement::IDENTITY => document.clone(),
                _ => placement.place(document),
            };
            (placement, placed)
        };
        let bodies = placed.embody();
        let background = match placed.background {
            document::Background::Color(color) => A::new_uniform(color),
            document::Background::Gradient { bottom, top, up } => A::new_gradient(up, bottom, top),
        };
        let detail = detail(&placed, placement.scale())?;
        let file = |i| placed.file_of_shape(i);
        let shapes = Shapes::new(&placed.shapes, placed.bounds(), file, thrift)?;
        let baked = Self {
            placement,
            groups: Groups::new(&placed, thrift)?,
            materials: materials(&placed)?,
            textures: detail.textures,
            absorptions: detail.absorptions,
            lights: Lights::new(&placed, &shapes, &bodies)?,
            shapes,
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
            textures: &self.textures,
            absorptions: &self.absorptions,
            lights: &self.lights.points,
            area_lights: &self.lights.areas,
            light_corners: &self.lights.corners,
            light_jitter: rules.light_jitter,
            selection: match rules.lights {
                LightSelection::All => Selection::All,
                LightSelection::Choose(count) => Selection::Choose(count),
                LightSelection::Threshold(radiance) => A::new_threshold(radiance)
                    .map_err(|e| refused::<A>("the threshold of the lights", e, None))?,
            },
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
        self.placed_camera(&self.placed.camera, size)
    }

    /// Another camera in the document's coordinates, for pictures of this size.
    ///
    /// # Errors
    /// The arithmetic can't hold it.
    pub fn camera_of(&self, camera: &document::Camera, size: Size) -> Result<Camera<A>, Flaw> {
        self.placed_camera(&self.placement.camera(camera), size)
    }

    fn placed_camera(&self, camera: &document::Camera, size: Size) -> Result<Camera<A>, Flaw> {
        let CameraSpec { eye, at, up, tangent } = specs::camera(camera, size);
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
    // Numbered as `detail` lists them.
    let (mut textures, mut absorptions) = (0u16, 0u16);
    let next = |wanted: bool, count: &mut u16| {
        wanted.then(|| {
            let index = *count;
            *count = count.saturating_add(1);
            index
        })
    };
    let mut make = |m: &document::Material| {
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
            texture: next(m.texture.is_some(), &mut textures),
            bump: next(m.bump.is_some(), &mut textures),
            fresnel: m.fresnel,
            absorption: next(m.absorbs(), &mut absorptions),
        })
        .map_err(refuse)
    };
    let from = |i| document.file_of_material(i);
    let all = document.materials.iter().enumerate();
    all.map(|(i, m)| make(m).map_err(|flaw| flaw.within(from(i)))).collect()
}

/// Whether a placed material's media are ones that the core takes; if not, what is wrong in the
/// scene's own units.
fn absorbable<A: Construct>(material: &document::Material, scale: f64) -> Result<(), Flaw> {
    let most = Absorption::<A>::MOST;
    let keys = ["absorption_front", "absorption"].into_iter().zip(material.absorption_lines);
    for ((key, line), rates) in keys.zip(material.absorption) {
        if let Some(rate) = rates.into_iter().find(|&rate| rate > most) {
            let right = format!("0 to {} (in {} arithmetic, in this scene)", most * scale, A::NAME);
            return Err(Problem::range(key, rate * scale, right).at(line));
        }
    }
    Ok(())
}

/// What materials name by index.
struct Detail<A: Construct> {
    textures: Vec<Texture<'static, A>>,
    absorptions: Vec<Absorption<A>>,
}

/// The textures and media of all materials, one after the other, each material's bump after its
/// texture.
fn detail<A: Construct>(document: &Document, scale: f64) -> Result<Detail<A>, Flaw> {
    let mut detail = Detail { textures: Vec::new(), absorptions: Vec::new() };
    for (i, material) in document.materials.iter().enumerate() {
        let from = document.file_of_material(i);
        let refuse = |what, e, line| refused::<A>(what, e, Some(line)).within(from);
        for texture in [&material.texture, &material.bump].into_iter().flatten() {
            let refuse = |e| refuse("the texture", e, texture.line);
            let other = texture.other.map(u16::try_from).transpose();
            let other = other.map_err(|_| refuse(ShapeError::Material))?;
            let spec = TextureSpec { other, ..texture.spec };
            detail.textures.push(A::new_texture(&spec).map_err(refuse)?);
        }
        if material.absorbs() {
            absorbable::<A>(material, scale).map_err(|flaw| flaw.within(from))?;
            let [front, behind] = material.absorption;
            let made = A::new_absorption(front, behind);
            detail.absorptions.push(made.map_err(|e| refuse("the absorption", e, material.line))?);
        }
    }
    Ok(detail)
}

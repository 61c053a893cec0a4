//! glTF 2.0, as text with buffers beside it (`.gltf`) or in one piece (`.glb`).
//!
//! The text is read by the `gltf-json` crate, the rest here: its sister crate's validation indexes
//! lists by numbers that it hasn't checked yet, and a wrong file would end the program. All that is
//! used is checked where it is used; an error names the place in the file's own words.
//!
//! What it means for the model: physical falloff and no cosines beside Lambert's.

mod accessor;
mod container;
mod material;
mod node;
mod texture;

use std::collections::BTreeMap;

use gltf_json::mesh::{Mode, Primitive, Semantic};
use gltf_json::validation::Checked;
use gltf_json::{Index, Root};

use crate::document::{
    Background, Body, Camera, Document, FARTHEST, Falloff, Material, Point, Rules, Shape, Span,
    Transform, Warning,
};
use crate::error::{Flaw, Problem, shown};
use crate::mesh::{self, Faces, Skipped, frame, repeated};
use crate::read::Around;
use accessor::Data;

/// Triangles beyond which a file is refused: nodes share meshes, so that a short one could ask for
/// any number.
const MOST_TRIANGLES: usize = 1 << 20;

/// Extensions that are read.
const EXTENSIONS: [&str; 4] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_transmission",
];

/// Reads a file's bytes; its buffers may lie beside `around`'s file.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn parse(bytes: &[u8], around: &Around) -> Result<Document, Flaw> {
    document(bytes, around).map_err(Problem::anywhere)
}

/// What is to be said, besides errors.
#[derive(Default)]
struct Noticed {
    /// What was left out: where first, and how often.
    without: BTreeMap<String, (String, usize)>,
    warnings: Vec<String>,
}

impl Noticed {
    fn leave_out(&mut self, what: &str, place: &str) {
        self.without.entry(what.to_owned()).or_insert_with(|| (place.to_owned(), 0)).1 += 1;
    }

    fn say(&mut self, text: String) {
        self.warnings.push(text);
    }

    fn warnings(self) -> Vec<Warning> {
        let without = self.without.into_iter().map(|(what, (place, count))| {
            format!("{what} aren't in the model: {count} left out (the first: {place})")
        });
        let all = self.warnings.into_iter().chain(without);
        all.map(|text| Warning { line: 0, text }).collect()
    }
}

/// What an index names.
fn indexed<'l, T, I>(
    list: &'l [T],
    index: Index<I>,
    place: &str,
    of: &str,
) -> Result<&'l T, Problem> {
    list.get(index.value()).ok_or_else(|| {
        let right = format!("below {}, the number of {of}", list.len());
        Problem::range(place, index.value() as f64, right)
    })
}

fn document(bytes: &[u8], around: &Around) -> Result<Document, Problem> {
    if bytes.is_empty() {
        return Err(Problem::Empty);
    }
    let parts = container::split(bytes)?;
    let root: Root = gltf_json::deserialize::from_slice(parts.json)
        .map_err(|error| Problem::Syntax(format!("is no glTF: {error}")))?;
    if root.asset.version != "2.0" && !root.asset.version.starts_with("2.") {
        let found = format!("asset.version \"{}\"", shown(&root.asset.version));
        return Err(Problem::Found { found, wanted: "\"2.0\"".into() });
    }
    let mut noticed = Noticed::default();
    if let Some(name) = root.extensions_required.iter().find(|n| !EXTENSIONS.contains(&n.as_str()))
    {
        return Err(Problem::unknown("required extension", name, &EXTENSIONS));
    }
    for name in root.extensions_used.iter().filter(|n| !EXTENSIONS.contains(&n.as_str())) {
        noticed.leave_out(&format!("things of the extension {}", shown(name)), "extensionsUsed");
    }
    if !root.animations.is_empty() {
        noticed.leave_out("animations", "animations[0]");
    }
    let mut reader = Reader {
        data: Data::new(&root, parts.binary, around)?,
        around,
        materials: Vec::new(),
        sets: Vec::new(),
        plain: None,
        shapes: Vec::new(),
        skipped: BTreeMap::new(),
        bare: 0,
        meshes: BTreeMap::new(),
        noticed,
        root: &root,
    };
    reader.materials()?;
    let nodes = node::flattened(&root)?;
    for (i, world) in &nodes {
        reader.place(*i, world)?;
    }
    let mut noticed = reader.noticed;
    for (why, count) in reader.skipped {
        noticed.say(format!("{count} faces {}", why.message()));
    }
    if reader.bare > 0 {
        noticed.say(mesh::bare(reader.bare));
    }
    if reader.shapes.is_empty() {
        let what = "a triangle with an area (in a mesh of a node of the scene)".into();
        return Err(Problem::Missing { what });
    }
    let camera = node::camera(&root, &nodes, &mut noticed)?;
    let lights = node::lights(&root, &nodes, &mut noticed)?;
    let mut document = Document {
        indirect: None,
        camera: camera.unwrap_or(NOWHERE),
        size: None,
        background: Background::Color([0.0; 3]),
        ambient: [0.0; 3],
        rules: Rules {
            specular_cosine: false,
            highlight_cosine: false,
            falloff: Falloff::InverseSquare,
            ..Rules::SLIDES
        },
        materials: reader.materials,
        lights,
        shapes: reader.shapes,
        groups: Vec::new(),
        instances: Vec::new(),
        warnings: noticed.warnings(),
        included: Vec::new(),
    };
    if !around.is_included() {
        frame(&mut document, camera.is_some());
    }
    Ok(document)
}

/// A camera's place until there is one.
const NOWHERE: Camera = Camera {
    eye: [0.0, 0.0, 1.0],
    look_at: [0.0; 3],
    up: [0.0, 1.0, 0.0],
    angle: 45.0,
    span: Span::Edges,
};

/// The triangles of a primitive, in its mesh's own space.
struct Part {
    positions: Vec<Point>,
    normals: Vec<Point>,
    /// With v upwards, the file's goes down; none where the material has no picture.
    uvs: Vec<[f64; 2]>,
    triangles: Vec<[usize; 3]>,
    material: Option<usize>,
}

struct Reader<'r> {
    root: &'r Root,
    data: Data<'r>,
    around: &'r Around,
    materials: Vec<Material>,
    /// Which coordinates place the picture of each material, if it has one.
    sets: Vec<Option<u32>>,
    /// The material of primitives that name none.
    plain: Option<usize>,
    shapes: Vec<Shape>,
    skipped: BTreeMap<Skipped, usize>,
    /// Faces that a picture should be on, and isn't.
    bare: usize,
    /// Those that were read: nodes share them.
    meshes: BTreeMap<usize, Vec<Part>>,
    noticed: Noticed,
}

impl Reader<'_> {
    fn materials(&mut self) -> Result<(), Problem> {
        for (i, theirs) in self.root.materials.iter().enumerate() {
            let place = format!("materials[{i}]");
            let mut material = material::read(theirs, &place, &mut self.noticed)?;
            let around = (self.root, &self.data, self.around);
            let map = texture::base_color(around, theirs, &place, &mut self.noticed)?;
            self.sets.push(map.as_ref().map(|map| map.set));
            material.texture = map.map(|map| map.texture);
            self.materials.push(material);
        }
        Ok(())
    }

    /// Adds the mesh of a node.
    fn place(&mut self, number: usize, world: &Transform) -> Result<(), Problem> {
        let node = &self.root.nodes[number];
        if node.skin.is_some() {
            self.noticed.leave_out("skins", &format!("nodes[{number}]"));
        }
        let Some(index) = node.mesh else { return Ok(()) };
        let place = format!("meshes[{}]", index.value());
        let mesh = indexed(&self.root.meshes, index, &format!("nodes[{number}].mesh"), "meshes")?;
        if !self.meshes.contains_key(&index.value()) {
            let mut parts = Vec::new();
            for (i, primitive) in mesh.primitives.iter().enumerate() {
                parts.extend(self.part(primitive, &format!("{place}.primitives[{i}]"))?);
            }
            self.meshes.insert(index.value(), parts);
        }
        let Some(parts) = self.meshes.get(&index.value()) else { return Ok(()) };
        let count: usize = parts.iter().map(|part| part.triangles.len()).sum();
        let all = self.shapes.len() + count;
        if all > MOST_TRIANGLES {
            let right = format!("at most {MOST_TRIANGLES}");
            return Err(Problem::range("number of triangles", all as f64, right));
        }
        for part in parts {
            let material = part.material.unwrap_or_else(|| {
                *self.plain.get_or_insert_with(|| {
                    self.materials.push(Material::matt(0));
                    self.materials.len() - 1
                })
            });
            for &[a, b, c] in &part.triangles {
                // Seen from its front a triangle goes counter-clockwise, mirrored or not.
                let corners = if world.mirrors() { [a, c, b] } else { [a, b, c] };
                let positions = corners.map(|i| world.point(part.positions[i]));
                let normals: Vec<Point> = corners
                    .iter()
                    .filter_map(|&i| part.normals.get(i))
                    .map(|&n| world.normal(n))
                    .collect();
                if let Some(x) =
                    positions.iter().flatten().find(|x| x.is_nan() || x.abs() > FARTHEST)
                {
                    let what = format!("nodes[{number}]: placed coordinate");
                    return Err(Problem::range(what, *x, format!("within ±{FARTHEST}")));
                }
                let uvs = corners.iter().filter_map(|&i| part.uvs.get(i).copied()).collect();
                let uvs = repeated(uvs);
                if uvs.is_empty() && self.materials[material].texture.is_some() {
                    self.bare += 1;
                }
                let faces = Faces::of(&positions, &normals, &uvs);
                if let Some(why) = faces.skipped {
                    *self.skipped.entry(why).or_default() += 1;
                }
                let mut uvs = faces.uvs.into_iter();
                let shape =
                    |body: Body| Shape { body, material, uv: uvs.next().flatten(), line: 0 };
                self.shapes.extend(faces.bodies.into_iter().map(shape));
            }
        }
        Ok(())
    }

    /// Reads a primitive, none where it has no triangles.
    fn part(&mut self, primitive: &Primitive, place: &str) -> Result<Option<Part>, Problem> {
        let Checked::Valid(mode) = primitive.mode else {
            let found = format!("{place}.mode of another kind");
            return Err(Problem::Found { found, wanted: "0 to 6".into() });
        };
        if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            self.noticed.leave_out("points and lines", place);
            return Ok(None);
        }
        if primitive.targets.is_some() {
            self.noticed.leave_out("morph targets", place);
        }
        let attribute = |what| primitive.attributes.get(&Checked::Valid(what)).copied();
        if attribute(Semantic::Colors(0)).is_some() {
            self.noticed.leave_out("colours of corners", place);
        }
        let at = format!("{place}.attributes.POSITION");
        let Some(index) = attribute(Semantic::Positions) else {
            return Err(Problem::Missing { what: at });
        };
        let positions = self.data.vectors(index, &at)?;
        let at = format!("{place}.attributes.NORMAL");
        let normals = match attribute(Semantic::Normals) {
            Some(index) => self.data.vectors(index, &at)?,
            None => Vec::new(),
        };
        if !normals.is_empty() && normals.len() != positions.len() {
            let right = format!("{}, as many as positions", positions.len());
            return Err(Problem::range(format!("{at} count"), normals.len() as f64, right));
        }
        let order = match primitive.indices {
            Some(index) => {
                self.data.indices(index, &format!("{place}.indices"), positions.len())?
            }
            None => (0..positions.len()).collect(),
        };
        if let Some(index) = primitive.material {
            indexed(&self.root.materials, index, &format!("{place}.material"), "materials")?;
        }
        let material = primitive.material.map(|index| index.value());
        let set = material.and_then(|index| self.sets.get(index).copied().flatten());
        let uvs = match set.and_then(|set| attribute(Semantic::TexCoords(set)).map(|i| (set, i))) {
            Some((set, index)) => {
                let at = format!("{place}.attributes.TEXCOORD_{set}");
                let uvs = self.data.vectors::<2>(index, &at)?;
                if uvs.len() != positions.len() {
                    let right = format!("{}, as many as positions", positions.len());
                    return Err(Problem::range(format!("{at} count"), uvs.len() as f64, right));
                }
                uvs.into_iter().map(|[u, v]| [u, 1.0 - v]).collect()
            }
            None => Vec::new(),
        };
        Ok(Some(Part { positions, normals, uvs, triangles: triangles(mode, &order), material }))
    }
}

/// The corners of each triangle, counter-clockwise.
fn triangles(mode: Mode, order: &[usize]) -> Vec<[usize; 3]> {
    match mode {
        Mode::TriangleStrip => order
            .windows(3)
            .enumerate()
            .map(|(i, w)| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[0], w[2], w[1]] })
            .collect(),
        Mode::TriangleFan => match order {
            [middle, rim @ ..] => rim.windows(2).map(|w| [*middle, w[0], w[1]]).collect(),
            [] => Vec::new(),
        },
        _ => order.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    }
}

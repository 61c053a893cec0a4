//! Wavefront OBJ, with its materials in MTL.
//!
//! The crates at hand give no line where a face names a corner that isn't there, and single
//! precision only; the format is a word and some numbers a line, so it is read here.
//!
//! What it means for the model: no falloff and no cosines beside Lambert's, as the format's own
//! illumination models have it. Faces without normals that are in a smoothing group get the
//! normals of that group: at each corner the sum over the faces there, by area.

mod line;
mod mtl;

use std::collections::{BTreeMap, HashMap};

use crate::document::{
    Background, Body, Camera, Document, Material, Point, Rules, Shape, Span, Warning, add, cross,
    sub,
};
use crate::error::{Flaw, Problem};
use crate::mesh::{Faces, Skipped, frame, repeated};
use crate::read::Around;
use crate::words::Numbers;
use line::{Words, lines};

/// Words of the format whose meaning the model lacks, and what they are.
const WITHOUT: [(&str, &[&str]); 4] = [
    ("points and lines", &["p", "l"]),
    (
        "free-form curves and surfaces",
        &[
            "vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole",
            "scrv", "sp", "end", "con", "bzp", "cdc", "bsp", "cdp", "res",
        ],
    ),
    (
        "display and rendering hints",
        &[
            "mg",
            "bevel",
            "c_interp",
            "d_interp",
            "lod",
            "shadow_obj",
            "trace_obj",
            "ctech",
            "stech",
        ],
    ),
    ("texture maps by usemap", &["maplib", "usemap"]),
];

/// As far as texture coordinates may lie from the picture, which is repeated.
const FARTHEST_UV: f64 = 1e6;

/// Words that are read.
const WORDS: [&str; 9] = ["v", "vt", "vn", "f", "g", "o", "s", "mtllib", "usemtl"];

/// Reads a text in Wavefront's format; its materials lie beside `around`'s file.
///
/// # Errors
/// The first thing that is wrong with it, with its line.
pub fn parse(text: &str, around: &Around) -> Result<Document, Flaw> {
    let mut reader = Reader::new(around);
    for (line, text) in lines(text) {
        let mut words = Words::new(&text, line);
        if let Some(word) = words.next() {
            reader.entity(word, &mut words)?;
        }
    }
    reader.finish()
}

/// A corner as a face names it.
#[derive(Clone, Copy)]
struct Corner {
    position: usize,
    texture: Option<usize>,
    normal: Option<usize>,
}

/// A face, until all is read.
struct Face {
    corners: Vec<Corner>,
    material: Option<usize>,
    /// The smoothing group, 0 for none.
    group: u32,
    line: usize,
}

struct Reader<'a> {
    around: &'a Around,
    positions: Vec<Point>,
    normals: Vec<Point>,
    textures: Vec<[f64; 2]>,
    faces: Vec<Face>,
    materials: Vec<Material>,
    known: HashMap<String, usize>,
    current: Option<usize>,
    group: u32,
    warnings: Vec<Warning>,
    /// What was left out: its first line, and how often.
    without: BTreeMap<&'static str, (usize, usize)>,
}

impl<'a> Reader<'a> {
    fn new(around: &'a Around) -> Self {
        Self {
            around,
            positions: Vec::new(),
            normals: Vec::new(),
            textures: Vec::new(),
            faces: Vec::new(),
            materials: Vec::new(),
            known: HashMap::new(),
            current: None,
            group: 0,
            warnings: Vec::new(),
            without: BTreeMap::new(),
        }
    }

    fn entity(&mut self, word: &str, words: &mut Words<'_>) -> Result<(), Flaw> {
        match word {
            "v" => {
                self.positions.push(words.point("position")?);
                // A weight, or a colour, may follow.
                match words.next() {
                    None => {}
                    Some(weight) if words.next().is_none() => match weight.parse::<f64>() {
                        Ok(1.0) => {}
                        Ok(_) => self.leave_out("weights of positions other than 1", words.line),
                        Err(_) => return Err(words.found(weight, "a number (weight)")),
                    },
                    Some(_) => self.leave_out("colours of positions", words.line),
                }
                Ok(())
            }
            "vn" => {
                self.normals.push(words.point("normal")?);
                Ok(())
            }
            "vt" => {
                let u = words.number_in("texture u", -FARTHEST_UV, FARTHEST_UV)?;
                // A curve's texture has no v.
                let v = match words.next() {
                    None => 0.0,
                    Some(word) => Words::new(word, words.line).number_in(
                        "texture v",
                        -FARTHEST_UV,
                        FARTHEST_UV,
                    )?,
                };
                self.textures.push([u, v]);
                Ok(())
            }
            "f" | "fo" => self.face(words),
            // Names of parts: nothing here depends on them.
            "g" | "o" => Ok(()),
            "s" => {
                let group = words.next().ok_or_else(|| words.missing("smoothing group"))?;
                self.group = match group {
                    "off" => 0,
                    "on" => 1,
                    _ => group
                        .parse()
                        .map_err(|_| words.found(group, "a smoothing group's number, or off"))?,
                };
                Ok(())
            }
            "mtllib" => self.library(words),
            "usemtl" => {
                let name = words.name("material")?;
                self.current = match self.known.get(&name) {
                    Some(&index) => Some(index),
                    None => {
                        let text = format!("material \"{name}\" isn't known: grey instead");
                        self.warnings.push(Warning { line: words.line, text });
                        None
                    }
                };
                Ok(())
            }
            _ => {
                let strange = WITHOUT.iter().find(|(_, words)| words.contains(&word));
                let Some((what, _)) = strange else {
                    return Err(Problem::unknown("word", word, &WORDS).at(words.line));
                };
                self.leave_out(what, words.line);
                Ok(())
            }
        }
    }

    fn leave_out(&mut self, what: &'static str, line: usize) {
        self.without.entry(what).or_insert((line, 0)).1 += 1;
    }

    fn face(&mut self, words: &mut Words<'_>) -> Result<(), Flaw> {
        let mut corners = Vec::new();
        while let Some(word) = words.next() {
            corners.push(self.corner(word, words)?);
        }
        if corners.len() < 3 {
            let count = corners.len() as f64;
            return Err(Problem::range("number of corners", count, "3 or more").at(words.line));
        }
        let (material, group, line) = (self.current, self.group, words.line);
        self.faces.push(Face { corners, material, group, line });
        Ok(())
    }

    /// `position`, `position/texture`, `position//normal` or `position/texture/normal`.
    fn corner(&self, word: &str, words: &Words<'_>) -> Result<Corner, Flaw> {
        let mut parts = word.split('/');
        let mut index = |what: &str, count: usize| match parts.next() {
            None | Some("") => Ok(None),
            Some(text) => {
                let wanted = "position/texture/normal, each a whole number or nothing";
                let number: i64 = text.parse().map_err(|_| words.found(word, wanted))?;
                let found = match number {
                    1.. => usize::try_from(number - 1).ok(),
                    // Back from the latest.
                    _ => usize::try_from(number.unsigned_abs())
                        .ok()
                        .filter(|&back| back > 0)
                        .and_then(|back| count.checked_sub(back)),
                };
                found.filter(|&i| i < count).map(Some).ok_or_else(|| {
                    let right = match count {
                        0 => format!("left out: no {what} stands before it"),
                        _ => format!("1 to {count}, or -1 to -{count}"),
                    };
                    Problem::range(format!("{what} number"), number as f64, right).at(words.line)
                })
            }
        };
        let position = index("position", self.positions.len())?;
        let texture = index("texture coordinate", self.textures.len())?;
        let normal = index("normal", self.normals.len())?;
        let position =
            position.ok_or_else(|| words.found(word, "a corner that begins with a position"))?;
        Ok(Corner { position, texture, normal })
    }

    fn library(&mut self, words: &mut Words<'_>) -> Result<(), Flaw> {
        let names = words.name("material library")?;
        // Several may stand on the line; but names may have spaces, too.
        let whole = self.around.beside(&names).is_ok_and(|file| file.path().is_file());
        if whole || !names.contains(' ') {
            return self.one_library(&names, words);
        }
        names.split(' ').try_for_each(|name| self.one_library(name, words))
    }

    fn one_library(&mut self, name: &str, words: &Words<'_>) -> Result<(), Flaw> {
        let bytes = match self.around.beside(name).and_then(|file| file.bytes()) {
            Ok(bytes) => bytes,
            Err(problem) => {
                let text = format!("material library \"{name}\": {problem}; grey instead");
                self.warnings.push(Warning { line: words.line, text });
                return Ok(());
            }
        };
        let file = self.around.path().with_file_name(name);
        let Ok(text) = std::str::from_utf8(&bytes) else {
            return Err(Problem::NotText.anywhere().within(Some(&file)));
        };
        let library = mtl::parse(text, self.around).map_err(|flaw| flaw.within(Some(&file)))?;
        for material in library.materials {
            self.known.insert(material.name.clone(), self.materials.len());
            self.materials.push(material);
        }
        self.warnings.extend(library.warnings.into_iter().map(|warning| Warning {
            line: words.line,
            text: format!("{name}:{}: {}", warning.line, warning.text),
        }));
        Ok(())
    }

    fn finish(mut self) -> Result<Document, Flaw> {
        let smooth = self.smoothed();
        let mut shapes: Vec<Shape> = Vec::with_capacity(self.faces.len());
        let mut skipped: BTreeMap<Skipped, (usize, usize)> = BTreeMap::new();
        let mut grey = None;
        let mut bare: Option<(usize, usize)> = None;
        let mut partly: Option<(usize, usize)> = None;
        for face in &self.faces {
            let corners: Vec<Point> =
                face.corners.iter().map(|c| self.positions[c.position]).collect();
            let mut normals: Vec<Point> =
                face.corners.iter().filter_map(|c| Some(self.normals[c.normal?])).collect();
            if normals.is_empty() && face.group != 0 {
                let normal = |c: &Corner| smooth.get(&(c.position, face.group)).copied();
                normals = face.corners.iter().filter_map(normal).collect();
            }
            if !normals.is_empty() && normals.len() < corners.len() {
                partly.get_or_insert((face.line, 0)).1 += 1;
            }
            let textured = face.material.is_some_and(|m| self.materials[m].texture.is_some());
            let uvs: Vec<[f64; 2]> = match textured {
                true => {
                    face.corners.iter().filter_map(|c| Some(self.textures[c.texture?])).collect()
                }
                false => Vec::new(),
            };
            let uvs = repeated(uvs);
            if textured && uvs.len() < corners.len() {
                bare.get_or_insert((face.line, 0)).1 += 1;
            }
            let faces = Faces::of(&corners, &normals, &uvs);
            if let Some(why) = faces.skipped {
                skipped.entry(why).or_insert((face.line, 0)).1 += 1;
            }
            let material = *face.material.as_ref().unwrap_or_else(|| {
                grey.get_or_insert_with(|| {
                    self.materials.push(Material::matt(face.line));
                    self.materials.len() - 1
                })
            });
            // Without coordinates all of it shows one point of the picture.
            let mut uvs = faces.uvs.into_iter();
            let line = face.line;
            let shape = |body: Body| Shape { body, material, uv: uvs.next().flatten(), line };
            shapes.extend(faces.bodies.into_iter().map(shape));
        }
        if shapes.is_empty() {
            let what = "a face (f) with an area".to_string();
            return Err(Problem::Missing { what }.anywhere());
        }
        let mut warnings = self.warnings;
        warnings.extend(skipped.into_iter().map(|(why, (line, count))| Warning {
            line,
            text: format!("{count} faces {} (this is the first)", why.message()),
        }));
        warnings.extend(partly.map(|(line, count)| Warning {
            line,
            text: format!(
                "{count} faces have normals at some corners alone and are flat (this is the first)"
            ),
        }));
        warnings.extend(bare.map(|(line, count)| Warning {
            line,
            text: format!("{} (this is the first)", crate::mesh::bare(count)),
        }));
        warnings.extend(self.without.into_iter().map(|(what, (line, count))| Warning {
            line,
            text: format!("{what} aren't in the model: {count} left out (this is the first)"),
        }));
        let camera = Camera {
            eye: [0.0, 0.0, 1.0],
            look_at: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            angle: 45.0,
            span: Span::Edges,
        };
        let mut document = Document {
            indirect: None,
            camera,
            size: None,
            background: Background::Color([0.0; 3]),
            ambient: [0.0; 3],
            rules: Rules {
                specular_cosine: false,
                highlight_cosine: false,
                falloff: crate::document::Falloff::None,
                ..Rules::SLIDES
            },
            materials: self.materials,
            lights: Vec::new(),
            shapes,
            groups: Vec::new(),
            instances: Vec::new(),
            warnings,
            included: Vec::new(),
        };
        if !self.around.is_included() {
            frame(&mut document, false);
        }
        Ok(document)
    }

    /// The normals of corners in smoothing groups, not of unit length.
    fn smoothed(&self) -> HashMap<(usize, u32), Point> {
        let mut sums: HashMap<(usize, u32), Point> = HashMap::new();
        let without = |face: &&Face| {
            face.group != 0 && face.corners.iter().all(|corner| corner.normal.is_none())
        };
        for face in self.faces.iter().filter(without) {
            let at = |i: usize| self.positions[face.corners[i % face.corners.len()].position];
            // Twice the area, along the normal.
            let normal = (0..face.corners.len())
                .fold([0.0; 3], |sum, i| add(sum, cross(sub(at(i), at(0)), sub(at(i + 1), at(0)))));
            for corner in &face.corners {
                let sum = sums.entry((corner.position, face.group)).or_default();
                *sum = add(*sum, normal);
            }
        }
        sums
    }
}

//! Materials, and how shapes and checkers name them.

use std::path::{Path, PathBuf};

use super::table::{Table, Value};
use super::texture;
use crate::document::{Checker, Material, ShadowThrough};
use crate::error::{Flaw, Problem};
use crate::read::Around;

/// The largest coefficient that is no part of the light: diffuse, ambient, highlight.
const STRONGEST: f64 = 15.9;

/// The largest radiance.
const BRIGHTEST: f64 = 1000.0;

/// What a unit of length may absorb. What an arithmetic takes depends on the scale that it gives the
/// scene, and is asked when it is baked.
const DENSEST: f64 = 1e6;

/// The materials read so far, and the checkers that name others.
pub(super) struct Names<'d> {
    materials: Vec<Material>,
    /// The material, and its checker's table without the name of the other.
    checkers: Vec<(usize, Checker, Value<'d>)>,
    /// The material, and the name of the one that its texture shows.
    textures: Vec<(usize, Value<'d>)>,
    /// The materials of included files, by their places in the document.
    included: Vec<Borrowed>,
}

/// A material of another file.
struct Borrowed {
    name: String,
    index: usize,
    file: PathBuf,
}

impl<'d> Names<'d> {
    /// Reads all materials.
    pub(super) fn read(tables: &[Table<'d>], around: &Around) -> Result<Self, Flaw> {
        let mut names = Self {
            materials: Vec::new(),
            checkers: Vec::new(),
            textures: Vec::new(),
            included: Vec::new(),
        };
        for table in tables {
            names.add(table, around)?;
        }
        Ok(names)
    }

    /// The file's own materials, without their checkers.
    pub(super) fn own(&self) -> &[Material] {
        &self.materials
    }

    /// Makes the names of another file known, whose materials begin at `first`.
    pub(super) fn include(&mut self, materials: &[Material], first: usize, file: &Path) {
        let named = materials.iter().enumerate().filter(|(_, m)| !m.name.is_empty());
        self.included.extend(named.map(|(i, m)| Borrowed {
            name: m.name.clone(),
            index: first + i,
            file: file.to_owned(),
        }));
    }

    /// Puts the file's own checkers into its materials, which come first in the document.
    pub(super) fn link(&self, materials: &mut [Material]) -> Result<(), Flaw> {
        for (index, checker, other) in &self.checkers {
            let other = self.find(other)?;
            if other == *index {
                let why = "its two materials are the same";
                return Err(Problem::degenerate("checker", why).at(self.materials[other].line));
            }
            materials[*index].checker = Some(Checker { other, ..*checker });
        }
        for (index, name) in &self.textures {
            let other = self.find(name)?;
            if other == *index {
                let why = "its two materials are the same";
                return Err(Problem::degenerate("texture", why).at(name.line));
            }
            if let Some(texture) = &mut materials[*index].texture {
                texture.other = Some(other);
            }
        }
        Ok(())
    }

    /// The material that a shape names. Where the file has one material, it need not.
    pub(super) fn of(&self, shape: &Table<'_>) -> Result<usize, Flaw> {
        match shape.get("material") {
            Some(name) => self.find(&name),
            None if self.materials.len() == 1 && self.included.is_empty() => Ok(0),
            None => Err(shape.missing("key \"material\"")),
        }
    }

    /// The file's own material of this name; else that of the files that it includes.
    pub(super) fn find(&self, value: &Value<'_>) -> Result<usize, Flaw> {
        let name = value.text("material")?;
        if let Some(own) = self.materials.iter().position(|m| m.name == name) {
            return Ok(own);
        }
        let mut others = self.included.iter().filter(|m| m.name == name);
        match (others.next(), others.next()) {
            (Some(one), None) => Ok(one.index),
            (Some(one), Some(other)) if one.file == other.file => Ok(one.index),
            (Some(one), Some(other)) => {
                let [one, other] = [&one.file, &other.file].map(|f| f.display().to_string());
                let why = format!("both {one} and {other} have one of this name");
                let what = format!("material \"{}\"", crate::error::shown(name));
                Err(Problem::degenerate(what, why).at(value.line))
            }
            (None, _) => {
                let included = self.included.iter().map(|m| m.name.as_str());
                let own = self.materials.iter().map(|m| m.name.as_str());
                let known: Vec<&str> = own.chain(included).collect();
                Err(Problem::unknown("material", name, &known).at(value.line))
            }
        }
    }

    fn add(&mut self, table: &Table<'d>, around: &Around) -> Result<(), Flaw> {
        let name = table.need("name")?;
        let text = name.text("name")?;
        if let Some(first) = self.materials.iter().find(|m| m.name == text) {
            let what = format!("material \"{}\"", crate::error::shown(text));
            return Err(Problem::Twice { what, first: first.line }.at(name.line));
        }
        let like = Material::matt(table.line);
        let diffuse = table.color("diffuse", STRONGEST, like.diffuse)?;
        let index = table.number("index", 0.25..4.0, like.index_behind)?;
        let shadows = [
            ("opaque", ShadowThrough::Opaque),
            ("filtered", ShadowThrough::Filtered),
            ("none", ShadowThrough::None),
        ];
        let mut swap = None;
        let texture = match table.get("texture") {
            None => None,
            Some(value) => {
                let (texture, with) = texture::read(&value.table("texture")?, around)?;
                swap = with;
                Some(texture)
            }
        };
        let bump = match table.get("bump") {
            None => None,
            Some(value) => Some(texture::bump(&value.table("bump")?, around)?),
        };
        let material = Material {
            name: text.to_owned(),
            texture,
            bump,
            fresnel: table.flag("fresnel", like.fresnel)?,
            absorption_lines: ["absorption_front", "absorption"]
                .map(|key| table.get(key).map_or(table.line, |value| value.line)),
            absorption: [
                table.color("absorption_front", DENSEST, like.absorption[0])?,
                table.color("absorption", DENSEST, like.absorption[1])?,
            ],
            ambient: table.color("ambient", STRONGEST, diffuse)?,
            diffuse,
            specular: table.color("specular", STRONGEST, like.specular)?,
            shininess: table.number("shininess", 0.0..1e6, like.shininess)?,
            reflection: table.color("reflection", 1.0, like.reflection)?,
            transmission: table.color("transmission", 1.0, like.transmission)?,
            index_front: table.number("index_front", 0.25..4.0, like.index_front)?,
            index_behind: table.number("index_behind", 0.25..4.0, index)?,
            emission: table.color("emission", BRIGHTEST, like.emission)?,
            shadow: table.get("shadow").map_or(Ok(like.shadow), |v| v.word("shadow", &shadows))?,
            ..like
        };
        let ratio = material.index_behind / material.index_front;
        if !(0.25..=4.0).contains(&ratio) {
            let right = "0.25 to 4 (of index_behind to index_front)";
            return Err(Problem::range("ratio of the indices", ratio, right).at(table.line));
        }
        if let Some(value) = table.get("checker") {
            let checker = value.table("checker")?;
            self.checkers.push((self.materials.len(), pattern(&checker)?, checker.need("with")?));
            checker.done()?;
        }
        table.done()?;
        self.textures.extend(swap.map(|name| (self.materials.len(), name)));
        self.materials.push(material);
        Ok(())
    }
}

/// The cells; which material the others have is known once all are read.
fn pattern(table: &Table<'_>) -> Result<Checker, Flaw> {
    let cell = match table.get("size") {
        None => [1.0; 3],
        Some(value) => match value.number("size") {
            Ok(_) => [value.positive("size")?; 3],
            Err(_) => value.point("size")?,
        },
    };
    if cell.iter().any(|&c| c < 0.0) || cell == [0.0; 3] {
        let why = "its size must be positive along one axis, and 0 along those that don't count";
        return Err(Problem::degenerate("checker", why).at(table.line));
    }
    let offset = table.get("offset").map_or(Ok([0.0; 3]), |v| v.point("offset"))?;
    Ok(Checker { cell, offset, other: 0 })
}

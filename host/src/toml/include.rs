//! Other files within this one.

use super::material::Names;
use super::place;
use super::table::{Table, Value};
use crate::document::{Document, Misplaced, Transform};
use crate::error::{Flaw, Problem};
use crate::read::Around;

/// A file that was read, whose shapes and lights are yet to be placed behind the file's own.
pub(super) struct Part {
    document: Document,
    around: Around,
    copies: Vec<Transform>,
    /// The material that all of it gets instead of its own.
    material: Option<usize>,
    line: usize,
}

/// Reads the files that a scene includes, `include = "file"`, a list of names, or `[[include]]`,
/// and its meshes, `[[mesh]]`.
pub(super) fn all<'d>(
    scene: &Table<'d>,
    around: &Around,
    into: &mut Document,
    names: &mut Names<'d>,
) -> Result<Vec<Part>, Flaw> {
    let mut items = Vec::new();
    if let Some(value) = scene.get("include") {
        // One name is the short form of a list of one.
        let wanted = "the name of a file, a list of names, or [[include]]";
        let list = match value.text("include") {
            Ok(_) => vec![value],
            Err(_) => value.list("include", wanted)?,
        };
        items.extend(list.into_iter().map(|item| (item, "include")));
    }
    if let Some(value) = scene.get("mesh") {
        let list = value.list("mesh", "a list of tables, each under [[mesh]],")?;
        items.extend(list.into_iter().map(|item| (item, "mesh")));
    }
    let mut parts = Vec::new();
    let mut materials = Vec::new();
    // Where the materials will be, once the parts are placed one after the other.
    let mut first = into.materials.len();
    for (item, kind) in items {
        let (mut part, material) = one(&item, kind, around)?;
        if material.is_some() {
            part.document.materials.clear();
        }
        names.include(&part.document.materials, first, part.around.path());
        first += part.document.materials.len();
        parts.push(part);
        materials.push(material);
    }
    // Which may be any file's.
    for (part, material) in parts.iter_mut().zip(materials) {
        part.material = material.map(|name| names.find(&name)).transpose()?;
    }
    Ok(parts)
}

fn one<'d>(
    item: &Value<'d>,
    kind: &'static str,
    around: &Around,
) -> Result<(Part, Option<Value<'d>>), Flaw> {
    let (file, copies, material) = match item.table(kind) {
        Ok(table) => {
            let (file, copies) = (table.need("file")?, place::read(&table)?);
            let material = if kind == "mesh" { table.get("material") } else { None };
            table.done()?;
            (file, copies, material)
        }
        Err(flaw) if kind == "mesh" => return Err(flaw),
        Err(_) => (*item, vec![Transform::IDENTITY], None),
    };
    let name = file.text("file")?;
    let around = match around.beside(name) {
        Ok(around) => around,
        Err(Problem::Circle) => {
            let what = format!("{kind} \"{}\"", crate::error::shown(name));
            let why = "this file is within that one, by way of others or at once";
            return Err(Problem::degenerate(what, why).at(file.line));
        }
        Err(problem) => return Err(problem.at(file.line)),
    };
    let document = around.read().map_err(|flaw| match flaw.problem {
        // Nothing of the file was read: what is wrong is how it is named here.
        problem @ (Problem::Io(_) | Problem::Directory | Problem::Format { .. }) => {
            Problem::degenerate(around.path().display().to_string(), problem.to_string())
                .at(file.line)
        }
        _ => flaw.within(Some(around.path())),
    })?;
    Ok((Part { document, around, copies, material: None, line: item.line }, material))
}

impl Part {
    /// What its groups are called.
    pub(super) fn groups(&self) -> Vec<&str> {
        self.document.groups.iter().map(|group| group.name.as_str()).collect()
    }

    /// Adds the part's materials, shapes and lights to the scene.
    pub(super) fn place(&self, into: &mut Document) -> Result<(), Flaw> {
        let (file, line) = (self.around.path(), self.line);
        super::room(into.shapes.len() + self.copies.len() * self.document.shapes.len(), line)?;
        let before = into.shapes.len();
        into.include(&self.document, file, &self.copies).map_err(|misplaced| {
            let Misplaced { what, line, why } = misplaced;
            Problem::degenerate(what, why).at(line).within(Some(file))
        })?;
        for shape in &mut into.shapes[before..] {
            super::within(&shape.body, line)?;
            shape.material = self.material.unwrap_or(shape.material);
        }
        let noticed = self.document.warnings.iter().map(|inner| crate::document::Warning {
            line,
            text: match inner.line {
                0 => format!("{}: {}", file.display(), inner.text),
                at => format!("{}:{at}: {}", file.display(), inner.text),
            },
        });
        into.warnings.extend(noticed);
        Ok(())
    }
}

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
    line: usize,
}

/// Reads the files that a scene includes: `include = "file"`, a list of names, or `[[include]]`.
pub(super) fn all(
    scene: &Table<'_>,
    around: &Around,
    into: &mut Document,
    names: &mut Names<'_>,
) -> Result<Vec<Part>, Flaw> {
    let Some(value) = scene.get("include") else { return Ok(Vec::new()) };
    // One name is the short form of a list of one.
    let items = match value.text("include") {
        Ok(_) => vec![value],
        Err(_) => value.list("include", "the name of a file, a list of names, or [[include]]")?,
    };
    let mut parts = Vec::new();
    // Where the materials will be, once the parts are placed one after the other.
    let mut first = into.materials.len();
    for item in items {
        let part = one(&item, around)?;
        names.include(&part.document.materials, first, part.around.path());
        first += part.document.materials.len();
        parts.push(part);
    }
    Ok(parts)
}

fn one(item: &Value<'_>, around: &Around) -> Result<Part, Flaw> {
    let (file, copies) = match item.table("include") {
        Ok(table) => {
            let (file, copies) = (table.need("file")?, place::read(&table)?);
            table.done()?;
            (file, copies)
        }
        Err(_) => (*item, vec![Transform::IDENTITY]),
    };
    let name = file.text("include")?;
    let around = match around.beside(name) {
        Ok(around) => around,
        Err(Problem::Circle) => {
            let what = format!("include \"{}\"", crate::error::shown(name));
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
    Ok(Part { document, around, copies, line: item.line })
}

impl Part {
    /// Adds the part's materials, shapes and lights to the scene.
    pub(super) fn place(&self, into: &mut Document) -> Result<(), Flaw> {
        let (file, line) = (self.around.path(), self.line);
        super::room(into.shapes.len() + self.copies.len() * self.document.shapes.len(), line)?;
        let before = into.shapes.len();
        into.include(&self.document, file, &self.copies).map_err(|misplaced| {
            let Misplaced { what, line, why } = misplaced;
            Problem::degenerate(what, why).at(line).within(Some(file))
        })?;
        for shape in &into.shapes[before..] {
            super::within(&shape.body, line)?;
        }
        let noticed = self.document.warnings.iter().map(|inner| crate::document::Warning {
            line,
            text: format!("{}:{}: {}", file.display(), inner.line, inner.text),
        });
        into.warnings.extend(noticed);
        Ok(())
    }
}

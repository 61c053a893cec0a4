//! Solids: lists of shapes within lists.

use super::body;
use super::material::Names;
use super::table::Table;
use crate::document::{Body, Made, Shape, Solid};
use crate::error::{Flaw, Problem};

/// The most operands that the core takes.
const MOST: usize = 8;

type Combine = fn(Vec<Made>) -> Made;

/// What can be made of parts.
const WAYS: [(&str, Combine); 3] = [
    ("union", Made::Union),
    ("intersection", Made::Intersection),
    ("difference", Made::Difference),
];

/// What parts can be. Half-spaces lie behind planes.
const PARTS: [&str; 5] = ["sphere", "box", "cylinder", "cone", "plane"];

/// Reads a solid; `material` is that of parts that don't name one.
pub(super) fn read(table: &Table<'_>, names: &Names<'_>, material: usize) -> Result<Body, Flaw> {
    let mut operands = Vec::new();
    let Some(made) = combined(table, names, material, &mut operands)? else {
        return Err(table.missing("\"union\", \"intersection\" or \"difference\""));
    };
    let solid = Solid { operands, made };
    if solid.bounds().is_none() {
        let why = "it has no end: a shape that ends must hold it together";
        return Err(Problem::degenerate("solid", why).at(table.line));
    }
    Ok(Body::Solid(solid))
}

/// The union, intersection or difference that a table has, if it has one.
fn combined(
    table: &Table<'_>,
    names: &Names<'_>,
    material: usize,
    operands: &mut Vec<Shape>,
) -> Result<Option<Made>, Flaw> {
    let mut found = None;
    for (key, combine) in WAYS {
        let Some(value) = table.get(key) else { continue };
        if found.is_some() {
            let why = "it stands beside another way to combine: put one into the other's list";
            return Err(Problem::degenerate(key, why).at(value.line));
        }
        let list = value.list(key, "a list of parts { sphere = { … } }, …,")?;
        if list.is_empty() {
            let wanted = "a part or more".to_string();
            let found = format!("an empty list for \"{key}\"");
            return Err(Problem::Found { found, wanted }.at(value.line));
        }
        let mut parts = Vec::new();
        for item in list {
            let item = item.table("part")?;
            parts.push(part(&item, names, material, operands)?);
            item.done()?;
        }
        found = Some(combine(parts));
    }
    Ok(found)
}

/// One part: a shape, or parts combined.
fn part(
    table: &Table<'_>,
    names: &Names<'_>,
    material: usize,
    operands: &mut Vec<Shape>,
) -> Result<Made, Flaw> {
    let material = match table.get("material") {
        Some(_) => names.of(table)?,
        None => material,
    };
    let mut found = combined(table, names, material, operands)?;
    for (kind, read) in body::KINDS.into_iter().filter(|(kind, _)| PARTS.contains(kind)) {
        let Some(value) = table.get(kind) else { continue };
        if found.is_some() {
            let why = "a part is one shape: put each into the list by itself";
            return Err(Problem::degenerate(kind, why).at(value.line));
        }
        let shape = value.table(kind)?;
        let bodies = read(&shape)?;
        shape.done()?;
        for body in bodies {
            if let Some(why) = body.flaw() {
                return Err(Problem::degenerate(kind, why).at(shape.line));
            }
            if operands.len() == MOST {
                let count = (MOST + 1) as f64;
                let right = format!("at most {MOST}");
                return Err(
                    Problem::range("number of a solid's parts", count, right).at(shape.line)
                );
            }
            found = Some(Made::Of(operands.len()));
            operands.push(Shape { body, material, uv: None, line: shape.line });
        }
    }
    found.ok_or_else(|| {
        let known: Vec<&str> = PARTS.into_iter().chain(WAYS.map(|(key, _)| key)).collect();
        table.missing(&format!("shape ({})", known.join(", ")))
    })
}

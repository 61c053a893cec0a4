//! Where shapes and included files go: `scale`, `rotate`, `move`, `repeat`.

use super::table::{Table, Value};
use crate::document::{FARTHEST, Point, Transform, scaled};
use crate::error::{Flaw, Problem};

/// The most copies that one table may ask for.
const MOST: f64 = 1e6;

/// The placements that a table asks for: one, or one a copy.
pub(super) fn read(table: &Table<'_>) -> Result<Vec<Transform>, Flaw> {
    let pivot = table.get("pivot").map_or(Ok([0.0; 3]), |v| v.point("pivot"))?;
    let mut by = match table.get("scale") {
        Some(value) => Transform::scaled(scale(&value)?),
        None => Transform::IDENTITY,
    };
    if let Some(value) = table.get("rotate") {
        by = by.then(&rotation(&value)?);
    }
    by = by.about(pivot);
    let way = match (table.get("move"), table.get("translate")) {
        (Some(_), Some(second)) => {
            let why = "it stands beside \"move\", which means the same: keep one of them";
            return Err(Problem::degenerate("translate", why).at(second.line));
        }
        (Some(value), None) => value.point("move")?,
        (None, Some(value)) => value.point("translate")?,
        (None, None) => [0.0; 3],
    };
    by = by.then(&Transform::moved(way));
    let Some(value) = table.get("repeat") else { return Ok(vec![by]) };
    // One table is the short form of a list of one.
    let rows = match value.table("repeat") {
        Ok(row) => vec![row],
        Err(_) => {
            let wanted = "a table { count = …, step = [x, y, z] }, or a list of up to three,";
            let list = value.list("repeat", wanted)?;
            list.iter().map(|v| v.table("repeat")).collect::<Result<_, _>>()?
        }
    };
    if rows.is_empty() || rows.len() > 3 {
        let right = "1 to 3 (a list of tables)";
        let count = rows.len() as f64;
        return Err(Problem::range("number of directions", count, right).at(value.line));
    }
    let mut all = vec![by];
    for row in &rows {
        let steps = steps(row)?;
        if all.len() as f64 * steps.len() as f64 > MOST {
            let copies = all.len() as f64 * steps.len() as f64;
            let what = "number of copies";
            return Err(Problem::range(what, copies, format!("at most {MOST}")).at(row.line));
        }
        // The first direction runs fastest.
        all = steps.iter().flat_map(|step| all.iter().map(|by| by.then(step))).collect();
    }
    Ok(all)
}

/// The way of each copy in one direction from the place of the first.
fn steps(row: &Table<'_>) -> Result<Vec<Transform>, Flaw> {
    let count = row.need("count")?.count("count", 1, MOST as u32)?;
    let step = row.get("step").map(|v| v.point("step")).transpose()?;
    let turn = row.get("rotate").map(|v| Turn::read(&v)).transpose()?;
    let pivot = row.get("pivot").map_or(Ok([0.0; 3]), |v| v.point("pivot"))?;
    row.done()?;
    if step.is_none() && turn.is_none() {
        return Err(row.missing("\"step\" or \"rotate\""));
    }
    let turns = match &turn {
        Some(turn) => turn.powers(count),
        None => vec![Transform::IDENTITY; count as usize],
    };
    let step = step.unwrap_or_default();
    let all = turns.into_iter().enumerate();
    Ok(all.map(|(i, t)| t.about(pivot).then(&Transform::moved(scaled(step, i as f64)))).collect())
}

/// One factor, or one for each axis.
fn scale(value: &Value<'_>) -> Result<Point, Flaw> {
    let factors = match value.number("scale") {
        Ok(_) => [value.number_in("scale", -FARTHEST..FARTHEST)?; 3],
        Err(_) => value.point("scale")?,
    };
    match factors.into_iter().find(|f| f.abs() < 1.0 / FARTHEST) {
        Some(f) => {
            Err(Problem::range("scale", f, "larger than 0, or negative: mirrored").at(value.line))
        }
        None => Ok(factors),
    }
}

/// A rotation, which can be done again and again.
enum Turn {
    Axes(Point),
    Axis(Point, f64),
}

impl Turn {
    fn read(value: &Value<'_>) -> Result<Self, Flaw> {
        let Ok(table) = value.table("rotate") else {
            const WANTED: &str = "[x, y, z] in degrees, or { axis = [x, y, z], angle = degrees },";
            value.list("rotate", WANTED)?;
            return Ok(Self::Axes(value.point("rotate")?));
        };
        let axis = table.need("axis")?.direction("axis")?;
        let angle = table.need("angle")?.number_in("angle", -FARTHEST..FARTHEST)?;
        table.done()?;
        Ok(Self::Axis(axis, angle))
    }

    /// The rotation done once.
    fn once(&self) -> Transform {
        match *self {
            Self::Axis(axis, angle) => Transform::turned(axis, angle),
            Self::Axes(angles) => Transform::turned_about_axes(angles),
        }
    }

    /// The rotation done 0, 1, 2 … times. About one axis the angle is multiplied, which is exact
    /// at right angles.
    fn powers(&self, count: u32) -> Vec<Transform> {
        let times = (0..count).map(f64::from);
        match *self {
            Self::Axis(axis, angle) => times.map(|n| Transform::turned(axis, angle * n)).collect(),
            Self::Axes(angles) if angles.iter().filter(|a| **a != 0.0).count() <= 1 => {
                times.map(|n| Transform::turned_about_axes(scaled(angles, n))).collect()
            }
            Self::Axes(_) => {
                let once = self.once();
                let next = |all: &Transform| Some(all.then(&once));
                std::iter::successors(Some(Transform::IDENTITY), next)
                    .take(count as usize)
                    .collect()
            }
        }
    }
}

fn rotation(value: &Value<'_>) -> Result<Transform, Flaw> {
    Ok(Turn::read(value)?.once())
}

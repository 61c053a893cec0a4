//! Lights.

use super::FALLOFFS;
use super::table::Table;
use crate::document::{Falloff, Light, LightKind, sub};
use crate::error::{Flaw, Problem};

#[derive(Clone, Copy)]
enum Kind {
    Point,
    Directional,
    Spot,
}

const KINDS: [(&str, Kind); 3] =
    [("point", Kind::Point), ("directional", Kind::Directional), ("spot", Kind::Spot)];

/// Brighter than any light within a picture; keeps a slip from overflowing.
const BRIGHTEST: f64 = 1e9;

pub(super) fn read(table: &Table<'_>, default: Falloff) -> Result<Light, Flaw> {
    let kind = table.get("type").map_or(Ok(Kind::Point), |v| v.word("type", &KINDS))?;
    let intensity = table.number("intensity", 0.0..BRIGHTEST, 1.0)?;
    let color = table.color("color", BRIGHTEST, [1.0; 3])?.map(|c| c * intensity);
    let position = || table.need("position")?.point("position");
    let falloff = || table.get("falloff").map_or(Ok(default), |v| v.word("falloff", &FALLOFFS));
    let kind = match kind {
        Kind::Point => LightKind::Point { position: position()?, falloff: falloff()? },
        Kind::Directional => {
            LightKind::Directional { direction: table.need("direction")?.direction("direction")? }
        }
        Kind::Spot => {
            let position = position()?;
            let direction = match table.get("look_at") {
                Some(at) => sub(at.point("look_at")?, position),
                None => table.need("direction")?.direction("direction")?,
            };
            if direction == [0.0; 3] {
                let why = "it looks at the point where it stands";
                return Err(Problem::degenerate("spot light", why).at(table.line));
            }
            let outer = table.number("outer", 0.1..89.9, 30.0)?;
            let inner = table.number("inner", 0.0..89.0, outer * 0.8)?;
            if inner >= outer {
                let line = table.get("inner").map_or(table.line, |v| v.line);
                let right = format!("smaller than \"outer\", {outer}");
                return Err(Problem::range("inner", inner, right).at(line));
            }
            LightKind::Spot { position, direction, inner, outer, falloff: falloff()? }
        }
    };
    table.done()?;
    Ok(Light { kind, color, line: table.line })
}

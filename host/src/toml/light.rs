//! Lights.

use super::FALLOFFS;
use super::table::Table;
use crate::document::{Area, Falloff, Light, LightKind, Point, cross, dot, sub};
use crate::error::{Flaw, Problem};
use crate::polygon::{Parts, split};
use whitted::scene::{AreaLight, AreaLightSpec};

#[derive(Clone, Copy, Debug)]
enum Kind {
    Point,
    Directional,
    Spot,
    Rectangle,
    Triangle,
    Polygon,
    Disc,
    Sphere,
}

const KINDS: [(&str, Kind); 8] = [
    ("point", Kind::Point),
    ("directional", Kind::Directional),
    ("spot", Kind::Spot),
    ("rectangle", Kind::Rectangle),
    ("triangle", Kind::Triangle),
    ("polygon", Kind::Polygon),
    ("disc", Kind::Disc),
    ("sphere", Kind::Sphere),
];

/// The largest radiance of a surface that is seen.
const BRIGHTEST_SEEN: f64 = 1000.0;

/// Brighter than any light within a picture; keeps a slip from overflowing.
const BRIGHTEST: f64 = 1e9;

pub(super) fn read(table: &Table<'_>, default: Falloff) -> Result<Light, Flaw> {
    let kind = table.get("type").map_or(Ok(Kind::Point), |v| v.word("type", &KINDS))?;
    if let Kind::Rectangle | Kind::Triangle | Kind::Polygon | Kind::Disc | Kind::Sphere = kind {
        return area_light(table, kind);
    }
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
        _ => return area_light(table, kind),
    };
    table.done()?;
    Ok(Light { kind, color, line: table.line })
}

/// A light with an area.
fn area_light(table: &Table<'_>, kind: Kind) -> Result<Light, Flaw> {
    let visible = table.flag("visible", false)?;
    let most = if visible { BRIGHTEST_SEEN } else { BRIGHTEST };
    let color = table.need("radiance")?.color("radiance", most)?;
    let error = match table.get("error") {
        Some(value) => value.positive("error")?,
        None => AreaLightSpec::ERROR,
    };
    let samples = match table.get("samples") {
        Some(value) => {
            let wanted = "[least, most]";
            let list = value.list("samples", wanted)?;
            let [least, most] = list.as_slice() else {
                let found = format!("a list of {} for \"samples\"", list.len());
                return Err(Problem::Found { found, wanted: wanted.into() }.at(value.line));
            };
            let count = |v: &super::Value<'_>, least| {
                let most = AreaLight::<f64>::MOST_SAMPLES;
                v.count("samples", least, u32::from(most)).map(|n| n as u16)
            };
            let least = count(least, 1)?;
            [least, count(most, u32::from(least))?]
        }
        None => AreaLightSpec::SAMPLES,
    };
    let mut area = area(table, kind)?;
    if let Some(why) = area.body().flaw() {
        return Err(
            Problem::degenerate(format!("{kind:?} light").to_lowercase(), why).at(table.line)
        );
    }
    if !matches!(kind, Kind::Sphere | Kind::Disc)
        && let Some(at) = table.get("look_at")
    {
        turn(&mut area, at.point("look_at")?);
    }
    table.done()?;
    let kind = LightKind::Area { area, error, samples, visible };
    Ok(Light { kind, color, line: table.line })
}

fn area(table: &Table<'_>, kind: Kind) -> Result<Area, Flaw> {
    let point = |key| table.need(key)?.point(key);
    let polygon = |corners: &[Point], what: &str| match split(corners) {
        Ok(Parts::Convex(kept)) => Ok(kept.into_iter().map(|i| corners[i]).collect()),
        // Three corners, or as many that aren't on a line with their neighbours.
        Ok(Parts::Triangles(all)) if all.len() == 1 => {
            Ok(all.into_iter().flatten().map(|i| corners[i]).collect::<Vec<Point>>())
        }
        Ok(Parts::Triangles(_)) => {
            let why = "it is concave: a light must be convex";
            Err(Problem::degenerate(what, why).at(table.line))
        }
        Err(flaw) => Err(Problem::degenerate(what, flaw.message()).at(table.line)),
    };
    Ok(match kind {
        Kind::Rectangle => {
            let (corner, value) = (point("corner")?, table.need("edges")?);
            let wanted = "a list of two edges [[x, y, z], [x, y, z]]";
            let edges = value.points("edges", wanted)?;
            let Ok(edges) = <[Point; 2]>::try_from(edges.as_slice()) else {
                let found = format!("a list of {} for \"edges\"", edges.len());
                return Err(Problem::Found { found, wanted: wanted.into() }.at(value.line));
            };
            let area = Area::Rectangle { corner, edges };
            if let crate::document::Body::Polygon { corners } = area.body() {
                let _: Vec<Point> = polygon(&corners, "rectangle light")?;
            }
            area
        }
        Kind::Triangle => Area::Triangle { corners: table.need("corners")?.corners("corners")? },
        Kind::Disc => Area::Disc {
            center: point("center")?,
            normal: match table.get("look_at") {
                Some(at) => {
                    let normal = sub(at.point("look_at")?, point("center")?);
                    if normal == [0.0; 3] {
                        let why = "it looks at its own middle";
                        return Err(Problem::degenerate("disc light", why).at(table.line));
                    }
                    normal
                }
                None => table.need("normal")?.direction("normal")?,
            },
            radius: table.need("radius")?.positive("radius")?,
        },
        Kind::Sphere => Area::Sphere {
            center: point("center")?,
            radius: table.need("radius")?.positive("radius")?,
        },
        _ => {
            let corners = polygon(&table.corners()?, "polygon light")?;
            match <[Point; 3]>::try_from(corners.as_slice()) {
                Ok(corners) => Area::Triangle { corners },
                Err(_) => Area::Polygon { corners },
            }
        }
    })
}

/// Turns an area so that its front is on the side of a point.
fn turn(area: &mut Area, at: Point) {
    let behind = |a: Point, b: Point, c: Point| dot(cross(sub(b, a), sub(c, a)), sub(at, a)) < 0.0;
    match area {
        Area::Rectangle { corner, edges } => {
            if dot(cross(edges[0], edges[1]), sub(at, *corner)) < 0.0 {
                edges.swap(0, 1);
            }
        }
        Area::Triangle { corners: [a, b, c] } => {
            if behind(*a, *b, *c) {
                std::mem::swap(b, c);
            }
        }
        Area::Polygon { corners } => {
            if let [a, b, c, ..] = corners[..]
                && behind(a, b, c)
            {
                corners.reverse();
            }
        }
        // A disc has its normal from there, a sphere shines all around.
        Area::Disc { .. } | Area::Sphere { .. } => {}
    }
}

//! Shapes: a table of the kinds, and a function for each.

use super::table::Table;
use crate::document::{Body, FARTHEST, Point};
use crate::error::{Flaw, Problem};
use crate::polygon::{Parts, split};

type Read = fn(&Table<'_>) -> Result<Vec<Body>, Flaw>;

/// What the file calls each kind, and what reads it. The material is read elsewhere.
pub(super) const KINDS: [(&str, Read); 8] = [
    ("sphere", sphere),
    ("plane", plane),
    ("disc", disc),
    ("box", cuboid),
    ("triangle", triangle),
    ("polygon", polygon),
    ("cylinder", cylinder),
    ("cone", cone),
];

fn point(table: &Table<'_>, key: &'static str) -> Result<Point, Flaw> {
    table.need(key)?.point(key)
}

/// A radius whose sign says which side shows.
fn signed(table: &Table<'_>, key: &'static str) -> Result<f64, Flaw> {
    table.need(key)?.number_in(key, -FARTHEST..FARTHEST)
}

fn sphere(table: &Table<'_>) -> Result<Vec<Body>, Flaw> {
    let (center, radius) = (point(table, "center")?, table.need("radius")?);
    let inside = table.flag("inside_only", false)?;
    let radius = radius.positive("radius")?;
    Ok(vec![Body::Sphere { center, radius: if inside { -radius } else { radius } }])
}

fn plane(table: &Table<'_>) -> Result<Vec<Body>, Flaw> {
    let normal = table.need("normal")?.direction("normal")?;
    Ok(vec![Body::Plane { point: point(table, "point")?, normal }])
}

fn disc(table: &Table<'_>) -> Result<Vec<Body>, Flaw> {
    let normal = table.need("normal")?.direction("normal")?;
    let radius = table.need("radius")?.positive("radius")?;
    Ok(vec![Body::Disc { center: point(table, "center")?, normal, radius }])
}

fn cuboid(table: &Table<'_>) -> Result<Vec<Body>, Flaw> {
    Ok(vec![Body::Box { low: point(table, "min")?, high: point(table, "max")? }])
}

fn triangle(table: &Table<'_>) -> Result<Vec<Body>, Flaw> {
    let corners = table.need("corners")?.corners("corners")?;
    Ok(vec![match table.get("normals") {
        Some(normals) => Body::SmoothTriangle { corners, normals: normals.corners("normals")? },
        None => Body::Triangle { corners },
    }])
}

/// The texture coordinates of a triangle's corners.
pub(super) fn uv(table: &Table<'_>) -> Result<Option<[[f64; 2]; 3]>, Flaw> {
    const WANTED: &str = "a list of three [u, v]";
    /// The core's range.
    const FARTHEST_UV: f64 = 7.999;
    let Some(value) = table.get("uv") else { return Ok(None) };
    let wrong = |found: usize| {
        let found = format!("a list of {found} for \"uv\"");
        Problem::Found { found, wanted: WANTED.into() }.at(value.line)
    };
    let mut corners = [[0.0; 2]; 3];
    let list = value.list("uv", WANTED)?;
    if list.len() != 3 {
        return Err(wrong(list.len()));
    }
    for (corner, pair) in corners.iter_mut().zip(list) {
        let pair = pair.list("uv", WANTED)?;
        let [u, v] = pair.as_slice() else { return Err(wrong(pair.len())) };
        *corner = [
            u.number_in("uv", -FARTHEST_UV..FARTHEST_UV)?,
            v.number_in("uv", -FARTHEST_UV..FARTHEST_UV)?,
        ];
    }
    Ok(Some(corners))
}

fn polygon(table: &Table<'_>) -> Result<Vec<Body>, Flaw> {
    let corners = table.corners()?;
    match split(&corners) {
        Ok(Parts::Convex(kept)) => {
            Ok(vec![Body::Polygon { corners: kept.into_iter().map(|i| corners[i]).collect() }])
        }
        Ok(Parts::Triangles(triangles)) => {
            let body = |t: [usize; 3]| Body::Triangle { corners: t.map(|i| corners[i]) };
            Ok(triangles.into_iter().map(body).collect())
        }
        Err(flaw) => Err(Problem::degenerate("polygon", flaw.message()).at(table.line)),
    }
}

fn cylinder(table: &Table<'_>) -> Result<Vec<Body>, Flaw> {
    let (base, apex) = (point(table, "base")?, point(table, "apex")?);
    let (radius, capped) = (signed(table, "radius")?, table.flag("caps", false)?);
    Ok(vec![Body::Cylinder { base, apex, radius, capped }])
}

fn cone(table: &Table<'_>) -> Result<Vec<Body>, Flaw> {
    let (base, apex) = (point(table, "base")?, point(table, "apex")?);
    let base_radius = signed(table, "base_radius")?;
    let apex_radius = table.number("apex_radius", -FARTHEST..FARTHEST, 0.0)?;
    let capped = table.flag("caps", false)?;
    Ok(vec![if base_radius == apex_radius {
        Body::Cylinder { base, apex, radius: base_radius, capped }
    } else {
        Body::Cone { base, base_radius, apex, apex_radius, capped }
    }])
}

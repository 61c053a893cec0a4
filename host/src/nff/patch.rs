//! Polygons (`p`) and patches with normals (`pp`).

use super::Reader;
use crate::document::{Body, Point, Shape};
use crate::error::Flaw;
use crate::polygon::{NoPolygon, Parts, split};
use crate::words::Numbers;

/// More corners than any file has by intent; keeps a wrong count from reading on for ever.
const MOST_CORNERS: u32 = 100_000;

impl Reader<'_> {
    pub(super) fn polygon(&mut self, smooth: bool, line: usize) -> Result<(), Flaw> {
        let name = if smooth { "patch" } else { "polygon" };
        let count = self.tokens.count(&format!("{name} corner count"), 3, MOST_CORNERS)?;
        let (mut corners, mut normals): (Vec<Point>, Vec<Point>) = (Vec::new(), Vec::new());
        for i in 1..=count {
            corners.push(self.tokens.point(&format!("{name} corner {i}"))?);
            if smooth {
                normals.push(self.tokens.point(&format!("{name} normal {i}"))?);
            }
        }
        let material = self.current(line)?;
        let parts = match split(&corners) {
            Ok(parts) => parts,
            // SPD itself makes such patches, at a teapot's poles.
            Err(NoPolygon::NoArea) => {
                self.warn(line, format!("a {name} without area is skipped"));
                return Ok(());
            }
            Err(flaw @ NoPolygon::Tangled) => {
                let why = flaw.message();
                return Err(crate::error::Problem::degenerate(name, why).at(line));
            }
        };
        for body in bodies(parts, &corners, &normals) {
            if let Some(why) = body.flaw() {
                self.warn(line, format!("a part of a {name} is skipped: {why}"));
            } else {
                self.shapes.push(Shape { body, material, uv: None, line });
            }
        }
        Ok(())
    }
}

/// The shapes of a polygon's parts; smooth ones where there are normals.
fn bodies(parts: Parts, corners: &[Point], normals: &[Point]) -> Vec<Body> {
    let triangle = |t: [usize; 3]| {
        let corners = t.map(|i| corners[i]);
        match t.map(|i| normals.get(i).copied()) {
            [Some(a), Some(b), Some(c)] => Body::SmoothTriangle { corners, normals: [a, b, c] },
            _ => Body::Triangle { corners },
        }
    };
    match parts {
        Parts::Convex(kept) if normals.is_empty() => {
            vec![Body::Polygon { corners: kept.into_iter().map(|i| corners[i]).collect() }]
        }
        // A fan around the first corner.
        Parts::Convex(kept) => {
            kept[1..].windows(2).map(|w| triangle([kept[0], w[0], w[1]])).collect()
        }
        Parts::Triangles(triangles) => triangles.into_iter().map(triangle).collect(),
    }
}

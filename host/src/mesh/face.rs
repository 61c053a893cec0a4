//! From a mesh's faces to shapes.
//!
//! A face with normals at its corners becomes smooth triangles, unless the normals say no more
//! than the face does; one without stays a polygon where it is plane and convex, and is cut where
//! it isn't.

use crate::document::{Body, Point, cross, dot, normalized, sub};
use crate::polygon::{NoPolygon, Parts, split};

/// Normals nearer to the face's than this (1 − cosine, some tenth of a degree) make it flat: the
/// largest difference in shading is below a grey level.
const FLAT: f64 = 2e-6;

/// Why a face, or a part of it, became no shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Skipped {
    /// It has no area.
    NoArea,
    /// Its edges cross.
    Tangled,
}

impl Skipped {
    /// In words, after a number of faces.
    pub(crate) fn message(self) -> &'static str {
        match self {
            Self::NoArea => "without area skipped",
            Self::Tangled => "whose edges cross skipped",
        }
    }
}

/// The shapes of a face, and what of it was left out.
#[derive(Debug, Default)]
pub(crate) struct Faces {
    pub(crate) bodies: Vec<Body>,
    /// The texture coordinates of each body, where the face has some.
    pub(crate) uvs: Vec<Option<[[f64; 2]; 3]>>,
    pub(crate) skipped: Option<Skipped>,
}

impl Faces {
    /// Of a face with these corners, and as many normals or none, and as many texture coordinates
    /// or none: with these it becomes triangles, which alone have them.
    pub(crate) fn of(corners: &[Point], normals: &[Point], uvs: &[[f64; 2]]) -> Self {
        let flat = flat(corners, normals);
        let parts = match split(corners) {
            Ok(parts) => parts,
            Err(NoPolygon::NoArea) => return Self::none(Skipped::NoArea),
            Err(NoPolygon::Tangled) => return Self::none(Skipped::Tangled),
        };
        let uv = |t: [usize; 3]| match t.map(|i| uvs.get(i).copied()) {
            [Some(a), Some(b), Some(c)] if uvs.len() == corners.len() => Some([a, b, c]),
            _ => None,
        };
        let triangle = |t: [usize; 3]| {
            let at = t.map(|i| corners[i]);
            let body = match t.map(|i| normals.get(i).copied()) {
                [Some(a), Some(b), Some(c)] if !flat => {
                    Body::SmoothTriangle { corners: at, normals: [a, b, c] }
                }
                _ => Body::Triangle { corners: at },
            };
            (body, uv(t))
        };
        let bodies: Vec<_> = match parts {
            Parts::Convex(kept) if flat && uvs.len() != corners.len() => {
                let corners = kept.into_iter().map(|i| corners[i]).collect();
                vec![(Body::Polygon { corners }, None)]
            }
            // A fan around the first corner.
            Parts::Convex(kept) => {
                kept[1..].windows(2).map(|w| triangle([kept[0], w[0], w[1]])).collect()
            }
            Parts::Triangles(triangles) => triangles.into_iter().map(triangle).collect(),
        };
        let all = bodies.len();
        let (bodies, uvs): (Vec<_>, Vec<_>) =
            bodies.into_iter().filter(|(body, _)| body.flaw().is_none()).unzip();
        let skipped = (bodies.len() < all).then_some(Skipped::NoArea);
        Self { bodies, uvs, skipped }
    }

    fn none(why: Skipped) -> Self {
        Self { skipped: Some(why), ..Self::default() }
    }
}

/// Whether a face's normals say no more than the face itself.
fn flat(corners: &[Point], normals: &[Point]) -> bool {
    if normals.len() != corners.len() {
        return true;
    }
    let Some(face) = geometric(corners) else { return true };
    normals.iter().all(|&n| match normalized(n) {
        Some(n) => dot(n, face).abs() > 1.0 - FLAT,
        // What has no direction says nothing.
        None => true,
    })
}

/// The unit normal of a face, by Newell's sum.
pub(crate) fn geometric(corners: &[Point]) -> Option<Point> {
    let origin = *corners.first()?;
    let around = corners.iter().zip(corners.iter().cycle().skip(1));
    let sum = around.fold([0.0; 3], |sum, (&a, &b)| {
        crate::document::add(sum, cross(sub(a, origin), sub(b, origin)))
    });
    normalized(sum)
}

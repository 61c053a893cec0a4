//! Polygons as files have them, cut into what the core can trace.
//!
//! The plane is that of Newell's normal (Sutherland, Sproull and Schumacker 1974): the sum of
//! the cross products of successive corners, which is twice the area along each axis and so is
//! right for concave polygons too. In that plane a polygon is convex if it turns the same way at
//! each corner and goes around once; another one is cut by ear clipping (the `earcut` crate).

use earcut::Earcut;

use crate::document::{Point, add, cross, dot, length, scaled, sub};

/// How far from their plane corners may be, as a part of the polygon's extent: what six digits
/// in a text leave.
const FLAT: f64 = 2e-6;

/// The most corners that the core's polygon holds with a compact test; more go to triangles.
const MOST: usize = 64;

/// A polygon's parts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Parts {
    /// It is convex and plane: these of its corners are it.
    Convex(Vec<usize>),
    /// It had to be cut: three of its corners each.
    Triangles(Vec<[usize; 3]>),
}

/// Why a polygon is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoPolygon {
    /// Its corners lie on a line or a point.
    NoArea,
    /// Its edges cross, or its corners are far from any plane.
    Tangled,
}

impl NoPolygon {
    /// In words.
    pub fn message(self) -> &'static str {
        match self {
            Self::NoArea => "its corners lie on a line: it has no area",
            Self::Tangled => "its edges cross each other: list its corners around its border",
        }
    }
}

/// Cuts a polygon of at least three corners.
///
/// # Errors
/// It has no area, or its edges cross.
pub fn split(corners: &[Point]) -> Result<Parts, NoPolygon> {
    let origin = *corners.first().ok_or(NoPolygon::NoArea)?;
    let extent = corners.iter().map(|&c| length(sub(c, origin))).fold(0.0, f64::max);
    let kept = distinct(corners, extent);
    let normal = newell(corners, &kept, origin);
    let twice_area = length(normal);
    // As for triangles: thinner than this can't be told from a line.
    if kept.len() < 3 || twice_area.is_nan() || twice_area <= 1e-11 * extent * extent {
        return Err(NoPolygon::NoArea);
    }
    let normal = scaled(normal, 1.0 / twice_area);
    let plane = flatten(corners, &kept, origin, normal);
    let warp = kept.iter().map(|&i| dot(sub(corners[i], origin), normal).abs()).fold(0.0, f64::max);
    if kept.len() == 3 {
        return Ok(Parts::Triangles(vec![[kept[0], kept[1], kept[2]]]));
    }
    if warp <= FLAT * extent && kept.len() <= MOST && convex(&plane) {
        return Ok(Parts::Convex(kept));
    }
    clip(&plane, twice_area).map(|triangles| {
        Parts::Triangles(triangles.into_iter().map(|t| t.map(|i| kept[i])).collect())
    })
}

/// The corners without those that repeat their predecessor.
fn distinct(corners: &[Point], extent: f64) -> Vec<usize> {
    let near = 1e-12 * extent;
    let same = |a: usize, b: usize| length(sub(corners[a], corners[b])) <= near;
    let mut kept: Vec<usize> = Vec::with_capacity(corners.len());
    for i in 0..corners.len() {
        if kept.last().is_none_or(|&last| !same(last, i)) {
            kept.push(i);
        }
    }
    while kept.len() > 1 && same(kept[0], kept[kept.len() - 1]) {
        kept.pop();
    }
    kept
}

fn newell(corners: &[Point], kept: &[usize], origin: Point) -> Point {
    let around = kept.iter().zip(kept.iter().cycle().skip(1));
    around.fold([0.0; 3], |sum, (&i, &j)| {
        add(sum, cross(sub(corners[i], origin), sub(corners[j], origin)))
    })
}

/// The corners in the plane's own coordinates, counter-clockwise.
fn flatten(corners: &[Point], kept: &[usize], origin: Point, normal: Point) -> Vec<[f64; 2]> {
    // The axis least along the normal gives the best-conditioned second direction.
    let least = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs())).unwrap_or(0);
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    let u = cross(axis, normal);
    let u = scaled(u, 1.0 / length(u));
    let v = cross(normal, u);
    let flat = |&i: &usize| {
        let p = sub(corners[i], origin);
        [dot(p, u), dot(p, v)]
    };
    kept.iter().map(flat).collect()
}

fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
}

/// Turns left everywhere, or hardly to the right, and goes around once.
fn convex(plane: &[[f64; 2]]) -> bool {
    let n = plane.len();
    let mut around = 0.0;
    for i in 0..n {
        let (a, b, c) = (plane[i], plane[(i + 1) % n], plane[(i + 2) % n]);
        let (ab, bc) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
        let (sine, cosine) = (turn(a, b, c), ab[0] * bc[0] + ab[1] * bc[1]);
        if sine < 0.0 {
            return false;
        }
        around += sine.atan2(cosine);
    }
    // Once around is 2π; a star that turns left everywhere goes around twice.
    (around - std::f64::consts::TAU).abs() < 0.1
}

fn clip(plane: &[[f64; 2]], twice_area: f64) -> Result<Vec<[usize; 3]>, NoPolygon> {
    let mut indices: Vec<u32> = Vec::new();
    Earcut::new().earcut(plane.iter().copied(), &[], &mut indices);
    let mut covered = 0.0;
    let mut triangles = Vec::with_capacity(indices.len() / 3);
    for t in indices.chunks_exact(3) {
        let t = [t[0] as usize, t[1] as usize, t[2] as usize];
        let area = turn(plane[t[0]], plane[t[1]], plane[t[2]]);
        covered += area.abs();
        // Ears of no area come from corners in a line.
        if area > 1e-13 * twice_area {
            triangles.push(t);
        } else if area < -1e-13 * twice_area {
            triangles.push([t[0], t[2], t[1]]);
        }
    }
    // A simple polygon is covered exactly; one whose edges cross is not.
    if triangles.is_empty() || (covered - twice_area).abs() > 1e-6 * twice_area {
        return Err(NoPolygon::Tangled);
    }
    Ok(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn xy(points: &[[f64; 2]]) -> Vec<Point> {
        points.iter().map(|p| [p[0], p[1], 1.0]).collect()
    }

    #[test]
    fn a_square_stays_whole() {
        let square = xy(&[[0., 0.], [1., 0.], [1., 1.], [0., 1.]]);
        assert_eq!(split(&square), Ok(Parts::Convex(vec![0, 1, 2, 3])));
    }

    #[test]
    fn repeated_corners_are_dropped() {
        let square = xy(&[[0., 0.], [1., 0.], [1., 0.], [1., 1.], [0., 0.]]);
        assert_eq!(split(&square), Ok(Parts::Triangles(vec![[0, 1, 3]])));
    }

    #[test]
    fn an_arrow_is_cut_facing_as_before() {
        for flip in [1.0, -1.0] {
            let arrow = xy(&[[0., 0.], [2. * flip, -2.], [0., 3.], [-2. * flip, -2.]]);
            let Ok(Parts::Triangles(cut)) = split(&arrow) else { panic!("not cut") };
            assert_eq!(cut.len(), 2);
            for [a, b, c] in cut {
                let n = cross(sub(arrow[b], arrow[a]), sub(arrow[c], arrow[a]));
                assert!(n[2] * flip > 0.0);
            }
        }
    }

    #[test]
    fn what_is_no_polygon() {
        let line = xy(&[[0., 0.], [1., 0.], [2., 0.], [3., 0.]]);
        assert_eq!(split(&line), Err(NoPolygon::NoArea));
        assert_eq!(split(&[[1.0; 3]; 3]), Err(NoPolygon::NoArea));
        let bow = xy(&[[0., 0.], [3., 0.], [0., 1.], [2., 1.]]);
        assert_eq!(split(&bow), Err(NoPolygon::Tangled));
        let star: Vec<_> = (0..5)
            .map(|i| f64::from(i * 2) * std::f64::consts::TAU / 5.0)
            .map(|a| [a.cos(), a.sin()])
            .collect();
        assert_eq!(split(&xy(&star)), Err(NoPolygon::Tangled));
    }

    #[test]
    fn a_warped_quad_is_cut() {
        let quad = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.1], [0., 1., 0.]];
        assert!(matches!(split(&quad), Ok(Parts::Triangles(t)) if t.len() == 2));
    }
}

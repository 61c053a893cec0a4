//! Shapes.

use super::{Bounds, Point, Solid, add, cross, length, scaled, sub};

/// A shape: its geometry and its material.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// What it is.
    pub body: Body,
    /// The index of its material.
    pub material: usize,
    /// Of a triangle: the texture coordinates of its corners, u to the right and v upwards, the whole
    /// picture from 0 to 1.
    pub uv: Option<[[f64; 2]; 3]>,
    /// The line of the file that it starts on.
    pub line: usize,
}

impl Shape {
    /// Texture coordinates as a transform leaves them, which exchanges corners where it mirrors.
    pub(crate) fn uv_placed(uv: Option<[[f64; 2]; 3]>, mirrors: bool) -> Option<[[f64; 2]; 3]> {
        uv.map(|[a, b, c]| if mirrors { [a, c, b] } else { [a, b, c] })
    }

    /// Gives every material another index.
    pub fn rename(&mut self, index: &mut impl FnMut(usize) -> usize) {
        self.material = index(self.material);
        if let Body::Solid(solid) = &mut self.body {
            for operand in &mut solid.operands {
                operand.material = index(operand.material);
            }
        }
    }
}

/// The geometry of a shape.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// A sphere; a negative radius shows the inside alone.
    Sphere {
        /// Its middle.
        center: Point,
        /// Its radius, not 0.
        radius: f64,
    },
    /// An endless plane.
    Plane {
        /// A point on it.
        point: Point,
        /// Towards its front, of any length.
        normal: Point,
    },
    /// A flat disc.
    Disc {
        /// Its middle.
        center: Point,
        /// Towards its front, of any length.
        normal: Point,
        /// Its radius.
        radius: f64,
    },
    /// A box along the axes.
    Box {
        /// The corner with the smallest coordinates.
        low: Point,
        /// The corner with the largest.
        high: Point,
    },
    /// A triangle, counter-clockwise seen from its front.
    Triangle {
        /// Its corners.
        corners: [Point; 3],
    },
    /// A triangle with a normal at each corner.
    SmoothTriangle {
        /// Its corners.
        corners: [Point; 3],
        /// The normals there, of any length.
        normals: [Point; 3],
    },
    /// A convex, plane polygon, counter-clockwise seen from its front.
    Polygon {
        /// Its corners, four or more.
        corners: Vec<Point>,
    },
    /// A cylinder; a negative radius shows the inside alone.
    Cylinder {
        /// One end of the axis.
        base: Point,
        /// The other end.
        apex: Point,
        /// Its radius.
        radius: f64,
        /// Whether discs close it.
        capped: bool,
    },
    /// A cone, whole or cut; negative radii show the inside alone.
    Cone {
        /// One end of the axis.
        base: Point,
        /// The radius there.
        base_radius: f64,
        /// The other end.
        apex: Point,
        /// The radius there, 0 for a whole cone.
        apex_radius: f64,
        /// Whether discs close it.
        capped: bool,
    },
    /// Closed shapes united, intersected, taken from each other.
    Solid(Solid),
}

impl Body {
    /// What this kind is called, in the singular.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Sphere { .. } => "sphere",
            Self::Plane { .. } => "plane",
            Self::Disc { .. } => "disc",
            Self::Box { .. } => "box",
            Self::Triangle { .. } => "triangle",
            Self::SmoothTriangle { .. } => "smooth triangle",
            Self::Polygon { .. } => "polygon",
            Self::Cylinder { .. } => "cylinder",
            Self::Cone { .. } => "cone",
            Self::Solid(_) => "solid",
        }
    }

    /// The box around it; `None` for a plane.
    pub fn bounds(&self) -> Option<Bounds> {
        match self {
            Self::Sphere { center, radius } => Some(ball(*center, *radius)),
            Self::Plane { .. } => None,
            Self::Disc { center, normal, radius } => Some(ring(*center, *normal, *radius)),
            Self::Box { low, high } => Some(Bounds { low: *low, high: *high }),
            Self::Triangle { corners } | Self::SmoothTriangle { corners, .. } => {
                Bounds::around(corners)
            }
            Self::Polygon { corners } => Bounds::around(corners),
            Self::Cylinder { base, apex, radius, .. } => {
                let axis = sub(*apex, *base);
                Some(ring(*base, axis, *radius).union(ring(*apex, axis, *radius)))
            }
            Self::Cone { base, base_radius, apex, apex_radius, .. } => {
                let axis = sub(*apex, *base);
                Some(ring(*base, axis, *base_radius).union(ring(*apex, axis, *apex_radius)))
            }
            Self::Solid(solid) => solid.bounds(),
        }
    }

    /// Why the shape is none, if so: what is degenerate about it, and what would be right.
    pub fn flaw(&self) -> Option<&'static str> {
        match self {
            Self::Sphere { radius, .. } => {
                (*radius == 0.0).then_some("its radius is 0: it must be another number")
            }
            Self::Plane { normal, .. } => null(*normal),
            Self::Disc { normal, radius, .. } => {
                null(*normal).or((*radius <= 0.0).then_some("its radius must be larger than 0"))
            }
            Self::Box { low, high } => (0..3)
                .any(|i| low[i] >= high[i])
                .then_some("its min must lie below its max on each axis"),
            Self::Triangle { corners } => thin(corners),
            Self::SmoothTriangle { corners, normals } => {
                thin(corners).or(normals.iter().find_map(|&n| null(n)))
            }
            // Its maker, `polygon::split`, has looked.
            Self::Polygon { .. } => None,
            Self::Cylinder { base, apex, radius, .. } => {
                if *radius == 0.0 {
                    return Some("its radius is 0: it must be another number");
                }
                null(sub(*apex, *base)).map(|_| "its two ends are one point")
            }
            Self::Cone { base, base_radius, apex, apex_radius, .. } => {
                if *base_radius == 0.0 && *apex_radius == 0.0 {
                    return Some("both its radii are 0: one must be another number");
                }
                if base_radius * apex_radius < 0.0 {
                    return Some("its radii have different signs: give both the same");
                }
                null(sub(*apex, *base)).map(|_| "its two ends are one point")
            }
            // Its reader has looked at the parts.
            Self::Solid(_) => None,
        }
    }
}

fn null(v: Point) -> Option<&'static str> {
    (length(v) == 0.0).then_some("a normal is 0 0 0: it must have a direction")
}

/// Corners whose triangle is flatter than rounding lets tell from a line.
fn thin(corners: &[Point; 3]) -> Option<&'static str> {
    let [a, b, c] = *corners;
    let (ab, ac, bc) = (sub(b, a), sub(c, a), sub(c, b));
    let longest = length(ab).max(length(ac)).max(length(bc));
    // Twice the area over the square of the longest side is the height over that side; f64
    // coordinates of a few thousand sides away leave about 1e-12 of it.
    (length(cross(ab, ac)) <= 1e-11 * longest * longest)
        .then_some("its corners lie on a line: it has no area")
}

fn ball(center: Point, radius: f64) -> Bounds {
    let r = [radius.abs(); 3];
    Bounds { low: sub(center, r), high: add(center, r) }
}

/// A circle's box: along each axis it reaches r·√(1 − n²) from the centre.
fn ring(center: Point, axis: Point, radius: f64) -> Bounds {
    let n = super::normalized(axis).unwrap_or([0.0; 3]);
    let r = scaled(n.map(|x| (1.0 - x * x).max(0.0).sqrt()), radius.abs());
    Bounds { low: sub(center, r), high: add(center, r) }
}

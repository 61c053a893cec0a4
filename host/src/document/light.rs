//! Lights.

use super::{Body, Point, Rgb, Transform, add, scaled};

/// How a light weakens with distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Falloff {
    /// Not at all.
    None,
    /// By 1/r².
    InverseSquare,
}

/// Where a light's radiation comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum LightKind {
    /// A point that shines everywhere.
    Point {
        /// Where it is.
        position: Point,
        /// How it weakens.
        falloff: Falloff,
    },
    /// A light infinitely far away.
    Directional {
        /// The way its light goes, of any length.
        direction: Point,
    },
    /// A point that shines into a cone.
    Spot {
        /// Where it is.
        position: Point,
        /// The cone's axis, of any length.
        direction: Point,
        /// Up to this angle from the axis the light is whole, in degrees.
        inner: f64,
        /// From this angle on there is none, in degrees.
        outer: f64,
        /// How it weakens.
        falloff: Falloff,
    },
    /// An area that shines from its front.
    Area {
        /// Which.
        area: Area,
        /// The irradiance that a shadow ray may stand for.
        error: f64,
        /// The least and the most shadow rays from a point.
        samples: [u16; 2],
        /// Whether the camera and mirrors see it: whether a shape shows it.
        visible: bool,
    },
}

/// The shape of an area light.
#[derive(Clone, Debug, PartialEq)]
pub enum Area {
    /// A parallelogram; its front is where `edges[0] × edges[1]` points.
    Rectangle {
        /// A corner.
        corner: Point,
        /// The edges that start there.
        edges: [Point; 2],
    },
    /// A triangle, counter-clockwise seen from its front.
    Triangle {
        /// Its corners.
        corners: [Point; 3],
    },
    /// A convex polygon, counter-clockwise seen from its front.
    Polygon {
        /// Its corners.
        corners: Vec<Point>,
    },
    /// A disc.
    Disc {
        /// Its middle.
        center: Point,
        /// Towards its front, of any length.
        normal: Point,
        /// Its radius.
        radius: f64,
    },
    /// A sphere.
    Sphere {
        /// Its middle.
        center: Point,
        /// Its radius.
        radius: f64,
    },
}

impl Area {
    /// The shape with the same surface.
    pub fn body(&self) -> Body {
        match self {
            Self::Rectangle { corner, edges: [u, v] } => {
                let far = add(add(*corner, *u), *v);
                Body::Polygon { corners: vec![*corner, add(*corner, *u), far, add(*corner, *v)] }
            }
            Self::Triangle { corners } => Body::Triangle { corners: *corners },
            Self::Polygon { corners } => Body::Polygon { corners: corners.clone() },
            Self::Disc { center, normal, radius } => {
                Body::Disc { center: *center, normal: *normal, radius: *radius }
            }
            Self::Sphere { center, radius } => Body::Sphere { center: *center, radius: *radius },
        }
    }

    /// The area elsewhere, its front where it goes with it. Lengths must all grow by `scale`.
    #[must_use]
    pub fn placed(&self, by: &Transform, scale: f64) -> Self {
        match self {
            Self::Rectangle { corner, edges: [u, v] } => {
                let (u, v) = (by.direction(*u), by.direction(*v));
                let edges = if by.mirrors() { [v, u] } else { [u, v] };
                Self::Rectangle { corner: by.point(*corner), edges }
            }
            Self::Triangle { corners } => {
                let [a, b, c] = corners.map(|c| by.point(c));
                Self::Triangle { corners: if by.mirrors() { [a, c, b] } else { [a, b, c] } }
            }
            Self::Polygon { corners } => {
                let mut corners: Vec<Point> = corners.iter().map(|&c| by.point(c)).collect();
                if by.mirrors() {
                    corners.reverse();
                }
                Self::Polygon { corners }
            }
            Self::Disc { center, normal, radius } => Self::Disc {
                center: by.point(*center),
                normal: by.normal(*normal),
                radius: radius * scale,
            },
            Self::Sphere { center, radius } => {
                Self::Sphere { center: by.point(*center), radius: radius * scale }
            }
        }
    }

    /// Its middle, or nearly so.
    pub fn center(&self) -> Point {
        let mean = |corners: &[Point]| {
            let sum = corners.iter().fold([0.0; 3], |sum, &c| add(sum, c));
            scaled(sum, 1.0 / corners.len().max(1) as f64)
        };
        match self {
            Self::Rectangle { corner, edges: [u, v] } => add(*corner, scaled(add(*u, *v), 0.5)),
            Self::Triangle { corners } => mean(corners),
            Self::Polygon { corners } => mean(corners),
            Self::Disc { center, .. } | Self::Sphere { center, .. } => *center,
        }
    }
}

/// A light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// What kind it is.
    pub kind: LightKind,
    /// Its intensity divided by π (its irradiance divided by π where it doesn't weaken); an area's
    /// radiance.
    pub color: Rgb,
    /// The line of the file that it starts on.
    pub line: usize,
}

impl Light {
    /// Where it is, if it is anywhere.
    pub fn position(&self) -> Option<Point> {
        match &self.kind {
            LightKind::Point { position, .. } | LightKind::Spot { position, .. } => Some(*position),
            LightKind::Directional { .. } | LightKind::Area { .. } => None,
        }
    }

    /// The shape that shows it, if it is visible.
    pub fn body(&self) -> Option<Body> {
        match &self.kind {
            LightKind::Area { area, visible: true, .. } => Some(area.body()),
            _ => None,
        }
    }

    /// The points that must lie in the arithmetic's range.
    pub fn reach(&self) -> Vec<Point> {
        match &self.kind {
            LightKind::Area { area, .. } => {
                area.body().bounds().map_or_else(Vec::new, |bounds| vec![bounds.low, bounds.high])
            }
            _ => self.position().into_iter().collect(),
        }
    }

    /// How it weakens.
    pub fn falloff(&self) -> Falloff {
        match &self.kind {
            LightKind::Point { falloff, .. } | LightKind::Spot { falloff, .. } => *falloff,
            LightKind::Directional { .. } => Falloff::None,
            LightKind::Area { .. } => Falloff::InverseSquare,
        }
    }

    /// What this kind is called.
    pub fn name(&self) -> &'static str {
        match &self.kind {
            LightKind::Point { .. } => "point",
            LightKind::Directional { .. } => "directional",
            LightKind::Spot { .. } => "spot",
            LightKind::Area { area, .. } => match area {
                Area::Rectangle { .. } => "rectangle",
                Area::Triangle { .. } => "triangle",
                Area::Polygon { .. } => "polygon",
                Area::Disc { .. } => "disc",
                Area::Sphere { .. } => "sphere",
            },
        }
    }
}

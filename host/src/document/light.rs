//! Lights.

use super::{Point, Rgb};

/// How a light weakens with distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Falloff {
    /// Not at all.
    None,
    /// By 1/r².
    InverseSquare,
}

/// Where a light's radiation comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
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
}

/// A light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// What kind it is.
    pub kind: LightKind,
    /// Its intensity divided by π (its irradiance divided by π where it doesn't weaken).
    pub color: Rgb,
    /// The line of the file that it starts on.
    pub line: usize,
}

impl Light {
    /// Where it is, if it is anywhere.
    pub fn position(&self) -> Option<Point> {
        match self.kind {
            LightKind::Point { position, .. } | LightKind::Spot { position, .. } => Some(position),
            LightKind::Directional { .. } => None,
        }
    }

    /// How it weakens.
    pub fn falloff(&self) -> Falloff {
        match self.kind {
            LightKind::Point { falloff, .. } | LightKind::Spot { falloff, .. } => falloff,
            LightKind::Directional { .. } => Falloff::None,
        }
    }

    /// What this kind is called.
    pub fn name(&self) -> &'static str {
        match self.kind {
            LightKind::Point { .. } => "point",
            LightKind::Directional { .. } => "directional",
            LightKind::Spot { .. } => "spot",
        }
    }
}

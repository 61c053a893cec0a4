//! Where a scene is seen from.

use super::{Point, Size, cross, length, normalized, sub};

/// What the camera's angle spans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Span {
    /// From the picture's upper edge to its lower edge.
    Edges,
    /// From the centre of the top row of pixels to the centre of the bottom row (NFF).
    Centers,
}

/// A pinhole camera with square pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The pinhole.
    pub eye: Point,
    /// The point in the middle of the picture.
    pub look_at: Point,
    /// The direction that is up in the picture; need not be perpendicular to the view.
    pub up: Point,
    /// The vertical field of view, in degrees.
    pub angle: f64,
    /// From where to where the angle is measured.
    pub span: Span,
}

impl Camera {
    /// Whether the view has a direction and `up` another one; else what is wrong.
    pub fn flaw(&self) -> Option<&'static str> {
        let view = sub(self.look_at, self.eye);
        if length(view) == 0.0 {
            return Some("the camera looks at the point where it stands");
        }
        let Some((view, up)) = normalized(view).zip(normalized(self.up)) else {
            return Some("the camera's up direction is null");
        };
        // Nearer than a ten-thousandth of a degree the direction of up is rounding noise.
        (length(cross(view, up)) < 1e-6)
            .then_some("the camera's up direction lies along its view: which way is up is unknown")
    }

    /// The angle from edge to edge of a picture of this size, in degrees.
    ///
    /// A picture of one row has no distance between its first and last centre; there the angle
    /// is taken to span edges.
    pub fn edge_angle(&self, size: Size) -> f64 {
        if self.span == Span::Edges || size.height < 2 {
            return self.angle;
        }
        let rows = f64::from(size.height);
        let half = (self.angle.to_radians() / 2.0).tan() * rows / (rows - 1.0);
        2.0 * half.atan().to_degrees()
    }
}

//! A view and a light for files that have none.

use crate::document::{
    Bounds, Camera, Document, Light, LightKind, Point, Span, Warning, add, length, normalized,
    scaled, sub,
};

/// Where the eye is, from the middle: in front, a little to the right and above.
const FROM: Point = [0.45, 0.4, 1.0];
/// Where light comes from: above, on the eye's left.
const LIGHT: Point = [-0.6, 1.0, 0.7];
const ANGLE: f64 = 40.0;

/// Lets the camera see all shapes, and a light shine on them, where the file has none; says so.
pub(crate) fn frame(document: &mut Document, has_camera: bool) {
    let Some(bounds) = document.bounds() else { return };
    if !has_camera {
        document.camera = around(&bounds);
        let [x, y, z] = document.camera.eye;
        document.warnings.push(Warning {
            line: 0,
            text: format!("no camera: seen from {x:.3} {y:.3} {z:.3}, framing the bounds"),
        });
    }
    if document.lights.is_empty() {
        let direction = scaled(LIGHT, -1.0);
        let kind = LightKind::Directional { direction };
        document.lights.push(Light { kind, color: [0.9; 3], line: 0 });
        document.ambient = [0.15; 3];
        document.warnings.push(Warning {
            line: 0,
            text: "no light: lit from the upper left, with some light from everywhere".into(),
        });
    }
}

/// A camera that sees the ball around a box.
fn around(bounds: &Bounds) -> Camera {
    let middle = bounds.center();
    let radius = (length(sub(bounds.high, bounds.low)) / 2.0).max(f64::MIN_POSITIVE);
    let distance = radius / (ANGLE.to_radians() / 2.0).sin();
    let way = normalized(FROM).unwrap_or([0.0, 0.0, 1.0]);
    Camera {
        eye: add(middle, scaled(way, distance)),
        look_at: middle,
        up: [0.0, 1.0, 0.0],
        angle: ANGLE,
        span: Span::Edges,
    }
}

//! Going around a scene: the camera on a sphere around the point that it looks at.
//!
//! With u up, a from that point to the camera and perpendicular to u, and b = u × a, the camera
//! stands at distance r, turned by φ and lifted by θ, at r·(cos θ·(cos φ·a + sin φ·b) + sin θ·u).

use std::f64::consts::{FRAC_PI_2, TAU};

use whitted_host::document::{Camera, Point, add, cross, dot, length, normalized, scaled, sub};

/// How near the poles one comes: beyond them up would be down.
const NEAREST_POLE: f64 = 0.02;
/// How much nearer and farther one gets than the scene's own camera.
const ZOOM: std::ops::RangeInclusive<f64> = 1.0 / 32.0..=32.0;
/// What a click of the wheel does to the distance.
const CLICK: f64 = 0.9;

/// A camera that goes around.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Orbit {
    start: Camera,
    /// Radians to the right, around up.
    turn: f64,
    /// Radians upwards.
    lift: f64,
    /// The distance, in those of the start.
    zoom: f64,
}

impl Orbit {
    /// Where the scene's camera stands.
    pub(super) fn new(start: Camera) -> Self {
        Self { start, turn: 0.0, lift: 0.0, zoom: 1.0 }
    }

    /// Back where the scene's camera stands.
    #[must_use]
    pub(super) fn home(self) -> Self {
        Self::new(self.start)
    }

    /// The camera. One that hasn't moved is the scene's own, to the bit.
    pub(super) fn camera(&self) -> Camera {
        let Some((up, out, aside)) = self.frame().filter(|_| *self != Self::new(self.start)) else {
            return self.start;
        };
        let theta = self.height() + self.lift;
        let around = add(scaled(out, self.turn.cos()), scaled(aside, self.turn.sin()));
        let direction = add(scaled(around, theta.cos()), scaled(up, theta.sin()));
        let r = length(sub(self.start.eye, self.start.look_at)) * self.zoom;
        Camera { eye: add(self.start.look_at, scaled(direction, r)), up, ..self.start }
    }

    /// Turns and lifts the camera, in radians; it stops short of the poles.
    #[must_use]
    pub(super) fn moved(mut self, turn: f64, lift: f64) -> Self {
        self.turn = (self.turn + turn) % TAU;
        let height = self.height();
        // A scene whose own camera stands at a pole may stay there.
        let most = (FRAC_PI_2 - NEAREST_POLE).max(height.abs());
        self.lift = (height + self.lift + lift).clamp(-most, most) - height;
        self
    }

    /// Goes nearer by so many clicks of the wheel, or farther.
    #[must_use]
    pub(super) fn zoomed(mut self, clicks: f64) -> Self {
        self.zoom = (self.zoom * CLICK.powf(clicks)).clamp(*ZOOM.start(), *ZOOM.end());
        self
    }

    /// The start's angle above the horizon.
    fn height(&self) -> f64 {
        let offset = normalized(sub(self.start.eye, self.start.look_at));
        offset
            .zip(normalized(self.start.up))
            .map_or(0.0, |(d, u)| dot(d, u).clamp(-1.0, 1.0).asin())
    }

    /// u, a and b; a camera that looks along its up, which readers refuse, has none.
    fn frame(&self) -> Option<(Point, Point, Point)> {
        let up = normalized(self.start.up)?;
        let offset = sub(self.start.eye, self.start.look_at);
        let out = normalized(sub(offset, scaled(up, dot(offset, up))))?;
        Some((up, out, cross(up, out)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_4, PI};
    use whitted_host::document::Span;

    fn camera(eye: Point) -> Camera {
        let (look_at, up) = ([1.0, 2.0, 3.0], [0.0, 2.0, 0.0]);
        Camera { eye: add(look_at, eye), look_at, up, angle: 50.0, span: Span::Edges }
    }

    fn close(orbit: Orbit, eye: Point) {
        let is = sub(orbit.camera().eye, orbit.start.look_at);
        assert!(length(sub(is, eye)) < 1e-9, "{is:?} {eye:?}");
        assert_eq!(orbit.camera().flaw(), None);
    }

    #[test]
    fn nothing_moves_by_itself() {
        let start = Camera { up: [0.3, 0.9, 0.1], ..camera([0.1, 0.7, -4.0]) };
        assert_eq!(Orbit::new(start).camera(), start);
        assert_eq!(Orbit::new(start).moved(0.0, 0.0).camera().eye, start.eye);
    }

    #[test]
    fn by_hand() {
        let orbit = Orbit::new(camera([0.0, 0.0, -4.0]));
        close(orbit.moved(PI, 0.0), [0.0, 0.0, 4.0]);
        // y × −z = −x
        close(orbit.moved(FRAC_PI_2, 0.0), [-4.0, 0.0, 0.0]);
        let part = 8f64.sqrt();
        close(orbit.moved(0.0, FRAC_PI_4), [0.0, part, -part]);
        close(orbit.zoomed(1.0), [0.0, 0.0, -3.6]);
        close(orbit.zoomed(2.0).zoomed(-2.0).moved(0.1, 0.1).moved(-0.1, -0.1), [0.0, 0.0, -4.0]);
    }

    #[test]
    fn bounds_hold() {
        let orbit = Orbit::new(camera([0.0, 3.0, -4.0]));
        for lift in [10.0, -10.0] {
            let end = orbit.moved(0.3, lift).camera();
            assert_eq!(end.flaw(), None);
            let height = (end.eye[1] - end.look_at[1]) / 5.0;
            assert!((height.abs() - NEAREST_POLE.cos()).abs() < 1e-9);
        }
        let distance = |o: Orbit| length(sub(o.camera().eye, o.start.look_at));
        assert!((distance(orbit.zoomed(1e3)) - 5.0 / 32.0).abs() < 1e-9);
        assert!((distance(orbit.zoomed(-1e3)) - 160.0).abs() < 1e-9);
    }
}

//! Pinhole camera.
//!
//! The ray through (x, y), in pixels from the picture's upper left corner, goes along
//! forward + right·(2x − W)/H + down·(2y − H)/H: `right` and `down` are as long as the tangent of
//! half the vertical angle, so pixels are square whatever the picture's proportions.

use crate::math::{Arithmetic, cross_f64, for_each_arithmetic, spread, tan_degrees, unit_f64};
use crate::shape::{Leaving, Ray, ShapeError, ok_or_panic, point, some_or};

/// A pinhole camera.
#[derive(Clone, Copy, Debug)]
pub struct Camera<A: Arithmetic> {
    eye: [A::Length; 3],
    forward: [A::Aim; 3],
    right: [A::Aim; 3],
    down: [A::Aim; 3],
}

for_each_arithmetic! {
    macro_rules! aim {
        ($v:expr) => {{
            let v = $v;
            [
                some_or!(make::aim(v[0]), Direction),
                some_or!(make::aim(v[1]), Direction),
                some_or!(make::aim(v[2]), Direction),
            ]
        }};
    }

    impl Camera<A> {
        /// A camera at `eye` that looks at `at`, for scenes in `const`s. `angle` is the vertical
        /// field of view from edge to edge, in degrees; `up` need not be perpendicular.
        ///
        /// # Panics
        /// Where [`try_look_at`](Self::try_look_at) has an error.
        pub const fn look_at(eye: [f64; 3], at: [f64; 3], up: [f64; 3], angle: f64) -> Self {
            if !(angle > 0.0 && angle < 170.0) {
                panic!("the field of view lies between 0 and 170 degrees");
            }
            ok_or_panic!(Self::try_look_at(eye, at, up, tan_degrees(angle * 0.5)))
        }

        /// A camera at `eye` that looks at `at`; `tangent` is that of half the vertical field of
        /// view, from edge to edge.
        ///
        /// # Errors
        /// A position out of range; a tangent not in 0 to 16; `up` along the view, or no view.
        pub const fn try_look_at(
            eye: [f64; 3],
            at: [f64; 3],
            up: [f64; 3],
            tangent: f64,
        ) -> Result<Self, ShapeError> {
            if !(tangent > 0.0 && tangent < 16.0) {
                return Err(ShapeError::Size);
            }
            let forward = [at[0] - eye[0], at[1] - eye[1], at[2] - eye[2]];
            let forward = some_or!(unit_f64(forward), Direction);
            let up = some_or!(unit_f64(up), Direction);
            let right = cross_f64(forward, up);
            if !(right[0] * right[0] + right[1] * right[1] + right[2] * right[2] > 1e-12) {
                return Err(ShapeError::Direction);
            }
            let right = some_or!(unit_f64(right), Direction);
            let down = cross_f64(forward, right);
            let r = [right[0] * tangent, right[1] * tangent, right[2] * tangent];
            let d = [down[0] * tangent, down[1] * tangent, down[2] * tangent];
            Self::try_from_vectors(eye, forward, r, d)
        }

        /// A camera by its vectors, for views that `look_at` doesn't give: see the module.
        ///
        /// # Panics
        /// Where [`try_from_vectors`](Self::try_from_vectors) has an error.
        pub const fn from_vectors(
            eye: [f64; 3],
            forward: [f64; 3],
            right: [f64; 3],
            down: [f64; 3],
        ) -> Self {
            ok_or_panic!(Self::try_from_vectors(eye, forward, right, down))
        }

        /// A camera by its vectors.
        ///
        /// # Errors
        /// A position out of range, a component beyond ±16.
        pub const fn try_from_vectors(
            eye: [f64; 3],
            forward: [f64; 3],
            right: [f64; 3],
            down: [f64; 3],
        ) -> Result<Self, ShapeError> {
            Ok(Self {
                eye: point!(make, eye),
                forward: aim!(forward),
                right: aim!(right),
                down: aim!(down),
            })
        }
    }
}

/// A camera set up for pictures of one size: the steps from pixel to pixel.
#[derive(Clone, Copy, Debug)]
pub struct View<A: Arithmetic> {
    eye: [A::Length; 3],
    /// Towards the upper left corner.
    corner: [A::Aim; 3],
    /// A pixel to the right.
    across: [A::Aim; 3],
    /// A pixel down.
    down: [A::Aim; 3],
    /// What the middle ray's direction is like: most are like it.
    rise: u8,
}

/// What of a view is the same for a whole row.
#[derive(Clone, Copy, Debug)]
pub struct Row<A: Arithmetic> {
    start: [A::Aim; 3],
    place: u32,
    /// It is known that no sphere shows in it.
    pub(crate) clear: bool,
}

impl<A: Arithmetic> Row<A> {
    /// The pixels' row that it is in.
    #[inline(always)]
    pub(crate) fn number(&self) -> u32 {
        self.place >> 8
    }

    /// The place of a pixel in a tile of 4×4, x in the low two bits.
    #[inline(always)]
    pub fn in_tile(&self, x: u16) -> u8 {
        (self.place >> 8 & 3) as u8 * 4 + (x & 3) as u8
    }

    /// Another number for each place in the picture: where what is random about a ray comes from.
    #[inline(always)]
    pub fn key(&self, x: u16, fraction: u8) -> u32 {
        spread(self.place, u32::from(x) << 8 | u32::from(fraction))
    }
}

impl<A: Arithmetic> Camera<A> {
    /// Where its rays start.
    pub fn eye(&self) -> &[A::Length; 3] {
        &self.eye
    }
}

impl<A: Arithmetic> View<A> {
    /// The view for pictures of `width` × `height` pixels.
    pub fn new(camera: &Camera<A>, width: u16, height: u16) -> Self {
        let vectors = [camera.forward, camera.right, camera.down];
        let [forward, right, down] = A::fitted(vectors, width, height);
        let rows = u32::from(height);
        let step = |v: &[A::Aim; 3]| {
            let f = |a: A::Aim| A::aim_over(A::aim(a, a, 1, 0), rows);
            [f(v[0]), f(v[1]), f(v[2])]
        };
        let (across, step_down) = (step(&right), step(&down));
        // half the width, in pixels and 1/256 of them
        let (whole, part) = (i32::from(width) >> 1, (i32::from(width) & 1) << 7);
        let f = |i: usize| {
            let top = A::aim(forward[i], down[i], -1, 0);
            let left = A::aim(across[i], across[i], -2, 0);
            A::aim(top, left, whole, part)
        };
        let corner = [f(0), f(1), f(2)];
        let rise = A::rise(&forward);
        Self { eye: camera.eye, corner, across, down: step_down, rise }
    }

    /// Where its rays start.
    pub(crate) fn eye(&self) -> &[A::Length; 3] {
        &self.eye
    }

    /// The row of rays at `y` and `fraction`/256 pixels below the upper edge.
    #[inline(always)]
    pub fn row(&self, y: u16, fraction: u8) -> Row<A> {
        let f = |i: usize| A::aim(self.corner[i], self.down[i], i32::from(y), i32::from(fraction));
        let place = u32::from(y) << 8 | u32::from(fraction);
        Row { start: [f(0), f(1), f(2)], place, clear: false }
    }

    /// The ray at `x` and `fraction`/256 pixels right of the left edge.
    #[inline(always)]
    pub fn ray(&self, row: &Row<A>, x: u16, fraction: u8) -> Ray<A> {
        let f = |i: usize| A::aim(row.start[i], self.across[i], i32::from(x), i32::from(fraction));
        Ray {
            origin: self.eye,
            direction: A::sight(&[f(0), f(1), f(2)], self.rise),
            leaving: Leaving::NOTHING,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;

    #[test]
    fn corners_and_centre() {
        let camera = Camera::<f64>::look_at([0.0; 3], [0.0, 0.0, 2.0], [0.0, 1.0, 0.0], 90.0);
        let view = View::new(&camera, 4, 2);
        let at = |x, fx, y, fy| view.ray(&view.row(y, fy), x, fx).direction;
        let close = |a: [f64; 3], b: [f64; 3]| {
            let n = (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]).sqrt();
            (0..3).all(|i| (a[i] - b[i] / n).abs() < 1e-12)
        };
        // y up, z forward, so x grows to the left: the picture's right is −x
        assert!(close(at(2, 0, 1, 0), [0.0, 0.0, 1.0]));
        assert!(close(at(0, 0, 0, 0), [2.0, 1.0, 1.0]));
        assert!(close(at(4, 0, 2, 0), [-2.0, -1.0, 1.0]));
        assert!(close(at(1, 128, 0, 128), [0.5, 0.5, 1.0]));
    }

    #[test]
    fn fixed_rays_are_right_in_pictures_of_any_shape() {
        let (eye, at, up) = ([1.0, 2.0, -3.0], [0.5, -0.2, 9.0], [0.1, 1.0, 0.0]);
        for angle in [1.0, 20.0, 53.0, 90.0, 169.0] {
            for (width, height) in [(1, 1), (1, 2), (3, 1), (7, 200), (400, 9), (240, 240)] {
                let exact = Camera::<f64>::look_at(eye, at, up, angle);
                let fixed = Camera::<Fixed>::look_at(eye, at, up, angle);
                let (exact, fixed) =
                    (View::new(&exact, width, height), View::new(&fixed, width, height));
                for y in 0..=height {
                    for x in (0..=width).step_by(usize::from(1 + width / 50)) {
                        let a = exact.ray(&exact.row(y, 85), x, 43).direction;
                        let b = fixed.ray(&fixed.row(y, 85), x, 43).direction;
                        for i in 0..3 {
                            let off = (a[i] - b[i].to_num::<f64>()).abs();
                            assert!(off < 3.5e-5, "{angle}, {width}×{height}: {off} at {x}, {y}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn fixed_rays_are_unit_and_right() {
        let (eye, at) = ([1.0, 2.0, -3.0], [0.5, -0.2, 9.0]);
        let exact = Camera::<f64>::look_at(eye, at, [0.1, 1.0, 0.0], 60.0);
        let fixed = Camera::<Fixed>::look_at(eye, at, [0.1, 1.0, 0.0], 60.0);
        let (exact, fixed) = (View::new(&exact, 241, 161), View::new(&fixed, 241, 161));
        for y in (0..=161).step_by(7) {
            for x in (0..=241).step_by(5) {
                let a = exact.ray(&exact.row(y, 128), x, 128).direction;
                let b = fixed.ray(&fixed.row(y, 128), x, 128).direction;
                for i in 0..3 {
                    assert!((a[i] - b[i].to_num::<f64>()).abs() < 3.5e-5, "{x} {y}");
                }
            }
        }
    }
}

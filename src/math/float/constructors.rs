//! From `f64` to a float arithmetic's numbers: `None` for what is out of range or no number.

macro_rules! constructors {
    ($f:ident) => {
        pub(crate) mod $f {
            use super::super::FloatScale;
            use super::super::{FloatBarycentric, FloatEdge, FloatEta, FloatOutline, FloatRadius};

            const fn within(x: f64, low: f64, high: f64) -> Option<$f> {
                if x >= low && x <= high { Some(x as $f) } else { None }
            }

            pub(crate) const fn length(x: f64) -> Option<$f> {
                within(x, -1e8, 1e8)
            }

            /// The least and the largest length.
            pub(crate) const LEAST: $f = $f::NEG_INFINITY;
            pub(crate) const MOST: $f = $f::INFINITY;

            /// Whether a length is less than another.
            pub(crate) const fn below(a: $f, b: $f) -> bool {
                a < b
            }

            pub(crate) const fn unit(x: f64) -> Option<$f> {
                within(x, -1.0001, 1.0001)
            }

            pub(crate) const fn weight(x: f64) -> Option<$f> {
                within(x, 0.0, 15.999)
            }

            pub(crate) const fn radiance(x: f64) -> Option<$f> {
                within(x, 0.0, 1024.0)
            }

            pub(crate) const fn radius(r: f64) -> Option<FloatRadius<$f>> {
                if !(r >= 1e-8 && r <= 1e8) {
                    return None;
                }
                Some(FloatRadius { r: r as $f, reciprocal: (1.0 / r) as $f })
            }

            pub(crate) const fn middle_and_slope(low: $f, high: $f) -> ($f, $f) {
                ((low + high) * 0.5, (high - low) * 0.5)
            }

            pub(crate) const fn intensity(x: f64) -> Option<$f> {
                within(x, 0.0, 1e12)
            }

            pub(crate) const fn from_intensity(x: &$f) -> f64 {
                *x as f64
            }

            pub(crate) const fn exponent(n: f64) -> Option<$f> {
                within(n, 0.0, 1e6)
            }

            pub(crate) const fn eta(x: f64) -> Option<FloatEta<$f>> {
                if !(x >= 0.25 && x <= 3.999) {
                    return None;
                }
                Some(FloatEta(x as $f))
            }

            pub(crate) const fn decay(x: f64) -> Option<$f> {
                within(x, 0.0, crate::math::DENSEST)
            }

            pub(crate) const fn aim(x: f64) -> Option<$f> {
                within(x, -16.0, 16.0)
            }

            /// From the second and third corner relative to the first, and the largest
            /// coordinate of all.
            pub(crate) const fn barycentric(
                b: [f64; 2],
                c: [f64; 2],
                reach: f64,
            ) -> Option<FloatBarycentric<$f>> {
                let det = b[0] * c[1] - b[1] * c[0];
                let size2 = b[0] * b[0] + b[1] * b[1] + c[0] * c[0] + c[1] * c[1];
                let area = if det < 0.0 { -det } else { det };
                if !(area > size2 * 1e-7) || !(size2 < 1e16) {
                    return None;
                }
                let second = [c[1] / det, -c[0] / det];
                let third = [-b[1] / det, b[0] / det];
                Some(FloatBarycentric {
                    second: [second[0] as $f, second[1] as $f],
                    third: [third[0] as $f, third[1] as $f],
                    slack: [slack(&second) as $f, slack(&third) as $f],
                    reach: reach as $f,
                })
            }

            /// The second and third corner again, and by what they may be wrong.
            pub(crate) const fn corners(form: &FloatBarycentric<$f>) -> ([f64; 2], [f64; 2], f64) {
                let second = [form.second[0] as f64, form.second[1] as f64];
                let third = [form.third[0] as f64, form.third[1] as f64];
                let error = [slack(&second), slack(&third)];
                let step = $f::EPSILON as f64;
                crate::math::inverted(second, third, (error[0] + error[1]) * step)
            }

            pub(crate) const fn normal(n: [f64; 3]) -> [$f; 3] {
                [n[0] as $f, n[1] as $f, n[2] as $f]
            }

            /// From half the sides of the rectangle and the largest coordinate of all.
            pub(crate) const fn outline(half: [f64; 2], reach: f64) -> FloatOutline<$f> {
                FloatOutline { half: [half[0] as $f, half[1] as $f], reach: reach as $f }
            }

            /// Half the sides of the rectangle.
            pub(crate) const fn half(outline: &FloatOutline<$f>) -> [f64; 2] {
                [outline.half[0] as f64, outline.half[1] as f64]
            }

            /// The half plane that `inward` points into from the point `at`; everything for
            /// a null vector.
            pub(crate) const fn edge(
                inward: [f64; 2],
                at: [f64; 2],
                _: &FloatOutline<$f>,
            ) -> FloatEdge<$f> {
                let n = match crate::math::unit_f64([inward[0], inward[1], 0.0]) {
                    Some(n) => n,
                    None => [0.0; 3],
                };
                let n = [n[0] as $f, n[1] as $f];
                let offset = -(n[0] as f64 * at[0] + n[1] as f64 * at[1]);
                FloatEdge { normal: n, offset: offset as $f }
            }

            /// From a rotation's rows, which must be of unit length and at right angles.
            pub(crate) const fn rotation(r: &[[f64; 3]; 3]) -> [[$f; 3]; 3] {
                let mut made = [[0.0; 3]; 3];
                let mut i = 0;
                while i < 9 {
                    made[i / 3][i % 3] = r[i / 3][i % 3] as $f;
                    i += 1;
                }
                made
            }

            pub(crate) const fn scale(s: f64) -> Option<FloatScale<$f>> {
                if !(s >= 1e-6 && s <= 1e6) {
                    return None;
                }
                Some(FloatScale { factor: s as $f, reciprocal: (1.0 / s) as $f })
            }

            pub(crate) const fn from_length(x: $f) -> f64 {
                x as f64
            }

            pub(crate) const fn from_unit(x: $f) -> f64 {
                x as f64
            }

            pub(crate) const fn from_radius(r: &FloatRadius<$f>) -> f64 {
                r.r as f64
            }

            /// A sum of few coordinates: twice their range and more.
            pub(crate) const fn sum(x: f64) -> $f {
                x as $f
            }

            /// A coordinate, in range or not, in steps of 2^`log2_step`.
            pub(crate) const fn grid(x: f64, log2_step: i8) -> i32 {
                let y = x / f64_power_of_two(log2_step);
                (if y < 0.0 { y - 0.5 } else { y + 0.5 }) as i32
            }

            const fn slack(form: &[f64; 2]) -> f64 {
                let abs = [
                    if form[0] < 0.0 { -form[0] } else { form[0] },
                    if form[1] < 0.0 { -form[1] } else { form[1] },
                ];
                abs[0] + abs[1]
            }

            /// A coordinate in steps of 2^`log2_step`, rounded to nearest.
            pub(crate) const fn to_grid(x: $f, log2_step: i8) -> i32 {
                let y = x as f64 / f64_power_of_two(log2_step);
                (if y < 0.0 { y - 0.5 } else { y + 0.5 }) as i32
            }

            /// The coordinate of a step of the grid.
            pub(crate) const fn from_grid(x: i32, log2_step: i8) -> $f {
                (x as f64 * f64_power_of_two(log2_step)) as $f
            }

            /// For `Arithmetic::cells_before`: one over a cell's side of `mantissa << shift` steps.
            pub(crate) const fn per_cell(mantissa: u8, shift: u8, log2_step: i8) -> $f {
                let side = ((mantissa as u32) << shift) as f64 * f64_power_of_two(log2_step);
                (1.0 / side) as $f
            }

            const fn f64_power_of_two(n: i8) -> f64 {
                f64::from_bits(((1023 + n as i64) as u64) << 52)
            }

            /// 2^n, for n from −126: a walk asks for it, so no loop.
            pub(crate) const fn power_of_two(n: i8) -> $f {
                f32::from_bits(((127 + n as i32) as u32) << 23) as $f
            }
        }
    };
}
constructors!(f32);
constructors!(f64);

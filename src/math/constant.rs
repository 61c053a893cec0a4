//! Functions of `f64` that can be evaluated in a `const`, where `core` and `libm` have none.
//! They serve scenes written as `static`s; they are ordinary IEEE arithmetic, so a target
//! computes the same bits at run time as the compiler does.

/// The most that a unit of length may absorb: nothing that one sees is left after a tenth of that.
pub(crate) const DENSEST: f64 = 170.0;

/// The square root, to the last bit or its neighbour; 0 for what has none.
pub(crate) const fn sqrt(x: f64) -> f64 {
    if !(x > 0.0) || x == f64::INFINITY {
        return if x == f64::INFINITY { x } else { 0.0 };
    }
    // Halving the exponent gives a start within 6 %, Newton doubles the digits at each step.
    let mut y = f64::from_bits((x.to_bits() >> 1) + (1023u64 << 51));
    let mut i = 0;
    while i < 6 {
        y = 0.5 * (y + x / y);
        i += 1;
    }
    y
}

/// The tangent of an angle in degrees, 0 ≤ angle < 90, to 1e-14: the quotient of the series of
/// sine and cosine.
pub const fn tan_degrees(angle: f64) -> f64 {
    let (sin, cos) = series(angle * (core::f64::consts::PI / 180.0));
    sin / cos
}

/// Sine and cosine of an angle in degrees, to 1e-14, and exact at right angles; no numbers for
/// angles beyond a million.
pub(crate) const fn sin_cos_degrees(angle: f64) -> (f64, f64) {
    if !(angle >= -1e6 && angle <= 1e6) {
        return (f64::NAN, f64::NAN);
    }
    // what remains beside a number of right angles, −45 to 45
    let turns = angle / 90.0;
    let quarter = (if turns < 0.0 { turns - 0.5 } else { turns + 0.5 }) as i32;
    let (sin, cos) = series((angle - quarter as f64 * 90.0) * (core::f64::consts::PI / 180.0));
    match quarter & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// Sine and cosine by their series.
const fn series(x: f64) -> (f64, f64) {
    let x2 = x * x;
    let (mut sin, mut cos) = (0.0, 0.0);
    let mut term = 1.0;
    let mut n = 0;
    while n < 32 {
        cos += term;
        term *= x / (n + 1) as f64;
        sin += term;
        term *= -x / (n + 2) as f64;
        n += 2;
        if x2 == 0.0 {
            break;
        }
    }
    (sin, cos)
}

/// The unit vector along `v`; `None` for a null vector or one that isn't of numbers.
pub(crate) const fn unit_vector(v: [f64; 3]) -> Option<[f64; 3]> {
    // Scaled by the largest component first: the squares of a direction given as 1e-200 vanish.
    let mut largest = 0.0;
    let mut i = 0;
    while i < 3 {
        let a = if v[i] < 0.0 { -v[i] } else { v[i] };
        if !(a <= f64::MAX) {
            return None;
        }
        if a > largest {
            largest = a;
        }
        i += 1;
    }
    if largest == 0.0 {
        return None;
    }
    let v = [v[0] / largest, v[1] / largest, v[2] / largest];
    let length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    Some([v[0] / length, v[1] / length, v[2] / length])
}

/// `a × b`.
pub(crate) const fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The vectors b and c of the plane for which the linear forms are 1 and 0, 0 and 1; and by
/// what their components may be wrong if `error` is the sum of what one coefficient of each
/// form may be wrong.
pub(crate) const fn inverted(
    second: [f64; 2],
    third: [f64; 2],
    error: f64,
) -> ([f64; 2], [f64; 2], f64) {
    let det = second[0] * third[1] - second[1] * third[0];
    let b = [third[1] / det, -third[0] / det];
    let c = [-second[1] / det, second[0] / det];
    let mut size = 0.0;
    let all = [b[0], b[1], c[0], c[1]];
    let mut i = 0;
    while i < 4 {
        let x = if all[i] < 0.0 { -all[i] } else { all[i] };
        size = if x > size { x } else { size };
        i += 1;
    }
    // The inverse's change is −M⁻¹·E·M⁻¹, each entry of M⁻¹ at most the size; doubled for what
    // is not linear in E.
    (b, c, 4.0 * size * size * error)
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;

    #[test]
    fn roots_are_within_one_step() {
        for i in 1..20_000u32 {
            let x = f64::from(i).powi(5) * 1e-11;
            let (a, b) = (sqrt(x), x.sqrt());
            assert!((a - b).abs() <= b * 2.3e-16, "{x}: {a} {b}");
        }
        assert_eq!(sqrt(0.0), 0.0);
        assert_eq!(sqrt(-1.0), 0.0);
        assert_eq!(sqrt(f64::NAN), 0.0);
    }

    #[test]
    fn sines() {
        for i in -9000..9000 {
            let a = f64::from(i) * 0.1;
            let (sin, cos) = sin_cos_degrees(a);
            let (s, c) = a.to_radians().sin_cos();
            assert!((sin - s).abs() <= 1e-13 && (cos - c).abs() <= 1e-13, "{a}");
        }
        assert_eq!(sin_cos_degrees(-90.0), (-1.0, 0.0));
        assert_eq!(sin_cos_degrees(180.0), (0.0, -1.0));
        assert!(sin_cos_degrees(f64::INFINITY).0.is_nan());
    }

    #[test]
    fn tangents() {
        for i in 0..895 {
            let a = f64::from(i) * 0.1;
            let t = a.to_radians().tan();
            assert!((tan_degrees(a) - t).abs() <= 1e-12 * (1.0 + t * t), "{a}");
        }
    }
}

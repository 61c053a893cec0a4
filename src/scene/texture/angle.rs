//! Angles of vectors of integers by rotation in smaller and smaller steps, without a product (Volder,
//! "The CORDIC trigonometric computing technique", 1959).
//!
//! The vector (x, y) is turned by ±atan 2⁻ⁱ towards the x axis, i = 0, 1, 2…; the turns sum to its
//! angle, and its length has grown by the same factor whatever the signs were.

/// The steps: each adds a bit.
const STEPS: usize = 18;

/// atan 2⁻ⁱ, a whole turn being 2³².
static TURNS_Q32: [u32; STEPS] = {
    let mut table = [0; STEPS];
    table[0] = 1 << 29;
    let mut i = 1;
    let mut x = 0.5;
    while i < STEPS {
        // x − x³/3 + x⁵/5 − …
        let (mut sum, mut term, mut k) = (0.0, x, 0);
        while k < 40 {
            sum += term / (2 * k + 1) as f64;
            term = -term * x * x;
            k += 1;
        }
        table[i] = (sum / core::f64::consts::TAU * 4294967296.0 + 0.5) as u32;
        x *= 0.5;
        i += 1;
    }
    table
};

/// The product of √(1 + 4⁻ⁱ), in Q16: by how much the vector grows.
const GROWTH_Q16: i64 = {
    let (mut square, mut i, mut power) = (1.0, 0, 1.0);
    while i < STEPS {
        square *= 1.0 + power;
        power *= 0.25;
        i += 1;
    }
    (crate::math::sqrt_f64(square) * 65536.0 + 0.5) as i64
};

/// The angle of (x, y), counter-clockwise from the x axis, 0 to 65536 being the whole turn, and the
/// vector's length times [`GROWTH_Q16`]/65536. Both components are at most 2²⁸. For a vector of at
/// least 2¹⁶ the angle is wrong by less than 2⁻¹⁵ of a turn.
fn turned(x: i32, y: i32) -> (u32, i32) {
    // The left half first, by half a turn.
    let (mut x, mut y, mut angle) = if x < 0 { (-x, -y, 1u32 << 31) } else { (x, y, 0) };
    let mut i = 0;
    for turn in &TURNS_Q32 {
        let (dx, dy) = (x >> i, y >> i);
        if y > 0 {
            (x, y) = (x.wrapping_add(dy), y.wrapping_sub(dx));
            angle = angle.wrapping_add(*turn);
        } else {
            (x, y) = (x.wrapping_sub(dy), y.wrapping_add(dx));
            angle = angle.wrapping_sub(*turn);
        }
        i += 1;
    }
    (angle.wrapping_add(1 << 15) >> 16, x)
}

/// Longitude and latitude of a direction of about 2¹⁷ in length: counter-clockwise around the y axis
/// from the x axis, seen from its tip, 0 to 65535 of 65536; and from the lower pole, 0, to the upper
/// one, 65536.
pub(super) fn sphere(d: [i32; 3]) -> [i32; 2] {
    let (longitude, radius) = turned(d[0] << 8, -d[2] << 8);
    // The height grown alike; then a right angle is 2¹⁴.
    let height = ((i64::from(d[1] << 8) * GROWTH_Q16) >> 16) as i32;
    let latitude = turned(radius, height).0 as u16 as i16;
    [longitude as i32, ((i32::from(latitude) + (1 << 14)) << 1).clamp(0, 1 << 16)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::{PI, TAU};
    use proptest::prelude::*;
    extern crate std;

    #[test]
    fn the_axes() {
        let one = 1 << 17;
        assert_eq!(sphere([one, 0, 0]), [0, 32768]);
        assert_eq!(sphere([0, 0, -one])[0], 16384);
        assert_eq!(sphere([-one, 0, 0])[0], 32768);
        assert_eq!(sphere([0, 0, one])[0], 49152);
        assert_eq!(sphere([0, one, 0])[1], 65536);
        assert_eq!(sphere([0, -one, 0])[1], 0);
    }

    proptest! {
        #[test]
        fn longitude_and_latitude(v in prop::array::uniform3(-1.0f64..1.0)) {
            let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
            prop_assume!(length > 0.01 && v[0].hypot(v[2]) > 0.01 * length);
            let d = v.map(|x| (x / length * 131072.0) as i32);
            let [longitude, latitude] = sphere(d).map(|x| f64::from(x) / 65536.0);
            let d = d.map(f64::from);
            let exact = (-d[2]).atan2(d[0]) / TAU;
            let off = (longitude - exact).rem_euclid(1.0);
            prop_assert!(off.min(1.0 - off) < 6e-5, "{longitude} {exact}");
            let exact = 0.5 + d[1].atan2(d[0].hypot(d[2])) / PI;
            prop_assert!((latitude - exact).abs() < 6e-5, "{latitude} {exact}");
        }
    }
}

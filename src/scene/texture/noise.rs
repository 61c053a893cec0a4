//! Gradient noise (Perlin, "An image synthesizer", 1985; the gradients and the fade of "Improving
//! noise", 2002), in integers: the same bits in every arithmetic.
//!
//! Each corner of the integer lattice has one of twelve gradients, (±1, ±1, 0) and their like, so
//! that a scalar product is a sum. Which one is told by a hash of the corner's coordinates, so that
//! there is no table. Between the corners the products are blended by 6t⁵ − 15t⁴ + 10t³.

use crate::math::hash;

/// The finest detail: 2⁻⁸ of the coarsest.
pub(super) const MOST_OCTAVES: u8 = 8;

/// Where each octave's lattice starts: were it at 0 for all, all would be null at whole numbers.
const SHIFT: i32 = 0x6a09_e667;

/// (x, y, z)·g, g the gradient of a corner.
#[inline(always)]
fn product(corner: [i32; 3], d: [i32; 3]) -> i32 {
    let key = (corner[0] as u32).wrapping_mul(0x9e37_79b9)
        ^ (corner[1] as u32).wrapping_mul(0x85eb_ca77)
        ^ (corner[2] as u32).wrapping_mul(0xc2b2_ae3d);
    let h = hash(key) >> 28;
    // Sixteen for twelve: four stand twice, which are the corners of a tetrahedron.
    let u = if h < 8 { d[0] } else { d[1] };
    let v = match h {
        0..4 => d[1],
        12 | 14 => d[0],
        _ => d[2],
    };
    (if h & 1 == 0 { u } else { -u }) + (if h & 2 == 0 { v } else { -v })
}

/// 6t⁵ − 15t⁴ + 10t³ of a number of 2⁻¹⁴ in 0 to 1.
pub(super) fn fade_q14(t: i32) -> i32 {
    let square = (t * t) >> 14;
    let cube = (square * t) >> 14;
    // 10 − 15t + 6t², which is 1 to 10; its products with t² fit without a sign
    let rest = (10 << 14) - 15 * t + 6 * square;
    ((cube as u32 * rest as u32) >> 14) as i32
}

#[inline(always)]
fn mix(a: i32, b: i32, t_q14: i32) -> i32 {
    a + (((b - a) * t_q14) >> 14)
}

/// Noise at a point of 2⁻¹⁶, in 2⁻¹⁴: between −1 and 1, null at the lattice's corners and in the mean.
fn gradient_q14(q: [i32; 3]) -> i32 {
    let cell = q.map(|x| x >> 16);
    let d = q.map(|x| (x & 0xffff) >> 2);
    let fade = d.map(fade_q14);
    let at = |i: i32, j: i32, k: i32| {
        let corner = [cell[0].wrapping_add(i), cell[1].wrapping_add(j), cell[2].wrapping_add(k)];
        product(corner, [d[0] - (i << 14), d[1] - (j << 14), d[2] - (k << 14)])
    };
    let row = |j: i32, k: i32| mix(at(0, j, k), at(1, j, k), fade[0]);
    let face = |k: i32| mix(row(0, k), row(1, k), fade[1]);
    mix(face(0), face(1), fade[2])
}

/// A sum of octaves, each of twice the frequency and half the strength of the one before, in 2⁻¹⁴;
/// between −1 and 1.
pub(super) fn octaves_q14(q: [i32; 3], octaves: u8) -> i32 {
    let (mut sum, mut q) = (0, q);
    for i in 0..octaves.min(MOST_OCTAVES) {
        sum += gradient_q14(q.map(|x| x.wrapping_add(SHIFT))) >> i;
        q = q.map(|x| x.wrapping_mul(2).wrapping_add(SHIFT));
    }
    // Together they can reach nearly 2, but next to never go beyond 1.
    sum.clamp(-(1 << 14), 1 << 14)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    extern crate std;

    #[test]
    fn null_at_the_corners() {
        for i in -5..5 {
            assert_eq!(gradient_q14([i << 16, 7 << 16, -i << 17]), 0);
        }
        assert_eq!([0, 1 << 13, 1 << 14].map(fade_q14), [0, 1 << 13, 1 << 14]);
    }

    #[test]
    fn the_mean_is_null_and_the_spread_is_perlins() {
        let (mut sum, mut squares, mut most) = (0.0, 0.0, 0.0f64);
        let count = 200_000u32;
        for i in 0..count {
            let at = |k: u32| (hash(i.wrapping_mul(3) + k) >> 4) as i32;
            let x = f64::from(gradient_q14([at(0), at(1), at(2)])) / 16384.0;
            sum += x;
            squares += x * x;
            most = most.max(x.abs());
        }
        let count = f64::from(count);
        assert!((sum / count).abs() < 0.003, "{}", sum / count);
        let deviation = (squares / count).sqrt();
        assert!((0.22..0.30).contains(&deviation), "{deviation}");
        assert!((0.8..1.05).contains(&most), "{most}");
    }

    proptest! {
        #[test]
        fn it_has_no_jumps(
            q in prop::array::uniform3(any::<i32>()), axis in 0usize..3, octaves in 1u8..=4,
        ) {
            let mut next = q;
            next[axis] = next[axis].wrapping_add(1 << 8);
            let step = octaves_q14(next, octaves) - octaves_q14(q, octaves);
            // A step of 1/256, and the rounding of each. An octave's slope is at most that of a
            // gradient, 1, and the fade's steepest, 15/8, times what two corners' products, their
            // distances weighted, can differ by: less than 6 in all, and seldom above 2. A jump would
            // be of thousands.
            prop_assert!(step.abs() <= i32::from(octaves) * (6 * 64 + 4), "{step}");
        }

        #[test]
        fn the_fade_is_that_of_f64(t in 0..=1i32 << 14) {
            let x = f64::from(t) / 16384.0;
            let exact = x * x * x * (x * (x * 6.0 - 15.0) + 10.0);
            prop_assert!((f64::from(fade_q14(t)) / 16384.0 - exact).abs() < 1e-3);
        }
    }
}

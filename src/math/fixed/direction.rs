//! Unit vectors: their making and Snell's law.

use super::kernel::{length_times_unit, lengths, magnitude, shift};
use super::{FixedEta, FixedInverse, Unit};
use crate::math::root::{self, reciprocal_root_q29, sqrt_u32};
use ::fixed::types::I16F16;

/// Three integers shifted so that the largest magnitude is in 2²⁹ to 2³⁰, and by how much.
#[inline(always)]
fn align(v: &[i32; 3]) -> ([i32; 3], i32) {
    let (_, z) = root::normalize(magnitude(v[0]) | magnitude(v[1]) | magnitude(v[2]) | 1);
    let up = z as i32 - 2;
    if up >= 0 {
        let up = up & 31;
        ([v[0] << up, v[1] << up, v[2] << up], up)
    } else {
        // No magnitude has 32 bits.
        ([v[0] >> 1, v[1] >> 1, v[2] >> 1], -1)
    }
}

/// 1/√s for a sum of squares s in 2²⁸ to 2³²: Y in Q29 from 1 to 2 with 1/√s = Y·2^(half − 16),
/// half, and s as a fraction, `s·2^(2·half − 32)` in Q32.
#[inline(always)]
fn inverse_root(s: u32) -> (u32, u32, u32) {
    // 1 below 2³⁰, without a branch.
    let half = (s >> 30).wrapping_sub(1) >> 31;
    let m = s << (half << 1);
    (reciprocal_root_q29(m), half, m)
}

/// `t·u / 2²¹` to the nearest, for |t| ≤ 2²³ and |u| ≤ 2¹⁷.
#[inline(always)]
fn rounded_product(t: i32, u: i32) -> i32 {
    let high = (t >> 13).wrapping_mul(u);
    let low = (t & 0x1fff).wrapping_mul(u) >> 13;
    high.wrapping_add(low).wrapping_add(1 << 7) >> 8
}

/// The sum of the squares of three integers whose length is below 2³¹, over 2³⁰.
#[inline(always)]
fn square_of(x: &[i32; 3]) -> u32 {
    // Sixteen bits a component, so that three squares fit a word, and five more for the
    // first-order correction: (32h + l)² ≈ 2¹⁰(h² + hl/16).
    let (mut square, mut correction) = (0u32, 0i32);
    for x in x {
        let (high, low) = (x >> 15, x >> 10 & 31);
        square = square.wrapping_add(high.wrapping_mul(high) as u32);
        correction = correction.wrapping_add(high.wrapping_mul(low));
    }
    square.wrapping_add((correction >> 4) as u32)
}

/// The unit vector along three integers, to 17 bits, and their length.
#[inline(always)]
pub(super) fn unit_along(v: &[i32; 3]) -> ([Unit; 3], i32) {
    let (x, up) = align(v);
    let (y_q29, half, m) = inverse_root(square_of(&x));
    // x·Y·2^(half − 14) in Q17, as x·(Y·2^half in Q15)/2²⁹
    let y = (y_q29 >> (14 - half)) as i32;
    let unit = |x: i32| Unit::from_bits(length_times_unit(x >> 12, y));
    let length = shift(root::root_q16(m, y_q29) as i32, 15 - up - half as i32);
    ([unit(x[0]), unit(x[1]), unit(x[2])], length)
}

/// See `Arithmetic::sight`: to the nearest, since a floor would turn every ray by half a step and lower
/// the horizon.
#[inline(always)]
pub(super) fn sight(v: &[i32; 3]) -> [Unit; 3] {
    let square = square_of(v);
    // Less than half as long as the longest of the picture.
    if square < 1 << 28 {
        return aligned_sight(*v);
    }
    sight_of_square(v, square)
}

#[inline(always)]
fn sight_of_square(x: &[i32; 3], square: u32) -> [Unit; 3] {
    let (y_q29, half, _) = inverse_root(square);
    // As in `unit_along`.
    let y = (y_q29 >> (14 - half)) as i32;
    let unit = |x: i32| Unit::from_bits(rounded_product(x >> 8, y));
    [unit(x[0]), unit(x[1]), unit(x[2])]
}

#[inline(never)]
fn aligned_sight(v: [i32; 3]) -> [Unit; 3] {
    let (x, _) = align(&v);
    sight_of_square(&x, square_of(&x))
}

/// See `Arithmetic::aims`. The longest direction towards the picture, a corner's, comes between 2³⁰ and 2³¹ steps.
pub(super) fn aims(vectors: &[[i32; 3]; 3], width: u16, height: u16) -> [[i32; 3]; 3] {
    // In steps of 2⁻¹²: three squares fit 64 bits. Each number is rounded, what lies aside by up to one for
    // each height in the width.
    let slack = u64::from(width.checked_div(height).unwrap_or(0)).wrapping_add(4);
    let square = |x: i32| {
        let part = u64::from(x.unsigned_abs()).wrapping_add(slack);
        part.wrapping_mul(part)
    };
    // Of seventeen bits times fifteen.
    let over =
        |x: i32, pixels: i32| x.wrapping_mul(pixels).checked_div(i32::from(height)).unwrap_or(0);
    let [forward, right, down] = vectors;
    // Corners, to a pixel beyond the edges; and steps, which are longer only where there is one row.
    let mut squares = [0u64; 6];
    for i in 0..3 {
        let (right, down) = (right[i] >> 14, down[i] >> 14);
        let aside = over(right, i32::from(width).wrapping_add(2));
        let below = over(down, i32::from(height).wrapping_add(2));
        let ahead = forward[i] >> 14;
        let (left, far) = (ahead.wrapping_sub(aside), ahead.wrapping_add(aside));
        let all = [
            left.wrapping_sub(below),
            left.wrapping_add(below),
            far.wrapping_sub(below),
            far.wrapping_add(below),
            over(right, 2),
            over(down, 2),
        ];
        for (sum, x) in squares.iter_mut().zip(all) {
            *sum = sum.wrapping_add(square(x));
        }
    }
    let mut most = 0u64;
    for square in squares {
        most = if square > most { square } else { most };
    }
    // |v|² is below most·2²⁸, which is to be below 2⁶².
    let up = (most.leading_zeros() as i32 - 30) >> 1;
    let mut scaled = *vectors;
    for x in scaled.as_flattened_mut() {
        *x = if up >= 0 { *x << (up & 31) } else { *x >> (-up & 31) };
    }
    scaled
}

/// See `Arithmetic::normalize`.
#[inline(always)]
pub(super) fn normalize(v: &[I16F16; 3]) -> ([Unit; 3], I16F16, FixedInverse) {
    // Fifteen bits a component do for the way to a light; rounding them before they are
    // squared keeps the result's length exact.
    let (x, up) = align(&lengths(v));
    let short = |x: i32| x.wrapping_add(1 << 14) >> 15;
    let h = [short(x[0]), short(x[1]), short(x[2])];
    let square = |h: i32| h.wrapping_mul(h) as u32;
    let sum = square(h[0]).wrapping_add(square(h[1])).wrapping_add(square(h[2]));
    let (y_q29, half, m) = inverse_root(sum);
    // h·Y·2^(half + 1) in Q17: |h|·Y is at most 2¹⁶, so the product fits at Q14
    let y_q14 = (y_q29.wrapping_add(1 << 14) >> 15) as i32;
    let round = 1 << (12 - half);
    let unit = |h: i32| Unit::from_bits(h.wrapping_mul(y_q14).wrapping_add(round) >> (13 - half));
    let length = shift(root::root_q16(m, y_q29) as i32, 15 - up - half as i32);
    let inverse = FixedInverse { mantissa_q15: y_q29 >> 14, exponent: half as i32 + up - 15 };
    ([unit(h[0]), unit(h[1]), unit(h[2])], I16F16::from_bits(length), inverse)
}

/// See `Arithmetic::refract`.
#[inline(always)]
pub(super) fn refract(
    d: &[Unit; 3],
    n: &[Unit; 3],
    cos_i: Unit,
    eta: &FixedEta,
) -> Option<[Unit; 3]> {
    let c_q15 = cos_i.to_bits() >> 2;
    let sin2_q30 = (1u32 << 30).saturating_sub(c_q15.wrapping_mul(c_q15) as u32);
    // sin²·η² with the square's sixteen bits: the product lies in Q(30 − exponent)
    let square = eta.square as u32;
    let product = ((sin2_q30 >> 15).wrapping_mul(square) >> 1)
        .wrapping_add((sin2_q30 & 0x7fff).wrapping_mul(square) >> 16);
    let e = eta.exponent as i32;
    if e > 0 && product >> (30 - e) != 0 {
        return None;
    }
    let sin2_t = shift(product as i32, e);
    let cos2_t = (1 << 30) - sin2_t;
    if cos2_t <= 0 {
        return None;
    }
    // one step less than the square, so that 1 doesn't fall off the top of Q32
    let cos_t_q17 = (sqrt_u32((cos2_t as u32 - 1) << 2) << 1) as i32;
    let eta_q16 = eta.eta_q16 as i32;
    let times_eta = |u: i32| length_times_unit(u << 1, eta_q16);
    let along_n = times_eta(cos_i.to_bits()).wrapping_sub(cos_t_q17);
    let f = |d: Unit, n: Unit| {
        let tangent = times_eta(d.to_bits());
        Unit::from_bits(tangent.wrapping_add(length_times_unit(along_n, n.to_bits())))
    };
    Some([f(d[0], n[0]), f(d[1], n[1]), f(d[2], n[2])])
}

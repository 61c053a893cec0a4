//! Unit vectors: their making and Snell's law.

use super::kernel::{length_times_unit, lengths, magnitude, shift};
use super::{Aim, FixedEta, FixedInverse, Unit};
use crate::math::root::{self, reciprocal_root_q29, sqrt_u32};
use ::fixed::types::I16F16;

/// Which bits the largest magnitude of three integers has.
#[inline(always)]
fn largest(v: &[i32; 3]) -> u32 {
    magnitude(v[0]) | magnitude(v[1]) | magnitude(v[2])
}

/// Three integers shifted so that the largest magnitude is in 2²⁹ to 2³⁰, and by how much.
#[inline(always)]
fn align(v: &[i32; 3]) -> ([i32; 3], i32) {
    let (_, z) = root::normalize(largest(v) | 1);
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

/// `t·u / 2²¹` to the nearest, for |t| ≤ 2²² and |u| ≤ 2¹⁷.
#[inline(always)]
fn rounded_product(t: i32, u: i32) -> i32 {
    let high = (t >> 13).wrapping_mul(u);
    let low = (t & 0x1fff).wrapping_mul(u) >> 13;
    high.wrapping_add(low).wrapping_add(1 << 7) >> 8
}

/// Of three integers of which the largest is in 2²⁹ to 2³⁰: 1/√s as [`inverse_root`] gives it, s being the
/// sum of their squares over 2³⁰.
#[inline(always)]
fn inverse_length(x: &[i32; 3]) -> (u32, u32, u32) {
    // Fifteen bits a component, so that three squares fit a word, and five more for the
    // first-order correction: (32h + l)² ≈ 2¹⁰(h² + hl/16).
    let (mut square, mut correction) = (0u32, 0i32);
    for x in x {
        let (high, low) = (x >> 15, x >> 10 & 31);
        square = square.wrapping_add(high.wrapping_mul(high) as u32);
        correction = correction.wrapping_add(high.wrapping_mul(low));
    }
    inverse_root(square.wrapping_add((correction >> 4) as u32))
}

/// The unit vector along three integers, to 17 bits, and their length.
#[inline(always)]
pub(super) fn unit_along(v: &[i32; 3]) -> ([Unit; 3], i32) {
    let (x, up) = align(v);
    let (y_q29, half, m) = inverse_length(&x);
    // x·Y·2^(half − 14) in Q17, as x·(Y·2^half in Q15)/2²⁹
    let y = (y_q29 >> (14 - half)) as i32;
    let unit = |x: i32| Unit::from_bits(length_times_unit(x >> 12, y));
    let length = shift(root::root_q16(m, y_q29) as i32, 15 - up - half as i32);
    ([unit(x[0]), unit(x[1]), unit(x[2])], length)
}

/// How often the vectors of `Arithmetic::fitted` are to be halved, 15 times at most: no ray towards a pixel, or to one beyond the edges,
/// may have a component of 2³¹.
#[inline(never)]
pub(super) fn halvings([forward, right, down]: &[[Aim; 3]; 3], width: u16, height: u16) -> u32 {
    // In steps of 2¹⁶, rounded up: fourteen bits of pixels fit beside.
    let steps = |x: Aim| (x.to_bits().unsigned_abs() >> 16).wrapping_add(1);
    let over = |x: u32, pixels: u16| {
        let whole = x.wrapping_mul(u32::from(pixels).wrapping_add(2));
        whole.checked_div(u32::from(height)).unwrap_or(0).wrapping_add(1)
    };
    let mut most = 0;
    for i in 0..3 {
        let aside = over(steps(right[i]), width);
        let below = over(steps(down[i]), height);
        let sum = steps(forward[i]).wrapping_add(aside).wrapping_add(below);
        most = if sum > most { sum } else { most };
    }
    let (_, zeros) = root::normalize(most);
    17u32.saturating_sub(zeros)
}

/// See `Arithmetic::rise`: by how much [`align`] shifts the vector to the left.
pub(super) fn rise(v: &[i32; 3]) -> u8 {
    let (_, up) = align(v);
    if up > 0 { up as u8 } else { 0 }
}

/// See `Arithmetic::sight`: to the nearest, since a floor would turn every ray by half a step and lower
/// the horizon.
#[inline(always)]
pub(super) fn sight(v: &[i32; 3], rise: u8) -> [Unit; 3] {
    let up = u32::from(rise) & 31;
    if largest(v) >> (29u32.wrapping_sub(up) & 31) == 1 {
        rounded(&[v[0] << up, v[1] << up, v[2] << up])
    } else {
        aligned_sight(*v)
    }
}

/// The same for any.
#[inline(never)]
fn aligned_sight(v: [i32; 3]) -> [Unit; 3] {
    rounded(&align(&v).0)
}

/// The unit vector along three integers that are aligned.
#[inline(always)]
fn rounded(x: &[i32; 3]) -> [Unit; 3] {
    let (y_q29, half, _) = inverse_length(x);
    // As in `unit_along`.
    let y = (y_q29 >> (14 - half)) as i32;
    let unit = |x: i32| Unit::from_bits(rounded_product(x >> 8, y));
    [unit(x[0]), unit(x[1]), unit(x[2])]
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

//! From `f64` to [`Fixed`](super::Fixed)'s numbers: `None` for what is out of range or no number.

use super::{Aim, FixedBarycentric, FixedDecay, FixedEdge, FixedEta, FixedExponent};
use super::{FixedFactor, FixedIntensity, FixedOutline, FixedRadius, FixedRotation, FixedScale};
use super::{Unit, Weight};
use crate::math::{DENSEST, inverted};
use ::fixed::types::I16F16;

const fn round(x: f64) -> f64 {
    if x < 0.0 { x - 0.5 } else { x + 0.5 }
}

const fn within(x: f64, low: f64, high: f64) -> bool {
    x >= low && x <= high
}

pub(crate) const fn length(x: f64) -> Option<I16F16> {
    if !within(x, -1024.0, 1024.0) {
        return None;
    }
    Some(I16F16::from_bits(round(x * 65536.0) as i32))
}

/// The least and the largest length.
pub(crate) const LEAST: I16F16 = I16F16::MIN;
pub(crate) const MOST: I16F16 = I16F16::MAX;

/// Whether a length is less than another.
pub(crate) const fn below(a: I16F16, b: I16F16) -> bool {
    a.to_bits() < b.to_bits()
}

pub(crate) const fn unit(x: f64) -> Option<Unit> {
    if !within(x, -1.0001, 1.0001) {
        return None;
    }
    Some(Unit::from_bits(round(x * 131072.0) as i32))
}

pub(crate) const fn weight(x: f64) -> Option<Weight> {
    if !within(x, 0.0, 15.999) {
        return None;
    }
    Some(Weight::from_bits(round(x * 16384.0) as i32))
}

pub(crate) const fn radiance(x: f64) -> Option<I16F16> {
    if !within(x, 0.0, 1024.0) {
        return None;
    }
    Some(I16F16::from_bits(round(x * 65536.0) as i32))
}

/// A ramp's middle and slope from its ends.
pub(crate) const fn middle_and_slope(low: I16F16, high: I16F16) -> (I16F16, I16F16) {
    let (low, high) = (low.to_bits(), high.to_bits());
    (I16F16::from_bits((low + high) >> 1), I16F16::from_bits((high - low) >> 1))
}

/// From 2⁻¹² (below it a sphere is a few steps across) to 500 (above it the coarse radius would
/// not fit sixteen bits).
pub(crate) const fn radius(r: f64) -> Option<FixedRadius> {
    if !within(r, 1.0 / 4096.0, 500.0) {
        return None;
    }
    let mut mantissa = r * 65536.0;
    let (mut shift, mut missing) = (0, 0);
    while mantissa >= 65534.5 {
        mantissa *= 0.5;
        shift += 1;
    }
    let mut normal = mantissa;
    while normal < 32768.0 {
        normal *= 2.0;
        missing += 1;
    }
    let reciprocal = round(4294967296.0 / normal) - 65536.0;
    let steps = (r * 65536.0) as u32 >> super::COARSE_SHIFT;
    Some(FixedRadius {
        mantissa: round(mantissa) as u16,
        reciprocal: if reciprocal > 65535.0 { 65535 } else { reciprocal as u16 },
        coarse: (steps + (steps >> 11) + super::COARSE_SLACK + 1) as u16,
        shift,
        missing,
    })
}

pub(crate) const fn intensity(x: f64) -> Option<FixedIntensity> {
    if !within(x, 0.0, 1e12) {
        return None;
    }
    if x < 1e-9 {
        return Some(FixedIntensity { mantissa_q15: 0, exponent: 0 });
    }
    let (mut mantissa, mut exponent) = (x, 0);
    while mantissa >= 32767.5 / 32768.0 {
        mantissa *= 0.5;
        exponent += 1;
    }
    while mantissa < 0.5 {
        mantissa *= 2.0;
        exponent -= 1;
    }
    Some(FixedIntensity { mantissa_q15: round(mantissa * 32768.0) as u16, exponent })
}

/// Exactly the number that makes the same intensity again.
pub(crate) const fn from_intensity(x: &FixedIntensity) -> f64 {
    let mut value = x.mantissa_q15 as f64 / 32768.0;
    let mut exponent = x.exponent;
    while exponent > 0 {
        value *= 2.0;
        exponent -= 1;
    }
    while exponent < 0 {
        value *= 0.5;
        exponent += 1;
    }
    value
}

pub(crate) const fn exponent(n: f64) -> Option<FixedExponent> {
    if !within(n, 0.0, 1e6) {
        return None;
    }
    Some(FixedExponent(round(n * 256.0) as u32))
}

pub(crate) const fn eta(x: f64) -> Option<FixedEta> {
    if !within(x, 0.25, 3.999) {
        return None;
    }
    let mut square = x * x;
    let mut exponent = 0;
    while square >= 65535.5 / 65536.0 {
        square *= 0.5;
        exponent += 1;
    }
    while square < 0.5 {
        square *= 2.0;
        exponent -= 1;
    }
    Some(FixedEta {
        eta_q16: round(x * 65536.0) as u32,
        square: round(square * 65536.0) as u16,
        exponent,
    })
}

/// From what a unit of length takes, in natural orders of magnitude.
pub(crate) const fn decay(x: f64) -> Option<FixedDecay> {
    if !within(x, 0.0, DENSEST) {
        return None;
    }
    Some(FixedDecay(round(x * core::f64::consts::LOG2_E * 16777216.0) as u32))
}

pub(crate) const fn aim(x: f64) -> Option<Aim> {
    if !within(x, -16.0, 16.0) {
        return None;
    }
    Some(Aim::from_bits(round(x * 67108864.0) as i32))
}

const fn abs(x: f64) -> f64 {
    if x < 0.0 { -x } else { x }
}

const fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// A form `p·x + q·y` that is 1 at its corner, x and y in 2^(`shift` − 16): brought to
/// coefficients of fifteen bits.
const fn form(p: f64, q: f64, shift: u8) -> ([i16; 2], u8) {
    let step = (1u64 << shift) as f64 / 65536.0;
    let (p, q) = (p * step, q * step);
    // 1 stands at 14 + down fraction bits
    let mut scale = 16384.0;
    let mut down = 0;
    let largest = max(abs(p), abs(q));
    while largest * scale * 2.0 <= 16384.0 && down < 16 {
        scale *= 2.0;
        down += 1;
    }
    ([clip(p * scale), clip(q * scale)], down)
}

const fn clip(x: f64) -> i16 {
    round(if x > 16384.0 {
        16384.0
    } else if x < -16384.0 {
        -16384.0
    } else {
        x
    }) as i16
}

/// From the triangle's second and third corner relative to the first, along the plane's two
/// other axes. `None` where the corners lie on a line or the triangle is larger than the range.
pub(crate) const fn barycentric(b: [f64; 2], c: [f64; 2], _reach: f64) -> Option<FixedBarycentric> {
    let det = b[0] * c[1] - b[1] * c[0];
    let largest = max(max(abs(b[0]), abs(b[1])), max(abs(c[0]), abs(c[1])));
    // Flatter than 2⁻¹⁴ it has no inside at this precision: no height is below half a step.
    if !(abs(det) > largest * largest / 16384.0) || !(largest <= 2048.0) {
        return None;
    }
    let mut shift = 0;
    // One bit to spare: a hit just outside must not wrap into the inside.
    while largest * 65536.0 >= 32000.0 * (1u64 << shift) as f64 {
        shift += 1;
    }
    let (second, second_down) = form(c[1] / det, -c[0] / det, shift);
    let (third, third_down) = form(-b[1] / det, b[0] / det, shift);
    Some(FixedBarycentric { second, third, second_down, third_down, shift })
}

/// The second and third corner again, and by what they may be wrong.
pub(crate) const fn corners(f: &FixedBarycentric) -> ([f64; 2], [f64; 2], f64) {
    let step = (1u64 << f.shift) as f64 / 65536.0;
    let one = [(16384u64 << f.second_down) as f64 * step, (16384u64 << f.third_down) as f64 * step];
    let second = [f.second[0] as f64 / one[0], f.second[1] as f64 / one[0]];
    let third = [f.third[0] as f64 / one[1], f.third[1] as f64 / one[1]];
    inverted(second, third, 0.5 / one[0] + 0.5 / one[1])
}

pub(crate) const fn normal(n: [f64; 3]) -> [i16; 3] {
    [clip(n[0] * 16384.0), clip(n[1] * 16384.0), clip(n[2] * 16384.0)]
}

/// From half the sides of the rectangle. Two coordinates together stay within sixteen bits, so
/// that an edge's offset does.
pub(crate) const fn outline(half: [f64; 2], _reach: f64) -> FixedOutline {
    let largest = max(half[0], half[1]);
    let mut shift = 0;
    while shift < 31 && largest * 65536.0 >= 16000.0 * (1u64 << shift) as f64 {
        shift += 1;
    }
    let steps = 65536.0 / (1u64 << shift) as f64;
    FixedOutline { half: [(half[0] * steps) as u16 + 1, (half[1] * steps) as u16 + 1], shift }
}

/// Half the sides of the rectangle.
pub(crate) const fn half(outline: &FixedOutline) -> [f64; 2] {
    let step = (1u64 << outline.shift) as f64 / 65536.0;
    [outline.half[0] as f64 * step, outline.half[1] as f64 * step]
}

/// The half plane that `inward` points into from the point `at`; everything for a null vector.
pub(crate) const fn edge(inward: [f64; 2], at: [f64; 2], outline: &FixedOutline) -> FixedEdge {
    let largest = max(abs(inward[0]), abs(inward[1]));
    if largest <= 0.0 {
        return FixedEdge { normal: [0, 0], offset: 0 };
    }
    let n = [clip(inward[0] / largest * 16384.0), clip(inward[1] / largest * 16384.0)];
    let steps = 65536.0 / (1u64 << outline.shift) as f64 / 16384.0;
    // `as` saturates
    let offset = round(-(n[0] as f64 * at[0] + n[1] as f64 * at[1]) * steps) as i16;
    FixedEdge { normal: n, offset }
}

/// From a rotation's rows, which must be of unit length and at right angles.
pub(crate) const fn rotation(r: &[[f64; 3]; 3]) -> FixedRotation {
    let mut made = FixedRotation { high_q17: [[0; 3]; 3], low_q30: [[0; 3]; 3] };
    let mut i = 0;
    while i < 9 {
        let x = r[i / 3][i % 3];
        let high = round(x * 131072.0) as i32;
        made.high_q17[i / 3][i % 3] = high;
        made.low_q30[i / 3][i % 3] = round((x * 131072.0 - high as f64) * 8192.0) as i16;
        i += 1;
    }
    made
}

const fn factor(s: f64) -> FixedFactor {
    let (mut mantissa, mut exponent) = (s, 0);
    while mantissa >= 2.0 {
        mantissa *= 0.5;
        exponent += 1;
    }
    while mantissa < 1.0 {
        mantissa *= 2.0;
        exponent -= 1;
    }
    // `as` saturates, a step below 2
    FixedFactor { mantissa_q30: round(mantissa * 1073741824.0) as u32, exponent }
}

/// From 2⁻¹⁰ to 2¹⁰.
pub(crate) const fn scale(s: f64) -> Option<FixedScale> {
    if !within(s, 1.0 / 1024.0, 1024.0) {
        return None;
    }
    Some(FixedScale { factor: factor(s), reciprocal: factor(1.0 / s) })
}

pub(crate) const fn from_length(x: I16F16) -> f64 {
    x.to_bits() as f64 / 65536.0
}

pub(crate) const fn from_unit(x: Unit) -> f64 {
    x.to_bits() as f64 / 131072.0
}

pub(crate) const fn from_radius(r: &FixedRadius) -> f64 {
    ((r.mantissa as u64) << r.shift) as f64 / 65536.0
}

/// A sum of few coordinates: twice their range and more.
pub(crate) const fn sum(x: f64) -> I16F16 {
    I16F16::from_bits(round(x * 65536.0) as i32)
}

/// A coordinate, in range or not, in steps of the grid.
pub(crate) const fn grid(x: f64, _log2_step: i8) -> i32 {
    // No shape reaches farther; a corner that is computed back from a needle of a triangle can.
    let x = if x > 1024.0 { 1024.0 } else { x };
    round(if x < -1024.0 { -1024.0 } else { x } * 65536.0) as i32
}

/// A coordinate in steps of the octree's grid, which for fixed point are its own steps.
pub(crate) const fn to_grid(x: I16F16, _log2_step: i8) -> i32 {
    x.to_bits()
}

/// The coordinate of a step of the grid.
pub(crate) const fn from_grid(x: i32, _log2_step: i8) -> I16F16 {
    I16F16::from_bits(x)
}

/// For `Arithmetic::cells_before`: 2²⁰ over a cell's side of `mantissa << shift` steps, whose shift is
/// its business. Rounded up, it is less than 2⁻²⁰ too large: of eleven bits less than 2⁻⁹ of a cell, which
/// is less than a step of the mantissa, so the quotient's floor is exact.
pub(crate) const fn per_cell(mantissa: u8, _shift: u8, _log2_step: i8) -> i32 {
    match 0xf_ffff_u32.checked_div(mantissa as u32) {
        Some(quotient) => quotient as i32 + 1,
        None => 0,
    }
}

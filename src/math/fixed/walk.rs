//! What a walk through an octree asks: whole numbers of cells, and ray parameters that fit a word.

use super::{Fixed, FixedPace, Unit};
use crate::math::Arithmetic;
use crate::math::root::{self, reciprocal_q28};
use ::fixed::types::I16F16;

/// See `Arithmetic::pace`.
#[inline(always)]
pub(super) fn pace(d: Unit) -> FixedPace {
    // Slower than this, a ray drifts less than the margin that an octree's builder leaves; and what
    // eight cells and a little take stays below 2³¹.
    let d = if d.to_bits() < 9 { 9 } else { d.to_bits() as u32 };
    let (m, z) = root::normalize_large(d << 14);
    FixedPace { y_q16: reciprocal_q28(m) >> 12, down: 17u32.wrapping_sub(z) }
}

/// See `Arithmetic::takes`.
#[inline(always)]
pub(super) fn takes(a: I16F16, pace: &FixedPace) -> I16F16 {
    if a >= Fixed::FAR {
        return Fixed::FAR;
    }
    // a·y/2¹³, below 2³¹ since a < 2²⁶
    let bits = a.to_bits() as u32;
    let p = (bits >> 13)
        .wrapping_mul(pace.y_q16)
        .wrapping_add((bits & 0x1fff).wrapping_mul(pace.y_q16) >> 13);
    // and that times 2^(13 − down), down being 3 to 17
    if pace.down >= 13 {
        I16F16::from_bits((p >> (pace.down.wrapping_sub(13) & 31)) as i32)
    } else if p >> (pace.down.wrapping_add(13) & 31) != 0 {
        Fixed::FAR
    } else {
        I16F16::from_bits((p << (13u32.wrapping_sub(pace.down) & 31)) as i32)
    }
}

/// What it takes for a length, as a span: see `Arithmetic::spans`.
#[inline(always)]
pub(super) fn span_of(a: I16F16, pace: &FixedPace, unit: u8) -> i32 {
    // Below 2¹⁴ times up to 2¹⁷.
    let a = (a.to_bits() >> (unit & 31)) as u32;
    (a.wrapping_mul(pace.y_q16) >> (pace.down & 31)) as i32
}

/// See `Arithmetic::cells_before`.
#[inline(always)]
pub(super) fn cells_before(o: I16F16, per: i32, unit: u8) -> u32 {
    // Eleven bits hold eight cells; times thirteen: see `per_cell`.
    let o = o.to_bits() >> (unit & 31) >> 6;
    ((o & !(o >> 31)) as u32).wrapping_mul(per as u32) >> 20
}

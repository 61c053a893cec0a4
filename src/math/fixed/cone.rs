//! Cones: a quadratic whose squares cancel, so its products have 64 bits.

use super::Unit;
use crate::math::root::{reciprocal_q28, sqrt_u32};

/// √x to sixteen bits.
fn root_of_wide(x: u64) -> i64 {
    let z = x.leading_zeros() & 62;
    let down = 32u32.saturating_sub(z);
    // `down` is even, since z is
    i64::from(sqrt_u32((x >> down) as u32)) << (down >> 1)
}

/// `a/b` as a unit, clipped to ±2; 2 with the sign of a for b = 0.
fn quotient(a: i64, b: i64) -> Unit {
    let negative = (a < 0) != (b < 0);
    let (a, b) = (a.unsigned_abs(), b.unsigned_abs());
    let q = if a >> 1 >= b {
        1 << 18
    } else {
        // a < 2b, so both can be moved until b has 31 bits and a 32.
        let z = b.leading_zeros();
        let (a, b) =
            if z >= 32 { (a << (z - 32), b << (z - 32)) } else { (a >> (32 - z), b >> (32 - z)) };
        // a/2³²·2²⁸/b of Q32
        let y_q28 = u64::from(reciprocal_q28(b as u32));
        (a.wrapping_mul(y_q28) >> 43) as i32
    };
    Unit::from_bits(if negative { -q } else { q })
}

/// See `Arithmetic::cone`.
#[inline(always)]
pub(super) fn cone(
    w: &[Unit; 3],
    d: &[Unit; 3],
    axis: &[Unit; 3],
    sin_cos: [Unit; 2],
    waist: Unit,
) -> Option<[Unit; 2]> {
    let wide = |x: Unit| i64::from(x.to_bits()) << 11;
    let times = |x: i64, y: i64| x.wrapping_mul(y) >> 28;
    let dot = |x: &[i64; 3], y: &[i64; 3]| {
        times(x[0], y[0]).wrapping_add(times(x[1], y[1])).wrapping_add(times(x[2], y[2]))
    };
    let (w, d, axis) = (w.map(wide), d.map(wide), axis.map(wide));
    let (sin, cos, waist) = (wide(sin_cos[0]), wide(sin_cos[1]), wide(waist));
    let (s, da) = (dot(&w, &axis), dot(&d, &axis));
    let across = |v: &[i64; 3], s: i64| {
        let f = |v: i64, a: i64| v.wrapping_sub(times(s, a));
        [f(v[0], axis[0]), f(v[1], axis[1]), f(v[2], axis[2])]
    };
    let (wp, dp) = (across(&w, s), across(&d, da));
    let (rs, rd) = (waist.wrapping_add(times(sin, s)), times(sin, da));
    let cos2 = times(cos, cos);
    let a = times(cos2, dot(&dp, &dp)).wrapping_sub(times(rd, rd));
    let b = times(cos2, dot(&wp, &dp)).wrapping_sub(times(rs, rd));
    let c = times(cos2, dot(&wp, &wp)).wrapping_sub(times(rs, rs));
    let square = b.wrapping_mul(b).wrapping_sub(a.wrapping_mul(c));
    if square < 0 {
        return None;
    }
    let h = root_of_wide(square as u64);
    Some(if b >= 0 {
        let q = b.wrapping_add(h).wrapping_neg();
        [quotient(q, a), quotient(c, q)]
    } else {
        let q = h.wrapping_sub(b);
        [quotient(c, q), quotient(q, a)]
    })
}

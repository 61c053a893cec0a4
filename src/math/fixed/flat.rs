//! Triangles and polygons: linear forms of fifteen bits, and by how much a shape is larger than
//! it is.

use super::kernel::magnitude;
use super::{
    COARSE_SHIFT, Fixed, FixedBarycentric, FixedEdge, FixedOutline, FixedSpot, Unit, Weight,
};
use crate::math::{Arithmetic, root};
use ::fixed::types::I16F16;

/// A length in steps of 2^(s − 16), rounded.
#[inline(always)]
fn steps(x: I16F16, s: u8) -> i32 {
    (x.to_bits() >> s).wrapping_add(x.to_bits() >> (s.saturating_sub(1)) & (s != 0) as i32)
}

/// By how many steps of 2^(s − 16) a triangle or polygon is larger than it is, so that meshes
/// have no cracks. A hit is off by four steps of a length for the products, the plane by a quarter
/// of a step at the corners, all that over the slope; two steps for the forms' coefficients, one
/// for the rounding of both coordinates. Never more than 1024: a thirtieth of the shape; so at a
/// glance there can be cracks, from a slope of about 1/64 (small shapes, tens of their size away)
/// down.
#[inline(always)]
fn slack_steps(slope: Unit, s: u8) -> i32 {
    let off = (4 >> s) + 1;
    // 1/slope ≤ 2^(z − 14)
    let (_, z) = root::normalize(slope.to_bits() as u32 | 1);
    let up = if z > 24 { 10 } else { z.saturating_sub(14) };
    let off = off << up;
    3 + if off > 1024 { 1024 } else { off }
}

/// By how many eighths of such a step a hit may be off: four steps of a length over the slope. What
/// [`slack_steps`] says for coordinates rounded, in haste and for the worst.
#[inline(always)]
fn off_in_eighths(slope: Unit, s: u8) -> i32 {
    let (_, z) = root::normalize(slope.to_bits() as u32 | 1);
    let up = if z > 24 { 10 } else { z.saturating_sub(14) };
    let off = (32 << up >> s) + 1;
    if off > 8192 { 8192 } else { off }
}

/// See `Arithmetic::barycentric`.
#[inline(always)]
pub(super) fn barycentric(
    form: &FixedBarycentric,
    x: I16F16,
    y: I16F16,
    slope: Unit,
) -> Option<(Weight, Weight)> {
    let s = form.shift & 31;
    let exact = [x.to_bits(), y.to_bits()];
    let (x, y) = (steps(x, s), steps(y, s));
    if x as i16 as i32 != x || y as i16 as i32 != y {
        return None;
    }
    // weighed by the largest coefficients (2¹⁴ and less)
    let slack = slack_steps(slope, s) << 14;
    let value = |form: &[i16; 2]| {
        (form[0] as i32).wrapping_mul(x).wrapping_add((form[1] as i32).wrapping_mul(y))
    };
    let b = value(&form.second);
    if b < -slack {
        return None;
    }
    let c = value(&form.third);
    if c < -slack {
        return None;
    }
    let (down_b, down_c) = (form.second_down & 31, form.third_down & 31);
    // The third edge is where the sum of both is 1. In half a step of the coarser form:
    let common = if down_b < down_c { down_b } else { down_c };
    let (down_second, down_third) = (down_b - common, down_c - common);
    let beyond = |b: i32, c: i32| {
        (b >> down_second >> 1).wrapping_add(c >> down_third >> 1) - (8192 << common)
    };
    // Most hits lie inside by any measure.
    if b < 0 || c < 0 || beyond(b, c) > 0 {
        // Coordinates as they were; then half a step for each coefficient, and what the point may be off.
        let rest = [exact[0].wrapping_sub(x << s), exact[1].wrapping_sub(y << s)];
        let finer = |form: &[i16; 2]| {
            (form[0] as i32)
                .wrapping_mul(rest[0])
                .wrapping_add((form[1] as i32).wrapping_mul(rest[1]))
                >> s
        };
        let (b, c) = (b.wrapping_add(finer(&form.second)), c.wrapping_add(finer(&form.third)));
        let reach = (magnitude(x) + magnitude(y)) as i32 >> 1;
        let off = off_in_eighths(slope, s);
        let allowed = |p: i32, q: i32| ((magnitude(p) + magnitude(q) + 8) as i32 >> 3) * off;
        let edge = |form: &[i16; 2]| reach + allowed(form[0] as i32, form[1] as i32);
        if b < -edge(&form.second) || c < -edge(&form.third) {
            return None;
        }
        let sum = |i: usize| {
            (form.second[i] as i32 >> down_second) + (form.third[i] as i32 >> down_third)
        };
        let edge = (reach >> down_second) + (reach >> down_third) + allowed(sum(0), sum(1));
        if beyond(b, c) > (edge >> 1) + 2 {
            return None;
        }
    }
    let (b, c) = (b >> down_b, c >> down_c);
    Some((Weight::from_bits(b), Weight::from_bits(c)))
}

/// See `Arithmetic::weights`.
#[inline(always)]
pub(super) fn weights(form: &FixedBarycentric, x: I16F16, y: I16F16) -> (Weight, Weight) {
    let s = form.shift & 31;
    let short = |x: I16F16| steps(x, s).clamp(-32768, 32767);
    let (x, y) = (short(x), short(y));
    let value = |form: &[i16; 2], down: u8, most: i32| {
        let sum = (form[0] as i32).wrapping_mul(x).wrapping_add((form[1] as i32).wrapping_mul(y));
        let w = sum >> (down & 31);
        if w < 0 {
            0
        } else if w > most {
            most
        } else {
            w
        }
    };
    let b = value(&form.second, form.second_down, 16384);
    let c = value(&form.third, form.third_down, 16384 - b);
    (Weight::from_bits(b), Weight::from_bits(c))
}

/// See `Arithmetic::spot`.
#[inline(always)]
pub(super) fn spot(outline: &FixedOutline, x: I16F16, y: I16F16, slope: Unit) -> Option<FixedSpot> {
    let s = outline.shift & 31;
    let (x, y) = (steps(x, s), steps(y, s));
    let slack = slack_steps(slope, s);
    if magnitude(x) as i32 > outline.half[0] as i32 + slack
        || magnitude(y) as i32 > outline.half[1] as i32 + slack
    {
        return None;
    }
    Some(FixedSpot { x, y, slack_q14: slack << 14 })
}

/// See `Arithmetic::beyond`.
#[inline(always)]
pub(super) fn beyond(edge: &FixedEdge, spot: &FixedSpot) -> bool {
    let p = (edge.normal[0] as i32).wrapping_mul(spot.x);
    let q = (edge.normal[1] as i32).wrapping_mul(spot.y);
    p.wrapping_add(q).wrapping_add((edge.offset as i32) << 14) < -spot.slack_q14
}

/// See `Arithmetic::blend`.
#[inline(always)]
pub(super) fn blend(n: &[[Unit; 3]; 3], b: Weight, c: Weight) -> [Unit; 3] {
    let (b, c) = (b.to_bits(), c.to_bits());
    let a = 16384 - b - c;
    let f = |i: usize| {
        let p = |u: Unit, w: i32| (u.to_bits() >> 2).wrapping_mul(w);
        let sum = p(n[0][i], a).wrapping_add(p(n[1][i], b)).wrapping_add(p(n[2][i], c));
        Unit::from_bits(sum >> 12)
    };
    Fixed::renormalize(&[f(0), f(1), f(2)]).0
}
/// See `Arithmetic::may_cross`.
///
/// The ray enters slab i at nᵢ/sᵢ and leaves slab j at fⱼ/sⱼ, so it misses where nᵢ·sⱼ > fⱼ·sᵢ. In
/// steps of 1/128 and of 2⁻¹², the way to the near plane rounded down and that to the far one up,
/// the half steps that the speeds may be wrong are (n + f)/2 in all; the quotients of
/// `Arithmetic::ratio`, which decide in the end, may be wrong by less than the other half and 16.
#[inline(always)]
pub(super) fn may_cross(near: &[i32; 3], far: &[i32; 3], speed: &[i32; 3]) -> bool {
    let n = |i: usize| near[i] >> COARSE_SHIFT;
    let f = |i: usize| (far[i] >> COARSE_SHIFT).wrapping_add(1);
    let s = |i: usize| speed[i].wrapping_add(16) >> 5;
    let (n, f, s) = ([n(0), n(1), n(2)], [f(0), f(1), f(2)], [s(0), s(1), s(2)]);
    let apart = |i: usize, j: usize| {
        let gap = n[i].wrapping_mul(s[j]).wrapping_sub(f[j].wrapping_mul(s[i]));
        gap > (n[i].wrapping_add(f[j])).wrapping_add(16)
    };
    for i in 0..3 {
        if n[i] > 0 && (apart(i, (i + 1) % 3) || apart(i, (i + 2) % 3)) {
            return false;
        }
    }
    true
}

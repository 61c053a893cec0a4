//! Spheres and what is round: squares in the exponent of the radius.

use super::kernel::{length_times_unit, magnitude, shift};
use super::{COARSE_SHIFT, FixedCoarse, FixedDirectionCone, FixedRadius, Unit};
use crate::math::root::{self, sqrt_u32};
use ::fixed::types::I16F16;

impl FixedRadius {
    #[inline(always)]
    pub(super) fn bits(&self) -> i32 {
        (self.mantissa as i32) << (self.shift & 31)
    }

    #[inline(always)]
    fn reciprocal(&self) -> i32 {
        self.reciprocal as i32 | 0x1_0000
    }

    /// Whether the reciprocal is that of the mantissa, but for what rounding both may do. Otherwise a
    /// point that is put back on the sphere could leave the range.
    pub(super) fn is_inverted(&self) -> bool {
        let (one, down) = (1u64 << 32, u32::from(self.missing));
        let reciprocal = u64::from(self.reciprocal) | 0x1_0000;
        let product = reciprocal.wrapping_mul(u64::from(self.mantissa).wrapping_shl(down));
        // half a step of the mantissa, and one of the reciprocal
        product.abs_diff(one) <= (reciprocal.wrapping_shl(down) >> 1).wrapping_add(1 << 16)
    }

    /// `a/r` in Q17: a·2³²/(m·2^e) with the operand brought to where the product keeps it.
    #[inline(always)]
    pub(super) fn divide(&self, a: i32) -> i32 {
        // length_times_unit divides by 2¹⁷, the reciprocal carries 2³², the result wants 2¹⁷
        let up = 2 + self.missing as i32 - self.shift as i32;
        length_times_unit(shift(a, up), self.reciprocal())
    }
}

/// See `Arithmetic::settle`.
#[inline(always)]
pub(super) fn settle(r: &FixedRadius, n: &mut [Unit; 3], p: &mut [I16F16; 3]) {
    // |n|² = 1 − e: a unit vector is n·(1 + e/2), and p is off by r·e/2. Squares of Q17 are Q34,
    // where 1 is a multiple of 2³²: the wrapping sum of the squares *is* −e, for |e| < ⅛, which
    // only spheres far smaller than a pixel exceed.
    let square = |n: Unit| n.to_bits().wrapping_mul(n.to_bits());
    let e_q34 = square(n[0]).wrapping_add(square(n[1])).wrapping_add(square(n[2])).wrapping_neg();
    let half = e_q34 >> 18;
    // 16 bits times 13; a position is off by far less than a unit, so that 18 bits do.
    let off = (r.mantissa as i32).wrapping_mul(half) >> (17 - (r.shift & 15));
    for (n, p) in n.iter_mut().zip(p) {
        let unit = n.to_bits();
        *p = I16F16::from_bits(p.to_bits().wrapping_add(off.wrapping_mul(unit >> 4) >> 13));
        *n = Unit::from_bits(unit.wrapping_add(unit.wrapping_mul(half) >> 17));
    }
}

/// See `Arithmetic::leg2`.
#[inline(always)]
pub(super) fn leg2(r: &FixedRadius, c: &[I16F16; 3], t: I16F16, d: &[Unit; 3]) -> Option<u32> {
    let bound = r.bits();
    let (t, s) = (t.to_bits(), r.shift & 31);
    let m = r.mantissa as u32;
    let mut rest = m.wrapping_mul(m);
    let mut correction = 0i32;
    for i in 0..3 {
        let f = c[i].to_bits().wrapping_sub(length_times_unit(t, d[i].to_bits()));
        if f.wrapping_add(bound) as u32 >= (bound as u32) << 1 {
            return None;
        }
        // (2ˢh + l)² ≈ 2²ˢ(h² + 2hl/2ˢ)
        let high = f >> s;
        correction = correction.wrapping_add(high.wrapping_mul(f.wrapping_sub(high << s)));
        let square = high.wrapping_mul(high) as u32;
        if square >= rest {
            return None;
        }
        rest -= square;
    }
    // h may be negative, and the rest then grows, but never beyond m² and a little
    let rest = rest.checked_add_signed(-(correction >> s << 1))?;
    if rest > 0 { Some(rest) } else { None }
}

/// See `Arithmetic::ahead`.
#[inline(always)]
pub(super) fn ahead(r: &FixedRadius, c: &[I16F16; 3], t: I16F16, d: &[Unit; 3]) -> I16F16 {
    // |c − t·d| is below r, sixteen bits, and |d| fifteen: the sum of products fits
    let s = r.shift & 31;
    let mut sum = 0i32;
    for i in 0..3 {
        let d = d[i].to_bits();
        let f = c[i].to_bits().wrapping_sub(length_times_unit(t.to_bits(), d));
        sum = sum.wrapping_add((f >> s).wrapping_mul(d >> 2));
    }
    I16F16::from_bits((sum >> 15) << s)
}

/// See `Arithmetic::may_hit`.
#[inline(always)]
pub(super) fn may_hit<const NEAR: bool>(
    ray: &FixedCoarse,
    center: &[I16F16; 3],
    r: &FixedRadius,
    limit: I16F16,
) -> bool {
    // In steps of 1/128: most spheres are out after one product.
    let c = |i: usize| center[i].to_bits().wrapping_sub(ray.o[i]) >> COARSE_SHIFT;
    let c = [c(0), c(1), c(2)];
    let p = |i: usize| c[i].wrapping_mul(ray.d_q12[i]);
    let t = p(0).wrapping_add(p(1)).wrapping_add(p(2)) >> 12;
    // Rounding moves each component of the direction by 2⁻¹³: a sphere that is hit, at most
    // t + r away, by less than 1.4·(t + r)/2¹², of which the radius has its part.
    let r = (r.coarse as i32).wrapping_add(t >> 11);
    let reach = (r as u32) << 1;
    let last = (limit.to_bits() >> COARSE_SHIFT) as u32;
    let beyond = || t.wrapping_add(r) as u32 > last.wrapping_add(reach);
    if !NEAR && beyond() {
        return false;
    }
    let mut square = 0u32;
    for i in 0..3 {
        let f = c[i].wrapping_sub(t.wrapping_mul(ray.d_q12[i]) >> 12);
        if f.wrapping_add(r) as u32 > reach {
            return false;
        }
        square = square.wrapping_add(f.wrapping_mul(f) as u32);
    }
    if NEAR && beyond() {
        return false;
    }
    // beyond 2¹⁵ steps (256 units) the squares don't fit, and the three bounds must do
    r >= 1 << 15 || square <= r.wrapping_mul(r) as u32
}

/// See `Arithmetic::may_pass`.
///
/// Two lines along d and a are |c·n|/|n| apart, where n = d × a and c leads from one to the other. Of a
/// vector's components, the largest and half of the others are no less than its length.
#[inline(always)]
pub(super) fn may_pass(
    ray: &FixedCoarse,
    p: &[I16F16; 3],
    axis: &[Unit; 3],
    r: &FixedRadius,
) -> bool {
    let d = &ray.d_q12;
    let a = |i: usize| axis[i].to_bits().wrapping_add(16) >> 5;
    let a = [a(0), a(1), a(2)];
    let n =
        |i: usize, j: usize| d[i].wrapping_mul(a[j]).wrapping_sub(d[j].wrapping_mul(a[i])) >> 12;
    let n = [n(1, 2), n(2, 0), n(0, 1)];
    let c = |i: usize| p[i].to_bits().wrapping_sub(ray.o[i]) >> COARSE_SHIFT;
    let c = [c(0), c(1), c(2)];
    let q = |i: usize| c[i].wrapping_mul(n[i]);
    let apart = q(0).wrapping_add(q(1)).wrapping_add(q(2)).wrapping_abs() >> 12;
    let n = [n[0].wrapping_abs(), n[1].wrapping_abs(), n[2].wrapping_abs()];
    let mut largest = n[0];
    largest = if n[1] > largest { n[1] } else { largest };
    largest = if n[2] > largest { n[2] } else { largest };
    let sum = n[0].wrapping_add(n[1]).wrapping_add(n[2]);
    let length = largest.wrapping_add(sum) >> 1;
    // Rounding moves a component of n by less than 2.5, its bound by less than 8, and each of c by one.
    let slack =
        c[0].wrapping_abs().wrapping_add(c[1].wrapping_abs()).wrapping_add(c[2].wrapping_abs());
    let reach = (r.coarse as i32).wrapping_mul(length.wrapping_add(8)) >> 12;
    apart <= reach.wrapping_add(slack >> 10).wrapping_add(4)
}

/// See `Arithmetic::direction_cone`.
///
/// A line in direction d through the origin passes the point v at √(|v|² − (d·v)²), so it comes
/// nearer than r where d·v > √(|v|² − r²).
#[inline(never)]
pub(super) fn direction_cone(way: &[i32; 3], r: i32, blurred: bool) -> Option<FixedDirectionCone> {
    // Twelve bits a component.
    let bits = magnitude(way[0]) | magnitude(way[1]) | magnitude(way[2]) | 1;
    let (_, zeros) = root::normalize(bits);
    let shift = 20u32.saturating_sub(zeros);
    let axis = way.map(|x| x >> shift);
    // The axis is rounded by less than two steps, the radius by one. Directions are wrong by 2⁻¹⁵ of
    // the way, a fraction of a step; those that `normalize` makes by less than 2⁻¹⁴ of a way
    // that is at most 2048 units long: ⅛ unit.
    let blur = if blurred { (1 << 13) >> shift } else { 0 };
    let reach = (r >> shift).wrapping_add(4).wrapping_add(blur) as u32;
    let square = axis.iter().map(|x| x.wrapping_mul(*x) as u32).fold(0, u32::wrapping_add);
    if reach > 1 << 13 || reach.wrapping_mul(reach) >= square {
        return None;
    }
    // A step for the root's rounding, another for a direction that isn't quite a unit long.
    let least = sqrt_u32(square.wrapping_sub(reach.wrapping_mul(reach))).saturating_sub(3);
    if least == 0 {
        return None;
    }
    Some(FixedDirectionCone { axis, below_q17: (least << 17) as i32 - 1 })
}

/// See `Arithmetic::pair_cone`: a ray from anywhere on the first sphere meets the second only where one from
/// its centre meets a sphere as large as both.
pub(super) fn pair_cone(
    (from, r): (&[i32; 3], i32),
    (to, s): (&[i32; 3], i32),
) -> Option<FixedDirectionCone> {
    let way = [0, 1, 2].map(|i| to[i].wrapping_sub(from[i]));
    // Where a ray starts, 1024 units after the last start at most, is off the sphere by what `leave` adds,
    // 2⁻¹⁶ of that way, and by what the direction was wrong, about as much: a sixteenth of a unit is more
    // than either could be together.
    direction_cone(&way, r.wrapping_add(s).wrapping_add(1 << 12), false)
}

//! Fixed point, for cores without a floating-point unit.
//!
//! Positions are Q16.16, directions Q17, coefficients Q14, radiance Q16.16. ARMv6-M multiplies
//! 32×32→32 in one cycle and has nothing wider, so every product is arranged to fit: a length
//! times a direction takes two products by splitting the length ([`kernel::length_times_unit`]),
//! squares are taken of sixteen-bit operands in the exponent of the radius they belong to.
//!
//! Direction of 17 fraction bits: with more than 18 the two-product form no longer reaches ±2048
//! units, and below 17 far edges move by a pixel (44.8 dB at 15 bits, 47.6 at 17 on the limit
//! scene).

pub(crate) mod constructors;
mod kernel;

use super::root::{reciprocal_q28, reciprocal_root_q29, sqrt_u32};
use super::{Arithmetic, log, root};
use ::fixed::types::extra::{U14, U17, U26};
use ::fixed::{FixedI32, types::I16F16};
use kernel::{length_times_unit, project, shift, wide_shr};

type Unit = FixedI32<U17>;
type Weight = FixedI32<U14>;
type Aim = FixedI32<U26>;

/// Q16.16 positions and Q17 directions in 32-bit words; needs no floating-point unit and no wide
/// multiplier.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fixed;

/// A radius of sixteen significant bits, and its reciprocal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedRadius {
    /// The radius is `mantissa << shift`, in 2⁻¹⁶; squares are taken after the same shift.
    mantissa: u16,
    /// 2³²/normalised mantissa − 2¹⁶, seventeen bits with the first implied.
    reciprocal: u16,
    /// In steps of the coarse test, with what rounding can add to it.
    coarse: u16,
    shift: u8,
    /// By how much the mantissa is short of sixteen bits.
    missing: u8,
}

/// The reciprocal of a length: `mantissa_q15 · 2^exponent` per unit, mantissa in 1 to 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedInverse {
    mantissa_q15: u32,
    exponent: i32,
}

/// `mantissa_q15 · 2^exponent`, mantissa in ½ to 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedIntensity {
    mantissa_q15: u16,
    exponent: i16,
}

/// Phong's exponent in Q8.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedExponent(u32);

/// η_i/η_t, and its square with sixteen significant bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedEta {
    eta_q16: u32,
    square: u16,
    /// The square is `square · 2^(exponent − 16)`.
    exponent: i8,
}

/// See [`Arithmetic::Barycentric`]: each form is `p·(x >> shift) + q·(y >> shift)`, 1 standing
/// at `14 + down` fraction bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedBarycentric {
    second: [i16; 2],
    third: [i16; 2],
    second_down: u8,
    third_down: u8,
    shift: u8,
}

/// See [`Arithmetic::Outline`]: half the sides in steps of 2^(`shift` − 16).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedOutline {
    half: [u16; 2],
    shift: u8,
}

/// See [`Arithmetic::Edge`]: `normal·(x, y) + offset·2¹⁴`, not negative inside, x and y in the
/// outline's steps; the larger component of the normal is ±2¹⁴.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedEdge {
    normal: [i16; 2],
    offset: i16,
}

/// See [`Arithmetic::Spot`].
#[derive(Clone, Copy, Debug)]
pub struct FixedSpot {
    x: i32,
    y: i32,
    slack_q14: i32,
}

/// A ray with Q12 directions and positions in steps of 1/128.
#[derive(Clone, Copy, Debug)]
pub struct FixedCoarse {
    o: [i32; 3],
    d: [i32; 3],
}

/// Positions lose this many bits in the coarse test.
const COARSE_SHIFT: u32 = 9;
/// What rounding can add to a coarse distance: half a step for the centre and for the origin,
/// one for each product.
const COARSE_SLACK: u32 = 3;
/// 1024 units: positions stay below 2048, where products still fit.
const FAR: i32 = 1 << 26;
/// 1024 in Q16: no single contribution is larger.
const BRIGHTEST: u32 = 1 << 26;

#[inline(always)]
fn lengths(v: &[I16F16; 3]) -> [i32; 3] {
    [v[0].to_bits(), v[1].to_bits(), v[2].to_bits()]
}

#[inline(always)]
fn units(v: &[Unit; 3]) -> [i32; 3] {
    [v[0].to_bits(), v[1].to_bits(), v[2].to_bits()]
}

#[inline(always)]
fn magnitude(x: i32) -> u32 {
    (x ^ (x >> 31)) as u32
}

/// Three integers shifted so that the largest magnitude is in 2²⁹ to 2³⁰, and by how much.
#[inline(always)]
fn align(v: &[i32; 3]) -> ([i32; 3], i32) {
    let (_, z) = root::normalize(magnitude(v[0]) | magnitude(v[1]) | magnitude(v[2]) | 1);
    let up = z as i32 - 2;
    if up >= 0 {
        let up = up & 31;
        ([v[0] << up, v[1] << up, v[2] << up], up)
    } else {
        ([v[0] >> 2, v[1] >> 2, v[2] >> 2], -2)
    }
}

/// 1/√s for a sum of squares s in 2²⁸ to 2³²: Y in Q29 from 1 to 2 with 1/√s = Y·2^(half − 16),
/// half, and s as a fraction, `s·2^(2·half − 32)` in Q32.
#[inline(always)]
fn inverse_root(s: u32) -> (u32, u32, u32) {
    let (m, half) = if s < 1 << 30 { (s << 2, 1) } else { (s, 0) };
    (reciprocal_root_q29(m), half, m)
}

/// The unit vector along three integers, to 17 bits, and their length: `root` in Q16 from ½ to 1,
/// of which `|v|` is `root·2^(1 − half − up)` in 2⁻¹⁶ of what the integers count.
#[inline(always)]
fn unit_along(v: &[i32; 3]) -> ([Unit; 3], i32) {
    // Fifteen bits a component, so that three squares fit a word, and five more for the
    // first-order correction: (32h + l)² ≈ 2¹⁰(h² + hl/16).
    let (x, up) = align(v);
    let (mut square, mut correction) = (0u32, 0i32);
    for x in &x {
        let (high, low) = (x >> 15, x >> 10 & 31);
        square = square.wrapping_add(high.wrapping_mul(high) as u32);
        correction = correction.wrapping_add(high.wrapping_mul(low));
    }
    let (y_q29, half, m) = inverse_root(square.wrapping_add((correction >> 4) as u32));
    // x·Y·2^(half − 14) in Q17, as (x/2¹²)·(Y·2^half in Q15)/2¹⁷
    let y = (y_q29 >> (14 - half)) as i32;
    let unit = |x: i32| Unit::from_bits(length_times_unit(x >> 12, y));
    let length = shift(root::root_q16(m, y_q29) as i32, 15 - up - half as i32);
    ([unit(x[0]), unit(x[1]), unit(x[2])], length)
}

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

impl FixedRadius {
    #[inline(always)]
    fn bits(&self) -> i32 {
        (self.mantissa as i32) << (self.shift & 31)
    }

    #[inline(always)]
    fn reciprocal(&self) -> i32 {
        self.reciprocal as i32 | 0x1_0000
    }

    /// `a/r` in Q17: a·2³²/(m·2^e) with the operand brought to where the product keeps it.
    #[inline(always)]
    fn divide(&self, a: i32) -> i32 {
        // length_times_unit divides by 2¹⁷, the reciprocal carries 2³², the result wants 2¹⁷
        let up = 2 + self.missing as i32 - self.shift as i32;
        length_times_unit(shift(a, up), self.reciprocal())
    }
}

impl Arithmetic for Fixed {
    type Length = I16F16;
    type Unit = Unit;
    type Weight = Weight;
    type Radiance = I16F16;
    type Radius = FixedRadius;
    type Leg2 = u32;
    type Inverse = FixedInverse;
    type Intensity = FixedIntensity;
    type Exponent = FixedExponent;
    type Eta = FixedEta;
    type Barycentric = FixedBarycentric;
    type Normal = [i16; 3];
    type Outline = FixedOutline;
    type Edge = FixedEdge;
    type Spot = FixedSpot;
    type Coarse = FixedCoarse;
    type Aim = Aim;
    type Span = i32;

    const NAME: &'static str = "fixed";
    const REFINE: bool = true;
    const FAR: I16F16 = I16F16::from_bits(FAR);
    const NO_LENGTH: I16F16 = I16F16::ZERO;
    const NO_UNIT: Unit = Unit::ZERO;
    const ONE_UNIT: Unit = Unit::ONE;
    const NO_WEIGHT: Weight = Weight::ZERO;
    const FULL: Weight = Weight::ONE;
    const BLACK: I16F16 = I16F16::ZERO;
    const NO_SPAN: i32 = 0;
    const CUTOFF: Weight = Weight::from_bits(64);

    #[inline(always)]
    fn along(o: &[I16F16; 3], t: I16F16, d: &[Unit; 3]) -> [I16F16; 3] {
        let at = |o: I16F16, d: Unit| o.wrapping_add(Self::scale(t, d));
        [at(o[0], d[0]), at(o[1], d[1]), at(o[2], d[2])]
    }

    #[inline(always)]
    fn scale(t: I16F16, u: Unit) -> I16F16 {
        I16F16::from_bits(length_times_unit(t.to_bits(), u.to_bits()))
    }

    #[inline(always)]
    fn project(v: &[I16F16; 3], d: &[Unit; 3]) -> I16F16 {
        I16F16::from_bits(project(&lengths(v), &units(d)))
    }

    #[inline(always)]
    fn dot(a: &[Unit; 3], b: &[Unit; 3]) -> Unit {
        Unit::from_bits(project(&units(a), &units(b)))
    }

    #[inline(always)]
    fn product(a: Unit, b: Unit) -> Unit {
        Unit::from_bits(length_times_unit(a.to_bits(), b.to_bits()))
    }

    #[inline(always)]
    fn cosine(a: &[Unit; 3], b: &[Unit; 3]) -> Weight {
        // fifteen bits each: the sum of three products is at most 2³⁰
        let p = |i: usize| (a[i].to_bits() >> 2).wrapping_mul(b[i].to_bits() >> 2);
        Weight::from_bits(p(0).wrapping_add(p(1)).wrapping_add(p(2)) >> 16)
    }

    #[inline(always)]
    fn reflect(d: &[Unit; 3], n: &[Unit; 3], dn: Unit) -> [Unit; 3] {
        let twice = dn.to_bits().wrapping_mul(2);
        let f = |d: Unit, n: Unit| {
            Unit::from_bits(d.to_bits().wrapping_sub(length_times_unit(twice, n.to_bits())))
        };
        [f(d[0], n[0]), f(d[1], n[1]), f(d[2], n[2])]
    }

    #[inline(always)]
    fn refract(d: &[Unit; 3], n: &[Unit; 3], cos_i: Unit, eta: &FixedEta) -> Option<[Unit; 3]> {
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

    #[inline(always)]
    fn ratio(a: I16F16, b: Unit) -> I16F16 {
        if b.to_bits() <= 0 || a >= Self::FAR {
            return Self::FAR;
        }
        let (m, z) = root::normalize(b.to_bits() as u32);
        let y_q17 = (reciprocal_q28(m) + (1 << 10)) >> 11;
        let bits = a.to_bits() as u32;
        // a·y/2¹³, that is sixteen times a/b·2^(z − 15); below 2³² since a < 2²⁶
        let p = (bits >> 13)
            .wrapping_mul(y_q17)
            .wrapping_add((bits & 0x1fff).wrapping_mul(y_q17) >> 13);
        if z <= 19 {
            I16F16::from_bits((p >> (19 - z)) as i32)
        } else if p >> (26 + 19 - z) != 0 {
            Self::FAR
        } else {
            I16F16::from_bits((p << (z - 19)) as i32)
        }
    }

    #[inline(always)]
    fn normalize(v: &[I16F16; 3]) -> ([Unit; 3], I16F16, FixedInverse) {
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
        let unit = |h: i32| Unit::from_bits(h.wrapping_mul(y_q14) >> (13 - half));
        let length = shift(root::root_q16(m, y_q29) as i32, 15 - up - half as i32);
        let inverse = FixedInverse { mantissa_q15: y_q29 >> 14, exponent: half as i32 + up - 15 };
        ([unit(h[0]), unit(h[1]), unit(h[2])], I16F16::from_bits(length), inverse)
    }

    #[inline(always)]
    fn renormalize(v: &[Unit; 3]) -> ([Unit; 3], Unit) {
        let (unit, length) = unit_along(&units(v));
        (unit, Unit::from_bits(length))
    }

    #[inline(always)]
    fn settle(r: &FixedRadius, n: &mut [Unit; 3], p: &mut [I16F16; 3]) {
        // |n|² = 1 − e: a unit vector is n·(1 + e/2), and p is off by r·e/2
        let e = (1 << 17) - project(&units(n), &units(n));
        let half = e >> 1;
        let off = length_times_unit(r.bits(), half);
        for (n, p) in n.iter_mut().zip(p) {
            let unit = n.to_bits();
            *p = I16F16::from_bits(p.to_bits().wrapping_add(length_times_unit(off, unit)));
            *n = Unit::from_bits(unit.wrapping_add(unit.wrapping_mul(half) >> 17));
        }
    }

    #[inline(always)]
    fn leave(p: &[I16F16; 3], n: &[Unit; 3], t: I16F16) -> [I16F16; 3] {
        // The roundings of a few products, a neighbour's among them; a direction is 2⁻¹⁸ wrong and
        // a root as much, together 2⁻¹⁷ of the way, doubled.
        let step = 8 + (t.to_bits() >> 16);
        let f = |p: I16F16, n: Unit| {
            I16F16::from_bits(p.to_bits().wrapping_add(n.to_bits().wrapping_mul(step) >> 17))
        };
        [f(p[0], n[0]), f(p[1], n[1]), f(p[2], n[2])]
    }

    #[inline(always)]
    fn radius(r: &FixedRadius) -> I16F16 {
        I16F16::from_bits(r.bits())
    }

    #[inline(always)]
    fn leg2(r: &FixedRadius, c: &[I16F16; 3], t: I16F16, d: &[Unit; 3]) -> Option<u32> {
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

    #[inline(always)]
    fn ahead(r: &FixedRadius, c: &[I16F16; 3], t: I16F16, d: &[Unit; 3]) -> I16F16 {
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

    #[inline(always)]
    fn leg(r: &FixedRadius, leg2: u32) -> I16F16 {
        I16F16::from_bits((sqrt_u32(leg2) << (r.shift & 31)) as i32)
    }

    #[inline(always)]
    fn square(r: &FixedRadius, a: I16F16) -> u32 {
        let a = magnitude(a.to_bits()) >> (r.shift & 31);
        let a = if a > 0xffff { 0xffff } else { a };
        a.wrapping_mul(a)
    }

    #[inline(always)]
    fn over(r: &FixedRadius, v: &[I16F16; 3]) -> [Unit; 3] {
        let f = |v: I16F16| Unit::from_bits(r.divide(v.to_bits()));
        [f(v[0]), f(v[1]), f(v[2])]
    }

    #[inline(always)]
    fn part(r: &FixedRadius, a: I16F16) -> Unit {
        Unit::from_bits(r.divide(a.to_bits()))
    }

    #[inline(always)]
    fn coarse(o: &[I16F16; 3], d: &[Unit; 3]) -> FixedCoarse {
        let o = |i: usize| o[i].to_bits() >> COARSE_SHIFT;
        let d = |i: usize| (d[i].to_bits() + 16) >> 5;
        FixedCoarse { o: [o(0), o(1), o(2)], d: [d(0), d(1), d(2)] }
    }

    #[inline(always)]
    fn may_hit(ray: &FixedCoarse, center: &[I16F16; 3], r: &FixedRadius, limit: I16F16) -> bool {
        let c = |i: usize| (center[i].to_bits() >> COARSE_SHIFT).wrapping_sub(ray.o[i]);
        let c = [c(0), c(1), c(2)];
        let p = |i: usize| c[i].wrapping_mul(ray.d[i]);
        let t = p(0).wrapping_add(p(1)).wrapping_add(p(2)) >> 12;
        // Rounding moves each component of the direction by 2⁻¹³: a sphere that is hit, at most
        // t + r away, by less than 1.4·(t + r)/2¹², of which the radius has its part.
        let r = (r.coarse as i32).wrapping_add(t >> 11);
        let reach = (r as u32) << 1;
        let last = (limit.to_bits() >> COARSE_SHIFT) as u32;
        if t.wrapping_add(r) as u32 > last.wrapping_add(reach) {
            return false;
        }
        let mut square = 0u32;
        for i in 0..3 {
            let f = c[i].wrapping_sub(t.wrapping_mul(ray.d[i]) >> 12);
            if f.wrapping_add(r) as u32 > reach {
                return false;
            }
            square = square.wrapping_add(f.wrapping_mul(f) as u32);
        }
        // beyond 2¹⁵ steps (256 units) the squares don't fit, and the three bounds must do
        r >= 1 << 15 || square <= r.wrapping_mul(r) as u32
    }

    #[inline(always)]
    fn barycentric(
        form: &FixedBarycentric,
        x: I16F16,
        y: I16F16,
        _: I16F16,
        slope: Unit,
    ) -> Option<(Weight, Weight)> {
        let s = form.shift & 31;
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
        let (b, c) = (b >> down_b, c >> down_c);
        if b.wrapping_add(c) > 16384 + (slack >> down_b) + (slack >> down_c) {
            return None;
        }
        Some((Weight::from_bits(b), Weight::from_bits(c)))
    }

    #[inline(always)]
    fn weights(form: &FixedBarycentric, x: I16F16, y: I16F16) -> (Weight, Weight) {
        let s = form.shift & 31;
        let short = |x: I16F16| steps(x, s).clamp(-32768, 32767);
        let (x, y) = (short(x), short(y));
        let value = |form: &[i16; 2], down: u8, most: i32| {
            let sum =
                (form[0] as i32).wrapping_mul(x).wrapping_add((form[1] as i32).wrapping_mul(y));
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

    #[inline(always)]
    fn unpack(n: &[i16; 3]) -> [Unit; 3] {
        let unit = |x: i16| Unit::from_bits((x as i32) << 3);
        [unit(n[0]), unit(n[1]), unit(n[2])]
    }

    #[inline(always)]
    fn spot(
        outline: &FixedOutline,
        x: I16F16,
        y: I16F16,
        _: I16F16,
        slope: Unit,
    ) -> Option<FixedSpot> {
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

    #[inline(always)]
    fn beyond(edge: &FixedEdge, spot: &FixedSpot) -> bool {
        let p = (edge.normal[0] as i32).wrapping_mul(spot.x);
        let q = (edge.normal[1] as i32).wrapping_mul(spot.y);
        p.wrapping_add(q).wrapping_add((edge.offset as i32) << 14) < -spot.slack_q14
    }

    /// In Q28, from Q17: a cone seldom fills the picture, and its squares cancel. So the
    /// products are of 64 bits, and only the root and the quotients of sixteen.
    fn cone(
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

    #[inline(always)]
    fn blend(n: &[[Unit; 3]; 3], b: Weight, c: Weight) -> [Unit; 3] {
        let (b, c) = (b.to_bits(), c.to_bits());
        let a = 16384 - b - c;
        let f = |i: usize| {
            let p = |u: Unit, w: i32| (u.to_bits() >> 2).wrapping_mul(w);
            let sum = p(n[0][i], a).wrapping_add(p(n[1][i], b)).wrapping_add(p(n[2][i], c));
            Unit::from_bits(sum >> 12)
        };
        Self::renormalize(&[f(0), f(1), f(2)]).0
    }

    #[inline(always)]
    fn weight(a: Weight, b: Weight) -> Weight {
        Weight::from_bits(((a.to_bits() as u32).wrapping_mul(b.to_bits() as u32) >> 14) as i32)
    }

    #[inline(always)]
    fn quotient(a: Weight, b: Weight) -> Weight {
        // a ≤ b ≤ 2 here: a << 14 fits
        let quotient = (a.to_bits() << 14).checked_div(b.to_bits()).unwrap_or(0);
        Weight::from_bits(quotient)
    }

    #[inline(always)]
    fn weight_of(u: Unit) -> Weight {
        Weight::from_bits(u.to_bits() >> 3)
    }

    #[inline(always)]
    fn power(cos: Weight, n: &FixedExponent) -> Weight {
        Weight::from_bits(log::power_q14(cos.to_bits() as u32, n.0) as i32)
    }

    #[inline(always)]
    fn dim(r: I16F16, w: Weight) -> I16F16 {
        let (r, w) = (r.to_bits() as u32, w.to_bits() as u32);
        let p = ((r >> 13).wrapping_mul(w) >> 1).wrapping_add((r & 0x1fff).wrapping_mul(w) >> 14);
        I16F16::from_bits(p as i32)
    }

    #[inline(always)]
    fn ramp(middle: I16F16, slope: I16F16, u: Unit) -> I16F16 {
        // Rounding can leave u a little beyond ±1.
        let sum = middle.to_bits().wrapping_add(length_times_unit(slope.to_bits(), u.to_bits()));
        I16F16::from_bits(if sum < 0 { 0 } else { sum })
    }

    #[inline(always)]
    fn gather(a: I16F16, b: I16F16) -> I16F16 {
        a.saturating_add(b)
    }

    #[inline(always)]
    fn mean(sum: I16F16, count: u16) -> I16F16 {
        // Powers of two, the common case, need no division.
        if count.is_power_of_two() {
            return I16F16::from_bits(sum.to_bits() >> count.trailing_zeros());
        }
        let quotient = sum.to_bits().checked_div(i32::from(count)).unwrap_or(0);
        I16F16::from_bits(quotient)
    }

    #[inline(always)]
    fn to_q16(r: I16F16) -> i32 {
        r.to_bits()
    }

    #[inline(always)]
    fn falloff(intensity: &FixedIntensity, inverse: &FixedInverse) -> I16F16 {
        let y_q14 = inverse.mantissa_q15 >> 1;
        let square_q15 = y_q14.wrapping_mul(y_q14) >> 13;
        let p_q30 = square_q15.wrapping_mul(intensity.mantissa_q15 as u32);
        let exponent = i32::from(intensity.exponent) + 2 * inverse.exponent - 14;
        I16F16::from_bits(wide_shr(p_q30, -exponent, BRIGHTEST) as i32)
    }

    #[inline(always)]
    fn constant(intensity: &FixedIntensity) -> I16F16 {
        let p =
            wide_shr(intensity.mantissa_q15 as u32, -i32::from(intensity.exponent) - 1, BRIGHTEST);
        I16F16::from_bits(p as i32)
    }

    #[inline(always)]
    fn odd(x: I16F16, per: I16F16) -> bool {
        // bit 32 of the product: the low bit of its floor
        let (x, per) = (x.to_bits(), per.to_bits());
        let low = ((x & 0xffff) as u32).wrapping_mul((per & 0xffff) as u32) >> 16;
        let mid = ((x & 0xffff) as u32).wrapping_mul((per >> 16) as u32);
        let high = ((x >> 16) as u32).wrapping_mul(per as u32);
        low.wrapping_add(mid).wrapping_add(high) >> 16 & 1 != 0
    }

    #[inline(always)]
    fn aim(base: Aim, step: Aim, n: i32, fraction: i32) -> Aim {
        let step = step.to_bits();
        let part = (step >> 8).wrapping_mul(fraction);
        Aim::from_bits(base.to_bits().wrapping_add(step.wrapping_mul(n)).wrapping_add(part))
    }

    #[inline(always)]
    fn aim_over(a: Aim, n: u32) -> Aim {
        let bits = i64::from(a.to_bits()).checked_div(i64::from(n));
        bits.map_or(a, |bits| Aim::from_bits(bits as i32))
    }

    #[inline(always)]
    fn sight(v: &[Aim; 3]) -> [Unit; 3] {
        unit_along(&[v[0].to_bits(), v[1].to_bits(), v[2].to_bits()]).0
    }

    #[inline(always)]
    fn spans(o: I16F16, d: Unit, log2_side: i8) -> (i32, i32) {
        // Slower than 2⁻¹⁴, a ray drifts less than the margin that the builder leaves.
        let d = if d.to_bits() < 8 { 8 } else { d.to_bits() as u32 };
        let left = (1i32 << (log2_side as u32 & 31)).wrapping_sub(o.to_bits());
        let left_q16 = shift(left, 16 - i32::from(log2_side)) as u32;
        let (m, z) = root::normalize(d);
        let y_q16 = reciprocal_q28(m) >> 12;
        let p_q24 = (left_q16 >> 8)
            .wrapping_mul(y_q16)
            .wrapping_add((left_q16 & 255).wrapping_mul(y_q16) >> 8);
        // 1/d = y·2^(z − 15)
        (shift(p_q24 as i32, z as i32 - 23), shift(y_q16 as i32, z as i32 - 15))
    }

    #[inline(always)]
    fn span(t: I16F16, log2_side: i8) -> i32 {
        shift(t.to_bits(), 16 - i32::from(log2_side)).wrapping_add(1)
    }

    #[inline(always)]
    fn half(s: i32) -> i32 {
        s >> 1
    }

    #[inline(always)]
    fn side(log2_side: i8) -> I16F16 {
        I16F16::from_bits(1 << (log2_side as u32 & 31))
    }
}

#[cfg(test)]
mod tests;

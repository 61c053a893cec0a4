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

mod cone;
pub(crate) mod constructors;
mod direction;
mod flat;
mod horizon;
mod kernel;
mod light;
mod place;
mod round;
mod types;
mod walk;

use bytemuck::AnyBitPattern;

use super::root::{reciprocal_q28, sqrt_u32};
use super::{Arithmetic, log, root};
use ::fixed::types::extra::{U14, U17, U26};
use ::fixed::{FixedI32, types::I16F16};
use kernel::{length_times_unit, lengths, magnitude, project, project_around, units};
use types::FixedFactor;
pub use types::{
    FixedBarycentric, FixedCoarse, FixedDecay, FixedDirectionCone, FixedEdge, FixedEta,
    FixedExponent, FixedIntensity, FixedInverse, FixedOutline, FixedPace, FixedRadius,
    FixedRotation, FixedScale, FixedSpot,
};

type Unit = FixedI32<U17>;
type Weight = FixedI32<U14>;
type Aim = FixedI32<U26>;

/// Q16.16 positions and Q17 directions in 32-bit words; needs no floating-point unit and no wide
/// multiplier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, AnyBitPattern)]
pub struct Fixed;

/// The way to a sphere loses this many bits in the coarse test.
const COARSE_SHIFT: u32 = 9;
/// What rounding can add to a coarse distance: half a step for the centre and for the origin,
/// one for each product.
const COARSE_SLACK: u32 = 3;
/// 1024 units: positions stay below 2048, where products still fit.
const FAR: i32 = 1 << 26;
/// 1024 in Q16: no single contribution is larger.
const BRIGHTEST: u32 = 1 << 26;

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
    type Decay = FixedDecay;
    type Barycentric = FixedBarycentric;
    type Normal = [i16; 3];
    type Outline = FixedOutline;
    type Edge = FixedEdge;
    type Spot = FixedSpot;
    type Coarse = FixedCoarse;
    type DirectionCone = FixedDirectionCone;
    type Aim = Aim;
    type Pace = FixedPace;
    type Span = i32;
    type Rotation = FixedRotation;
    type Scale = FixedScale;

    const NAME: &'static str = "fixed";
    const REFINE: bool = true;
    const FAR: I16F16 = I16F16::from_bits(FAR);
    const HORIZON: I16F16 = I16F16::from_bits(FAR - 1);
    const EVERY_DIRECTION: FixedDirectionCone = FixedDirectionCone { axis: [0; 3], below_q17: -1 };
    const NO_DIRECTION: FixedDirectionCone = FixedDirectionCone { axis: [0; 3], below_q17: 0 };
    const NO_LENGTH: I16F16 = I16F16::ZERO;
    const NO_UNIT: Unit = Unit::ZERO;
    const ONE_UNIT: Unit = Unit::ONE;
    const NO_WEIGHT: Weight = Weight::ZERO;
    const FULL: Weight = Weight::ONE;
    const NO_INTENSITY: FixedIntensity = FixedIntensity { mantissa_q15: 0, exponent: 0 };
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
        direction::refract(d, n, cos_i, eta)
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
    fn endless_ratio(a: I16F16, b: Unit) -> I16F16 {
        let quotient = Self::ratio(a, b);
        if quotient > Self::HORIZON { Self::HORIZON } else { quotient }
    }

    fn beyond_horizon(a: I16F16, b: Unit) -> I16F16 {
        // In 1024 units: to a million of them.
        Self::ratio(I16F16::from_bits(a.to_bits() >> 10), b)
    }

    #[inline(always)]
    fn endless_point(o: &[I16F16; 3], a: I16F16, b: Unit, d: &[Unit; 3]) -> [I16F16; 3] {
        horizon::endless_point(o, a, b, d)
    }

    #[inline(always)]
    fn endless_difference(a: I16F16, b: I16F16) -> I16F16 {
        a.wrapping_sub(b)
    }

    #[inline(always)]
    fn endless_project(v: &[I16F16; 3], d: &[Unit; 3]) -> I16F16 {
        I16F16::from_bits(project_around(&lengths(v), &units(d)))
    }

    #[inline(always)]
    fn normalize(v: &[I16F16; 3]) -> ([Unit; 3], I16F16, FixedInverse) {
        direction::normalize(v)
    }

    #[inline(always)]
    fn renormalize(v: &[Unit; 3]) -> ([Unit; 3], Unit) {
        let (unit, length) = direction::unit_along(&units(v));
        (unit, Unit::from_bits(length))
    }

    #[inline(always)]
    fn settle(r: &FixedRadius, n: &mut [Unit; 3], p: &mut [I16F16; 3]) {
        round::settle(r, n, p)
    }

    #[inline(always)]
    fn leave(p: &[I16F16; 3], n: &[Unit; 3], t: I16F16) -> [I16F16; 3] {
        let step = Self::clearance(p, t).to_bits();
        let f = |p: I16F16, n: Unit| {
            I16F16::from_bits(p.to_bits().wrapping_add(n.to_bits().wrapping_mul(step) >> 17))
        };
        [f(p[0], n[0]), f(p[1], n[1]), f(p[2], n[2])]
    }

    #[inline(always)]
    fn clearance(_: &[I16F16; 3], t: I16F16) -> I16F16 {
        // The roundings of a few products, a neighbour's among them; a direction is 2⁻¹⁸ wrong and
        // a root as much, together 2⁻¹⁷ of the way, doubled.
        I16F16::from_bits(8 + (t.to_bits() >> 16))
    }

    #[inline(always)]
    fn radius(r: &FixedRadius) -> I16F16 {
        I16F16::from_bits(r.bits())
    }

    #[inline(always)]
    fn leg2(r: &FixedRadius, c: &[I16F16; 3], t: I16F16, d: &[Unit; 3]) -> Option<u32> {
        round::leg2(r, c, t, d)
    }

    #[inline(always)]
    fn ahead(r: &FixedRadius, c: &[I16F16; 3], t: I16F16, d: &[Unit; 3]) -> I16F16 {
        round::ahead(r, c, t, d)
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
    fn share(a: I16F16, inverse: &FixedInverse) -> Unit {
        light::share(a, inverse)
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
        let d = |i: usize| (d[i].to_bits() + 16) >> 5;
        FixedCoarse { o: lengths(o), d_q12: [d(0), d(1), d(2)] }
    }

    #[inline(always)]
    fn may_hit<const NEAR: bool>(
        ray: &FixedCoarse,
        center: &[I16F16; 3],
        r: &FixedRadius,
        limit: I16F16,
    ) -> bool {
        round::may_hit::<NEAR>(ray, center, r, limit)
    }

    #[inline(always)]
    fn may_pass(ray: &FixedCoarse, p: &[I16F16; 3], axis: &[Unit; 3], r: &FixedRadius) -> bool {
        round::may_pass(ray, p, axis, r)
    }

    #[inline(always)]
    fn may_cross(near: &[I16F16; 3], far: &[I16F16; 3], speed: &[Unit; 3]) -> bool {
        flat::may_cross(&lengths(near), &lengths(far), &units(speed))
    }

    fn direction_cone(
        way: &[I16F16; 3],
        r: &FixedRadius,
        blurred: bool,
    ) -> Option<FixedDirectionCone> {
        round::direction_cone(&lengths(way), r.bits(), blurred)
    }

    fn pair_cone(
        (from, r): &([I16F16; 3], &FixedRadius),
        (to, s): &([I16F16; 3], &FixedRadius),
    ) -> Option<FixedDirectionCone> {
        round::pair_cone((&lengths(from), r.bits()), (&lengths(to), s.bits()))
    }

    #[inline(always)]
    fn is_near(_: I16F16) -> bool {
        // Nothing is too far: see `pair_cone`.
        true
    }

    #[inline(always)]
    fn in_cone(cone: &FixedDirectionCone, d: &[Unit; 3]) -> bool {
        // Below 2¹³ steps times 2¹⁷, and by Cauchy's inequality so is every part of the sum: no difference
        // overflows.
        let p = |i: usize| cone.axis[i].wrapping_mul(d[i].to_bits());
        // A sign is a bit without a branch.
        cone.below_q17.wrapping_sub(p(0).wrapping_add(p(1)).wrapping_add(p(2))) < 0
    }

    #[inline(always)]
    fn barycentric(
        form: &FixedBarycentric,
        x: I16F16,
        y: I16F16,
        _: I16F16,
        slope: Unit,
    ) -> Option<(Weight, Weight)> {
        flat::barycentric(form, x, y, slope)
    }

    #[inline(always)]
    fn weights(form: &FixedBarycentric, x: I16F16, y: I16F16) -> (Weight, Weight) {
        flat::weights(form, x, y)
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
        flat::spot(outline, x, y, slope)
    }

    #[inline(always)]
    fn beyond(edge: &FixedEdge, spot: &FixedSpot) -> bool {
        flat::beyond(edge, spot)
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
        cone::cone(w, d, axis, sin_cos, waist)
    }

    #[inline(always)]
    fn blend(n: &[[Unit; 3]; 3], b: Weight, c: Weight) -> [Unit; 3] {
        flat::blend(n, b, c)
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
    fn fraction(x: i32) -> Unit {
        Unit::from_bits(x.wrapping_mul(2))
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

    fn relative(a: I16F16, b: I16F16) -> Weight {
        light::relative(a, b)
    }

    #[inline(always)]
    fn portion(r: I16F16, part: u32) -> I16F16 {
        I16F16::from_bits(
            (u64::from(r.to_bits() as u32).wrapping_mul(u64::from(part)) >> 32) as i32,
        )
    }

    #[inline(always)]
    fn over_weight(r: I16F16, w: Weight) -> I16F16 {
        I16F16::from_bits(kernel::ratio(r.to_bits(), w.to_bits(), 14) as i32)
    }

    #[inline(always)]
    fn ramp(middle: I16F16, slope: I16F16, u: Unit) -> I16F16 {
        // Rounding can leave u a little beyond ±1.
        let sum = middle.to_bits().wrapping_add(length_times_unit(slope.to_bits(), u.to_bits()));
        I16F16::from_bits(if sum < 0 { 0 } else { sum })
    }

    #[inline(always)]
    fn gather(a: I16F16, b: I16F16) -> I16F16 {
        let sum = a.to_bits().wrapping_add(b.to_bits());
        I16F16::from_bits(if sum < 0 { i32::MAX } else { sum })
    }

    #[inline(always)]
    fn step(a: I16F16, b: I16F16, log2: u32) -> I16F16 {
        let rise = b.to_bits().wrapping_sub(a.to_bits());
        // A shift rounds down; what is added to negative numbers makes it round towards 0.
        let bias = (rise >> 31) & (1i32.wrapping_shl(log2)).wrapping_sub(1);
        I16F16::from_bits(rise.wrapping_add(bias).wrapping_shr(log2))
    }

    #[inline(always)]
    fn steps(a: I16F16, step: I16F16, n: u16) -> I16F16 {
        I16F16::from_bits(a.to_bits().wrapping_add(step.to_bits().wrapping_mul(i32::from(n))))
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
    fn from_q16(bits: i32) -> I16F16 {
        I16F16::from_bits(bits)
    }

    #[inline(always)]
    fn to_q17(u: Unit) -> i32 {
        u.to_bits()
    }

    #[inline(always)]
    fn ratio_q16(a: I16F16, b: I16F16) -> u32 {
        kernel::ratio(a.to_bits(), b.to_bits(), 16)
    }

    #[inline(always)]
    fn falloff(intensity: &FixedIntensity, inverse: &FixedInverse) -> I16F16 {
        light::falloff(intensity, inverse)
    }

    fn dim_intensity(i: &FixedIntensity, w: Weight) -> FixedIntensity {
        light::dimmed(i, w)
    }

    fn spread_intensity(i: &FixedIntensity, r: I16F16) -> FixedIntensity {
        light::spread(i, r)
    }

    #[inline(always)]
    fn constant(intensity: &FixedIntensity) -> I16F16 {
        light::constant(intensity)
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
    fn cells(x: I16F16, per: I16F16) -> i32 {
        ((i64::from(x.to_bits()).wrapping_mul(i64::from(per.to_bits()))) >> 16) as i32
    }

    #[inline(always)]
    fn eta_weight(eta: &FixedEta) -> Weight {
        Weight::from_bits((eta.eta_q16 >> 2) as i32)
    }

    #[inline(always)]
    fn decay(rate: &FixedDecay, t: I16F16) -> Weight {
        let product = u64::from(t.to_bits().unsigned_abs()).wrapping_mul(u64::from(rate.0)) >> 24;
        Weight::from_bits(log::exp2_q14(product) as i32)
    }

    #[inline(always)]
    fn weight_q14(bits: i32) -> Weight {
        Weight::from_bits(bits)
    }

    #[inline(always)]
    fn to_q14(w: Weight) -> i32 {
        w.to_bits()
    }

    #[inline(always)]
    fn length_q16(bits: i32) -> I16F16 {
        I16F16::from_bits(bits)
    }

    #[inline(always)]
    fn unit_q17(bits: i32) -> Unit {
        Unit::from_bits(bits)
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

    fn fitted(mut vectors: [[Aim; 3]; 3], width: u16, height: u16) -> [[Aim; 3]; 3] {
        let halvings = direction::halvings(&vectors, width, height);
        for aim in vectors.as_flattened_mut() {
            *aim = Aim::from_bits(aim.to_bits() >> halvings);
        }
        vectors
    }

    fn rise(v: &[Aim; 3]) -> u8 {
        direction::rise(&[v[0].to_bits(), v[1].to_bits(), v[2].to_bits()])
    }

    #[inline(always)]
    fn sight(v: &[Aim; 3], rise: u8) -> [Unit; 3] {
        direction::sight(&[v[0].to_bits(), v[1].to_bits(), v[2].to_bits()], rise)
    }

    #[inline(always)]
    fn pace(d: Unit) -> FixedPace {
        walk::pace(d)
    }

    #[inline(always)]
    fn takes(a: I16F16, pace: &FixedPace) -> I16F16 {
        walk::takes(a, pace)
    }

    #[inline(always)]
    fn spans(left: I16F16, cell: I16F16, pace: &FixedPace, unit: u8) -> (i32, i32) {
        (walk::span_of(left, pace, unit), walk::span_of(cell, pace, unit))
    }

    #[inline(always)]
    fn cells_before(o: I16F16, per: i32, _: u32, unit: u8) -> u32 {
        walk::cells_before(o, per, unit)
    }

    #[inline(always)]
    fn cells_long(cell: I16F16, n: u32) -> I16F16 {
        I16F16::from_bits(cell.to_bits().wrapping_mul(n as i32))
    }

    #[inline(always)]
    fn span(t: I16F16, unit: u8) -> i32 {
        (t.to_bits() >> (unit & 31)).wrapping_add(1)
    }

    #[inline(always)]
    fn spans_on(first: i32, s: i32, n: u32) -> i32 {
        first.wrapping_add(s.wrapping_mul(n as i32))
    }

    #[inline(always)]
    fn span_before(end: i32, s: i32) -> i32 {
        end.wrapping_sub(s)
    }

    #[inline(always)]
    fn rotate(r: &FixedRotation, v: &[I16F16; 3]) -> [I16F16; 3] {
        place::rotate(r, v)
    }

    #[inline(always)]
    fn rotate_back(r: &FixedRotation, v: &[I16F16; 3]) -> [I16F16; 3] {
        place::rotate(&r.back(), v)
    }

    #[inline(always)]
    fn turn(r: &FixedRotation, d: &[Unit; 3]) -> [Unit; 3] {
        place::turn(r, d)
    }

    #[inline(always)]
    fn turn_back(r: &FixedRotation, d: &[Unit; 3]) -> [Unit; 3] {
        place::turn(&r.back(), d)
    }

    #[inline(always)]
    fn magnify(s: &FixedScale, a: I16F16) -> I16F16 {
        s.factor.times(a)
    }

    #[inline(always)]
    fn reduce(s: &FixedScale, a: I16F16) -> I16F16 {
        s.reciprocal.times(a)
    }

    #[inline(always)]
    fn halved(s: i32, times: u32) -> i32 {
        s >> (times & 31)
    }

    #[inline(always)]
    fn side(log2_side: i8) -> I16F16 {
        I16F16::from_bits(1 << (log2_side as u32 & 31))
    }
}

#[cfg(test)]
mod tests;

//! What fixed point precomputes and remembers, with what its numbers stand for.

use crate::blob::stored_numbers;
use bytemuck::AnyBitPattern;

/// A radius of sixteen significant bits, and its reciprocal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, AnyBitPattern)]
#[repr(C)]
pub struct FixedRadius {
    /// The radius is `mantissa << shift`, in 2⁻¹⁶; squares are taken after the same shift.
    pub(super) mantissa: u16,
    /// 2³²/normalised mantissa − 2¹⁶, seventeen bits with the first implied.
    pub(super) reciprocal: u16,
    /// In steps of the coarse test, with what rounding can add to it.
    pub(super) coarse: u16,
    pub(super) shift: u8,
    /// By how much the mantissa is short of sixteen bits.
    pub(super) missing: u8,
}

/// The reciprocal of a length: `mantissa_q15 · 2^exponent` per unit, mantissa in 1 to 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedInverse {
    pub(super) mantissa_q15: u32,
    pub(super) exponent: i32,
}

/// `mantissa_q15 · 2^exponent`, mantissa in ½ to 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, AnyBitPattern)]
#[repr(C)]
pub struct FixedIntensity {
    pub(super) mantissa_q15: u16,
    pub(super) exponent: i16,
}

/// Phong's exponent in Q8.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedExponent(pub(super) u32);

/// η_i/η_t, and its square with sixteen significant bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedEta {
    pub(super) eta_q16: u32,
    pub(super) square: u16,
    /// The square is `square · 2^(exponent − 16)`.
    pub(super) exponent: i8,
}

/// Binary orders of magnitude that a unit of length takes, in Q24.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedDecay(pub(super) u32);

/// See [`Arithmetic::Barycentric`](crate::math::Arithmetic::Barycentric): each form is `p·(x >> shift) + q·(y >> shift)`, 1 standing
/// at `14 + down` fraction bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, AnyBitPattern)]
#[repr(C)]
pub struct FixedBarycentric {
    pub(super) second: [i16; 2],
    pub(super) third: [i16; 2],
    pub(super) second_down: u8,
    pub(super) third_down: u8,
    pub(super) shift: u8,
}

/// See [`Arithmetic::Outline`](crate::math::Arithmetic::Outline): half the sides in steps of 2^(`shift` − 16).
#[derive(Clone, Copy, Debug, PartialEq, Eq, AnyBitPattern)]
#[repr(C)]
pub struct FixedOutline {
    pub(super) half: [u16; 2],
    pub(super) shift: u8,
}

/// See [`Arithmetic::Edge`](crate::math::Arithmetic::Edge): `normal·(x, y) + offset·2¹⁴`, not negative inside, x and y in the
/// outline's steps; the larger component of the normal is ±2¹⁴.
#[derive(Clone, Copy, Debug, PartialEq, Eq, AnyBitPattern)]
#[repr(C)]
pub struct FixedEdge {
    pub(super) normal: [i16; 2],
    pub(super) offset: i16,
}

stored_numbers!(FixedRadius { mantissa, reciprocal, coarse, shift, missing }
    if |r| r.shift <= 9 && r.missing <= 11 && r.is_inverted());
stored_numbers!(FixedBarycentric { second, third, second_down, third_down, shift }
    if |f| f.second_down <= 16 && f.third_down <= 16 && f.shift <= 16
        && f.second.iter().chain(&f.third).all(|x| x.unsigned_abs() <= 16384));
stored_numbers!(FixedOutline { half, shift } if |o| o.shift <= 16 && o.half.iter().all(|&x| x <= 16385));
// 10¹² is less than 2⁴⁰; the smallest that isn't null is more than 2⁻³⁰.
stored_numbers!(FixedIntensity { mantissa_q15, exponent }
    if |x| x.mantissa_q15 <= 1 << 15 && x.exponent.unsigned_abs() <= 40);
stored_numbers!(FixedEdge { normal, offset }
    if |e| e.normal.iter().all(|x| x.unsigned_abs() <= 16384));

/// See [`Arithmetic::Spot`](crate::math::Arithmetic::Spot).
#[derive(Clone, Copy, Debug)]
pub struct FixedSpot {
    pub(super) x: i32,
    pub(super) y: i32,
    pub(super) slack_q14: i32,
}

/// See [`Arithmetic::Rotation`](crate::math::Arithmetic::Rotation): each entry is `high_q17` and `low_q30` together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedRotation {
    pub(super) high_q17: [[i32; 3]; 3],
    pub(super) low_q30: [[i16; 3]; 3],
}

/// See [`Arithmetic::Scale`](crate::math::Arithmetic::Scale): the factor and its reciprocal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FixedScale {
    pub(super) factor: FixedFactor,
    pub(super) reciprocal: FixedFactor,
}

/// `mantissa_q30 · 2^exponent`, mantissa in 1 to 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FixedFactor {
    pub(super) mantissa_q30: u32,
    pub(super) exponent: i8,
}

/// A ray with Q12 directions.
#[derive(Clone, Copy, Debug)]
pub struct FixedCoarse {
    pub(super) o: [i32; 3],
    pub(super) d_q12: [i32; 3],
}

/// See [`Arithmetic::Pace`](crate::math::Arithmetic::Pace): `y_q16·2^−down`.
#[derive(Clone, Copy, Debug)]
pub struct FixedPace {
    pub(super) y_q16: u32,
    pub(super) down: u32,
}

/// See [`Arithmetic::DirectionCone`](crate::math::Arithmetic::DirectionCone): those whose product with the axis is more than `below_q17`
/// steps of the axis.
#[derive(Clone, Copy, Debug)]
pub struct FixedDirectionCone {
    pub(super) axis: [i32; 3],
    pub(super) below_q17: i32,
}

//! Lights: intensities and distances with exponents of their own.

use super::kernel::wide_shr;
use super::{BRIGHTEST, FixedIntensity, FixedInverse, Unit, Weight};
use crate::math::root;
use ::fixed::types::I16F16;

/// See `Arithmetic::falloff`.
#[inline(always)]
pub(super) fn falloff(intensity: &FixedIntensity, inverse: &FixedInverse) -> I16F16 {
    let y_q14 = inverse.mantissa_q15 >> 1;
    let square_q15 = y_q14.wrapping_mul(y_q14) >> 13;
    let p_q30 = square_q15.wrapping_mul(intensity.mantissa_q15 as u32);
    let exponent = i32::from(intensity.exponent) + 2 * inverse.exponent - 14;
    I16F16::from_bits(wide_shr(p_q30, -exponent, BRIGHTEST) as i32)
}

/// See `Arithmetic::constant`.
#[inline(always)]
pub(super) fn constant(intensity: &FixedIntensity) -> I16F16 {
    let p = wide_shr(intensity.mantissa_q15 as u32, -i32::from(intensity.exponent) - 1, BRIGHTEST);
    I16F16::from_bits(p as i32)
}

/// See `Arithmetic::share`: sixteen bits of the length and sixteen of the reciprocal.
#[inline(always)]
pub(super) fn share(a: I16F16, inverse: &FixedInverse) -> Unit {
    let (m_q32, z) = root::normalize(a.to_bits().unsigned_abs());
    // a = (m/2¹⁶)·2^(−z), the reciprocal mantissa·2^(exponent − 15); the product in Q17
    let p = (m_q32 >> 16).wrapping_mul(inverse.mantissa_q15);
    let q17 = wide_shr(p, z as i32 - 2 - inverse.exponent, 1 << 17) as i32;
    Unit::from_bits(if a.to_bits() < 0 { -q17 } else { q17 })
}

/// See `Arithmetic::relative`. Seldom asked, so it may divide.
pub(super) fn relative(a: I16F16, b: I16F16) -> Weight {
    const MOST: u64 = 261_980;
    let (a, b) = (u64::from(a.to_bits() as u32), u64::from(b.to_bits() as u32));
    let ratio = (a << 14).checked_div(b).unwrap_or(0);
    Weight::from_bits((if ratio < MOST { ratio } else { MOST }) as i32)
}

/// `p·2^(exponent − 29)` with its mantissa brought to fifteen bits.
fn normalized(p: u32, exponent: i32) -> FixedIntensity {
    if p == 0 {
        return FixedIntensity { mantissa_q15: 0, exponent: 0 };
    }
    let (m, z) = root::normalize(p);
    FixedIntensity { mantissa_q15: (m >> 17) as u16, exponent: (exponent + 3 - z as i32) as i16 }
}

/// See `Arithmetic::dim_intensity`.
pub(super) fn dimmed(intensity: &FixedIntensity, w: Weight) -> FixedIntensity {
    let w = if w.to_bits() < 0 { 0 } else { w.to_bits() as u32 };
    let product = u32::from(intensity.mantissa_q15).wrapping_mul(w);
    normalized(product, i32::from(intensity.exponent))
}

/// See `Arithmetic::spread_intensity`: sixteen bits of the length.
pub(super) fn spread(intensity: &FixedIntensity, r: I16F16) -> FixedIntensity {
    if r.to_bits() <= 0 {
        return FixedIntensity { mantissa_q15: 0, exponent: 0 };
    }
    let (m, z) = root::normalize(r.to_bits() as u32);
    // r = a·2^(−z), a from ½ to 1 in Q16 of units, and its square in Q32
    let a = m >> 16;
    let square_q16 = a.wrapping_mul(a) >> 16;
    let product_q31 = square_q16.wrapping_mul(u32::from(intensity.mantissa_q15));
    normalized(product_q31 >> 2, i32::from(intensity.exponent) + 2 * (16 - z as i32))
}

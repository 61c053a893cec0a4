//! Reciprocals and roots without a divider: a byte from a table, then one step of a quadratic.
//!
//! For 1/√m take a table's y₀ ≈ 1/√m and e = 1 − m·y₀²; then 1/√m = y₀(1−e)^(−½) =
//! y₀(1 + e/2 + 3e²/8 + …). For 1/m, with e = 1 − m·y₀, it is y₀(1 + e + e² + …). With y₀ good to
//! 7 bits |e| stays below 2⁻⁶, and what the series leaves out is below 2⁻¹⁸.
//! (The method is Newton's, with one more term; see e.g. Muller, "Elementary Functions", 2016.)
//!
//! The residual e is exact: in the format where 1.0 is a multiple of 2³², a wrapping 32-bit
//! product *is* m·y₀² − 1, because the 1 falls off the top.

/// 128/√m for m = (i + ½)/256, i in 64 to 255; the entries below are never used.
static RECIPROCAL_ROOT: [u8; 256] = {
    let mut table = [0u8; 256];
    let mut i = 64;
    while i < 256 {
        let y = 128.0 / super::constant::sqrt((i as f64 + 0.5) / 256.0) + 0.5;
        table[i] = if y > 255.0 { 255 } else { y as u8 };
        i += 1;
    }
    table
};

/// 128/m for m = (i + ½)/256, i in 128 to 255.
static RECIPROCAL: [u8; 256] = {
    let mut table = [0u8; 256];
    let mut i = 128;
    while i < 256 {
        let y = 128.0 * 256.0 / (i as f64 + 0.5) + 0.5;
        table[i] = if y > 255.0 { 255 } else { y as u8 };
        i += 1;
    }
    table
};

/// Zeros above the highest bit of a byte: ARMv6-M has no instruction for it.
#[cfg(narrow_multiply)]
static LEADING_ZEROS: [u8; 256] = {
    let mut table = [8u8; 256];
    let mut i = 1;
    while i < 256 {
        table[i] = (i as u8).leading_zeros() as u8;
        i += 1;
    }
    table
};

#[inline(always)]
fn entry(table: &[u8; 256], m: u32) -> u32 {
    // The top byte of a word can't be out of a table of 256: no check is left.
    table[(m >> 24) as usize] as u32
}

/// 1 for 0, and 0 for others below 2³¹: without a branch.
#[cfg(narrow_multiply)]
#[inline(always)]
fn none(x: u32) -> u32 {
    x.wrapping_sub(1) >> 31
}

/// `x << z` with its top bit set, and `z`; for 0 the shift is 31.
#[inline(always)]
pub(crate) fn normalize(x: u32) -> (u32, u32) {
    #[cfg(not(narrow_multiply))]
    {
        let z = x.leading_zeros() & 31;
        (x << z, z)
    }
    #[cfg(narrow_multiply)]
    {
        let a = ((x >> 16 == 0) as u32) << 4;
        let x = x << a;
        let b = none(x >> 24) << 3;
        let x = x << b;
        let k = entry(&LEADING_ZEROS, x) & 7;
        (x << k, a + b + k)
    }
}

/// The same for x no less than 2¹⁶.
#[inline(always)]
pub(crate) fn normalize_large(x: u32) -> (u32, u32) {
    #[cfg(not(narrow_multiply))]
    {
        normalize(x)
    }
    #[cfg(narrow_multiply)]
    {
        let b = none(x >> 24) << 3;
        let x = x << b;
        let k = entry(&LEADING_ZEROS, x) & 7;
        (x << k, b + k)
    }
}

/// The same as [`normalize`] with an even shift: the result is in 2³⁰ to 2³².
#[inline(always)]
pub(crate) fn normalize_even(x: u32) -> (u32, u32) {
    #[cfg(not(narrow_multiply))]
    {
        let z = x.leading_zeros() & 30;
        (x << z, z)
    }
    #[cfg(narrow_multiply)]
    {
        let a = ((x >> 16 == 0) as u32) << 4;
        let x = x << a;
        let b = none(x >> 24) << 3;
        let x = x << b;
        let k = entry(&LEADING_ZEROS, x) & 6;
        (x << k, a + b + k)
    }
}

/// 1/√m in Q29, for m in Q32 from ¼ to 1; relative error below 2⁻¹⁸.
#[inline(always)]
pub(crate) fn reciprocal_root_q29(m_q32: u32) -> u32 {
    let y0_q7 = entry(&RECIPROCAL_ROOT, m_q32) as i32;
    let e_q37 = ((m_q32 >> 9) as i32).wrapping_mul(y0_q7.wrapping_mul(y0_q7)).wrapping_neg();
    let e_q21 = e_q37 >> 16;
    // e + ¾e², twice the relative correction
    let square_q21 = e_q21.wrapping_mul(e_q21) >> 21;
    let u_q21 = e_q21.wrapping_add(square_q21.wrapping_mul(3) >> 2);
    (y0_q7 << 22).wrapping_add(y0_q7.wrapping_mul(u_q21)) as u32
}

/// 1/m in Q28, for m in Q32 from ½ to 1; relative error below 2⁻¹⁸.
#[inline(always)]
pub(crate) fn reciprocal_q28(m_q32: u32) -> u32 {
    let y0_q7 = entry(&RECIPROCAL, m_q32) as i32;
    let e_q37 = ((m_q32 >> 2) as i32).wrapping_mul(y0_q7).wrapping_neg();
    let e_q21 = e_q37 >> 16;
    let u_q21 = e_q21.wrapping_add(e_q21.wrapping_mul(e_q21) >> 21);
    (y0_q7 << 21).wrapping_add(y0_q7.wrapping_mul(u_q21)) as u32
}

/// √x, relative error below 2⁻¹⁵ (it keeps sixteen bits).
#[inline(always)]
pub(crate) fn sqrt_u32(x: u32) -> u32 {
    let (m_q32, z) = normalize_even(x);
    root_q16(m_q32, reciprocal_root_q29(m_q32)) >> (z >> 1)
}

/// √m in Q16 from m in Q32, ¼ to 1, and its reciprocal root in Q29.
#[inline(always)]
pub(crate) fn root_q16(m_q32: u32, y_q29: u32) -> u32 {
    let y_q15 = y_q29.wrapping_add(1 << 13) >> 14;
    let m_q16 = ((m_q32 >> 15) + 1) >> 1;
    m_q16.wrapping_mul(y_q15) >> 15
}

/// The square root in single precision, correctly rounded: the instruction where the core has
/// one, `libm` elsewhere. Both give the same bits.
#[inline(always)]
pub fn sqrt_f32(x: f32) -> f32 {
    #[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
    {
        super::hardware::sqrt(x)
    }
    #[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
    {
        libm::sqrtf(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;

    #[test]
    fn reciprocal_roots_to_18_bits() {
        let mut worst = 0f64;
        for i in 0..3_000_000u64 {
            let m = ((1u64 << 30) + i * 1073) as u32;
            let exact = 1.0 / (f64::from(m) / 4294967296.0).sqrt();
            let got = f64::from(reciprocal_root_q29(m)) / f64::from(1 << 29);
            worst = worst.max(((got - exact) / exact).abs());
        }
        assert!(worst < 0.5f64.powi(17), "2^{}", worst.log2());
    }

    #[test]
    fn reciprocals_to_18_bits() {
        let mut worst = 0f64;
        for i in 0..2_000_000u64 {
            let m = ((1u64 << 31) + i * 1073) as u32;
            let exact = 1.0 / (f64::from(m) / 4294967296.0);
            let got = f64::from(reciprocal_q28(m)) / f64::from(1 << 28);
            worst = worst.max(((got - exact) / exact).abs());
        }
        assert!(worst < 0.5f64.powi(17), "2^{}", worst.log2());
    }

    #[test]
    fn roots_keep_sixteen_bits() {
        for i in 0..2_000_000u64 {
            let x = (i * i % 4294967291) as u32;
            let exact = f64::from(x).sqrt();
            let got = f64::from(sqrt_u32(x));
            assert!((got - exact).abs() <= 1.0 + exact * 0.5f64.powi(14), "{x} {got}");
        }
        assert_eq!(sqrt_u32(0), 0);
        assert!((65534..=65536).contains(&sqrt_u32(u32::MAX)));
    }
}

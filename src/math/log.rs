//! cos^n in fixed point: 2^(n·log₂ cos) by two tables, linear in between.
//!
//! A chord's error is at most an eighth of the squared step times the second derivative: 2.8e-6
//! in the logarithm with steps of 1/256 (times n in the result's relative error) and 1.5e-5 in
//! the power with steps of 1/64.

/// log₂(1 + i/256) in Q16.
static LOG2_Q16: [u32; 257] = {
    let mut table = [0u32; 257];
    let mut i = 0;
    while i <= 256 {
        // ln(1+x) = 2·artanh(x/(2+x))
        let x = i as f64 / 256.0;
        let a = x / (2.0 + x);
        let (mut sum, mut term, mut k) = (0.0, a, 1);
        while k < 40 {
            sum += term / k as f64;
            term *= a * a;
            k += 2;
        }
        table[i] = (2.0 * sum / core::f64::consts::LN_2 * 65536.0 + 0.5) as u32;
        i += 1;
    }
    table
};

/// 2^(−i/64) in Q16.
static EXP2_Q16: [u32; 65] = {
    let mut table = [0u32; 65];
    let mut i = 0;
    while i <= 64 {
        let x = -(i as f64) / 64.0 * core::f64::consts::LN_2;
        let (mut sum, mut term, mut k) = (0.0, 1.0, 1);
        while k < 30 {
            sum += term;
            term *= x / k as f64;
            k += 1;
        }
        table[i] = (sum * 65536.0 + 0.5) as u32;
        i += 1;
    }
    table
};

#[inline(always)]
fn between<const N: usize>(table: &[u32; N], i: u32, fraction_q10: u32) -> u32 {
    // N is a power of two and one: the masked index has a successor
    let i = i as usize & (N - 2);
    let (a, b) = (table[i], table[i + 1]);
    a.wrapping_add((b.wrapping_sub(a).wrapping_mul(fraction_q10) as i32 >> 10) as u32)
}

/// −log₂(x) in Q16, for x in Q14 from 1/2¹⁴ to 1.
#[inline(always)]
fn neg_log2_q16(x_q14: u32) -> u32 {
    let (m, z) = super::root::normalize(x_q14);
    // m in [1, 2) with 31 fraction bits; x = m·2^(17 − z)
    let fraction = m & 0x7fff_ffff;
    let log = between(&LOG2_Q16, fraction >> 23, (fraction >> 13) & 1023);
    (z.wrapping_sub(17) << 16).wrapping_sub(log)
}

/// x^n in Q14 for x in Q14 from 0 to 1 and n in Q8, up to 2²⁴; absolute error below 2⁻¹³ for
/// n ≤ 16, growing as n/2¹⁷ with the resolution of x.
#[inline(always)]
pub(crate) fn power_q14(x_q14: u32, n_q8: u32) -> u32 {
    let x = if x_q14 > 16384 { 16384 } else { x_q14 };
    let log_q16 = neg_log2_q16(x);
    // 2^−15 rounds to nothing, and so does all below it: 15·2²⁴ is the largest product
    match product_below(log_q16, n_q8, 15) {
        Some(product) if x != 0 => exp2_q14(u64::from(product >> 8)),
        _ => 0,
    }
}

/// a·b if it is less than `limit`·2²⁴, for a below 2²⁰ and a limit below 128: in one word, once products of
/// the high parts have shown that it fits.
#[inline(always)]
fn product_below(a: u32, b: u32, limit: u32) -> Option<u32> {
    // Both parts at least 1, or b below 2¹⁰: what passes is below 2³⁰.
    if (a >> 10).wrapping_mul(b >> 10) >= limit << 4 {
        return None;
    }
    // A small a is exact, and b may have all its bits.
    if a < 1 << 10 && a.wrapping_mul(b >> 14) >= limit << 10 {
        return None;
    }
    let product = a.wrapping_mul(b);
    if product < limit << 24 { Some(product) } else { None }
}

/// 2^−x in Q14 for x in Q16, within 1.5·10⁻⁵ and half a step; 0 from x = 15 on.
#[inline(always)]
pub(crate) fn exp2_q14(exponent_q16: u64) -> u32 {
    if exponent_q16 >= 15 << 16 {
        return 0;
    }
    let exponent_q16 = exponent_q16 as u32;
    let power_q16 = between(&EXP2_Q16, exponent_q16 >> 10, exponent_q16 & 1023);
    (power_q16 >> (exponent_q16 >> 16)).wrapping_add(2) >> 2
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    extern crate std;

    proptest! {
        #[test]
        fn products_in_a_word_are_those_of_two(a in 0u32..20, b in 0u32..32, x: u32, y: u32) {
            // Of any size.
            let (a, b) = (x & ((1 << a) | ((1 << a) - 1)), y & ((1 << b) | ((1 << b) - 1)));
            let a = a & ((1 << 20) - 1);
            let product = u64::from(a) * u64::from(b);
            let small = (product < 15 << 24).then_some(product as u32);
            prop_assert_eq!(product_below(a, b, 15), small);
        }
    }

    #[test]
    fn powers_against_f64() {
        for n in [1.0, 2.5, 3.0827, 11.1434, 32.0, 101.148, 400.0] {
            for x in 0..=16384u32 {
                let exact = (f64::from(x) / 16384.0).powf(n);
                let got = f64::from(power_q14(x, (n * 256.0 + 0.5) as u32)) / 16384.0;
                let bound = 1.3e-4 + 1e-5 * n;
                assert!((exact - got).abs() < bound, "{x}^{n}: {got} for {exact}");
            }
        }
        assert_eq!(power_q14(16384, 100_000 * 256), 16384);
        assert_eq!(power_q14(16383, u32::MAX), 0);
    }
}

//! Products that are wider than a word, from products that are not.

use super::Unit;
use crate::math::root;
use ::fixed::types::I16F16;

/// `t·u / 2¹⁷`, exactly the 64-bit result, for |t·u| < 2⁴⁴ and |u| ≤ 2¹⁸.
#[inline(always)]
pub(super) fn length_times_unit(t: i32, u: i32) -> i32 {
    if cfg!(narrow_multiply) {
        length_times_unit_narrow(t, u)
    } else {
        length_times_unit_wide(t, u)
    }
}

#[inline(always)]
fn length_times_unit_wide(t: i32, u: i32) -> i32 {
    ((i64::from(t) * i64::from(u)) >> 17) as i32
}

/// Splitting at 13 bits rather than at 16 makes two products do: both parts are below 2³¹.
/// The floor of the sum is that of the whole, since the low part's fraction is kept.
#[inline(always)]
fn length_times_unit_narrow(t: i32, u: i32) -> i32 {
    let high = (t >> 13).wrapping_mul(u);
    let low = (t & 0x1fff).wrapping_mul(u) >> 13;
    high.wrapping_add(low) >> 4
}

/// `Σ vᵢ·dᵢ / 2¹⁷`, exactly the 64-bit result where that is below 2²⁷.
#[inline(always)]
pub(super) fn project(v: &[i32; 3], d: &[i32; 3]) -> i32 {
    if cfg!(narrow_multiply) { project_narrow(v, d) } else { project_wide(v, d) }
}

#[inline(always)]
fn project_wide(v: &[i32; 3], d: &[i32; 3]) -> i32 {
    let p = |i: usize| i64::from(v[i]).wrapping_mul(i64::from(d[i]));
    (p(0).wrapping_add(p(1)).wrapping_add(p(2)) >> 17) as i32
}

#[inline(always)]
fn project_narrow(v: &[i32; 3], d: &[i32; 3]) -> i32 {
    let high = |i: usize| (v[i] >> 13).wrapping_mul(d[i]);
    let low = |i: usize| (v[i] & 0x1fff).wrapping_mul(d[i]);
    let high = high(0).wrapping_add(high(1)).wrapping_add(high(2));
    // Each low product is below 2³⁰ for |d| ≤ 1, and their sum, by Cauchy's inequality, below
    // √3·2³⁰ < 2³¹.
    let low = low(0).wrapping_add(low(1)).wrapping_add(low(2)) >> 13;
    high.wrapping_add(low) >> 4
}

/// `Σ vᵢ·dᵢ / 2¹⁷` modulo 2³², exactly the 64-bit result of any v, |d| ≤ 1: for points that may lie
/// beyond the range.
#[inline(always)]
pub(super) fn project_around(v: &[i32; 3], d: &[i32; 3]) -> i32 {
    if cfg!(narrow_multiply) { project_around_narrow(v, d) } else { project_wide(v, d) }
}

/// As [`project_narrow`], but the four bits that would fall off the top have products of their own.
#[inline(always)]
fn project_around_narrow(v: &[i32; 3], d: &[i32; 3]) -> i32 {
    let high = |i: usize| (v[i] >> 17).wrapping_mul(d[i]);
    let middle = |i: usize| (v[i] >> 13 & 15).wrapping_mul(d[i]);
    let low = |i: usize| (v[i] & 0x1fff).wrapping_mul(d[i]);
    let high = high(0).wrapping_add(high(1)).wrapping_add(high(2));
    let middle = middle(0).wrapping_add(middle(1)).wrapping_add(middle(2));
    let low = low(0).wrapping_add(low(1)).wrapping_add(low(2)) >> 13;
    high.wrapping_add(middle.wrapping_add(low) >> 4)
}

/// `x << n`, or `x >> −n` for a negative n; n in −31 to 31.
#[inline(always)]
pub(super) fn shift(x: i32, n: i32) -> i32 {
    if n >= 0 { x << (n & 31) } else { x >> (-n & 31) }
}

/// `x >> n`, or `x << −n`, for any n, and at most `limit`.
#[inline(always)]
pub(super) fn wide_shr(x: u32, n: i32, limit: u32) -> u32 {
    if n >= 0 {
        let y = if n > 31 { 0 } else { x >> (n & 31) };
        if y > limit { limit } else { y }
    } else {
        let up = -n;
        if x == 0 {
            0
        } else if up > 31 || x > limit >> (up & 31) {
            limit
        } else {
            x << (up & 31)
        }
    }
}

/// `a·2^up/b` for a ≥ 0, at most 2³¹ − 1, and that for b ≤ 0; up at most 16. Relative error below
/// 2⁻¹⁷. The product is of 64 bits: it is for what is done once a record, not once a ray.
#[inline(never)]
pub(super) fn ratio(a: i32, b: i32, up: u32) -> u32 {
    const MOST: u32 = i32::MAX as u32;
    if b <= 0 {
        return MOST;
    }
    // b = m·2⁻ᶻ, and 1/m is y·2⁻⁶⁰
    let (m, z) = root::normalize(b as u32);
    let product = u64::from(if a < 0 { 0 } else { a as u32 })
        .wrapping_mul(u64::from(root::reciprocal_q28(m)));
    let quotient = product >> (60u32.wrapping_sub(up).wrapping_sub(z) & 63);
    if quotient > u64::from(MOST) { MOST } else { quotient as u32 }
}

/// The bits of three lengths.
#[inline(always)]
pub(super) fn lengths(v: &[I16F16; 3]) -> [i32; 3] {
    [v[0].to_bits(), v[1].to_bits(), v[2].to_bits()]
}

/// The bits of three components.
#[inline(always)]
pub(super) fn units(v: &[Unit; 3]) -> [i32; 3] {
    [v[0].to_bits(), v[1].to_bits(), v[2].to_bits()]
}

/// |x|, or one less for a negative x: which bits it needs.
#[inline(always)]
pub(super) fn magnitude(x: i32) -> u32 {
    (x ^ (x >> 31)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    extern crate std;

    proptest! {
        #[test]
        fn narrow_products_are_exact(t in -(1i32 << 27)..(1 << 27), u in -(1i32 << 17)..=(1 << 17)) {
            prop_assert_eq!(length_times_unit_narrow(t, u), length_times_unit_wide(t, u));
        }

        #[test]
        fn narrow_products_of_short_lengths_take_units_of_two(
            t in -(1i32 << 25)..(1 << 25), u in -(1i32 << 18)..=(1 << 18),
        ) {
            prop_assert_eq!(length_times_unit_narrow(t, u), length_times_unit_wide(t, u));
        }

        #[test]
        fn narrow_projections_are_exact(
            v in prop::array::uniform3(-(1i32 << 26)..(1 << 26)),
            d in prop::array::uniform3(-1.0f64..1.0),
        ) {
            let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt().max(1e-3);
            let d = d.map(|x| (x / length * 131072.0) as i32);
            prop_assert_eq!(project_narrow(&v, &d), project_wide(&v, &d));
        }

        #[test]
        fn narrow_projections_of_any_vector_are_exact(
            v in prop::array::uniform3(any::<i32>()),
            d in prop::array::uniform3(-1.0f64..1.0),
        ) {
            let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt().max(1e-3);
            let d = d.map(|x| (x / length * 131072.0) as i32);
            prop_assert_eq!(project_around_narrow(&v, &d), project_wide(&v, &d));
        }

        #[test]
        fn ratios_to_seventeen_bits(a in 0..=i32::MAX, b in 1..=i32::MAX, up in 0u32..=16) {
            let exact = (f64::from(a) * f64::from(1u32 << up) / f64::from(b)).min(2147483647.0);
            let got = f64::from(ratio(a, b, up));
            prop_assert!((got - exact).abs() <= 1.0 + exact * 0.5f64.powi(17), "{got} {exact}");
        }

        #[test]
        fn shifts_saturate(x: u32, n in -64i32..64) {
            let exact = if n >= 0 { u128::from(x) >> n } else { u128::from(x) << -n };
            prop_assert_eq!(u128::from(wide_shr(x, n, 1 << 26)), exact.min(1 << 26));
        }
    }
}

//! Planes that have no end, in a range that has one.

use super::Unit;
use super::kernel::lengths;
use crate::math::root::{self, reciprocal_q28};
use ::fixed::types::I16F16;

/// See `Arithmetic::endless_point`. Seldom asked, so its products have 64 bits.
#[inline(never)]
pub(super) fn endless_point(o: &[I16F16; 3], a: I16F16, b: Unit, d: &[Unit; 3]) -> [I16F16; 3] {
    // 1/b is y·2^(z − 43), y the reciprocal of its mantissa in Q28.
    let (m, z) = root::normalize(if b.to_bits() > 0 { b.to_bits() as u32 } else { 1 });
    let product = i64::from(a.to_bits()).wrapping_mul(i64::from(reciprocal_q28(m)));
    let t_q16 = product >> (43u32.wrapping_sub(z) & 63);
    let o = lengths(o);
    let at = |i: usize| {
        let way = t_q16.wrapping_mul(i64::from(d[i].to_bits())) >> 17;
        // What doesn't fit falls off the top.
        I16F16::from_bits(o[i].wrapping_add(way as i32))
    };
    [at(0), at(1), at(2)]
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;

    #[test]
    fn a_floor_thousands_of_units_away() {
        for (height, slope) in [(8.5, 40), (3.0, 100), (100.0, 1000), (1.0, 8)] {
            let d = [Unit::from_num(0.6), Unit::from_bits(-slope), Unit::from_num(-0.8)];
            let o = [1.5, height, -2.25].map(I16F16::from_num::<f64>);
            let t = height / (f64::from(slope) / 131_072.0);
            let got = endless_point(&o, o[1], -d[1], &d);
            for i in 0..3 {
                let want = o[i].to_num::<f64>() + t * d[i].to_num::<f64>();
                let off = (got[i].to_num::<f64>() - want).abs();
                assert!(off <= t / 131_072.0 + 1e-3, "{} {want}", got[i]);
            }
        }
    }

    #[test]
    fn it_never_panics() {
        let extreme = [i32::MIN, -1, 0, 1, 7, i32::MAX];
        for a in extreme.map(I16F16::from_bits) {
            for b in [-1, 0, 1, 2, 1 << 17].map(Unit::from_bits) {
                for d in [-(1 << 17), 0, 1 << 17].map(Unit::from_bits) {
                    let _ = endless_point(&[a; 3], a, b, &[d; 3]);
                }
            }
        }
    }
}

//! Placing: rotations and scales of whole groups of shapes.
//!
//! A position that is rotated there and back must come out where it was, to a step or two, or a
//! ray that leaves a surface starts behind it; at Q17 the entries of a rotation would be 2⁻¹⁸ wrong,
//! sixteen steps at a distance of 64. So an entry has thirty fraction bits, in two parts that
//! products of 32 bits can take. A scale is used a few times a ray: one wide product each.

use super::kernel::{lengths, project, units};
use super::{FixedFactor, FixedRotation, Unit};
use ::fixed::types::I16F16;

impl FixedRotation {
    /// Its inverse, which is its transpose.
    #[inline(always)]
    pub(super) fn back(&self) -> Self {
        let (h, l) = (&self.high_q17, &self.low_q30);
        let high = |i: usize| [h[0][i], h[1][i], h[2][i]];
        let low = |i: usize| [l[0][i], l[1][i], l[2][i]];
        Self { high_q17: [high(0), high(1), high(2)], low_q30: [low(0), low(1), low(2)] }
    }

    /// A row's product with a vector, in the vector's steps.
    #[inline(always)]
    fn row(&self, i: usize, v: &[i32; 3]) -> i32 {
        let low = &self.low_q30[i];
        let low = [i32::from(low[0]), i32::from(low[1]), i32::from(low[2])];
        project(v, &self.high_q17[i]).wrapping_add(project(v, &low).wrapping_add(1 << 12) >> 13)
    }
}

/// See `Arithmetic::rotate`.
#[inline(always)]
pub(super) fn rotate(r: &FixedRotation, v: &[I16F16; 3]) -> [I16F16; 3] {
    let v = lengths(v);
    let at = |i: usize| I16F16::from_bits(r.row(i, &v));
    [at(0), at(1), at(2)]
}

/// See `Arithmetic::turn`.
#[inline(always)]
pub(super) fn turn(r: &FixedRotation, d: &[Unit; 3]) -> [Unit; 3] {
    // nine bits more, for rounding to nearest
    let [x, y, z] = units(d);
    let d = [x << 9, y << 9, z << 9];
    let at = |i: usize| Unit::from_bits(r.row(i, &d).wrapping_add(1 << 8) >> 9);
    [at(0), at(1), at(2)]
}

impl FixedFactor {
    /// The product with a length.
    #[inline(always)]
    pub(super) fn times(self, a: I16F16) -> I16F16 {
        const MOST: i64 = 1 << 27;
        let product = i64::from(a.to_bits()).wrapping_mul(i64::from(self.mantissa_q30));
        let down = 30u32.wrapping_sub(self.exponent as u32) & 63;
        let rounded = product.wrapping_add(1 << (down.saturating_sub(1) & 63)) >> down;
        I16F16::from_bits(rounded.clamp(-MOST, MOST) as i32)
    }
}

#[cfg(test)]
mod tests {
    use super::super::constructors::{rotation, scale};
    use super::*;
    use crate::math::{Arithmetic, Fixed};
    use crate::scene::Transform;
    use proptest::prelude::*;
    extern crate std;

    proptest! {
        #[test]
        fn rotations_are_exact_there_and_back(
            axis in prop::array::uniform3(-1.0f64..1.0), angle in -720.0f64..720.0,
            v in prop::array::uniform3(-600.0f64..600.0),
        ) {
            prop_assume!(axis.iter().any(|x| x.abs() > 1e-3));
            let exact = Transform::IDENTITY.rotated(axis, angle).rotation;
            let r = rotation(&exact);
            let fixed = v.map(|x| I16F16::from_num(x));
            let there = Fixed::rotate(&r, &fixed);
            for i in 0..3 {
                let want: f64 = (0..3).map(|j| exact[i][j] * fixed[j].to_num::<f64>()).sum();
                let off = (there[i].to_num::<f64>() - want) * 65536.0;
                prop_assert!(off.abs() <= 2.0, "{off} steps");
                let back = Fixed::rotate_back(&r, &there)[i].to_bits() - fixed[i].to_bits();
                prop_assert!(back.abs() <= 4, "{back} steps");
            }
            let length = v.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-3);
            let d = v.map(|x| Unit::from_num(x / length));
            let turned = Fixed::turn(&r, &d);
            for i in 0..3 {
                let want: f64 = (0..3).map(|j| exact[i][j] * d[j].to_num::<f64>()).sum();
                let off = (turned[i].to_num::<f64>() - want) * 131_072.0;
                prop_assert!(off.abs() <= 1.0, "{off} steps");
            }
        }

        #[test]
        fn scales_round_to_nearest(log2 in -9.9f64..9.9, a in -1000.0f64..1000.0) {
            let factor = log2.exp2();
            let s = scale(factor).unwrap();
            let a = I16F16::from_num(a);
            for (got, want) in [
                (Fixed::magnify(&s, a), a.to_num::<f64>() * factor),
                (Fixed::reduce(&s, a), a.to_num::<f64>() / factor),
            ] {
                let want = (want * 65536.0).clamp(-134_217_728.0, 134_217_728.0);
                prop_assert!((f64::from(got.to_bits()) - want).abs() <= 0.75, "{got} {want}");
            }
        }
    }

    #[test]
    fn one_is_exact() {
        let r = rotation(&Transform::IDENTITY.rotation);
        let v = [I16F16::from_bits(12345), I16F16::from_bits(-7), I16F16::MAX];
        assert_eq!(Fixed::rotate(&r, &[v[0], v[1], v[0]]), [v[0], v[1], v[0]]);
        let s = scale(1.0).unwrap();
        assert_eq!(Fixed::magnify(&s, v[0]), v[0]);
        assert_eq!(Fixed::reduce(&s, v[1]), v[1]);
    }
}

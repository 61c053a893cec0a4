//! Directions over a hemisphere, spread with the cosine and stratified.
//!
//! The unit disc below the hemisphere is cut into M rings of equal area and each ring into N
//! sectors; a ray goes up from a random place of each cell (Malley's method, as in Shirley and
//! Chiu, "A low distortion map between disk and square", 1997): with u, v in 0 to 1,
//! sin²θ = (j + u)/M and φ = 2π(k + v)/N. All of it is whole numbers, so the directions are the
//! same in every arithmetic, up to its rounding.

use crate::math::{Arithmetic, hash, spread, sqrt_u32};

/// More rings than this aren't kept while gradients are summed.
pub(crate) const MAX_RINGS: usize = 16;

/// sin(2πt/2¹⁶) in Q15, within 2⁻¹³: the quarter wave's odd polynomial (Hastings,
/// "Approximations for digital computers", 1955).
#[inline]
pub(crate) fn sine_q15(t_q16: u32) -> i32 {
    let within = (t_q16 & 0x3fff) as i32;
    let x = if t_q16 & 0x4000 != 0 { 0x4000 - within } else { within };
    // x in Q14 quarters: the coefficients of sin(πx/2), in Q15
    let x2 = x.wrapping_mul(x) >> 14;
    let p = 2603 - (x2.wrapping_mul(142) >> 14);
    let p = 21_165 - (x2.wrapping_mul(p) >> 14);
    let p = 51_472 - (x2.wrapping_mul(p) >> 14);
    let sine = x.wrapping_mul(p) >> 14;
    let sine = if sine > 32_767 { 32_767 } else { sine };
    if t_q16 & 0x8000 != 0 { -sine } else { sine }
}

/// cos(2πt/2¹⁶) in Q15.
#[inline]
pub(crate) fn cosine_q15(t_q16: u32) -> i32 {
    sine_q15(t_q16.wrapping_add(0x4000))
}

/// `i/n` in Q16.
#[inline]
pub(crate) fn part_q16(i: u32, n: u32) -> u32 {
    (i << 16).checked_div(n).unwrap_or(0)
}

/// √x in Q16, for x in Q16 from 0 to 1.
#[inline]
pub(crate) fn root_q16(x_q16: u32) -> u32 {
    if x_q16 >= 0x1_0000 { 0x1_0000 } else { sqrt_u32(x_q16 << 16) }
}

/// Two unit vectors that make a right-handed frame with a normal, the normal being the third.
#[inline]
pub(crate) fn tangents<A: Arithmetic>(n: &[A::Unit; 3]) -> [[A::Unit; 3]; 2] {
    // The cross product with the axis that the normal is farthest from: never shorter than √(2/3).
    let abs = |u: A::Unit| if u < A::NO_UNIT { -u } else { u };
    let (x, y, z) = (abs(n[0]), abs(n[1]), abs(n[2]));
    let across = if x <= y && x <= z {
        [A::NO_UNIT, n[2], -n[1]]
    } else if y <= z {
        [-n[2], A::NO_UNIT, n[0]]
    } else {
        [n[1], -n[0], A::NO_UNIT]
    };
    let (tangent, _) = A::renormalize(&across);
    let bitangent = cross::<A>(n, &tangent);
    [tangent, bitangent]
}

/// `a × b` of two unit vectors.
#[inline]
pub(crate) fn cross<A: Arithmetic>(a: &[A::Unit; 3], b: &[A::Unit; 3]) -> [A::Unit; 3] {
    let f = |i: usize, j: usize| A::product(a[i], b[j]) - A::product(a[j], b[i]);
    [f(1, 2), f(2, 0), f(0, 1)]
}

/// The direction with the components x and y along the tangents and z along the normal, in Q16.
#[inline]
pub(crate) fn raised<A: Arithmetic>(
    [x, y, z]: [i32; 3],
    [tangent, bitangent]: &[[A::Unit; 3]; 2],
    normal: &[A::Unit; 3],
) -> [A::Unit; 3] {
    let (x, y, z) = (A::fraction(x), A::fraction(y), A::fraction(z));
    let f = |i: usize| {
        A::product(x, tangent[i]) + A::product(y, bitangent[i]) + A::product(z, normal[i])
    };
    A::renormalize(&[f(0), f(1), f(2)]).0
}

/// The hemisphere's components in Q16 for a place in the square, both in Q16 from 0 to 1.
#[inline]
pub(crate) fn lifted(u_q16: u32, turn_q16: u32) -> [i32; 3] {
    let sine = root_q16(u_q16) as i32;
    let up = root_q16(0x1_0000u32.saturating_sub(u_q16)) as i32;
    // Q16 of Q15: below 2³¹, and a step less than 1 at most
    let along = |c: i32| (sine >> 1).wrapping_mul(c) >> 14;
    [along(cosine_q15(turn_q16)), along(sine_q15(turn_q16)), up]
}

/// How a hemisphere is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Strata {
    pub(crate) rings: u32,
    pub(crate) sectors: u32,
}

impl Strata {
    /// The direction through cell (ring, sector), moved by the random numbers of `seed`.
    #[inline]
    pub(crate) fn direction(&self, ring: u32, sector: u32, seed: u32) -> [i32; 3] {
        let bits = hash(seed ^ hash(spread(ring, sector)));
        let (u, v) = (bits & 0xffff, bits >> 16);
        let within =
            |i: u32, n: u32, part: u32| (i << 16).wrapping_add(part).checked_div(n).unwrap_or(0);
        lifted(within(ring, self.rings, u), within(sector, self.sectors, v))
    }

    /// How many cells there are.
    pub(crate) fn count(&self) -> u32 {
        self.rings.wrapping_mul(self.sectors)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;
    extern crate std;

    #[test]
    fn sines_against_f64() {
        for t in 0..65536u32 {
            let angle = f64::from(t) / 65536.0 * core::f64::consts::TAU;
            let exact = [angle.sin(), angle.cos()];
            let got = [sine_q15(t), cosine_q15(t)].map(|x| f64::from(x) / 32768.0);
            for i in 0..2 {
                assert!((exact[i] - got[i]).abs() < 1.3e-4, "{t}: {got:?} for {exact:?}");
            }
        }
    }

    fn frames<A: Arithmetic>(unit: impl Fn(f64) -> A::Unit, tolerance: f64) {
        for i in 0..2000 {
            let (a, b) = (f64::from(i) * 0.7, f64::from(i) * 0.013);
            let n = [a.cos() * b.sin(), a.sin() * b.sin(), b.cos()].map(&unit);
            let [t, u] = tangents::<A>(&n);
            let dot = |a: &[A::Unit; 3], b: &[A::Unit; 3]| Into::<f64>::into(A::dot(a, b));
            for (x, y, wanted) in
                [(&t, &t, 1.0), (&u, &u, 1.0), (&t, &u, 0.0), (&t, &n, 0.0), (&u, &n, 0.0)]
            {
                assert!((dot(x, y) - wanted).abs() < tolerance, "{n:?}: {t:?} {u:?}");
            }
            assert!((dot(&cross::<A>(&t, &u), &n) - 1.0).abs() < tolerance);
        }
    }

    #[test]
    fn frames_are_orthonormal() {
        frames::<f64>(|x| x, 1e-12);
        frames::<Fixed>(|x| <Fixed as Arithmetic>::Unit::from_bits((x * 131072.0) as i32), 1e-4);
    }

    #[test]
    fn directions_follow_the_cosine() {
        // The mean of cos θ under the cosine's density is 2/3, of its square 1/2.
        let strata = Strata { rings: 5, sectors: 13 };
        let (mut mean, mut square, mut side, mut count) = (0.0, 0.0, [0.0; 2], 0.0);
        for seed in 0..400 {
            for ring in 0..strata.rings {
                for sector in 0..strata.sectors {
                    let [x, y, z] =
                        strata.direction(ring, sector, seed).map(|c| f64::from(c) / 65536.0);
                    assert!((x * x + y * y + z * z - 1.0).abs() < 5e-4, "{x} {y} {z}");
                    let s = (x * x + y * y) * f64::from(strata.rings);
                    let ring = f64::from(ring);
                    assert!(s > ring - 0.01 && s < ring + 1.01, "{s} in ring {ring}");
                    mean += z;
                    square += z * z;
                    side = [side[0] + x, side[1] + y];
                    count += 1.0;
                }
            }
        }
        assert!((mean / count - 2.0 / 3.0).abs() < 1e-3, "{}", mean / count);
        assert!((square / count - 0.5).abs() < 1e-3, "{}", square / count);
        assert!(side.iter().all(|s| (s / count).abs() < 1e-3), "{side:?}");
    }
}

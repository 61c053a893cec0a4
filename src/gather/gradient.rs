//! Irradiance gradients from the rays of one hemisphere (Ward and Heckbert, "Irradiance
//! gradients", Eurographics Workshop on Rendering 1992).
//!
//! With L and r of cell (j, k), u the tangent through the middle of sector k and v the tangent a
//! quarter turn on from that through its border with sector k − 1, E/π changes with the place by
//!
//! Σₖ u·(2/N) Σⱼ sin θⱼ cos² θⱼ (Lⱼ − Lⱼ₋₁)/min(rⱼ, rⱼ₋₁) +
//! Σₖ v·(1/π) Σⱼ (sin θⱼ₊₁ − sin θⱼ) (Lₖ − Lₖ₋₁)/min(rₖ, rₖ₋₁),
//!
//! θⱼ being the lower border of ring j: sin² θⱼ = j/M. With the normal it changes by
//! 1/(MN)·Σ tan θ·L·v, v being a quarter turn on from the middle of sector k: the part of the
//! vector that N × N' is multiplied with.
//!
//! Everything is kept as whole numbers: reciprocal distances as parts of a given length, L as the
//! mean of the channels, both in Q16.

use super::hemisphere::{MAX_RINGS, Strata, cosine_q15, part_q16, root_q16, sine_q15};
use crate::math::{Arithmetic, sqrt_u32};

/// What a ray of the hemisphere found.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Seen {
    /// The mean of the channels.
    pub(super) radiance_q16: i32,
    /// The given length over the distance.
    pub(super) near_q16: u32,
}

/// Sums over the sectors, which come one after the other.
pub(super) struct Gradients {
    strata: Strata,
    first: [Seen; MAX_RINGS],
    last: [Seen; MAX_RINGS],
    /// Along the two tangents.
    translation_q16: [i64; 2],
    rotation_q16: [i64; 2],
}

/// `a·b` in Q16.
fn times(a: u32, b: u32) -> i64 {
    ((u64::from(a)).wrapping_mul(u64::from(b)) >> 16) as i64
}

impl Gradients {
    pub(super) fn new(strata: Strata) -> Self {
        let none = [Seen::default(); MAX_RINGS];
        Self { strata, first: none, last: none, translation_q16: [0; 2], rotation_q16: [0; 2] }
    }

    /// Adds a wall between two sectors at the angle `turn_q16`.
    fn wall(&mut self, before: &[Seen; MAX_RINGS], after: &[Seen; MAX_RINGS], turn_q16: u32) {
        let mut sum_q16 = 0i64;
        let mut low = 0;
        for (ring, (a, b)) in (1u32..).zip(before.iter().zip(after)).take(self.rings()) {
            let high = root_q16(part_q16(ring, self.strata.rings));
            let near = a.near_q16.max(b.near_q16);
            // 1/π in Q16
            let width = times(high.saturating_sub(low), 20_861) as u32;
            let step = i64::from(b.radiance_q16) - i64::from(a.radiance_q16);
            sum_q16 = sum_q16.wrapping_add(times(width, near).wrapping_mul(step) >> 16);
            low = high;
        }
        add(&mut self.translation_q16, sum_q16, turn_q16.wrapping_add(0x4000));
    }

    fn rings(&self) -> usize {
        self.strata.rings as usize
    }

    /// Adds the rays of a sector, from the zenith down.
    pub(super) fn sector(&mut self, sector: u32, seen: [Seen; MAX_RINGS]) {
        let Strata { rings, sectors } = self.strata;
        let border = part_q16(sector, sectors);
        let middle = part_q16(2 * sector + 1, 2 * sectors);
        if sector == 0 {
            self.first = seen;
        } else {
            let last = self.last;
            self.wall(&last, &seen, border);
        }
        let (mut radial_q16, mut turning_q16) = (0i64, 0i64);
        let mut inner = Seen::default();
        for (ring, cell) in (0..rings).zip(&seen) {
            if ring > 0 {
                let sin2 = part_q16(ring, rings);
                let factor = times(root_q16(sin2), 0x1_0000 - sin2) as u32;
                let factor = (2 * factor).checked_div(sectors).unwrap_or(0);
                let step = i64::from(cell.radiance_q16) - i64::from(inner.radiance_q16);
                let near = cell.near_q16.max(inner.near_q16);
                radial_q16 = radial_q16.wrapping_add(times(factor, near).wrapping_mul(step) >> 16);
            }
            inner = *cell;
            let tangent = tangent_q16(ring, rings);
            let part = i64::from(cell.radiance_q16).wrapping_mul(i64::from(tangent)) >> 16;
            turning_q16 = turning_q16.wrapping_add(part);
        }
        let all = i64::from(self.strata.count());
        let turning_q16 = turning_q16.checked_div(all).unwrap_or(0);
        add(&mut self.translation_q16, radial_q16, middle);
        add(&mut self.rotation_q16, turning_q16, middle.wrapping_add(0x4000));
        self.last = seen;
        if sector + 1 == sectors {
            let (last, first) = (self.last, self.first);
            self.wall(&last, &first, 0);
        }
    }

    /// Both gradients as parts of a mean radiance in Q16, in Q16 along the tangents, the
    /// translational one for the given length; each at most 64.
    pub(super) fn relative(&self, mean_q16: i32) -> [[i32; 2]; 2] {
        let part = |x: i64| {
            let most = 1 << 22;
            let q16 = (x << 16).checked_div(i64::from(mean_q16)).unwrap_or(0);
            if q16 > most {
                most
            } else if q16 < -most {
                -most
            } else {
                q16
            }
        };
        [self.translation_q16, self.rotation_q16].map(|v| v.map(|x| part(x) as i32))
    }
}

/// tan θ in a ring, in Q16: that of its middle, √((2j + 1)/(2M − 2j − 1)). In the lowest one, where
/// it rises beyond all bounds, its mean, 2√M − 1/(3√M) and less than 1/(20·M) more: with s = cos²,
/// M·∫√((1 − s)/s) ds from 0 to 1/M.
fn tangent_q16(ring: u32, rings: u32) -> u32 {
    if ring + 1 == rings {
        let root = sqrt_u32(rings << 26) << 3;
        return (2 * root).saturating_sub((root / 3).checked_div(rings).unwrap_or(0));
    }
    // both odd and at most 31
    let quotient_q26 = ((2 * ring + 1) << 26).checked_div(2 * (rings - ring) - 1).unwrap_or(0);
    sqrt_u32(quotient_q26) << 3
}

/// Adds a vector of this length at this angle.
fn add(sum: &mut [i64; 2], length: i64, turn_q16: u32) {
    let along = |c: i32| length.wrapping_mul(i64::from(c)) >> 15;
    sum[0] = sum[0].wrapping_add(along(cosine_q15(turn_q16)));
    sum[1] = sum[1].wrapping_add(along(sine_q15(turn_q16)));
}

/// The length of a vector of at most 2²² along each axis, within 2⁸: at most 310 too short.
pub(super) fn length(v: &[i32; 2]) -> i32 {
    let square = |x: i32| (x >> 7).wrapping_mul(x >> 7) as u32;
    (sqrt_u32(square(v[0]).wrapping_add(square(v[1]))) << 7) as i32
}

/// A gradient along the tangents, made no longer than `most`, in 127ths of that along the axes.
#[inline(always)]
pub(super) fn along<A: Arithmetic>(
    frame: &[[A::Unit; 3]; 2],
    gradient: [i32; 2],
    most: i32,
) -> [i8; 3] {
    let size = length(&gradient);
    let scale = if size > most { size } else { most };
    let part = |x: i32| {
        let q14 = (i64::from(x) << 10).checked_div(i64::from(scale >> 4));
        q14.unwrap_or(0) as i32
    };
    let [x, y] = gradient.map(part);
    let f = |i: usize| {
        let q14 = (A::to_q17(frame[0][i]) >> 6)
            .wrapping_mul(x)
            .wrapping_add((A::to_q17(frame[1][i]) >> 6).wrapping_mul(y))
            >> 11;
        (q14.wrapping_mul(127) >> 14) as i8
    };
    [f(0), f(1), f(2)]
}

#[cfg(test)]
mod tests {
    use super::super::Record;
    use super::super::hemisphere::tangents;
    use super::*;
    use crate::blob::Stored;
    use crate::math::Fixed;
    use proptest::prelude::*;
    extern crate std;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        /// Whatever was gathered can be baked, and points where it did.
        #[test]
        fn records_hold_every_gradient(
            turn in -3.15f64..3.15, up in -1.0f64..=1.0, angle in -3.15f64..3.15, log in 8.0f64..21.9,
        ) {
            let across = (1.0 - up * up).sqrt();
            let normal = [across * turn.cos(), up, across * turn.sin()];
            let unit = normal.map(|x| Fixed::unit_q17((x * 131_072.0) as i32));
            let frame = tangents::<Fixed>(&unit);
            let size = log.exp2();
            let gradient = [angle.cos(), angle.sin()].map(|c| (c * size) as i32);
            let record = Record::<Fixed> {
                normal_q14: normal.map(|x| (x * 16384.0) as i16),
                reach: Fixed::FAR,
                translation_q7: along::<Fixed>(&frame, gradient, 1 << 16),
                rotation_q6: along::<Fixed>(&frame, gradient, 1 << 17),
                ..Record::NONE
            };
            prop_assert!(record.is_sound(), "{record:?}");
            prop_assert_eq!(Record::<Fixed>::try_new(&record.spec()), Ok(record));
        }
    }
}

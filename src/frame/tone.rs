//! From radiance to display values: exposure, clamp, transfer curve.
//!
//! Scenes are linear, displays are not: a display value v shows the radiance of the sRGB curve
//! (IEC 61966-2-1), v = 12.92 x for x ≤ 0.0031308, else 1.055 x^(1/2.4) − 0.055. The curve is
//! evaluated in integers, so that every arithmetic and every target gives the same bits: the
//! radiance's leading bit picks an octave, the next four a segment, and within the segment the
//! curve is a chord. The chord is off by at most 1.3e-4, a thirtieth of an 8-bit step.

use crate::math::{Arithmetic, Rgb};

/// How display values follow radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transfer {
    /// The sRGB curve, which almost every display expects.
    #[default]
    Srgb,
    /// None: the scene's colours are display values already, as the old programs have it.
    Linear,
}

/// Exposure and transfer curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tone {
    /// In Q8: 256 is 1.
    exposure: u16,
    transfer: Transfer,
}

impl Tone {
    /// sRGB without exposure.
    pub const SRGB: Self = Self { exposure: 256, transfer: Transfer::Srgb };
    /// Radiance is display value.
    pub const LINEAR: Self = Self { exposure: 256, transfer: Transfer::Linear };

    /// Multiplies radiance by `exposure`/256 before the curve.
    #[must_use]
    pub const fn with_exposure(self, exposure: u16) -> Self {
        Self { exposure, ..self }
    }

    /// The display values of a radiance.
    #[inline(always)]
    pub(super) fn values<A: Arithmetic>(&self, radiance: &Rgb<A::Radiance>) -> [u16; 3] {
        let value = |r: A::Radiance| self.value(A::to_q16(r));
        [value(radiance[0]), value(radiance[1]), value(radiance[2])]
    }

    /// The display value of a radiance in 1/65536, as 0 to 65535.
    #[inline(always)]
    pub fn value(&self, radiance_q16: i32) -> u16 {
        let exposed = if self.exposure == 256 {
            radiance_q16
        } else {
            // Anything above 256 is white at any exposure.
            let radiance = radiance_q16.clamp(0, 1 << 24) as u32;
            let exposed = (radiance >> 8)
                .wrapping_mul(u32::from(self.exposure))
                .saturating_add((radiance & 255).wrapping_mul(u32::from(self.exposure)) >> 8);
            if exposed > 65535 { 65535 } else { exposed as i32 }
        };
        // One instruction where the core has one that saturates.
        let exposed = exposed.clamp(0, 65535) as u32;
        match self.transfer {
            Transfer::Srgb if exposed == 65535 => 65535,
            Transfer::Srgb => srgb(exposed),
            Transfer::Linear => exposed as u16,
        }
    }
}

/// The curve at 2^k·(1 + s/16)/65536 for k from 4 and s from 0 to 15, in 1/65535 of white.
static CURVE: [u16; 193] = {
    let mut table = [0u16; 193];
    let mut i = 0;
    while i < 193 {
        let x = (1u32 << (i / 16)) as f64 * (16 + i % 16) as f64 / 65536.0;
        let y = curve(x) * 65535.0 + 0.5;
        table[i] = if y > 65535.0 { 65535 } else { y as u16 };
        i += 1;
    }
    table
};

const fn curve(x: f64) -> f64 {
    if x <= 0.0031308 {
        return 12.92 * x;
    }
    // x^(5/12) by Newton on y¹² = x⁵
    let x5 = x * x * x * x * x;
    let mut y = 0.5 + 0.5 * x;
    let mut i = 0;
    while i < 60 {
        let y2 = y * y;
        let y4 = y2 * y2;
        let y11 = y4 * y4 * y2 * y;
        y = y - (y11 * y - x5) / (12.0 * y11);
        i += 1;
    }
    1.055 * y - 0.055
}

/// The sRGB curve of x/65536, x below 65536, as 0 to 65535.
#[inline(always)]
fn srgb(x: u32) -> u16 {
    if x < 16 {
        // the straight part: 12.92·x
        return (x.wrapping_mul(12920) / 1000) as u16;
    }
    let (m, z) = crate::math::normalize_u32(x);
    // x = 2^(31 − z)·(1 + …): octave 27 − z, counted from 2⁴; segment and place from the next bits
    let segment = (m >> 27) & 15;
    let index = ((27u32.wrapping_sub(z)) << 4 | segment) as usize;
    let place_q13 = (m >> 14) & 0x1fff;
    match (CURVE.get(index), CURVE.get(index + 1)) {
        (Some(&low), Some(&high)) => {
            let rise = u32::from(high).wrapping_sub(u32::from(low)).wrapping_mul(place_q13) >> 13;
            u32::from(low).wrapping_add(rise) as u16
        }
        _ => 65535,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;

    fn exact(x: f64) -> f64 {
        if x <= 0.0031308 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
    }

    #[test]
    fn the_curve_is_right_to_a_thirtieth_of_a_step() {
        let mut last = 0;
        for x in 0..65535 {
            let got = Tone::SRGB.value(x);
            let error = f64::from(got) / 65535.0 - exact(f64::from(x) / 65536.0);
            assert!(error.abs() < 1.0 / 255.0 / 30.0, "{x}: {error}");
            assert!(got >= last);
            last = got;
        }
        assert_eq!(Tone::SRGB.value(65536), 65535);
        assert_eq!(Tone::SRGB.value(i32::MAX), 65535);
        assert_eq!(Tone::SRGB.value(-5), 0);
    }

    #[test]
    fn exposure_multiplies() {
        let twice = Tone::LINEAR.with_exposure(512);
        assert_eq!(twice.value(10_000), 20_000);
        assert_eq!(twice.value(40_000), 65535);
        assert_eq!(Tone::LINEAR.with_exposure(128).value(10_001), 5000);
        assert_eq!(Tone::LINEAR.with_exposure(65535).value(i32::MAX), 65535);
    }
}

//! Pixel formats: how display values of sixteen bits become what a display is sent.

/// A pixel as a display takes it.
pub trait Pixel: Copy {
    /// Bytes a pixel takes in a band; two grey pixels of four bits share one, see [`Gray4`].
    const BYTES: usize;

    /// The pixel for display values of 0 to 65535. `threshold`, 0 to 65535, is where between two
    /// levels the next one begins: 32768 rounds, an ordered dither varies it from pixel to pixel.
    fn quantize(rgb: [u16; 3], threshold: u16) -> Self;

    /// The pixel's bytes, the most significant first; `BYTES` of them count.
    fn to_be_bytes(self) -> [u8; 3];
}

/// Which of 2^bits levels a value is shown at.
#[inline(always)]
fn level(value: u16, bits: u32, threshold: u16) -> u32 {
    let steps = (1u32 << bits) - 1;
    (u32::from(value)
        .wrapping_mul(steps)
        .wrapping_add(u32::from(threshold))
        .wrapping_add(u32::from(value) >> 15))
        >> 16
}

/// The luma of display values by Rec. 709's weights (0.2126, 0.7152, 0.0722).
#[inline(always)]
fn luma(rgb: [u16; 3]) -> u16 {
    let sum = u32::from(rgb[0])
        .wrapping_mul(13933)
        .wrapping_add(u32::from(rgb[1]).wrapping_mul(46871))
        .wrapping_add(u32::from(rgb[2]).wrapping_mul(4732));
    (sum >> 16) as u16
}

/// Five bits red, six green, five blue.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rgb565(pub u16);

impl Pixel for Rgb565 {
    const BYTES: usize = 2;

    #[inline(always)]
    fn quantize(rgb: [u16; 3], threshold: u16) -> Self {
        let (r, g) = (level(rgb[0], 5, threshold), level(rgb[1], 6, threshold));
        Self((r << 11 | g << 5 | level(rgb[2], 5, threshold)) as u16)
    }

    #[inline(always)]
    fn to_be_bytes(self) -> [u8; 3] {
        [(self.0 >> 8) as u8, self.0 as u8, 0]
    }
}

/// Eight bits a channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rgb888(pub [u8; 3]);

impl Pixel for Rgb888 {
    const BYTES: usize = 3;

    #[inline(always)]
    fn quantize(rgb: [u16; 3], threshold: u16) -> Self {
        Self(rgb.map(|v| level(v, 8, threshold) as u8))
    }

    #[inline(always)]
    fn to_be_bytes(self) -> [u8; 3] {
        self.0
    }
}

/// 256 levels of grey.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Gray8(pub u8);

impl Pixel for Gray8 {
    const BYTES: usize = 1;

    #[inline(always)]
    fn quantize(rgb: [u16; 3], threshold: u16) -> Self {
        Self(level(luma(rgb), 8, threshold) as u8)
    }

    #[inline(always)]
    fn to_be_bytes(self) -> [u8; 3] {
        [self.0, 0, 0]
    }
}

/// Sixteen levels of grey, one pixel a byte (drivers pack them as their display wants).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Gray4(pub u8);

impl Pixel for Gray4 {
    const BYTES: usize = 1;

    #[inline(always)]
    fn quantize(rgb: [u16; 3], threshold: u16) -> Self {
        Self(level(luma(rgb), 4, threshold) as u8)
    }

    #[inline(always)]
    fn to_be_bytes(self) -> [u8; 3] {
        [self.0, 0, 0]
    }
}

/// Black and white.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Gray1(pub u8);

impl Pixel for Gray1 {
    const BYTES: usize = 1;

    #[inline(always)]
    fn quantize(rgb: [u16; 3], threshold: u16) -> Self {
        Self(level(luma(rgb), 1, threshold) as u8)
    }

    #[inline(always)]
    fn to_be_bytes(self) -> [u8; 3] {
        [self.0, 0, 0]
    }
}

/// Whether pixels are dithered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Dither {
    /// Each value goes to the nearest level.
    #[default]
    None,
    /// Thresholds from a 4×4 matrix (Bayer 1973) trade levels for pattern: for displays of few
    /// levels.
    Ordered,
}

impl Dither {
    /// The threshold at a pixel.
    #[inline(always)]
    pub fn threshold(self, x: u16, y: u16) -> u16 {
        match self {
            Self::None => 32768,
            Self::Ordered => {
                // Bit-interleaved x ^ y and y, the most significant bit of the matrix first.
                let (a, b) = (x ^ y, y);
                let rank = (a & 1) << 3 | (b & 1) << 2 | (a & 2) | (b & 2) >> 1;
                rank << 12 | 0x800
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_middle() {
        let round = 32768;
        assert_eq!(Rgb565::quantize([65535; 3], round), Rgb565(0xffff));
        assert_eq!(Rgb565::quantize([0; 3], round), Rgb565(0));
        assert_eq!(Rgb565::quantize([65535, 0, 0], round), Rgb565(0xf800));
        assert_eq!(Rgb888::quantize([0, 32768, 65535], round), Rgb888([0, 128, 255]));
        assert_eq!(Gray8::quantize([65535; 3], round), Gray8(255));
        assert_eq!(Gray4::quantize([65535; 3], round), Gray4(15));
        assert_eq!(Rgb565(0x1234).to_be_bytes()[..2], [0x12, 0x34]);
    }

    #[test]
    fn every_level_is_shown_for_its_own_value() {
        for v in 0..=255u16 {
            assert_eq!(Rgb888::quantize([v * 257; 3], 32768), Rgb888([v as u8; 3]));
        }
        for v in 0..16u16 {
            assert_eq!(Gray4::quantize([v * 4369; 3], 32768), Gray4(v as u8));
            assert_eq!(
                Gray4::quantize([v * 4369; 3], Dither::Ordered.threshold(1, 2)),
                Gray4(v as u8)
            );
        }
    }

    #[test]
    fn dither_keeps_the_mean() {
        let mut seen = [false; 16];
        for y in 0..4 {
            for x in 0..4 {
                seen[(Dither::Ordered.threshold(x, y) >> 12) as usize] = true;
            }
        }
        assert_eq!(seen, [true; 16]);
        for value in (0..=65535u16).step_by(997) {
            let mut sum = 0u32;
            for y in 0..4 {
                for x in 0..4 {
                    let Gray1(bit) = Gray1::quantize([value; 3], Dither::Ordered.threshold(x, y));
                    sum += u32::from(bit);
                }
            }
            let exact = f64::from(value) / 65535.0 * 16.0;
            assert!((f64::from(sum) - exact).abs() <= 0.6, "{value}: {sum}");
        }
    }
}

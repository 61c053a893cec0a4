//! Small images that lie in flash: palette indices of 1, 2, 4 or 8 bits, or RGB565.
//!
//! Rows start at whole bytes, the first pixel in a byte's highest bits, RGB565's higher byte first, as
//! displays and embedded-graphics have it. Colours are sRGB; a table of 512 bytes makes them linear.

use crate::math::Rgb;
use crate::shape::ShapeError;

/// How an image's pixels lie in its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Texels<'a> {
    /// Indices of so many bits (1, 2, 4 or 8) into a palette of sRGB colours. An index beyond the
    /// palette is black.
    Indexed {
        /// The bits of an index.
        bits: u8,
        /// The colours, red first.
        palette: &'a [[u8; 3]],
    },
    /// Five bits of red, six of green, five of blue.
    Rgb565,
}

/// How a colour is found between the centres of pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// That of the pixel that the point lies in.
    #[default]
    Nearest,
    /// Between those of the four around it.
    Bilinear,
}

/// What lies beyond the border of a picture or the ends of a gradient.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The same again.
    #[default]
    Repeat,
    /// What lies at the border.
    Clamp,
}

/// An image in borrowed memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Image<'a> {
    bytes: &'a [u8],
    texels: Texels<'a>,
    width: u16,
    height: u16,
    filter: Filter,
    wrap: Wrap,
}

impl<'a> Image<'a> {
    /// An image for `const`s: its nearest pixel, repeated.
    ///
    /// # Panics
    /// Where [`try_new`](Self::try_new) has an error.
    pub const fn new(width: u16, height: u16, texels: Texels<'a>, bytes: &'a [u8]) -> Self {
        match Self::try_new(width, height, texels, bytes) {
            Ok(image) => image,
            Err(error) => panic!("{}", error.message()),
        }
    }

    /// An image: its nearest pixel, repeated.
    ///
    /// # Errors
    /// A side that is 0 or larger than 16384, other numbers of bits than 1, 2, 4 and 8, a palette that
    /// is empty or larger than the indices reach, too few bytes.
    pub const fn try_new(
        width: u16,
        height: u16,
        texels: Texels<'a>,
        bytes: &'a [u8],
    ) -> Result<Self, ShapeError> {
        let bits = match texels {
            Texels::Indexed { bits, palette } => {
                if !matches!(bits, 1 | 2 | 4 | 8) || palette.is_empty() || palette.len() > 1 << bits
                {
                    return Err(ShapeError::Image);
                }
                bits as usize
            }
            Texels::Rgb565 => 16,
        };
        let stride = (width as usize * bits).div_ceil(8);
        if width == 0
            || height == 0
            || width > 16384
            || height > 16384
            || bytes.len() < stride * height as usize
        {
            return Err(ShapeError::Image);
        }
        let (filter, wrap) = (Filter::Nearest, Wrap::Repeat);
        Ok(Self { bytes, texels, width, height, filter, wrap })
    }

    /// The same, read with another filter.
    #[must_use]
    pub const fn with_filter(self, filter: Filter) -> Self {
        Self { filter, ..self }
    }

    /// The same with something else around it.
    #[must_use]
    pub const fn with_wrap(self, wrap: Wrap) -> Self {
        Self { wrap, ..self }
    }

    /// Pixels of a row, and rows.
    pub const fn size(&self) -> (u16, u16) {
        (self.width, self.height)
    }

    /// The bytes of the pixels.
    pub const fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// How the pixels lie in the bytes.
    pub const fn texels(&self) -> Texels<'a> {
        self.texels
    }

    /// How a colour is found between the centres of pixels.
    pub const fn filter(&self) -> Filter {
        self.filter
    }

    /// What lies beyond the border.
    pub const fn wrap(&self) -> Wrap {
        self.wrap
    }

    /// The linear colour at a point in pixels of 2⁻¹⁶ from the lower left corner, in 2⁻¹⁶.
    pub(super) fn at(&self, q: [i32; 2]) -> Rgb<i32> {
        if self.filter == Filter::Nearest {
            return self.texel(q[0] >> 16, q[1] >> 16);
        }
        let q = q.map(|x| x.wrapping_sub(1 << 15));
        let (x, y) = (q[0] >> 16, q[1] >> 16);
        let t = q.map(|x| (x & 0xffff) >> 2);
        let (right, up) = (x.wrapping_add(1), y.wrapping_add(1));
        let (a, b) = (self.texel(x, y), self.texel(right, y));
        let (c, d) = (self.texel(x, up), self.texel(right, up));
        let mix = |a: i32, b: i32, t: i32| a + (((b - a) * t) >> 14);
        let channel = |i: usize| mix(mix(a[i], b[i], t[0]), mix(c[i], d[i], t[0]), t[1]);
        // Two colours differ by less than 2¹⁶: a signed product with 2¹⁴ just fits.
        [channel(0), channel(1), channel(2)]
    }

    /// The colour of a pixel, counted from the lower left one.
    fn texel(&self, x: i32, y: i32) -> Rgb<i32> {
        let x = self.within(x, self.width);
        // Rows are stored from the top.
        let row = usize::from(self.height - 1).wrapping_sub(self.within(y, self.height));
        let width = usize::from(self.width);
        let byte = |at: usize| self.bytes.get(at).copied().unwrap_or(0);
        let srgb = match self.texels {
            Texels::Indexed { bits, palette } => {
                let bits = usize::from(bits);
                let bit = x.wrapping_mul(bits);
                let stride = width.wrapping_mul(bits).wrapping_add(7) >> 3;
                let byte = byte(row.wrapping_mul(stride).wrapping_add(bit >> 3));
                let shift = 8usize.wrapping_sub(bits).wrapping_sub(bit & 7) & 7;
                let index = byte >> shift & (0xff >> (8usize.wrapping_sub(bits) & 7));
                palette.get(usize::from(index)).copied().unwrap_or([0; 3])
            }
            Texels::Rgb565 => {
                let at = row.wrapping_mul(width).wrapping_add(x).wrapping_mul(2);
                let (high, low) = (byte(at), byte(at.wrapping_add(1)));
                // The upper bits again below: then the brightest is white.
                let red = high & 0xf8;
                let green = high << 5 | low >> 3 & 0x1c;
                let blue = low << 3;
                [red | red >> 5, green | green >> 6, blue | blue >> 5]
            }
        };
        srgb.map(|x| i32::from(LINEAR[usize::from(x)]))
    }

    /// A coordinate brought within the image.
    fn within(&self, x: i32, size: u16) -> usize {
        let size = i32::from(size);
        let x = match self.wrap {
            Wrap::Repeat => x.checked_rem_euclid(size).unwrap_or(0),
            Wrap::Clamp => x.clamp(0, size.wrapping_sub(1).max(0)),
        };
        x as usize
    }
}

/// sRGB to linear in 2⁻¹⁶, the brightest 65535 (IEC 61966-2-1).
static LINEAR: [u16; 256] = {
    let mut table = [0; 256];
    let mut i = 0;
    while i < 256 {
        let v = i as f64 / 255.0;
        let linear = if v <= 0.04045 { v / 12.92 } else { power_2_4((v + 0.055) / 1.055) };
        table[i] = (linear * 65535.0 + 0.5) as u16;
        i += 1;
    }
    table
};

/// x^2.4 for x in 0 to 1, as x²·⁵√x².
const fn power_2_4(x: f64) -> f64 {
    let square = x * x;
    // Newton from above: it falls to the root.
    let (mut root, mut i) = (1.0, 0);
    while i < 60 {
        let fourth = root * root * root * root;
        root -= (root * fourth - square) / (5.0 * fourth);
        i += 1;
    }
    square * root
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    extern crate std;
    use std::vec::Vec;

    const PALETTE: &[[u8; 3]] = &[[0, 0, 0], [255, 255, 255], [255, 0, 0], [0, 0, 188]];
    const WHITE: Rgb<i32> = [65535; 3];

    #[test]
    fn srgb_is_made_linear() {
        for (i, &linear) in LINEAR.iter().enumerate() {
            let v = i as f64 / 255.0;
            let exact = if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) };
            assert!((f64::from(linear) - exact * 65535.0).abs() <= 0.51, "{i}");
        }
        assert_eq!((LINEAR[0], LINEAR[255]), (0, 65535));
    }

    #[test]
    fn pixels_by_hand() {
        // Two rows of five, two bits each: the upper 0 1 2 3 0, the lower 1 1 0 0 2.
        let bytes = [0b0001_1011, 0b0000_0000, 0b0101_0000, 0b1000_0000];
        let image = Image::new(5, 2, Texels::Indexed { bits: 2, palette: PALETTE }, &bytes);
        let at = |x: i32, y: i32| image.at([(x << 16) + 40_000, (y << 16) + 12]);
        let (red, blue) = ([65535, 0, 0], [0, 0, i32::from(LINEAR[188])]);
        assert_eq!([0, 1, 2, 3, 4].map(|x| at(x, 1)), [[0; 3], WHITE, red, blue, [0; 3]]);
        assert_eq!([0, 1, 2, 3, 4].map(|x| at(x, 0)), [WHITE, WHITE, [0; 3], [0; 3], red]);
        // Again beyond each border, or the border itself.
        assert_eq!((at(7, 3), at(-3, -1)), (red, red));
        let clamped = image.with_wrap(Wrap::Clamp);
        assert_eq!(clamped.at([9 << 16, -5 << 16]), red);
        assert_eq!(clamped.at([-9 << 16, 5 << 16]), [0; 3]);
    }

    #[test]
    fn other_depths() {
        let two = &PALETTE[..2];
        let one = Image::new(9, 1, Texels::Indexed { bits: 1, palette: two }, &[0x01, 0x80]);
        assert_eq!([6, 7, 8].map(|x| one.texel(x, 0)), [[0; 3], WHITE, WHITE]);
        let four = Image::new(2, 1, Texels::Indexed { bits: 4, palette: PALETTE }, &[0x21]);
        assert_eq!([0, 1].map(|x| four.texel(x, 0)), [[65535, 0, 0], WHITE]);
        let eight = Image::new(2, 1, Texels::Indexed { bits: 8, palette: PALETTE }, &[1, 77]);
        assert_eq!([0, 1].map(|x| eight.texel(x, 0)), [WHITE, [0; 3]]);
        let rgb = Image::new(2, 1, Texels::Rgb565, &[0xff, 0xff, 0x07, 0xe0]);
        assert_eq!([0, 1].map(|x| rgb.texel(x, 0)), [WHITE, [0, 65535, 0]]);
    }

    #[test]
    fn between_four_pixels() {
        let texels = Texels::Indexed { bits: 1, palette: &PALETTE[..2] };
        let image = Image::new(2, 2, texels, &[0x80, 0x40]).with_filter(Filter::Bilinear);
        // White at the upper left and the lower right: half everywhere on the cross between.
        let half = |c: Rgb<i32>| (c[0] - 32768).abs() < 8;
        assert!(half(image.at([1 << 16, 1 << 16])) && half(image.at([1 << 16, 1 << 15])));
        assert_eq!(image.at([1 << 15, 3 << 15]), WHITE);
        assert_eq!(image.at([3 << 15, 3 << 15]), [0; 3]);
    }

    #[test]
    fn what_is_no_image() {
        let indexed = |bits| Texels::Indexed { bits, palette: PALETTE };
        let none = Texels::Indexed { bits: 8, palette: &[] };
        for (w, h, texels, bytes) in [
            (0, 1, Texels::Rgb565, 9),
            (1, 0, Texels::Rgb565, 9),
            (2, 2, Texels::Rgb565, 7),
            (9, 2, indexed(2), 5),
            (2, 2, indexed(3), 9),
            (2, 2, indexed(1), 9),
            (2, 2, none, 9),
            (16385, 1, indexed(2), 9999),
        ] {
            let bytes: Vec<u8> = std::vec![0; bytes];
            let error = Image::try_new(w, h, texels, &bytes).unwrap_err();
            assert_eq!(error, ShapeError::Image, "{w}x{h}");
        }
    }

    proptest! {
        #[test]
        fn bilinear_lies_between_its_neighbours(
            bytes in prop::array::uniform32(any::<u8>()), q in prop::array::uniform2(any::<i32>()),
        ) {
            let image = Image::new(4, 4, Texels::Rgb565, &bytes).with_filter(Filter::Bilinear);
            let got = image.at(q);
            let corner = q.map(|x| x.wrapping_sub(1 << 15) >> 16);
            let all = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| {
                image.texel(corner[0].wrapping_add(i), corner[1].wrapping_add(j))
            });
            for i in 0..3 {
                let low = all.iter().map(|c| c[i]).min().unwrap();
                let high = all.iter().map(|c| c[i]).max().unwrap();
                prop_assert!(got[i] >= low - 2 && got[i] <= high, "{low} {} {high}", got[i]);
            }
        }
    }
}

//! Patterns without a picture: a number for each point of texture space, from integers alone.

use super::image::{Image, Wrap};
use super::noise;
use crate::math::{normalize_u32, sqrt_u32};

/// What a texture shows. Texture space has cells of side 1, to which the texture's
/// [`size`](super::TextureSpec::size) scales.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pattern<'a> {
    /// Cells of the first and of the second colour in turn, along each axis that has a size.
    Checker,
    /// Stripes across the first axis.
    Stripes {
        /// How much of each cell has the first colour, 0 to 1.
        width: f64,
    },
    /// From the first colour to the second along the first axis, over one cell.
    Gradient {
        /// What lies before and behind.
        wrap: Wrap,
    },
    /// Clouds: gradient noise (Perlin 1985, 2002), ½ in the mean.
    Noise {
        /// How many octaves, each of twice the frequency and half the strength, 1 to 8.
        octaves: u8,
    },
    /// Veins across the first axis, one a cell, bent by noise.
    Marble {
        /// The octaves of the noise, 1 to 8.
        octaves: u8,
        /// How many cells the noise bends them by, 0 to 16.
        turbulence: f64,
    },
    /// Rings around the second axis, one a cell, bent by noise.
    Wood {
        /// The octaves of the noise, 1 to 8.
        octaves: u8,
        /// How many cells the noise bends them by, 0 to 16.
        turbulence: f64,
    },
    /// Bricks of the first colour in mortar of the second, each row half a brick along.
    Brick {
        /// The mortar's part of a row's height, 0 to 1. Between two bricks of a row it is as wide.
        mortar: f64,
    },
    /// A picture. A cell is the whole of it.
    Image(Image<'a>),
}

/// A pattern with its numbers made integers.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind<'a> {
    Checker,
    Stripes { width_q16: i32 },
    Gradient { wrap: Wrap },
    Noise { octaves: u8 },
    Marble { octaves: u8, turbulence_q8: i16 },
    Wood { octaves: u8, turbulence_q8: i16 },
    Brick { mortar_q16: [i32; 2] },
    Image(Image<'a>),
}

impl Kind<'_> {
    /// The pattern at a point of 2⁻¹⁶, 0 to 65536: which part of the second colour; of a picture the
    /// luminance.
    pub(super) fn value(&self, q: [i32; 3]) -> i32 {
        let [x, y, z] = q;
        match *self {
            Self::Checker => ((x ^ y ^ z) >> 16 & 1) << 16,
            Self::Stripes { width_q16 } => ((fraction(x) >= width_q16) as i32) << 16,
            Self::Gradient { wrap: Wrap::Repeat } => fraction(x),
            Self::Gradient { wrap: Wrap::Clamp } => x.clamp(0, 1 << 16),
            Self::Noise { octaves } => (1 << 15) + 2 * noise::octaves_q14(q, octaves),
            Self::Marble { octaves, turbulence_q8 } => wave(bent(x, q, octaves, turbulence_q8)),
            Self::Wood { octaves, turbulence_q8 } => {
                wave(bent(hypotenuse(x, z), q, octaves, turbulence_q8))
            }
            Self::Brick { mortar_q16 } => {
                let odd = y >> 16 & 1;
                let along = x.wrapping_add(odd << 15);
                let mortar = fraction(along) < mortar_q16[0] || fraction(y) < mortar_q16[1];
                (mortar as i32) << 16
            }
            Self::Image(image) => {
                // ITU-R BT.709
                let [r, g, b] = image.at([x, y]);
                (54 * r + 183 * g + 19 * b) >> 8
            }
        }
    }
}

fn fraction(x: i32) -> i32 {
    x & 0xffff
}

/// `x` moved by so many cells times noise.
fn bent(x: i32, q: [i32; 3], octaves: u8, turbulence_q8: i16) -> i32 {
    if turbulence_q8 == 0 {
        return x;
    }
    x.wrapping_add((noise::octaves_q14(q, octaves) * i32::from(turbulence_q8)) >> 6)
}

/// From 0 to 1 and back in one cell, as smooth as a sine.
fn wave(x: i32) -> i32 {
    let x = fraction(x);
    let rise = if x < 1 << 15 { 2 * x } else { (2 << 16) - 2 * x };
    noise::fade_q14(rise >> 2) << 2
}

/// √(x² + z²), to fifteen bits.
fn hypotenuse(x: i32, z: i32) -> i32 {
    let (_, zeros) = normalize_u32((x.unsigned_abs() | z.unsigned_abs()) >> 1 | 1);
    // Fifteen bits each, so that the sum of their squares fits.
    let down = 18i32.wrapping_sub(zeros as i32).max(0) as u32 & 31;
    let square = |x: i32| {
        let x = x.unsigned_abs() >> down;
        x.wrapping_mul(x)
    };
    (sqrt_u32(square(x).wrapping_add(square(z))) << down) as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    extern crate std;

    const ONE: i32 = 1 << 16;

    fn at(kind: Kind<'_>, x: f64, y: f64, z: f64) -> f64 {
        f64::from(kind.value([x, y, z].map(|x| (x * 65536.0).floor() as i32))) / 65536.0
    }

    #[test]
    fn cells_stripes_and_gradients() {
        assert_eq!(at(Kind::Checker, 0.5, 0.5, 0.5), 0.0);
        assert_eq!(at(Kind::Checker, 1.5, 0.5, 0.5), 1.0);
        assert_eq!(at(Kind::Checker, -0.5, 0.5, 0.5), 1.0);
        assert_eq!(at(Kind::Checker, -0.5, -0.1, 0.5), 0.0);
        let stripes = Kind::Stripes { width_q16: ONE / 4 };
        assert_eq!(
            [0.0, 0.24, 0.26, 0.99, 1.1].map(|x| at(stripes, x, 0.0, 0.0)),
            [0.0, 0.0, 1.0, 1.0, 0.0]
        );
        let gradient = |wrap, x| at(Kind::Gradient { wrap }, x, 3.0, 4.0);
        assert_eq!(
            [-1.0, 0.0, 0.25, 1.0, 7.0].map(|x| gradient(Wrap::Clamp, x)),
            [0.0, 0.0, 0.25, 1.0, 1.0]
        );
        assert_eq!([-0.75, 0.25, 1.25].map(|x| gradient(Wrap::Repeat, x)), [0.25; 3]);
    }

    #[test]
    fn bricks() {
        let brick = Kind::Brick { mortar_q16: [ONE / 10, ONE / 5] };
        assert_eq!(at(brick, 0.5, 0.5, 0.0), 0.0);
        assert_eq!((at(brick, 0.05, 0.5, 0.0), at(brick, 0.5, 0.1, 0.0)), (1.0, 1.0));
        // The next row begins half a brick along.
        assert_eq!((at(brick, 0.05, 1.5, 0.0), at(brick, 0.55, 1.5, 0.0)), (0.0, 1.0));
        assert_eq!((at(brick, 0.05, -1.5, 0.0), at(brick, 0.05, -0.5, 0.0)), (1.0, 0.0));
    }

    #[test]
    fn veins_and_rings() {
        let marble = Kind::Marble { octaves: 3, turbulence_q8: 0 };
        assert_eq!([0.0, 0.25, 0.5, 1.0].map(|x| at(marble, x, 0.3, 0.4)), [0.0, 0.5, 1.0, 0.0]);
        let wood = Kind::Wood { octaves: 3, turbulence_q8: 0 };
        // 3, 4 and 5: a whole number of rings out.
        assert!(at(wood, 3.0, 9.0, 4.0) < 1e-3 && at(wood, -4.5, 9.0, -6.0) > 0.999);
        // Half a cell by noise, at most.
        let bent = Kind::Marble { octaves: 1, turbulence_q8: 128 };
        assert_ne!(at(bent, 0.2, 0.3, 0.4), at(marble, 0.2, 0.3, 0.4));
    }

    #[test]
    fn noise_has_a_mean_of_a_half() {
        for octaves in [1, 3, 8] {
            let mut sum = 0.0;
            for i in 0..100_000u32 {
                let at = |k: u32| (crate::math::hash(i * 3 + k) >> 6) as i32;
                sum += f64::from(Kind::Noise { octaves }.value([at(0), at(1), at(2)]));
            }
            let mean = sum / 100_000.0 / 65536.0;
            assert!((mean - 0.5).abs() < 0.005, "{octaves}: {mean}");
        }
    }

    proptest! {
        #[test]
        fn values_lie_between_the_colours(
            q in prop::array::uniform3(any::<i32>()), octaves in 1u8..=8, bend in 0i16..=4096,
        ) {
            for kind in [
                Kind::Checker,
                Kind::Stripes { width_q16: 9999 },
                Kind::Gradient { wrap: Wrap::Clamp },
                Kind::Noise { octaves },
                Kind::Marble { octaves, turbulence_q8: bend },
                Kind::Wood { octaves, turbulence_q8: bend },
                Kind::Brick { mortar_q16: [999, 4000] },
            ] {
                let value = kind.value(q);
                prop_assert!((0..=ONE).contains(&value), "{kind:?} {value}");
            }
        }

        #[test]
        fn periods(q in prop::array::uniform3(-(1i32 << 24)..1 << 24), n in -9i32..9) {
            let along = [q[0] + n * ONE, q[1], q[2]];
            for kind in [
                Kind::Stripes { width_q16: 9999 },
                Kind::Gradient { wrap: Wrap::Repeat },
                Kind::Marble { octaves: 1, turbulence_q8: 0 },
                Kind::Brick { mortar_q16: [999, 4000] },
            ] {
                prop_assert_eq!(kind.value(q), kind.value(along));
            }
            let other = Kind::Checker.value(q) ^ ((n & 1) << 16);
            prop_assert_eq!(Kind::Checker.value(along), other);
        }

        #[test]
        fn roots_of_sums_of_squares(x in -(1i32 << 30)..1 << 30, z in -(1i32 << 30)..1 << 30) {
            let exact = f64::from(x).hypot(f64::from(z));
            let got = f64::from(hypotenuse(x, z));
            prop_assert!((got - exact).abs() <= 4.0 + exact * 1.5e-4, "{got} {exact}");
        }
    }
}

//! What a ray that hits nothing sees.

use super::uses::{self, has};
use crate::math::{Arithmetic, Rgb, for_each_arithmetic, rgb};
use crate::shape::{ShapeError, ok_or_panic, some_or, unit_vector};

/// What a ray that hits nothing sees, by its direction.
#[derive(Clone, Copy, Debug)]
pub enum Background<A: Arithmetic> {
    /// The same everywhere.
    Uniform(Rgb<A::Radiance>),
    /// Linear in the direction's component along `up`.
    Gradient {
        /// The vertical.
        up: [A::Unit; 3],
        /// The radiance at the horizon.
        middle: Rgb<A::Radiance>,
        /// What is added straight above, and taken away straight below; no more than `middle`
        /// either way.
        slope: Rgb<A::Radiance>,
    },
}

impl<A: Arithmetic> Background<A> {
    /// No light at all.
    pub const BLACK: Self = Self::Uniform([A::BLACK; 3]);

    #[inline(always)]
    pub(crate) fn radiance<const USES: u64>(&self, direction: &[A::Unit; 3]) -> Rgb<A::Radiance> {
        match self {
            Self::Uniform(radiance) => *radiance,
            Self::Gradient { up, middle, slope } if has(USES, uses::GRADIENT) => {
                let height = A::dot(direction, up);
                rgb(middle, slope, |m, s| A::ramp(m, s, height))
            }
            Self::Gradient { .. } => [A::BLACK; 3],
        }
    }
}

for_each_arithmetic! {
    macro_rules! radiances {
        ($c:expr) => {{
            let c = $c;
            [
                some_or!(make::radiance(c[0]), Coefficient),
                some_or!(make::radiance(c[1]), Coefficient),
                some_or!(make::radiance(c[2]), Coefficient),
            ]
        }};
    }

    impl Background<A> {
        /// One radiance everywhere, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_uniform`](Self::try_uniform) has an error.
        pub const fn uniform(radiance: Rgb<f64>) -> Self {
            ok_or_panic!(Self::try_uniform(radiance))
        }

        /// One radiance everywhere.
        ///
        /// # Errors
        /// A radiance that is negative, no number or above 1024.
        pub const fn try_uniform(radiance: Rgb<f64>) -> Result<Self, ShapeError> {
            Ok(Self::Uniform(radiances!(radiance)))
        }

        /// A gradient along `up`, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_gradient`](Self::try_gradient) has an error.
        pub const fn gradient(up: [f64; 3], bottom: Rgb<f64>, top: Rgb<f64>) -> Self {
            ok_or_panic!(Self::try_gradient(up, bottom, top))
        }

        /// A gradient along `up`, from `bottom` where the direction's component along it is −1 to
        /// `top` where it is 1.
        ///
        /// # Errors
        /// A null vertical; a radiance that is negative, no number or above 1024.
        pub const fn try_gradient(
            up: [f64; 3],
            bottom: Rgb<f64>,
            top: Rgb<f64>,
        ) -> Result<Self, ShapeError> {
            let (low, high) = (radiances!(bottom), radiances!(top));
            let mut middle = low;
            let mut slope = low;
            let mut i = 0;
            while i < 3 {
                (middle[i], slope[i]) = make::middle_and_slope(low[i], high[i]);
                i += 1;
            }
            Ok(Self::Gradient { up: unit_vector!(make, up), middle, slope })
        }
    }

    impl super::Ambient<A> {
        /// The ambient irradiance E_amb, divided by π.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(irradiance: Rgb<f64>) -> Self {
            ok_or_panic!(Self::try_new(irradiance))
        }

        /// The ambient irradiance E_amb, divided by π.
        ///
        /// # Errors
        /// An irradiance that is negative, no number or above 1024.
        pub const fn try_new(irradiance: Rgb<f64>) -> Result<Self, ShapeError> {
            Ok(Self(radiances!(irradiance)))
        }
    }
}

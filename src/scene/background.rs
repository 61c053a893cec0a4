//! What a ray that hits nothing sees.

use crate::math::{Arithmetic, Rgb, for_each_arithmetic, rgb};
use crate::shape::{ShapeError, ok_or_panic, some_or, unit_vector};

/// What a ray that hits nothing sees, by its direction.
#[derive(Clone, Copy, Debug)]
pub enum Background<A: Arithmetic> {
    /// The same everywhere.
    Uniform(Rgb<A::Radiance>),
    /// Linear in the direction's component along `up`, from `bottom` at −1 to `top` at 1.
    Gradient {
        /// The vertical.
        up: [A::Unit; 3],
        /// The radiance straight below.
        bottom: Rgb<A::Radiance>,
        /// The radiance straight above.
        top: Rgb<A::Radiance>,
    },
}

impl<A: Arithmetic> Background<A> {
    /// No light at all.
    pub const BLACK: Self = Self::Uniform([A::BLACK; 3]);

    #[inline(always)]
    pub(crate) fn radiance(&self, direction: &[A::Unit; 3]) -> Rgb<A::Radiance> {
        match self {
            Self::Uniform(radiance) => *radiance,
            Self::Gradient { up, bottom, top } => {
                let height = A::weight_of(A::dot(direction, up)) + A::FULL;
                // Rounding can leave a component a little beyond ±1.
                let height = if height < A::NO_WEIGHT { A::NO_WEIGHT } else { height };
                let rest = A::FULL + A::FULL - height;
                let rest = if rest < A::NO_WEIGHT { A::NO_WEIGHT } else { rest };
                rgb(bottom, top, |b, t| A::mean(A::gather(A::dim(b, rest), A::dim(t, height)), 2))
            }
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

        /// A gradient along `up`.
        ///
        /// # Errors
        /// A null vertical; a radiance that is negative, no number or above 1024.
        pub const fn try_gradient(
            up: [f64; 3],
            bottom: Rgb<f64>,
            top: Rgb<f64>,
        ) -> Result<Self, ShapeError> {
            Ok(Self::Gradient {
                up: unit_vector!(make, up),
                bottom: radiances!(bottom),
                top: radiances!(top),
            })
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

//! Absorption: how much of the light a coloured medium takes on the way through it.
//!
//! By Bouguer's, Lambert's and Beer's law the part exp(−a·d) arrives after a way of length d. As with
//! indices of refraction, a surface says what lies before and behind it; which of the two a ray came
//! through is known where it meets the surface.

use crate::math::{Arithmetic, DENSEST, Rgb, for_each_arithmetic, rgb};
use crate::shape::{ShapeError, ok_or_panic, some_or};

/// The media on both sides of a surface: what a unit of length takes of each channel.
#[derive(Clone, Copy, Debug)]
pub struct Absorption<A: Arithmetic> {
    front: Rgb<A::Decay>,
    behind: Rgb<A::Decay>,
}

for_each_arithmetic! {
    macro_rules! decay {
        ($c:expr) => {{
            let c = $c;
            [
                some_or!(make::decay(c[0]), Coefficient),
                some_or!(make::decay(c[1]), Coefficient),
                some_or!(make::decay(c[2]), Coefficient),
            ]
        }};
    }

    impl Absorption<A> {
        /// The media on both sides, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(front: Rgb<f64>, behind: Rgb<f64>) -> Self {
            ok_or_panic!(Self::try_new(front, behind))
        }

        /// The media on the side that the normal points to, and on the other (inside a body): the a of
        /// exp(−a·d) for each channel, 0 for what is clear.
        ///
        /// # Errors
        /// A number that is negative, none, or beyond [`MOST`](Self::MOST).
        pub const fn try_new(front: Rgb<f64>, behind: Rgb<f64>) -> Result<Self, ShapeError> {
            Ok(Self { front: decay!(front), behind: decay!(behind) })
        }
    }
}

impl<A: Arithmetic> Absorption<A> {
    /// The most that a unit of length may take of a channel: nothing gets through that.
    pub const MOST: f64 = DENSEST;

    /// What is left of a weight after a way that ended at the surface.
    pub(crate) fn after(
        &self,
        behind: bool,
        way: A::Length,
        weight: &Rgb<A::Weight>,
    ) -> Rgb<A::Weight> {
        let rates = if behind { &self.behind } else { &self.front };
        rgb(weight, rates, |w, rate| A::weight(w, A::decay(&rate, way)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;
    use proptest::prelude::*;
    extern crate std;

    fn decay<A: Arithmetic>(absorption: &Absorption<A>, way: A::Length) -> [f64; 2] {
        let after = |behind| absorption.after(behind, way, &[A::FULL; 3]).map(Into::into);
        let [front, _, _]: [f64; 3] = after(false);
        let [behind, _, _]: [f64; 3] = after(true);
        [front, behind]
    }

    #[test]
    fn a_unit_of_a_medium() {
        let glass = Absorption::<f64>::new([0.0; 3], [1.0, 0.5, 0.0]);
        assert_eq!(glass.after(false, 3.0, &[0.5; 3]), [0.5; 3]);
        let [r, g, b] = glass.after(true, 3.0, &[0.5; 3]);
        assert!((r - 0.5 * (-3f64).exp()).abs() < 1e-15);
        assert!((g - 0.5 * (-1.5f64).exp()).abs() < 1e-15);
        assert_eq!(b, 0.5);
        assert_eq!(
            Absorption::<Fixed>::try_new([-1.0; 3], [0.0; 3]).unwrap_err(),
            ShapeError::Coefficient
        );
        assert!(Absorption::<f32>::try_new([0.0; 3], [f64::NAN; 3]).is_err());
        assert!(Absorption::<f32>::try_new([0.0; 3], [171.0; 3]).is_err());
    }

    proptest! {
        /// In fixed point the rate has 24 fraction bits, over 1024 units 3·10⁻⁵; the power's table adds
        /// 1.5·10⁻⁵ and the coefficient's step 6·10⁻⁵.
        #[test]
        fn fixed_and_single_against_f64(
            rate in prop_oneof![0.0..0.01f64, 0.0..1.0f64, 0.0..170.0f64],
            way in prop_oneof![0.0..1.0f64, 0.0..1024.0f64],
        ) {
            let fixed = Absorption::<Fixed>::new([rate; 3], [0.0; 3]);
            let length = <Fixed as Arithmetic>::Length::from_num(way);
            let way = length.to_num::<f64>();
            let exact = (-rate * way).exp();
            let [got, clear] = decay(&fixed, length);
            prop_assert!((got - exact).abs() < 1.2e-4, "{got} {exact}");
            prop_assert_eq!(clear, 1.0);
            let single = Absorption::<f32>::new([rate; 3], [0.0; 3]);
            // A rounded exponent of x is 2⁻²⁴·x wrong.
            prop_assert!((decay(&single, way as f32)[0] - exact).abs() < 1e-6);
        }
    }
}

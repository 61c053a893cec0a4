//! Where the classic programs differ, as settings of a scene.

use crate::math::{Arithmetic, for_each_arithmetic};

/// Where the classic programs differ (see the crate's documentation of the model).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules<A: Arithmetic> {
    /// Mirrored and transmitted radiance is multiplied by the cosine of its direction, as the
    /// course does; Whitted, NFF and most others don't.
    pub specular_cosine: bool,
    /// Phong's highlight is multiplied by cos(N, L), as the course does.
    pub highlight_cosine: bool,
    /// A transmitting surface sends a reflection ray even where k_sg is 0 (the rule behind the
    /// published ray counts of the Standard Procedural Databases).
    pub transmitters_reflect: bool,
    /// Total internal reflection carries k_sg alone, as in the course, not k_sg + k_tg.
    pub lossy: bool,
    /// A ray is sent if the largest channel of the product of the coefficients down the tree
    /// is at least this.
    pub cutoff: A::Weight,
}

impl<A: Arithmetic> Rules<A> {
    /// The course's own form, and a cut-off of 1/255.
    pub const COURSE: Self = Self {
        specular_cosine: true,
        highlight_cosine: true,
        transmitters_reflect: false,
        lossy: false,
        cutoff: A::CUTOFF,
    };

    /// Whitted's form: no specular cosine, a highlight of its own.
    pub const WHITTED: Self =
        Self { specular_cosine: false, highlight_cosine: false, ..Self::COURSE };

    /// The rules of the Neutral File Format's databases: Whitted's, without a cut-off.
    pub const NFF: Self =
        Self { transmitters_reflect: true, cutoff: A::NO_WEIGHT, ..Self::WHITTED };
}

for_each_arithmetic! {
    impl Rules<A> {
        /// [`COURSE`](Self::COURSE) with another cut-off.
        ///
        /// # Panics
        /// A cut-off that isn't in 0 to 1.
        pub const fn with_cutoff(cutoff: f64) -> Self {
            match Self::try_with_cutoff(cutoff) {
                Some(rules) => rules,
                None => panic!("the cut-off is 0 to 1"),
            }
        }

        /// [`COURSE`](Self::COURSE) with another cut-off; `None` where it isn't in 0 to 1.
        pub const fn try_with_cutoff(cutoff: f64) -> Option<Self> {
            if !(cutoff >= 0.0 && cutoff <= 1.0) {
                return None;
            }
            match make::weight(cutoff) {
                Some(cutoff) => Some(Self { cutoff, ..Self::COURSE }),
                None => None,
            }
        }
    }
}

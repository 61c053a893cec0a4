//! Lights: what a point sees of each.

use super::uses::{self, has};
use crate::math::{Arithmetic, Rgb, for_each_arithmetic, neg, sub};
use crate::shape::{ShapeError, ok_or_panic, point, some_or, unit_vector};

/// How a light grows weaker with distance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Falloff {
    /// With the square of the distance (the default).
    #[default]
    InverseSquare,
    /// Not at all, as in Whitted's paper and in NFF.
    None,
}

/// A light as its author writes it.
///
/// A point light's `intensity` is its radiant intensity divided by π: over the distance r it
/// gives a surface that faces it the radiance k_d·intensity/r².
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightSpec {
    /// Shines from a point in all directions.
    Point {
        /// Where it is.
        position: [f64; 3],
        /// Its intensity by channel.
        intensity: Rgb<f64>,
        /// How it grows weaker.
        falloff: Falloff,
    },
    /// Shines from infinitely far, the same everywhere.
    Directional {
        /// Where its light goes.
        direction: [f64; 3],
        /// The irradiance on a surface that faces it, divided by π.
        intensity: Rgb<f64>,
    },
    /// Shines from a point into a cone.
    Spot {
        /// Where it is.
        position: [f64; 3],
        /// Where the cone's axis goes.
        direction: [f64; 3],
        /// The intensity within the inner cone.
        intensity: Rgb<f64>,
        /// How it grows weaker.
        falloff: Falloff,
        /// The cosine of the angle between the axis and the inner cone: full light.
        cos_inner: f64,
        /// The cosine of the angle between the axis and the outer cone: no light. Smaller than
        /// `cos_inner`; in between the light fades by the smooth step 3f² − 2f³.
        cos_outer: f64,
    },
}

/// A light, precomputed.
#[derive(Clone, Copy, Debug)]
pub struct Light<A: Arithmetic> {
    pub(crate) source: Source<A>,
    /// The largest channel's intensity.
    pub(crate) intensity: A::Intensity,
    /// The channels, relative to the largest.
    pub(crate) color: Rgb<A::Weight>,
    pub(crate) falloff: Falloff,
    /// Whether it isn't white.
    pub(crate) colored: bool,
}

/// Where the light comes from.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source<A: Arithmetic> {
    Point {
        position: [A::Length; 3],
    },
    /// The direction is towards the light.
    Directional {
        direction: [A::Unit; 3],
    },
    /// The axis is towards the light; `width` is the difference of the two cosines.
    Spot {
        position: [A::Length; 3],
        axis: [A::Unit; 3],
        cos_outer: A::Weight,
        width: A::Weight,
    },
}

/// What a point gets from a light, were nothing between.
pub(crate) struct Incident<A: Arithmetic> {
    /// Towards the light.
    pub(crate) direction: [A::Unit; 3],
    pub(crate) distance: A::Length,
    /// The largest channel's irradiance on a surface that faces the light, divided by π.
    pub(crate) irradiance: A::Radiance,
}

impl<A: Arithmetic> Light<A> {
    /// How much of a spot's light goes where the light is seen in this direction, if not all; `None`
    /// outside its cone.
    #[inline(always)]
    pub(crate) fn fade(&self, direction: &[A::Unit; 3]) -> Option<Option<A::Weight>> {
        let Source::Spot { axis, cos_outer, width, .. } = &self.source else { return Some(None) };
        let inside = A::cosine(direction, axis) - *cos_outer;
        if inside <= A::NO_WEIGHT {
            return None;
        }
        if inside >= *width {
            return Some(None);
        }
        let f = A::quotient(inside, *width);
        let f2 = A::weight(f, f);
        Some(Some(f2 + f2 + f2 - A::weight(f2, f + f)))
    }

    /// What the point `p` gets; `None` outside a spot's cone.
    #[inline(always)]
    pub(crate) fn at<const USES: u64>(&self, p: &[A::Length; 3]) -> Option<Incident<A>> {
        let position = match &self.source {
            Source::Directional { direction } if has(USES, uses::DIRECTIONAL_LIGHTS) => {
                return Some(Incident {
                    direction: *direction,
                    distance: A::FAR,
                    irradiance: A::constant(&self.intensity),
                });
            }
            Source::Directional { .. } => return None,
            Source::Point { position } | Source::Spot { position, .. } => position,
        };
        let (direction, distance, inverse) = A::normalize(&sub(position, p));
        let mut irradiance = match self.falloff {
            Falloff::InverseSquare if has(USES, uses::INVERSE_SQUARE) => {
                A::falloff(&self.intensity, &inverse)
            }
            _ => A::constant(&self.intensity),
        };
        if has(USES, uses::SPOTS)
            && let Some(share) = self.fade(&direction)?
        {
            irradiance = A::dim(irradiance, share);
        }
        Some(Incident { direction, distance, irradiance })
    }
}

const fn largest(c: &Rgb<f64>) -> f64 {
    let m = if c[0] > c[1] { c[0] } else { c[1] };
    if c[2] > m { c[2] } else { m }
}

for_each_arithmetic! {
    impl Light<A> {
        /// A light, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(spec: LightSpec) -> Self {
            ok_or_panic!(Self::try_new(&spec))
        }

        /// A point light whose intensity falls off with the square of the distance.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn point(position: [f64; 3], intensity: Rgb<f64>) -> Self {
            let falloff = Falloff::InverseSquare;
            Self::new(LightSpec::Point { position, intensity, falloff })
        }

        /// A light.
        ///
        /// # Errors
        /// A position out of range, a null direction, a negative intensity, a cone whose outer
        /// cosine is not smaller than the inner one.
        pub const fn try_new(spec: &LightSpec) -> Result<Self, ShapeError> {
            let (source, intensity, falloff) = match spec {
                LightSpec::Point { position, intensity, falloff } => {
                    (Source::Point { position: point!(make, *position) }, intensity, *falloff)
                }
                LightSpec::Directional { direction, intensity } => {
                    let d = *direction;
                    let direction = unit_vector!(make, [-d[0], -d[1], -d[2]]);
                    (Source::Directional { direction }, intensity, Falloff::None)
                }
                LightSpec::Spot {
                    position, direction, intensity, falloff, cos_inner, cos_outer,
                } => {
                    let d = *direction;
                    if !(*cos_outer >= 0.0 && *cos_outer < *cos_inner && *cos_inner <= 1.0) {
                        return Err(ShapeError::Coefficient);
                    }
                    let source = Source::Spot {
                        position: point!(make, *position),
                        axis: unit_vector!(make, [-d[0], -d[1], -d[2]]),
                        cos_outer: some_or!(make::weight(*cos_outer), Coefficient),
                        width: some_or!(make::weight(*cos_inner - *cos_outer), Coefficient),
                    };
                    (source, intensity, *falloff)
                }
            };
            let max = largest(intensity);
            let scale = if max > 0.0 { 1.0 / max } else { 0.0 };
            Ok(Self {
                source,
                intensity: some_or!(make::intensity(max), Coefficient),
                color: [
                    some_or!(make::weight(intensity[0] * scale), Coefficient),
                    some_or!(make::weight(intensity[1] * scale), Coefficient),
                    some_or!(make::weight(intensity[2] * scale), Coefficient),
                ],
                falloff,
                colored: intensity[1] != intensity[0] || intensity[2] != intensity[0],
            })
        }
    }
}

impl<A: Arithmetic> Light<A> {
    /// The direction the light shines in, for a directional light or a spot.
    pub fn direction(&self) -> Option<[A::Unit; 3]> {
        match &self.source {
            Source::Point { .. } => None,
            Source::Directional { direction } => Some(neg(direction)),
            Source::Spot { axis, .. } => Some(neg(axis)),
        }
    }
}

//! Materials: the coefficients of the model, a triple of channels each.

use crate::math::{Arithmetic, Rgb, for_each_arithmetic, rgb};
use crate::shape::{ShapeError, ok_or_panic, some_or};

/// What a shadow ray finds in a surface of this material.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shadow {
    /// It is blocked, by glass too (the classic model).
    #[default]
    Opaque,
    /// It goes straight on, times the coefficient of transmission at each surface.
    Filtered,
    /// It goes on as if nothing were there.
    None,
}

/// A material as its author writes it, in plain numbers: what [`Material`] is made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaterialSpec {
    /// k_amb: how much of the ambient irradiance (divided by π) is reflected.
    pub ambient: Rgb<f64>,
    /// k_d: the diffuse albedo; the BRDF is k_d/π.
    pub diffuse: Rgb<f64>,
    /// k_s: the coefficient of Phong's highlight.
    pub specular: Rgb<f64>,
    /// n_s: Phong's exponent.
    pub shininess: f64,
    /// k_sg: the coefficient of mirror reflection, at most 1.
    pub reflection: Rgb<f64>,
    /// k_tg: the coefficient of specular transmission, at most 1.
    pub transmission: Rgb<f64>,
    /// The index of refraction on the side the normal points to (outside a body).
    pub index_front: f64,
    /// The index of refraction behind the surface (inside a body).
    pub index_behind: f64,
    /// L_e: the radiance that the surface emits from its front, whatever falls on it, at most 1024.
    /// A closed shape's front is its outside; of a shape that shows its inside only, the inside.
    pub emission: Rgb<f64>,
    /// What shadow rays find.
    pub shadow: Shadow,
    /// A pattern that shows another material in places.
    pub pattern: Option<PatternSpec>,
    /// The texture that `diffuse` and `ambient` are multiplied by, or that shows another material in
    /// places: an index into [`Parts::textures`](super::Parts::textures).
    pub texture: Option<u16>,
    /// The texture whose height bends the normal that shading sees.
    pub bump: Option<u16>,
    /// `reflection` is multiplied by what a dielectric of these indices reflects of unpolarised light
    /// (Fresnel's formula), and `transmission` by the rest.
    pub fresnel: bool,
    /// What the media on both sides absorb: an index into
    /// [`Parts::absorptions`](super::Parts::absorptions).
    pub absorption: Option<u16>,
}

impl MaterialSpec {
    /// Reflects nothing: the base for `MaterialSpec { diffuse: …, ..MaterialSpec::BLACK }`.
    pub const BLACK: Self = Self {
        ambient: [0.0; 3],
        diffuse: [0.0; 3],
        specular: [0.0; 3],
        shininess: 1.0,
        reflection: [0.0; 3],
        transmission: [0.0; 3],
        index_front: 1.0,
        index_behind: 1.0,
        emission: [0.0; 3],
        shadow: Shadow::Opaque,
        pattern: None,
        texture: None,
        bump: None,
        fresnel: false,
        absorption: None,
    };
}

/// A checker: where the sum of the cell numbers is odd, the surface has the other material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatternSpec {
    /// The side of a cell along each axis; 0 where the axis doesn't count.
    pub cell: [f64; 3],
    /// A corner of some cell.
    pub offset: [f64; 3],
    /// The material of the odd cells; its own pattern is not looked at.
    pub other: u16,
}

/// A material, precomputed.
#[derive(Clone, Copy, Debug)]
pub struct Material<A: Arithmetic> {
    pub(crate) ambient: Rgb<A::Weight>,
    pub(crate) diffuse: Rgb<A::Weight>,
    pub(crate) specular: Rgb<A::Weight>,
    pub(crate) reflection: Rgb<A::Weight>,
    pub(crate) transmission: Rgb<A::Weight>,
    pub(crate) emission: Rgb<A::Radiance>,
    pub(crate) shininess: A::Exponent,
    /// η_i/η_t for a ray from the front and for one from behind.
    pub(crate) eta: [A::Eta; 2],
    pub(crate) pattern: Option<Pattern<A>>,
    /// Indices, or `u16::MAX` for none.
    texture: u16,
    bump: u16,
    absorption: u16,
    pub(crate) shadow: Shadow,
    pub(crate) fresnel: bool,
    /// Which coefficients are not 0.
    pub(crate) shines: bool,
    pub(crate) reflects: bool,
    /// The same, whatever terms a render leaves out.
    pub(crate) mirrors: bool,
    pub(crate) transmits: bool,
    /// Whether a coefficient of reflection or transmission isn't grey.
    pub(crate) colored: bool,
    pub(crate) emits: bool,
}

impl<A: Arithmetic> Material<A> {
    #[inline(always)]
    pub(crate) const fn texture(&self) -> Option<u16> {
        some(self.texture)
    }

    #[inline(always)]
    pub(crate) const fn bump(&self) -> Option<u16> {
        some(self.bump)
    }

    #[inline(always)]
    pub(crate) const fn absorption(&self) -> Option<u16> {
        some(self.absorption)
    }

    /// The same material with another diffuse and ambient coefficient, each times a factor.
    pub(crate) fn times(&self, color: &Rgb<A::Weight>) -> Self {
        Self {
            ambient: rgb(&self.ambient, color, A::weight),
            diffuse: rgb(&self.diffuse, color, A::weight),
            ..*self
        }
    }
}

const fn some(index: u16) -> Option<u16> {
    if index == u16::MAX { None } else { Some(index) }
}

/// An index as it is stored; `None` for the one that stands for nothing.
const fn index(wanted: Option<u16>) -> Option<u16> {
    match wanted {
        None => Some(u16::MAX),
        Some(u16::MAX) => None,
        Some(index) => Some(index),
    }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Pattern<A: Arithmetic> {
    /// Cells per unit along each axis; 0 where the axis doesn't count.
    per: [A::Length; 3],
    offset: [A::Length; 3],
    pub(crate) other: u16,
}

impl<A: Arithmetic> Pattern<A> {
    /// Whether the point lies in a cell of the other material.
    #[inline(always)]
    pub(crate) fn odd(&self, p: &[A::Length; 3]) -> bool {
        let mut odd = false;
        for i in 0..3 {
            if self.per[i] != A::NO_LENGTH {
                odd ^= A::odd(A::endless_difference(p[i], self.offset[i]), self.per[i]);
            }
        }
        odd
    }
}

const fn any(c: &Rgb<f64>) -> bool {
    c[0] > 0.0 || c[1] > 0.0 || c[2] > 0.0
}

const fn colored(c: &Rgb<f64>) -> bool {
    c[1] != c[0] || c[2] != c[0]
}

const fn at_most_one(c: &Rgb<f64>) -> bool {
    c[0] <= 1.0 && c[1] <= 1.0 && c[2] <= 1.0
}

for_each_arithmetic! {
    macro_rules! weights {
        ($c:expr) => {{
            let c = $c;
            [
                some_or!(make::weight(c[0]), Coefficient),
                some_or!(make::weight(c[1]), Coefficient),
                some_or!(make::weight(c[2]), Coefficient),
            ]
        }};
    }

    impl Material<A> {
        /// A material, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(spec: MaterialSpec) -> Self {
            ok_or_panic!(Self::try_new(&spec))
        }

        /// A material.
        ///
        /// # Errors
        /// A coefficient that is negative, no number or beyond its range (16; 1 for reflection
        /// and transmission; 1024 for emission), an index of refraction whose ratio to the other
        /// side's is beyond ¼ to 4, an exponent beyond a million, a negative cell, an index of 65535.
        pub const fn try_new(spec: &MaterialSpec) -> Result<Self, ShapeError> {
            if !at_most_one(&spec.reflection) || !at_most_one(&spec.transmission) {
                return Err(ShapeError::Coefficient);
            }
            if !(spec.index_front > 0.0 && spec.index_behind > 0.0) {
                return Err(ShapeError::Coefficient);
            }
            let pattern = match &spec.pattern {
                None => None,
                Some(p) => {
                    let mut per = [0.0; 3];
                    let mut i = 0;
                    while i < 3 {
                        if !(p.cell[i] >= 0.0) {
                            return Err(ShapeError::Coefficient);
                        }
                        if p.cell[i] > 0.0 {
                            per[i] = 1.0 / p.cell[i];
                        }
                        i += 1;
                    }
                    Some(Pattern {
                        per: crate::shape::point!(make, per),
                        offset: crate::shape::point!(make, p.offset),
                        other: p.other,
                    })
                }
            };
            Ok(Self {
                ambient: weights!(spec.ambient),
                diffuse: weights!(spec.diffuse),
                specular: weights!(spec.specular),
                reflection: weights!(spec.reflection),
                transmission: weights!(spec.transmission),
                shininess: some_or!(make::exponent(spec.shininess), Coefficient),
                eta: [
                    some_or!(make::eta(spec.index_front / spec.index_behind), Coefficient),
                    some_or!(make::eta(spec.index_behind / spec.index_front), Coefficient),
                ],
                pattern,
                texture: some_or!(index(spec.texture), Material),
                bump: some_or!(index(spec.bump), Material),
                absorption: some_or!(index(spec.absorption), Material),
                shadow: spec.shadow,
                fresnel: spec.fresnel,
                shines: any(&spec.specular),
                reflects: any(&spec.reflection),
                mirrors: any(&spec.reflection),
                transmits: any(&spec.transmission),
                colored: colored(&spec.reflection) || colored(&spec.transmission),
                emission: [
                    some_or!(make::radiance(spec.emission[0]), Coefficient),
                    some_or!(make::radiance(spec.emission[1]), Coefficient),
                    some_or!(make::radiance(spec.emission[2]), Coefficient),
                ],
                emits: any(&spec.emission),
            })
        }
    }
}

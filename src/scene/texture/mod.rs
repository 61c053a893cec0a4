//! Textures: patterns and pictures that colour a surface, swap its material, or dent it.
//!
//! A point is first brought into the texture's own axes, then mapped to coordinates, which are
//! integers of 2⁻¹⁶ in every arithmetic; all that follows is the same to the bit in each. Textures lie
//! in a list of their own beside the materials, which name them by index, so that a plain material
//! takes no more memory than before.
//!
//! ```
//! use whitted::math::Fixed;
//! use whitted::scene::{Material, MaterialSpec, Parts, Pattern, Scene, Texture, TextureSpec};
//! use whitted::shape::Sphere;
//!
//! static SCENE: Scene<Fixed> = Scene::checked(Parts {
//!     spheres: &[Sphere::<Fixed>::new([0.0, 1.0, 4.0], 1.0, 0)],
//!     textures: &[Texture::<Fixed>::new(TextureSpec {
//!         size: [0.5; 3],
//!         colors: [[0.9, 0.9, 0.85], [0.2, 0.25, 0.3]],
//!         ..TextureSpec::of(Pattern::Marble { octaves: 4, turbulence: 1.5 })
//!     })],
//!     materials: &[Material::<Fixed>::new(MaterialSpec {
//!         diffuse: [1.0; 3],
//!         texture: Some(0),
//!         ..MaterialSpec::BLACK
//!     })],
//!     ..Parts::EMPTY
//! });
//! ```

mod angle;
mod image;
mod noise;
mod pattern;
mod uv;

pub use image::{Filter, Image, Texels, Wrap};
pub use pattern::Pattern;
pub use uv::TriangleUv;

use crate::math::{Arithmetic, Rgb, cross_f64, for_each_arithmetic, rgb, unit_f64};
use crate::shape::{ShapeError, ok_or_panic, point, some_or, unit_vector};
use pattern::Kind;

/// How a point becomes texture coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mapping {
    /// As it lies: a picture is projected along the third axis, a solid pattern fills space.
    #[default]
    Planar,
    /// By longitude and latitude around the origin, a whole turn being 1, the lower pole 0 and the
    /// upper one 1.
    Spherical,
    /// By longitude around the second axis, a whole turn being 1, and the length along it.
    Cylindrical,
    /// By the texture coordinates of triangles, [`Parts::uvs`](super::Parts::uvs); (0, 0) on shapes
    /// that have none.
    Uv,
}

/// A texture as its author writes it, in plain numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureSpec<'a> {
    /// What it shows.
    pub pattern: Pattern<'a>,
    /// How points become coordinates.
    pub mapping: Mapping,
    /// A corner of a cell; the middle for longitudes.
    pub origin: [f64; 3],
    /// The first axis. What of it lies along `up` doesn't count.
    pub right: [f64; 3],
    /// The second axis. The third is `right × up`.
    pub up: [f64; 3],
    /// The side of a cell along each axis, in the unit of the coordinate: a length, or a part of the
    /// whole for an angle or a mesh's coordinates. 0 where the coordinate doesn't count.
    pub size: [f64; 3],
    /// What the diffuse and the ambient coefficient are multiplied by, where the pattern is 0 and where
    /// it is 1. A picture has its own colours.
    pub colors: [Rgb<f64>; 2],
    /// Where the pattern is ½ or more, the surface has this material instead; the colours then don't
    /// count. The other material's own texture may colour it.
    pub other: Option<u16>,
    /// For a material's [`bump`](super::MaterialSpec::bump): how far the surface is raised where the
    /// pattern is 1, as a length. Slopes steeper than 1 are taken for 1.
    pub height: f64,
}

impl<'a> TextureSpec<'a> {
    /// A pattern as it lies, with cells of side 1, in white and black.
    pub const fn of(pattern: Pattern<'a>) -> Self {
        Self {
            pattern,
            mapping: Mapping::Planar,
            origin: [0.0; 3],
            right: [1.0, 0.0, 0.0],
            up: [0.0, 1.0, 0.0],
            size: [1.0; 3],
            colors: [[1.0; 3], [0.0; 3]],
            other: None,
            height: 0.0,
        }
    }
}

/// A texture, precomputed.
#[derive(Clone, Copy, Debug)]
pub struct Texture<'a, A: Arithmetic> {
    kind: Kind<'a>,
    mapping: Mapping,
    /// `NONE` for no other material.
    other: u16,
    axes: [[A::Unit; 3]; 3],
    origin: [A::Length; 3],
    /// Cells (of a picture, pixels) per unit of each coordinate; 0 where it doesn't count.
    per: [A::Length; 3],
    colors: [Rgb<A::Weight>; 2],
    /// Height times `per`.
    steep_q12: [i16; 3],
}

/// The step over which a slope is measured, in cells or pixels of 2⁻¹⁶: short against the finest
/// wave of a few octaves, long against the rounding of a height.
const SLOPE_STEP: i32 = 1 << 13;

impl<'a, A: Arithmetic> Texture<'a, A> {
    pub(super) const NONE: u16 = u16::MAX;

    /// The material of the places where the pattern is ½ or more.
    pub(crate) const fn other(&self) -> Option<u16> {
        if self.other == Self::NONE { None } else { Some(self.other) }
    }

    /// Whether it asks for triangles' coordinates.
    pub(crate) const fn wants_uv(&self) -> bool {
        matches!(self.mapping, Mapping::Uv)
    }

    /// Texture coordinates in 2⁻¹⁶.
    fn coordinates(&self, p: &[A::Length; 3], uv: [i32; 2]) -> [i32; 3] {
        let part = |i: usize, x: A::Length| A::cells(x, self.per[i]);
        if self.mapping == Mapping::Uv {
            let [u, v] = uv.map(A::length_q16);
            return [part(0, u), part(1, v), 0];
        }
        let p = [0, 1, 2].map(|i| A::endless_difference(p[i], self.origin[i]));
        let along = |i: usize| A::endless_project(&p, &self.axes[i]);
        let v = [along(0), along(1), along(2)];
        match self.mapping {
            Mapping::Spherical => {
                let [x, y] = angle::sphere(A::normalize(&v).0.map(A::to_q17)).map(A::length_q16);
                [part(0, x), part(1, y), 0]
            }
            Mapping::Cylindrical => {
                let around = [v[0], A::NO_LENGTH, v[2]];
                let [x, _] = angle::sphere(A::normalize(&around).0.map(A::to_q17));
                [part(0, A::length_q16(x)), part(1, v[1]), 0]
            }
            Mapping::Planar | Mapping::Uv => [part(0, v[0]), part(1, v[1]), part(2, v[2])],
        }
    }

    /// Whether the point has the other material.
    pub(super) fn is_other(&self, p: &[A::Length; 3]) -> bool {
        self.kind.value(self.coordinates(p, [0; 2])) >= 1 << 15
    }

    /// What the coefficients are multiplied by.
    pub(crate) fn color(&self, p: &[A::Length; 3], uv: [i32; 2]) -> Rgb<A::Weight> {
        let q = self.coordinates(p, uv);
        if let Kind::Image(image) = &self.kind {
            return image.at([q[0], q[1]]).map(|x| A::weight_q14((x + 2) >> 2));
        }
        let t = A::weight_q14(self.kind.value(q) >> 2);
        let rest = A::FULL - t;
        rgb(&self.colors[0], &self.colors[1], |a, b| A::weight(a, rest) + A::weight(b, t))
    }

    /// The gradient of the height, as the slope along each axis of space; each at most 1 along the
    /// texture's own.
    pub(crate) fn gradient(&self, p: &[A::Length; 3]) -> [A::Unit; 3] {
        let q = self.coordinates(p, [0; 2]);
        let here = self.kind.value(q);
        let mut sum = [A::NO_UNIT; 3];
        for i in 0..3 {
            let steep = i32::from(self.steep_q12[i]);
            if steep == 0 {
                continue;
            }
            let mut next = q;
            next[i] = next[i].wrapping_add(SLOPE_STEP);
            let rise_q16 = self.kind.value(next).wrapping_sub(here);
            // Over a step of 2⁻³: Q16 and Q12 to Q17, below 2³¹ before
            let slope_q17 = (rise_q16.wrapping_mul(steep) >> 8).clamp(-(1 << 17), 1 << 17);
            let slope = A::unit_q17(slope_q17);
            for j in 0..3 {
                sum[j] = sum[j] + A::product(self.axes[i][j], slope);
            }
        }
        sum
    }
}

const fn fraction_q16(x: f64) -> Option<i32> {
    if x >= 0.0 && x <= 1.0 { Some((x * 65536.0 + 0.5) as i32) } else { None }
}

const fn octaves_of(octaves: u8) -> Option<u8> {
    if octaves >= 1 && octaves <= noise::MOST_OCTAVES { Some(octaves) } else { None }
}

const fn turbulence_q8(x: f64) -> Option<i16> {
    if x >= 0.0 && x <= 16.0 { Some((x * 256.0 + 0.5) as i16) } else { None }
}

const fn kind<'a>(spec: &TextureSpec<'a>) -> Option<Kind<'a>> {
    macro_rules! some {
        ($value:expr) => {
            match $value {
                Some(value) => value,
                None => return None,
            }
        };
    }
    Some(match spec.pattern {
        Pattern::Checker => Kind::Checker,
        Pattern::Stripes { width } => Kind::Stripes { width_q16: some!(fraction_q16(width)) },
        Pattern::Gradient { wrap } => Kind::Gradient { wrap },
        Pattern::Noise { octaves } => Kind::Noise { octaves: some!(octaves_of(octaves)) },
        Pattern::Marble { octaves, turbulence } => Kind::Marble {
            octaves: some!(octaves_of(octaves)),
            turbulence_q8: some!(turbulence_q8(turbulence)),
        },
        Pattern::Wood { octaves, turbulence } => Kind::Wood {
            octaves: some!(octaves_of(octaves)),
            turbulence_q8: some!(turbulence_q8(turbulence)),
        },
        Pattern::Brick { mortar } => {
            let [x, y, _] = spec.size;
            if !(x > 0.0 && y > 0.0) {
                return None;
            }
            // As wide only where both sides are lengths.
            let along = match spec.mapping {
                Mapping::Planar => mortar * y / x,
                _ => mortar,
            };
            Kind::Brick { mortar_q16: [some!(fraction_q16(along)), some!(fraction_q16(mortar))] }
        }
        Pattern::Image(image) => Kind::Image(image),
    })
}

for_each_arithmetic! {
    macro_rules! color {
        ($c:expr) => {{
            let c = $c;
            [
                some_or!(make::weight(c[0]), Coefficient),
                some_or!(make::weight(c[1]), Coefficient),
                some_or!(make::weight(c[2]), Coefficient),
            ]
        }};
    }

    impl<'a> Texture<'a, A> {
        /// A texture, for scenes in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(spec: TextureSpec<'a>) -> Self {
            ok_or_panic!(Self::try_new(&spec))
        }

        /// A texture.
        ///
        /// # Errors
        /// A number of the pattern's out of its range; axes that are null or lie along each other; a
        /// size that is negative or so small that there are more than 1024 cells (of a picture, pixels)
        /// to a unit in fixed point; a colour as for a material; a height other than 0 for another
        /// mapping than [`Planar`](Mapping::Planar), or of more than 4 cells (pixels); another material
        /// by a mesh's coordinates.
        pub const fn try_new(spec: &TextureSpec<'a>) -> Result<Self, ShapeError> {
            let kind = some_or!(kind(spec), Coefficient);
            let up = some_or!(unit_f64(spec.up), Direction);
            let right = some_or!(unit_f64(spec.right), Direction);
            let third = cross_f64(right, up);
            // Nearer together than a thousandth, rounding decides where the third goes.
            if third[0] * third[0] + third[1] * third[1] + third[2] * third[2] < 1e-6 {
                return Err(ShapeError::Direction);
            }
            let third = some_or!(unit_f64(third), Direction);
            let first = cross_f64(up, third);
            let pixels = match &kind {
                Kind::Image(image) => [image.size().0 as f64, image.size().1 as f64, 0.0],
                _ => [1.0; 3],
            };
            let planar = matches!(spec.mapping, Mapping::Planar);
            if !planar && !(spec.height == 0.0) {
                return Err(ShapeError::Coefficient);
            }
            let other = match spec.other {
                None => Self::NONE,
                Some(_) if matches!(spec.mapping, Mapping::Uv) => {
                    return Err(ShapeError::Coefficient);
                }
                Some(Self::NONE) => return Err(ShapeError::Material),
                Some(other) => other,
            };
            let mut per = [0.0; 3];
            let mut steep_q12 = [0; 3];
            let mut i = 0;
            while i < 3 {
                if !(spec.size[i] >= 0.0) {
                    return Err(ShapeError::Size);
                }
                if spec.size[i] > 0.0 {
                    per[i] = pixels[i] / spec.size[i];
                    let steep = spec.height * per[i] * 4096.0;
                    if !(steep >= -16384.0 && steep <= 16384.0) {
                        return Err(ShapeError::Coefficient);
                    }
                    steep_q12[i] = (if steep < 0.0 { steep - 0.5 } else { steep + 0.5 }) as i16;
                }
                i += 1;
            }
            Ok(Self {
                kind,
                mapping: spec.mapping,
                other,
                axes: [
                    unit_vector!(make, first),
                    unit_vector!(make, up),
                    unit_vector!(make, third),
                ],
                origin: point!(make, spec.origin),
                per: [
                    some_or!(make::length(per[0]), Size),
                    some_or!(make::length(per[1]), Size),
                    some_or!(make::length(per[2]), Size),
                ],
                colors: [color!(spec.colors[0]), color!(spec.colors[1])],
                steep_q12,
            })
        }
    }
}

#[cfg(test)]
mod tests;

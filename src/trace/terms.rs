//! The terms of radiance, and the paths of light they stand for.
//!
//! A path is written from the light to the eye (Heckbert, "Adaptive radiosity textures for
//! bidirectional ray tracing", 1990): L a light or a surface that emits, A the ambient light, B the
//! background, D a diffuse reflection, G Phong's highlight, S a mirror or a refraction (R, T one of
//! them alone), E the eye; * any number, + at least one.

use crate::math::{Arithmetic, Rgb};
use crate::scene::Material;
use core::fmt;

/// A set of terms: those that a render adds up.
///
/// All but the two specular ones end a path; those say whether paths go on through mirrors and
/// glass. With both, the pictures of each of the others alone add up to the whole. At total
/// reflection inside glass the ray belongs to the transmission.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Terms(u8);

impl Terms {
    /// Nothing.
    pub const NONE: Self = Self(0);
    /// What surfaces emit.
    pub const EMISSION: Self = Self(1);
    /// k_amb·E_amb.
    pub const AMBIENT: Self = Self(1 << 1);
    /// Lambert's term of the lights.
    pub const DIRECT: Self = Self(1 << 2);
    /// Phong's highlights of the lights.
    pub const HIGHLIGHT: Self = Self(1 << 3);
    /// Mirrored rays.
    pub const REFLECTION: Self = Self(1 << 4);
    /// Refracted rays.
    pub const TRANSMISSION: Self = Self(1 << 5);
    /// The background.
    pub const BACKGROUND: Self = Self(1 << 6);
    /// Interreflection, where a scene has it.
    pub const INDIRECT: Self = Self(1 << 7);
    /// All of them.
    pub const ALL: Self = Self(0xff);

    /// The terms of both sets.
    #[must_use]
    pub const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The terms of this set that aren't in the other.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether all of the other set's terms are in this one.
    #[inline(always)]
    pub const fn has(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The paths that a render of these terms covers, for text.
    pub const fn paths(self, depth: u8) -> Paths {
        Paths { terms: self, depth }
    }

    /// The material, with the coefficients of these terms alone.
    #[inline(never)]
    pub(super) fn of<A: Arithmetic>(self, material: &Material<A>) -> Material<A> {
        let mut material = *material;
        let keep = |term, k: &mut Rgb<A::Weight>, flag: &mut bool| {
            if !self.has(term) {
                (*k, *flag) = ([A::NO_WEIGHT; 3], false);
            }
        };
        keep(Self::AMBIENT, &mut material.ambient, &mut false);
        keep(Self::DIRECT, &mut material.diffuse, &mut false);
        keep(Self::HIGHLIGHT, &mut material.specular, &mut material.shines);
        keep(Self::REFLECTION, &mut material.reflection, &mut material.reflects);
        keep(Self::TRANSMISSION, &mut material.transmission, &mut material.transmits);
        material.emits &= self.has(Self::EMISSION);
        material
    }
}

/// The paths of light that a render covers, as text: `L S* E, L D S* E, …`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paths {
    terms: Terms,
    depth: u8,
}

impl fmt::Display for Paths {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (mirrors, glass) =
            (self.terms.has(Terms::REFLECTION), self.terms.has(Terms::TRANSMISSION));
        let through = match (mirrors, glass) {
            _ if self.depth < 2 => "",
            (true, true) => " S*",
            (true, false) => " R*",
            (false, true) => " T*",
            (false, false) => "",
        };
        let ends = [
            (Terms::EMISSION, "L"),
            (Terms::DIRECT, "L D"),
            (Terms::HIGHLIGHT, "L G"),
            (Terms::INDIRECT, "L D D+"),
            (Terms::AMBIENT, "A D"),
            (Terms::BACKGROUND, "B"),
        ];
        let mut first = true;
        for (term, start) in ends {
            if self.terms.has(term) {
                let comma = if first { "" } else { ", " };
                write!(f, "{comma}{start}{through} E")?;
                first = false;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    extern crate std;
    use std::string::ToString;

    #[test]
    fn paths_in_words() {
        let paths = |terms: Terms, depth| terms.paths(depth).to_string();
        let all = "L S* E, L D S* E, L G S* E, L D D+ S* E, A D S* E, B S* E";
        assert_eq!(paths(Terms::ALL, 5), all);
        assert_eq!(paths(Terms::DIRECT, 5), "L D E");
        assert_eq!(paths(Terms::DIRECT.with(Terms::REFLECTION), 5), "L D R* E");
        assert_eq!(paths(Terms::DIRECT.with(Terms::REFLECTION), 1), "L D E");
        assert_eq!(paths(Terms::NONE, 5), "");
    }
}

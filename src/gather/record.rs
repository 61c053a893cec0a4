//! Irradiance records: what is remembered at a point.

use bytemuck::AnyBitPattern;

use crate::blob::{Stored, put, stored};
use crate::math::{Arithmetic, Rgb, for_each_arithmetic};
use crate::shape::{ShapeError, ok_or_panic, point, some_or};

/// Three radiances with a common exponent, in 32 bits: nine bits each and five, as in OpenGL's
/// RGB9_E5, here of multiples of 2⁻¹⁶. The largest channel keeps a relative precision of 2⁻⁹; a
/// channel above 32767 is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, AnyBitPattern)]
#[repr(transparent)]
pub(crate) struct PackedRgb(u32);

impl Stored for PackedRgb {
    fn store(&self, to: &mut [u8]) {
        put(&self.0, to, 0);
    }

    fn is_sound(&self) -> bool {
        self.0 & 31 <= 22
    }
}

impl PackedRgb {
    pub(crate) const fn new(q16: [i32; 3]) -> Self {
        let (r, g, b) = (positive(q16[0]), positive(q16[1]), positive(q16[2]));
        let most = if r > g { r } else { g };
        let most = if b > most { b } else { most };
        let mut exponent = 0;
        // Rounding must not carry into a tenth bit.
        while exponent < 22 && rounded(most, exponent) > 511 {
            exponent += 1;
        }
        Self(
            rounded(r, exponent) << 23
                | rounded(g, exponent) << 14
                | rounded(b, exponent) << 5
                | exponent,
        )
    }

    /// In 1/65536.
    #[inline(always)]
    pub(crate) const fn q16(self) -> [i32; 3] {
        let up = self.0 & 31;
        let (r, g, b) = (self.0 >> 23, self.0 >> 14 & 511, self.0 >> 5 & 511);
        [(r << up) as i32, (g << up) as i32, (b << up) as i32]
    }
}

const fn positive(x: i32) -> u32 {
    if x > 0 { x as u32 } else { 0 }
}

const fn rounded(x: u32, down: u32) -> u32 {
    let y = x.wrapping_add((1 << down) >> 1) >> down;
    if y > 511 && down == 22 { 511 } else { y }
}

/// A record as its author, or a baker, writes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordSpec {
    /// Where.
    pub position: [f64; 3],
    /// The unit normal there, on the side that the light comes from.
    pub normal: [f64; 3],
    /// How far from there the record counts, its normal being the same.
    pub reach: f64,
    /// The irradiance divided by π.
    pub irradiance: Rgb<f64>,
    /// How the irradiance changes on the way along the reach, as a part of itself: the
    /// translational gradient times the reach, no longer than 1.
    pub translation: [f64; 3],
    /// How it changes with the normal, as a part of itself: times the cross product of the old
    /// normal and the new one, no longer than 2.
    pub rotation: [f64; 3],
}

/// The irradiance at a point, how it changes around it, and how far that holds.
///
/// 32 bytes in fixed point and `f32`, 48 in `f64`. Positions and reach are the arithmetic's own
/// lengths; normals have 14 fraction bits, irradiance nine bits for the largest channel, the
/// gradients seven and six fraction bits.
#[derive(Clone, Copy, Debug, PartialEq, AnyBitPattern)]
#[repr(C)]
pub struct Record<A: Arithmetic> {
    pub(crate) position: [A::Length; 3],
    pub(crate) reach: A::Length,
    pub(crate) irradiance: PackedRgb,
    pub(crate) normal_q14: [i16; 3],
    pub(crate) translation_q7: [i8; 3],
    pub(crate) rotation_q6: [i8; 3],
}

stored!(Record {
    position: lengths, reach: length, irradiance: nested, normal_q14: whole, translation_q7: whole,
    rotation_q6: whole,
} if *reach > A::NO_LENGTH
    && square(normal_q14, 1.0 / 16384.0, 0.99, 1.01)
    && square(translation_q7, 1.0 / 127.0, 0.0, STEEPEST)
    && square(rotation_q6, 1.0 / 63.0, 0.0, MOST_TURNING));

// A gatherer makes no gradient longer than 127, whatever that stands for, but by what its arithmetic
// is wrong: 5.6 in 1,000 of 65536, half of it of twice that, then less than a step along each axis.

/// The largest square of a translational gradient: ((1.0056·127 + √3)/127)².
const STEEPEST: f64 = 1.04;
/// The largest square of a rotational one: ((1.0034·127 + √3)/63)².
const MOST_TURNING: f64 = 4.21;

/// Whether the square of a vector lies within bounds.
pub(super) fn square<T: Copy + Into<f64>>(v: &[T; 3], one: f64, least: f64, most: f64) -> bool {
    let square = v.iter().map(|&x| Into::<f64>::into(x) * one).fold(0.0, |sum, x| sum + x * x);
    square >= least && square <= most
}

const _: () = assert!(size_of::<Record<crate::math::Fixed>>() == 32);
const _: () = assert!(size_of::<Record<f32>>() == 32);
const _: () = assert!(size_of::<Record<f64>>() == 48);

impl<A: Arithmetic> Record<A> {
    /// A record that counts nowhere: what a pool is made of before it is filled.
    pub const NONE: Self = Self {
        position: [A::NO_LENGTH; 3],
        reach: A::NO_LENGTH,
        irradiance: PackedRgb(0),
        normal_q14: [0; 3],
        translation_q7: [0; 3],
        rotation_q6: [0; 3],
    };

    /// Where it is.
    pub fn position(&self) -> [A::Length; 3] {
        self.position
    }

    /// The normal there.
    #[inline(always)]
    pub fn normal(&self) -> [A::Unit; 3] {
        let n = &self.normal_q14;
        let f = |i: usize| A::fraction(i32::from(n[i]) << 2);
        [f(0), f(1), f(2)]
    }

    /// The irradiance there, divided by π.
    #[inline(always)]
    pub fn irradiance(&self) -> Rgb<A::Radiance> {
        self.irradiance.q16().map(A::from_q16)
    }

    /// In plain numbers, which make the same record again.
    pub fn spec(&self) -> RecordSpec {
        let small = |x: [i8; 3], one: f64| x.map(|x| f64::from(x) / one);
        RecordSpec {
            position: self.position.map(Into::into),
            normal: self.normal_q14.map(|x| f64::from(x) / 16384.0),
            reach: self.reach.into(),
            irradiance: self.irradiance.q16().map(|x| f64::from(x) / 65536.0),
            translation: small(self.translation_q7, 127.0),
            rotation: small(self.rotation_q6, 63.0),
        }
    }
}

const fn rounds(x: f64) -> f64 {
    if x < 0.0 { x - 0.5 } else { x + 0.5 }
}

for_each_arithmetic! {
    impl Record<A> {
        /// A record, for caches in `const`s.
        ///
        /// # Panics
        /// Where [`try_new`](Self::try_new) has an error.
        pub const fn new(spec: RecordSpec) -> Self {
            ok_or_panic!(Self::try_new(&spec))
        }

        /// A record.
        ///
        /// # Errors
        /// A position out of range, a normal that isn't a unit vector, a reach that isn't
        /// positive, an irradiance or gradient out of range.
        pub const fn try_new(spec: &RecordSpec) -> Result<Self, ShapeError> {
            let (mut square, mut slope, mut turn) = (0.0, 0.0, 0.0);
            let mut normal_q14 = [0; 3];
            let mut irradiance = [0; 3];
            let mut translation_q7 = [0; 3];
            let mut rotation_q6 = [0; 3];
            let mut i = 0;
            while i < 3 {
                square += spec.normal[i] * spec.normal[i];
                normal_q14[i] = rounds(spec.normal[i] * 16384.0) as i16;
                let e = spec.irradiance[i];
                if !(e >= 0.0 && e <= 32_767.0) {
                    return Err(ShapeError::Coefficient);
                }
                irradiance[i] = rounds(e * 65536.0) as i32;
                let (t, r) = (spec.translation[i], spec.rotation[i]);
                (slope, turn) = (slope + t * t, turn + r * r);
                // `as` keeps within i8
                translation_q7[i] = rounds(t * 127.0) as i8;
                rotation_q6[i] = rounds(r * 63.0) as i8;
                i += 1;
            }
            if !(slope <= STEEPEST && turn <= MOST_TURNING) {
                return Err(ShapeError::Coefficient);
            }
            if !(square > 0.99 && square < 1.01) {
                return Err(ShapeError::Direction);
            }
            if !(spec.reach > 0.0) {
                return Err(ShapeError::Size);
            }
            Ok(Self {
                position: point!(make, spec.position),
                reach: some_or!(make::length(spec.reach), Size),
                irradiance: PackedRgb::new(irradiance),
                normal_q14,
                translation_q7,
                rotation_q6,
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Fixed;
    use proptest::prelude::*;
    extern crate std;

    proptest! {
        #[test]
        fn packed_to_nine_bits(r in 0..=i32::MAX, g in 0..=i32::MAX, shift in 0u32..31) {
            let rgb = [r >> shift, g >> shift, (r ^ g) >> shift];
            let got = PackedRgb::new(rgb).q16();
            let most = f64::from(*rgb.iter().max().expect("three"));
            for i in 0..3 {
                let wrong = (f64::from(got[i]) - f64::from(rgb[i])).abs();
                prop_assert!(wrong <= most / 511.0 + 0.5, "{rgb:?}: {got:?}");
            }
        }
    }

    #[test]
    fn specs_come_back() {
        let spec = RecordSpec {
            position: [1.5, -2.25, 3.0],
            normal: [0.0, 0.6, 0.8],
            reach: 0.75,
            irradiance: [0.5, 0.25, 1.0],
            translation: [0.5, -0.8, 0.0],
            rotation: [2.0, 0.0, -0.25],
        };
        let record = Record::<Fixed>::new(spec);
        assert_eq!(Record::<Fixed>::new(record.spec()), record);
        let record = Record::<f64>::new(spec);
        assert_eq!(Record::<f64>::new(record.spec()), record);
        assert_eq!(record.irradiance(), [0.5, 0.25, 1.0]);
        assert!(Record::<f32>::try_new(&RecordSpec { normal: [1.0; 3], ..spec }).is_err());
        assert!(Record::<f32>::try_new(&RecordSpec { reach: 0.0, ..spec }).is_err());
    }
}

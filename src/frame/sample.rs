//! What samplers remember of a ray, and when two of them differ.
//!
//! Two samples differ if their colours do by more than a threshold, on 8-bit sRGB, or if the rays
//! met different objects, or the same with other lights in shadow. Object and shadows are kept as
//! a signature, made by a tally that stands before the user's, so that the tracer knows nothing of it.
//!
//! Sparse sampling uses the same memory, as words.

use super::{Output, Rgb888};
use crate::math::{Arithmetic, Rgb};
use crate::shape::Ray;
use crate::tally::{RayKind, Tally, Term};
use bytemuck::TransparentWrapper;

/// Memory for what a sampler remembers: 16 bytes, 32 in `f64`.
// Three radiances, and in the place of a fourth the colours on 8-bit sRGB and the signature.
#[derive(Clone, Copy, Debug, TransparentWrapper)]
#[repr(transparent)]
pub struct Sample<A: Arithmetic>([A::Radiance; 4]);

/// The signature's bits. The sixth is left out, so that the word is a number as floats have it, too.
const SIGNATURE: u8 = 0xbf;

/// A word as it lies in the place of a radiance, and back.
#[inline(always)]
fn put_word<A: Arithmetic>(word: u32) -> A::Radiance {
    if size_of::<A::Radiance>() == 4 {
        bytemuck::try_cast(word).unwrap_or(A::BLACK)
    } else {
        bytemuck::try_cast([word, 0]).unwrap_or(A::BLACK)
    }
}

#[inline(always)]
fn word<A: Arithmetic>(radiance: A::Radiance) -> u32 {
    if size_of::<A::Radiance>() == 4 {
        bytemuck::try_cast(radiance).unwrap_or(0)
    } else {
        let [word, _] = bytemuck::try_cast(radiance).unwrap_or([0u32; 2]);
        word
    }
}

impl<A: Arithmetic> Sample<A> {
    /// No ray yet: what memory for samples is filled with.
    pub const NONE: Self = Self([A::BLACK; 4]);

    /// What a ray found.
    #[inline(always)]
    pub(super) fn new(radiance: Rgb<A::Radiance>, signature: u8) -> Self {
        let Rgb888([r, g, b]) = Output::SRGB.pixel::<A, Rgb888>(&radiance, 0, 0);
        Self::with_word(radiance, u32::from_le_bytes([r, g, b, signature]))
    }

    #[inline(always)]
    fn with_word([r, g, b]: Rgb<A::Radiance>, word: u32) -> Self {
        Self([r, g, b, put_word::<A>(word)])
    }

    /// A radiance that nothing will be compared with.
    #[inline(always)]
    pub(super) fn plain(radiance: Rgb<A::Radiance>) -> Self {
        Self::with_word(radiance, 0)
    }

    /// What came back along the ray.
    #[inline(always)]
    pub(super) fn radiance(&self) -> Rgb<A::Radiance> {
        let [r, g, b, _] = self.0;
        [r, g, b]
    }

    /// The same on 8-bit sRGB, and the signature.
    #[inline(always)]
    fn seen(&self) -> ([u8; 3], u8) {
        let [r, g, b, signature] = word::<A>(self.0[3]).to_le_bytes();
        ([r, g, b], signature)
    }

    /// The memory as words, as sparse sampling uses it.
    #[inline(always)]
    pub(super) fn words(samples: &[Self]) -> &[u32] {
        bytemuck::try_cast_slice(Self::peel_slice(samples)).unwrap_or_default()
    }

    /// The same, to be changed.
    #[inline(always)]
    pub(super) fn words_mut(samples: &mut [Self]) -> &mut [u32] {
        bytemuck::try_cast_slice_mut(Self::peel_slice_mut(samples)).unwrap_or_default()
    }
}

impl<A: Arithmetic> Default for Sample<A> {
    fn default() -> Self {
        Self::NONE
    }
}

/// Whether the colours of any two samples differ.
#[inline(always)]
pub(super) fn differ_in_color<A: Arithmetic, const N: usize>(
    samples: &[Sample<A>; N],
    threshold: u8,
) -> bool {
    let (mut low, mut high) = ([u8::MAX; 3], [0; 3]);
    for sample in samples {
        for i in 0..3 {
            let value = sample.seen().0[i];
            low[i] = if value < low[i] { value } else { low[i] };
            high[i] = if value > high[i] { value } else { high[i] };
        }
    }
    (0..3).any(|i| high[i].wrapping_sub(low[i]) > threshold)
}

/// Whether any two samples differ.
#[inline(always)]
pub(super) fn differ<A: Arithmetic, const N: usize>(
    samples: &[Sample<A>; N],
    threshold: u8,
) -> bool {
    let mut signatures = samples.iter().map(|sample| sample.seen().1);
    let first = signatures.next();
    signatures.any(|signature| Some(signature) != first) || differ_in_color(samples, threshold)
}

/// Makes a signature out of what the tracer reports, if one is wanted, counts rays, and hands all of it on.
pub(super) struct Watch<'t, T, const SIGNS: bool = true> {
    tally: &'t mut T,
    signature: u8,
    rays: u32,
}

impl<'t, T, const SIGNS: bool> Watch<'t, T, SIGNS> {
    #[inline(always)]
    pub(super) fn new(tally: &'t mut T) -> Self {
        Self { tally, signature: 0, rays: 0 }
    }

    /// What the sampler remembers of the rays that were reported.
    #[inline(always)]
    pub(super) fn sample<A: Arithmetic>(&self, radiance: Rgb<A::Radiance>) -> Sample<A> {
        let seventh = self.signature << 1 & 0x80;
        Sample::new(radiance, (self.signature & 0x3f | seventh) & SIGNATURE)
    }

    /// How many rays were reported.
    #[inline(always)]
    pub(super) fn rays(&self) -> u32 {
        self.rays
    }
}

impl<T: Tally, const SIGNS: bool> Tally for Watch<'_, T, SIGNS> {
    #[inline(always)]
    fn ray<A: Arithmetic>(&mut self, kind: RayKind, depth: u8, ray: &Ray<A>, w: &Rgb<A::Weight>) {
        self.rays = self.rays.wrapping_add(1);
        self.tally.ray(kind, depth, ray, w);
    }

    #[inline(always)]
    fn hit<A: Arithmetic>(&mut self, kind: RayKind, shape: u32, distance: A::Length) {
        if SIGNS && kind == RayKind::Primary {
            // An odd factor keeps shapes apart whose numbers differ by less than 128.
            self.signature = (shape as u8).wrapping_add(1).wrapping_mul(0x9d);
        }
        self.tally.hit::<A>(kind, shape, distance);
    }

    #[inline(always)]
    fn term<A: Arithmetic>(&mut self, term: Term, radiance: &Rgb<A::Radiance>) {
        self.tally.term::<A>(term, radiance);
    }

    #[inline(always)]
    fn shadowed(&mut self, light: u16, depth: u8) {
        if SIGNS && depth == 1 {
            self.signature ^= (light as u8).wrapping_add(1).wrapping_mul(0x2b);
        }
        self.tally.shadowed(light, depth);
    }

    #[inline(always)]
    fn node(&mut self) {
        self.tally.node();
    }

    #[inline(always)]
    fn test(&mut self) {
        self.tally.test();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(radiance: f64, signature: u8) -> Sample<f64> {
        Sample::new([radiance; 3], signature)
    }

    #[test]
    fn samples_differ_by_colour_and_by_signature() {
        let a = grey(0.5, 7);
        // 188.0 and 190.0 on the sRGB curve
        let near = grey(0.5143, 7);
        assert!(!differ(&[a, near, a, near], 2));
        assert!(differ(&[a, near, a, near], 1));
        for place in 0..4 {
            let mut four = [a; 4];
            four[place] = grey(0.5, 8);
            assert!(differ(&four, 255));
            four[place] = Sample::new([0.5, 0.5, 0.4], 7);
            assert!(differ(&four, 4) && !differ(&four, 255));
        }
    }

    /// What is compared after these reports.
    fn signature(shape: u32, shadows: &[u16], deeper: bool) -> u8 {
        let mut tally = ();
        let mut watch = Watch::<()>::new(&mut tally);
        watch.hit::<f64>(RayKind::Primary, shape, 1.0);
        watch.hit::<f64>(RayKind::Reflection, 99, 1.0);
        shadows.iter().for_each(|&light| watch.shadowed(light, 1));
        if deeper {
            watch.shadowed(0, 2);
        }
        watch.sample::<f64>([0.5; 3]).seen().1
    }

    #[test]
    fn signatures_tell_shapes_and_shadows_apart() {
        let count = 128;
        assert!((1..count).all(|shape| signature(shape, &[], false) != signature(0, &[], false)));
        let lights = 0..count as u16 - 1;
        assert!(
            lights.clone().all(|light| signature(3, &[light], false) != signature(3, &[], false))
        );
        assert!(signature(3, &[0, 1], false) != signature(3, &[0], false));
        assert_eq!(signature(3, &[1], true), signature(3, &[1], false));
    }

    #[test]
    fn a_sample_is_read_as_it_was_written() {
        fn test<A: Arithmetic>() {
            for (rgb, signature) in [([0, 1, 2], 0), ([255; 3], SIGNATURE), ([7, 0, 128], 0x9d)] {
                let [r, g, b] = rgb;
                let word = u32::from_le_bytes([r, g, b, signature]);
                let radiance = [1, 2, 3].map(A::from_q16);
                let sample = Sample::<A>::with_word(radiance, word);
                assert_eq!(sample.radiance(), radiance);
                assert_eq!(sample.seen(), (rgb, signature));
            }
        }
        test::<crate::math::Fixed>();
        test::<f32>();
        test::<f64>();
    }
}

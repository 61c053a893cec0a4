//! What samplers remember of a ray, and when two of them differ.
//!
//! Two samples differ if their colours do by more than a threshold, on 8-bit sRGB, or if the rays
//! met different objects, or the same with other lights in shadow. Object and shadows are kept as
//! a signature, made by a tally that stands before the user's, so that the tracer knows nothing of it.
//!
//! Colours and signature share a word. Adaptive sampling compares seven bits of the signature. Sparse
//! sampling has to know whether many rays followed, and marks samples at corners: that leaves it six.

use super::{Output, Rgb888};
use crate::math::{Arithmetic, Rgb};
use crate::shape::Ray;
use crate::tally::{RayKind, Tally, Term};

/// What a sampler remembers of a ray: 16 bytes, 32 in `f64`.
#[derive(Clone, Copy, Debug)]
pub struct Sample<A: Arithmetic> {
    pub(super) radiance: Rgb<A::Radiance>,
    srgb: [u8; 3],
    /// The signature and the bit for many rays. Where sparse sampling has been told of it, six bits are
    /// left, 0 where no ray has been sent, and the seventh is its mark.
    signature: u8,
}

/// The seventh bit of the signature, or the mark.
const MARK: u8 = 0x80;
/// The bit that says that the pixel took many rays.
const COSTLY: u8 = 0x40;
/// The signature's other bits.
const SIGNATURE: u8 = 0x3f;
/// More rays than these, of all kinds, are many.
const FEW_RAYS: u32 = 5;

impl<A: Arithmetic> Sample<A> {
    /// No ray yet: what memory for samples is filled with.
    pub const NONE: Self = Self { radiance: [A::BLACK; 3], srgb: [0; 3], signature: 0 };

    /// What a ray found.
    #[inline(always)]
    pub(super) fn new(radiance: Rgb<A::Radiance>, signature: u8) -> Self {
        let Rgb888(srgb) = Output::SRGB.pixel::<A, Rgb888>(&radiance, 0, 0);
        Self { radiance, srgb, signature }
    }

    /// The same as sparse sampling remembers it: known, and not marked yet.
    #[inline(always)]
    pub(super) fn known(self) -> Self {
        let one = u8::from(self.signature & SIGNATURE == 0);
        Self { signature: self.signature & !MARK | one, ..self }
    }

    /// A radiance that nothing will be compared with.
    #[inline(always)]
    pub(super) fn plain(radiance: Rgb<A::Radiance>) -> Self {
        Self { radiance, srgb: [0; 3], signature: 1 }
    }

    /// Whether a ray has been sent.
    #[inline(always)]
    pub(super) fn is_known(&self) -> bool {
        self.signature & SIGNATURE != 0
    }

    /// Whether a sampler has marked it.
    #[inline(always)]
    pub(super) fn is_marked(&self) -> bool {
        self.signature & MARK != 0
    }

    /// What lies in the middle between two samples where no ray has been sent.
    #[inline(always)]
    pub(super) fn between(
        &self,
        other: &Self,
        mean: impl Fn(&Rgb<A::Radiance>, &Rgb<A::Radiance>) -> Rgb<A::Radiance>,
    ) -> Self {
        let half = |a: u8, b: u8| (u16::from(a).wrapping_add(u16::from(b)) >> 1) as u8;
        let ([r, g, b], [s, h, c]) = (self.srgb, other.srgb);
        Self {
            radiance: mean(&self.radiance, &other.radiance),
            srgb: [half(r, s), half(g, h), half(b, c)],
            signature: self.signature & other.signature & COSTLY,
        }
    }

    /// Whether a ray among four samples is worth sending: their colours differ by more than the
    /// threshold, a quarter less if their rays met different things, half as much again if all took many.
    #[inline(never)]
    pub(super) fn is_worth_a_ray(&self, b: &Self, c: &Self, d: &Self, threshold: u8) -> bool {
        let four = [self, b, c, d];
        let (mut costly, mut first, mut same) = (COSTLY, 0, true);
        for sample in four {
            costly &= sample.signature;
            let signature = sample.signature & SIGNATURE;
            same &= first == 0 || signature == 0 || signature == first;
            first = if signature == 0 { first } else { signature };
        }
        let limit = if costly == 0 { threshold } else { threshold.saturating_add(threshold >> 1) };
        let limit = if same { limit } else { limit.wrapping_sub(limit >> 2) };
        (0..3).any(|i| {
            let [a, b, c, d] = four.map(|sample| sample.srgb[i]);
            let (low, high) = (a.min(b).min(c.min(d)), a.max(b).max(c.max(d)));
            high.wrapping_sub(low) > limit
        })
    }

    /// As if no ray had been sent.
    #[inline(always)]
    pub(super) fn forget(&mut self) {
        self.signature = 0;
    }

    /// The same, marked.
    #[inline(always)]
    pub(super) fn marked(self) -> Self {
        Self { signature: self.signature | MARK, ..self }
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
            let value = sample.srgb[i];
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
    let mut signatures = samples.iter().map(|sample| sample.signature & !COSTLY);
    let first = signatures.next();
    signatures.any(|signature| Some(signature) != first) || differ_in_color(samples, threshold)
}

/// Makes a signature out of what the tracer reports, and hands all of it on.
pub(super) struct Watch<'t, T> {
    tally: &'t mut T,
    signature: u8,
    rays: u32,
}

impl<'t, T> Watch<'t, T> {
    #[inline(always)]
    pub(super) fn new(tally: &'t mut T) -> Self {
        Self { tally, signature: 0, rays: 0 }
    }

    /// What the sampler remembers of the rays that were reported.
    #[inline(always)]
    pub(super) fn sample<A: Arithmetic>(&self, radiance: Rgb<A::Radiance>) -> Sample<A> {
        let costly = if self.rays > FEW_RAYS { COSTLY } else { 0 };
        let seventh = self.signature << 1 & MARK;
        Sample::new(radiance, self.signature & SIGNATURE | seventh | costly)
    }
}

impl<T: Tally> Tally for Watch<'_, T> {
    #[inline(always)]
    fn ray<A: Arithmetic>(&mut self, kind: RayKind, depth: u8, ray: &Ray<A>, w: &Rgb<A::Weight>) {
        self.rays = self.rays.wrapping_add(1);
        self.tally.ray(kind, depth, ray, w);
    }

    #[inline(always)]
    fn hit<A: Arithmetic>(&mut self, kind: RayKind, shape: u32, distance: A::Length) {
        if kind == RayKind::Primary {
            // An odd factor keeps shapes apart whose numbers differ by less than 128, or 64 of six bits.
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
        if depth == 1 {
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

    /// What is compared after these reports, by adaptive sampling and by sparse sampling.
    fn signatures(shape: u32, shadows: &[u16], deeper: bool) -> [u8; 2] {
        let mut tally = ();
        let mut watch = Watch::new(&mut tally);
        watch.hit::<f64>(RayKind::Primary, shape, 1.0);
        watch.hit::<f64>(RayKind::Reflection, 99, 1.0);
        shadows.iter().for_each(|&light| watch.shadowed(light, 1));
        if deeper {
            watch.shadowed(0, 2);
        }
        let sample = watch.sample::<f64>([0.5; 3]);
        [sample.signature & !COSTLY, sample.known().signature & SIGNATURE]
    }

    #[test]
    fn signatures_tell_shapes_and_shadows_apart() {
        // Seven bits and six: twice as many neighbours, or as many lights.
        for (i, count) in [(0, 128), (1, 64)] {
            let signature = |shape, shadows: &[u16]| signatures(shape, shadows, false)[i];
            assert!((1..count).all(|shape| signature(shape, &[]) != signature(0, &[])));
            let lights = 0..count as u16 - 1;
            assert!(lights.clone().all(|light| signature(3, &[light]) != signature(3, &[])));
            assert!(signature(3, &[0, 1]) != signature(3, &[0]));
        }
        assert_eq!(signatures(3, &[1], true), signatures(3, &[1], false));
    }

    #[test]
    fn what_sparse_sampling_knows_is_no_mark() {
        for shape in 0..256 {
            let mut tally = ();
            let mut watch = Watch::new(&mut tally);
            watch.hit::<f64>(RayKind::Primary, shape, 1.0);
            let known = watch.sample::<f64>([0.5; 3]).known();
            assert!(known.is_known() && !known.is_marked());
            assert!(known.marked().is_marked() && known.marked().is_known());
        }
    }
}

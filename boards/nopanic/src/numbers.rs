//! What is asked by itself: pixel formats, functions on bare numbers, operations of an arithmetic.

use core::hint::black_box as any;

use embedded_graphics::pixelcolor as eg;
use whitted::Color;
use whitted::frame::{self, Dither, Tone, Transfer};
use whitted::math::{self, Arithmetic, Fixed};
use whitted::shape::MaterialId;

/// Pixel formats and tone.
#[inline(never)]
pub(crate) fn formats() {
    let tone = any(Tone::LINEAR);
    any(tone.value(any(5)));
    any(Transfer::Srgb);
    let threshold = any(Dither::Ordered).threshold(any(1), any(2));
    format::<eg::Rgb565>(threshold);
    format::<eg::Rgb888>(threshold);
    format::<eg::Gray8>(threshold);
    format::<eg::Gray4>(threshold);
    format::<eg::BinaryColor>(threshold);
    any(MaterialId::new(any(7)).inside_only());
    any(MaterialId::new(any(7)).index());
}

#[inline(never)]
fn format<C: Color>(threshold: u16) {
    let pixel = <C::Pixel as frame::Pixel>::quantize(any([1; 3]), threshold);
    any(frame::Pixel::to_be_bytes(any(pixel)));
    any(C::from_pixel(any(pixel)));
}

/// Functions on bare numbers.
#[inline(never)]
pub(crate) fn numbers() {
    any(math::sqrt_f32(any(2.0)));
    lengths::<Fixed>();
    lengths::<f32>();
    lengths::<f64>();
}

/// Operations of an arithmetic that the tracer may not need in this combination.
#[inline(never)]
fn lengths<A: Arithmetic>() {
    let (t, u, w, r) = (any(A::FAR), any(A::ONE_UNIT), any(A::FULL), any(A::BLACK));
    let (p, d) = (any([t; 3]), any([u; 3]));
    any(A::along(&p, t, &d));
    any(A::scale(t, u));
    any(A::project(&p, &d));
    any(A::dot(&d, &d));
    any(A::product(u, u));
    any(A::cosine(&d, &d));
    any(A::reflect(&d, &d, u));
    any(A::ratio(t, u));
    any(A::normalize(&p).0);
    any(A::renormalize(&d));
    any(A::leave(&p, &d, t));
    any(A::weight(w, w));
    any(A::quotient(w, w));
    any(A::weight_of(u));
    any(A::relative(r, r));
    any(A::portion(r, any(7)));
    any(A::fraction(any(7)));
    any(A::share(t, &any(A::normalize(&p).2)));
    any(A::dim(r, w));
    any(A::gather(r, r));
    any(A::mean(r, any(0)));
    any(A::to_q16(r));
    any(A::odd(t, t));
    any(math::add(&p, &p));
    any(math::sub(&p, &p));
    any(math::neg(&d));
    any(math::axis_of(&p, any(7)));
    any(math::largest(&[w; 3]));
    any(math::rgb(&[r; 3], &[w; 3], A::dim));
}

//! Frames: which rays a picture takes, and how it leaves, row by row, without a framebuffer.
//!
//! A [`Renderer`] traces rows of radiance in memory of the caller's. What leaves it is one line
//! into a slice of pixels ([`Renderer::line`]), bands of bytes for DMA ([`Renderer::band`]), or,
//! through [`Picture`](crate::Picture), whatever embedded-graphics draws on. Or the picture comes
//! from coarse to fine, in blocks, as far as a deadline lets it ([`Renderer::refine`]).

mod adaptive;
mod band;
mod corners;
mod error;
mod jitter;
mod passes;
mod pixel;
mod renderer;
mod sample;
mod sampling;
mod scan;
mod sparse;
mod tone;

pub use error::FrameError;
pub use passes::{Block, Passes, Progress};
pub use pixel::{Dither, Gray1, Gray4, Gray8, Pixel, Rgb565, Rgb888};
pub use renderer::Renderer;
pub use sample::Sample;
pub use sampling::Sampling;
pub use scan::{Pixels, Scan};
pub use tone::{Tone, Transfer};

use crate::math::{Arithmetic, Rgb};
use crate::trace::Terms;

/// What a frame is to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Pixels across.
    pub width: u16,
    /// Pixels down.
    pub height: u16,
    /// How deep the tree of rays may be; the camera's ray has depth 1.
    pub depth: u8,
    /// Where its rays go.
    pub sampling: Sampling,
    /// Which terms of radiance it shows.
    pub terms: Terms,
}

impl Settings {
    /// A picture of this size, five deep, one ray a pixel.
    pub const fn new(width: u16, height: u16) -> Self {
        Self { width, height, depth: 5, sampling: Sampling::Center, terms: Terms::ALL }
    }
}

/// How radiance becomes pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// Exposure and curve.
    pub tone: Tone,
    /// Dither.
    pub dither: Dither,
}

impl Output {
    /// sRGB, rounded to the nearest level.
    pub const SRGB: Self = Self { tone: Tone::SRGB, dither: Dither::None };
    /// sRGB, dithered: for displays of few levels.
    pub const DITHERED: Self = Self { tone: Tone::SRGB, dither: Dither::Ordered };

    /// The pixel that shows a radiance at (x, y).
    #[inline(always)]
    pub fn pixel<A: Arithmetic, P: Pixel>(&self, radiance: &Rgb<A::Radiance>, x: u16, y: u16) -> P {
        self.shown(self.tone.values::<A>(radiance), x, y)
    }

    /// The pixel of display values at (x, y).
    #[inline(always)]
    fn shown<P: Pixel>(&self, values: [u16; 3], x: u16, y: u16) -> P {
        P::quantize(values, self.dither.threshold(x, y))
    }
}

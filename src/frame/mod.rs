//! Frames: which rays a picture takes, and how it leaves, row by row, without a framebuffer.
//!
//! A [`Renderer`] traces rows of radiance in memory of the caller's. What leaves it is one line
//! into a slice of pixels ([`Renderer::line`]), bands of bytes for DMA ([`Renderer::band`]), or,
//! through [`Picture`](crate::Picture), whatever embedded-graphics draws on.

mod band;
mod error;
mod jitter;
mod pixel;
mod renderer;
mod tone;

pub use error::FrameError;
pub use pixel::{Dither, Gray1, Gray4, Gray8, Pixel, Rgb565, Rgb888};
pub use renderer::{Renderer, Scan};
pub use tone::{Tone, Transfer};

/// Where the rays of a pixel go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sampling {
    /// One through the centre of each pixel.
    #[default]
    Center,
    /// One through each pixel's corner, the mean of four making a pixel: (W + 1)·(H + 1) rays, as
    /// the Standard Procedural Databases ask. Needs a row of W + 1 radiances.
    Corners,
    /// One through the middle of each of `side`×`side` cells of the pixel, averaged.
    Grid {
        /// 1 to 8.
        side: u8,
    },
    /// One at random within each of `side`×`side` cells, averaged: regular patterns turn into
    /// noise. The same seed gives the same picture on every machine.
    Jittered {
        /// 1 to 8.
        side: u8,
        /// Which of the random pictures.
        seed: u16,
    },
}

impl Sampling {
    /// How many radiances the renderer must remember for pictures of this width.
    pub const fn samples(self, width: u16) -> usize {
        match self {
            Self::Center | Self::Grid { .. } | Self::Jittered { .. } => 0,
            Self::Corners => width as usize + 1,
        }
    }
}

/// What a frame is to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Pixels across.
    pub width: u16,
    /// Pixels down.
    pub height: u16,
    /// How deep the tree of rays may be; the camera's ray has depth 1.
    pub depth: u8,
    /// Where the rays of a pixel go.
    pub sampling: Sampling,
}

impl Settings {
    /// A picture of this size, five deep, one ray a pixel.
    pub const fn new(width: u16, height: u16) -> Self {
        Self { width, height, depth: 5, sampling: Sampling::Center }
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
    pub fn pixel<A: crate::math::Arithmetic, P: Pixel>(
        &self,
        radiance: &crate::math::Rgb<A::Radiance>,
        x: u16,
        y: u16,
    ) -> P {
        let value = |r: A::Radiance| self.tone.value(A::to_q16(r));
        let rgb = [value(radiance[0]), value(radiance[1]), value(radiance[2])];
        P::quantize(rgb, self.dither.threshold(x, y))
    }
}

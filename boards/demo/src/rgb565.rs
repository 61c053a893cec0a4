//! What a colour display of 16-bit pixels shows, on the chip and on the host that compares.

use whitted::frame::{Renderer, Rgb565, Settings};
use whitted::math::Fixed;
use whitted::trace::Work;

use crate::frame::MAX_DEPTH;
use crate::job::SceneName;
use crate::scenes::{Shot, Shots};

/// Bytes a pixel takes.
pub const BYTES: usize = 2;

/// A scene's shot, in fixed point, and a renderer of it.
///
/// # Panics
/// If a side is 0: no scene is deeper than the memory.
pub fn renderer<'a>(
    scene: SceneName,
    width: u16,
    height: u16,
    work: &'a mut Work<Fixed, MAX_DEPTH>,
) -> (Shot<Fixed>, Renderer<'a, Fixed, MAX_DEPTH>) {
    let shot = Fixed::shot(scene);
    let settings = Settings { depth: shot.depth, ..Settings::new(width, height) };
    let renderer = Renderer::new(shot.scene, shot.camera, settings, work, &mut [])
        .expect("a picture with sides");
    (shot, renderer)
}

/// Adds pixels to a sum that tells pictures apart, of 32 bits (FNV-1a over pixels), since on a
/// small core it must cost little beside tracing.
#[must_use]
pub fn sum(sum: u32, bytes: &[u8]) -> u32 {
    bytes.as_chunks::<BYTES>().0.iter().fold(sum, |sum, &pixel| {
        (sum ^ u32::from(u16::from_be_bytes(pixel))).wrapping_mul(0x0100_0193)
    })
}

/// Draws a scene into bytes, big-endian, row by row; as many rows as there is room for.
///
/// # Panics
/// If a side is 0.
pub fn draw(scene: SceneName, width: u16, height: u16, bytes: &mut [u8]) {
    let mut work = Work::new();
    let (shot, mut renderer) = renderer(scene, width, height, &mut work);
    renderer.band::<Rgb565>(0, &shot.output, bytes);
}

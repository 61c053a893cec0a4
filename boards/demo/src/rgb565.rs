//! What a colour display of 16-bit pixels shows, on the chip and on the host that compares.

use whitted::frame::{Renderer, Rgb565, Settings};
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Scene, SceneRef};
use whitted::trace::Work;

use crate::frame::MAX_DEPTH;
use crate::job::{ArithName, SceneName};
use crate::scenes::{Shot, Shots, View};

/// Bytes a pixel takes.
pub const BYTES: usize = 2;

/// A renderer of a shot.
///
/// # Panics
/// If a side is 0: no scene is deeper than the memory.
pub fn renderer<'a, A: Arithmetic, S, const USES: u64>(
    shot: &Shot<A, S>,
    width: u16,
    height: u16,
    work: &'a mut Work<A, MAX_DEPTH>,
) -> Renderer<'a, A, MAX_DEPTH, (), S>
where
    S: SceneRef<Target = Scene<'static, A, USES>>,
{
    let settings = Settings { depth: shot.depth, ..Settings::new(width, height) };
    Renderer::new(shot.scene, shot.camera, settings, work, &mut []).expect("a picture with sides")
}

/// Adds pixels to a sum that tells pictures apart, of 32 bits (FNV-1a over pixels), since on a
/// small core it must cost little beside tracing.
#[must_use]
pub fn sum(sum: u32, bytes: &[u8]) -> u32 {
    bytes.as_chunks::<BYTES>().0.iter().fold(sum, |sum, &pixel| {
        (sum ^ u32::from(u16::from_be_bytes(pixel))).wrapping_mul(0x0100_0193)
    })
}

/// Draws a scene in fixed point into bytes, big-endian, row by row; as many rows as there is room for.
///
/// # Panics
/// If a side is 0.
#[cfg_attr(target_os = "none", inline)]
pub fn draw(scene: SceneName, width: u16, height: u16, bytes: &mut [u8]) {
    draw_in(ArithName::Fixed, scene, width, height, bytes);
}

/// The same in an arithmetic.
///
/// # Panics
/// If a side is 0.
#[cfg_attr(target_os = "none", inline)]
pub fn draw_in(arith: ArithName, scene: SceneName, width: u16, height: u16, bytes: &mut [u8]) {
    let view = Bytes { width, height, bytes };
    match arith {
        ArithName::Fixed => Fixed::shot(scene, view),
        ArithName::F32 => f32::shot(scene, view),
    }
}

struct Bytes<'a> {
    width: u16,
    height: u16,
    bytes: &'a mut [u8],
}

impl<A: Arithmetic> View<A> for Bytes<'_> {
    type Output = ();

    fn view<S, const USES: u64>(self, shot: Shot<A, S>)
    where
        S: SceneRef<Target = Scene<'static, A, USES>>,
    {
        let mut work = Work::new();
        let mut renderer = renderer(&shot, self.width, self.height, &mut work);
        renderer.band::<Rgb565>(0, &shot.output, self.bytes);
    }
}

//! Bands: whole rows as bytes, the most significant first, as SPI displays take them by DMA.

use super::{Output, Pixel, Renderer, Settings};
use crate::math::Arithmetic;
use crate::tally::Tally;

impl<A: Arithmetic, const MAX_DEPTH: usize, T: Tally, const USES: u64>
    Renderer<'_, A, MAX_DEPTH, T, USES>
{
    /// Fills `bytes` with the rows from `y` on, as many as fit wholly; returns how many rows, 0
    /// below the picture's end. With two buffers, one is sent while the other is filled.
    #[inline(always)]
    pub fn band<P: Pixel>(&mut self, y: u16, output: &Output, bytes: &mut [u8]) -> u16 {
        let Settings { width, height, .. } = *self.settings();
        let line = usize::from(width) * P::BYTES;
        let fit = bytes.len().checked_div(line).unwrap_or(0);
        let left = height.saturating_sub(y);
        let rows = if fit < usize::from(left) { fit as u16 } else { left };
        let mut places = bytes.iter_mut();
        for (x, y, radiance) in self.scan(0..width, y..y + rows) {
            let pixel: P = output.pixel::<A, P>(&radiance, x, y);
            for byte in pixel.to_be_bytes().iter().take(P::BYTES) {
                if let Some(place) = places.next() {
                    *place = *byte;
                }
            }
        }
        rows
    }
}

//! Bands: whole rows as bytes, the most significant first, as SPI displays take them by DMA.

use super::renderer::Asked;
use super::{Output, Pixel, Renderer, Settings};
use crate::math::Arithmetic;
use crate::scene::{Scene, SceneRef};
use crate::tally::Tally;
use crate::trace::call_site;

impl<'s, A, const MAX_DEPTH: usize, T, S, const USES: u64> Renderer<'_, A, MAX_DEPTH, T, S>
where
    A: Arithmetic,
    T: Tally,
    S: SceneRef<Target = Scene<'s, A, USES>>,
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
        // As in `line`.
        let mut sparse = self.sparse.take();
        let tone = &output.tone;
        let put = |(x, y): (u16, u16), values: [u16; 3], bytes: &mut [u8]| {
            let pixel: P = output.shown(values, x, y);
            bytes.iter_mut().zip(pixel.to_be_bytes()).for_each(|(place, byte)| *place = byte);
        };
        for (y, line) in (y..).zip(bytes.chunks_exact_mut(line.max(1)).take(usize::from(rows))) {
            let row = self.row(y);
            let mut ready = false;
            for (x, bytes) in (0..width).zip(line.chunks_exact_mut(P::BYTES)) {
                let asked = Asked { row: &row, x, y, columns: (0, width) };
                let traced = self.traced::<{ call_site::BAND }>(&mut sparse, asked, tone);
                let Some(values) = traced else {
                    ready = true;
                    break;
                };
                put((x, y), values, bytes);
            }
            if ready {
                let places = line.chunks_exact_mut(P::BYTES);
                for ((x, bytes), values) in (0..width).zip(places).zip(self.ready()) {
                    put((x, y), values, bytes);
                }
            }
        }
        self.sparse = sparse;
        rows
    }
}

//! Where within a pixel its rays go.
//!
//! A pixel is cut into n×n cells, a ray to each: through its middle, or moved at random within it
//! (Cook, "Stochastic sampling in computer graphics", 1986). The random offsets come from the
//! pixel's own coordinates, the ray's number and a seed through an integer hash, so a picture is
//! the same on every machine and in whatever order its pixels are traced.

use crate::math::hash;

/// The place of cell `cell` of `side` along one axis, in 1/256 of a pixel, `within` in 0 to 255
/// being the place in the cell.
#[inline(always)]
fn place(cell: u8, side: u8, within: u32) -> u8 {
    let at = u32::from(cell) * 256 + within;
    // below 256: the last cell ends there
    at.checked_div(u32::from(side)).unwrap_or(128) as u8
}

/// The place of a ray in its pixel through the middle of a cell, in 1/256.
#[inline(always)]
pub(super) fn middle(cell: (u8, u8), side: u8) -> (u8, u8) {
    (place(cell.0, side, 128), place(cell.1, side, 128))
}

/// The place of a ray in its pixel at random within a cell, in 1/256.
#[inline(always)]
pub(super) fn jittered(cell: (u8, u8), side: u8, pixel: (u16, u16), seed: u16) -> (u8, u8) {
    let number = u32::from(cell.1) << 3 | u32::from(cell.0);
    let pixel = u32::from(pixel.1) << 16 | u32::from(pixel.0);
    let bits = hash(hash(pixel) ^ (u32::from(seed) << 16 | number));
    // Rounded up as often as down: always down would move the picture by half a step.
    let place =
        |cell: u8, bits: u32| place(cell, side, bits & 255).saturating_add((bits >> 8 & 1) as u8);
    (place(cell.0, bits), place(cell.1, bits >> 16))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn middles() {
        assert_eq!(middle((0, 0), 1), (128, 128));
        assert_eq!([0, 1, 2, 3].map(|i| middle((i, 0), 4).0), [32, 96, 160, 224]);
    }

    #[test]
    fn every_ray_stays_in_its_cell_and_the_mean_is_the_middle() {
        for side in 1..=8u8 {
            let mut sum = [0u32; 2];
            let mut count = 0;
            for y in 0..40u16 {
                for x in 0..40u16 {
                    for cell in 0..side * side {
                        let cell = (cell % side, cell / side);
                        let (a, b) = jittered(cell, side, (x, y), 7);
                        let n = u32::from(side);
                        for (place, cell) in [(a, cell.0), (b, cell.1)] {
                            // rounded down or up to 1/256
                            let (at, low) = (u32::from(place) * n, u32::from(cell) * 256);
                            assert!(at + n > low && at < low + 256 + n, "{at} in cell {cell}");
                        }
                        sum = [sum[0] + u32::from(a), sum[1] + u32::from(b)];
                        count += 1;
                    }
                }
            }
            for sum in sum {
                let mean = f64::from(sum) / f64::from(count);
                assert!((mean - 128.0).abs() < 4.0, "{side}: {mean}");
            }
        }
    }

    #[test]
    fn seeds_and_pixels_differ() {
        let a = jittered((0, 0), 1, (3, 4), 0);
        assert!(a != jittered((0, 0), 1, (3, 4), 1) && a != jittered((0, 0), 1, (4, 3), 0));
    }
}

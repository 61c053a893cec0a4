//! Smaller pictures.

use super::Pixels;

/// The picture with no side above `most`: each pixel the mean of a square of pixels, or of what there is
/// of one at the right and lower edges. Means are those of light, not of its sRGB values.
pub(super) fn reduced(pixels: Pixels, most: u32) -> Pixels {
    let longest = pixels.width.max(pixels.height);
    if longest <= most {
        return pixels;
    }
    let side = longest.div_ceil(most);
    let (width, height) = (pixels.width.div_ceil(side), pixels.height.div_ceil(side));
    let light: Vec<f64> = (0..=255).map(linear).collect();
    let rows: Vec<&[[u8; 3]]> = pixels.colors.chunks(pixels.width as usize).collect();
    let mut colors = Vec::with_capacity((width * height) as usize);
    for square in rows.chunks(side as usize) {
        for x in 0..width as usize {
            let columns = x * side as usize..((x + 1) * side as usize).min(pixels.width as usize);
            let mut sum = [0.0; 3];
            for pixel in square.iter().flat_map(|row| &row[columns.clone()]) {
                for (sum, &value) in sum.iter_mut().zip(pixel) {
                    *sum += light[usize::from(value)];
                }
            }
            let count = (columns.len() * square.len()) as f64;
            colors.push(sum.map(|sum| nearest(&light, sum / count)));
        }
    }
    Pixels { width, height, colors }
}

/// The light of a value on the sRGB curve (IEC 61966-2-1).
fn linear(value: u8) -> f64 {
    let v = f64::from(value) / 255.0;
    if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

/// The value whose light is nearest.
fn nearest(light: &[f64], wanted: f64) -> u8 {
    let above = light.partition_point(|&l| l < wanted).min(255);
    let below = above.saturating_sub(1);
    if wanted - light[below] < light[above] - wanted { below as u8 } else { above as u8 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_is_what_is_averaged() {
        // Black and white in a checker are half the light, 188 on the curve; edges count what they have.
        let colors = (0..5 * 3).map(|i| [if i % 2 == 0 { 255 } else { 0 }; 3]).collect();
        let small = reduced(Pixels { width: 5, height: 3, colors }, 3);
        assert_eq!((small.width, small.height), (3, 2));
        assert_eq!(small.colors[0], [188; 3]);
        assert_eq!(small.colors[1], [188; 3]);
        assert_eq!(small.colors[2], [188; 3]);
        assert_eq!(small.colors[3], [188; 3]);
        assert_eq!(small.colors[5], [255; 3]);
    }

    #[test]
    fn a_picture_that_fits_stays() {
        let colors = vec![[1, 2, 3], [4, 5, 6]];
        let same = reduced(Pixels { width: 2, height: 1, colors: colors.clone() }, 2);
        assert_eq!((same.width, same.height, same.colors), (2, 1, colors));
    }

    #[test]
    fn every_value_is_its_own() {
        let light: Vec<f64> = (0..=255).map(linear).collect();
        assert!((0..=255).all(|value| nearest(&light, linear(value)) == value));
    }
}

//! `cargo xtask compare`: how far two pictures are apart.
//!
//! Decibels are 10·log₁₀(255² / mean squared difference) over all channels of 8-bit sRGB, the
//! measure of the whole project.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use whitted_host::document::Size;
use whitted_host::picture::Picture;

use crate::USAGE;

/// How often a difference is enlarged in the picture of differences.
const ENLARGED: u16 = 8;

/// Reads a PNG with 8 bits a channel; a transparent one is taken as it is stored.
pub(crate) fn open(path: &Path) -> Result<Picture, String> {
    let name = path.display();
    let file = File::open(path).map_err(|error| format!("{name}: {error}"))?;
    let mut decoder = png::Decoder::new(BufReader::new(file));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let wrong = |error: png::DecodingError| format!("{name}: {error}");
    let mut reader = decoder.read_info().map_err(wrong)?;
    let bytes = reader.output_buffer_size().ok_or_else(|| format!("{name}: too large"))?;
    let mut data = vec![0; bytes];
    let info = reader.next_frame(&mut data).map_err(wrong)?;
    let mut picture = Picture::new(Size { width: info.width, height: info.height });
    let samples = info.color_type.samples();
    for (pixel, from) in picture.pixels_mut().iter_mut().zip(data.chunks_exact(samples)) {
        *pixel = match *from {
            [r, g, b, ..] => [r, g, b],
            [grey, ..] => [grey; 3],
            [] => [0; 3],
        };
    }
    Ok(picture)
}

/// Of two pictures of one size.
#[derive(Debug, PartialEq)]
struct Difference {
    /// Infinite where they are the same.
    decibels: f64,
    /// The largest in any channel.
    largest: u8,
    /// Pixels that differ by more than 8 levels in some channel.
    visible: usize,
}

fn difference(a: &Picture, b: &Picture) -> (Difference, Picture) {
    let mut picture = Picture::new(a.size());
    let (mut squares, mut largest, mut visible) = (0u64, 0, 0);
    for ((out, a), b) in picture.pixels_mut().iter_mut().zip(a.pixels()).zip(b.pixels()) {
        let off = [0, 1, 2].map(|i| a[i].abs_diff(b[i]));
        squares += off.iter().map(|&d| u64::from(d) * u64::from(d)).sum::<u64>();
        let most = off.into_iter().fold(0, u8::max);
        largest = largest.max(most);
        visible += usize::from(most > 8);
        *out = off.map(|d| (u16::from(d) * ENLARGED).min(255) as u8);
    }
    let mean = squares as f64 / (3 * a.pixels().len()) as f64;
    let decibels = 10.0 * (255.0 * 255.0 / mean).log10();
    (Difference { decibels, largest, visible }, picture)
}

/// Compares two pictures, and draws where they differ.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let (a, b, out) = match *words {
        [a, b] => (a, b, None),
        [a, b, "-o", out] => (a, b, Some(out)),
        _ => return Err(USAGE.into()),
    };
    let (first, second) = (open(a.as_ref())?, open(b.as_ref())?);
    if first.size() != second.size() {
        return Err(format!("{a} is {}, {b} is {}", first.size(), second.size()));
    }
    let (difference, picture) = difference(&first, &second);
    if let Some(out) = out {
        picture.save(out.as_ref()).map_err(|error| format!("{out}: {error}"))?;
    }
    println!(
        "{:.1} dB, at most {} levels, {} of {} pixels by more than 8",
        difference.decibels,
        difference.largest,
        difference.visible,
        first.pixels().len()
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_by_hand() {
        let a = Picture::new(Size { width: 2, height: 1 });
        let mut b = a.clone();
        assert!(difference(&a, &b).0.decibels.is_infinite());
        b.pixels_mut()[1] = [0, 51, 0];
        let (found, picture) = difference(&a, &b);
        // 51 is a fifth of 255, in one channel of six: 10·log₁₀(25·6).
        assert!((found.decibels - 21.7609).abs() < 1e-4, "{found:?}");
        assert_eq!((found.largest, found.visible), (51, 1));
        assert_eq!(picture.pixels(), [[0; 3], [0, 255, 0]]);
    }
}

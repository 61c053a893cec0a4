//! From a file's bytes to pixels.

use std::io::Cursor;

use png::{ColorType, Transformations};
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::Pixels;
use crate::document::Size;
use crate::error::Problem;

/// As many as 4096×4096: a few bytes can ask for more than the memory.
const MOST_PIXELS: u64 = 1 << 24;

/// Reads a PNG or a JPEG, told by its first bytes.
pub(super) fn decode(bytes: &[u8]) -> Result<Pixels, Problem> {
    match bytes {
        [0xff, 0xd8, 0xff, ..] => jpeg(bytes),
        _ => png(bytes),
    }
}

fn fits(width: u32, height: u32) -> Result<(), Problem> {
    for side in [width, height] {
        if !(1..=Size::LARGEST).contains(&side) {
            let right = format!("1 to {}", Size::LARGEST);
            return Err(Problem::range("side of the picture", f64::from(side), right));
        }
    }
    let pixels = u64::from(width) * u64::from(height);
    if pixels > MOST_PIXELS {
        let right = format!("at most {MOST_PIXELS}, 4096×4096");
        return Err(Problem::range("pixels of the picture", pixels as f64, right));
    }
    Ok(())
}

fn png(bytes: &[u8]) -> Result<Pixels, Problem> {
    let bad = |error: png::DecodingError| {
        Problem::Syntax(format!("is no picture in PNG or JPEG: {error}"))
    };
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::EXPAND | Transformations::STRIP_16);
    let mut reader = decoder.read_info().map_err(bad)?;
    let (width, height) = (reader.info().width, reader.info().height);
    fits(width, height)?;
    let Some(room) = reader.output_buffer_size() else {
        return Err(Problem::Syntax("is larger than the memory".into()));
    };
    let mut buffer = vec![0; room];
    let frame = reader.next_frame(&mut buffer).map_err(bad)?;
    let samples = frame.color_type.samples();
    let grey = matches!(frame.color_type, ColorType::Grayscale | ColorType::GrayscaleAlpha);
    let color = |s: &[u8]| if grey { [s[0]; 3] } else { [s[0], s[1], s[2]] };
    let colors = buffer[..frame.buffer_size()].chunks_exact(samples).map(color).collect();
    Ok(Pixels { width, height, colors })
}

fn jpeg(bytes: &[u8]) -> Result<Pixels, Problem> {
    let bad = |error: &dyn std::fmt::Debug| Problem::Syntax(format!("is a bad JPEG: {error:?}"));
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|error| bad(&error))?;
    let (width, height) = decoder.dimensions().ok_or_else(|| bad(&"it has no size"))?;
    let (width, height) = (width as u32, height as u32);
    fits(width, height)?;
    let buffer = decoder.decode().map_err(|error| bad(&error))?;
    let colors: Vec<[u8; 3]> = buffer.as_chunks::<3>().0.to_vec();
    if colors.len() as u64 != u64::from(width) * u64::from(height) {
        return Err(bad(&"its colours are of another kind"));
    }
    Ok(Pixels { width, height, colors })
}

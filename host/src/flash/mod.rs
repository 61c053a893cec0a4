//! Pictures as they lie in flash: made of few colours, packed to few bits.

mod decode;
mod reduce;

use std::collections::HashMap;
use std::path::Path;
use std::sync::{Mutex, OnceLock, PoisonError};

use color_quant::NeuQuant;
use whitted::scene::{Image, Texels};

use crate::document::Size;
use crate::error::Problem;
use crate::read;

/// The fewest colours that a picture of more can be reduced to: below, the quantiser's network is too
/// small to learn.
pub const LEAST_COLORS: u32 = 16;
/// The most colours of a palette.
pub const MOST_COLORS: u32 = 256;

/// As wide or as high as a mesh's picture gets: programs that make meshes give them pictures larger
/// than a chip's flash.
const MESH_SIDE: u32 = 256;

/// A picture, its rows from the top.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Pixels {
    width: u32,
    height: u32,
    /// On the sRGB curve.
    colors: Vec<[u8; 3]>,
}

impl Pixels {
    const fn size(&self) -> Size {
        Size { width: self.width, height: self.height }
    }
}

/// Reads a PNG or JPEG for a palette of so many colours. Transparency isn't looked at.
///
/// The bytes stay in memory for the rest of the program, as a board's lie in flash, once for each
/// picture and number of colours.
///
/// # Errors
/// The file can't be read, is no such picture, or is larger than the core takes.
pub fn picture(path: &Path, most: u32) -> Result<Image<'static>, Problem> {
    kept(decode::decode(&read::bytes(path)?)?, most)
}

/// A mesh's picture out of a file's bytes, of [`MOST_COLORS`] and not larger than [`MESH_SIDE`]; and a
/// word on its size where it was.
pub(crate) fn of_mesh(bytes: &[u8]) -> Result<(Image<'static>, Option<String>), Problem> {
    let pixels = decode::decode(bytes)?;
    let before = pixels.size();
    let pixels = reduce::reduced(pixels, MESH_SIDE);
    let Size { width, height } = pixels.size();
    let reduced = (width < before.width || height < before.height)
        .then(|| format!("{}×{} pixels, reduced to {width}×{height}", before.width, before.height));
    Ok((kept(pixels, MOST_COLORS)?, reduced))
}

/// The picture in memory that is never freed.
fn kept(pixels: Pixels, most: u32) -> Result<Image<'static>, Problem> {
    type Known = Mutex<HashMap<(Pixels, u32), Image<'static>>>;
    static KNOWN: OnceLock<Known> = OnceLock::new();
    let key = (pixels, most);
    let mut known =
        KNOWN.get_or_init(Known::default).lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(image) = known.get(&key) {
        return Ok(*image);
    }
    let image = packed(key.0.size(), &key.0.colors, most)?;
    known.insert(key, image);
    Ok(image)
}

/// The picture in as few bits as its colours take, or as the wanted number does.
fn packed(size: Size, pixels: &[[u8; 3]], most: u32) -> Result<Image<'static>, Problem> {
    let mut palette: Vec<[u8; 3]> = pixels.to_vec();
    palette.sort_unstable();
    palette.dedup();
    let indices: Vec<u8> = if palette.len() <= most as usize {
        let index = |p: &[u8; 3]| palette.binary_search(p).unwrap_or(0) as u8;
        pixels.iter().map(index).collect()
    } else {
        let rgba: Vec<u8> = pixels.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect();
        let quantiser = NeuQuant::new(1, most as usize, &rgba);
        palette = quantiser.color_map_rgb().chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
        rgba.chunks_exact(4).map(|p| quantiser.index_of(p) as u8).collect()
    };
    let bits = [1u8, 2, 4].into_iter().find(|&bits| palette.len() <= 1 << bits).unwrap_or(8);
    let per_byte = usize::from(8 / bits);
    let mut bytes = Vec::new();
    for row in indices.chunks(size.width.max(1) as usize) {
        for group in row.chunks(per_byte) {
            let first_down = group.iter().zip((0..8).step_by(bits.into()));
            bytes.push(first_down.fold(0, |byte, (&index, at)| byte | index << (8 - bits - at)));
        }
    }
    let texels = Texels::Indexed { bits, palette: Vec::leak(palette) };
    Image::try_new(size.width as u16, size.height as u16, texels, Vec::leak(bytes))
        .map_err(|error| Problem::Syntax(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_are_kept() {
        let pixels = [[1, 2, 3], [9, 9, 9], [1, 2, 3], [200, 0, 0], [9, 9, 9], [9, 9, 9]];
        let size = Size { width: 3, height: 2 };
        let image = packed(size, &pixels, 256).unwrap_or_else(|problem| panic!("{problem}"));
        let palette = &[[1, 2, 3], [9, 9, 9], [200, 0, 0]];
        let texels = Texels::Indexed { bits: 2, palette };
        assert_eq!(image, Image::new(3, 2, texels, &[0b0001_0000, 0b1001_0100]));
    }

    #[test]
    fn many_colours_become_few() {
        let pixels: Vec<[u8; 3]> =
            (0..4096u32).map(|i| [i as u8, (i >> 4) as u8, (i * 7) as u8]).collect();
        let size = Size { width: 64, height: 64 };
        for most in [LEAST_COLORS, 64, MOST_COLORS] {
            assert!(packed(size, &pixels, most).is_ok());
        }
    }
}

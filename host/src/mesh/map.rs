//! Pictures on meshes, by coordinates at their corners.

use whitted::scene::{Filter, Mapping, Pattern, TextureSpec, Wrap};

use crate::error::Problem;
use crate::flash;

/// As far as the core takes coordinates.
const FARTHEST: f64 = 7.999;

/// The picture in a file's bytes as a texture, and a word on it if there is one to be said.
pub(crate) fn texture(
    bytes: &[u8],
    filter: Filter,
    wrap: Wrap,
) -> Result<(TextureSpec<'static>, Option<String>), Problem> {
    let (image, note) = flash::of_mesh(bytes)?;
    let image = image.with_filter(filter).with_wrap(wrap);
    Ok((TextureSpec { mapping: Mapping::Uv, ..TextureSpec::of(Pattern::Image(image)) }, note))
}

/// The same points of a picture that is repeated, as near to it as a face's can be moved together;
/// none where that isn't near enough.
pub(crate) fn repeated(mut uvs: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    for axis in 0..2 {
        let low = uvs.iter().map(|uv| uv[axis]).fold(f64::INFINITY, f64::min).floor();
        if !(0.0..=1.0).contains(&low) && low.is_finite() {
            uvs.iter_mut().for_each(|uv| uv[axis] -= low);
        }
    }
    if uvs.as_flattened().iter().any(|x| x.abs() > FARTHEST) { Vec::new() } else { uvs }
}

/// The words on faces that a picture isn't on.
pub(crate) fn bare(count: usize) -> String {
    format!("{count} faces with a map have no texture coordinates, or repeat it too often")
}

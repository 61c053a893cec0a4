//! What only some scenes have, as a blob holds it: media, textures, area lights. Like materials they
//! are made anew on the chip, from plain numbers; the pixels of pictures, their palettes and the
//! corners of polygons stay where they lie.

use super::spec::{Reader, Writer};
use crate::math::Rgb;
use crate::scene::{
    Area, AreaLightSpec, Filter, Image, Mapping, Pattern, Texels, TextureSpec, Wrap,
};

/// Media in front of a surface and behind it: what [`Absorption`](crate::scene::Absorption) is made
/// from.
pub type AbsorptionSpec = [Rgb<f64>; 2];

/// Where a picture lies among the pictures' bytes, its palette first.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) at: u32,
    /// No earlier texture has the same.
    pub(super) is_first: bool,
}

pub(super) fn picture<'a>(texture: &TextureSpec<'a>) -> Option<Image<'a>> {
    match texture.pattern {
        Pattern::Image(image) => Some(image),
        _ => None,
    }
}

pub(super) fn palette<'a>(image: &Image<'a>) -> &'a [[u8; 3]] {
    match image.texels() {
        Texels::Indexed { palette, .. } => palette,
        Texels::Rgb565 => &[],
    }
}

/// Bytes of a picture, its palette among them.
pub(super) fn bytes(image: &Image<'_>) -> usize {
    palette(image).len().wrapping_mul(3).wrapping_add(image.bytes().len())
}

/// Where the picture of this texture lies: pictures that several show are there once.
pub(super) fn place(textures: &[TextureSpec<'_>], index: usize) -> Place {
    let same = |a: &Image<'_>, b: &Image<'_>| {
        core::ptr::eq(a.bytes(), b.bytes()) && core::ptr::eq(palette(a), palette(b))
    };
    let wanted = textures.get(index).and_then(picture);
    let mut at = 0usize;
    for (i, texture) in textures.iter().enumerate() {
        let (Some(image), Some(wanted)) = (picture(texture), &wanted) else { continue };
        let earlier = textures.iter().take(i).filter_map(picture).any(|e| same(&e, &image));
        if i == index && !earlier {
            break;
        }
        if same(&image, wanted) {
            return Place { at: at as u32, is_first: false };
        }
        if !earlier {
            at = at.wrapping_add(bytes(&image));
        }
    }
    Place { at: at as u32, is_first: true }
}

pub(super) fn write_absorption(spec: &AbsorptionSpec, to: &mut Writer<'_>) {
    spec.iter().for_each(|rates| to.numbers(rates));
}

pub(super) fn read_absorption(from: &mut Reader<'_>) -> Option<AbsorptionSpec> {
    Some([from.numbers()?, from.numbers()?])
}

fn write_wrap(wrap: Wrap, to: &mut Writer<'_>) {
    to.byte(match wrap {
        Wrap::Repeat => 0,
        Wrap::Clamp => 1,
    });
}

fn read_wrap(from: &mut Reader<'_>) -> Option<Wrap> {
    Some(if from.switch()? { Wrap::Clamp } else { Wrap::Repeat })
}

pub(super) fn write_texture(spec: &TextureSpec<'_>, at: u32, to: &mut Writer<'_>) {
    let TextureSpec { pattern, mapping, origin, right, up, size, colors, other, height } = spec;
    match pattern {
        Pattern::Checker => to.byte(0),
        Pattern::Stripes { width } => {
            to.byte(1);
            to.number(*width);
        }
        Pattern::Gradient { wrap } => {
            to.byte(2);
            write_wrap(*wrap, to);
        }
        Pattern::Noise { octaves } => {
            to.byte(3);
            to.byte(*octaves);
        }
        Pattern::Marble { octaves, turbulence } => {
            to.byte(4);
            to.byte(*octaves);
            to.number(*turbulence);
        }
        Pattern::Wood { octaves, turbulence } => {
            to.byte(5);
            to.byte(*octaves);
            to.number(*turbulence);
        }
        Pattern::Brick { mortar } => {
            to.byte(6);
            to.number(*mortar);
        }
        Pattern::Image(image) => {
            to.byte(7);
            let (width, height) = image.size();
            to.whole(width);
            to.whole(height);
            to.byte(match image.texels() {
                Texels::Indexed { bits, .. } => bits,
                Texels::Rgb565 => 16,
            });
            to.byte((image.filter() == Filter::Bilinear).into());
            write_wrap(image.wrap(), to);
            to.whole(palette(image).len() as u16);
            to.long(at);
            to.long(image.bytes().len() as u32);
        }
    }
    to.byte(match mapping {
        Mapping::Planar => 0,
        Mapping::Spherical => 1,
        Mapping::Cylindrical => 2,
        Mapping::Uv => 3,
    });
    [origin, right, up, size].into_iter().for_each(|v| to.numbers(v));
    colors.iter().for_each(|color| to.numbers(color));
    to.maybe(*other);
    to.number(*height);
}

/// `pictures` are the bytes of all pictures.
pub(super) fn read_texture<'b>(
    from: &mut Reader<'_>,
    pictures: &'b [u8],
) -> Option<TextureSpec<'b>> {
    let pattern = match from.byte()? {
        0 => Pattern::Checker,
        1 => Pattern::Stripes { width: from.number()? },
        2 => Pattern::Gradient { wrap: read_wrap(from)? },
        3 => Pattern::Noise { octaves: from.byte()? },
        4 => Pattern::Marble { octaves: from.byte()?, turbulence: from.number()? },
        5 => Pattern::Wood { octaves: from.byte()?, turbulence: from.number()? },
        6 => Pattern::Brick { mortar: from.number()? },
        7 => Pattern::Image(read_image(from, pictures)?),
        _ => return None,
    };
    let mapping = match from.byte()? {
        0 => Mapping::Planar,
        1 => Mapping::Spherical,
        2 => Mapping::Cylindrical,
        3 => Mapping::Uv,
        _ => return None,
    };
    Some(TextureSpec {
        pattern,
        mapping,
        origin: from.numbers()?,
        right: from.numbers()?,
        up: from.numbers()?,
        size: from.numbers()?,
        colors: [from.numbers()?, from.numbers()?],
        other: from.maybe()?,
        height: from.number()?,
    })
}

fn read_image<'b>(from: &mut Reader<'_>, pictures: &'b [u8]) -> Option<Image<'b>> {
    let (width, height, bits) = (from.whole()?, from.whole()?, from.byte()?);
    let filter = if from.switch()? { Filter::Bilinear } else { Filter::Nearest };
    let wrap = read_wrap(from)?;
    let colors = usize::from(from.whole()?);
    let (at, length) = (from.long()?, from.long()?);
    let rest = pictures.get(at as usize..)?;
    let (palette, rest) = rest.split_at_checked(colors.wrapping_mul(3))?;
    let bytes = rest.get(..length as usize)?;
    let texels = match bits {
        16 if colors == 0 => Texels::Rgb565,
        16 => return None,
        // Other numbers of bits than there are have an error below.
        bits => Texels::Indexed { bits, palette: palette.as_chunks::<3>().0 },
    };
    let image = Image::try_new(width, height, texels, bytes).ok()?;
    Some(image.with_filter(filter).with_wrap(wrap))
}

pub(super) fn write_area_light(spec: &AreaLightSpec<'_>, to: &mut Writer<'_>) {
    let AreaLightSpec { area, radiance, error, samples, body } = spec;
    match area {
        Area::Rectangle { corner, u, v } => {
            to.byte(0);
            [corner, u, v].into_iter().for_each(|v| to.numbers(v));
        }
        Area::Triangle { corners } => {
            to.byte(1);
            corners.iter().for_each(|v| to.numbers(v));
        }
        Area::Polygon { corners, .. } => {
            to.byte(2);
            to.whole(corners.len() as u16);
        }
        Area::Disc { center, normal, radius } => {
            to.byte(3);
            to.numbers(center);
            to.numbers(normal);
            to.number(*radius);
        }
        Area::Sphere { center, radius } => {
            to.byte(4);
            to.numbers(center);
            to.number(*radius);
        }
    }
    to.numbers(radiance);
    to.number(*error);
    samples.iter().for_each(|&n| to.whole(n));
    to.byte(body.is_some().into());
    if let Some(body) = body {
        to.long(*body);
    }
}

/// `corners` are those of the polygons from this light on; `first` is where the next fan starts.
pub(super) fn read_area_light<'b>(
    from: &mut Reader<'_>,
    corners: &mut &'b [[f64; 3]],
    first: &mut u32,
) -> Option<AreaLightSpec<'b>> {
    let area = match from.byte()? {
        0 => Area::Rectangle { corner: from.numbers()?, u: from.numbers()?, v: from.numbers()? },
        1 => Area::Triangle { corners: [from.numbers()?, from.numbers()?, from.numbers()?] },
        2 => {
            let (own, rest) = corners.split_at_checked(usize::from(from.whole()?))?;
            *corners = rest;
            let fan = *first;
            *first = first.wrapping_add((own.len() as u32).checked_sub(1)?);
            Area::Polygon { corners: own, first: fan }
        }
        3 => {
            Area::Disc { center: from.numbers()?, normal: from.numbers()?, radius: from.number()? }
        }
        4 => Area::Sphere { center: from.numbers()?, radius: from.number()? },
        _ => return None,
    };
    Some(AreaLightSpec {
        area,
        radiance: from.numbers()?,
        error: from.number()?,
        samples: [from.whole()?, from.whole()?],
        body: if from.switch()? { Some(from.long()?) } else { None },
    })
}

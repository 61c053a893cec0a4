//! Materials as Rust source, and what they name: textures, their pictures, media.

use std::fmt::{self, Write as _};

use whitted::scene::{Image, MaterialSpec, Pattern, PatternSpec, Shadow, Texels, TextureSpec};

use super::write_list;
use crate::bake::specs;
use crate::document::{self, Document};

/// Writes the lists of materials, textures and media of a document that has been placed; gives the
/// fields of `Parts` with what stands in them.
pub(super) fn write(
    to: &mut String,
    document: &Document,
) -> Result<Vec<(&'static str, String)>, fmt::Error> {
    let (mut materials, mut absorptions) = (Vec::new(), Vec::new());
    let mut textures = Textures::default();
    for m in &document.materials {
        // The baker has refused what isn't.
        let Ok(mut spec) = specs::material(m) else { continue };
        spec.texture = textures.add(to, m.texture.as_ref())?;
        spec.bump = textures.add(to, m.bump.as_ref())?;
        if m.absorbs() {
            spec.absorption = u16::try_from(absorptions.len()).ok();
            let [front, behind] = m.absorption;
            absorptions
                .push(format!("whitted::scene::Absorption::<A>::new({front:?}, {behind:?})"));
        }
        materials.push(material(&spec));
    }
    let lists = [
        ("textures", "Texture<'static, A>", textures.all),
        ("absorptions", "Absorption<A>", absorptions),
    ];
    let mut written = vec![("materials", "&MATERIALS".to_string())];
    for (field, kind, values) in lists {
        if !values.is_empty() {
            let name = field.to_uppercase();
            write_list(to, &name, &format!("whitted::scene::{kind}"), &values)?;
            written.push((field, format!("&{name}")));
        }
    }
    write_list(to, "MATERIALS", "whitted::scene::Material<A>", &materials)?;
    Ok(written)
}

/// Textures as they are written, and the pictures that have been.
#[derive(Default)]
struct Textures {
    all: Vec<String>,
    /// The palettes' and the pixels' bytes: pictures of one file share them.
    pictures: Vec<(&'static [[u8; 3]], &'static [u8])>,
}

impl Textures {
    /// The index of a texture, whose picture is written.
    fn add(
        &mut self,
        to: &mut String,
        texture: Option<&document::Texture>,
    ) -> Result<Option<u16>, fmt::Error> {
        let Some(texture) = texture else { return Ok(None) };
        let TextureSpec { pattern, mapping, origin, right, up, size, colors, height, other: _ } =
            texture.spec;
        let pattern = self.pattern(to, pattern)?;
        let index = u16::try_from(self.all.len()).ok();
        self.all.push(format!(
            "whitted::scene::Texture::<A>::new(whitted::scene::TextureSpec {{ \
             pattern: whitted::scene::Pattern::{pattern}, \
             mapping: whitted::scene::Mapping::{mapping:?}, origin: {origin:?}, \
             right: {right:?}, up: {up:?}, size: {size:?}, colors: {colors:?}, \
             other: {:?}, height: {height:?} }})",
            texture.other
        ));
        Ok(index)
    }

    fn pattern(
        &mut self,
        to: &mut String,
        pattern: Pattern<'static>,
    ) -> Result<String, fmt::Error> {
        Ok(match pattern {
            Pattern::Image(image) => {
                let image = self.image(to, &image)?;
                format!("Image({image})")
            }
            Pattern::Gradient { wrap } => {
                format!("Gradient {{ wrap: whitted::scene::Wrap::{wrap:?} }}")
            }
            // What the others derive as `Debug` is their source.
            Pattern::Checker
            | Pattern::Stripes { .. }
            | Pattern::Noise { .. }
            | Pattern::Marble { .. }
            | Pattern::Wood { .. }
            | Pattern::Brick { .. } => format!("{pattern:?}"),
        })
    }

    fn image(&mut self, to: &mut String, image: &Image<'static>) -> Result<String, fmt::Error> {
        let (bytes, (width, height)) = (image.bytes(), image.size());
        let palette = match image.texels() {
            Texels::Indexed { palette, .. } => palette,
            Texels::Rgb565 => &[],
        };
        let known = self.pictures.iter();
        let mut known = known.map(|(p, b)| std::ptr::eq(*p, palette) && std::ptr::eq(*b, bytes));
        let n = known.position(|same| same).unwrap_or(self.pictures.len());
        if n == self.pictures.len() {
            self.pictures.push((palette, bytes));
            if !palette.is_empty() {
                let colors: Vec<String> = palette.iter().map(|c| format!("{c:?}")).collect();
                write_list(to, &format!("PALETTE_{n}"), "[u8; 3]", &colors)?;
            }
            let rows = bytes.chunks(32).map(|row| {
                let row: Vec<String> = row.iter().map(u8::to_string).collect();
                row.join(", ")
            });
            writeln!(to, "#[rustfmt::skip]\nstatic PIXELS_{n}: [u8; {}] = [", bytes.len())?;
            for row in rows {
                writeln!(to, "    {row},")?;
            }
            writeln!(to, "];\n")?;
        }
        let texels = match image.texels() {
            Texels::Indexed { bits, .. } => {
                format!("Indexed {{ bits: {bits}, palette: &PALETTE_{n} }}")
            }
            Texels::Rgb565 => "Rgb565".into(),
        };
        Ok(format!(
            "whitted::scene::Image::new({width}, {height}, whitted::scene::Texels::{texels}, \
             &PIXELS_{n}).with_filter(whitted::scene::Filter::{:?})\
             .with_wrap(whitted::scene::Wrap::{:?})",
            image.filter(),
            image.wrap()
        ))
    }
}

fn material(spec: &MaterialSpec) -> String {
    let MaterialSpec {
        ambient,
        diffuse,
        specular,
        shininess,
        reflection,
        transmission,
        index_front,
        index_behind,
        emission,
        shadow,
        pattern,
        fresnel,
        texture,
        bump,
        absorption,
    } = spec;
    let shadow = match shadow {
        Shadow::Opaque => "Opaque",
        Shadow::Filtered => "Filtered",
        Shadow::None => "None",
    };
    let pattern = match pattern {
        None => "None".to_string(),
        Some(PatternSpec { cell, offset, other }) => format!(
            "Some(whitted::scene::PatternSpec {{ cell: {cell:?}, offset: {offset:?}, other: {other} }})"
        ),
    };
    format!(
        "whitted::scene::Material::<A>::new(whitted::scene::MaterialSpec {{ ambient: {ambient:?}, \
         diffuse: {diffuse:?}, specular: {specular:?}, shininess: {shininess:?}, \
         reflection: {reflection:?}, transmission: {transmission:?}, \
         index_front: {index_front:?}, index_behind: {index_behind:?}, emission: {emission:?}, \
         shadow: whitted::scene::Shadow::{shadow}, pattern: {pattern}, \
         fresnel: {fresnel}, texture: {texture:?}, bump: {bump:?}, absorption: {absorption:?} }})"
    )
}

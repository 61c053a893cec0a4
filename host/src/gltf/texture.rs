//! The picture of a material's base colour: a file beside the scene's, or bytes within it.
//!
//! A picture that can't be read leaves the material its colour, with a warning; a number that names
//! nothing is an error, as everywhere.

use std::path::PathBuf;

use gltf_json::Root;
use gltf_json::material::Material;
use gltf_json::texture::{MagFilter, Sampler, WrappingMode};
use gltf_json::validation::Checked;
use whitted::scene::{Filter, Wrap};

use super::accessor::{Data, of_uri};
use super::{Noticed, indexed};
use crate::document::Texture;
use crate::error::Problem;
use crate::mesh;
use crate::read::Around;

/// A picture, and the number of the coordinates that place it.
pub(super) struct Map {
    pub(super) texture: Texture,
    pub(super) set: u32,
}

pub(super) fn base_color(
    (root, data, around): (&Root, &Data<'_>, &Around),
    material: &Material,
    place: &str,
    noticed: &mut Noticed,
) -> Result<Option<Map>, Problem> {
    let Some(info) = &material.pbr_metallic_roughness.base_color_texture else { return Ok(None) };
    let place = format!("{place}.pbrMetallicRoughness.baseColorTexture");
    let texture = indexed(&root.textures, info.index, &place, "textures")?;
    let texture_place = format!("textures[{}]", info.index.value());
    let image = indexed(&root.images, texture.source, &texture_place, "images")?;
    let image_place = format!("images[{}]", texture.source.value());
    let plain = Sampler::default();
    let sampler = match texture.sampler {
        Some(index) => indexed(&root.samplers, index, &texture_place, "samplers")?,
        None => &plain,
    };
    let filter = match sampler.mag_filter {
        Some(Checked::Valid(MagFilter::Nearest)) => Filter::Nearest,
        _ => Filter::Bilinear,
    };
    let wraps = [sampler.wrap_s, sampler.wrap_t];
    let all = |mode| wraps.iter().all(|wrap| *wrap == Checked::Valid(mode));
    let wrap = if all(WrappingMode::ClampToEdge) { Wrap::Clamp } else { Wrap::Repeat };
    if wrap == Wrap::Repeat && !all(WrappingMode::Repeat) {
        noticed.leave_out("pictures repeated mirrored, or along one side alone", &texture_place);
    }
    let (mut file, uri): (Option<PathBuf>, _) = (None, &image.uri);
    let read = match (uri, image.buffer_view) {
        (_, Some(view)) => data.image(view, &image_place).map(<[u8]>::to_vec)?,
        (Some(uri), None) => {
            if !uri.starts_with("data:") {
                file = Some(around.file_beside(&uri.replace("%20", " ")));
            }
            match of_uri(uri, &image_place, around) {
                Ok(bytes) => bytes,
                Err(problem) => {
                    noticed.say(without(&image_place, &problem));
                    return Ok(None);
                }
            }
        }
        (None, None) => {
            return Err(Problem::Missing { what: format!("{image_place}.uri or bufferView") });
        }
    };
    match mesh::texture(&read, filter, wrap) {
        Ok((spec, note)) => {
            if let Some(note) = note {
                noticed.say(format!("{image_place}: {note}"));
            }
            Ok(Some(Map {
                texture: Texture { spec, other: None, file, line: 0 },
                set: info.tex_coord,
            }))
        }
        Err(problem) => {
            noticed.say(without(&image_place, &problem));
            Ok(None)
        }
    }
}

fn without(place: &str, problem: &Problem) -> String {
    format!("{place}: {problem}; the material's colour alone instead")
}

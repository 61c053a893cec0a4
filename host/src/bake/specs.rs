//! What the core's materials, lights and surroundings are made from.

use whitted::blob::{BackgroundSpec, CameraSpec, SelectionSpec, SettingSpec};
use whitted::scene::{Falloff, LightSpec, MaterialSpec, PatternSpec, Shadow, TextureSpec};
use whitted::shape::ShapeError;

use crate::document::{self, Document, LightKind, LightSelection, ShadowThrough, Size};

/// A material; its error is an index that the core can't hold.
pub(super) fn material(m: &document::Material) -> Result<MaterialSpec, ShapeError> {
    let pattern = match &m.checker {
        None => None,
        Some(checker) => Some(PatternSpec {
            cell: checker.cell,
            offset: checker.offset,
            other: u16::try_from(checker.other).map_err(|_| ShapeError::Material)?,
        }),
    };
    Ok(MaterialSpec {
        ambient: m.ambient,
        diffuse: m.diffuse,
        specular: m.specular,
        shininess: m.shininess,
        reflection: m.reflection,
        transmission: m.transmission,
        index_front: m.index_front,
        index_behind: m.index_behind,
        emission: m.emission,
        shadow: match m.shadow {
            ShadowThrough::Opaque => Shadow::Opaque,
            ShadowThrough::Filtered => Shadow::Filtered,
            ShadowThrough::None => Shadow::None,
        },
        pattern,
        fresnel: m.fresnel,
        // Media and textures lie elsewhere, in lists that `materials` numbers.
        ..MaterialSpec::BLACK
    })
}

/// All materials, which name textures, bumps and media by their places in lists where each
/// material's follow those of the one before, its bump after its texture.
pub(super) fn materials(document: &Document) -> Result<Vec<MaterialSpec>, ShapeError> {
    let (mut textures, mut absorptions) = (0u16, 0u16);
    let next = |wanted: bool, count: &mut u16| {
        wanted.then(|| {
            let index = *count;
            *count = count.saturating_add(1);
            index
        })
    };
    let each = |m: &document::Material| {
        Ok(MaterialSpec {
            texture: next(m.texture.is_some(), &mut textures),
            bump: next(m.bump.is_some(), &mut textures),
            absorption: next(m.absorbs(), &mut absorptions),
            ..material(m)?
        })
    };
    document.materials.iter().map(each).collect()
}

/// The textures that they name.
pub(super) fn textures(document: &Document) -> Result<Vec<TextureSpec<'static>>, ShapeError> {
    let all = document.materials.iter().flat_map(|m| [&m.texture, &m.bump]).flatten();
    let each = |texture: &document::Texture| {
        let other = texture.other.map(u16::try_from).transpose();
        let other = other.map_err(|_| ShapeError::Material)?;
        Ok(TextureSpec { other, ..texture.spec })
    };
    all.map(each).collect()
}

/// A light that is a point or far away; `None` for one with an area.
pub(super) fn light(light: &document::Light) -> Option<LightSpec> {
    let weakens = |falloff| match falloff {
        document::Falloff::None => Falloff::None,
        document::Falloff::InverseSquare => Falloff::InverseSquare,
    };
    let intensity = light.color;
    Some(match light.kind {
        LightKind::Area { .. } => return None,
        LightKind::Point { position, falloff } => {
            LightSpec::Point { position, intensity, falloff: weakens(falloff) }
        }
        LightKind::Directional { direction } => LightSpec::Directional { direction, intensity },
        LightKind::Spot { position, direction, inner, outer, falloff } => LightSpec::Spot {
            position,
            direction,
            intensity,
            falloff: weakens(falloff),
            cos_inner: inner.to_radians().cos(),
            cos_outer: outer.to_radians().cos(),
        },
    })
}

pub(super) fn camera(camera: &document::Camera, size: Size) -> CameraSpec {
    let tangent = (camera.edge_angle(size).to_radians() / 2.0).tan();
    CameraSpec { eye: camera.eye, at: camera.look_at, up: camera.up, tangent }
}

/// Rules, camera and surroundings of a document that has been placed, for pictures of a size.
pub(super) fn setting(document: &Document, size: Size) -> SettingSpec {
    let rules = &document.rules;
    SettingSpec {
        camera: camera(&document.camera, size),
        ambient: document.ambient,
        background: match document.background {
            document::Background::Color(color) => BackgroundSpec::Uniform(color),
            document::Background::Gradient { bottom, top, up } => {
                BackgroundSpec::Gradient { up, bottom, top }
            }
        },
        specular_cosine: rules.specular_cosine,
        highlight_cosine: rules.highlight_cosine,
        transmitters_reflect: rules.transmitters_reflect,
        lossy: rules.lossy_total_reflection,
        cutoff: rules.cutoff,
        depth: rules.depth,
        selection: match rules.lights {
            LightSelection::All => SelectionSpec::All,
            LightSelection::Choose(count) => SelectionSpec::Choose(count),
            LightSelection::Threshold(radiance) => SelectionSpec::Above(radiance),
        },
        light_jitter: rules.light_jitter,
    }
}

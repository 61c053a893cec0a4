//! What the core's materials, lights and surroundings are made from.

use whitted::blob::{BackgroundSpec, CameraSpec, SettingSpec};
use whitted::scene::{Falloff, LightSpec, MaterialSpec, PatternSpec, Shadow};
use whitted::shape::ShapeError;

use crate::document::{self, Document, LightKind, ShadowThrough, Size};

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
        // Media lie elsewhere, in lists that the caller numbers; baked forms refuse textures.
        ..MaterialSpec::BLACK
    })
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
    }
}

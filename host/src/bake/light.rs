//! Lights, those with an area apart from the others.

use whitted::scene::{self, AreaLight, AreaLightSpec, Falloff, FanCorner, Light, LightSpec};

use super::shapes::Shapes;
use super::{Construct, refused};
use crate::document::{self, Area, Document, LightKind};
use crate::error::Flaw;

/// The lights of a scene as the core wants them.
#[derive(Debug)]
pub(super) struct Lights<A: Construct> {
    pub(super) points: Vec<Light<A>>,
    pub(super) areas: Vec<AreaLight<A>>,
    /// The fans of those that are polygons.
    pub(super) corners: Vec<FanCorner<A>>,
}

impl<A: Construct> Lights<A> {
    /// Makes all lights of a document that has been placed, whose shapes have their numbers;
    /// `bodies` has the indices of those that show lights.
    pub(super) fn new(
        document: &Document,
        shapes: &Shapes<A>,
        bodies: &[Option<usize>],
    ) -> Result<Self, Flaw> {
        let mut lights = Self { points: Vec::new(), areas: Vec::new(), corners: Vec::new() };
        for (index, light) in document.lights.iter().enumerate() {
            let body = bodies.get(index).copied().flatten();
            let body = body.and_then(|index| shapes.number(index));
            lights.add(light, body).map_err(|flaw| flaw.within(document.file_of_light(index)))?;
        }
        Ok(lights)
    }

    fn add(&mut self, light: &document::Light, body: Option<u32>) -> Result<(), Flaw> {
        let LightKind::Area { area, error, samples, .. } = &light.kind else {
            self.points.extend(point(light)?);
            return Ok(());
        };
        let refuse = |error| refused::<A>("the light", error, Some(light.line));
        let first = self.corners.len() as u32;
        if let Area::Polygon { corners } = area {
            let fan = (0..corners.len() - 1).map(|i| A::new_fan_corner(corners, i));
            self.corners.extend(fan.collect::<Result<Vec<_>, _>>().map_err(refuse)?);
        }
        let spec = AreaLightSpec {
            area: of(area, first),
            radiance: light.color,
            error: *error,
            samples: *samples,
            body,
        };
        self.areas.push(A::new_area_light(&spec).map_err(refuse)?);
        Ok(())
    }
}

/// What the area lights are made from; `bodies` are the shapes that show them.
pub(super) fn specs(
    lights: &[document::Light],
    mut bodies: impl Iterator<Item = Option<u32>>,
) -> Vec<AreaLightSpec<'_>> {
    let mut first = 0;
    let mut all = Vec::new();
    for light in lights {
        let LightKind::Area { area, error, samples, .. } = &light.kind else { continue };
        all.push(AreaLightSpec {
            area: of(area, first),
            radiance: light.color,
            error: *error,
            samples: *samples,
            body: bodies.next().flatten(),
        });
        if let Area::Polygon { corners } = area {
            first += corners.len().saturating_sub(1) as u32;
        }
    }
    all
}

fn of(area: &Area, first: u32) -> scene::Area<'_> {
    match area {
        Area::Rectangle { corner, edges: [u, v] } => {
            scene::Area::Rectangle { corner: *corner, u: *u, v: *v }
        }
        Area::Triangle { corners } => scene::Area::Triangle { corners: *corners },
        Area::Polygon { corners } => scene::Area::Polygon { corners, first },
        Area::Disc { center, normal, radius } => {
            scene::Area::Disc { center: *center, normal: *normal, radius: *radius }
        }
        Area::Sphere { center, radius } => scene::Area::Sphere { center: *center, radius: *radius },
    }
}

fn point<A: Construct>(light: &document::Light) -> Result<Option<Light<A>>, Flaw> {
    let weakens = |falloff| match falloff {
        document::Falloff::None => Falloff::None,
        document::Falloff::InverseSquare => Falloff::InverseSquare,
    };
    let intensity = light.color;
    let spec = match light.kind {
        LightKind::Point { position, falloff } => {
            LightSpec::Point { position, intensity, falloff: weakens(falloff) }
        }
        LightKind::Area { .. } => return Ok(None),
        LightKind::Directional { direction } => LightSpec::Directional { direction, intensity },
        LightKind::Spot { position, direction, inner, outer, falloff } => LightSpec::Spot {
            position,
            direction,
            intensity,
            falloff: weakens(falloff),
            cos_inner: inner.to_radians().cos(),
            cos_outer: outer.to_radians().cos(),
        },
    };
    A::new_light(&spec)
        .map(Some)
        .map_err(|error| refused::<A>("the light", error, Some(light.line)))
}

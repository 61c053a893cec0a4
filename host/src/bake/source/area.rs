//! Lights with an area as Rust source.

use std::fmt::{self, Write as _};

use whitted::scene::AreaLight;

use super::write_list;
use crate::bake::Construct;
use crate::document::{Area, Light, LightKind};

/// Writes the lists of area lights, if there are any, and of the fans of those that are polygons.
/// `made` are the same lights as the core has them, which know the shapes that show them.
pub(super) fn write<A: Construct>(
    to: &mut String,
    lights: &[Light],
    made: &[AreaLight<A>],
) -> fmt::Result {
    let (mut areas, mut fans) = (Vec::new(), Vec::new());
    let mut made = made.iter();
    for light in lights {
        let LightKind::Area { area, error, samples, .. } = &light.kind else { continue };
        let body = made.next().and_then(AreaLight::body);
        let area = match area {
            Area::Rectangle { corner, edges: [u, v] } => {
                format!("Rectangle {{ corner: {corner:?}, u: {u:?}, v: {v:?} }}")
            }
            Area::Triangle { corners } => format!("Triangle {{ corners: {corners:?} }}"),
            Area::Polygon { corners } => {
                let (n, first, count) = (areas.len(), fans.len(), corners.len());
                let fan = count.saturating_sub(1);
                write!(
                    to,
                    "const LIGHT_{n}: [[f64; 3]; {count}] = {corners:?};\n\
                     const FAN_{n}: [whitted::scene::FanCorner<A>; {fan}] =\n    \
                     whitted::scene::AreaLight::<A>::fan(&LIGHT_{n});\n"
                )?;
                fans.extend((0..fan).map(|i| format!("FAN_{n}[{i}]")));
                format!("Polygon {{ corners: &LIGHT_{n}, first: {first} }}")
            }
            Area::Disc { center, normal, radius } => {
                format!("Disc {{ center: {center:?}, normal: {normal:?}, radius: {radius:?} }}")
            }
            Area::Sphere { center, radius } => {
                format!("Sphere {{ center: {center:?}, radius: {radius:?} }}")
            }
        };
        areas.push(format!(
            "whitted::scene::AreaLight::<A>::new(whitted::scene::AreaLightSpec {{ \
             area: whitted::scene::Area::{area}, radiance: {:?}, error: {error:?}, \
             samples: {samples:?}, body: {body:?} }})",
            light.color
        ));
    }
    if !areas.is_empty() {
        write_list(to, "AREA_LIGHTS", "whitted::scene::AreaLight<A>", &areas)?;
    }
    if !fans.is_empty() {
        write_list(to, "LIGHT_CORNERS", "whitted::scene::FanCorner<A>", &fans)?;
    }
    Ok(())
}

//! A document in POV-Ray's language, to compare pictures with.
//!
//! POV-Ray lets light through whatever transmits. Where a material says that it blocks light, the
//! shape lets all of it through instead, and a twin that only shadow rays see blocks it.
//!
//! What POV-Ray has no words for, and so differs: a surface that is both coloured and transmits
//! has one coefficient of transmission for all channels (the mean is written); a highlight has
//! the mean of its channels; neither a specular cosine nor a highlight's cosine; no shape that
//! shows its inside alone; at total reflection the ray carries the transmission alone. The
//! weakening of lights is POV-Ray's own formula, with a fade distance so small that it is 1/r² to
//! four digits.

use std::fmt::{self, Write as _};

use crate::document::{
    Background, Body, Camera, Checker, Document, Falloff, Light, LightKind, Made, Material, Point,
    ShadowThrough, Shape, Size, Solid, cross, dot, length, normalized, scaled, sub,
};

/// The scene for pictures of a size, whose proportions the camera has.
pub fn to_pov(document: &Document, size: Size) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    let _ = write(document, size, &mut text);
    text
}

/// A vector in POV-Ray's notation.
struct V(Point);

impl fmt::Display for V {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0;
        write!(f, "<{x}, {y}, {z}>")
    }
}

fn write(document: &Document, size: Size, out: &mut String) -> fmt::Result {
    let rules = &document.rules;
    writeln!(out, "#version 3.7;")?;
    writeln!(
        out,
        "global_settings {{ assumed_gamma 1.0 max_trace_level {} adc_bailout {} ambient_light 1 }}",
        rules.depth, rules.cutoff
    )?;
    camera(&document.camera, size, out)?;
    match &document.background {
        Background::Color(color) => writeln!(out, "background {{ rgb {} }}", V(*color))?,
        Background::Gradient { bottom, top, up } => {
            let up = normalized(*up).unwrap_or([0.0, 1.0, 0.0]);
            writeln!(
                out,
                "sky_sphere {{ pigment {{ gradient {} color_map {{ [0 rgb {}] [1 rgb {}] }} \
                 scale 2 translate {} }} }}",
                V(up),
                V(*bottom),
                V(*top),
                V(scaled(up, -1.0))
            )?;
        }
    }
    for light_source in &document.lights {
        light(light_source, document, out)?;
    }
    for index in 0..document.materials.len() {
        let flat = format!("F{index}");
        writeln!(out, "#declare {flat} = {}", texture(document, index))?;
        if document.materials[index].checker.is_none() {
            writeln!(out, "#declare T{index} = texture {{ {flat} }}")?;
        }
    }
    for (index, material) in document.materials.iter().enumerate() {
        if let Some(checker) = &material.checker {
            writeln!(out, "#declare T{index} = {}", pattern(index, checker))?;
        }
    }
    shapes(&document.shapes, None, document, out)?;
    for instance in &document.instances {
        let Some(group) = document.groups.get(instance.group) else { continue };
        writeln!(out, "union {{")?;
        shapes(&group.shapes, instance.material, document, out)?;
        let [x, y, z] = instance.place.columns;
        let rows = [x, y, z, instance.place.offset].map(|v| v.map(|x| x.to_string()).join(", "));
        writeln!(out, "matrix <{}> }}", rows.join(", "))?;
    }
    Ok(())
}

/// Shapes with their textures, or all with that of one material.
fn shapes(
    shapes: &[Shape],
    instead: Option<usize>,
    document: &Document,
    out: &mut String,
) -> fmt::Result {
    for shape in shapes {
        let index = instead.unwrap_or(shape.material);
        let Some(material) = document.materials.get(index) else { continue };
        body(&shape.body, out)?;
        let ior = material.index_behind / material.index_front;
        let shadow = material.shadow;
        let twin = shadow == ShadowThrough::Opaque && material.transmits();
        let mark = if twin || shadow == ShadowThrough::None { " no_shadow" } else { "" };
        writeln!(out, " texture {{ T{index} }} interior {{ ior {ior} }}{mark} }}")?;
        if twin {
            body(&shape.body, out)?;
            writeln!(out, " pigment {{ rgb 0 }} hollow no_image no_reflection }}")?;
        }
    }
    Ok(())
}

/// By its vectors: handedness and angle conventions then don't matter.
fn camera(camera: &Camera, size: Size, out: &mut String) -> fmt::Result {
    let tangent = (camera.edge_angle(size).to_radians() / 2.0).tan();
    let forward = normalized(sub(camera.look_at, camera.eye)).unwrap_or([0.0, 0.0, 1.0]);
    let right = normalized(cross(forward, camera.up)).unwrap_or([1.0, 0.0, 0.0]);
    let up = cross(right, forward);
    let aspect = f64::from(size.width) / f64::from(size.height);
    writeln!(
        out,
        "camera {{ perspective location {} direction {} right {} up {} }}",
        V(camera.eye),
        V(forward),
        V(scaled(right, 2.0 * tangent * aspect)),
        V(scaled(up, 2.0 * tangent))
    )
}

fn light(light: &Light, document: &Document, out: &mut String) -> fmt::Result {
    // 2/(1 + (r/d)²) is POV-Ray's weakening; a small d makes it 2d²/r².
    let near = document.bounds().map_or(1.0, |b| b.side().max(1e-3)) * 1e-3;
    let (color, fade) = match light.falloff() {
        Falloff::None => (light.color, String::new()),
        Falloff::InverseSquare => (
            scaled(light.color, 0.5 / (near * near)),
            format!(" fade_distance {near} fade_power 2"),
        ),
    };
    match &light.kind {
        LightKind::Point { position, .. } => {
            writeln!(out, "light_source {{ {} rgb {}{fade} }}", V(*position), V(color))
        }
        LightKind::Directional { direction } => writeln!(
            out,
            "light_source {{ {} rgb {} parallel point_at <0, 0, 0> }}",
            V(scaled(*direction, -1e4 / length(*direction).max(1e-12))),
            V(color)
        ),
        LightKind::Spot { position, direction, inner, outer, .. } => writeln!(
            out,
            "light_source {{ {} rgb {}{fade} spotlight point_at {} radius {inner} falloff {outer} \
             tightness 0 }}",
            V(*position),
            V(color),
            V([0, 1, 2].map(|i| position[i] + direction[i]))
        ),
    }
}

/// The texture of a material, without its pattern.
fn texture(document: &Document, index: usize) -> String {
    let m: &Material = &document.materials[index];
    let mean = (m.transmission[0] + m.transmission[1] + m.transmission[2]) / 3.0;
    let largest = m.transmission.into_iter().fold(0.0, f64::max);
    let (color, through) = if m.diffuse == [0.0; 3] && largest > 0.0 {
        // A filter transmits in the pigment's colour, which nothing else needs here.
        (scaled(m.transmission, 1.0 / largest), format!("filter {largest}"))
    } else {
        // POV-Ray dims a surface's own colour by what it transmits; ours doesn't.
        (scaled(m.diffuse, 1.0 / (1.0 - mean).max(1e-3)), format!("transmit {mean}"))
    };
    let ambient = [0, 1, 2].map(|i| {
        let light = m.ambient[i] * document.ambient[i];
        if m.diffuse[i] > 0.0 { light / m.diffuse[i] } else { 0.0 }
    });
    let phong = (m.specular[0] + m.specular[1] + m.specular[2]) / 3.0;
    format!(
        "texture {{ pigment {{ rgb {} {through} }} finish {{ ambient rgb {} diffuse 1 \
         phong {phong} phong_size {} reflection {{ rgb {} }} }} }}",
        V(color),
        V(ambient),
        m.shininess,
        V(m.reflection)
    )
}

fn pattern(index: usize, checker: &Checker) -> String {
    // An axis that doesn't count gets one cell, with the scene in its middle.
    const ENDLESS: f64 = 1e7;
    let cell = checker.cell.map(|c| if c > 0.0 { c } else { ENDLESS });
    let shift =
        [0, 1, 2].map(|i| if checker.cell[i] > 0.0 { checker.offset[i] } else { -ENDLESS / 2.0 });
    format!(
        "texture {{ checker texture {{ F{index} }} texture {{ F{} }} scale {} translate {} }}",
        checker.other,
        V(cell),
        V(shift)
    )
}

/// The shape, its brace left open.
fn body(body: &Body, out: &mut String) -> fmt::Result {
    match body {
        Body::Sphere { center, radius } => {
            write!(out, "sphere {{ {}, {}", V(*center), radius.abs())
        }
        Body::Plane { point, normal } => {
            let n = normalized(*normal).unwrap_or([0.0, 1.0, 0.0]);
            write!(out, "plane {{ {}, {}", V(n), dot(n, *point))
        }
        Body::Disc { center, normal, radius } => {
            write!(out, "disc {{ {}, {}, {radius}", V(*center), V(*normal))
        }
        Body::Box { low, high } => write!(out, "box {{ {}, {}", V(*low), V(*high)),
        Body::Triangle { corners: [a, b, c] } => {
            write!(out, "triangle {{ {}, {}, {}", V(*a), V(*b), V(*c))
        }
        Body::SmoothTriangle { corners, normals } => {
            write!(out, "smooth_triangle {{ ")?;
            for (i, (p, n)) in corners.iter().zip(normals).enumerate() {
                write!(out, "{}{}, {}", if i > 0 { ", " } else { "" }, V(*p), V(*n))?;
            }
            Ok(())
        }
        Body::Polygon { corners } => {
            // The first corner closes the outline.
            write!(out, "polygon {{ {}", corners.len() + 1)?;
            corners.iter().chain(corners.first()).try_for_each(|c| write!(out, ", {}", V(*c)))
        }
        Body::Cylinder { base, apex, radius, capped } => {
            let open = if *capped { "" } else { " open" };
            write!(out, "cylinder {{ {}, {}, {}{open}", V(*base), V(*apex), radius.abs())
        }
        Body::Cone { base, base_radius, apex, apex_radius, capped } => {
            let (r, s) = (base_radius.abs(), apex_radius.abs());
            let open = if *capped { "" } else { " open" };
            write!(out, "cone {{ {}, {r}, {}, {s}{open}", V(*base), V(*apex))
        }
        Body::Solid(solid) => {
            write!(out, "union {{ ")?;
            made(solid, &solid.made, out)
        }
    }
}

/// What is made of a solid's operands, which have textures of their own.
fn made(solid: &Solid, what: &Made, out: &mut String) -> fmt::Result {
    let (word, parts) = match what {
        Made::Of(index) => {
            let Some(operand) = solid.operands.get(*index) else { return Ok(()) };
            match &operand.body {
                Body::Cylinder { base, apex, radius, .. } => body(
                    &Body::Cylinder { base: *base, apex: *apex, radius: *radius, capped: true },
                    out,
                )?,
                Body::Cone { base, base_radius, apex, apex_radius, .. } => body(
                    &Body::Cone {
                        base: *base,
                        base_radius: *base_radius,
                        apex: *apex,
                        apex_radius: *apex_radius,
                        capped: true,
                    },
                    out,
                )?,
                other => body(other, out)?,
            }
            return write!(out, " texture {{ T{} }} }} ", operand.material);
        }
        Made::Union(parts) => ("merge", parts),
        Made::Intersection(parts) => ("intersection", parts),
        Made::Difference(parts) => ("difference", parts),
    };
    write!(out, "{word} {{ ")?;
    parts.iter().try_for_each(|part| made(solid, part, out))?;
    write!(out, "}} ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::{Format, parse};

    #[test]
    fn every_shape_has_its_words() {
        let Ok(document) = parse(Format::Toml, include_bytes!("../scenes/shapes.toml")) else {
            panic!("our own scene is right")
        };
        let text = to_pov(&document, Size { width: 4, height: 3 });
        for word in [
            "sphere {",
            "plane {",
            "disc {",
            "box {",
            "triangle {",
            "smooth_triangle {",
            "cylinder {",
            "cone {",
            "parallel",
            "spotlight",
            "fade_power 2",
            "sky_sphere",
            "checker",
            "open",
        ] {
            assert!(text.contains(word), "{word}");
        }
        assert_eq!(text.matches('{').count(), text.matches('}').count());
    }
}

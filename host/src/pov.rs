//! A document in POV-Ray's language, to compare pictures with.
//!
//! POV-Ray lets light through whatever transmits. Where a material says that it blocks light, the
//! shape lets all of it through instead, and a twin that only shadow rays see blocks it.
//!
//! What POV-Ray has no words for, and so differs: a surface that is both coloured and transmits
//! has one coefficient of transmission for all channels (the mean is written); a highlight has
//! the mean of its channels; neither a specular cosine nor a highlight's cosine; no shape that
//! shows its inside alone; of textures it gets checkers, gradients and pictures, planar, in colours (the
//! others as the mean of their colours), no bumps, and no medium before a surface; at total reflection the ray carries the transmission alone. The
//! weakening of lights is POV-Ray's own formula, with a fade distance so small that it is 1/r² to
//! four digits.
//!
//! Area lights become `area_light`s of 8×8 points, a triangle or polygon a disc of its area; their
//! cosine is that of a spotlight towards their front (the angle to their middle); a body of theirs
//! casts no shadow.

use std::f64::consts::PI;
use std::fmt::{self, Write as _};

use whitted::scene::{Mapping, Pattern, TextureSpec, Wrap};

use crate::document::{
    Area, Background, Body, Camera, Checker, Document, Falloff, Light, LightKind, Made, Material,
    Point, ShadowThrough, Shape, Size, Solid, add, cross, dot, length, normalized, scaled, sub,
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
    let mut document = document.clone();
    let lit = document.embody();
    let document = &document;
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
    shapes(&document.shapes, None, &lit, document, out)?;
    for instance in &document.instances {
        let Some(group) = document.groups.get(instance.group) else { continue };
        writeln!(out, "union {{")?;
        shapes(&group.shapes, instance.material, &[], document, out)?;
        let [x, y, z] = instance.place.columns;
        let rows = [x, y, z, instance.place.offset].map(|v| v.map(|x| x.to_string()).join(", "));
        writeln!(out, "matrix <{}> }}", rows.join(", "))?;
    }
    Ok(())
}

/// Shapes with their textures, or all with that of one material; those that show lights are in `lit`.
fn shapes(
    shapes: &[Shape],
    instead: Option<usize>,
    lit: &[Option<usize>],
    document: &Document,
    out: &mut String,
) -> fmt::Result {
    for (number, shape) in shapes.iter().enumerate() {
        let index = instead.unwrap_or(shape.material);
        let Some(material) = document.materials.get(index) else { continue };
        body(&shape.body, out)?;
        let ior = material.index_behind / material.index_front;
        let shadow = material.shadow;
        let twin = shadow == ShadowThrough::Opaque && material.transmits();
        let lit = lit.contains(&Some(number));
        let mark = if twin || lit || shadow == ShadowThrough::None { " no_shadow" } else { "" };
        writeln!(
            out,
            " texture {{ T{index} }} interior {{ ior {ior}{} }}{mark} }}",
            fading(material)
        )?;
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
        LightKind::Area { area, .. } => area_light(area, color, &fade, out),
    }
}

fn area_light(area: &Area, color: Point, fade: &str, out: &mut String) -> fmt::Result {
    let doubled = |corners: &[Point]| {
        (2..corners.len()).fold([0.0; 3], |sum, i| {
            let (a, b) = (sub(corners[i - 1], corners[0]), sub(corners[i], corners[0]));
            add(sum, cross(a, b))
        })
    };
    let (normal, size) = match area {
        Area::Rectangle { edges: [u, v], .. } => (cross(*u, *v), length(cross(*u, *v))),
        Area::Triangle { corners } => (doubled(corners), length(doubled(corners)) / 2.0),
        Area::Polygon { corners } => (doubled(corners), length(doubled(corners)) / 2.0),
        Area::Disc { normal, radius, .. } => (*normal, PI * radius * radius),
        Area::Sphere { radius, .. } => ([0.0, 1.0, 0.0], PI * radius * radius),
    };
    let front = normalized(normal).unwrap_or([0.0, 1.0, 0.0]);
    let (u, v, round) = if let Area::Rectangle { edges: [u, v], .. } = area {
        (*u, *v, "")
    } else {
        let least = (0..3).min_by(|&a, &b| front[a].abs().total_cmp(&front[b].abs())).unwrap_or(0);
        let mut from = [0.0; 3];
        from[least] = 1.0;
        let u = normalized(cross(from, front)).unwrap_or([1.0, 0.0, 0.0]);
        let diameter = 2.0 * (size / PI).sqrt();
        let round =
            if matches!(area, Area::Sphere { .. }) { " circular orient" } else { " circular" };
        (scaled(u, diameter), scaled(cross(front, u), diameter), round)
    };
    let middle = area.center();
    let cosine = match area {
        Area::Sphere { .. } => String::new(),
        _ => {
            let at = V(add(middle, front)).to_string();
            format!(" spotlight point_at {at} radius 89.9 falloff 89.99 tightness 1")
        }
    };
    writeln!(
        out,
        "light_source {{ {} rgb {} area_light {}, {}, 8, 8{round}{fade}{cosine} }}",
        V(middle),
        V(scaled(color, size / PI)),
        V(u),
        V(v)
    )
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
    // The pigment's colour dims its emission too.
    let black = m.diffuse == [0.0; 3] && largest == 0.0;
    let color = if black { m.emission } else { color };
    let emission = [0, 1, 2].map(|i| if color[i] > 0.0 { m.emission[i] / color[i] } else { 0.0 });
    let diffuse = if black { 0 } else { 1 };
    let phong = (m.specular[0] + m.specular[1] + m.specular[2]) / 3.0;
    format!(
        "texture {{ pigment {{ {} }} finish {{ ambient rgb {} emission rgb {} \
         diffuse {diffuse} phong {phong} phong_size {} reflection {{ {} }} }} }}",
        pigment(m, color, &through),
        V(ambient),
        V(emission),
        m.shininess,
        if m.fresnel {
            format!("rgb 0, rgb {} fresnel on", V(m.reflection))
        } else {
            format!("rgb {}", V(m.reflection))
        }
    )
}

/// The colour of a surface, or its texture in that colour. What POV-Ray has otherwise or not at all
/// gets the mean of its two colours.
fn pigment(m: &Material, color: Point, through: &str) -> String {
    let plain = |c: Point| {
        let c = [0, 1, 2].map(|i| color[i] * c[i]);
        format!("rgb {} {through}", V(c))
    };
    let Some(texture) = m.texture.as_ref().filter(|t| t.other.is_none()) else {
        return plain([1.0; 3]);
    };
    let spec = &texture.spec;
    let [first, second] = spec.colors;
    let map = || format!("color_map {{ [0 {}] [1 {}] }}", plain(first), plain(second));
    let placed = in_place(spec);
    match (spec.pattern, spec.mapping, &texture.file) {
        (Pattern::Checker, Mapping::Planar, _) => {
            format!("checker {}, {} {placed}", plain(first), plain(second))
        }
        (Pattern::Gradient { wrap: Wrap::Repeat }, Mapping::Planar, _) => {
            format!("gradient x {} {placed}", map())
        }
        (Pattern::Gradient { wrap: Wrap::Clamp }, Mapping::Planar, _) => {
            format!("function {{ min(1, max(0, x)) }} {} {placed}", map())
        }
        (Pattern::Image(_), Mapping::Planar, Some(file)) => {
            format!("image_map {{ png {:?} interpolate 2 }} {placed}", file.display().to_string())
        }
        (Pattern::Image(_), _, _) => plain([0.5; 3]),
        _ => plain([0, 1, 2].map(|i| (first[i] + second[i]) / 2.0)),
    }
}

/// From POV-Ray's unit cells to a texture's.
fn in_place(spec: &TextureSpec<'_>) -> String {
    // An axis that doesn't count gets one cell, with the scene in its middle.
    const ENDLESS: f64 = 1e7;
    let up = normalized(spec.up).unwrap_or([0.0, 1.0, 0.0]);
    let third = normalized(cross(spec.right, up)).unwrap_or([0.0, 0.0, 1.0]);
    let axes = [cross(up, third), up, third];
    let mut origin = spec.origin;
    let mut rows = Vec::new();
    for (axis, size) in axes.into_iter().zip(spec.size) {
        let side = if size > 0.0 { size } else { ENDLESS };
        if size <= 0.0 {
            origin = [0, 1, 2].map(|i| origin[i] - axis[i] * ENDLESS / 2.0);
        }
        rows.push(scaled(axis, side));
    }
    rows.push(origin);
    let numbers: Vec<String> = rows.iter().flatten().map(f64::to_string).collect();
    format!("matrix <{}>", numbers.join(", "))
}

/// What a medium absorbs: POV-Ray's exponential fading, by the strongest channel.
fn fading(m: &Material) -> String {
    let rates = m.absorption[1];
    let most = rates.into_iter().fold(0.0, f64::max);
    if most <= 0.0 {
        return String::new();
    }
    let color = rates.map(|a| 1.0 - a / most);
    format!(" fade_power 1001 fade_distance {} fade_color rgb {}", 1.0 / most, V(color))
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

    #[test]
    fn surface_detail_has_its_words() {
        let text = b"[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\n[[material]]\nname = \"a\"\n\
            fresnel = true\nreflection = 1\nabsorption = [1, 2, 4]\n\
            texture = { type = \"gradient\", size = 2, colors = [0, 0.5] }\n\
            [[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
        let document = parse(Format::Toml, text).unwrap_or_else(|flaw| panic!("{}", flaw.problem));
        let text = to_pov(&document, Size { width: 4, height: 3 });
        for word in [
            "rgb 0, rgb <1, 1, 1> fresnel on",
            "fade_power 1001 fade_distance 0.25 fade_color rgb <0.75, 0.5, 0>",
            "gradient x color_map { [0 rgb <0, 0, 0> transmit 0] [1 rgb <0.4, 0.4, 0.4> transmit 0] }",
            "matrix <2, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0>",
        ] {
            assert!(text.contains(word), "{word}\n{text}");
        }
        assert_eq!(text.matches('{').count(), text.matches('}').count());
    }
}

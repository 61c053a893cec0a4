//! A scene as Rust source: `static`s that the library's const constructors make at compile time,
//! and the octree's words.
//!
//! The numbers are written so that they read back as they were, so the scene is the same to the
//! bit as the one that the host renders.

use std::fmt::{self, Write as _};

use whitted::blob::BackgroundSpec;
use whitted::scene::{LightSpec, MaterialSpec, PatternSpec, Shadow};

use super::{Baked, Construct, area, specs};
use crate::document::{Body, LightSelection, Point, Size, dot, normalized};
use crate::error::{Flaw, Problem};

/// The kinds of shapes: the field of `Parts`, its static, its type.
const KINDS: [(&str, &str, &str); 9] = [
    ("spheres", "SPHERES", "Sphere"),
    ("triangles", "TRIANGLES", "Triangle"),
    ("smooth_triangles", "SMOOTH_TRIANGLES", "SmoothTriangle"),
    ("polygons", "POLYGONS", "Polygon"),
    ("cuboids", "CUBOIDS", "Cuboid"),
    ("discs", "DISCS", "Disc"),
    ("cylinders", "CYLINDERS", "Cylinder"),
    ("cones", "CONES", "Cone"),
    ("planes", "PLANES", "Plane"),
];

/// Polygons are the fourth kind; their edges are a list of their own.
const POLYGONS: usize = 3;

impl<A: Construct> Baked<A> {
    /// The scene as a Rust module, its camera for pictures of a size; `name` is where it came from.
    ///
    /// # Errors
    /// The scene holds what a baked form can't.
    pub fn source(&self, name: &str, size: Size) -> Result<String, Flaw> {
        self.fits_source()?;
        let mut text = String::new();
        self.write_source(&mut text, name, size)
            .map_err(|error| Problem::Settings(error.to_string()).anywhere())?;
        Ok(text)
    }

    fn write_source(&self, to: &mut String, name: &str, size: Size) -> fmt::Result {
        let (arithmetic, words) = match A::NAME {
            "fixed" => ("whitted::math::Fixed", "fixed point"),
            other => (other, other),
        };
        // A name may hold anything; in a comment it is one line.
        let name: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        write!(
            to,
            "// {name}, baked for {words} by whitted {}. Baked again rather than edited.\n\n\
             /// The arithmetic of the scene.\npub type A = {arithmetic};\n\n",
            env!("CARGO_PKG_VERSION")
        )?;
        let lists = self.write_shapes(to)?;
        let tree = self.write_tree(to)?;
        self.write_rest(to, size)?;
        writeln!(to, "/// What the scene is put together from.")?;
        writeln!(
            to,
            "pub const PARTS: whitted::scene::Parts<'static, A> = whitted::scene::Parts {{"
        )?;
        for (field, list) in lists {
            writeln!(to, "    {field}: &{list},")?;
        }
        if tree {
            writeln!(to, "    tree: Some(TREE),")?;
        }
        self.write_lighting(to)?;
        let setting = specs::setting(&self.placed, size);
        write!(
            to,
            "    materials: &MATERIALS,\n    lights: &LIGHTS,\n    \
             ambient: whitted::scene::Ambient::<A>::new({:?}),\n    background: {},\n    \
             rules: RULES,\n    ..whitted::scene::Parts::EMPTY\n}};\n\n\
             /// The scene, compiled for what it uses alone.\n\
             pub static SCENE: whitted::scene::Scene<'static, A, {{ PARTS.uses() }}> =\n    \
             whitted::scene::Scene::tailored(PARTS);\n\n\
             /// The camera.\npub static CAMERA: whitted::scene::Camera<A> =\n    \
             match whitted::scene::Camera::<A>::try_look_at({:?}, {:?}, {:?}, {:?}) {{\n        \
             Ok(camera) => camera,\n        Err(_) => panic!(\"the camera\"),\n    }};\n\n\
             /// The deepest tree of rays.\npub const DEPTH: u8 = {};\n\
             /// Width and height of the picture.\npub const SIZE: (u16, u16) = ({}, {});\n",
            setting.ambient,
            background(&setting.background),
            setting.camera.eye,
            setting.camera.at,
            setting.camera.up,
            setting.camera.tangent,
            setting.depth,
            size.width,
            size.height,
        )
    }

    /// Writes the lists of shapes; gives the fields of `Parts` and the statics.
    fn write_shapes(
        &self,
        to: &mut String,
    ) -> Result<Vec<(&'static str, &'static str)>, fmt::Error> {
        let mut lists: [Vec<String>; 9] = Default::default();
        let (mut corners, mut edges) = (String::new(), Vec::new());
        for shape in &self.placed.shapes {
            let m = shape.material;
            let (kind, arguments) = match &shape.body {
                Body::Sphere { center, radius } => (0, format!("{center:?}, {radius:?}")),
                Body::Triangle { corners } => (1, format!("{corners:?}")),
                Body::SmoothTriangle { corners, normals } => {
                    (2, format!("{corners:?}, {normals:?}"))
                }
                Body::Polygon { corners: all } => {
                    let (n, count) = (lists[POLYGONS].len(), all.len());
                    writeln!(corners, "const CORNERS_{n}: [[f64; 3]; {count}] = {all:?};")?;
                    writeln!(
                        corners,
                        "const EDGES_{n}: [whitted::shape::PolygonEdge<A>; {count}] =\n    \
                         whitted::shape::Polygon::<A>::edges(&CORNERS_{n});"
                    )?;
                    let first = edges.len();
                    edges.extend((0..count).map(|i| format!("EDGES_{n}[{i}]")));
                    (POLYGONS, format!("&CORNERS_{n}, {first}"))
                }
                Body::Box { low, high } => (4, format!("{low:?}, {high:?}")),
                Body::Disc { center, normal, radius } => {
                    (5, format!("{center:?}, {normal:?}, {radius:?}"))
                }
                Body::Cylinder { base, apex, radius, .. } => {
                    (6, format!("{base:?}, {apex:?}, {radius:?}"))
                }
                Body::Cone { base, base_radius, apex, apex_radius, .. } => {
                    (7, format!("{base:?}, {base_radius:?}, {apex:?}, {apex_radius:?}"))
                }
                // Refused before.
                Body::Solid(_) => continue,
                Body::Plane { point, normal } => {
                    (8, format!("{normal:?}, {:?}", offset(*point, *normal)))
                }
            };
            let (_, _, name) = KINDS[kind];
            let capped = matches!(
                shape.body,
                Body::Cylinder { capped: true, .. } | Body::Cone { capped: true, .. }
            );
            let caps = if capped { ".with_caps()" } else { "" };
            lists[kind].push(format!("whitted::shape::{name}::<A>::new({arguments}, {m}){caps}"));
        }
        to.push_str(&corners);
        let mut written = Vec::new();
        for ((field, list, name), shapes) in KINDS.into_iter().zip(&lists) {
            if !shapes.is_empty() {
                write_list(to, list, &format!("whitted::shape::{name}<A>"), shapes)?;
                written.push((field, list));
            }
        }
        if !edges.is_empty() {
            write_list(to, "EDGES", "whitted::shape::PolygonEdge<A>", &edges)?;
            written.push(("edges", "EDGES"));
        }
        Ok(written)
    }

    fn write_tree(&self, to: &mut String) -> Result<bool, fmt::Error> {
        let Some((words, cube, step)) = self.shapes.words() else { return Ok(false) };
        let list: Vec<String> = words.iter().map(|word| format!("{word:#x}")).collect();
        write_list(to, "WORDS", "u32", &list)?;
        let planes = self.placed.shapes.iter().filter(|s| matches!(s.body, Body::Plane { .. }));
        let bounded = self.placed.shapes.len() - planes.count();
        write!(
            to,
            "#[allow(long_running_const_eval)]\n\
             const TREE: whitted::octree::Octree<'static, A> = {{\n    \
             let cube = whitted::octree::Cube {{ origin: {:?}, log2_side: {} }};\n    \
             match whitted::octree::Octree::<A>::try_new(&WORDS, {bounded}, &cube, {step}) {{\n        \
             Ok(tree) => tree,\n        Err(_) => panic!(\"the octree\"),\n    }}\n}};\n\n",
            cube.origin, cube.log2_side
        )?;
        Ok(true)
    }

    /// The fields of `Parts` that only some scenes have: media, area lights and their choice.
    fn write_lighting(&self, to: &mut String) -> fmt::Result {
        if !self.absorptions.is_empty() {
            writeln!(to, "    absorptions: &ABSORPTIONS,")?;
        }
        if !self.lights.areas.is_empty() {
            writeln!(to, "    area_lights: &AREA_LIGHTS,")?;
        }
        if !self.lights.corners.is_empty() {
            writeln!(to, "    light_corners: &LIGHT_CORNERS,")?;
        }
        let rules = &self.placed.rules;
        if let Some(seed) = rules.light_jitter {
            writeln!(to, "    light_jitter: Some({seed}),")?;
        }
        match rules.lights {
            LightSelection::All => Ok(()),
            LightSelection::Choose(count) => {
                writeln!(to, "    selection: whitted::scene::Selection::Choose({count}),")
            }
            LightSelection::Threshold(radiance) => {
                writeln!(to, "    selection: whitted::scene::Selection::<A>::above({radiance:?}),")
            }
        }
    }

    fn write_rest(&self, to: &mut String, size: Size) -> fmt::Result {
        let mut absorptions = Vec::new();
        let mut materials = Vec::new();
        for m in &self.placed.materials {
            let Ok(mut spec) = specs::material(m) else { continue };
            if m.absorbs() {
                spec.absorption = u16::try_from(absorptions.len()).ok();
                let [front, behind] = m.absorption;
                absorptions
                    .push(format!("whitted::scene::Absorption::<A>::new({front:?}, {behind:?})"));
            }
            materials.push(material(&spec));
        }
        if !absorptions.is_empty() {
            write_list(to, "ABSORPTIONS", "whitted::scene::Absorption<A>", &absorptions)?;
        }
        write_list(to, "MATERIALS", "whitted::scene::Material<A>", &materials)?;
        let lights: Vec<String> =
            self.placed.lights.iter().filter_map(specs::light).map(|l| light(&l)).collect();
        write_list(to, "LIGHTS", "whitted::scene::Light<A>", &lights)?;
        area::write(to, &self.placed.lights, &self.lights.areas)?;
        let setting = specs::setting(&self.placed, size);
        write!(
            to,
            "const RULES: whitted::scene::Rules<A> = whitted::scene::Rules {{\n    \
             specular_cosine: {},\n    highlight_cosine: {},\n    transmitters_reflect: {},\n    \
             lossy: {},\n    ..whitted::scene::Rules::<A>::with_cutoff({:?})\n}};\n\n",
            setting.specular_cosine,
            setting.highlight_cosine,
            setting.transmitters_reflect,
            setting.lossy,
            setting.cutoff
        )
    }
}

/// A static list.
pub(super) fn write_list(
    to: &mut String,
    name: &str,
    kind: &str,
    values: &[String],
) -> fmt::Result {
    writeln!(to, "#[allow(long_running_const_eval)]\n#[rustfmt::skip]")?;
    writeln!(to, "static {name}: [{kind}; {}] = [", values.len())?;
    for value in values {
        writeln!(to, "    {value},")?;
    }
    writeln!(to, "];\n")
}

/// As the baker's own planes have it.
fn offset(point: Point, normal: Point) -> f64 {
    normalized(normal).map_or(0.0, |n| dot(n, point))
}

fn background(spec: &BackgroundSpec) -> String {
    match spec {
        BackgroundSpec::Uniform(color) => {
            format!("whitted::scene::Background::<A>::uniform({color:?})")
        }
        BackgroundSpec::Gradient { up, bottom, top } => {
            format!("whitted::scene::Background::<A>::gradient({up:?}, {bottom:?}, {top:?})")
        }
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
        texture: _,
        bump: _,
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
         fresnel: {fresnel}, absorption: {absorption:?}, ..whitted::scene::MaterialSpec::BLACK }})"
    )
}

/// What the specifications derive as `Debug` is their source, but for where their names are.
fn light(spec: &LightSpec) -> String {
    let text = format!("{spec:?}").replace("falloff: ", "falloff: whitted::scene::Falloff::");
    format!("whitted::scene::Light::<A>::new(whitted::scene::LightSpec::{text})")
}

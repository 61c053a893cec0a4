//! A scene as Rust source: `static`s that the library's const constructors make at compile time,
//! and the octree's words.
//!
//! The numbers are written so that they read back as they were, so the scene is the same to the
//! bit as the one that the host renders.

mod area;
mod indirect;
mod list;
mod surface;

use std::fmt::{self, Write as _};

use whitted::blob::BackgroundSpec;
use whitted::scene::LightSpec;

use super::{Baked, Construct, Glow, specs};
use crate::document::{LightSelection, Size};
use crate::error::{Flaw, Problem};

impl<A: Construct> Baked<A> {
    /// The scene as a Rust module, its camera for pictures of a size; `name` is where it came from.
    ///
    /// What surfaces send each other is made for this size, and lies there read-only.
    ///
    /// # Errors
    /// The settings of that are out of range.
    pub fn source(&self, name: &str, size: Size) -> Result<String, Flaw> {
        self.source_with(name, size, &self.glow(size)?)
    }

    /// The same with light between the surfaces that was made before, by [`glow`](Self::glow).
    ///
    /// # Errors
    /// None but of memory.
    pub fn source_with(&self, name: &str, size: Size, glow: &Glow) -> Result<String, Flaw> {
        let mut text = String::new();
        self.write_source(&mut text, name, size, glow)
            .map_err(|error| Problem::Settings(error.to_string()).anywhere())?;
        Ok(text)
    }

    fn write_source(&self, to: &mut String, name: &str, size: Size, glow: &Glow) -> fmt::Result {
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
        let mut fields = list::write(to, "", &self.placed.shapes, &self.shapes)?;
        fields.extend(self.write_groups(to)?);
        fields.extend(surface::write(to, &self.placed)?);
        fields.extend(indirect::write(to, glow)?);
        self.write_lights(to)?;
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
        )?;
        writeln!(to, "/// What the scene is put together from.")?;
        writeln!(
            to,
            "pub const PARTS: whitted::scene::Parts<'static, A> = whitted::scene::Parts {{"
        )?;
        for (field, value) in fields {
            writeln!(to, "    {field}: {value},")?;
        }
        self.write_lighting(to)?;
        write!(
            to,
            "    lights: &LIGHTS,\n    \
             ambient: whitted::scene::Ambient::<A>::new({:?}),\n    background: {},\n    \
             rules: RULES,\n    ..whitted::scene::Parts::EMPTY\n}};\n\n\
             /// The scene, compiled for what it uses alone.\n\
             pub static SCENE: whitted::scene::Scene<'static, A, {{ PARTS.uses() }}> =\n    \
             whitted::scene::Scene::tailored(PARTS);\n\n\
             whitted::scene_type! {{\n    \
             /// The scene as a type: the compiler knows it wherever it is traced.\n    \
             pub struct Baked: whitted::scene::Scene<'static, A, {{ PARTS.uses() }}> = SCENE;\n\
             }}\n\n\
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

    /// Writes the groups and where they stand; gives the field of `Parts`, if there are any.
    fn write_groups(&self, to: &mut String) -> Result<Option<(&'static str, String)>, fmt::Error> {
        for (index, group) in self.placed.groups.iter().enumerate() {
            let Some(shapes) = self.groups.placed(index) else { continue };
            let prefix = format!("GROUP_{index}_");
            let fields = list::write(to, &prefix, &group.shapes, shapes)?;
            write!(
                to,
                "#[allow(long_running_const_eval)]\n\
                 static GROUP_{index}: whitted::scene::Group<'static, A> =\n    \
                 whitted::scene::Group::<A>::new(whitted::scene::Shapes {{\n"
            )?;
            for (field, value) in fields {
                writeln!(to, "        {field}: {value},")?;
            }
            writeln!(to, "        ..whitted::scene::Shapes::EMPTY\n    }});\n")?;
        }
        let instances: Vec<String> = self
            .groups
            .places()
            .map(|(group, transform, material)| {
                let material =
                    material.map_or_else(String::new, |m| format!(".with_material({m})"));
                format!(
                    "whitted::scene::Instance::<A>::new(&GROUP_{group}, \
                     whitted::scene::{transform:?}){material}"
                )
            })
            .collect();
        if instances.is_empty() {
            return Ok(None);
        }
        write_list(to, "INSTANCES", "whitted::scene::Instance<'static, A>", &instances)?;
        Ok(Some(("instances", "&INSTANCES".into())))
    }

    fn write_lights(&self, to: &mut String) -> fmt::Result {
        let lights: Vec<String> =
            self.placed.lights.iter().filter_map(specs::light).map(|l| light(&l)).collect();
        write_list(to, "LIGHTS", "whitted::scene::Light<A>", &lights)?;
        area::write(to, &self.placed.lights, &self.lights.areas)
    }

    /// The fields of `Parts` that only some scenes have: area lights, and which lights are asked.
    fn write_lighting(&self, to: &mut String) -> fmt::Result {
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
}

/// A static list.
fn write_list(to: &mut String, name: &str, kind: &str, values: &[String]) -> fmt::Result {
    writeln!(to, "#[allow(long_running_const_eval)]\n#[rustfmt::skip]")?;
    writeln!(to, "static {name}: [{kind}; {}] = [", values.len())?;
    for value in values {
        writeln!(to, "    {value},")?;
    }
    writeln!(to, "];\n")
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

/// What the specifications derive as `Debug` is their source, but for where their names are.
fn light(spec: &LightSpec) -> String {
    let text = format!("{spec:?}").replace("falloff: ", "falloff: whitted::scene::Falloff::");
    format!("whitted::scene::Light::<A>::new(whitted::scene::LightSpec::{text})")
}

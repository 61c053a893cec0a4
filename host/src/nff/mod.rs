//! Neutral File Format (Eric Haines, Standard Procedural Databases).
//!
//! Line breaks mean nothing inside an entity, `#` starts a comment. What a file in this format
//! means for the model is [`Rules::NFF`]: lights don't weaken, no specular cosine, no cut-off, a
//! transmitting surface always reflects too, the view's angle lies between pixel centres.

mod patch;
mod token;

use std::collections::HashMap;

use crate::document::{
    Background, Body, Camera, Document, FARTHEST, Falloff, Light, LightKind, Material, Point, Rgb,
    Rules, ShadowThrough, Shape, Size, Span, Warning,
};
use crate::error::{Flaw, Problem};
use crate::words::Numbers;
use token::Tokens;

/// The words that an entity can start with.
const WORDS: [&str; 13] =
    ["v", "from", "at", "up", "angle", "hither", "resolution", "b", "l", "f", "s", "c", "p"];
const PATCH: &str = "pp";

/// Reads a text in Neutral File Format.
///
/// # Errors
/// The first thing that is wrong with it, with its line.
pub fn parse(text: &str) -> Result<Document, Flaw> {
    let mut reader = Reader { tokens: Tokens::new(text), ..Reader::default() };
    while let Some(word) = reader.tokens.word() {
        reader.entity(word)?;
    }
    reader.finish()
}

/// The view as far as it has been read.
#[derive(Default)]
struct View {
    started: Option<usize>,
    from: Option<(Point, usize)>,
    at: Option<(Point, usize)>,
    up: Option<(Point, usize)>,
    angle: Option<(f64, usize)>,
    hither: Option<(f64, usize)>,
    resolution: Option<(Size, usize)>,
}

struct Reader<'t> {
    tokens: Tokens<'t>,
    view: View,
    background: Option<(Rgb, usize)>,
    lights: Vec<(Point, Option<Rgb>, usize)>,
    materials: Vec<Material>,
    /// Which of them has these numbers: programs say the same again before each object.
    known: HashMap<[u64; 8], usize>,
    /// The material of what follows.
    current: Option<usize>,
    shapes: Vec<Shape>,
    warnings: Vec<Warning>,
}

impl Default for Reader<'_> {
    fn default() -> Self {
        Self {
            tokens: Tokens::new(""),
            view: View::default(),
            background: None,
            lights: Vec::new(),
            materials: Vec::new(),
            known: HashMap::new(),
            current: None,
            shapes: Vec::new(),
            warnings: Vec::new(),
        }
    }
}

/// Puts a value in its place, once.
fn once<T>(place: &mut Option<(T, usize)>, value: T, what: &str, line: usize) -> Result<(), Flaw> {
    if let Some((_, first)) = place {
        return Err(Problem::Twice { what: what.into(), first: *first }.at(line));
    }
    *place = Some((value, line));
    Ok(())
}

impl Reader<'_> {
    fn entity(&mut self, word: &str) -> Result<(), Flaw> {
        let line = self.tokens.line();
        let tokens = &mut self.tokens;
        match word {
            "v" => {
                if let Some(first) = self.view.started.replace(line) {
                    return Err(Problem::Twice { what: "view (v)".into(), first }.at(line));
                }
                Ok(())
            }
            "from" => once(&mut self.view.from, tokens.point("from")?, word, line),
            "at" => once(&mut self.view.at, tokens.point("at")?, word, line),
            "up" => once(&mut self.view.up, tokens.point("up")?, word, line),
            "angle" => {
                once(&mut self.view.angle, tokens.number_in("angle", 0.01, 179.0)?, word, line)
            }
            "hither" => once(&mut self.view.hither, tokens.number("hither")?, word, line),
            "resolution" => {
                let width = tokens.count("resolution x", 1, Size::LARGEST)?;
                let height = tokens.count("resolution y", 1, Size::LARGEST)?;
                once(&mut self.view.resolution, Size { width, height }, word, line)
            }
            "b" => once(&mut self.background, tokens.color("background")?, "background (b)", line),
            "l" => self.light(line),
            "f" => self.material(line),
            "s" => self.sphere(line),
            "c" => self.cone(line),
            "p" | PATCH => self.polygon(word == PATCH, line),
            _ => {
                let known: Vec<&str> = WORDS.into_iter().chain([PATCH]).collect();
                Err(Problem::unknown("word", word, &known).at(line))
            }
        }
    }

    fn light(&mut self, line: usize) -> Result<(), Flaw> {
        let position = self.tokens.point("light")?;
        // A colour may follow: no word that starts an entity reads as a number.
        let colored = self.tokens.peek().is_some_and(|w| w.parse::<f64>().is_ok());
        let color = colored.then(|| self.tokens.color("light")).transpose()?;
        self.lights.push((position, color, line));
        Ok(())
    }

    fn material(&mut self, line: usize) -> Result<(), Flaw> {
        let tokens = &mut self.tokens;
        let color = tokens.color("material")?;
        let diffuse = tokens.number_in("Kd", 0.0, 16.0)?;
        let specular = tokens.number_in("Ks", 0.0, 1.0)?;
        let shininess = tokens.number_in("Shine", 0.0, 1e6)?;
        let transmission = tokens.number_in("T", 0.0, 1.0)?;
        let index = tokens.number("ior")?;
        // An opaque body's index says nothing, and often is 0.
        if transmission > 0.0 && !(0.25..=4.0).contains(&index) {
            return Err(
                Problem::range("ior", index, "0.25 to 4 where T is not 0").at(tokens.line())
            );
        }
        let [r, g, b] = color;
        let numbers = [r, g, b, diffuse, specular, shininess, transmission, index];
        let next = self.materials.len();
        let number = *self.known.entry(numbers.map(f64::to_bits)).or_insert(next);
        self.current = Some(number);
        if number < next {
            return Ok(());
        }
        self.materials.push(Material {
            ambient: [0.0; 3],
            diffuse: color.map(|c| c * diffuse),
            specular: [specular; 3],
            shininess,
            reflection: [specular; 3],
            transmission: [transmission; 3],
            index_behind: if transmission > 0.0 { index } else { 1.0 },
            shadow: ShadowThrough::Opaque,
            ..Material::matt(line)
        });
        Ok(())
    }

    fn sphere(&mut self, line: usize) -> Result<(), Flaw> {
        let center = self.tokens.point("sphere")?;
        let radius = self.tokens.number_in("sphere radius", -FARTHEST, FARTHEST)?;
        self.shape(Body::Sphere { center, radius }, line)
    }

    fn cone(&mut self, line: usize) -> Result<(), Flaw> {
        let base = self.tokens.point("cone base")?;
        let base_radius = self.tokens.number_in("cone base radius", -FARTHEST, FARTHEST)?;
        let apex = self.tokens.point("cone apex")?;
        let apex_radius = self.tokens.number_in("cone apex radius", -FARTHEST, FARTHEST)?;
        let body = if base_radius == apex_radius {
            Body::Cylinder { base, apex, radius: base_radius, capped: false }
        } else {
            Body::Cone { base, base_radius, apex, apex_radius, capped: false }
        };
        self.shape(body, line)
    }

    /// Adds a shape of the latest material.
    fn shape(&mut self, body: Body, line: usize) -> Result<(), Flaw> {
        if let Some(why) = body.flaw() {
            return Err(Problem::degenerate(body.name(), why).at(line));
        }
        let material = self.current(line)?;
        self.shapes.push(Shape { body, material, uv: None, line });
        Ok(())
    }

    fn current(&self, line: usize) -> Result<usize, Flaw> {
        let what = "a material (f r g b Kd Ks Shine T ior) before the first shape".to_string();
        self.current.ok_or_else(|| Problem::Missing { what }.at(line))
    }

    fn warn(&mut self, line: usize, text: String) {
        self.warnings.push(Warning { line, text });
    }

    fn finish(self) -> Result<Document, Flaw> {
        let camera = self.view.camera()?;
        if self.shapes.is_empty() {
            let what = "a shape (s, c, p or pp)".to_string();
            return Err(Problem::Missing { what }.anywhere());
        }
        // Haines' convention: n lights without colours have 1/√n each.
        let share = [1.0 / (self.lights.len().max(1) as f64).sqrt(); 3];
        let falloff = Rules::NFF.falloff;
        debug_assert_eq!(falloff, Falloff::None);
        let lights = self.lights.iter().map(|&(position, color, line)| Light {
            kind: LightKind::Point { position, falloff },
            color: color.unwrap_or(share),
            line,
        });
        Ok(Document {
            indirect: None,
            camera,
            size: self.view.resolution.map(|(size, _)| size),
            background: Background::Color(self.background.map_or([0.0; 3], |(color, _)| color)),
            ambient: [0.0; 3],
            rules: Rules::NFF,
            lights: lights.collect(),
            materials: self.materials,
            shapes: self.shapes,
            groups: Vec::new(),
            instances: Vec::new(),
            warnings: self.warnings,
            included: Vec::new(),
        })
    }
}

impl View {
    fn camera(&self) -> Result<Camera, Flaw> {
        let missing = |what: &str| {
            let problem = Problem::Missing { what: what.into() };
            Flaw { line: self.started, file: None, problem }
        };
        if self.started.is_none() && self.from.is_none() {
            return Err(missing("the view (v, then from, at, up, angle, resolution)"));
        }
        let (eye, _) = self.from.ok_or_else(|| missing("the view's eye point (from x y z)"))?;
        let (look_at, at) = self.at.ok_or_else(|| missing("the view's target (at x y z)"))?;
        let (up, _) = self.up.ok_or_else(|| missing("the view's up direction (up x y z)"))?;
        let (angle, _) = self.angle.ok_or_else(|| missing("the view's angle (angle degrees)"))?;
        let camera = Camera { eye, look_at, up, angle, span: Span::Centers };
        match camera.flaw() {
            Some(why) => Err(Problem::degenerate("view", why).at(self.started.unwrap_or(at))),
            None => Ok(camera),
        }
    }
}

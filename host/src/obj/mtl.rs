//! Wavefront MTL: materials.
//!
//! | format | model |
//! |---|---|
//! | `Kd`, `Ka`, `Ks`, `Ns` | diffuse, ambient, specular, shininess |
//! | `illum` 3 to 7 | mirrors: reflection is `Ks` |
//! | `illum` 4, 6, 7, 9, or none with `d` below 1 | glass: transmission is `Tf`, times 1 − `d` where `d` is given |
//! | `Ni` | index of what transmits |
//! | `Ke` | emission |
//! | `map_Kd` | a picture that diffuse and ambient are multiplied by, by the mesh's coordinates |
//! | `d` (or 1 − `Tr`) | where it is below 1: diffuse is `d`·`Kd`, shadows are filtered |

use std::collections::BTreeMap;

use whitted::scene::{Filter, Wrap};

use super::line::{Words, lines};
use crate::document::{Material, Rgb, ShadowThrough, Texture, Warning};
use crate::error::{Flaw, Problem, shown};
use crate::mesh;
use crate::read::{self, Around};
use crate::words::Numbers;

/// What was read.
pub(super) struct Library {
    pub(super) materials: Vec<Material>,
    pub(super) warnings: Vec<Warning>,
}

const WORDS: [&str; 12] =
    ["newmtl", "Ka", "Kd", "Ks", "Ke", "Ns", "Ni", "Tf", "d", "Tr", "illum", "map_Kd"];

/// Words that the model has no meaning for, by how they begin.
const WITHOUT: [(&str, &[&str]); 4] = [
    (
        "maps other than map_Kd (map_…, bump, disp, decal, refl, norm)",
        &["map_", "bump", "disp", "decal", "refl", "norm"],
    ),
    ("physically based values (Pr, Pm, Ps, Pc, aniso)", &["Pr", "Pm", "Ps", "Pc", "aniso"]),
    ("sharpness of reflections", &["sharpness"]),
    ("coefficients of other programs (Kr, Kt, Km, Ko)", &["Kr", "Kt", "Km", "Ko"]),
];

/// As bright as a surface may be.
const BRIGHTEST: f64 = 1000.0;

/// A material as the file has it.
#[derive(Default)]
struct Entry {
    name: String,
    line: usize,
    ambient: Option<Rgb>,
    diffuse: Option<Rgb>,
    specular: Option<Rgb>,
    shininess: Option<f64>,
    index: Option<(f64, usize)>,
    filter: Option<Rgb>,
    dissolve: Option<f64>,
    /// `d -halo` instead of `d`.
    halo: bool,
    illumination: Option<u8>,
    emission: Option<Rgb>,
    map: Option<Texture>,
}

pub(super) fn parse(text: &str, around: &Around) -> Result<Library, Flaw> {
    let mut entries: Vec<Entry> = Vec::new();
    let mut maps = Vec::new();
    let mut without: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for (line, text) in lines(text) {
        let mut words = Words::new(&text, line);
        let Some(word) = words.next() else { continue };
        if word == "newmtl" {
            let name = words.name("material")?;
            if let Some(first) = entries.iter().find(|m| m.name == name) {
                let what = format!("material \"{}\"", crate::error::shown(&name));
                return Err(Problem::Twice { what, first: first.line }.at(line));
            }
            entries.push(Entry { name, line, ..Entry::default() });
            continue;
        }
        if word == "map_Kd"
            && let Some(entry) = entries.last_mut()
        {
            entry.map = map(&mut words, around, &mut maps)?;
            continue;
        }
        let lacks = WITHOUT.iter().find(|(_, starts)| starts.iter().any(|s| word.starts_with(s)));
        if let Some((what, _)) = lacks {
            without.entry(what).or_insert((line, 0)).1 += 1;
            continue;
        }
        let Some(entry) = entries.last_mut() else {
            let what = "a material (newmtl name) before this line".to_string();
            return Err(Problem::Missing { what }.at(line));
        };
        entry.read(word, &mut words)?;
    }
    let mut warnings = maps;
    let lacking = without.into_iter().map(|(what, (line, count))| Warning {
        line,
        text: format!("{what} aren't in the model: {count} left out (this is the first)"),
    });
    warnings.extend(lacking);
    let materials = entries.iter().map(|e| e.material(&mut warnings)).collect::<Result<_, _>>()?;
    Ok(Library { materials, warnings })
}

impl Entry {
    fn read(&mut self, word: &str, words: &mut Words<'_>) -> Result<(), Flaw> {
        match word {
            "Ka" => self.ambient = Some(color(words, word, 15.9)?),
            "Kd" => self.diffuse = Some(color(words, word, 15.9)?),
            "Ks" => self.specular = Some(color(words, word, 15.9)?),
            "Ke" | "ke" => self.emission = Some(color(words, word, BRIGHTEST)?),
            "Tf" => self.filter = Some(color(words, word, 1.0)?),
            "Ns" => self.shininess = Some(words.number_in(word, 0.0, 1e6)?),
            "Ni" => self.index = Some((words.number(word)?, words.line)),
            "d" => {
                // `d -halo` thins towards the middle, which the model has no meaning for.
                let mut value = words.next().ok_or_else(|| words.missing(word))?;
                if value == "-halo" {
                    self.halo = true;
                    value = words.next().ok_or_else(|| words.missing(word))?;
                }
                let mut words = Words::new(value, words.line);
                self.dissolve = Some(words.number_in(word, 0.0, 1.0)?);
            }
            "Tr" => self.dissolve = Some(1.0 - words.number_in(word, 0.0, 1.0)?),
            "illum" => {
                let value = words.number_in(word, 0.0, 10.0)?;
                if value.fract() != 0.0 {
                    return Err(Problem::range(word, value, "a whole number").at(words.line));
                }
                self.illumination = Some(value as u8);
            }
            _ => return Err(Problem::unknown("word", word, &WORDS).at(words.line)),
        }
        Ok(())
    }

    fn material(&self, warnings: &mut Vec<Warning>) -> Result<Material, Flaw> {
        let like = Material::matt(self.line);
        let dissolve = self.dissolve.unwrap_or(1.0);
        let highlights = self.illumination.is_none_or(|i| i >= 2);
        let mirrors = self.illumination.is_some_and(|i| (3..=7).contains(&i));
        let glass = match self.illumination {
            Some(4 | 6 | 7 | 9) => true,
            // Programs that write `d` without a word on illumination mean it to be seen.
            _ => dissolve < 1.0,
        };
        let mut say = |text: &str| {
            let text = format!("material \"{}\": {text}", self.name);
            warnings.push(Warning { line: self.line, text });
        };
        if self.halo {
            say("d -halo thins towards the middle; here it is as thin everywhere");
        }
        match self.illumination {
            Some(0) => say("illum 0 is lit here as illum 1 is"),
            Some(5 | 7) => {
                say("illum 5 and 7 weigh mirrors by angle (Fresnel); here they are even")
            }
            Some(8 | 9) => say("illum 8 and 9 mirror a map; nothing is mirrored here"),
            Some(10) => say("illum 10 shows shadows alone; here it is lit as illum 1"),
            _ => {}
        }
        // A picture without a colour is shown as it is.
        let plain = if self.map.is_some() { [1.0; 3] } else { like.diffuse };
        let diffuse = self.diffuse.unwrap_or(plain);
        let specular = self.specular.unwrap_or([0.0; 3]);
        let filter = match (self.filter, self.dissolve) {
            (Some(filter), Some(d)) => filter.map(|k| k * (1.0 - d)),
            (Some(filter), None) => filter,
            (None, Some(d)) => [1.0 - d; 3],
            (None, None) => [1.0; 3],
        };
        let transmission = if glass { filter } else { [0.0; 3] };
        let transmits = transmission.iter().any(|&k| k > 0.0);
        let index = match self.index {
            Some((index, line)) if transmits && !(0.25..=4.0).contains(&index) => {
                return Err(Problem::range("Ni", index, "0.25 to 4").at(line));
            }
            Some((index, _)) if transmits => index,
            _ => 1.0,
        };
        Ok(Material {
            name: self.name.clone(),
            ambient: self.ambient.unwrap_or(diffuse),
            diffuse: diffuse.map(|k| k * dissolve),
            specular: if highlights { specular } else { [0.0; 3] },
            shininess: self.shininess.unwrap_or(like.shininess),
            reflection: if mirrors { specular.map(|k| k.min(1.0)) } else { [0.0; 3] },
            transmission,
            emission: self.emission.unwrap_or_default(),
            texture: self.map.clone(),
            index_behind: index,
            shadow: if transmits { ShadowThrough::Filtered } else { ShadowThrough::Opaque },
            ..like
        })
    }
}

/// The picture of `map_Kd`, or a warning of why there is none.
fn map(
    words: &mut Words<'_>,
    around: &Around,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Texture>, Flaw> {
    let name = words.name("map_Kd")?;
    let left_out = |warnings: &mut Vec<Warning>, why: String| {
        let text = format!("map_Kd \"{}\": {why}; its colour alone instead", shown(&name));
        warnings.push(Warning { line: words.line, text });
        Ok(None)
    };
    if name.starts_with('-') {
        return left_out(warnings, "options of maps (-s, -o, -clamp, …) aren't read".into());
    }
    let path = around.file_beside(&name);
    let read = read::bytes(&path);
    match read.and_then(|bytes| mesh::texture(&bytes, Filter::Bilinear, Wrap::Repeat)) {
        Ok((spec, note)) => {
            warnings.extend(note.map(|note| Warning {
                line: words.line,
                text: format!("map_Kd \"{}\": {note}", shown(&name)),
            }));
            Ok(Some(Texture { spec, other: None, file: Some(path), line: words.line }))
        }
        Err(problem) => left_out(warnings, problem.to_string()),
    }
}

/// Three channels, or one for all.
fn color(words: &mut Words<'_>, what: &str, most: f64) -> Result<Rgb, Flaw> {
    let first = words.next().ok_or_else(|| words.missing(what))?;
    if first == "spectral" || first == "xyz" {
        return Err(words.found(first, "red green blue (spectral and xyz colours aren't read)"));
    }
    let mut one = Words::new(first, words.line);
    let red = one.number_in(&format!("{what} red"), 0.0, most)?;
    let Some(second) = words.next() else { return Ok([red; 3]) };
    let mut one = Words::new(second, words.line);
    let green = one.number_in(&format!("{what} green"), 0.0, most)?;
    Ok([red, green, words.number_in(&format!("{what} blue"), 0.0, most)?])
}

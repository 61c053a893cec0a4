//! `whitted check`: reads and validates a scene, and says what is in it.

use std::path::Path;

use whitted::math::Fixed;
use whitted_host::bake::{Baked, Construct, Thrift, parts_of};
use whitted_host::document::{Body, Document, Material, Size};
use whitted_host::error::Flaw;
use whitted_host::need::{self, BOARDS, PROGRAM, Pixel, RESERVE};
use whitted_host::read;

use super::{Failure, print, warn};

pub(super) fn run(file: &Path, quiet: bool) -> Result<(), Failure> {
    let document = read::read(file)?;
    let reference = Baked::<f64>::new(&document).map_err(|flaw| flaw.of(file))?;
    drop(reference);
    if quiet {
        return Ok(());
    }
    warn(file, &document);
    let shapes: Vec<String> =
        document.census().iter().map(|(name, count)| plural(*count, name)).collect();
    line("shapes", format_args!("{} ({})", document.shapes.len(), shapes.join(", ")))?;
    if !document.instances.is_empty() {
        let (instances, groups) = (document.instances.len(), document.groups.len());
        line("instances", format_args!("{instances} of {}", plural(groups, "group")))?;
    }
    let features = features(&document);
    let features = if features.is_empty() { String::new() } else { format!(" ({features})") };
    line("materials", format_args!("{}{features}", document.materials.len()))?;
    let lights: Vec<&str> = document.lights.iter().map(|light| light.name()).collect();
    line("lights", format_args!("{} {}", lights.len(), listed(&lights)))?;
    if let Some(size) = document.size {
        line("size", format_args!("{size}"))?;
    }
    line("depth", format_args!("{}", document.rules.depth))?;
    line(
        "paths",
        format_args!("{}", super::covered(&document, document.rules.depth, document.indirect)),
    )?;
    if let Some(bounds) = document.bounds() {
        let [low, high] = [bounds.low, bounds.high].map(|p| p.map(|x| format!("{x:.4}")).join(" "));
        let planes = document.shapes.iter().any(|s| matches!(s.body, Body::Plane { .. }));
        let beyond = if planes { ", and endless planes" } else { "" };
        line("extent", format_args!("{low} to {high}{beyond}"))?;
    }
    let size = document.size.unwrap_or(super::render::SIZE);
    let needs = [fits::<f32>(&document, file, size)?, fits::<Fixed>(&document, file, size)?];
    boards(&needs, size)
}

/// What a scene needs in an arithmetic.
struct Need {
    arithmetic: &'static str,
    flash: usize,
    memory: usize,
    pixel: Pixel,
}

/// Which boards the scene fits on, and how long a frame takes there.
fn boards(needs: &[Option<Need>], size: Size) -> Result<(), Failure> {
    let needs = || needs.iter().flatten();
    if needs().next().is_none() {
        return Ok(());
    }
    line("frame", format_args!("{size}, one ray a pixel, times estimated from emulated counts"))?;
    for board in &BOARDS {
        let Some(need) = needs().find(|need| need.arithmetic == board.arithmetic) else {
            continue;
        };
        let row = size.width as usize * 2;
        let (flash, ram) = (need.flash + PROGRAM, need.memory + row + RESERVE);
        let pixels = f64::from(size.width) * f64::from(size.height);
        let seconds = board.core.cycles(&need.pixel) * pixels / (board.mhz * 1e6 * board.cores);
        let verdict = match (flash > board.flash, ram > board.ram) {
            (false, false) => format!("about {}", rough(seconds)),
            (true, _) => {
                format!("doesn't fit: {} of {} KiB of flash", flash / 1024, board.flash / 1024)
            }
            (_, true) => {
                format!("doesn't fit: {} of {} KiB of RAM", ram / 1024, board.ram / 1024)
            }
        };
        print(format_args!("  {:24} {:6} {verdict}\n", board.name, board.arithmetic))?;
    }
    Ok(())
}

/// A time in two digits: no more is known.
fn rough(seconds: f64) -> String {
    match seconds {
        s if s < 0.0995 => format!("{:.0} ms", s * 1e3),
        s if s < 9.95 => format!("{s:.1} s"),
        s if s < 99.5 => format!("{s:.0} s"),
        s => format!("{:.0} min", s / 60.0),
    }
}

/// How many materials have what beyond a colour.
fn features(document: &Document) -> String {
    type Has = fn(&Material) -> bool;
    let all: [(&str, Has); 9] = [
        ("with a highlight", |m| m.specular.iter().any(|&k| k > 0.0)),
        ("mirroring", Material::reflects),
        ("transmitting", Material::transmits),
        ("by Fresnel's formula", |m| m.fresnel),
        ("absorbing", Material::absorbs),
        ("emitting", |m| m.emission.iter().any(|&e| e > 0.0)),
        ("checkered", |m| m.checker.is_some()),
        ("textured", |m| m.texture.is_some()),
        ("bumped", |m| m.bump.is_some()),
    ];
    let count = |has: Has| document.materials.iter().filter(|m| has(m)).count();
    let found = all.map(|(name, has)| (count(has), name));
    let found = found.iter().filter(|(count, _)| *count > 0);
    found.map(|(count, name)| format!("{count} {name}")).collect::<Vec<_>>().join(", ")
}

fn line(name: &str, text: std::fmt::Arguments<'_>) -> Result<(), Failure> {
    print(format_args!("{name:10} {text}\n"))
}

fn listed(names: &[&str]) -> String {
    let mut kinds: Vec<&str> = names.to_vec();
    kinds.dedup();
    if kinds.is_empty() { String::new() } else { format!("({})", kinds.join(", ")) }
}

fn plural(count: usize, name: &str) -> String {
    match (count, name.strip_suffix('x')) {
        (1, _) => format!("1 {name}"),
        (_, Some(_)) => format!("{count} {name}es"),
        (_, None) => format!("{count} {name}s"),
    }
}

/// Whether an arithmetic can hold the scene, how it is placed, and what it needs.
fn fits<A: Construct>(
    document: &Document,
    file: &Path,
    size: Size,
) -> Result<Option<Need>, Failure> {
    // As `bake` does it: with the octree that flash has room for.
    match Baked::<A>::with(document, Thrift::Flash) {
        Err(flaw) => {
            line(A::NAME, format_args!("no: {}", flaw.of(file)))?;
            Ok(None)
        }
        Ok(baked) => {
            let far = baked.document().lights.iter().zip(&document.lights);
            let placed = match far.filter(|(here, there)| here.name() != there.name()).count() {
                0 => baked.placement.to_string(),
                far => {
                    format!("{}, {} made directional", baked.placement, plural(far, "far light"))
                }
            };
            let tree = match baked.tree() {
                Some((words, levels)) => format!("octree {} bytes, {levels} levels", 4 * words),
                None => "no octree".to_string(),
            };
            line(A::NAME, format_args!("yes, {placed}; {tree}"))?;
            let (flash, text) = in_flash(&baked, size).map_err(|flaw| flaw.of(file))?;
            line("  flash", format_args!("{text}"))?;
            let depth = document.rules.depth;
            let memory = need::memory::<A>(depth);
            line("  memory", format_args!("{memory} bytes to trace {depth} deep, and rows"))?;
            let pixel = need::pixel(&baked, size, depth).map_err(|flaw| flaw.of(file))?;
            let Pixel { rays, shadow, nodes, tests, lookups, deepest } = pixel;
            let asked = match lookups {
                0.0 => String::new(),
                n => format!(", {n:.2} times asking the irradiance cache at most"),
            };
            let rays = format!("{rays:.2} a pixel, and {shadow:.2} to lights{asked}");
            let each = 1.0 / (pixel.rays + pixel.shadow).max(1.0);
            let (nodes, tests) = (nodes * each, tests * each);
            line(
                "  rays",
                format_args!("{rays}; each tests {tests:.1} shapes in {nodes:.1} nodes"),
            )?;
            let enough = match deepest < depth {
                true => format!("depth = {deepest} would do"),
                false => "as deep as they may".to_string(),
            };
            line("  trees", format_args!("up to {deepest} deep in a small picture: {enough}"))?;
            Ok(Some(Need { arithmetic: A::NAME, flash, memory, pixel }))
        }
    }
}

/// The bytes that a scene takes in flash, and what they are: those of a blob, or, where none can hold
/// the scene, those of a `static`.
fn in_flash<A: Construct>(baked: &Baked<A>, size: Size) -> Result<(usize, String), Flaw> {
    let (flash, form, parts): (usize, &str, Vec<(&str, usize)>) = match baked.blob(size) {
        Ok(flash) => {
            let parts = parts_of::<A>(&flash.counts).into_iter();
            (flash.bytes.len(), " baked", parts.map(|(name, _, bytes)| (name, bytes)).collect())
        }
        Err(_) => {
            let mut parts = need::flash(baked)?;
            if let Some((name, _, bytes)) = baked.glow(size)?.size::<A>() {
                parts.push((name, bytes));
            }
            let chip = if size_of::<usize>() > 4 { ", some less on a chip" } else { "" };
            (parts.iter().map(|(_, bytes)| bytes).sum(), chip, parts)
        }
    };
    let list: Vec<String> = parts.iter().map(|(name, bytes)| format!("{name} {bytes}")).collect();
    Ok((flash, format!("{flash} bytes{form}: {}", list.join(", "))))
}

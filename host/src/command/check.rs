//! `whitted check`: reads and validates a scene, and says what is in it.

use std::path::Path;

use whitted::math::Fixed;
use whitted_host::bake::{Baked, Construct, Placement};
use whitted_host::document::{Body, Document};
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
    line("materials", format_args!("{}", document.materials.len()))?;
    let lights: Vec<&str> = document.lights.iter().map(|light| light.name()).collect();
    line("lights", format_args!("{} {}", lights.len(), listed(&lights)))?;
    if let Some(size) = document.size {
        line("size", format_args!("{size}"))?;
    }
    line("depth", format_args!("{}", document.rules.depth))?;
    line("paths", format_args!("{}", super::covered(&document, document.rules.depth)))?;
    if let Some(bounds) = document.bounds() {
        let [low, high] = [bounds.low, bounds.high].map(|p| p.map(|x| format!("{x:.4}")).join(" "));
        let planes = document.shapes.iter().any(|s| matches!(s.body, Body::Plane { .. }));
        let beyond = if planes { ", and endless planes" } else { "" };
        line("extent", format_args!("{low} to {high}{beyond}"))?;
    }
    fits::<f32>(&document, file)?;
    fits::<Fixed>(&document, file)
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

/// Whether an arithmetic can hold the scene, and how it is placed.
fn fits<A: Construct>(document: &Document, file: &Path) -> Result<(), Failure> {
    match Baked::<A>::new(document) {
        Err(flaw) => line(A::NAME, format_args!("no: {}", flaw.of(file))),
        Ok(baked) => {
            let placed = match baked.placement {
                Placement::IDENTITY => "as it is".to_string(),
                Placement { center, log2_scale } => {
                    let center = center.map(|x| x.to_string()).join(" ");
                    format!("scaled by 2^{log2_scale} around {center}")
                }
            };
            let tree = match baked.tree() {
                Some((words, levels)) => format!("octree {} bytes, {levels} levels", 4 * words),
                None => "no octree".to_string(),
            };
            line(A::NAME, format_args!("yes, {placed}; {tree}"))
        }
    }
}

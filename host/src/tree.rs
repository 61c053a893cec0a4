//! The tree of rays of one pixel, as `whitted trace` shows it.

use std::fmt;

use whitted::math::{Arithmetic, Rgb};
use whitted::scene::View;
use whitted::shape::Ray;
use whitted::tally::{Counts, RayKind, Tally, Term};
use whitted::trace::{Tracer, Work};

use crate::bake::{Baked, Construct};
use crate::document::{Indirect, Size};
use crate::error::Flaw;
use crate::indirect::Pools;
use crate::number::{radiance, to_f64};
use crate::render::MAX_DEPTH;

/// A ray of the tree, with what it found.
#[derive(Clone, Debug)]
pub struct Branch {
    /// What it was sent for.
    pub kind: RayKind,
    /// The camera's ray has depth 1.
    pub depth: u8,
    /// The product of the coefficients down the tree.
    pub weight: [f64; 3],
    /// The shape it hit, by its number in the core's scene, and how far away.
    pub hit: Option<(u32, f64)>,
    /// What it adds to the pixel, weight included.
    pub terms: Vec<(Term, [f64; 3])>,
}

/// The rays of a pixel, each before those that it caused.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// The rays.
    pub branches: Vec<Branch>,
    /// The pixel's radiance.
    pub sum: [f64; 3],
    /// What each hit shape is called.
    names: Vec<(u32, String)>,
}

impl Tally for Tree {
    fn ray<A: Arithmetic>(&mut self, kind: RayKind, depth: u8, _: &Ray<A>, w: &Rgb<A::Weight>) {
        let weight = w.map(to_f64);
        self.branches.push(Branch { kind, depth, weight, hit: None, terms: Vec::new() });
    }

    fn hit<A: Arithmetic>(&mut self, kind: RayKind, shape: u32, distance: A::Length) {
        if let Some(branch) = self.branches.iter_mut().rev().find(|b| b.kind == kind) {
            branch.hit = Some((shape, to_f64(distance)));
        }
    }

    fn term<A: Arithmetic>(&mut self, term: Term, value: &Rgb<A::Radiance>) {
        // Shadow rays have no terms: what a light gives belongs to the ray that found the point.
        let owner = self.branches.iter_mut().rev().find(|b| b.kind != RayKind::Shadow);
        if let Some(branch) = owner {
            branch.terms.push((term, radiance::<A>(value)));
        }
    }
}

/// Traces the ray through the centre of a pixel, with what light surfaces send each other.
///
/// # Errors
/// The arithmetic can't hold the camera.
pub fn tree<A: Construct>(
    baked: &Baked<A>,
    size: Size,
    depth: u8,
    (x, y): (u32, u32),
    indirect: Option<Indirect>,
) -> Result<Tree, Flaw> {
    let view = View::new(&baked.camera(size)?, size.width as u16, size.height as u16);
    let row = view.row(y as u16, 128);
    let ray = view.ray(&row, x as u16, 128);
    let mut tree = Tree::default();
    let mut work = Work::<A, MAX_DEPTH>::new();
    let camera = baked.camera(size)?;
    let mut made = Counts::default();
    let sum = baked.with_scene(|scene| {
        let mut pools = Pools::default();
        let lit = pools.light(baked, scene, &camera, size, indirect, &mut made)?;
        let x = x as u16;
        let tracer = Tracer::new(&lit, depth).with_key(row.key(x, 128)).with_turn(row.in_tile(x));
        Ok::<_, Flaw>(tracer.radiance(ray, &mut work, &mut tree))
    })??;
    tree.sum = radiance::<A>(&sum);
    for branch in &mut tree.branches {
        let Some((shape, distance)) = &mut branch.hit else { continue };
        *distance /= baked.placement.scale();
        let name = baked.origin(*shape).map(|(shape, file)| {
            let material = baked.document().materials.get(shape.material);
            let name = material.map_or("", |m| &m.name);
            let of = if name.is_empty() { String::new() } else { format!(" of \"{name}\"") };
            let file = file.map_or(String::new(), |file| format!("{}, ", file.display()));
            format!("{}{of}, {file}line {}", shape.body.name(), shape.line)
        });
        tree.names.push((*shape, name.unwrap_or_default()));
    }
    Ok(tree)
}

struct Color<'c>(&'c [f64; 3]);

impl fmt::Display for Color<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b] = self.0;
        write!(f, "{r:.4} {g:.4} {b:.4}")
    }
}

impl fmt::Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for branch in &self.branches {
            let kind = match branch.kind {
                RayKind::Primary => "primary",
                RayKind::Reflection => "reflection",
                RayKind::Transmission => "transmission",
                RayKind::Shadow => "shadow",
                RayKind::Ambient => "ambient",
            };
            // A shadow ray has the depth of the ray that found the point.
            let under = usize::from(branch.kind == RayKind::Shadow);
            let indent = 2 * (usize::from(branch.depth.max(1)) - 1 + under);
            write!(f, "{:indent$}{kind}, depth {}", "", branch.depth)?;
            if branch.kind != RayKind::Shadow {
                write!(f, ", weight {}", Color(&branch.weight))?;
            }
            match (branch.hit, branch.kind) {
                (Some((shape, distance)), kind) => {
                    let name = self.names.iter().find(|(id, _)| *id == shape);
                    let name = name.map_or("", |(_, name)| name);
                    let verb = if kind == RayKind::Shadow { "blocked by" } else { "hits" };
                    writeln!(f, ": {verb} {name}, at {distance:.6}")?;
                }
                (None, RayKind::Shadow) => writeln!(f, ": free")?,
                (None, _) => writeln!(f, ": hits nothing")?,
            }
            for (term, value) in &branch.terms {
                let name = match term {
                    Term::Background => "background".to_string(),
                    Term::Emission => "emission".to_string(),
                    Term::Ambient => "ambient".to_string(),
                    Term::Indirect => "indirect".to_string(),
                    Term::Direct { light } => format!("light {light}"),
                };
                writeln!(f, "{:indent$}  + {}  {name}", "", Color(value))?;
            }
        }
        writeln!(f, "= {}", Color(&self.sum))
    }
}

//! `whitted trace`: the tree of rays of one pixel.

use std::path::PathBuf;

use whitted::math::Fixed;
use whitted_host::bake::{Baked, Construct};
use whitted_host::document::{Document, Indirect, Size};
use whitted_host::error::Flaw;
use whitted_host::read;
use whitted_host::tree::{Tree, tree};

use super::{Arith, Failure, With, print};

#[derive(clap::Args)]
pub(super) struct Options {
    /// The scene: .toml, .nff, .obj, .gltf or .glb
    scene: PathBuf,
    /// The pixel's column, from 0 at the left
    x: u32,
    /// The pixel's row, from 0 at the top
    y: u32,
    #[command(flatten)]
    with: With,
}

pub(super) fn run(options: &Options) -> Result<(), Failure> {
    let document = read::read(&options.scene)?;
    let size = options.with.size.or(document.size).unwrap_or(super::render::SIZE);
    let (x, y) = (options.x, options.y);
    if x >= size.width || y >= size.height {
        return Err(Failure::Input(format!(
            "pixel {x} {y} is outside the picture: its size is {size}, pixels count from 0"
        )));
    }
    let depth = options.with.depth.unwrap_or(document.rules.depth);
    let indirect = options.with.indirect(&document);
    let tree = match options.with.arith {
        Arith::Fixed => tree_in::<Fixed>(&document, size, depth, (x, y), indirect),
        Arith::F32 => tree_in::<f32>(&document, size, depth, (x, y), indirect),
        Arith::F64 => tree_in::<f64>(&document, size, depth, (x, y), indirect),
    };
    print(format_args!("{}", tree.map_err(|flaw| flaw.of(&options.scene))?))
}

fn tree_in<A: Construct>(
    document: &Document,
    size: Size,
    depth: u8,
    pixel: (u32, u32),
    indirect: Option<Indirect>,
) -> Result<Tree, Flaw> {
    tree(&Baked::<A>::new(document)?, size, depth, pixel, indirect)
}

//! `whitted bake`: a scene in the form that firmware takes in.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use whitted::math::Fixed;
use whitted_host::bake::{Baked, Construct, Placement, Thrift, parts_of};
use whitted_host::document::{Document, Size};
use whitted_host::error::Flaw;
use whitted_host::need;
use whitted_host::picture::save;
use whitted_host::read;

use super::{Failure, print, room_for, warn};

#[derive(clap::Args)]
pub(super) struct Options {
    /// The scene: .toml, .nff, .obj, .gltf or .glb
    scene: PathBuf,
    /// Where it goes: .bin for a blob that is read in place, .rs for Rust source [default: the
    /// scene's name with .bin, here]
    #[arg(short, long)]
    out: Option<PathBuf>,
    /// The numbers that the chip computes with
    #[arg(long, value_enum, default_value = "fixed")]
    arith: BakedArith,
    /// The picture's size, in pixels [default: the scene's, or 320x240]
    #[arg(long, value_name = "WxH", value_parser = super::size)]
    size: Option<Size>,
}

#[derive(Clone, Copy, ValueEnum)]
enum BakedArith {
    /// Fixed point, for chips without a floating-point unit
    Fixed,
    /// Single precision, for those with one
    F32,
}

pub(super) fn run(options: &Options, quiet: bool) -> Result<(), Failure> {
    let document = read::read(&options.scene)?;
    if !quiet {
        warn(&options.scene, &document);
    }
    let name = || Path::new(options.scene.file_stem().unwrap_or_default()).with_extension("bin");
    let out = options.out.clone().unwrap_or_else(name);
    let size = options.size.or(document.size).unwrap_or(super::render::SIZE);
    let source = match out.extension().and_then(|ending| ending.to_str()) {
        Some("rs") => true,
        Some("bin") => false,
        _ => {
            let words = format!("{}: its name must end in .bin or .rs", out.display());
            return Err(Failure::Input(words));
        }
    };
    room_for(&out)?;
    let file = options.scene.file_name().unwrap_or_default().to_string_lossy();
    let (bytes, said) = match options.arith {
        BakedArith::Fixed => bake::<Fixed>(&document, &file, size, source),
        BakedArith::F32 => bake::<f32>(&document, &file, size, source),
    }
    .map_err(|flaw| flaw.of(&options.scene))?;
    save(&out, |to| to.write_all(&bytes)).map_err(|error| Failure::Output(out.clone(), error))?;
    if quiet {
        return Ok(());
    }
    print(format_args!("{said}{}\n", out.display()))
}

/// The file, and what to say of it.
fn bake<A: Construct>(
    document: &Document,
    name: &str,
    size: Size,
    source: bool,
) -> Result<(Vec<u8>, String), Flaw> {
    let baked = Baked::<A>::with(document, Thrift::Flash)?;
    let mut said = String::new();
    let (bytes, all) = if source {
        let mut all = 0;
        let mut say = |what: &str, bytes: usize| {
            all += bytes;
            let _ = writeln!(said, "{bytes:>9} bytes  {what}");
        };
        for (what, bytes) in need::flash(&baked)? {
            say(what, bytes);
        }
        let glow = baked.glow(size)?;
        if let Some((what, count, bytes)) = glow.size::<A>() {
            say(&format!("{count} {what}"), bytes);
        }
        (baked.source_with(name, size, &glow)?.into_bytes(), all)
    } else {
        let flash = baked.blob(size)?;
        for (what, count, bytes) in parts_of::<A>(&flash.counts) {
            let _ = writeln!(said, "{bytes:>9} bytes  {count} {what}");
        }
        let all = flash.bytes.len();
        (flash.bytes, all)
    };
    let each = all as f64 / baked.document().shapes.len().max(1) as f64;
    let _ = writeln!(said, "{all:>9} bytes in all, {each:.1} a shape");
    if baked.placement != Placement::IDENTITY {
        let _ = writeln!(said, "{}, for the range of {}", baked.placement, A::NAME);
    }
    Ok((bytes, said))
}

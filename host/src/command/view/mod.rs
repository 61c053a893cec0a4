//! `whitted view`: a window in which the picture refines, and around which one goes.

mod keys;
mod orbit;
mod pace;
mod window;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use whitted::math::Fixed;
use whitted_host::bake::{Baked, Construct};
use whitted_host::document::{Document, Size};
use whitted_host::need::{self, Board};
use whitted_host::read;
use whitted_host::render::{Colors, Sampling, Settings, live};
use whitted_host::sampling;

use super::{Arith, Failure, print, warn};
use window::Viewer;

/// The blocks that a picture from coarse to fine begins with.
const FIRST_BLOCKS: u8 = 16;

#[derive(clap::Args)]
pub(super) struct Options {
    /// The scene: .toml, .nff, .obj, .gltf or .glb
    scene: PathBuf,
    /// Where the key S saves the picture [default: the scene's name with .png, here]
    #[arg(short, long)]
    out: Option<PathBuf>,
    /// The picture's size, in pixels [default: the scene's, or 320x240]
    #[arg(long, value_name = "WxH", value_parser = super::size)]
    size: Option<Size>,
    /// The numbers to compute with [default: the board's, or f64]
    #[arg(long, value_enum)]
    arith: Option<Arith>,
    /// The deepest tree of rays; the camera's ray has depth 1 [default: the scene's]
    #[arg(long, value_parser = clap::value_parser!(u8).range(1..=64))]
    depth: Option<u8>,
    /// Where rays go, as for render [default: the scene's, or center]
    #[arg(long, value_name = "HOW", value_parser = sampling::parse)]
    sampling: Option<Sampling>,
    /// Imitate a display of this size, with colours of 16 bits
    #[arg(long, value_name = "WxH", value_parser = super::size, conflicts_with = "size")]
    display: Option<Size>,
    /// Draw row by row, one ray a pixel, no faster than an SPI of this clock carries 16 bits a pixel
    #[arg(long, value_name = "MHZ", value_parser = pace::megahertz, conflicts_with = "sampling")]
    spi_mhz: Option<f64>,
    /// Draw row by row, one ray a pixel, no faster than this board would, as check estimates it: pico,
    /// pico2, f411, …
    #[arg(long, value_name = "NAME", value_parser = pace::board, conflicts_with = "sampling")]
    board: Option<&'static Board>,
}

impl Options {
    fn arith(&self) -> Arith {
        self.arith.unwrap_or(match self.board.map(|board| board.arithmetic) {
            Some("fixed") => Arith::Fixed,
            Some("f32") => Arith::F32,
            _ => Arith::F64,
        })
    }

    fn is_paced(&self) -> bool {
        self.board.is_some() || self.spi_mhz.is_some()
    }

    fn settings(&self, document: &Document) -> Settings {
        let size = self.display.or(self.size).or(document.size).unwrap_or(super::render::SIZE);
        let sampling = self.sampling.unwrap_or(document.rules.sampling);
        Settings {
            size,
            depth: self.depth.unwrap_or(document.rules.depth),
            sampling: if self.is_paced() { Sampling::Center } else { sampling },
            indirect: document.indirect,
            show: None,
            threads: NonZeroUsize::MIN,
        }
    }
}

pub(super) fn run(options: &Options, quiet: bool) -> Result<(), Failure> {
    let document = read::read(&options.scene)?;
    if !quiet {
        warn(&options.scene, &document);
    }
    window::is_possible()?;
    match options.arith() {
        Arith::Fixed => view::<Fixed>(&document, options, quiet),
        Arith::F32 => view::<f32>(&document, options, quiet),
        Arith::F64 => view::<f64>(&document, options, quiet),
    }
}

fn view<A: Construct>(document: &Document, options: &Options, quiet: bool) -> Result<(), Failure> {
    let file = &options.scene;
    let settings = options.settings(document);
    let baked = Baked::<A>::new(document).map_err(|flaw| flaw.of(file))?;
    let seconds = match options.board {
        None => pace::seconds(None, options.spi_mhz),
        Some(board) => {
            let pixel = need::pixel(&baked, settings.size, settings.depth);
            let pixel = pixel.map_err(|flaw| flaw.of(file))?;
            pace::seconds(Some((board, pixel)), options.spi_mhz)
        }
    };
    let stem = file.file_stem().unwrap_or_default();
    let out = options.out.clone().unwrap_or_else(|| Path::new(stem).with_extension("png"));
    let name = stem.to_string_lossy();
    let mut viewer = Viewer::open(document.camera, settings.size, &name, out, quiet)?;
    if !quiet {
        print(format_args!("{}\n", keys::HELP))?;
        if options.is_paced() {
            let pixels = f64::from(settings.size.width) * f64::from(settings.size.height);
            let time = seconds * pixels * 1e3;
            print(format_args!("a frame in {time:.0} ms, estimated\n"))?;
        }
    }
    viewer.pace(seconds);
    let colors = if options.display.is_some() { Colors::Rgb565 } else { Colors::Rgb888 };
    let side = if options.is_paced() { 1 } else { FIRST_BLOCKS };
    live(&baked, &settings, side, colors, &mut viewer).map_err(|flaw| flaw.of(file))?;
    viewer.close()
}

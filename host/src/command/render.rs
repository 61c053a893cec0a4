//! `whitted render`, and `whitted` alone.

use std::io::{IsTerminal, stdout};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;

use whitted::math::Fixed;
use whitted::trace::{Paths, Terms};
use whitted_host::bake::{Baked, Construct};
use whitted_host::document::{Document, Size};
use whitted_host::error::Flaw;
use whitted_host::picture::{Picture, save};
use whitted_host::read;
use whitted_host::render::{Progress, Rendered, Sampling, Settings, render, render_until};
use whitted_host::sampling;
use whitted_host::stats::{Seconds, Stats};

use super::{Arith, Failure, ShowName, With, print, progress, room_for, warn};

/// How large a picture is if neither the command nor the scene says.
pub(super) const SIZE: Size = Size { width: 320, height: 240 };

/// The blocks that a picture from coarse to fine begins with.
const FIRST_BLOCKS: u8 = 16;

const SHOWCASE: &str = include_str!("../../scenes/showcase.toml");

#[derive(clap::Args)]
pub(super) struct Options {
    /// The scene: .toml, .nff, .obj, .gltf or .glb
    scene: PathBuf,
    /// Where the picture goes; - is standard output [default: the scene's name with .png, here]
    #[arg(short, long)]
    out: Option<PathBuf>,
    #[command(flatten)]
    with: With,
    /// Where rays go: center (one through each pixel), corners (one through each pixel corner, four
    /// averaged), grid:N (N×N a pixel, 1 to 8), jittered:N[:SEED] (moved at random),
    /// adaptive[:DEPTH[:THRESHOLD]] (more where the picture changes), sparse[:SIDE[:THRESHOLD]] (fewer
    /// where it doesn't) [default: the scene's, or center]
    #[arg(long, value_name = "HOW", value_parser = sampling::parse)]
    sampling: Option<Sampling>,
    /// Draw from coarse to fine, stop after this many rays of all kinds, and save what a display would
    /// show then
    #[arg(long, value_name = "RAYS", conflicts_with_all = ["show", "threads"])]
    deadline: Option<u64>,
    /// How many threads trace; the picture is the same for any number [default: one for each core]
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Which terms of radiance the picture shows, as in direct,specular: emission, ambient, direct,
    /// highlight, indirect, background, reflection, transmission, specular (both), all [default: the
    /// scene's, or all]
    #[arg(long, value_name = "TERMS", value_parser = whitted_host::terms::parse)]
    terms: Option<Terms>,
    /// Write ray counts and times to a file, as JSON
    #[arg(long, value_name = "FILE")]
    stats: Option<PathBuf>,
    /// Show something else than the scene
    #[arg(long, value_enum)]
    show: Option<ShowName>,
}

pub(super) fn run(options: &Options, quiet: bool) -> Result<(), Failure> {
    let start = Instant::now();
    let mut document = read::read(&options.scene)?;
    document.rules.terms = options.terms.unwrap_or(document.rules.terms);
    let load = start.elapsed().as_secs_f64();
    if !quiet {
        warn(&options.scene, &document);
    }
    let name = || Path::new(options.scene.file_stem().unwrap_or_default()).with_extension("png");
    let out = options.out.clone().unwrap_or_else(name);
    room_for(&out)?;
    options.stats.as_deref().map_or(Ok(()), room_for)?;
    paint(&document, &options.scene, options, &out, load, quiet)
}

/// What `whitted` does alone: the scene that is built into it.
pub(super) fn showcase(quiet: bool) -> Result<(), Failure> {
    let file = PathBuf::from("showcase.toml");
    let document = read::parse(read::Format::Toml, SHOWCASE.as_bytes()).map_err(|f| f.of(&file))?;
    let options = Options {
        scene: file.clone(),
        out: None,
        with: With { size: None, arith: Arith::F64, depth: None, indirect: None },
        sampling: None,
        deadline: None,
        threads: None,
        terms: None,
        stats: None,
        show: None,
    };
    paint(&document, &file, &options, Path::new("whitted.png"), 0.0, quiet)
}

fn paint(
    document: &Document,
    file: &Path,
    options: &Options,
    out: &Path,
    load: f64,
    quiet: bool,
) -> Result<(), Failure> {
    let settings = Settings {
        size: options.with.size.or(document.size).unwrap_or(SIZE),
        depth: options.with.depth.unwrap_or(document.rules.depth),
        sampling: options.sampling.unwrap_or(document.rules.sampling),
        indirect: options.with.indirect(document),
        show: options.show.map(Into::into),
        threads: options
            .threads
            .or_else(|| std::thread::available_parallelism().ok())
            .unwrap_or(NonZeroUsize::MIN),
    };
    let Painted { rendered, arithmetic, build, note } = match options.with.arith {
        Arith::Fixed => paint_in::<Fixed>(document, &settings, options.deadline, quiet),
        Arith::F32 => paint_in::<f32>(document, &settings, options.deadline, quiet),
        Arith::F64 => paint_in::<f64>(document, &settings, options.deadline, quiet),
    }
    .map_err(|flaw| flaw.of(file))?;

    let paths = super::covered(document, settings.depth, settings.indirect);
    let picture = &rendered.picture;
    let to_stdout = out == Path::new("-");
    let written = if to_stdout { picture.write_png(stdout().lock()) } else { picture.save(out) };
    written.map_err(|error| Failure::Output(out.into(), error))?;
    let seconds = Seconds { load, build, render: rendered.time.as_secs_f64() };
    if let Some(path) = &options.stats {
        let stats = Stats::new(settings.size, arithmetic, paths, &rendered.counts, seconds);
        save(path, |to| serde_json::to_writer_pretty(to, &stats).map_err(Into::into))
            .map_err(|error| Failure::Output(path.into(), error))?;
    }
    if quiet || to_stdout {
        return Ok(());
    }
    if stdout().is_terminal() {
        print(format_args!("{}", preview(picture)))?;
    }
    report(&rendered, arithmetic, paths, seconds)?;
    print(format_args!("{note}"))?;
    print(format_args!("{}\n", out.display()))
}

/// What there is to say of a cache that the scene gave too few records.
const FULL: &str = "the irradiance cache is full: where no record reaches, the nearest stands in \
                    (`records` in [indirect])\n";

/// A picture, what made it, how long it took to make the scene, and what else there is to say.
struct Painted {
    rendered: Rendered,
    arithmetic: &'static str,
    build: f64,
    note: String,
}

fn paint_in<A: Construct>(
    document: &Document,
    settings: &Settings,
    deadline: Option<u64>,
    quiet: bool,
) -> Result<Painted, Flaw> {
    let start = Instant::now();
    let baked = Baked::<A>::new(document)?;
    let build = start.elapsed().as_secs_f64();
    let (rendered, note) = match deadline {
        None => {
            let bar = progress::bar(settings.size.height, quiet);
            let rendered = render(&baked, settings, |row| bar.set_position(row.into()))?;
            bar.finish_and_clear();
            (rendered, String::new())
        }
        Some(rays) => {
            let shown = render_until(&baked, settings, FIRST_BLOCKS, rays)?;
            let note = match (shown.progress, shown.side) {
                (Progress::Done, _) => "the picture is finished\n".into(),
                (Progress::Interrupted, 0) => "the deadline came in the last pass\n".into(),
                (Progress::Interrupted, side) => {
                    format!("the deadline came in the pass of {side}x{side} blocks\n")
                }
            };
            (shown.rendered, note)
        }
    };
    let full = if rendered.full { FULL } else { "" };
    Ok(Painted { rendered, arithmetic: A::NAME, build, note: note + full })
}

/// The picture, as large as the terminal lets it be with room for the text below.
fn preview(picture: &Picture) -> String {
    // A terminal that doesn't know its size says 0.
    let known = terminal_size::terminal_size().filter(|(w, h)| w.0 > 0 && h.0 > 0);
    let (columns, lines) = known.map_or((80, 24), |(w, h)| (w.0, h.0));
    picture.to_terminal(columns.into(), lines.saturating_sub(5).max(10).into())
}

fn report(
    rendered: &Rendered,
    arithmetic: &str,
    paths: Paths,
    seconds: Seconds,
) -> Result<(), Failure> {
    let counts = &rendered.counts;
    let size = rendered.picture.size();
    print(format_args!(
        "{size}, {arithmetic}: {:.2} s ({:.2} s to build the scene)\n",
        seconds.render, seconds.build
    ))?;
    let ambient = match counts.ambient {
        0 => String::new(),
        ambient => format!(", {ambient} ambient"),
    };
    print(format_args!(
        "{} rays: {} primary, {} reflection, {} transmission, {} shadow{ambient}\n",
        counts.rays(),
        counts.primary,
        counts.reflection,
        counts.transmission,
        counts.shadow
    ))?;
    print(format_args!("paths {paths}\n"))
}

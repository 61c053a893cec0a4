//! What the command line says, and which command does it.

mod bake;
mod check;
mod progress;
mod render;
mod trace;
#[cfg(feature = "window")]
mod view;

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand, ValueEnum};
use whitted::trace::{Paths, Terms};
use whitted_host::document::{Cache, Document, Indirect, Size, VirtualLights};
use whitted_host::error::SceneError;
use whitted_host::show::Show;

/// Classic ray tracing for microcontrollers, on the host: renders, checks and explains scenes.
///
/// Without a command it renders the showcase: into the terminal and into whitted.png.
#[derive(Parser)]
#[command(version, name = "whitted")]
struct Line {
    #[command(subcommand)]
    command: Option<Command>,
    /// Say nothing that isn't an error
    #[arg(short, long, global = true)]
    quiet: bool,
}

#[derive(Subcommand)]
enum Command {
    /// Render a scene to a PNG
    Render(render::Options),
    /// Read and validate a scene, and say what is in it
    Check {
        /// The scene: .toml, .nff, .obj, .gltf or .glb
        scene: PathBuf,
    },
    /// Print the tree of rays of one pixel
    Trace(trace::Options),
    #[cfg(feature = "window")]
    /// Open a window in which the picture refines, and orbit around the scene
    View(view::Options),
    /// Turn a scene into what firmware takes in, and say how much flash it takes
    Bake(bake::Options),
}

/// What a scene is rendered with.
#[derive(Args, Clone)]
struct With {
    /// The picture's size, in pixels [default: the scene's, or 320x240]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Size>,
    /// The numbers to compute with
    #[arg(long, value_enum, default_value = "f64")]
    arith: Arith,
    /// The deepest tree of rays; the camera's ray has depth 1 [default: the scene's]
    #[arg(long, value_parser = clap::value_parser!(u8).range(1..=64))]
    depth: Option<u8>,
    /// The light that surfaces send each other, with the scene's settings of it or the usual ones
    /// [default: the scene's]
    #[arg(long, value_enum)]
    indirect: Option<IndirectName>,
}

impl With {
    fn indirect(&self, document: &Document) -> Option<Indirect> {
        match (self.indirect, document.indirect) {
            (None, scenes) => scenes,
            (Some(IndirectName::None), _) => None,
            (Some(IndirectName::Cache), Some(cache @ Indirect::Cache(_))) => Some(cache),
            (Some(IndirectName::Cache), _) => Some(Indirect::Cache(Cache::DEFAULT)),
            (Some(IndirectName::VirtualLights), Some(lights @ Indirect::VirtualLights(_))) => {
                Some(lights)
            }
            (Some(IndirectName::VirtualLights), _) => {
                Some(Indirect::VirtualLights(VirtualLights::DEFAULT))
            }
        }
    }
}

#[derive(Clone, Copy, ValueEnum)]
enum IndirectName {
    /// The constant ambient term
    None,
    /// Irradiance records, interpolated
    Cache,
    /// Virtual lights where paths from the lights arrive
    VirtualLights,
}

#[derive(Clone, Copy, ValueEnum)]
enum Arith {
    /// Fixed point, as on chips without a floating-point unit
    Fixed,
    /// Single precision, as on chips with one
    F32,
    /// Double precision, the reference
    F64,
}

#[derive(Clone, Copy, ValueEnum)]
enum ShowName {
    /// Distances, near ones bright
    Depth,
    /// Normals, x y z as red green blue
    Normal,
    /// Rays each pixel took
    Rays,
    /// Nodes of the octree each pixel visited
    Octree,
}

impl From<ShowName> for Show {
    fn from(name: ShowName) -> Self {
        match name {
            ShowName::Depth => Self::Depth,
            ShowName::Normal => Self::Normal,
            ShowName::Rays => Self::Rays,
            ShowName::Octree => Self::Octree,
        }
    }
}

/// The paths of light that pictures of a scene cover: interreflection instead of the ambient term,
/// where there is any.
fn covered(document: &Document, depth: u8, indirect: Option<Indirect>) -> Paths {
    let replaced = if indirect.is_some() { Terms::AMBIENT } else { Terms::INDIRECT };
    document.rules.terms.without(replaced).paths(depth)
}

fn size(text: &str) -> Result<Size, String> {
    let side = |t: &str| t.parse().ok().filter(|n| (1..=Size::LARGEST).contains(n));
    text.split_once('x')
        .and_then(|(w, h)| Some(Size { width: side(w)?, height: side(h)? }))
        .ok_or_else(|| format!("write WxH, each 1 to {}, as in 320x240", Size::LARGEST))
}

/// Why a command didn't do what it should.
enum Failure {
    /// The input is at fault.
    Scene(SceneError),
    /// Something else about the input, in words.
    Input(String),
    /// The result can't be written.
    Output(PathBuf, io::Error),
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::Scene(error)
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Input(words) => f.write_str(words),
            Self::Output(path, error) => write!(f, "{}: can't be written: {error}", path.display()),
        }
    }
}

pub(crate) fn main() -> ExitCode {
    let line = Line::parse();
    let done = match line.command {
        None => render::showcase(line.quiet),
        Some(Command::Render(options)) => render::run(&options, line.quiet),
        Some(Command::Check { scene }) => check::run(&scene, line.quiet),
        Some(Command::Trace(options)) => trace::run(&options),
        #[cfg(feature = "window")]
        Some(Command::View(options)) => view::run(&options, line.quiet),
        Some(Command::Bake(options)) => bake::run(&options, line.quiet),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        // The reader of our output has gone: nobody is left to tell.
        Err(Failure::Output(_, error)) if error.kind() == io::ErrorKind::BrokenPipe => {
            ExitCode::SUCCESS
        }
        Err(failure) => {
            eprintln!("whitted: {failure}");
            ExitCode::from(if matches!(failure, Failure::Output(..)) { 1 } else { 2 })
        }
    }
}

/// Whether a file can be where it is to be written, which is asked before anything takes time.
fn room_for(out: &Path) -> Result<(), Failure> {
    let refused =
        |why: String| Err(Failure::Input(format!("{}: can't be written: {why}", out.display())));
    if out.is_dir() {
        return refused("it is a directory; give a file's name".into());
    }
    match out.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            refused(format!("there is no directory {}", folder.display()))
        }
        _ => Ok(()),
    }
}

/// Prints to stdout; `println!` would panic where nobody reads.
fn print(text: fmt::Arguments<'_>) -> Result<(), Failure> {
    use io::Write;
    io::stdout().lock().write_fmt(text).map_err(|error| Failure::Output("stdout".into(), error))
}

/// Says what the reader noticed, on stderr.
fn warn(file: &Path, document: &whitted_host::document::Document) {
    const MOST: usize = 5;
    for warning in document.warnings.iter().take(MOST) {
        // Line 0 is the whole file.
        let line = match warning.line {
            0 => String::new(),
            line => format!("{line}:"),
        };
        eprintln!("{}:{line} warning: {}", file.display(), warning.text);
    }
    if let Some(more) = document.warnings.len().checked_sub(MOST + 1) {
        eprintln!("{}: {} more warnings", file.display(), more + 1);
    }
}

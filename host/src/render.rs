//! Pictures of a baked scene.

use std::time::{Duration, Instant};

pub use whitted::frame::Sampling;
use whitted::frame::{Output, Renderer, Rgb888, Sample};
use whitted::tally::Counts;
use whitted::trace::{Tracer, Work};

use crate::bake::{Baked, Construct};
use crate::document::{Rules, Size};
use crate::error::{Flaw, Problem};
use crate::picture::Picture;
use crate::show::{self, Show};

/// The deepest tree of rays that any scene can ask for.
pub(crate) const MAX_DEPTH: usize = Rules::DEEPEST as usize;

/// How to render.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// The picture's size.
    pub size: Size,
    /// The largest depth of a tree of rays; the camera's ray has depth 1.
    pub depth: u8,
    /// Where in a pixel rays go.
    pub sampling: Sampling,
    /// What the picture shows instead of the scene.
    pub show: Option<Show>,
}

impl Settings {
    fn for_core(&self) -> whitted::frame::Settings {
        // Larger sizes become one that the core refuses.
        let side = |n: u32| u16::try_from(n).unwrap_or(u16::MAX);
        whitted::frame::Settings {
            depth: self.depth,
            sampling: self.sampling,
            ..whitted::frame::Settings::new(side(self.size.width), side(self.size.height))
        }
    }
}

/// A picture, and what it took.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// The picture.
    pub picture: Picture,
    /// The rays by kind.
    pub counts: Counts,
    /// How long it took.
    pub time: Duration,
}

/// Renders a picture; `progress` is told the number of rows that are done.
///
/// # Errors
/// A size or depth that is out of range, or a camera that the arithmetic can't hold.
pub fn render<A: Construct>(
    baked: &Baked<A>,
    settings: &Settings,
    mut progress: impl FnMut(u32),
) -> Result<Rendered, Flaw> {
    let start = Instant::now();
    let scene = baked.scene()?;
    let camera = baked.camera(settings.size)?;
    let core = settings.for_core();
    let mut work = Work::<A, MAX_DEPTH>::new();
    let mut samples = vec![Sample::NONE; core.sampling.samples(core.width)];
    let counts = Counts::default();
    let mut renderer = Renderer::with_tally(&scene, &camera, core, &mut work, &mut samples, counts)
        .map_err(|error| Problem::Settings(error.to_string()).anywhere())?;
    let mut picture = Picture::new(settings.size);
    if let Some(show) = settings.show {
        let tracer = Tracer::new(&scene, settings.depth);
        show::paint(&mut renderer, &tracer, show, &mut picture, &mut progress);
    } else {
        let mut line = vec![Rgb888::default(); usize::from(core.width)];
        for (y, row) in (0..core.height).zip(picture.rows_mut()) {
            renderer.line(y, &Output::SRGB, &mut line);
            row.iter_mut().zip(&line).for_each(|(to, from)| *to = from.0);
            progress(u32::from(y) + 1);
        }
    }
    let counts = *renderer.tally();
    Ok(Rendered { picture, counts, time: start.elapsed() })
}

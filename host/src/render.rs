//! Pictures of a baked scene.

mod bands;
mod deadline;
mod live;

use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

pub use deadline::{Shown, render_until};
pub use live::{Colors, Next, Watcher, live, shown};
pub use whitted::frame::{Progress, Sampling};
use whitted::frame::{Renderer, Sample};
use whitted::gather;
use whitted::scene::{Camera, Scene};
use whitted::tally::Counts;
use whitted::trace::{Terms, Tracer, Work};

use crate::bake::{Baked, Construct};
use crate::document::{Indirect, Rules, Size};
use crate::error::{Flaw, Problem};
use crate::indirect::Pools;
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
    /// The light that surfaces send each other.
    pub indirect: Option<Indirect>,
    /// What the picture shows instead of the scene.
    pub show: Option<Show>,
    /// How many threads trace; the picture and the counts are the same for any number.
    pub threads: NonZeroUsize,
}

impl Settings {
    pub(crate) fn for_core(&self, terms: Terms) -> whitted::frame::Settings {
        // Larger sizes become one that the core refuses.
        let side = |n: u32| u16::try_from(n).unwrap_or(u16::MAX);
        whitted::frame::Settings {
            depth: self.depth,
            sampling: self.sampling,
            terms,
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
    /// Those of them that made irradiance records or virtual lights, before the picture.
    pub made: Counts,
    /// Whether the irradiance cache had no room for all the records that were wanted.
    pub full: bool,
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
    progress: impl FnMut(u32),
) -> Result<Rendered, Flaw> {
    let camera = baked.camera(settings.size)?;
    let terms = baked.document().rules.terms;
    baked.with_scene(|scene| {
        let start = Instant::now();
        let (mut pools, mut made) = (Pools::default(), Counts::default());
        let wanted = settings.indirect.filter(|_| settings.show.is_none());
        let lit = pools.light(baked, scene, &camera, settings.size, wanted, &mut made)?;
        let rendered = render_scene(&lit, &camera, settings, terms, progress)?;
        Ok(rendered.after(&lit, made, start))
    })?
}

impl Rendered {
    /// With what it took to make the scene's indirect light before, from `start` on.
    fn after<A: Construct>(mut self, scene: &Scene<'_, A>, made: Counts, start: Instant) -> Self {
        self.counts += made;
        self.made = made;
        self.full =
            matches!(&scene.parts().indirect, gather::Indirect::Cache(cache) if cache.is_full());
        self.time = start.elapsed();
        self
    }
}

fn render_scene<A: Construct>(
    scene: &Scene<'_, A>,
    camera: &Camera<A>,
    settings: &Settings,
    terms: Terms,
    mut progress: impl FnMut(u32),
) -> Result<Rendered, Flaw> {
    let start = Instant::now();
    let core = settings.for_core(terms);
    let mut picture = Picture::new(settings.size);
    let counts = if let Some(show) = settings.show {
        with_renderer(scene, camera, core, |renderer| {
            let tracer = Tracer::new(scene, settings.depth);
            show::paint(renderer, &tracer, show, &mut picture, &mut progress);
            *renderer.tally()
        })?
    } else {
        bands::paint(scene, camera, core, settings.threads, &mut picture, &mut progress)?
    };
    let made = Counts::default();
    Ok(Rendered { picture, counts, made, full: false, time: start.elapsed() })
}

/// Calls `act` with a renderer and the memory that it needs.
fn with_renderer<A: Construct, R>(
    scene: &Scene<'_, A>,
    camera: &Camera<A>,
    settings: whitted::frame::Settings,
    act: impl FnOnce(&mut Renderer<'_, A, MAX_DEPTH, Counts>) -> R,
) -> Result<R, Flaw> {
    let mut work = Work::<A, MAX_DEPTH>::new();
    let mut samples = vec![Sample::NONE; settings.sampling.samples(settings.width)];
    let counts = Counts::default();
    Renderer::with_tally(scene, camera, settings, &mut work, &mut samples, counts)
        .map(|mut renderer| act(&mut renderer))
        .map_err(|error| Problem::Settings(error.to_string()).anywhere())
}

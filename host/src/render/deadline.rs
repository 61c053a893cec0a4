//! Pictures from coarse to fine, as far as a number of rays goes: what a display would show.

use std::time::Instant;

use whitted::frame::{Output, Passes, Progress, Rgb888};
use whitted::scene::{Camera, Scene};
use whitted::tally::Counts;

use super::{Rendered, Settings, with_renderer};
use crate::bake::{Baked, Construct};
use crate::document::Size;
use crate::error::{Flaw, Problem};
use crate::indirect::Pools;
use crate::picture::Picture;

/// What the screen shows at the deadline.
#[derive(Clone, Debug)]
pub struct Shown {
    /// The screen, and what it took.
    pub rendered: Rendered,
    /// Whether the picture is finished.
    pub progress: Progress,
    /// The pass that was being painted: the side of its blocks, 0 in a last pass of more rays a pixel.
    pub side: u8,
}

/// Renders from coarse to fine, from blocks of `side` pixels, until so many rays have been sent. Those
/// that make irradiance records or virtual lights before don't count for that.
///
/// # Errors
/// A size, depth or side that is out of range, or a camera that the arithmetic can't hold.
pub fn render_until<A: Construct>(
    baked: &Baked<A>,
    settings: &Settings,
    side: u8,
    rays: u64,
) -> Result<Shown, Flaw> {
    let camera = baked.camera(settings.size)?;
    let passes =
        Passes::new(side).map_err(|error| Problem::Settings(error.to_string()).anywhere())?;
    let core = settings.for_core(baked.document().rules.terms);
    baked.with_scene(|scene| {
        let start = Instant::now();
        let (mut pools, mut made) = (Pools::default(), Counts::default());
        let lit =
            pools.light(baked, scene, &camera, settings.size, settings.indirect, &mut made)?;
        let shown = draw(&lit, &camera, settings.size, core, passes, rays)?;
        Ok(Shown { rendered: shown.rendered.after(&lit, made, start), ..shown })
    })?
}

fn draw<A: Construct>(
    scene: &Scene<'_, A>,
    camera: &Camera<A>,
    size: Size,
    core: whitted::frame::Settings,
    mut passes: Passes,
    rays: u64,
) -> Result<Shown, Flaw> {
    let start = Instant::now();
    let mut picture = Picture::new(size);
    let (progress, counts) = with_renderer(scene, camera, core, |renderer| {
        let progress = renderer.refine(
            &mut passes,
            &Output::SRGB,
            |counts| counts.rays() >= rays,
            |block| {
                let Rgb888(color) = block.pixel;
                let (left, top) = (usize::from(block.x), usize::from(block.y));
                let rows = picture.rows_mut().skip(top).take(block.height.into());
                rows.for_each(|row| row[left..][..usize::from(block.width)].fill(color));
            },
        );
        (progress, *renderer.tally())
    })?;
    let rendered =
        Rendered { picture, counts, made: Counts::default(), full: false, time: start.elapsed() };
    Ok(Shown { rendered, progress, side: passes.side() })
}

//! Pictures of something else than the scene: what `--show` offers.

use whitted::frame::Renderer;
use whitted::scene::Scene;
use whitted::tally::Counts;
use whitted::trace::{Tracer, Work};

use crate::bake::Construct;
use crate::number::to_f64;
use crate::picture::Picture;
use crate::render::MAX_DEPTH;

/// What a picture shows instead of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Show {
    /// The distance of the nearest hit; near is bright, nothing is black.
    Depth,
    /// The normal there: x, y and z from −1 to 1 as red, green and blue.
    Normal,
    /// How many rays each pixel took.
    Rays,
    /// How many nodes of the octree each pixel visited.
    Octree,
}

/// Paints it, through pixel centres.
pub(crate) fn paint<A: Construct>(
    renderer: &mut Renderer<'_, A, MAX_DEPTH, Counts>,
    tracer: &Tracer<&Scene<'_, A>>,
    show: Show,
    out: &mut Picture,
    progress: &mut dyn FnMut(u32),
) {
    let mut work = Work::<A, 1>::new();
    let mut values: Vec<f64> = Vec::with_capacity(out.pixels().len());
    for (y, pixels) in out.rows_mut().enumerate() {
        for (x, pixel) in pixels.iter_mut().enumerate() {
            let ray = renderer.ray(x as u16, y as u16);
            let before = *renderer.tally();
            match show {
                Show::Depth => {
                    let near = tracer.nearest(&ray, &mut work, renderer.tally_mut());
                    values.push(near.map_or(0.0, |hit| 1.0 / to_f64(hit.distance).max(1e-9)));
                }
                Show::Normal => {
                    let color = |c| ((to_f64(c) * 0.5 + 0.5) * 255.0).round() as u8;
                    let met = tracer.surface(&ray, &mut work, renderer.tally_mut());
                    *pixel = met.map_or([0; 3], |(_, s)| s.normal.map(color));
                }
                Show::Rays => {
                    renderer.radiance(&ray);
                    values.push((renderer.tally().rays() - before.rays()) as f64);
                }
                Show::Octree => {
                    renderer.radiance(&ray);
                    values.push((renderer.tally().nodes - before.nodes) as f64);
                }
            }
        }
        progress(y as u32 + 1);
    }
    let most = values.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let color = if show == Show::Depth { grey } else { heat };
    for (pixel, value) in out.pixels_mut().iter_mut().zip(values) {
        *pixel = color(value / most);
    }
}

fn grey(value: f64) -> [u8; 3] {
    [(value * 255.0).round() as u8; 3]
}

/// Black, blue, red, yellow, white.
fn heat(value: f64) -> [u8; 3] {
    let ramp = |from: f64| ((value - from) * 4.0).clamp(0.0, 1.0);
    let (blue, red, yellow, white) = (ramp(0.0), ramp(0.25), ramp(0.5), ramp(0.75));
    [red, yellow, blue - red + white].map(|c| (c * 255.0).round() as u8)
}

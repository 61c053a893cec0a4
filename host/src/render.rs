//! Pictures of a baked scene.

use std::time::{Duration, Instant};

use whitted::math::{Arithmetic, Rgb, rgb};
use whitted::scene::View;
use whitted::shape::Ray;
use whitted::tally::Counts;
use whitted::trace::{Tracer, Work};

use crate::bake::{Baked, Construct};
use crate::document::{Rules, Size};
use crate::error::Flaw;
use crate::number::to_f64;
use crate::picture::Picture;

/// The deepest tree of rays that any scene can ask for.
const MAX_DEPTH: usize = Rules::DEEPEST as usize;

/// Where in a pixel rays go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// One through each pixel's centre.
    Center,
    /// One through each corner, four averaged to a pixel (SPD's rule).
    Corners,
}

/// What the picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Show {
    /// The scene.
    Radiance,
    /// The distance of the nearest hit, near ones bright.
    Depth,
    /// The normal there, x y z as red green blue.
    Normal,
    /// How many rays each pixel took.
    Rays,
    /// How many nodes of the octree each pixel visited.
    Octree,
}

/// How to render.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// The picture's size.
    pub size: Size,
    /// The largest depth of a tree of rays; the camera's ray has depth 1.
    pub depth: u8,
    /// Where in a pixel rays go.
    pub sampling: Sampling,
    /// What the picture shows.
    pub show: Show,
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
/// The arithmetic can't hold the camera.
pub fn render<A: Construct>(
    baked: &Baked<A>,
    settings: &Settings,
    mut progress: impl FnMut(u32),
) -> Result<Rendered, Flaw> {
    let start = Instant::now();
    let Ok(scene) = baked.scene() else { unreachable!("a baked scene has been checked") };
    let camera = baked.camera(settings.size)?;
    let tracer = Tracer::new(&scene, settings.depth);
    let Size { width, height } = settings.size;
    // Sizes are at most `Size::LARGEST`.
    let view = View::new(&camera, width as u16, height as u16);
    let mut painter =
        Painter { tracer, view, work: Work::new(), counts: Counts::default(), width: width as u16 };
    let mut picture = Picture::new(settings.size);
    if settings.show == Show::Radiance {
        painter.radiance(settings.sampling, &mut picture, &mut progress);
    } else {
        painter.values(settings.show, &mut picture, &mut progress);
    }
    Ok(Rendered { picture, counts: painter.counts, time: start.elapsed() })
}

struct Painter<'a, A: Construct> {
    tracer: Tracer<'a, A>,
    view: View<A>,
    work: Work<A, MAX_DEPTH>,
    counts: Counts,
    width: u16,
}

/// Half a pixel, in the camera's 1/256.
const HALF: u8 = 128;

impl<A: Construct> Painter<'_, A> {
    fn trace(&mut self, ray: &Ray<A>) -> Rgb<A::Radiance> {
        self.tracer.radiance(ray, &mut self.work, &mut self.counts)
    }

    fn radiance(&mut self, sampling: Sampling, out: &mut Picture, progress: &mut dyn FnMut(u32)) {
        let quantum = |c: Rgb<A::Radiance>| c.map(A::to_q16);
        match sampling {
            Sampling::Center => {
                for (y, pixels) in out.rows_mut().enumerate() {
                    let row = self.view.row(y as u16, HALF);
                    for (x, pixel) in pixels.iter_mut().enumerate() {
                        let ray = self.view.ray(&row, x as u16, HALF);
                        *pixel = crate::picture::tone(quantum(self.trace(&ray)));
                    }
                    progress(y as u32 + 1);
                }
            }
            Sampling::Corners => {
                let mut above = self.corners(0);
                for (y, pixels) in out.rows_mut().enumerate() {
                    let below = self.corners(y as u16 + 1);
                    let pairs = above.windows(2).zip(below.windows(2));
                    for (pixel, (a, b)) in pixels.iter_mut().zip(pairs) {
                        let sum =
                            [a[1], b[0], b[1]].iter().fold(a[0], |s, c| rgb(&s, c, A::gather));
                        *pixel = crate::picture::tone(sum.map(|s| A::to_q16(A::mean(s, 4))));
                    }
                    above = below;
                    progress(y as u32 + 1);
                }
            }
        }
    }

    fn corners(&mut self, y: u16) -> Vec<Rgb<A::Radiance>> {
        let row = self.view.row(y, 0);
        (0..=self.width).map(|x| self.trace(&self.view.ray(&row, x, 0))).collect()
    }

    /// A number for each pixel, then shown relative to the largest.
    fn values(&mut self, show: Show, out: &mut Picture, progress: &mut dyn FnMut(u32)) {
        let mut all: Vec<f64> = Vec::new();
        for (y, pixels) in out.rows_mut().enumerate() {
            let row = self.view.row(y as u16, HALF);
            for (x, pixel) in pixels.iter_mut().enumerate() {
                let ray = self.view.ray(&row, x as u16, HALF);
                let before = self.counts;
                match show {
                    Show::Depth => all.push(self.nearness(&ray)),
                    Show::Normal => *pixel = self.normal(&ray),
                    Show::Rays | Show::Radiance => {
                        self.trace(&ray);
                        all.push((self.counts.rays() - before.rays()) as f64);
                    }
                    Show::Octree => {
                        self.trace(&ray);
                        all.push((self.counts.nodes - before.nodes) as f64);
                    }
                }
            }
            progress(y as u32 + 1);
        }
        let most = all.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        for (pixel, value) in out.pixels_mut().iter_mut().zip(all) {
            *pixel = heat(value / most, show);
        }
    }

    /// 1/distance; 0 for a miss.
    fn nearness(&mut self, ray: &Ray<A>) -> f64 {
        let hit = self.tracer.nearest(ray, &mut self.counts);
        hit.map_or(0.0, |hit| 1.0 / to_f64(hit.distance).max(1e-9))
    }

    fn normal(&mut self, ray: &Ray<A>) -> [u8; 3] {
        let _ = self.tracer.nearest(ray, &mut self.counts);
        [0; 3]
    }
}

/// Grey for depth; for counts black, blue, red, yellow, white.
fn heat(value: f64, show: Show) -> [u8; 3] {
    if show == Show::Depth {
        return [(value * 255.0).round() as u8; 3];
    }
    let ramp = |from: f64| ((value - from) * 4.0).clamp(0.0, 1.0);
    let (rise, red, green, white) = (ramp(0.0), ramp(0.25), ramp(0.5), ramp(0.75));
    let blue = rise - red + white;
    [red, green, blue].map(|c| (c * 255.0).round() as u8)
}

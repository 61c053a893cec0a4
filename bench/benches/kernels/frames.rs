//! A frame of each scene, 80×60 pixels, one ray a pixel: the time is a frame's, the rate pixels'.

use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Camera, Scene};
use whitted::trace::Work;

use crate::common::scenes::{self, Shots, Tailored};

const SIZE: (u16, u16) = (80, 60);

/// As deep as those scenes are drawn that aren't among [`Shots`].
fn depth<A: Shots>(name: &str) -> u8 {
    match name {
        "gfxcat" => 2,
        "spheres64" => 1,
        _ => A::SHOTS.iter().find(|shot| shot.name == name).map_or(5, |shot| shot.depth),
    }
}

struct Frames<'a>(BenchmarkGroup<'a, WallTime>);

impl<A: Shots> Tailored<A> for Frames<'_> {
    fn scene<const USES: u64>(
        &mut self,
        name: &str,
        scene: &'static Scene<'static, A, USES>,
        camera: &'static Camera<A>,
    ) {
        let settings = Settings { depth: depth::<A>(name), ..Settings::new(SIZE.0, SIZE.1) };
        self.0.bench_function(name, |bencher| {
            let mut row = [Rgb888::default(); SIZE.0 as usize];
            bencher.iter(|| {
                let mut work = Work::<A, 5>::new();
                let mut renderer = Renderer::new(scene, camera, settings, &mut work, &mut [])
                    .expect("a frame of that size");
                for y in 0..SIZE.1 {
                    renderer.line(y, &Output::SRGB, &mut row);
                    black_box(&row);
                }
            });
        });
    }
}

fn frames<'a>(criterion: &'a mut Criterion, arithmetic: &str) -> Frames<'a> {
    let mut group = criterion.benchmark_group(format!("frame/{arithmetic}"));
    group.throughput(Throughput::Elements(u64::from(SIZE.0) * u64::from(SIZE.1)));
    Frames(group)
}

pub(crate) fn bench(criterion: &mut Criterion) {
    let mut fixed = frames(criterion, Fixed::NAME);
    scenes::fixed::tailored(&mut fixed);
    crate::fixed::tailored(&mut fixed);
    drop(fixed);
    let mut single = frames(criterion, f32::NAME);
    scenes::single::tailored(&mut single);
    crate::single::tailored(&mut single);
    drop(single);
    let mut double = frames(criterion, f64::NAME);
    scenes::double::tailored(&mut double);
    crate::double::tailored(&mut double);
}

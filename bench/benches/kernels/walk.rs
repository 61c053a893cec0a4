//! A ray among spheres at random in an octree: the rate is rays'.

use std::hint::black_box;

use criterion::{Criterion, Throughput};
use whitted::octree::Limits;
use whitted::scene::{MaterialSpec, Parts, Scene};
use whitted::shape::Ray;
use whitted::trace::{Tracer, Work};

use crate::common::make::{Body, Make, Shapes};
use crate::common::random::Random;
use crate::common::ray;

const RAYS: usize = 64;
/// Steps of the tree's grid in floating point: ±128 units.
const LOG2_STEP: i8 = -20;

pub(crate) fn bench<A: Make>(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group(format!("walk/{}", A::NAME));
    group.throughput(Throughput::Elements(RAYS as u64));
    for count in [64, 4096] {
        let mut random = Random::new(1);
        // As large as keeps the part of the cube that is full the same.
        let size = 0.5 * (64.0 / f64::from(count)).cbrt();
        let sphere = |random: &mut Random| {
            let radius = random.within(0.4, 1.6) * size;
            (Body::Sphere(random.point(4.0), radius), 0)
        };
        let bodies: Vec<_> = (0..count).map(|_| sphere(&mut random)).collect();
        let mut shapes = Shapes::<A>::of(&bodies, LOG2_STEP);
        shapes.grow(Limits::DEFAULT);
        let materials = [A::material(&MaterialSpec::BLACK).expect("a material")];
        let scene = Scene::new(Parts { materials: &materials, ..shapes.parts() }).expect("a scene");
        let mut one = || {
            let (from, to) = (random.direction().map(|x| 10.0 * x), random.point(4.0));
            ray::<A>(from, [0, 1, 2].map(|i| to[i] - from[i]))
        };
        let rays: Vec<Ray<A>> = (0..RAYS).map(|_| one()).collect();
        let tracer = Tracer::new(&scene, 1);
        let mut work = Work::<A, 1>::new();
        group.bench_function(format!("{count} spheres"), |bencher| {
            bencher.iter(|| {
                for ray in black_box(&rays) {
                    black_box(tracer.nearest(ray, &mut work, &mut ()));
                }
            });
        });
    }
}

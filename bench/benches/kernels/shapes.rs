//! Each shape's test, on 64 rays that go for it, of which some miss: the rate is rays'.

use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput};
use whitted::shape::{Ray, Shape};

use crate::common::make::{Body, Make, Shapes};
use crate::common::random::Random;
use crate::common::ray;

const RAYS: usize = 64;

/// From somewhere around the shape, which lies within a unit or so, to somewhere near its centre.
fn rays<A: Make>() -> Vec<(Ray<A>, A::Coarse)> {
    let mut random = Random::new(1);
    let mut one = || {
        let (from, to) = (random.direction().map(|x| 6.0 * x), random.point(1.2));
        let ray = ray::<A>(from, [0, 1, 2].map(|i| to[i] - from[i]));
        (ray, A::coarse(&ray.origin, &ray.direction))
    };
    (0..RAYS).map(|_| one()).collect()
}

/// One of each kind.
fn bodies() -> Vec<(Body, u16)> {
    let corners = [[-1.0, -0.8, 0.1], [1.1, -0.7, -0.2], [0.1, 1.2, 0.3]];
    let normals = [[-0.1, 0.0, 1.0], [0.1, 0.0, 1.0], [0.0, 0.2, 1.0]];
    let octagon = |i: i32| {
        let (sin, cos) = (f64::from(i) * std::f64::consts::FRAC_PI_4).sin_cos();
        [cos, sin, 0.0]
    };
    let bodies = [
        Body::Sphere([0.1, 0.0, -0.1], 1.0),
        Body::Plane([0.1, 1.0, 0.2], -0.2),
        Body::Triangle(corners),
        Body::Smooth(corners, normals),
        Body::Polygon((0..8).map(octagon).collect()),
        Body::Cuboid([-0.9, -0.7, -0.8], [0.8, 0.9, 0.7]),
        Body::Disc([0.0, 0.1, 0.0], [0.1, 1.0, 0.3], 1.0),
        Body::Cylinder([0.0, -0.9, 0.1], [0.1, 0.9, 0.0], 0.7),
        Body::Cone([0.0, -0.9, 0.1], 0.9, [0.1, 0.9, 0.0], 0.2),
    ];
    bodies.into_iter().map(|body| (body, 0)).collect()
}

fn test<A: Make>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    shape: &impl Shape<A>,
    rays: &[(Ray<A>, A::Coarse)],
) {
    group.bench_function(name, |bencher| {
        bencher.iter(|| {
            for (ray, coarse) in black_box(rays) {
                black_box(black_box(shape).nearest(ray, coarse, false, A::FAR));
            }
        });
    });
}

pub(crate) fn bench<A: Make>(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group(format!("test/{}", A::NAME));
    group.throughput(Throughput::Elements(RAYS as u64));
    let (shapes, rays) = (Shapes::<A>::of(&bodies(), -16), rays::<A>());
    let group = &mut group;
    test(group, "sphere", &shapes.spheres[0], &rays);
    test(group, "plane", &shapes.planes[0], &rays);
    test(group, "triangle", &shapes.triangles[0], &rays);
    test(group, "smooth triangle", &shapes.smooth_triangles[0], &rays);
    let polygon = shapes.polygons[0].view(&shapes.edges);
    test(group, "polygon of 8", &polygon, &rays);
    test(group, "cuboid", &shapes.cuboids[0], &rays);
    test(group, "disc", &shapes.discs[0], &rays);
    test(group, "cylinder", &shapes.cylinders[0], &rays);
    test(group, "cone", &shapes.cones[0], &rays);
}

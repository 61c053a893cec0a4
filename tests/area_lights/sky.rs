//! Lights that stand for a part of the sky.

use super::{DOWN, Point, SIXTY_FOUR, UP, spec, square};
use crate::arithmetics::in_each_arithmetic;
use crate::common::radiance;
use whitted::gather::{Gatherer, Gathering, GatheringSpec, Indirect, Record};
use whitted::scene::{
    Area, AreaLight, AreaLightSpec, Background, Camera, FanCorner, Material, MaterialSpec, Parts,
    Scene,
};
use whitted::shape::{Disc, Plane};
use whitted::trace::Work;

/// Seen from above, a floor of albedo 1 under a sky of radiance 1, with light gathered by 1024 rays
/// and a light of radiance 1 before the sky: 1, if nothing counts twice.
macro_rules! floor_under_a_sky {
    ($a:ident, $spec:expr, $fan:expr, $discs:expr, $x:expr) => {{
        let lights = [AreaLight::<$a>::new($spec)];
        let planes = [Plane::<$a>::new(UP, 0.0, 0)];
        let white = MaterialSpec { diffuse: [1.0; 3], ..MaterialSpec::BLACK };
        let glow = MaterialSpec { emission: [1.0; 3], ..MaterialSpec::BLACK };
        let materials = [Material::<$a>::new(white), Material::<$a>::new(glow)];
        let scene = Scene::<$a>::checked(Parts {
            planes: &planes,
            discs: $discs,
            materials: &materials,
            area_lights: &lights,
            light_corners: $fan,
            background: Background::<$a>::uniform([1.0; 3]),
            ..Parts::EMPTY
        });
        let x: Point = $x;
        let eye = [x[0], 0.2, x[2]];
        let camera = Camera::<$a>::look_at(eye, x, [1.0, 0.0, 0.0], 10.0);
        let gathering = Gathering::<$a>::new(GatheringSpec {
            rings: 16,
            sectors: 64,
            coarse: 1,
            fine: 1,
            ..GatheringSpec::DEFAULT
        });
        let mut work = Work::<$a, 4>::new();
        let mut pool = [Record::<$a>::NONE; 1];
        let cache = Gatherer::new(&scene, gathering, &mut work, &mut ())
            .expect("settings")
            .fill(&camera, (1, 1), &mut pool, &mut [])
            .expect("memory");
        assert_eq!(cache.records().len(), 1);
        let lit = scene.with_indirect(Indirect::Cache(cache)).expect("uses");
        radiance(&lit, 1, eye, DOWN)[1]
    }};
}

in_each_arithmetic! {
    // what a light stands for isn't gathered from behind it as well, whatever its form; from behind
    // the light isn't there; one that is seen does the same by its body
    a_sky_counts_once: {
        const CORNERS: [Point; 5] = [
            [0.6, 1.0, 0.0], [0.2, 1.0, 0.6], [-0.5, 1.0, 0.35], [-0.5, 1.0, -0.35],
            [0.2, 1.0, -0.6],
        ];
        let fan: [FanCorner<A>; 4] = AreaLight::<A>::fan(&CORNERS);
        let disc = Area::Disc { center: [0.0, 0.8, 0.0], normal: DOWN, radius: 0.7 };
        let corners = [[-0.4, 0.9, -0.3], [0.7, 0.9, -0.2], [0.1, 0.6, 0.6]];
        let areas = [
            square(0.6),
            Area::Rectangle { corner: [-0.5, 0.6, -0.5], u: [0.0, 0.0, 1.0], v: [1.0, 0.0, 0.0] },
            Area::Triangle { corners },
            Area::Polygon { corners: &CORNERS, first: 0 },
            disc,
            Area::Sphere { center: [0.2, 0.7, 0.0], radius: 0.4 },
        ];
        for area in areas {
            for x in [[0.0; 3], [0.7, 0.0, -0.3], [-2.0, 0.0, 0.4]] {
                let fan = if matches!(area, Area::Polygon { .. }) { &fan[..] } else { &[] };
                let sum = floor_under_a_sky!(A, spec(area, SIXTY_FOUR), fan, &[], x);
                assert!((sum - 1.0).abs() < 0.01, "{area:?} {x:?}: {sum}");
            }
        }
        let discs = [Disc::<A>::new([0.0, 0.8, 0.0], DOWN, 0.7, 1)];
        let seen = AreaLightSpec { body: Some(0), ..spec(disc, SIXTY_FOUR) };
        let sum = floor_under_a_sky!(A, seen, &[], &discs, [0.1, 0.0, 0.0]);
        assert!((sum - 1.0).abs() < 0.01, "{sum}");
    }
}

//! Area lights against closed forms, in all three arithmetics.
//!
//! A surface of albedo 1 under a light of radiance 1 sends back the light's form factor.

use std::f64::consts::PI;

use crate::arithmetics::in_each_arithmetic;
use crate::common::radiance;
use whitted::scene::{
    Area, AreaLight, AreaLightSpec, FanCorner, Material, MaterialSpec, Parts, Pattern, Scene,
    Texture, TextureSpec, Wrap,
};
use whitted::shape::Plane;

mod bodies;
mod sky;

type Point = [f64; 3];

fn minus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] - b[i])
}

fn dot(a: Point, b: Point) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Point) -> Point {
    let l = dot(a, a).sqrt();
    a.map(|x| x / l)
}

/// The form factor from a small surface at x with normal n to a polygon that is wholly above its
/// horizon (Lambert 1760): the sum over the edges of the angle they are seen under, along n.
fn lambert(corners: &[Point], x: Point, n: Point) -> f64 {
    let sum: f64 = (0..corners.len())
        .map(|i| {
            let a = unit(minus(corners[i], x));
            let b = unit(minus(corners[(i + 1) % corners.len()], x));
            dot(a, b).clamp(-1.0, 1.0).acos() * dot(unit(cross(a, b)), n)
        })
        .sum();
    sum.abs() / (2.0 * PI)
}

/// To a disc of radius r in a parallel plane at height h, its middle `a` to the side
/// (e.g. Howell, "A catalog of radiation heat transfer configuration factors", B-14).
fn disc_factor(r: f64, h: f64, a: f64) -> f64 {
    if a == 0.0 {
        return r * r / (r * r + h * h);
    }
    let (h, r) = (h / a, r / a);
    let z = 1.0 + h * h + r * r;
    0.5 * (1.0 - (z - 2.0 * r * r) / (z * z - 4.0 * r * r).sqrt())
}

const UP: Point = [0.0, 1.0, 0.0];
const DOWN: Point = [0.0, -1.0, 0.0];

/// Seen from above, a floor at y = 0 of albedo 1 at x: the form factor of a light.
macro_rules! floor_under {
    ($a:ident, $spec:expr, $fan:expr, $jitter:expr, $x:expr, $from:expr) => {{
        let lights = [AreaLight::<$a>::new($spec)];
        let planes = [Plane::<$a>::new(UP, 0.0, 0)];
        let white = MaterialSpec { diffuse: [1.0; 3], ..MaterialSpec::BLACK };
        let materials = [Material::<$a>::new(white)];
        let scene = Scene::<$a>::checked(Parts {
            planes: &planes,
            materials: &materials,
            area_lights: &lights,
            light_corners: $fan,
            light_jitter: $jitter,
            ..Parts::EMPTY
        });
        let x: Point = $x;
        radiance(&scene, 1, [x[0], $from, x[2]], DOWN)[1]
    }};
}

const SIXTY_FOUR: [u16; 2] = [64, 64];

fn spec(area: Area<'_>, samples: [u16; 2]) -> AreaLightSpec<'_> {
    AreaLightSpec { area, radiance: [1.0; 3], error: 0.1, samples, body: None }
}

/// A square of side 1 at height h, shining down, around (0, 0).
fn square(h: f64) -> Area<'static> {
    Area::Rectangle { corner: [-0.5, h, -0.5], u: [1.0, 0.0, 0.0], v: [0.0, 0.0, 1.0] }
}

fn square_corners(h: f64) -> [Point; 4] {
    [[-0.5, h, -0.5], [0.5, h, -0.5], [0.5, h, 0.5], [-0.5, h, 0.5]]
}

/// The closed form for a differential element under the corner of a parallel rectangle a×b at
/// height 1.
fn corner_factor(a: f64, b: f64) -> f64 {
    let part = |a: f64, b: f64| {
        let s = (1.0 + a * a).sqrt();
        a / s * (b / s).atan()
    };
    (part(a, b) + part(b, a)) / (2.0 * PI)
}

#[test]
fn the_closed_forms_agree() {
    for h in [0.5, 1.0, 3.0] {
        let a = 4.0 * corner_factor(0.5 / h, 0.5 / h);
        let b = lambert(&square_corners(h), [0.0; 3], UP);
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
    assert!((disc_factor(1.0, 2.0, 1e-4) - disc_factor(1.0, 2.0, 0.0)).abs() < 1e-6);
}

in_each_arithmetic! {
    // 64 sub-areas, a ray through the middle of each: within 1 % from half a side upward
    middles: {
        for h in [0.5, 0.7, 1.0, 2.0, 6.0] {
            for x in [[0.0, 0.0, 0.0], [0.5, 0.0, 0.2], [1.5, 0.0, -0.5]] {
                let exact = lambert(&square_corners(h), x, UP);
                let got = floor_under!(A, spec(square(h), SIXTY_FOUR), &[], None, x, h * 0.7);
                assert!((got / exact - 1.0).abs() < 0.01, "{h} {x:?}: {got} {exact}");
            }
        }
        let exact = 4.0 * corner_factor(1.0, 1.0);
        let got = floor_under!(A, spec(square(0.5), SIXTY_FOUR), &[], None, [0.0; 3], 0.3);
        assert!((got / exact - 1.0).abs() < 0.01, "{got} {exact}");
    }

    // at random within each, in the mean of 1000 seeds
    jittered: {
        for h in [0.5, 1.5] {
            let x = [0.3, 0.0, 0.1];
            let exact = lambert(&square_corners(h), x, UP);
            let one = |seed| {
                floor_under!(A, spec(square(h), SIXTY_FOUR), &[], Some(seed), x, h * 0.7)
            };
            let mean = (0..1000).map(one).sum::<f64>() / 1000.0;
            assert!((mean / exact - 1.0).abs() < 0.003, "{h}: {mean} {exact}");
            assert!(one(1) != one(2) && one(1) == one(1));
        }
    }

    discs: {
        for (h, a) in [
            (0.5, 0.0), (0.5, 0.2), (0.5, 0.5), (0.5, 1.0), (0.7, 0.0), (1.0, 0.0), (0.6, 0.7),
            (2.0, 0.0), (3.0, 2.0),
        ] {
            let tolerance = 0.01;
            let disc = Area::Disc { center: [0.0, h, 0.0], normal: DOWN, radius: 0.5 };
            let exact = disc_factor(0.5, h, a);
            let x = [a * 0.6, 0.0, a * 0.8];
            let got = floor_under!(A, spec(disc, SIXTY_FOUR), &[], None, x, h * 0.7);
            assert!((got / exact - 1.0).abs() < tolerance, "{h} {a}: {got} {exact}");
        }
    }

    // wholly above the horizon a sphere's form factor is (R/d)²·cos θ
    spheres: {
        for (h, a) in [(1.0, 0.0), (1.0, 0.5), (2.0, 0.0), (3.0, 4.0)] {
            let ball = Area::Sphere { center: [0.0, h, 0.0], radius: 0.5 };
            let d = (h * h + a * a).sqrt();
            let exact = 0.25 / (d * d) * h / d;
            let x = [a, 0.0, 0.0];
            let got = floor_under!(A, spec(ball, SIXTY_FOUR), &[], None, x, h * 0.3);
            assert!((got / exact - 1.0).abs() < 0.01, "{h} {a}: {got} {exact}");
        }
    }

    triangles: {
        let corners = [[-0.4, 1.2, -0.3], [0.7, 1.2, -0.2], [0.1, 0.9, 0.6]];
        for x in [[0.0; 3], [1.0, 0.0, 0.5], [-0.3, 0.0, 0.2]] {
            let light = spec(Area::Triangle { corners }, SIXTY_FOUR);
            let exact = lambert(&corners, x, UP);
            let got = floor_under!(A, light, &[], None, x, 0.5);
            assert!((got / exact - 1.0).abs() < 0.01, "{x:?}: {got} {exact}");
        }
    }

    polygons: {
        const CORNERS: [Point; 5] = [
            [0.6, 1.0, 0.0], [0.2, 1.0, 0.6], [-0.5, 1.0, 0.35], [-0.5, 1.0, -0.35],
            [0.2, 1.0, -0.6],
        ];
        let mut corners = CORNERS;
        corners.reverse();
        let fan: [FanCorner<A>; 4] = AreaLight::<A>::fan(&CORNERS);
        for x in [[0.0; 3], [1.0, 0.0, 0.5], [-0.7, 0.0, 0.2]] {
            let light = spec(Area::Polygon { corners: &CORNERS, first: 0 }, SIXTY_FOUR);
            let exact = lambert(&CORNERS, x, UP);
            let got = floor_under!(A, light, &fan, None, x, 0.5);
            assert!((got / exact - 1.0).abs() < 0.01, "{x:?}: {got} {exact}");
            // the other way round it shines up
            let fan: [FanCorner<A>; 4] = AreaLight::<A>::fan(&corners);
            let light = spec(Area::Polygon { corners: &corners, first: 0 }, SIXTY_FOUR);
            assert_eq!(floor_under!(A, light, &fan, None, x, 0.5), 0.0);
        }
    }

    // the back of a light is dark, and there is no light within a sphere
    one_sided: {
        let up = Area::Rectangle { corner: [-0.5, 1.0, -0.5], u: [0.0, 0.0, 1.0], v: [1.0, 0.0, 0.0] };
        assert_eq!(floor_under!(A, spec(up, SIXTY_FOUR), &[], None, [0.0; 3], 0.5), 0.0);
        let around = Area::Sphere { center: [0.0, 0.5, 0.0], radius: 2.0 };
        assert_eq!(floor_under!(A, spec(around, SIXTY_FOUR), &[], None, [0.0; 3], 0.5), 0.0);
        // nor from below the horizon
        let below = Area::Disc { center: [0.0, -1.0, 0.0], normal: UP, radius: 0.5 };
        assert_eq!(floor_under!(A, spec(below, SIXTY_FOUR), &[], None, [0.0; 3], 0.5), 0.0);
    }

    // what bends the normal bends the light of an area: the form factor is that of the bent normal
    bumps: {
        let height = 1.0;
        let bump = TextureSpec { size: [2.0, 0.0, 0.0], height, ..TextureSpec::of(Pattern::Gradient { wrap: Wrap::Repeat }) };
        // half a unit up for each unit along x
        let bent = unit([-0.5, 1.0, 0.0]);
        let white = MaterialSpec { diffuse: [1.0; 3], bump: Some(0), ..MaterialSpec::BLACK };
        let mut most = 0.0f64;
        for h in [0.6, 1.0, 2.5] {
            let lights = [AreaLight::<A>::new(spec(square(h), SIXTY_FOUR))];
            let planes = [Plane::<A>::new(UP, 0.0, 0)];
            let (materials, textures) = ([Material::<A>::new(white)], [Texture::<A>::new(bump)]);
            let scene = Scene::<A>::checked(Parts {
                planes: &planes,
                materials: &materials,
                textures: &textures,
                area_lights: &lights,
                ..Parts::EMPTY
            });
            for x in [[0.3, 0.0, 0.0], [0.7, 0.0, 0.4], [1.2, 0.0, -0.3]] {
                let exact = lambert(&square_corners(h), x, bent);
                let got = radiance(&scene, 1, [x[0], h * 0.5, x[2]], DOWN)[0];
                assert!((got / exact - 1.0).abs() < 0.01, "{h} {x:?}: {got} {exact}");
                let flat = lambert(&square_corners(h), x, UP);
                most = most.max((got / flat - 1.0).abs());
            }
        }
        assert!(most > 0.3, "a flat floor is no other: {most}");
    }
}

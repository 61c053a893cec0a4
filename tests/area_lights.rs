//! Area lights against closed forms, in all three arithmetics.
//!
//! A surface of albedo 1 under a light of radiance 1 sends back the light's form factor.

use std::f64::consts::PI;

use crate::common::{radiance, toward};
use whitted::gather::{Gatherer, Gathering, GatheringSpec, Indirect, Record};
use whitted::math::Fixed;
use whitted::scene::{
    Area, AreaLight, AreaLightSpec, Background, Camera, FanCorner, Light, Material, MaterialSpec,
    Parts, Pattern, Rules, Scene, Shadow, Texture, TextureSpec, Wrap,
};
use whitted::shape::{Disc, Plane, Polygon, Sphere};
use whitted::trace::Work;

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

macro_rules! for_all {
    ($($name:ident: $body:block)*) => {
        $(mod $name {
            use super::*;
            #[test]
            fn fixed() {
                type A = Fixed;
                $body
            }
            #[test]
            fn f32() {
                type A = f32;
                $body
            }
            #[test]
            fn f64() {
                type A = f64;
                $body
            }
        })*
    };
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

for_all! {
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

    // the emission of a body is seen from its front by the camera and in a mirror, unlit
    emission: {
        let materials = [
            Material::<A>::new(MaterialSpec { emission: [2.0, 1.0, 0.5], ..MaterialSpec::BLACK }),
            Material::<A>::new(MaterialSpec { reflection: [0.5; 3], ..MaterialSpec::BLACK }),
        ];
        let spheres = [
            Sphere::<A>::new([5.0, 0.0, 0.0], 1.0, 0),
            Sphere::<A>::new([-5.0, 0.0, 0.0], -1.0, 0),
        ];
        let discs = [Disc::<A>::new([0.0, 2.0, 0.0], DOWN, 1.0, 0)];
        let planes = [Plane::<A>::new(UP, -2.0, 1)];
        let parts = Parts::<A> {
            spheres: &spheres,
            discs: &discs,
            planes: &planes,
            materials: &materials,
            rules: Rules::WHITTED,
            ..Parts::EMPTY
        };
        let scene = Scene::<A>::checked(parts);
        let see = |from, to| {
            let (eye, way) = toward(from, to);
            radiance(&scene, 3, eye, way)
        };
        let near = |got: Point, exact: Point| {
            (0..3).all(|i| (got[i] - exact[i]).abs() < 1e-3)
        };
        assert!(near(see([0.0; 3], [0.0, 2.0, 0.0]), [2.0, 1.0, 0.5]));
        assert_eq!(see([0.0, 4.0, 0.0], [0.0, 2.0, 0.0]), [0.0; 3]);
        assert!(near(see([0.0; 3], [5.0, 0.0, 0.0]), [2.0, 1.0, 0.5]));
        assert!(near(see([0.0; 3], [-5.0, 0.0, 0.0]), [2.0, 1.0, 0.5]));
        assert!(near(see([0.3, 0.0, 0.0], [0.3, -2.0, 0.0]), [1.0, 0.5, 0.25]));
    }
}

/// The parts of a floor, the four kinds of light above it with or without a body, and a glass pane
/// far below that makes shadow rays look for more than the first thing in their way.
macro_rules! with_bodies {
    ($a:ident, $bodies:expr, $filtered:expr, $x:expr) => {{
        const CORNERS: [Point; 5] = [
            [2.6, 1.0, 0.0],
            [2.2, 1.0, 0.6],
            [1.5, 1.0, 0.35],
            [1.5, 1.0, -0.35],
            [2.2, 1.0, -0.6],
        ];
        let bodies: bool = $bodies;
        let plain = MaterialSpec { diffuse: [1.0; 3], ..MaterialSpec::BLACK };
        let shadow = if $filtered { Shadow::Filtered } else { Shadow::Opaque };
        let materials = [
            Material::<$a>::new(MaterialSpec { shadow, ..plain }),
            Material::<$a>::new(MaterialSpec { emission: [1.0; 3], ..MaterialSpec::BLACK }),
        ];
        let spheres = [Sphere::<$a>::new([-2.0, 1.2, 0.0], 0.5, 1)];
        let polygons = [Polygon::<$a>::new(&CORNERS, 0, 1)];
        let discs = [Disc::<$a>::new([0.0, 1.5, 2.0], [0.1, -1.0, -0.2], 0.5, 1)];
        let edges = Polygon::<$a>::edges(&CORNERS);
        let fan: [FanCorner<$a>; 4] = AreaLight::<$a>::fan(&CORNERS);
        let with = |area, body| {
            let body = bodies.then_some(body);
            AreaLight::<$a>::new(AreaLightSpec { body, ..spec(area, SIXTY_FOUR) })
        };
        let lights = [
            with(Area::Sphere { center: [-2.0, 1.2, 0.0], radius: 0.5 }, 0),
            with(Area::Polygon { corners: &CORNERS, first: 0 }, 1),
            with(Area::Disc { center: [0.0, 1.5, 2.0], normal: [0.1, -1.0, -0.2], radius: 0.5 }, 2),
        ];
        let planes = [Plane::<$a>::new(UP, 0.0, 0)];
        let mut parts = Parts::<$a> {
            planes: &planes,
            materials: &materials,
            area_lights: &lights,
            light_corners: &fan,
            light_jitter: Some(5),
            ..Parts::EMPTY
        };
        if bodies {
            parts = Parts {
                spheres: &spheres,
                polygons: &polygons,
                edges: &edges,
                discs: &discs,
                ..parts
            };
        }
        let scene = Scene::<$a>::checked(parts);
        let x: Point = $x;
        radiance(&scene, 1, [x[0], 0.4, x[2]], DOWN)[0]
    }};
}

for_all! {
    // a light's body doesn't stand in the way of its own light, however grazing; but it does in
    // another's
    no_light_is_in_its_own_way: {
        let same = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-3;
        for filtered in [false, true] {
            for i in 0..12 {
                for j in 0..9 {
                    let x = [f64::from(i) * 0.31 - 1.7, 0.0, f64::from(j) * 0.29 - 1.2];
                    let dark = with_bodies!(A, true, filtered, x);
                    let light = with_bodies!(A, false, filtered, x);
                    assert!(same(dark, light), "{x:?}, {filtered}: {dark} {light}");
                }
            }
            // from far outside the one body hides the other's light
            let x = [-10.0, 0.0, -8.0];
            let (dark, light) =
                (with_bodies!(A, true, filtered, x), with_bodies!(A, false, filtered, x));
            assert!(dark < light * 0.999, "{dark} {light}");
        }
    }
}

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

for_all! {
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

for_all! {
    // a mirror shows a light that can be seen: no highlight stands for it there. It does on what
    // doesn't mirror, of a light that can't be seen, and of another light
    no_highlight_of_what_is_mirrored: {
        let disc = Area::Disc { center: [0.0, 1.0, 0.0], normal: DOWN, radius: 0.3 };
        let shown = |specular: f64, reflection: f64, body: Option<u32>, other: bool| {
            let polished = MaterialSpec {
                diffuse: [0.25; 3],
                specular: [specular; 3],
                shininess: 10.0,
                reflection: [reflection; 3],
                ..MaterialSpec::BLACK
            };
            let glow = MaterialSpec { emission: [1.0; 3], ..MaterialSpec::BLACK };
            let lights = [AreaLight::<A>::new(AreaLightSpec { body, ..spec(disc, SIXTY_FOUR) })];
            let points = [Light::<A>::point([0.5, 1.0, 0.0], [0.5; 3])];
            let planes = [Plane::<A>::new(UP, 0.0, 0)];
            let discs = [Disc::<A>::new([0.0, 1.0, 0.0], DOWN, 0.3, 1)];
            let materials = [Material::<A>::new(polished), Material::<A>::new(glow)];
            let scene = Scene::<A>::checked(Parts {
                planes: &planes,
                discs: &discs,
                materials: &materials,
                lights: if other { &points } else { &[] },
                area_lights: &lights,
                ..Parts::EMPTY
            });
            // the rays of a depth of 1 mirror nothing
            radiance(&scene, 1, [0.0, 0.5, 0.0], DOWN)[0]
        };
        for reflection in [0.0, 0.5] {
            for body in [None, Some(0)] {
                let mirrored = reflection > 0.0 && body.is_some();
                let matt = shown(0.0, reflection, body, false);
                let glossy = shown(0.5, reflection, body, false);
                assert!(matt > 0.01);
                assert_eq!(glossy == matt, mirrored, "{reflection} {body:?}: {glossy} {matt}");
                // the point light's own highlight is there in any case
                let of_point = shown(0.5, reflection, body, true) - shown(0.0, reflection, body, true);
                assert!(of_point - (glossy - matt) > 0.01, "{reflection} {body:?}: {of_point}");
            }
        }
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

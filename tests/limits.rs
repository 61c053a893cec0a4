//! Nothing panics: random scenes and rays at the limits of the ranges, with overflow checks on
//! (as tests are built). What is drawn there may be anything, but it is drawn.

use crate::common::FromF64;
use crate::common::make::{Body, Make, Shapes, body};
use crate::common::random::Random;
use whitted::frame::{Gray4, Output, Renderer, Rgb565, Sample, Sampling, Settings};
use whitted::math::Fixed;
use whitted::octree::{BuildError, Limits};
use whitted::scene::{
    Area, AreaLightSpec, Falloff, LightSpec, MaterialSpec, Parts, PatternSpec, Rules, Scene,
    Selection, Shadow,
};
use whitted::tally::Counts;
use whitted::trace::Work;

/// A number of any size that fixed point has, often one at the end of the range.
fn anything(random: &mut Random) -> f64 {
    match random.below(8) {
        0 => 1024.0,
        1 => -1024.0,
        2 => 0.0,
        3 => random.within(-1024.0, 1024.0),
        4 => 2f64.powf(random.within(-16.0, 0.0)),
        5 => random.within(1023.0, 1024.0),
        _ => random.within(-8.0, 8.0),
    }
}

fn point(random: &mut Random) -> [f64; 3] {
    [anything(random), anything(random), anything(random)]
}

fn coefficients(random: &mut Random, most: f64) -> [f64; 3] {
    let mut one = || match random.below(4) {
        0 => 0.0,
        1 => most,
        _ => random.within(0.0, 1.0),
    };
    [one(), one(), one()]
}

fn material(random: &mut Random) -> MaterialSpec {
    let index = |random: &mut Random| [1.0, 1.5, 1.99, 0.51, 1.33][random.below(5) as usize];
    let cell = |random: &mut Random| [0.0, 1.0 / 1024.0, 1024.0, 0.3][random.below(4) as usize];
    MaterialSpec {
        ambient: coefficients(random, 15.9),
        diffuse: coefficients(random, 15.9),
        specular: coefficients(random, 15.9),
        shininess: [0.0, 0.5, 1.0, 33.3, 1e6][random.below(5) as usize],
        reflection: coefficients(random, 1.0),
        transmission: coefficients(random, 1.0),
        index_front: index(random),
        index_behind: index(random),
        emission: coefficients(random, 1024.0),
        shadow: [Shadow::Opaque, Shadow::Filtered, Shadow::None][random.below(3) as usize],
        pattern: match random.below(3) {
            0 => Some(PatternSpec {
                cell: [cell(random), cell(random), cell(random)],
                offset: point(random),
                other: random.below(4) as u16,
            }),
            _ => None,
        },
        fresnel: random.below(2) == 0,
        ..MaterialSpec::BLACK
    }
}

fn light(random: &mut Random) -> LightSpec {
    let (position, direction) = (point(random), random.direction());
    let intensity = [random.within(0.0, 1.0), 10f64.powf(random.within(-9.0, 12.0)), 0.0];
    let falloff = [Falloff::None, Falloff::InverseSquare][random.below(2) as usize];
    match random.below(3) {
        0 => LightSpec::Point { position, intensity, falloff },
        1 => LightSpec::Directional { direction, intensity },
        _ => {
            let cos_outer = random.within(0.0, 0.99);
            let cos_inner = cos_outer + (1.0 - cos_outer) * random.within(0.001, 1.0);
            LightSpec::Spot { position, direction, intensity, falloff, cos_inner, cos_outer }
        }
    }
}

fn scene<A: Make>(seed: u64) -> Counts {
    let mut random = Random::new(seed);
    let count = 1 + random.below(30);
    let bodies: Vec<_> = (0..count)
        .map(|_| {
            let p = point(&mut random);
            let r = match random.below(4) {
                0 => 10f64.powf(random.within(-3.6, 2.7)),
                1 => random.within(400.0, 2000.0),
                2 => 1.0 / 4096.0,
                _ => random.within(0.1, 8.0),
            };
            let kind = random.below(9);
            let shape = match (kind, random.below(6)) {
                (8, _) => Body::Plane(random.direction(), anything(&mut random)),
                (0, 0) => Body::Sphere(p, -r),
                (6, 0) => Body::Cylinder(p, point(&mut random), -r),
                (7, 0) => Body::Cone(p, -r, point(&mut random), -anything(&mut random).abs()),
                (1, 0) => Body::Triangle([p, point(&mut random), point(&mut random)]),
                (4, 0) => Body::Cuboid([-1024.0; 3], p),
                _ => body(&mut random, kind, p, r),
            };
            (shape, random.below(4) as u16)
        })
        .collect();
    // Shapes that reach beyond the range are refused, and left out.
    let mut shapes = Shapes::<A>::of(&bodies, -12);
    if random.below(2) == 0 {
        // Once in a thousand scenes a thin triangle's computed extent leaves the tree's range.
        if let Err(error) = shapes.try_grow(Limits::DEFAULT) {
            assert_eq!(error, BuildError::Extent);
        }
    }
    let materials: Vec<_> = (0..4)
        .map(|_| {
            loop {
                if let Ok(material) = A::material(&material(&mut random)) {
                    break material;
                }
            }
        })
        .collect();
    let lights: Vec<_> = (0..random.below(4)).map(|_| A::light(&light(&mut random))).collect();
    let lights: Vec<_> = lights.into_iter().map(|light| light.expect("a light")).collect();
    let (mut area_lights, mut light_corners) = (Vec::new(), Vec::new());
    for _ in 0..random.below(3) {
        let corners = [point(&mut random), point(&mut random), point(&mut random)];
        let first = light_corners.len() as u32;
        let radius = 10f64.powf(random.within(-3.6, 2.7));
        let normal = random.direction();
        let [corner, u, v] = corners;
        let area = match random.below(5) {
            0 => Area::Rectangle { corner, u, v },
            1 => Area::Triangle { corners },
            2 => Area::Polygon { corners: &corners, first },
            3 => Area::Disc { center: corner, normal, radius },
            _ => Area::Sphere { center: corner, radius },
        };
        let spec = AreaLightSpec {
            area,
            radiance: [random.within(0.0, 9.0), 10f64.powf(random.within(-9.0, 9.0)), 0.0],
            error: 10f64.powf(random.within(-9.0, 9.0)),
            samples: [1 + random.below(9) as u16, 9 + random.below(20) as u16],
            body: (random.below(2) == 0).then_some(random.below(30) as u32),
        };
        // Corners too far apart are refused.
        let Ok(light) = A::area_light(&spec) else { continue };
        if let Area::Polygon { corners, .. } = area {
            let fan = (0..2).map(|i| A::fan_corner(corners, i));
            let Ok(fan) = fan.collect::<Result<Vec<_>, _>>() else { continue };
            light_corners.extend(fan);
        }
        area_lights.push(light);
    }
    let selection = match random.below(4) {
        0 => Selection::Choose(random.below(4) as u8),
        1 => Selection::Above(A::BLACK),
        _ => Selection::All,
    };
    let rules = [Rules::COURSE, Rules::WHITTED, Rules::NFF][random.below(3) as usize];
    let scene = Scene::new(Parts {
        materials: &materials,
        lights: &lights,
        area_lights: &area_lights,
        light_corners: &light_corners,
        light_jitter: [None, Some(7)][random.below(2) as usize],
        selection,
        ambient: A::ambient(coefficients(&mut random, 1024.0)).expect("ambient"),
        background: A::gradient(random.direction(), [0.0; 3], [1024.0; 3]).expect("sky"),
        rules: Rules { lossy: random.below(2) == 0, ..rules },
        ..shapes.parts()
    })
    .expect("a scene");
    let eye = point(&mut random);
    let component = |random: &mut Random| match random.below(3) {
        0 => random.within(-16.0, 16.0),
        1 => [16.0, -16.0, 0.0][random.below(3) as usize],
        _ => random.within(-1.0, 1.0),
    };
    let mut vector = || [component(&mut random), component(&mut random), component(&mut random)];
    let camera = A::vectors(eye, vector(), vector(), vector()).expect("a camera");
    draw(&scene, &camera, &mut random)
}

/// Draws the scene in a few ways, and some rays that no camera sends.
fn draw<A: FromF64>(
    scene: &Scene<'_, A>,
    camera: &whitted::scene::Camera<A>,
    random: &mut Random,
) -> Counts {
    let sampling = [Sampling::Center, Sampling::Corners][random.below(2) as usize];
    let (width, height) = (1 + random.below(12) as u16, 1 + random.below(12) as u16);
    let depth = 1 + random.below(8) as u8;
    let settings = Settings { depth, sampling, ..Settings::new(width, height) };
    let mut work = Work::<A, 8>::new();
    let mut samples = vec![Sample::NONE; sampling.samples(width)];
    let counts = Counts::default();
    let mut renderer =
        Renderer::with_tally(scene, camera, settings, &mut work, &mut samples, counts)
            .expect("settings");
    let mut line = vec![Rgb565(0); usize::from(width)];
    for y in 0..height {
        renderer.line(y, &Output::SRGB, &mut line);
    }
    let mut band = [0; 40];
    renderer.band::<Gray4>(0, &Output::DITHERED, &mut band);
    for _ in 0..40 {
        renderer.radiance(&crate::common::ray(point(random), random.direction()));
    }
    *renderer.tally()
}

fn many<A: Make>(first: u64) {
    let (mut hits, mut secondary) = (0, 0);
    for seed in first..first + SCENES {
        let counts = std::panic::catch_unwind(|| scene::<A>(seed))
            .unwrap_or_else(|_| panic!("{}: scene {seed}", A::NAME));
        hits += counts.primary_hits;
        secondary += counts.reflection + counts.transmission;
    }
    // or nothing would have been tested
    assert!(hits > SCENES * 10 && secondary > SCENES * 10, "{hits} {secondary}");
}

/// So many scenes in each arithmetic.
const SCENES: u64 = 400;

#[test]
fn fixed() {
    many::<Fixed>(1000);
}

#[test]
fn single() {
    many::<f32>(2000);
}

#[test]
fn double() {
    many::<f64>(3000);
}

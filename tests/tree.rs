//! An octree changes how long a picture takes, and not a bit of it: whole scenes of all shapes
//! with a tree against the same scenes without one.

use crate::common::make::{Body, Make, Shapes, body};
use crate::common::random::Random;
use crate::common::scenes::{double, fixed, single};
use crate::common::{ray, weight};
use whitted::frame::{Renderer, Settings};
use whitted::math::Fixed;
use whitted::octree::{Limits, build_into};
use whitted::scene::{Falloff, LightSpec, MaterialSpec, Parts, PatternSpec, Rules, Scene, Shadow};
use whitted::shape::Ray;
use whitted::tally::Counts;
use whitted::trace::{Tracer, Work};

/// Steps of 2⁻²⁰ for floating point: ±128 units.
const LOG2_STEP: i8 = -20;
const SIZE: u16 = 20;
/// So many scenes of each sort.
const SEEDS: u64 = 4;

/// What rays find, the work of the search left out.
fn found(counts: &Counts) -> Counts {
    Counts { nodes: 0, tests: 0, ..*counts }
}

/// All that a scene shows along some rays: hits, radiances, counts.
fn seen<A: Make>(parts: Parts<'_, A>, rays: &[Ray<A>]) -> (Vec<String>, Counts) {
    let scene = Scene::new(parts).expect("a scene");
    let camera = A::look_at([3.0, 4.0, -30.0], [0.0; 3], [0.0, 1.0, 0.0], 0.5).expect("a camera");
    let mut all = Vec::new();
    let mut work = Work::<A, 5>::new();
    let mut tracer_work = Work::<A, 5>::new();
    let tracer = Tracer::new(&scene, 5);
    let settings = Settings::new(SIZE, SIZE);
    let mut renderer =
        Renderer::with_tally(&scene, &camera, settings, &mut work, &mut [], Counts::default())
            .expect("settings");
    let primary = (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| (x, y)));
    let primary: Vec<_> = primary.map(|(x, y)| renderer.ray(x, y)).collect();
    for ray in primary.iter().chain(rays) {
        let hit = tracer.nearest(ray, &mut tracer_work, &mut ());
        let place = hit.map(|hit| (hit.shape, hit.distance));
        all.push(format!("{place:?} {:?}", renderer.radiance(ray)));
    }
    (all, *renderer.tally())
}

fn same<A: Make>(name: &str, with: Parts<'_, A>, rays: &[Ray<A>]) -> Counts {
    let (tree, counts) = seen(with, rays);
    let (list, plain) = seen(Parts { tree: None, ..with }, rays);
    for (i, (tree, list)) in tree.iter().zip(&list).enumerate() {
        assert_eq!(tree, list, "{name}, {}: ray {i}, left with the tree", A::NAME);
    }
    assert_eq!(found(&counts), found(&plain), "{name}, {}", A::NAME);
    assert!(plain.nodes == 0);
    counts
}

/// Matt, mirror, glass with each kind of shadow, a checker.
fn materials<A: Make>() -> Vec<whitted::scene::Material<A>> {
    let matt = MaterialSpec {
        ambient: [0.1, 0.2, 0.3],
        diffuse: [0.7, 0.6, 0.5],
        specular: [0.3; 3],
        shininess: 20.0,
        ..MaterialSpec::BLACK
    };
    let glass = MaterialSpec {
        reflection: [0.2; 3],
        transmission: [0.8, 0.7, 0.9],
        index_behind: 1.5,
        ..MaterialSpec::BLACK
    };
    let specs = [
        matt,
        MaterialSpec { reflection: [0.6; 3], ..matt },
        MaterialSpec { shadow: Shadow::Filtered, ..glass },
        glass,
        MaterialSpec {
            pattern: Some(PatternSpec { cell: [1.0; 3], offset: [0.25; 3], other: 1 }),
            ..matt
        },
        MaterialSpec { shadow: Shadow::None, index_behind: 1.0, ..glass },
    ];
    specs.iter().map(|spec| A::material(spec).expect("a material")).collect()
}

/// Runs a scene with and without a tree. `filtered`: with materials that let light through.
fn scene<A: Make>(name: &str, bodies: &[(Body, u16)], filtered: bool, seed: u64) {
    let mut random = Random::new(seed);
    let mut shapes = Shapes::<A>::of(bodies, LOG2_STEP);
    assert!(shapes.bounded() * 10 >= bodies.len() * 8, "{name}: most shapes can be made");
    let built = shapes.grow(Limits::DEFAULT);
    assert!(built.levels > 0, "{name}");
    let mut materials = materials::<A>();
    if !filtered {
        materials[2] = materials[3];
        materials[5] = materials[3];
    }
    let falloff = Falloff::None;
    let lights = [
        LightSpec::Point { position: [8.0, 25.0, -9.0], intensity: [0.8; 3], falloff },
        LightSpec::Directional { direction: [0.4, -0.5, 0.7], intensity: [0.3; 3] },
    ]
    .map(|spec| A::light(&spec).expect("a light"));
    let mut rays = Vec::new();
    for i in 0..300 {
        // from within, along an axis, from far outside
        let (origin, direction) = match i % 3 {
            0 => (random.point(12.0), random.direction()),
            1 => {
                let mut axis = [0.0; 3];
                axis[i / 3 % 3] = if i % 2 == 0 { 1.0 } else { -1.0 };
                (random.point(10.0), axis)
            }
            _ => {
                let (d, p) = (random.direction(), random.point(8.0));
                ([0, 1, 2].map(|i| p[i] - 60.0 * d[i]), d)
            }
        };
        rays.push(ray::<A>(origin, direction));
    }
    let rules = Rules { cutoff: weight::<A>(0.02), ..Rules::WHITTED };
    let counts = same(
        name,
        Parts {
            materials: &materials,
            lights: &lights,
            ambient: A::ambient([0.5; 3]).expect("ambient"),
            background: A::gradient([0.0, 1.0, 0.0], [0.1; 3], [0.4, 0.6, 0.9]).expect("sky"),
            rules,
            ..shapes.parts()
        },
        &rays,
    );
    assert!(counts.nodes > 0 && counts.shadow > 0 && counts.shadow_hits > 0, "{name}: {counts:?}");
}

fn all_arithmetics(name: &str, bodies: &[(Body, u16)], seed: u64) {
    for filtered in [false, true] {
        scene::<Fixed>(name, bodies, filtered, seed);
        scene::<f32>(name, bodies, filtered, seed);
        scene::<f64>(name, bodies, filtered, seed);
    }
}

fn floor() -> (Body, u16) {
    (Body::Plane([0.05, 1.0, 0.1], -9.0), 4)
}

#[test]
fn mixed_shapes() {
    for seed in 0..SEEDS {
        let mut random = Random::new(seed);
        let count = [30, 80, 300][seed as usize % 3];
        let mut bodies = vec![floor()];
        for i in 0..count {
            let (p, r) = (random.point(9.0), random.within(0.2, 2.0));
            bodies.push((body(&mut random, i % 8, p, r), random.below(6) as u16));
        }
        all_arithmetics("mixed shapes", &bodies, seed);
    }
}

#[test]
fn sizes_from_specks_to_the_whole_scene() {
    for seed in 0..SEEDS {
        let mut random = Random::new(100 * 4 + seed);
        let mut bodies = vec![];
        for i in 0..120 {
            let (p, r) = (random.point(9.0), 10f64.powf(random.within(-2.5, 1.3)));
            bodies.push((body(&mut random, i % 8, p, r), random.below(6) as u16));
        }
        all_arithmetics("sizes", &bodies, seed);
    }
}

#[test]
fn clusters() {
    for seed in 0..SEEDS {
        let mut random = Random::new(100 * 5 + seed);
        let mut bodies = vec![floor()];
        let centers: Vec<_> = (0..4).map(|_| random.point(9.0)).collect();
        for i in 0..160 {
            let (c, q) = (centers[i % 4], random.point(0.6));
            let p = [0, 1, 2].map(|j| c[j] + q[j]);
            bodies.push((body(&mut random, i as u64 / 4 % 8, p, 0.25), random.below(6) as u16));
        }
        all_arithmetics("clusters", &bodies, seed);
    }
}

/// Balls and boxes on a grid of whole numbers, where they touch and where cells are cut.
#[test]
fn touching() {
    for seed in 0..SEEDS {
        let mut random = Random::new(100 * 6 + seed);
        let mut bodies = vec![];
        for i in 0..125u32 {
            let p = [i % 5, i / 5 % 5, i / 25].map(|x| f64::from(x) * 2.0 - 4.0);
            let material = random.below(6) as u16;
            bodies.push(match i % 4 {
                0 => (Body::Sphere(p, 1.0), material),
                1 => (Body::Cuboid(p.map(|x| x - 1.0), p.map(|x| x + 1.0)), material),
                2 => (
                    Body::Cylinder([p[0], p[1] - 1.0, p[2]], [p[0], p[1] + 1.0, p[2]], 1.0),
                    material,
                ),
                _ => (
                    Body::Cone([p[0], p[1] - 1.0, p[2]], 1.0, [p[0], p[1] + 1.0, p[2]], 0.0),
                    material,
                ),
            });
        }
        all_arithmetics("touching", &bodies, seed);
    }
}

/// Flat shapes of different materials in the same planes, over one another: the lowest number
/// counts, whichever the walk finds first.
#[test]
fn coplanar_overlaps() {
    for seed in 0..SEEDS {
        let mut random = Random::new(100 * 7 + seed);
        let mut bodies = vec![];
        for i in 0..96 {
            let (axis, level) = (i % 3, f64::from(i as i32 / 3 % 3) * 3.0 - 3.0);
            let at = |random: &mut Random, r: f64| {
                let mut p = random.point(r);
                p[axis] = 0.0;
                p
            };
            let mut center = at(&mut random, 5.0);
            center[axis] = level;
            let mut normal = [0.0; 3];
            normal[axis] = 1.0;
            let corner = |u: f64, v: f64| {
                let mut p = center;
                p[(axis + 1) % 3] += u;
                p[(axis + 2) % 3] += v;
                p
            };
            let square =
                [corner(-2.0, -2.0), corner(2.0, -2.0), corner(2.0, 2.0), corner(-2.0, 2.0)];
            let material = random.below(6) as u16;
            bodies.push(match i / 9 % 4 {
                0 => (Body::Disc(center, normal, 2.0), material),
                1 => (Body::Polygon(square.to_vec()), material),
                2 => (Body::Triangle([square[0], square[1], square[2]]), material),
                _ => (
                    Body::Cuboid(
                        [0, 1, 2].map(|i| square[0][i].min(square[2][i]) - normal[i]),
                        square[2],
                    ),
                    material,
                ),
            });
        }
        all_arithmetics("coplanar overlaps", &bodies, seed);
    }
}

/// The same shapes several times with different materials.
#[test]
fn coincident_shapes() {
    for seed in 0..SEEDS {
        let mut random = Random::new(100 * 8 + seed);
        let mut bodies = vec![];
        for kind in 0..8 {
            for _ in 0..3 {
                let (p, r) = (random.point(7.0), random.within(0.8, 2.5));
                let shape = body(&mut random, kind, p, r);
                for material in [3, 0, 2, 1] {
                    bodies.push((shape.clone(), material));
                }
            }
        }
        all_arithmetics("coincident shapes", &bodies, seed);
    }
}

/// A static scene whose tree the compiler built.
#[test]
fn built_by_the_compiler() {
    fn run<A: Make>(parts: Parts<'static, A>, bounded: usize) {
        assert_eq!(parts.bounded() as usize, bounded);
        let mut random = Random::new(9);
        let rays: Vec<_> = (0..1000)
            .map(|_| ray::<A>(random.point(6.0).map(|x| x + 0.5), random.direction()))
            .collect();
        same("compiled", parts, &rays);
    }
    run::<Fixed>(*fixed::every::SCENE.parts(), fixed::every::BOUNDED);
    run::<f32>(*single::every::SCENE.parts(), single::every::BOUNDED);
    run::<f64>(*double::every::SCENE.parts(), double::every::BOUNDED);
    assert!(fixed::every::TREE.built().levels > 1);
}

/// The compiler and a program build the same words.
#[test]
fn built_at_run_time() {
    let mut words = [0; 256];
    let mut scratch = [0; 256];
    let extents = fixed::every::PARTS.extents::<{ fixed::every::BOUNDED }>(-16);
    let built = build_into(&extents, &mut words, &mut scratch, Limits::DEFAULT).expect("a tree");
    assert_eq!(built, *fixed::every::TREE.built());
    assert_eq!(words[..built.words], *fixed::every::TREE.words());
}

/// What stood in a light's way is tested first, for the next point that it shadows: a shape, and no node
/// of the tree.
#[test]
fn what_was_in_the_way_is_asked_first() {
    fn test<A: Make>() {
        let mut bodies = vec![(Body::Disc([0.0, 6.0, 0.0], [0.0, 1.0, 0.0], 2.0), 0)];
        // what stands beside the shadow's way, in cells that it passes
        for i in 0..60 {
            let angle = f64::from(i) * 2.4;
            let at = [3.5 * angle.cos(), 0.5 + f64::from(i) * 0.09, 3.5 * angle.sin()];
            bodies.push((Body::Sphere(at, 0.2), 0));
        }
        bodies.push((Body::Disc([0.0, 0.0, 0.0], [0.0, 1.0, 0.0], 5.0), 0));
        let mut shapes = Shapes::<A>::of(&bodies, LOG2_STEP);
        shapes.grow(Limits::default());
        let materials =
            [A::material(&MaterialSpec { diffuse: [0.5; 3], ..MaterialSpec::BLACK }).unwrap()];
        let light = A::light(&LightSpec::Point {
            position: [0.0, 9.0, 0.0],
            intensity: [1.0; 3],
            falloff: Falloff::None,
        });
        let lights = [light.unwrap()];
        let parts = Parts { materials: &materials, lights: &lights, ..shapes.parts() };
        let scene = Scene::new(parts).expect("a scene");
        let mut work = Work::<A, 2>::new();
        let tracer = Tracer::new(&scene, 1);
        let mut took = |x: f64| {
            let way = ray::<A>([x, 0.5, 0.0], [0.0, -1.0, 0.0]);
            let mut all = Counts::default();
            assert!(tracer.radiance(way, &mut work, &mut all).iter().all(|&r| r == A::BLACK));
            assert_eq!((all.shadow, all.shadow_hits), (1, 1));
            let mut seen = Counts::default();
            assert!(tracer.nearest(&way, &mut Work::<A, 2>::new(), &mut seen).is_some());
            (all.nodes - seen.nodes, all.tests - seen.tests)
        };
        let (nodes, _) = took(0.1);
        assert!(nodes > 0, "the first goes through the tree");
        assert_eq!(took(0.15), (0, 1), "the next asks that one shape");
        assert_eq!(took(-0.4), (0, 1));
    }
    test::<Fixed>();
    test::<f32>();
    test::<f64>();
}

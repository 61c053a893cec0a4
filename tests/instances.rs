//! Groups placed in a scene: the same as their shapes written out.

use crate::common::make::{Body, Make, Shapes, body};
use crate::common::random::Random;
use crate::common::scenes::{double, fixed, single};
use crate::common::{FromF64, ray};
use whitted::frame::{Renderer, Settings};
use whitted::math::{Arithmetic, Fixed};
use whitted::octree::Limits;
use whitted::scene::uses;
use whitted::scene::{Group, Instance, Parts, Scene, SceneError, Transform};
use whitted::shape::{Leaving, Ray, ShapeError};
use whitted::trace::{Tracer, Work};

/// The constructors are no trait's.
trait Place: Make {
    fn group<'a>(shapes: whitted::scene::Shapes<'a, Self>) -> Result<Group<'a, Self>, SceneError>;
    fn instance<'a>(
        group: &'a Group<'a, Self>,
        transform: &Transform,
    ) -> Result<Instance<'a, Self>, ShapeError>;
}

macro_rules! place {
    ($($a:ident),*) => {$(
        impl Place for $a {
            fn group<'a>(
                shapes: whitted::scene::Shapes<'a, Self>,
            ) -> Result<Group<'a, Self>, SceneError> {
                Group::<$a>::try_new(shapes)
            }
            fn instance<'a>(
                group: &'a Group<'a, Self>,
                transform: &Transform,
            ) -> Result<Instance<'a, Self>, ShapeError> {
                Instance::<$a>::try_new(group, transform)
            }
        }
    )*};
}
place!(Fixed, f32, f64);

/// The radiances of a small picture.
fn picture<A: Arithmetic>(scene: &Scene<'_, A>, camera: &whitted::scene::Camera<A>) -> Vec<f64> {
    let mut work = Work::<A, 5>::new();
    let settings = Settings::new(48, 36);
    let mut renderer = Renderer::new(scene, camera, settings, &mut work, &mut []).expect("right");
    renderer.scan(0..48, 0..36).flat_map(|(_, _, c)| c.map(Into::into)).collect()
}

/// The parts with their bounded shapes in a group.
fn grouped<'a, A: Arithmetic>(
    parts: &Parts<'a, A>,
    instances: &'a [Instance<'a, A>],
) -> Parts<'a, A> {
    Parts {
        instances,
        planes: parts.planes,
        materials: parts.materials,
        lights: parts.lights,
        ambient: parts.ambient,
        background: parts.background,
        rules: parts.rules,
        ..Parts::EMPTY
    }
}

fn identity<A: Place>(parts: &Parts<'_, A>, camera: &whitted::scene::Camera<A>) {
    let group = A::group(parts.shapes()).expect("a group");
    let instances = [A::instance(&group, &Transform::IDENTITY).expect("an instance")];
    let scene = Scene::new(*parts).expect("a scene");
    let other = Scene::new(grouped(parts, &instances)).expect("a scene");
    assert!(picture(&scene, camera) == picture(&other, camera), "{}", A::NAME);
}

#[test]
fn where_it_was_to_the_bit() {
    for tree in [true, false] {
        macro_rules! both {
            ($($module:ident)*) => {$(
                let mut parts = *$module::every::SCENE.parts();
                if !tree {
                    parts.tree = None;
                }
                identity(&parts, &$module::every::CAMERA);
            )*};
        }
        both!(fixed single double);
    }
}

/// A body where a transform takes it; `None` for boxes, which stay along the axes.
fn placed(body: &Body, t: &Transform) -> Option<Body> {
    let s = t.scale;
    let p = |p: &[f64; 3]| t.apply(*p);
    let d = |d: &[f64; 3]| Transform { scale: 1.0, position: [0.0; 3], ..*t }.apply(*d);
    Some(match body {
        Body::Sphere(c, r) => Body::Sphere(p(c), r * s),
        Body::Triangle(c) => Body::Triangle(c.map(|c| t.apply(c))),
        Body::Smooth(c, n) => Body::Smooth(c.map(|c| t.apply(c)), n.map(|n| d(&n))),
        Body::Polygon(c) => Body::Polygon(c.iter().map(p).collect()),
        Body::Disc(c, n, r) => Body::Disc(p(c), d(n), r * s),
        Body::Cylinder(b, a, r) => Body::Cylinder(p(b), p(a), r * s),
        Body::Cone(b, r, a, q) => Body::Cone(p(b), r * s, p(a), q * s),
        Body::Cuboid(..) | Body::Plane(..) => return None,
    })
}

fn transform(random: &mut Random) -> Transform {
    Transform::IDENTITY
        .scaled(random.within(0.2, 5.0))
        .rotated(random.direction(), random.within(-180.0, 180.0))
        .moved(random.point(20.0))
}

/// Distances of rays to a random group placed at random, and to the same shapes written out; by
/// how much they differ, and how many rays hit something in one alone.
fn against_written_out<A: Place>(seed: u64, log2_step: i8) -> (Vec<f64>, usize) {
    let mut random = Random::new(seed);
    let (mut differences, mut strays) = (Vec::new(), 0);
    for round in 0..20 {
        let t = transform(&mut random);
        let bodies: Vec<(Body, u16)> = (0..12 + round * 2)
            .filter_map(|i| {
                let (p, r) = (random.point(3.0), random.within(0.2, 1.0));
                let body = body(&mut random, [0, 1, 2, 3, 5, 6, 7][i % 7], p, r);
                placed(&body, &t).map(|_| (body, 0))
            })
            .collect();
        let out: Vec<(Body, u16)> =
            bodies.iter().filter_map(|(b, m)| placed(b, &t).map(|b| (b, *m))).collect();
        let mut local = Shapes::<A>::of(&bodies, log2_step);
        let mut global = Shapes::<A>::of(&out, log2_step);
        if local.bounded() != global.bounded() {
            continue;
        }
        if round % 2 == 0 {
            local.grow(Limits::DEFAULT);
            global.grow(Limits::DEFAULT);
        }
        let materials = [A::material(&whitted::scene::MaterialSpec::BLACK).expect("black")];
        let parts = local.parts();
        let group = A::group(parts.shapes()).expect("a group");
        let instances = [A::instance(&group, &t).expect("an instance")];
        let placed = Parts { instances: &instances, materials: &materials, ..Parts::EMPTY };
        let placed = Scene::new(placed).expect("a scene");
        let written = Scene::new(Parts { materials: &materials, ..global.parts() }).expect("one");
        let mut work = Work::<A, 2>::new();
        for _ in 0..300 {
            let eye = random.point(60.0);
            let at = t.apply(random.point(3.0));
            let r: Ray<A> = ray(eye, [0, 1, 2].map(|i| at[i] - eye[i]));
            let one = Tracer::new(&placed, 2).surface(&r, &mut work, &mut ());
            let two = Tracer::new(&written, 2).surface(&r, &mut work, &mut ());
            match (one, two) {
                (Some((a, s)), Some((b, q))) if a.shape == b.shape => {
                    let of = |x: A::Length| -> f64 { x.into() };
                    differences.push((of(a.distance) - of(b.distance)).abs());
                    let cosine: f64 = A::dot(&s.normal, &q.normal).into();
                    assert!(cosine > 0.99, "{}: normals {s:?} {q:?}", A::NAME);
                    assert_eq!(s.behind, q.behind);
                }
                (None, None) => {}
                _ => strays += 1,
            }
        }
    }
    differences.sort_by(f64::total_cmp);
    (differences, strays)
}

#[test]
fn anywhere_else_to_a_billionth() {
    let (differences, strays) = against_written_out::<f64>(1, -20);
    assert!(differences.len() > 1500 && strays == 0, "{} {strays}", differences.len());
    assert!(differences.iter().all(|&d| d < 1e-9), "{:?}", differences.last());
}

#[test]
fn anywhere_else_in_fixed_point() {
    let (differences, strays) = against_written_out::<Fixed>(2, -16);
    let typical = differences[differences.len() * 9 / 10];
    println!("{} rays, 9 of 10 within {typical}, {strays} strays", differences.len());
    // Some hit what is beside an edge.
    assert!(differences.len() > 1500 && strays * 50 < differences.len(), "{strays}");
    // A direction is 2⁻¹⁸ wrong, and a shape is often met at a slant.
    assert!(typical < 40.0 / 65536.0, "{typical}");
}

#[test]
fn moving_rebuilds_nothing() {
    let parts = *fixed::every::SCENE.parts();
    let group = Group::<Fixed>::new(parts.shapes());
    let still = [Instance::<Fixed>::new(&group, Transform::IDENTITY)];
    let scene = Scene::new(grouped(&parts, &still)).expect("a scene");
    let camera = &fixed::every::CAMERA;
    let to = Transform::IDENTITY.rotated([0.0, 1.0, 0.0], 40.0).moved([0.5, 0.25, 0.0]);
    let mut moving = still;
    moving[0] = Instance::<Fixed>::new(&group, to);
    let moved = picture(&scene.with_instances(&moving).expect("a scene"), camera);
    let anew = picture(&Scene::new(grouped(&parts, &moving)).expect("a scene"), camera);
    assert!(moved == anew && moved != picture(&scene, camera));
    // and by its position alone
    let there = [still[0].at([0.5, 0.25, 0.0].map(Fixed::length))];
    let straight = [Instance::<Fixed>::new(&group, Transform::IDENTITY.moved([0.5, 0.25, 0.0]))];
    let there = picture(&scene.with_instances(&there).expect("a scene"), camera);
    assert!(there == picture(&scene.with_instances(&straight).expect("a scene"), camera));
    assert!(picture(&scene.with_instances(&[]).expect("a scene"), camera) != there);
}

/// A ray that leaves a shape of an instance knows it, whatever number that has in the scene.
#[test]
fn what_a_ray_leaves_it_does_not_meet() {
    let ball = [whitted::shape::Sphere::<Fixed>::new([0.0; 3], 1.0, 0)];
    let shapes = whitted::scene::Shapes { spheres: &ball, ..whitted::scene::Shapes::EMPTY };
    let group = Group::<Fixed>::new(shapes);
    let place = |x: f64| {
        let turned = Transform::IDENTITY.scaled(1.5).rotated([1.0, 2.0, 3.0], 50.0);
        Instance::<Fixed>::new(&group, turned.moved([x, 0.0, 0.0]))
    };
    let instances = [place(-4.0), place(0.0), place(4.0)];
    let materials = [Fixed::material(&whitted::scene::MaterialSpec::BLACK).expect("black")];
    let scene = Parts { instances: &instances, materials: &materials, ..Parts::EMPTY };
    let scene = Scene::new(scene).expect("a scene");
    let mut work = Work::<Fixed, 2>::new();
    let mut first = |x: f64, direction: f64, leaving: Leaving| {
        let r = Ray { leaving, ..ray::<Fixed>([x, 0.0, 0.0], [direction, 0.0, 0.0]) };
        let hit = Tracer::new(&scene, 2).nearest(&r, &mut work, &mut ())?;
        Some((hit.shape, Into::<f64>::into(hit.distance)))
    };
    let near = |hit: Option<(u32, f64)>, shape: u32, distance: f64| {
        hit.is_some_and(|(s, d)| s == shape && (d - distance).abs() < 1e-3)
    };
    let outwards = Leaving { shape: 1, part: 0, inwards: false };
    assert!(
        near(first(-1.5, 1.0, Leaving::NOTHING), 1, 3.0)
            || near(first(-1.5, 1.0, Leaving::NOTHING), 1, 0.0)
    );
    assert!(near(first(1.5, 1.0, outwards), 2, 1.0));
    assert!(near(first(-1.5, -1.0, outwards), 0, 1.0));
    assert!(near(first(-1.5, 1.0, Leaving { inwards: true, ..outwards }), 1, 3.0));
}

#[test]
fn patterns_move_along_and_materials_can_be_overridden() {
    use whitted::scene::{MaterialSpec, PatternSpec};
    let light = |x: f64| MaterialSpec { ambient: [x; 3], ..MaterialSpec::BLACK };
    let pattern = PatternSpec { cell: [1.0, 0.0, 0.0], offset: [0.0; 3], other: 1 };
    let materials = [
        f64::material(&MaterialSpec { pattern: Some(pattern), ..light(1.0) }).expect("right"),
        f64::material(&light(2.0)).expect("right"),
        f64::material(&light(3.0)).expect("right"),
    ];
    let slab = [whitted::shape::Cuboid::<f64>::new([-2.0, -2.0, 0.0], [2.0, 2.0, 0.5], 0)];
    let shapes = whitted::scene::Shapes { cuboids: &slab, ..whitted::scene::Shapes::EMPTY };
    let group = Group::<f64>::new(shapes);
    let seen = |instance: Instance<'_, f64>, x: f64| {
        let instances = [instance];
        let parts = Parts {
            instances: &instances,
            materials: &materials,
            ambient: <f64 as Make>::ambient([1.0; 3]).expect("right"),
            ..Parts::EMPTY
        };
        let scene = Scene::new(parts).expect("a scene");
        crate::common::radiance(&scene, 1, [x, 0.25, -5.0], [0.0, 0.0, 1.0])[0]
    };
    let still = Instance::<f64>::new(&group, Transform::IDENTITY);
    assert_eq!([0.5, 1.5].map(|x| seen(still, x)), [1.0, 2.0]);
    let moved = still.at([0.75, 0.0, 0.0]);
    assert_eq!([0.5, 1.25, 1.5, 2.25].map(|x| seen(moved, x)), [2.0, 1.0, 1.0, 2.0]);
    assert_eq!([0.5, 1.5].map(|x| seen(still.with_material(2), x)), [3.0, 3.0]);
}

#[test]
fn what_is_wrong_is_said() {
    let ball = |r: f64| [whitted::shape::Sphere::<Fixed>::new([0.0; 3], r, 1)];
    let shapes = |s| whitted::scene::Shapes { spheres: s, ..whitted::scene::Shapes::EMPTY };
    let empty = Group::<Fixed>::try_new(whitted::scene::Shapes::EMPTY);
    assert!(matches!(empty, Err(SceneError::Group)));
    let large = ball(499.9);
    assert!(matches!(Group::<Fixed>::try_new(shapes(&large)), Err(SceneError::Group)));
    let one = ball(1.0);
    let group = Group::<Fixed>::new(shapes(&one));
    let refused = |t: Transform| Instance::<Fixed>::try_new(&group, &t).err();
    let identity = Transform::IDENTITY;
    assert_eq!(refused(identity.scaled(-1.0)), Some(ShapeError::Size));
    assert_eq!(refused(identity.scaled(1e4)), Some(ShapeError::Size));
    assert_eq!(refused(identity.scaled(600.0)), Some(ShapeError::Size));
    assert_eq!(refused(identity.moved([2000.0, 0.0, 0.0])), Some(ShapeError::Coordinate));
    assert_eq!(refused(identity.rotated([0.0; 3], 1.0)), Some(ShapeError::Direction));
    assert_eq!(refused(identity.rotated([1.0; 3], f64::NAN)), Some(ShapeError::Direction));
    let mirror = [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(refused(identity.turned(&mirror)), Some(ShapeError::Direction));
    let material = Fixed::material(&whitted::scene::MaterialSpec::BLACK).expect("black");
    let instances = [Instance::<Fixed>::new(&group, identity)];
    let two = [material; 2];
    let scene =
        |materials| Scene::new(Parts { instances: &instances, materials, ..Parts::EMPTY }).err();
    assert_eq!(scene(&two[..1]), Some(SceneError::Material { index: 1 }));
    assert_eq!(scene(&two), None);
    let other = [instances[0].with_material(7)];
    let parts = Parts { instances: &other, materials: &two, ..Parts::EMPTY };
    assert_eq!(Scene::new(parts).err(), Some(SceneError::Material { index: 7 }));
    let parts = Parts { instances: &instances, ..parts };
    let Err(SceneError::Uses { missing }) = Scene::<Fixed, 0>::try_tailored(parts) else {
        panic!("it uses something")
    };
    assert_eq!(missing, uses::INSTANCES | Parts { instances: &[], ..parts }.uses());
}

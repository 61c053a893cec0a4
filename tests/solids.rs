//! Solids made of several shapes, and caps: against the plain question whether a point is inside.

use crate::common::make::Make;
use crate::common::random::Random;
use crate::common::ray;
use whitted::math::Fixed;
use whitted::octree::{Cube, Extent, Limits, Octree, build_into};
use whitted::scene::{MaterialSpec, Parts, Scene, SceneError};
use whitted::shape::{Cone, Cuboid, Cylinder, Leaving, Operand, Plane, Ray, Region, ShapeError};
use whitted::shape::{Solid, Sphere, Surface};
use whitted::trace::{Tracer, Work};

type Point = [f64; 3];

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn along(o: Point, t: f64, d: Point) -> Point {
    [0, 1, 2].map(|i| o[i] + t * d[i])
}
fn minus(a: Point, b: Point) -> Point {
    along(a, -1.0, b)
}
fn unit(v: Point) -> Point {
    v.map(|x| x / dot(v, v).sqrt())
}

/// A closed convex shape in plain numbers.
#[derive(Clone, Debug)]
enum Body {
    Ball(Point, f64),
    Box(Point, Point),
    /// Base, radius, apex, radius.
    Round(Point, f64, Point, f64),
    Behind(Point, f64),
}

impl Body {
    fn holds(&self, p: Point) -> bool {
        match self {
            Self::Ball(c, r) => dot(minus(p, *c), minus(p, *c)) < r * r,
            Self::Box(low, high) => (0..3).all(|i| p[i] > low[i] && p[i] < high[i]),
            Self::Round(base, r, apex, q) => {
                let way = minus(*apex, *base);
                let s = dot(minus(p, *base), way) / dot(way, way);
                let off = minus(p, along(*base, s, way));
                (0.0..1.0).contains(&s) && dot(off, off) < (r + (q - r) * s).powi(2)
            }
            Self::Behind(n, offset) => dot(unit(*n), p) < *offset,
        }
    }

    fn random(random: &mut Random, kind: u64) -> Self {
        let p = random.point(1.0);
        let r = random.within(0.4, 1.3);
        match kind {
            0 => Self::Ball(p, r),
            1 => {
                let half = [0; 3].map(|_| random.within(0.3, 1.2));
                Self::Box(minus(p, half), along(p, 1.0, half))
            }
            2 => Self::Round(p, 0.6 * r, along(p, 2.0, random.direction()), 0.6 * r),
            3 => Self::Round(p, r, along(p, 2.0, random.direction()), random.within(0.0, 0.5)),
            _ => Self::Behind(random.direction(), random.within(-0.3, 0.8)),
        }
    }
}

/// The constructors are no trait's.
trait MakeSolid: Make {
    fn operand(body: &Body, material: u16) -> Result<Operand<Self>, ShapeError>;
    fn solid(region: Region, operands: &[Operand<Self>]) -> Result<Solid<Self>, ShapeError>;
    fn extent(solid: &Solid<Self>, step: i8) -> Extent;
}

macro_rules! make_solid {
    ($($a:ident),*) => {$(
        impl MakeSolid for $a {
            fn operand(body: &Body, m: u16) -> Result<Operand<Self>, ShapeError> {
                Ok(match *body {
                    Body::Ball(c, r) => Operand::Sphere(Sphere::<$a>::try_new(c, r, m)?),
                    Body::Box(a, b) => Operand::Cuboid(Cuboid::<$a>::try_new(a, b, m)?),
                    Body::Round(b, r, a, q) if r == q => {
                        Operand::Cylinder(Cylinder::<$a>::try_new(b, a, r, m)?)
                    }
                    Body::Round(b, r, a, q) => {
                        Operand::Cone(Cone::<$a>::try_new(b, r, a, q, m)?)
                    }
                    Body::Behind(n, o) => Operand::HalfSpace(Plane::<$a>::try_new(n, o, m)?),
                })
            }
            fn solid(r: Region, operands: &[Operand<Self>]) -> Result<Solid<Self>, ShapeError> {
                Solid::<$a>::try_new(r, operands, 0, operands.len() as u8)
            }
            fn extent(solid: &Solid<Self>, step: i8) -> Extent {
                solid.extent(step)
            }
        }
    )*};
}
make_solid!(Fixed, f32, f64);

/// Bodies and what is made of them.
fn random_solid(random: &mut Random) -> (Vec<Body>, Region) {
    let count = 1 + random.below(5);
    let bodies: Vec<Body> = (0..count)
        .map(|i| {
            let kind = random.below(if i == 0 { 4 } else { 5 });
            Body::random(random, kind)
        })
        .collect();
    let mut region = Region::of(0);
    for (i, body) in bodies.iter().enumerate().skip(1) {
        let other = Region::of(i);
        region = match (random.below(3), body) {
            (0, Body::Ball(..) | Body::Box(..) | Body::Round(..)) => region.or(other),
            (1, _) => region.and(other),
            _ => region.minus(other),
        };
    }
    (bodies, region)
}

fn holds(bodies: &[Body], region: &Region, p: Point) -> bool {
    let mask = bodies.iter().enumerate().fold(0, |m, (k, b)| m | u8::from(b.holds(p)) << k);
    region.holds(mask)
}

/// All distances at which a ray crosses the surface, found by small steps and halving.
fn crossings(bodies: &[Body], region: &Region, o: Point, d: Point) -> Vec<f64> {
    const STEP: f64 = 1.0 / 256.0;
    let inside = |t: f64| holds(bodies, region, along(o, t, d));
    let mut found = Vec::new();
    let mut before = inside(0.0);
    for i in 1..=(16.0 / STEP) as usize {
        let (mut low, mut high) = ((i - 1) as f64 * STEP, i as f64 * STEP);
        let now = inside(high);
        if now != before {
            for _ in 0..40 {
                let middle = (low + high) / 2.0;
                if inside(middle) == before { low = middle } else { high = middle }
            }
            found.push(high);
        }
        before = now;
    }
    found
}

/// The crossings that the tracer finds, following the ray through; whether each is seen from
/// inside, and where each lies.
fn followed<A: MakeSolid>(scene: &Scene<'_, A>, start: Ray<A>) -> Vec<(f64, Surface<A>)> {
    let mut work = Work::<A, 2>::new();
    let tracer = Tracer::new(scene, 2);
    let (mut r, mut gone, mut found) = (start, 0.0, Vec::new());
    for _ in 0..20 {
        let Some((hit, surface)) = tracer.surface(&r, &mut work, &mut ()) else { break };
        gone += Into::<f64>::into(hit.distance);
        found.push((gone, surface));
        let p = A::along(&r.origin, hit.distance, &r.direction);
        let onwards = surface.geometric.map(|x| -x);
        r.origin = A::leave(&p, &onwards, hit.distance);
        r.leaving = Leaving::through(hit.shape, &surface);
    }
    found
}

/// Compares random rays through random solids; how many rays there were, how many crossings, and
/// how many rays differ.
fn compare<A: MakeSolid>(seed: u64, tolerance: f64) -> (usize, usize, usize) {
    let mut random = Random::new(seed);
    let material = A::material(&MaterialSpec::BLACK).expect("black");
    let (mut rays, mut all, mut strays) = (0, 0, 0);
    for _ in 0..150 {
        let (bodies, region) = random_solid(&mut random);
        let operands: Vec<Operand<A>> =
            bodies.iter().map(|b| A::operand(b, 0).expect("an operand")).collect();
        // One whose parts don't meet has no inside.
        let Ok(solid) = A::solid(region, &operands) else { continue };
        let solids = [solid];
        let materials = [material];
        let parts =
            Parts { solids: &solids, operands: &operands, materials: &materials, ..Parts::EMPTY };
        let scene = Scene::new(parts).expect("a scene");
        for _ in 0..20 {
            let (o, at) = (random.direction().map(|x| 6.0 * x), random.point(1.2));
            let r: Ray<A> = ray(o, minus(at, o));
            // as the arithmetic has it
            let o = r.origin.map(Into::into);
            let d = unit(r.direction.map(Into::into));
            let want = crossings(&bodies, &region, o, d);
            let found = followed(&scene, r);
            rays += 1;
            all += want.len();
            let near = |(a, b): (&f64, &(f64, Surface<A>))| (a - b.0).abs() < tolerance;
            let right = want.len() == found.len()
                && want.iter().zip(&found).all(near)
                && found.iter().enumerate().all(|(i, (_, s))| s.behind == (i % 2 == 1));
            // The normal is that of the surface: a step along it leads to the side of the ray.
            let normals = right
                && want.iter().zip(&found).enumerate().all(|(i, (t, (_, s)))| {
                    let n: Point = s.geometric.map(Into::into);
                    let side = |x: f64| holds(&bodies, &region, along(along(o, *t, d), x, n));
                    let slant = dot(n, d).abs() < 0.05;
                    slant || (side(2e-3) == (i % 2 == 1) && side(-2e-3) == (i % 2 == 0))
                });
            strays += usize::from(!normals);
        }
    }
    println!("{}: {rays} rays, {all} crossings, {strays} strays", A::NAME);
    (rays, all, strays)
}

#[test]
fn in_double() {
    let (rays, all, strays) = compare::<f64>(1, 1e-6);
    // What is thinner than a step of the reference, or lies at an edge of two operands.
    assert!(rays > 1500 && all > 1000 && strays * 100 < rays, "{rays} {all} {strays}");
}

#[test]
fn in_single() {
    let (rays, _, strays) = compare::<f32>(2, 1e-3);
    assert!(strays * 50 < rays, "{rays} {strays}");
}

#[test]
fn in_fixed() {
    let (rays, _, strays) = compare::<Fixed>(3, 0.01);
    assert!(strays * 25 < rays, "{rays} {strays}");
}

/// A ray along the axis, through the caps; one from outside through a cap and the wall.
#[test]
fn caps_close_what_is_open() {
    let z = [0.0, 0.0, 1.0];
    let cylinder = Cylinder::<f64>::new([0.0; 3], [0.0, 0.0, 2.0], 1.0, 0);
    let cone = Cone::<f64>::new([0.0; 3], 1.0, [0.0, 0.0, 2.0], 0.5, 0);
    let materials = [f64::material(&MaterialSpec::BLACK).expect("black")];
    let through = |cylinders: &[Cylinder<f64>], cones: &[Cone<f64>], o: Point, d: Point| {
        let parts = Parts { cylinders, cones, materials: &materials, ..Parts::EMPTY };
        let scene = Scene::new(parts).expect("a scene");
        followed(&scene, ray::<f64>(o, d)).iter().map(|(t, _)| *t).collect::<Vec<f64>>()
    };
    let near = |a: Vec<f64>, b: &[f64]| {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9)
    };
    assert!(near(through(&[cylinder], &[], [0.5, 0.0, -1.0], z), &[]));
    let capped = [cylinder.with_caps()];
    assert!(near(through(&capped, &[], [0.5, 0.0, -1.0], z), &[1.0, 3.0]));
    assert!(near(through(&capped, &[], [0.0, 0.0, 1.0], z), &[1.0]));
    assert!(near(through(&capped, &[], [0.0, 0.0, 3.0], z), &[]));
    assert!(near(through(&capped, &[], [1.5, 0.0, -1.0], z), &[]));
    let slant = through(&capped, &[], [0.0, 0.0, -0.8], [0.6, 0.0, 0.8]);
    assert!(near(slant, &[1.0, 1.0 / 0.6]), "in at the base, out through the wall");
    assert!(near(through(&[], &[cone], [0.25, 0.0, -1.0], z), &[]));
    let capped = [cone.with_caps()];
    assert!(near(through(&[], &capped, [0.25, 0.0, -1.0], z), &[1.0, 3.0]));
    assert!(near(through(&[], &capped, [0.75, 0.0, -1.0], z), &[1.0, 2.0]));
    // Only the inside shows.
    let inside = Cylinder::<f64>::new([0.0; 3], [0.0, 0.0, 2.0], -1.0, 0).with_caps();
    assert!(near(through(&[inside], &[], [0.5, 0.0, -1.0], z), &[3.0]));
}

#[test]
fn a_tree_finds_solids_too() {
    let mut random = Random::new(5);
    let mut bodies = Vec::new();
    let mut operands = Vec::new();
    let mut solids = Vec::new();
    for _ in 0..40 {
        let c = random.point(6.0);
        let bite = along(c, 0.5, random.direction());
        for body in [Body::Ball(c, 0.7), Body::Ball(bite, 0.5)] {
            operands.push(f64::operand(&body, 0).expect("a ball"));
            bodies.push(body);
        }
    }
    for i in 0..40 {
        let region = Region::of(0).minus(Region::of(1));
        solids.push(Solid::<f64>::new(region, &operands, 2 * i, 2));
    }
    let extents: Vec<Extent> = solids.iter().map(|s| f64::extent(s, -20)).collect();
    let (mut words, mut scratch) = (vec![0; 4096], vec![0; 4096]);
    let built = build_into(&extents, &mut words, &mut scratch, Limits::DEFAULT).expect("a tree");
    let cube: &Cube = &built.cube;
    let tree = Octree::<f64>::try_new(&words[..built.words], 40, cube, -20).expect("a tree");
    let materials = [f64::material(&MaterialSpec::BLACK).expect("black")];
    let list =
        Parts { solids: &solids, operands: &operands, materials: &materials, ..Parts::EMPTY };
    let with = Scene::new(Parts { tree: Some(tree), ..list }).expect("a scene");
    let without = Scene::new(list).expect("a scene");
    let mut hits = 0;
    for _ in 0..500 {
        let (o, at) = (random.direction().map(|x| 15.0 * x), random.point(6.0));
        let r: Ray<f64> = ray(o, minus(at, o));
        let (a, b) = (followed(&with, r), followed(&without, r));
        assert_eq!(a.len(), b.len());
        hits += a.len();
        assert!(a.iter().zip(&b).all(|(a, b)| a.0 == b.0));
    }
    assert!(hits > 300, "{hits}");
}

#[test]
fn what_is_wrong_is_said() {
    let ball = |x: f64| f64::operand(&Body::Ball([x, 0.0, 0.0], 1.0), 3).expect("a ball");
    let behind = f64::operand(&Body::Behind([0.0, 1.0, 0.0], 0.0), 3).expect("a half-space");
    let two = [ball(0.0), behind];
    let refused = |region, operands: &[Operand<f64>]| f64::solid(region, operands).err();
    let wrong = Some(ShapeError::Operands);
    assert_eq!(refused(Region::of(0), &two), None);
    assert_eq!(refused(Region::NOTHING, &two), wrong);
    assert_eq!(refused(Region::of(2), &two), wrong);
    assert_eq!(refused(Region::of(1), &two), wrong);
    assert_eq!(refused(Region::of(0).or(Region::of(1)), &two), wrong);
    assert_eq!(refused(Region::of(0).and(Region::of(1)), &[ball(0.0), ball(5.0)]), wrong);
    assert_eq!(refused(Region::of(0), &[ball(0.0); 9]), wrong);
    assert_eq!(refused(Region::of(0), &[]), wrong);
    assert!(Solid::<f64>::try_new(Region::of(0), &two, 2, 1).is_err());
}

#[test]
fn scenes_check_their_solids() {
    let ball = f64::operand(&Body::Ball([0.0; 3], 1.0), 3).expect("a ball");
    let solids = [Solid::<f64>::new(Region::of(0), &[ball; 3], 2, 1)];
    let material = f64::material(&MaterialSpec::BLACK).expect("black");
    let error = |operands, materials| {
        Scene::new(Parts { solids: &solids, operands, materials, ..Parts::EMPTY }).err()
    };
    let (operands, materials) = ([ball; 3], [material; 4]);
    assert_eq!(error(&operands[..2], &materials[..]), Some(SceneError::Operands { solid: 0 }));
    assert_eq!(error(&operands[..], &materials[..3]), Some(SceneError::Material { index: 3 }));
    assert_eq!(error(&operands[..], &materials[..]), None);
}

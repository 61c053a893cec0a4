//! Three rays through a tank of glass with water in it, against paths by hand.
//!
//! Snell's law says that n times the sine of the angle stays; so of a vector along the ray whose length is
//! the index n, the components along a flat wall stay, and the one across it follows from the length.
//! No formula of the tracer's is used.

use crate::common::{FromF64, ray};
use whitted::math::{Arithmetic, Fixed, Rgb};
use whitted::scene::{Material, MaterialSpec, Parts, Rules, Scene};
use whitted::shape::{Cuboid, Ray};
use whitted::tally::{RayKind, Tally};
use whitted::trace::{Tracer, Work};

const AIR: f64 = 1.0;
const GLASS: f64 = 1.5;
const WATER: f64 = 1.333;

/// The glass reaches to 1 from the middle, the water to 0.8.
const WALL: f64 = 1.0;
const INNER: f64 = 0.8;

const OUTSIDE: MaterialSpec = MaterialSpec {
    transmission: [1.0; 3],
    index_front: AIR,
    index_behind: GLASS,
    ..MaterialSpec::BLACK
};
const INSIDE: MaterialSpec = MaterialSpec { index_front: GLASS, index_behind: WATER, ..OUTSIDE };

/// A point, and the vector along the ray as long as the index.
#[derive(Clone, Copy, Debug)]
struct Way {
    at: [f64; 3],
    along: [f64; 3],
}

impl Way {
    fn new(at: [f64; 3], direction: [f64; 3]) -> Self {
        let length = direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        Self { at, along: direction.map(|x| x / length) }
    }

    /// On to the wall where a coordinate has a value, and into a medium.
    fn through(self, axis: usize, value: f64, index: f64) -> Self {
        let t = (value - self.at[axis]) / self.along[axis];
        assert!(t > 0.0, "the wall lies ahead");
        let at = [0, 1, 2].map(|i| self.at[i] + t * self.along[i]);
        let mut along = self.along;
        along[axis] = 0.0;
        let rest = index * index - along.iter().map(|x| x * x).sum::<f64>();
        assert!(rest > 0.0, "it gets through");
        along[axis] = rest.sqrt().copysign(self.along[axis]);
        Self { at, along }
    }

    fn direction(self) -> [f64; 3] {
        let length = self.along.iter().map(|x| x * x).sum::<f64>().sqrt();
        self.along.map(|x| x / length)
    }
}

/// The transmitted rays in the order that they are sent.
#[derive(Default)]
struct Transmitted(Vec<([f64; 3], [f64; 3])>);

impl Tally for Transmitted {
    fn ray<A: Arithmetic>(&mut self, kind: RayKind, _: u8, ray: &Ray<A>, _: &Rgb<A::Weight>) {
        if kind == RayKind::Transmission {
            self.0.push((ray.origin.map(Into::into), ray.direction.map(Into::into)));
        }
    }
}

fn follows<A: FromF64>(scene: &Scene<'_, A>, tolerance: f64, start: Way, path: &[Way]) {
    let mut sent = Transmitted::default();
    let mut work = Work::<A, 8>::new();
    let first = ray::<A>(start.at, start.along);
    Tracer::new(scene, 8).radiance(first, &mut work, &mut sent);
    assert_eq!(sent.0.len(), path.len(), "{:#?}", sent.0);
    for (way, (origin, direction)) in path.iter().zip(&sent.0) {
        let wanted = way.direction();
        for i in 0..3 {
            let (p, d) = ((origin[i] - way.at[i]).abs(), (direction[i] - wanted[i]).abs());
            assert!(
                p < tolerance && d < tolerance,
                "{}: {origin:?} {direction:?} for {way:?}",
                A::NAME
            );
        }
    }
}

fn three_rays<A: FromF64>(scene: &Scene<'_, A>, tolerance: f64) {
    // Straight through at 45 degrees: 28.1 in the glass, 32.0 in the water, 45 again.
    let start = Way::new([-2.0, -1.7, 0.1], [1.0, 1.0, 0.0]);
    let path = straight(start);
    let angles = path.map(|way| way.direction()[1].asin().to_degrees());
    for (angle, printed) in angles.into_iter().zip([28.13, 32.04, 28.13, 45.0]) {
        assert!((angle - printed).abs() < 0.005, "{angle}");
    }
    follows(scene, tolerance, start, &path);

    // Obliquely: all three coordinates change.
    let start = Way::new([-1.75, -0.41, 0.33], [1.0, 0.37, -0.52]);
    follows(scene, tolerance, start, &straight(start));

    // In at the side, out at the top: almost grazing both, else it couldn't leave.
    let sine = 0.95f64;
    let start = Way::new(
        [-1.2, 0.1 - 0.2 * sine / (1.0 - sine * sine).sqrt(), -0.2],
        [(1.0 - sine * sine).sqrt(), sine, 0.0],
    );
    let glass = start.through(0, -WALL, GLASS);
    let water = glass.through(0, -INNER, WATER);
    let top = water.through(1, INNER, GLASS);
    let out = top.through(1, WALL, AIR);
    follows(scene, tolerance, start, &[glass, water, top, out]);
}

fn straight(start: Way) -> [Way; 4] {
    let glass = start.through(0, -WALL, GLASS);
    let water = glass.through(0, -INNER, WATER);
    let wall = water.through(0, INNER, GLASS);
    [glass, water, wall, wall.through(0, WALL, AIR)]
}

macro_rules! tank {
    ($($name:ident: $a:ty, $tolerance:expr;)*) => {$(
        #[test]
        fn $name() {
            let cuboid = |half: f64, material| Cuboid::<$a>::new([-half; 3], [half; 3], material);
            let parts = Parts::<$a> {
                cuboids: &[cuboid(WALL, 0), cuboid(INNER, 1)],
                materials: &[Material::<$a>::new(OUTSIDE), Material::<$a>::new(INSIDE)],
                rules: Rules { cutoff: <$a>::NO_WEIGHT, ..Rules::WHITTED },
                ..Parts::EMPTY
            };
            let scene = Scene::<$a>::checked(parts);
            three_rays(&scene, $tolerance);
        }
    )*};
}

tank! {
    double: f64, 1e-9;
    // A few steps of 2⁻²⁴, grown by the grazing ray.
    single: f32, 1e-5;
    // Directions of 17 bits and cosines from roots of 15: grown fivefold where the ray grazes, and then
    // by the way.
    fixed: Fixed, 1e-3;
}

//! The glass of water: three rays through its walls, against paths computed by hand.
//!
//! All of it happens in the plane z = 0, where walls are straight lines: there refraction is
//! arithmetic on angles, without vectors, and so independent of the tracer's formula.

use whitted::math::{Arithmetic, Rgb};
use whitted::shape::{Leaving, Ray};
use whitted::tally::{RayKind, Tally};
use whitted::trace::{Tracer, Work};
use whitted_host::bake::Baked;
use whitted_host::number::to_f64;
use whitted_host::read::{Format, parse};

const SCENE: &[u8] = include_bytes!("../scenes/glass.toml");
const AIR: f64 = 1.0;
const WATER: f64 = 1.333;
const GLASS: f64 = 1.5;
/// Offsets from surfaces, and the few digits that the file gives its radii with.
const NEAR: f64 = 2e-6;

/// A line of the glass's section, from one (x, y) to another.
type Wall = [[f64; 2]; 2];

const OUTSIDE: Wall = [[0.30, 0.002], [0.385, 1.0]];
const INSIDE: Wall = [[0.27, 0.07], [0.355, 1.0]];

fn mirrored(wall: Wall) -> Wall {
    wall.map(|[x, y]| [-x, y])
}

fn level(y: f64) -> Wall {
    [[-1.0, y], [1.0, y]]
}

/// A ray in the plane: where, and the angle of its direction from +x.
#[derive(Clone, Copy, Debug)]
struct Way {
    at: [f64; 2],
    angle: f64,
}

impl Way {
    /// Goes on to a wall, and through it.
    fn through(self, wall: Wall, from: f64, to: f64) -> Self {
        let [[ax, ay], [bx, by]] = wall;
        let (dx, dy) = (self.angle.cos(), self.angle.sin());
        // Where the two lines cross.
        let (wx, wy) = (bx - ax, by - ay);
        let t = ((ax - self.at[0]) * wy - (ay - self.at[1]) * wx) / (dx * wy - dy * wx);
        assert!(t > 0.0, "the wall lies ahead");
        // The normal that points the way that the ray goes, and the angle off it.
        let mut normal = wy.atan2(wx) + std::f64::consts::FRAC_PI_2;
        if (self.angle - normal).cos() < 0.0 {
            normal += std::f64::consts::PI;
        }
        let sine = (self.angle - normal).sin() * from / to;
        Self { at: [self.at[0] + t * dx, self.at[1] + t * dy], angle: normal + sine.asin() }
    }
}

/// The transmitted rays that the tracer sends, and which rays they are.
#[derive(Default)]
struct Transmitted(Vec<(u8, [f64; 3], [f64; 3])>);

impl Tally for Transmitted {
    fn ray<A: Arithmetic>(&mut self, kind: RayKind, depth: u8, ray: &Ray<A>, _: &Rgb<A::Weight>) {
        if kind == RayKind::Transmission {
            self.0.push((depth, ray.origin.map(to_f64), ray.direction.map(to_f64)));
        }
    }
}

/// Sends a ray into the scene, and asks that it goes on as `path` says, interface by interface.
fn follows(start: Way, path: &[Way]) {
    let document = parse(Format::Toml, SCENE).expect("the scene is right");
    let baked = Baked::<f64>::new(&document).expect("f64 holds it");
    let ray = Ray {
        origin: [start.at[0], start.at[1], 0.0],
        direction: [start.angle.cos(), start.angle.sin(), 0.0],
        leaving: Leaving::NOTHING,
    };
    let mut sent = Transmitted::default();
    let depth = document.rules.depth;
    let mut work = Work::<f64, 64>::new();
    let seen = baked.with_scene(|scene| {
        Tracer::new(scene, depth).radiance(ray, &mut work, &mut sent);
    });
    seen.expect("it is whole");
    for (way, wanted) in path.iter().zip(2u8..) {
        let right = sent.0.iter().any(|&(depth, origin, direction)| {
            let [x, y] = way.at;
            let beside =
                |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < NEAR);
            depth == wanted
                && beside(origin, [x, y, 0.0])
                && beside(direction, [way.angle.cos(), way.angle.sin(), 0.0])
        });
        assert!(right, "no ray of depth {wanted} at {way:?} among {:#?}", sent.0);
    }
}

#[test]
fn down_through_the_water() {
    // 40 degrees off the vertical: 28.8 in the water, 25.4 in the glass, 40 again below.
    let start = Way { at: [0.32, 0.95], angle: (-90.0f64 - 40.0).to_radians() };
    let water = start.through(level(0.69), AIR, WATER);
    let glass = water.through(level(0.07), WATER, GLASS);
    let air = glass.through(level(0.002), GLASS, AIR);
    let off = |way: Way| (-90.0 - way.angle.to_degrees()).rem_euclid(360.0);
    for (way, degrees) in [(water, 28.83), (glass, 25.37), (air, 40.0)] {
        assert!((off(way) - degrees).abs() < 0.005, "{} degrees", off(way));
    }
    follows(start, &[water, glass, air]);
}

#[test]
fn across_the_water() {
    let start = Way { at: [1.5, 0.60], angle: std::f64::consts::PI };
    let glass = start.through(OUTSIDE, AIR, GLASS);
    let water = glass.through(INSIDE, GLASS, WATER);
    let wall = water.through(mirrored(INSIDE), WATER, GLASS);
    let out = wall.through(mirrored(OUTSIDE), GLASS, AIR);
    follows(start, &[glass, water, wall, out]);
}

#[test]
fn across_the_air_above_it() {
    // Two walls that are almost parallel, twice: the ray goes on almost as it came.
    let start = Way { at: [1.5, 0.85], angle: std::f64::consts::PI };
    let glass = start.through(OUTSIDE, AIR, GLASS);
    let air = glass.through(INSIDE, GLASS, AIR);
    let wall = air.through(mirrored(INSIDE), AIR, GLASS);
    let out = wall.through(mirrored(OUTSIDE), GLASS, AIR);
    assert!((out.angle - start.angle).abs() < 0.02);
    follows(start, &[glass, air, wall, out]);
}

//! Shapes as tests describe them, and textbook formulas in `f64` for them.

extern crate std;

mod distance;
mod probe;
mod properties;

use super::testing::{Test, ray};
use super::*;
use crate::math::{Fixed, FixedEdge};
use probe::{Make, Probe, with};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::prelude::v1::*;
use std::vec;

type V = [f64; 3];

fn add(a: V, b: V) -> V {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
fn minus(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
fn times(a: V, k: f64) -> V {
    a.map(|x| x * k)
}
fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
fn unit(a: V) -> V {
    times(a, 1.0 / dot(a, a).sqrt())
}

/// A shape as a test describes it.
#[derive(Clone, Debug)]
enum Solid {
    Sphere(V, f64),
    Disc(V, V, f64),
    Cuboid(V, V),
    Triangle([V; 3]),
    Polygon(Vec<V>),
    Cylinder(V, V, f64),
    Cone(V, f64, V, f64),
}

/// All distances at which a ray meets the shape, and the outward normals there: textbook forms,
/// for well-conditioned input.
fn reference(solid: &Solid, o: V, d: V) -> Vec<(f64, V)> {
    let mut hits = match solid {
        Solid::Sphere(c, r) => {
            let f = minus(o, *c);
            roots(1.0, dot(f, d), dot(f, f) - r * r)
                .into_iter()
                .map(|t| (t, unit(minus(add(o, times(d, t)), *c))))
                .collect()
        }
        Solid::Disc(c, n, r) => {
            let n = unit(*n);
            let t = dot(minus(*c, o), n) / dot(d, n);
            let v = minus(add(o, times(d, t)), *c);
            if dot(v, v) < r * r { vec![(t, n)] } else { vec![] }
        }
        Solid::Cuboid(min, max) => {
            let mut hits = vec![];
            for i in 0..3 {
                for (bound, sign) in [(min[i], -1.0), (max[i], 1.0)] {
                    let t = (bound - o[i]) / d[i];
                    let p = add(o, times(d, t));
                    if (0..3).all(|j| j == i || (p[j] > min[j] && p[j] < max[j])) {
                        let mut n = [0.0; 3];
                        n[i] = sign;
                        hits.push((t, n));
                    }
                }
            }
            hits
        }
        Solid::Triangle(c) => moller_trumbore(c, o, d).into_iter().collect(),
        Solid::Polygon(c) => (1..c.len() - 1)
            .filter_map(|i| moller_trumbore(&[c[0], c[i], c[i + 1]], o, d))
            .collect(),
        Solid::Cylinder(b, a, r) => round(*b, *r, *a, *r, o, d),
        Solid::Cone(b, r0, a, r1) => round(*b, *r0, *a, *r1, o, d),
    };
    hits.retain(|h| h.0.is_finite() && h.0 > 0.0);
    hits.sort_by(|a, b| a.0.total_cmp(&b.0));
    hits
}

/// Of a·t² + 2b·t + c.
fn roots(a: f64, b: f64, c: f64) -> Vec<f64> {
    let square = b * b - a * c;
    if square < 0.0 { vec![] } else { vec![(-b - square.sqrt()) / a, (-b + square.sqrt()) / a] }
}

fn moller_trumbore(c: &[V; 3], o: V, d: V) -> Option<(f64, V)> {
    let (e1, e2) = (minus(c[1], c[0]), minus(c[2], c[0]));
    let p = cross(d, e2);
    let det = dot(e1, p);
    let s = minus(o, c[0]);
    let u = dot(s, p) / det;
    let q = cross(s, e1);
    let v = dot(d, q) / det;
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    if inside { Some((dot(e2, q) / det, unit(cross(e1, e2)))) } else { None }
}

/// |p − b|² − s² = (r₀ + k·s)²
fn round(b: V, r0: f64, apex: V, r1: f64, o: V, d: V) -> Vec<(f64, V)> {
    let way = minus(apex, b);
    let length = dot(way, way).sqrt();
    let axis = unit(way);
    let k = (r1 - r0) / length;
    let f = minus(o, b);
    let (s, ds) = (dot(f, axis), dot(d, axis));
    let r = r0 + k * s;
    let across = |v: V, s: f64| minus(v, times(axis, s));
    let (fp, dp) = (across(f, s), across(d, ds));
    let a = dot(dp, dp) - k * k * ds * ds;
    let half_b = dot(fp, dp) - r * k * ds;
    let c = dot(fp, fp) - r * r;
    roots(a, half_b, c)
        .into_iter()
        .filter(|t| (0.0..=length).contains(&(s + t * ds)))
        .map(|t| {
            let v = across(minus(add(o, times(d, t)), b), s + t * ds);
            (t, unit(minus(unit(v), times(axis, k))))
        })
        .collect()
}

fn point() -> impl Strategy<Value = V> {
    prop::array::uniform3(-1.0..1.0f64)
}

/// Shapes of about a unit.
fn solid() -> impl Strategy<Value = Solid> {
    let size = || 0.1..0.8f64;
    prop_oneof![
        (point(), size()).prop_map(|(c, r)| Solid::Sphere(c, r)),
        (point(), point(), size()).prop_map(|(c, n, r)| Solid::Disc(c, n, r)),
        (point(), prop::array::uniform3(0.1..1.0f64))
            .prop_map(|(a, b)| Solid::Cuboid(a, add(a, b))),
        prop::array::uniform3(point()).prop_map(Solid::Triangle),
        (point(), point(), point(), size(), 3usize..12, 0.3..1.0f64).prop_map(
            |(c, a, b, r, n, squash)| {
                let z = unit(a);
                let x = unit(cross(z, b));
                let y = cross(z, x);
                let corner = |i| {
                    let angle = (i as f64 + 0.1) / n as f64 * std::f64::consts::TAU;
                    let (u, v) = (r * angle.cos(), r * squash * angle.sin());
                    add(c, add(times(x, u), times(y, v)))
                };
                Solid::Polygon((0..n).map(corner).collect())
            }
        ),
        (point(), point(), size()).prop_map(|(b, a, r)| Solid::Cylinder(b, a, r)),
        (point(), size(), point(), size()).prop_map(|(b, r, a, s)| Solid::Cone(b, r, a, s)),
        (point(), point(), size()).prop_map(|(b, a, r)| Solid::Cone(b, 0.0, a, r)),
        (point(), point(), size()).prop_map(|(b, a, r)| Solid::Cone(b, r, a, 0.0)),
    ]
    .prop_filter("neither flat nor short", |s| match s {
        Solid::Disc(_, n, _) => dot(*n, *n) > 0.01,
        Solid::Triangle(c) => {
            let n = cross(minus(c[1], c[0]), minus(c[2], c[0]));
            dot(n, n) > 0.01
        }
        Solid::Polygon(c) => c.iter().flatten().all(|x| x.is_finite()),
        Solid::Cylinder(b, a, _) | Solid::Cone(b, _, a, _) => {
            dot(minus(*a, *b), minus(*a, *b)) > 0.1
        }
        _ => true,
    })
}

fn scaled(solid: &Solid, k: f64) -> Solid {
    let v = |x: &V| times(*x, k);
    match solid {
        Solid::Sphere(c, r) => Solid::Sphere(v(c), r * k),
        Solid::Disc(c, n, r) => Solid::Disc(v(c), *n, r * k),
        Solid::Cuboid(a, b) => Solid::Cuboid(v(a), v(b)),
        Solid::Triangle(c) => Solid::Triangle(c.map(|x| times(x, k))),
        Solid::Polygon(c) => Solid::Polygon(c.iter().map(v).collect()),
        Solid::Cylinder(b, a, r) => Solid::Cylinder(v(b), v(a), r * k),
        Solid::Cone(b, r, a, s) => Solid::Cone(v(b), r * k, v(a), s * k),
    }
}

/// The reference's answer if rays that start `clear` away meet the same surface, at nearly the
/// same distance; and by how much their normals differ. Rays a quarter as far away are asked, too:
/// those farther away may all miss a sharp corner that this one passes.
fn clearly(solid: &Solid, o: V, d: V, clear: f64) -> Option<(Option<(f64, V)>, f64)> {
    let first = reference(solid, o, d).first().copied();
    let mut turn = 0.0f64;
    for i in 0..3 {
        for step in [clear, -clear, 0.25 * clear, -0.25 * clear] {
            let mut near = o;
            near[i] += step;
            match (first, reference(solid, near, d).first()) {
                (None, None) => {}
                (Some(a), Some(b)) if (a.0 - b.0).abs() < 6.0 * clear && a.0 > 2.0 * clear => {
                    let f = minus(a.1, b.1);
                    turn = turn.max(dot(f, f).sqrt());
                }
                _ => return None,
            }
        }
    }
    Some((first, turn))
}

/// Distance, side and normal agree with the reference, wherever that is clear.
fn agree<A: Test + Make>(
    solid: &Solid,
    o: V,
    d: V,
    clear: f64,
    bound: f64,
    normal_bound: f64,
) -> Result<(), TestCaseError> {
    let ray = ray::<A>(o, d);
    let (o, d) = (ray.origin.map(A::of_length), unit(ray.direction.map(A::of_unit)));
    // At a glance a flat shape is larger than it is, in fixed point by a thirtieth: more than is
    // clear.
    if face(solid).is_some_and(|n| dot(n, d).abs() < 4.0 * A::GLANCE) {
        return Ok(());
    }
    let Some((expected, turn)) = clearly(solid, o, d, clear) else { return Ok(()) };
    // where a surface bends, an error of the position is one of the normal
    let normal_bound = normal_bound + turn * (bound / clear);
    with::<A, _>(solid, |shape| {
        let hit = shape.nearest(&ray, false, A::FAR).filter(|m| m.distance < A::FAR);
        match (hit, expected) {
            (None, None) => {}
            (Some(m), Some((t, n))) => {
                let off = (A::of_length(m.distance) - t).abs();
                prop_assert!(off < bound, "{}: {:?} for {}", A::NAME, m, t);
                let s = shape.surface(&ray, &m);
                let behind = dot(n, d) > 0.0;
                prop_assert_eq!(s.behind, behind);
                let n = if behind { times(n, -1.0) } else { n };
                let got = s.normal.map(A::of_unit);
                for i in 0..3 {
                    prop_assert!((got[i] - n[i]).abs() < normal_bound, "{:?} for {:?}", got, n);
                }
                let cosine = A::of_unit(s.cosine);
                prop_assert!(cosine >= 0.0 && (cosine + dot(n, d)).abs() < 2.0 * normal_bound);
                // what occludes, and what doesn't
                prop_assert!(shape.occludes(&ray, A::length(t + clear)));
                prop_assert!(
                    !shape.occludes(&ray, A::length(t - clear)),
                    "{} {:?} {:?} {}",
                    A::NAME,
                    ray,
                    m,
                    t
                );
                prop_assert!(shape.nearest(&ray, false, A::length(t - clear)).is_none());
            }
            (got, expected) => prop_assert!(false, "{}: {got:?} for {expected:?}", A::NAME),
        }
        Ok(())
    })
    .unwrap_or(Ok(()))
}

/// Where to aim to hit a shape more often than not: near its middle.
fn aimed(solid: &Solid, p: V) -> V {
    let (middle, reach) = match solid {
        Solid::Sphere(c, r) | Solid::Disc(c, _, r) => (*c, *r),
        Solid::Cuboid(a, b) => (times(add(*a, *b), 0.5), 0.5),
        Solid::Triangle(c) => (times(add(add(c[0], c[1]), c[2]), 1.0 / 3.0), 0.5),
        Solid::Polygon(c) => (center(c), 0.3),
        Solid::Cylinder(b, a, r) => (times(add(*b, *a), 0.5), *r),
        Solid::Cone(b, r, a, s) => (times(add(*b, *a), 0.5), (r + s) * 0.5),
    };
    add(middle, times(p, reach * 1.2))
}

/// The normal of a shape made of triangles.
fn face(solid: &Solid) -> Option<V> {
    match solid {
        Solid::Triangle(c) => Some(unit(cross(minus(c[1], c[0]), minus(c[2], c[0])))),
        Solid::Polygon(c) => Some(unit(cross(minus(c[1], c[0]), minus(c[2], c[0])))),
        _ => None,
    }
}

fn center(c: &[V]) -> V {
    times(c.iter().copied().fold([0.0; 3], add), 1.0 / c.len() as f64)
}

/// The origin moved so that, for small `glance`, the ray to `p` grazes the plane across `n`.
fn glancing(o: V, p: V, n: V, glance: f64) -> V {
    let n = unit(n);
    if glance < 0.5 { add(o, times(n, dot(minus(p, o), n) * (1.0 - glance * glance))) } else { o }
}

/// From a point around towards one within the scene.
fn sight() -> impl Strategy<Value = (V, V)> {
    (prop::array::uniform3(-3.0..3.0f64), point())
        .prop_filter("apart", |(a, b)| dot(minus(*a, *b), minus(*a, *b)) > 0.01)
}

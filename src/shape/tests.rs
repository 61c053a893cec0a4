//! What all shapes must do, in every arithmetic, against textbook formulas in `f64`.

use super::testing::{Test, ray};
use super::*;
use crate::math::{Fixed, FixedEdge};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
extern crate std;
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

/// `f` of the shape in an arithmetic; `None` where it can't be made.
fn with<A: Test + Make, R>(solid: &Solid, f: impl FnOnce(&dyn Probe<A>) -> R) -> Option<R> {
    A::make(solid).map(|shape| f(&*shape))
}

/// [`Shape`] without its constant, so that it can be a trait object.
trait Probe<A: Arithmetic> {
    fn nearest(&self, ray: &Ray<A>, inwards: bool, limit: A::Length) -> Option<Meeting<A>>;
    fn occludes(&self, ray: &Ray<A>, limit: A::Length) -> bool;
    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>) -> Surface<A>;
    fn flat(&self) -> bool;
}

impl<A: Arithmetic, S: Shape<A>> Probe<A> for S {
    fn nearest(&self, ray: &Ray<A>, inwards: bool, limit: A::Length) -> Option<Meeting<A>> {
        Shape::nearest(self, ray, &A::coarse(&ray.origin, &ray.direction), inwards, limit)
    }
    fn occludes(&self, ray: &Ray<A>, limit: A::Length) -> bool {
        Shape::occludes(self, ray, &A::coarse(&ray.origin, &ray.direction), false, limit)
    }
    fn surface(&self, ray: &Ray<A>, meeting: &Meeting<A>) -> Surface<A> {
        let mut p = A::along(&ray.origin, meeting.distance, &ray.direction);
        Shape::surface(self, ray, meeting, &mut p)
    }
    fn flat(&self) -> bool {
        S::FLAT
    }
}

/// A polygon that keeps its edges.
struct Owned<A: Arithmetic>(Polygon<A>, Vec<PolygonEdge<A>>);

impl<A: Arithmetic> Shape<A> for Owned<A> {
    const FLAT: bool = true;
    fn nearest(&self, r: &Ray<A>, c: &A::Coarse, i: bool, l: A::Length) -> Option<Meeting<A>> {
        Shape::nearest(&self.0.view(&self.1), r, c, i, l)
    }
    fn surface(&self, r: &Ray<A>, m: &Meeting<A>, p: &mut [A::Length; 3]) -> Surface<A> {
        Shape::surface(&self.0.view(&self.1), r, m, p)
    }
    fn material(&self) -> MaterialId {
        self.0.view(&self.1).material()
    }
}

trait Make: Arithmetic {
    fn make(solid: &Solid) -> Option<Box<dyn Probe<Self>>>;
    fn extent(solid: &Solid, log2_step: i8) -> Option<Extent>;
    /// The least slope of a plane to a ray at which its shapes have no cracks, at distances of
    /// tens of their size.
    const GLANCE: f64;
}

use crate::octree::Extent;

macro_rules! make {
    ($a:ty, $glance:literal) => {
        impl Make for $a {
            const GLANCE: f64 = $glance;

            fn make(solid: &Solid) -> Option<Box<dyn Probe<$a>>> {
                Some(match solid {
                    Solid::Sphere(c, r) => Box::new(Sphere::<$a>::try_new(*c, *r, 0).ok()?),
                    Solid::Disc(c, n, r) => Box::new(Disc::<$a>::try_new(*c, *n, *r, 0).ok()?),
                    Solid::Cuboid(a, b) => Box::new(Cuboid::<$a>::try_new(*a, *b, 0).ok()?),
                    Solid::Triangle(c) => Box::new(Triangle::<$a>::try_new(*c, 0).ok()?),
                    Solid::Polygon(c) => {
                        let edge = |i| Polygon::<$a>::try_edge(c, i).ok();
                        let edges = (0..c.len()).map(edge).collect::<Option<_>>()?;
                        Box::new(Owned(Polygon::<$a>::try_new(c, 0, 0).ok()?, edges))
                    }
                    Solid::Cylinder(b, a, r) => {
                        Box::new(Cylinder::<$a>::try_new(*b, *a, *r, 0).ok()?)
                    }
                    Solid::Cone(b, r, a, s) => {
                        Box::new(Cone::<$a>::try_new(*b, *r, *a, *s, 0).ok()?)
                    }
                })
            }

            fn extent(solid: &Solid, step: i8) -> Option<Extent> {
                Some(match solid {
                    Solid::Sphere(c, r) => Sphere::<$a>::try_new(*c, *r, 0).ok()?.extent(step),
                    Solid::Disc(c, n, r) => Disc::<$a>::try_new(*c, *n, *r, 0).ok()?.extent(step),
                    Solid::Cuboid(a, b) => Cuboid::<$a>::try_new(*a, *b, 0).ok()?.extent(step),
                    Solid::Triangle(c) => Triangle::<$a>::try_new(*c, 0).ok()?.extent(step),
                    Solid::Polygon(c) => Polygon::<$a>::try_new(c, 0, 0).ok()?.extent(step),
                    Solid::Cylinder(b, a, r) => {
                        Cylinder::<$a>::try_new(*b, *a, *r, 0).ok()?.extent(step)
                    }
                    Solid::Cone(b, r, a, s) => {
                        Cone::<$a>::try_new(*b, *r, *a, *s, 0).ok()?.extent(step)
                    }
                })
            }
        }
    };
}
make!(Fixed, 0.02);
make!(f32, 0.001);
make!(f64, 0.001);

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

proptest! {
    // The same rays each time: what is clear in forty thousand of them isn't in all of them.
    #![proptest_config(ProptestConfig {
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::with_cases(40000)
    })]

    #[test]
    fn three_arithmetics_and_the_textbook(s in solid(), (o, p) in sight()) {
        let d = unit(minus(aimed(&s, p), o));
        agree::<f64>(&s, o, d, 1e-7, 1e-6, 1e-5)?;
        for extent in [10.0, 100.0] {
            let (s, o) = (scaled(&s, extent / 2.0), times(o, extent / 2.0));
            // of the extent: 2⁻¹³ in fixed point, 2⁻¹⁸ in single precision
            agree::<Fixed>(&s, o, d, extent * 2e-3, extent * 2e-4 + 2e-4, 2e-3)?;
            agree::<f32>(&s, o, d, extent * 1e-4, extent * 5e-6, 1e-4)?;
        }
    }

    #[test]
    fn what_goes_in_finds_the_far_side_only(s in solid(), (o, p) in sight()) {
        fn far<A: Test + Make>(s: &Solid, o: V, d: V, clear: f64) -> Result<(), TestCaseError> {
            let first = ray::<A>(o, d);
            let (o, d) = (first.origin.map(A::of_length), unit(first.direction.map(A::of_unit)));
            let hits = reference(s, o, d);
            with::<A, _>(s, |shape| {
                if shape.flat() || hits.len() != 2 || hits[1].0 - hits[0].0 < clear {
                    return Ok(());
                }
                if clearly(s, o, d, clear / 8.0).is_none() {
                    return Ok(());
                }
                let m = shape.nearest(&first, false, A::FAR);
                let Some(m) = m else { return Ok(()) };
                let p = A::along(&first.origin, m.distance, &first.direction);
                let surface = shape.surface(&first, &m);
                let n = crate::math::neg(&surface.geometric);
                let inwards = Ray { origin: A::leave(&p, &n, m.distance), ..first };
                let rest = shape.nearest(&inwards, true, A::FAR);
                let rest = rest.map(|m| A::of_length(m.distance)).unwrap_or(-1.0);
                let expected = hits[1].0 - hits[0].0;
                // The far root may lie at an edge or at a glance.
                let q = add(o, times(d, hits[0].0 + expected / 2.0));
                if clearly(s, q, d, clear / 8.0).is_some() {
                    prop_assert!((rest - expected).abs() < clear, "{} for {}", rest, expected);
                }
                Ok(())
            }).unwrap_or(Ok(()))
        }
        let d = unit(minus(aimed(&s, p), o));
        far::<f64>(&s, o, d, 1e-5)?;
        far::<Fixed>(&scaled(&s, 5.0), times(o, 5.0), d, 0.05)?;
        far::<f32>(&scaled(&s, 50.0), times(o, 50.0), d, 0.05)?;
    }

    #[test]
    fn hits_lie_within_the_extent(s in solid(), (o, p) in sight()) {
        fn within<A: Test + Make>(s: &Solid, o: V, d: V, step: i8) -> Result<(), TestCaseError> {
            let ray = ray::<A>(o, d);
            let (o, d) = (ray.origin.map(A::of_length), unit(ray.direction.map(A::of_unit)));
            let Some(extent) = A::extent(s, step) else { return Ok(()) };
            for (t, _) in reference(s, o, d) {
                let p = add(o, times(d, t)).map(|x| x / 2f64.powi(step.into()));
                match extent {
                    Extent::Box { min, max } => for i in 0..3 {
                        prop_assert!(p[i] > f64::from(min[i]) - 4.0, "{:?} {:?}", p, extent);
                        prop_assert!(p[i] < f64::from(max[i]) + 4.0, "{:?} {:?}", p, extent);
                    },
                    Extent::Sphere { center, radius } => {
                        let f = minus(p, center.map(f64::from));
                        prop_assert!((dot(f, f).sqrt() - f64::from(radius)).abs() < 4.0 + f64::from(radius) / 32768.0);
                    }
                    Extent::Round { ends, radii, .. } => {
                        let [base, apex] = ends.map(|e| e.map(f64::from));
                        let [r, q] = radii.map(f64::from);
                        let way = minus(apex, base);
                        let s = dot(minus(p, base), way) / dot(way, way);
                        let off = minus(p, add(base, times(way, s)));
                        let size = dot(way, way).sqrt() + r.max(q);
                        let slack = 4.0 + size / 8192.0;
                        prop_assert!((-slack..=slack + size).contains(&(s * dot(way, way).sqrt())));
                        let wall = dot(off, off).sqrt() - (r + (q - r) * s);
                        prop_assert!(wall.abs() < slack * (1.0 + size / dot(way, way).sqrt()), "{}", wall);
                    }
                    Extent::Triangle { .. } => {}
                }
            }
            Ok(())
        }
        let d = unit(minus(aimed(&s, p), o));
        within::<Fixed>(&scaled(&s, 5.0), times(o, 5.0), d, -16)?;
        within::<f32>(&scaled(&s, 50.0), times(o, 50.0), d, -16)?;
        within::<f64>(&scaled(&s, 50.0), times(o, 50.0), d, -16)?;
    }

    #[test]
    fn edges_between_triangles_are_tight(
        c in prop::array::uniform4(point()), along in 0.001..0.999f64, o in prop::array::uniform3(-3.0..3.0f64),
        glance in 0.0..1.0f64, bend in 0.0..0.4f64,
    ) {
        fn tight<A: Test + Make>(c: [V; 4], p: V, o: V, slope: f64) -> Result<(), TestCaseError> {
            if slope < A::GLANCE {
                return Ok(());
            }

            let ray = ray::<A>(o, unit(minus(p, o)));
            let hit = |s: Solid| with::<A, _>(&s, |s| s.nearest(&ray, false, A::FAR).is_some());
            let pair = (hit(Solid::Triangle([c[0], c[1], c[2]])), hit(Solid::Triangle([c[1], c[0], c[3]])));
            if let (Some(a), Some(b)) = pair {
                prop_assert!(a || b, "{}", A::NAME);
            }
            Ok(())
        }
        let p = add(times(c[0], along), times(c[1], 1.0 - along));
        // A quarter of the pairs are nearly in one plane.
        let fourth = add(times(p, 2.0), times(c[2], -1.0));
        let c = if bend < 0.1 {
            [c[0], c[1], c[2], add(fourth, times(minus(c[3], fourth), bend * bend))]
        } else {
            c
        };
        let (left, right) = (minus(c[2], c[0]), minus(c[3], c[0]));
        let e = minus(c[1], c[0]);
        prop_assume!(dot(e, e) > 0.01);
        let (m, n) = (cross(e, left), cross(right, e));
        prop_assume!(dot(m, m) > 1e-3 && dot(n, n) > 1e-3);
        let o = glancing(o, p, m, glance);
        let way = minus(p, o);
        let slope = dot(unit(way), unit(m)).abs().min(dot(unit(way), unit(n)).abs());
        // Seen along the two faces' outline, an edge has nothing beyond it to hit.
        if dot(way, m) * dot(way, n) < 0.0 {
            return Ok(());
        }
        for size in [1.0, 7.0, 100.0] {
            let c = c.map(|x| times(x, size));
            let (p, o) = (times(p, size), times(o, size));
            tight::<Fixed>(c, p, o, slope)?;
            tight::<f32>(c, p, o, slope)?;
            tight::<f64>(c, p, o, slope)?;
        }
    }

    #[test]
    fn fans_and_polygons_are_tight(
        s in solid(), spoke in 0usize..12, along in 0.0..0.999f64, o in prop::array::uniform3(-3.0..3.0f64),
        glance in 0.0..1.0f64,
    ) {
        fn tight<A: Test + Make>(parts: &[Solid], p: V, o: V, slope: f64) -> Result<(), TestCaseError> {
            if slope < A::GLANCE {
                return Ok(());
            }

            let ray = ray::<A>(o, unit(minus(p, o)));
            let hit = |s: &Solid| with::<A, _>(s, |s| s.nearest(&ray, false, A::FAR).is_some());
            let hits: Vec<_> = parts.iter().map(hit).collect();
            if hits.iter().all(Option::is_some) {
                prop_assert!(hits.contains(&Some(true)), "{} {:?} {:?}", A::NAME, parts, ray);
            }
            Ok(())
        }
        let Solid::Polygon(c) = &s else { return Ok(()) };
        let n = cross(minus(c[1], c[0]), minus(c[2], c[0]));
        let mid = center(c);
        let spoke = spoke % c.len();
        let p = add(times(mid, 1.0 - along), times(c[spoke], along));
        let o = glancing(o, p, n, glance);
        let way = minus(p, o);
        let slope = dot(unit(way), unit(n)).abs();
        for size in [1.0, 7.0, 100.0] {
            let at = |i: usize| times(c[i % c.len()], size);
            let (m, p, o) = (times(mid, size), times(p, size), times(o, size));
            let fan: Vec<_> =
                (0..c.len()).map(|i| Solid::Triangle([m, at(i), at(i + 1)])).collect();
            tight::<Fixed>(&fan, p, o, slope)?;
            tight::<f32>(&fan, p, o, slope)?;
            tight::<f64>(&fan, p, o, slope)?;
            // cut in two along a diagonal
            if c.len() >= 4 {
                let half = c.len() / 2;
                let first = (0..=half).map(at).collect();
                let second = (half..=c.len()).map(at).collect();
                let halves = [Solid::Polygon(first), Solid::Polygon(second)];
                let q = add(times(at(0), 1.0 - along), times(at(half), along));
                let slope = dot(unit(minus(q, o)), unit(n)).abs();
                tight::<Fixed>(&halves, q, o, slope)?;
                tight::<f32>(&halves, q, o, slope)?;
                tight::<f64>(&halves, q, o, slope)?;
            }
        }
    }

    #[test]
    fn edges_of_sixteen_bits(
        from in prop::array::uniform2(-50.0..50.0f64), to in prop::array::uniform2(-50.0..50.0f64),
        p in prop::array::uniform2(-50.0..50.0f64), t in 0.0..100.0f64, slope in 0.01..1.7f64,
    ) {
        use crate::math::fixed_constructors as make;
        let inward = [from[1] - to[1], to[0] - from[0]];
        let length = (inward[0] * inward[0] + inward[1] * inward[1]).sqrt();
        prop_assume!(length > 0.1);
        let outline = make::outline([50.0, 50.0], 50.0);
        let edge: FixedEdge = make::edge(inward, from, &outline);
        let spot = Fixed::spot(&outline, Fixed::length(p[0]), Fixed::length(p[1]),
            Fixed::length(t), Fixed::unit(slope));
        let depth = (inward[0] * (p[0] - from[0]) + inward[1] * (p[1] - from[1])) / length;
        // a step is 2⁻⁸ here; the slack is four of them and as much again at a glance
        let bound = 0.02 * (1.0 + 2.0 / slope * (1.0 + t / 256.0));
        let Some(spot) = spot else { return Ok(()) };
        if depth > 0.0 { prop_assert!(!Fixed::beyond(&edge, &spot)); }
        if depth < -bound { prop_assert!(Fixed::beyond(&edge, &spot)); }
    }

    #[test]
    fn no_ray_panics(
        s in solid(), size in 0.01..400.0f64, o in prop::array::uniform3(-(1i32 << 28)..1 << 28),
        d in prop::array::uniform3(-(1i32 << 17)..=1 << 17), limit in 0..=1 << 26, inwards: bool,
        detail: i32,
    ) {
        with::<Fixed, _>(&scaled(&s, size), |shape| {
            let ray = Ray::<Fixed> {
                origin: o.map(::fixed::types::I16F16::from_bits),
                direction: d.map(::fixed::FixedI32::from_bits),
                leaving: Leaving::NOTHING,
            };
            let limit = ::fixed::types::I16F16::from_bits(limit);
            if let Some(m) = shape.nearest(&ray, inwards, limit) {
                shape.surface(&ray, &m);
            }
            shape.occludes(&ray, limit);
            let detail = ::fixed::types::I16F16::from_bits(detail >> 4);
            shape.surface(&ray, &Meeting { distance: limit, detail });
        });
        with::<f32, _>(&scaled(&s, size), |shape| {
            let values = [0.0, f32::NAN, f32::INFINITY, 1e30, -1e-40, 1.0];
            let pick = |x: i32| values[(x & 0xff) as usize % values.len()];
            let ray = Ray::<f32> { origin: o.map(pick), direction: d.map(pick), leaving: Leaving::NOTHING };
            if let Some(m) = shape.nearest(&ray, inwards, 1e9) {
                shape.surface(&ray, &m);
            }
        });
    }

    #[test]
    fn smooth_normals(
        c in prop::array::uniform3(point()), n in prop::array::uniform3(point()),
        w in prop::array::uniform2(0.0..1.0f64), o in prop::array::uniform3(-3.0..3.0f64),
    ) {
        let front = cross(minus(c[1], c[0]), minus(c[2], c[0]));
        if dot(front, front) < 0.01 {
            return Ok(());
        }
        // normals on the front, of a mesh that is not too coarse
        let n = n.map(|n| unit(add(times(unit(front), 1.0), times(n, 0.5))));
        let w = if w[0] + w[1] > 1.0 { w.map(|x| 1.0 - x) } else { w };
        let p = add(c[0], add(times(minus(c[1], c[0]), w[0]), times(minus(c[2], c[0]), w[1])));
        let d = unit(minus(p, o));
        if dot(d, unit(front)).abs() < 0.05 {
            return Ok(());
        }
        let blend = [0, 1, 2].map(|i| (1.0 - w[0] - w[1]) * n[0][i] + w[0] * n[1][i] + w[1] * n[2][i]);
        let behind = dot(d, front) > 0.0;
        let blend = times(unit(blend), if behind { -1.0 } else { 1.0 });
        let faces = -dot(d, blend);
        macro_rules! check {
            ($a:ty, $bound:literal) => {
                if let Ok(shape) = SmoothTriangle::<$a>::try_new(c, n, 0) {
                    let ray = ray::<$a>(o, d);
                    let m = Probe::nearest(&shape, &ray, false, <$a>::FAR).expect("aimed at it");
                    let s = Probe::surface(&shape, &ray, &m);
                    prop_assert_eq!(s.behind, behind);
                    let (got, flat) = (s.normal.map(<$a>::of_unit), s.geometric.map(<$a>::of_unit));
                    let cosine = <$a>::of_unit(s.cosine);
                    prop_assert!(cosine >= 0.0 && (cosine + dot(got, d)).abs() < $bound);
                    let expected = if faces > $bound { blend } else { flat };
                    if faces.abs() > $bound {
                        for i in 0..3 {
                            prop_assert!((got[i] - expected[i]).abs() < $bound, "{:?} {:?}", got, expected);
                        }
                    }
                }
            };
        }
        check!(Fixed, 1e-2);
        check!(f32, 1e-4);
        check!(f64, 1e-9);
    }
}

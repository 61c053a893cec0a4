//! What all shapes must do, in every arithmetic.

use super::*;
use crate::octree::Extent;

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

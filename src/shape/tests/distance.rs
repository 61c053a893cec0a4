//! How far the distance of a hit may be off, against the scene's scale: what `docs/precision.md` states.

use super::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, TestRunner};

/// Least cosine of incidence: towards a glance, an error of the ray's becomes larger without bound.
const COSINE: f64 = 0.25;
const SAMPLES: usize = 40_000;
/// Scenes' halves: shapes lie within them, rays start within three of them.
const SCALES: [f64; 4] = [1.0, 8.0, 64.0, 256.0];
/// The worst found is no less than this part of a bound.
const NEAR: f64 = 0.5;

/// A kind of shape; bounds in fixed point at each scale, in steps of 2⁻¹⁶; and in `f32`, in parts of 2⁻²⁴ of
/// the scale.
struct Row(&'static str, [f64; 4], f64);

const ROWS: [Row; 7] = [
    Row("sphere", [6.5, 34.0, 240.0, 930.0], 16.0),
    Row("disc", [9.0, 62.0, 500.0, 1800.0], 22.0),
    Row("box", [3.3, 18.0, 150.0, 490.0], 8.1),
    Row("triangle", [7.8, 19.0, 130.0, 340.0], 19.0),
    Row("polygon", [9.5, 18.0, 120.0, 380.0], 23.0),
    Row("cylinder", [17.0, 84.0, 680.0, 2700.0], 20.0),
    Row("cone", [9.0, 49.0, 390.0, 1600.0], 21.0),
];

fn kind(solid: &Solid) -> usize {
    match solid {
        Solid::Sphere(..) => 0,
        Solid::Disc(..) => 1,
        Solid::Cuboid(..) => 2,
        Solid::Triangle(_) => 3,
        Solid::Polygon(_) => 4,
        Solid::Cylinder(..) => 5,
        Solid::Cone(..) => 6,
    }
}

/// By how much the hit of a ray, as the arithmetic has it, lies before or behind where the textbook's does, of
/// the shape as it was described.
fn off<A: Test + Make>(solid: &Solid, o: V, d: V, clear: f64) -> Option<f64> {
    let ray = ray::<A>(o, d);
    let (o, d) = (ray.origin.map(A::of_length), unit(ray.direction.map(A::of_unit)));
    // Beside an edge, rays of either kind go on to what lies behind.
    let (exact, normal) = clearly(solid, o, d, clear)?.0?;
    if dot(normal, d).abs() < COSINE {
        return None;
    }
    let hit = with::<A, _>(solid, |shape| shape.nearest(&ray, false, A::FAR))??;
    if hit.distance >= A::FAR {
        return None;
    }
    Some((A::of_length(hit.distance) - exact).abs())
}

#[test]
fn distances_are_as_near_as_stated() {
    let config = Config { rng_seed: RngSeed::Fixed(1), ..Config::default() };
    let mut runner = TestRunner::new(config);
    let strategy = (solid(), sight());
    let mut worst = [([0.0f64; 4], 0.0f64); ROWS.len()];
    for _ in 0..SAMPLES {
        let (solid, (o, p)) = strategy.new_tree(&mut runner).unwrap().current();
        let d = unit(minus(aimed(&solid, p), o));
        let (fixed, single) = &mut worst[kind(&solid)];
        for (scale, worst) in SCALES.iter().zip(fixed) {
            if let Some(off) =
                off::<Fixed>(&scaled(&solid, *scale), times(o, *scale), d, 1e-3 * scale)
            {
                *worst = worst.max(off * 65536.0);
            }
        }
        if let Some(off) = off::<f32>(&solid, o, d, 1e-5) {
            *single = single.max(off * 2f64.powi(24));
        }
    }
    let mut flaws = vec![];
    for (Row(name, fixed, single), (worst_fixed, worst_single)) in ROWS.iter().zip(&worst) {
        let bounds = fixed.iter().chain([single]);
        let found = worst_fixed.iter().chain([worst_single]);
        if bounds.zip(found).any(|(bound, worst)| !(NEAR * bound..=*bound).contains(worst)) {
            flaws.push(format!("{name}: {worst_fixed:.1?}, {worst_single:.1}"));
        }
    }
    assert!(flaws.is_empty(), "\n{}", flaws.join("\n"));

    let steps = SCALES.map(|scale| format!("fixed, scale {scale}")).join(" | ");
    let mut table = format!("| shape | {steps} | `f32` |\n|---|--:|--:|--:|--:|--:|\n");
    for Row(name, fixed, single) in &ROWS {
        let fixed = fixed.map(|steps| format!("{steps}")).join(" | ");
        table += &format!("| {name} | {fixed} | {single} |\n");
    }
    crate::page::states(&table);
}

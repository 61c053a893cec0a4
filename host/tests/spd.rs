//! The Standard Procedural Databases: published ray counts, and the small scenes in all three
//! arithmetics.

mod common;

use whitted::frame::Sampling;
use whitted::math::Fixed;
use whitted::tally::Counts;
use whitted_host::bake::{Baked, Construct};
use whitted_host::document::{Document, Size};
use whitted_host::read::read;
use whitted_host::render::{Settings, render};

/// Eye hits, reflection, refraction and shadow rays, as published for 513 × 513 eye rays.
const PUBLISHED: [(&str, [u64; 4]); 5] = [
    ("balls", [263_169, 175_095, 0, 954_368]),
    ("rings", [263_169, 315_236, 0, 1_085_002]),
    ("teapot_s12", [161_120, 225_248, 0, 407_656]),
    ("tetra", [49_788, 0, 0, 46_112]),
    ("mount", [173_125, 354_769, 354_769, 412_922]),
];

/// What the readers make of each small file.
const SMALL: [(&str, usize, usize); 8] = [
    ("balls_s1", 11, 3),
    ("balls_s2", 92, 3),
    ("balls_s3", 821, 3),
    ("gears_s1", 429, 5),
    ("jacks_s2", 81, 1),
    ("mount_s4", 516, 1),
    ("rings_s2", 301, 3),
    ("teapot_s2", 244, 2),
];

fn counts<A: Construct>(document: &Document, side: u32) -> Counts {
    let baked = Baked::<A>::new(document).unwrap_or_else(|flaw| panic!("{}", flaw.problem));
    let settings = Settings {
        indirect: None,
        size: Size { width: side, height: side },
        depth: 5,
        sampling: Sampling::Corners,
        show: None,
        threads: std::thread::available_parallelism().unwrap_or(std::num::NonZeroUsize::MIN),
    };
    render(&baked, &settings, |_| {}).unwrap_or_else(|flaw| panic!("{}", flaw.problem)).counts
}

fn by_kind(counts: &Counts) -> [u64; 4] {
    [counts.primary_hits, counts.reflection, counts.transmission, counts.shadow]
}

/// How far `a` is from `b`, in per cent of `b`.
fn off(a: u64, b: u64) -> f64 {
    if b == 0 { a as f64 } else { (a as f64 / b as f64 - 1.0).abs() * 100.0 }
}

#[test]
fn published_counts() {
    let Some(place) = common::spd() else { return };
    for (name, published) in PUBLISHED {
        let document = read(&place.join(name).with_extension("nff")).unwrap();
        let ours = by_kind(&counts::<f64>(&document, 512));
        for (a, b) in ours.into_iter().zip(published) {
            assert!(off(a, b) <= 0.25, "{name}: {ours:?} against {published:?}");
        }
        if matches!(name, "balls" | "rings") {
            assert_eq!(ours[0], published[0], "{name}");
        }
        let [single, fixed] = [counts::<f32>(&document, 512), counts::<Fixed>(&document, 512)];
        for (arithmetic, others) in [("f32", by_kind(&single)), ("fixed", by_kind(&fixed))] {
            for (a, b) in others.into_iter().zip(ours) {
                assert!(off(a, b) <= 0.2, "{name}, {arithmetic}: {others:?} against {ours:?}");
            }
        }
    }
}

/// Rings says one of seven materials before each of its 840 objects and its floor.
#[test]
fn materials_said_again_are_one() {
    let Some(place) = common::spd() else { return };
    let document = read(&place.join("rings.nff")).unwrap();
    assert_eq!(document.materials.len(), 7);
    let text = std::fs::read_to_string(place.join("rings.nff")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let said = |line: &&&str| line.starts_with("f ");
    assert_eq!(lines.iter().filter(said).count(), 841);
    for shape in document.shapes.iter().step_by(100) {
        let last = lines[..shape.line].iter().rfind(said);
        assert_eq!(last, lines.get(document.materials[shape.material].line - 1));
    }
}

#[test]
fn small_scenes_in_every_arithmetic() {
    let Some(place) = common::spd() else { return };
    for (name, shapes, lights) in SMALL {
        let document = read(&place.join(name).with_extension("nff")).unwrap();
        assert_eq!((document.shapes.len(), document.lights.len()), (shapes, lights), "{name}");
        let reference = by_kind(&counts::<f64>(&document, 64));
        for ours in
            [by_kind(&counts::<f32>(&document, 64)), by_kind(&counts::<Fixed>(&document, 64))]
        {
            for (a, b) in ours.into_iter().zip(reference) {
                // At this size single rays at silhouettes weigh a lot.
                assert!(off(a, b) <= 1.5, "{name}: {ours:?} against {reference:?}");
            }
        }
    }
}

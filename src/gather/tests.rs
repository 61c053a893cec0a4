use super::fill::Place;
use super::*;
use crate::frame::{Renderer, Settings};
use crate::math::{Arithmetic, Fixed};
use crate::scene::{Background, Camera, Light, LightSpec, Material, MaterialSpec, Parts, Scene};
use crate::shape::{Leaving, Polygon, Sphere};
use crate::tally::Counts;
use crate::trace::Work;
extern crate std;
use std::vec;

/// A sphere of albedo ½ around a light beside its centre, and a camera in it.
macro_rules! in_a_sphere {
    ($a:ty, $scene:ident, $camera:ident) => {
        let spheres = [Sphere::<$a>::new([0.0; 3], 1.0, 0)];
        let materials =
            [Material::<$a>::new(MaterialSpec { diffuse: [0.5; 3], ..MaterialSpec::BLACK })];
        let lights = [Light::<$a>::point([0.3, 0.0, 0.0], [1.0; 3])];
        let $scene = Scene::<$a>::new(Parts {
            spheres: &spheres,
            materials: &materials,
            lights: &lights,
            ..Parts::EMPTY
        })
        .expect("a scene");
        let $camera = Camera::<$a>::look_at([0.0, 0.0, -0.9], [0.0; 3], [0.0, 1.0, 0.0], 120.0);
    };
}

/// Inside a sphere of albedo ½ every point gets as much from the others: half of what a light of
/// intensity π gives on average, 1 in our units, and with all further bounces twice as much.
macro_rules! integrating_sphere {
    ($name:ident, $a:ty) => {
        #[test]
        fn $name() {
            in_a_sphere!($a, scene, camera);
            for (bounces, wanted) in [(1, 0.25), (10, 0.5)] {
                let spec = GatheringSpec {
                    error: 0.25,
                    nearest: 0.05,
                    farthest: 2.0,
                    bounces,
                    ..GatheringSpec::DEFAULT
                };
                let mut work = Work::<$a, 4>::new();
                let mut counts = Counts::default();
                let mut pool = vec![Record::<$a>::NONE; 600];
                let mut drafts = vec![Draft::<$a>::NONE; 600];
                let cache =
                    Gatherer::new(&scene, Gathering::<$a>::new(spec), &mut work, &mut counts)
                        .expect("settings")
                        .fill(&camera, (160, 120), &mut pool, &mut drafts)
                        .expect("memory");
                let (mut mean, mut worst) = (0.0, 0.0f64);
                for record in cache.records() {
                    let e: f64 = record.irradiance()[0].into();
                    mean += e * 0.5;
                    worst = worst.max((e * 0.5 / wanted - 1.0).abs());
                }
                let count = cache.records().len();
                mean /= count as f64;
                let name = <$a>::NAME;
                std::println!(
                    "{name}: {count} records, {bounces}: mean {mean:.4}, worst {worst:.4}"
                );
                assert!((mean / wanted - 1.0).abs() < 0.005, "{mean}");
                assert!(worst < 0.04, "{worst}");
            }
        }
    };
}

/// The same sphere with virtual lights, as a camera in it sees its walls.
macro_rules! virtual_sphere {
    ($name:ident, $a:ty) => {
        #[test]
        fn $name() {
            in_a_sphere!($a, scene, camera);
            for (bounces, tile, wanted) in [(1, 1, 0.25), (1, 4, 0.25), (4, 1, 0.25 * 1.875)] {
                let settings = VirtualLightsSettings::<$a>::new(VirtualLightsSpec {
                    bounces,
                    tile,
                    nearest: 0.05,
                    ..VirtualLightsSpec::DEFAULT
                });
                let mut pool = vec![VirtualLight::<$a>::NONE; 1024];
                let mut work = Work::<$a, 4>::new();
                let laid = VirtualLights::lay(&scene, &settings, &mut pool, &mut work, &mut ());
                let lit = scene.with_indirect(Indirect::VirtualLights(laid)).expect("uses");
                let mut sum = 0.0;
                for (scene, sign) in [(&lit, 1.0), (&scene, -1.0)] {
                    let settings = Settings { depth: 1, ..Settings::new(40, 32) };
                    let mut renderer =
                        Renderer::new(scene, &camera, settings, &mut work, &mut []).expect("fits");
                    for (_, _, radiance) in renderer.scan(0..40, 0..32) {
                        sum += sign * Into::<f64>::into(radiance[0]);
                    }
                }
                let mean = sum / (40.0 * 32.0);
                std::println!("{} {bounces} {tile}: {mean} for {wanted}", <$a>::NAME);
                assert!((mean / wanted - 1.0).abs() < 0.01, "{mean}");
            }
        }
    };
}

virtual_sphere!(virtual_lights_in_fixed, Fixed);
virtual_sphere!(virtual_lights_in_f32, f32);
virtual_sphere!(virtual_lights_in_f64, f64);

integrating_sphere!(integrating_sphere_in_fixed, Fixed);
integrating_sphere!(integrating_sphere_in_f32, f32);
integrating_sphere!(integrating_sphere_in_f64, f64);

/// Whatever order records lie in, a point hears the same to the bit from all of them, one by one, as
/// from those alone that may reach it; also where none does. Filled ones lie so that few are asked.
macro_rules! found_by_halving {
    ($name:ident, $a:ty) => {
        #[test]
        fn $name() {
            in_a_sphere!($a, scene, camera);
            for bounces in [1, 2] {
                let spec = GatheringSpec {
                    error: 0.2,
                    nearest: 0.05,
                    farthest: 2.0,
                    bounces,
                    ..GatheringSpec::DEFAULT
                };
                let mut work = Work::<$a, 4>::new();
                let mut pool = vec![Record::<$a>::NONE; 300];
                let mut drafts = vec![Draft::<$a>::NONE; 300];
                let gathering = Gathering::<$a>::new(spec);
                let cache = Gatherer::new(&scene, gathering, &mut work, &mut ())
                    .expect("settings")
                    .fill(&camera, (80, 60), &mut pool, &mut drafts)
                    .expect("memory");
                let records = cache.records();
                assert_eq!(cache.arranged(), records.len());
                // made of them again, as from flash, it is as it was
                let again = IrradianceCache::<$a>::new(records, spec.error);
                assert_eq!(again.arranged(), records.len());
                let reversed: std::vec::Vec<_> = records.iter().rev().copied().collect();
                assert_eq!(IrradianceCache::<$a>::new(&reversed, spec.error).arranged(), 0);
                let one_by_one =
                    IrradianceCache::of(records, 0, gathering.sharpness, cache.is_full());
                let part = |bits: u32| f64::from(bits & 0x3ff) / 512.0 - 1.0;
                for i in 0..4000u32 {
                    let bits = crate::math::hash(i);
                    let v = [part(bits), part(bits >> 10), part(bits >> 20)];
                    let square = v.iter().map(|x| x * x).sum::<f64>();
                    if square < 1e-3 {
                        continue;
                    }
                    // on the wall, and anywhere
                    let size = if i % 2 == 0 { square.sqrt() } else { 0.7 };
                    let p = v.map(|x| <$a>::length_q16((x / size * 65536.0) as i32));
                    let normal = v.map(|x| <$a>::fraction((-x / square.sqrt() * 65536.0) as i32));
                    let said = cache.irradiance(p, normal);
                    assert_eq!(said, one_by_one.irradiance(p, normal), "{v:?}");
                    assert_eq!(said, again.irradiance(p, normal), "{v:?}");
                }
            }
        }
    };
}

found_by_halving!(found_by_halving_in_fixed, Fixed);
found_by_halving!(found_by_halving_in_f32, f32);
found_by_halving!(found_by_halving_in_f64, f64);

/// A floor before a lit wall, under a sky: how the gradients of a record say the irradiance changes,
/// and how it does.
#[test]
fn gradients_are_the_change() {
    type A = f64;
    let corners = [[2.0, 0.0, -2.0], [2.0, 0.0, 2.0], [2.0, 2.0, 2.0], [2.0, 2.0, -2.0]];
    let polygons = [Polygon::<A>::new(&corners, 0, 0)];
    let edges: [_; 4] = core::array::from_fn(|i| Polygon::<A>::try_edge(&corners, i).expect("4"));
    let diffuse = MaterialSpec { diffuse: [0.8; 3], ..MaterialSpec::BLACK };
    let materials = [Material::<A>::new(diffuse), Material::<A>::new(MaterialSpec::BLACK)];
    let direction = [1.0, 0.0, 0.0];
    let lights = [Light::<A>::new(LightSpec::Directional { direction, intensity: [1.0; 3] })];
    let scene = Scene::<A>::new(Parts {
        polygons: &polygons,
        edges: &edges,
        materials: &materials,
        lights: &lights,
        background: Background::<A>::uniform([0.2; 3]),
        ..Parts::EMPTY
    })
    .expect("a scene");
    let gathering = Gathering::<A>::new(GatheringSpec {
        rings: 16,
        sectors: 64,
        farthest: 10.0,
        ..GatheringSpec::DEFAULT
    });
    let mut work = Work::<A, 4>::new();
    let mut none = ();
    let mut gatherer = Gatherer::new(&scene, gathering, &mut work, &mut none).expect("settings");
    let mut at = |position: [f64; 3], normal: [f64; 3]| {
        let leaving = Leaving::NOTHING;
        let place = Place { position, normal, origin: position, leaving };
        // the mean of some seeds: the difference of two is small
        let records: std::vec::Vec<_> =
            (0..64).map(|seed| gatherer.gather(&scene, &place, seed).spec()).collect();
        let mean = |f: &dyn Fn(&RecordSpec) -> f64| {
            records.iter().map(f).sum::<f64>() / records.len() as f64
        };
        let e = mean(&|r| r.irradiance[0]);
        let t = [0, 1, 2].map(|i| mean(&|r| r.translation[i] / r.reach) * e);
        let r = [0, 1, 2].map(|i| mean(&|r| r.rotation[i]) * e);
        (e, t, r)
    };
    let (e, t, r) = at([0.0; 3], [0.0, 1.0, 0.0]);
    let h = 0.1;
    let change =
        |a: (f64, [f64; 3], [f64; 3]), b: (f64, [f64; 3], [f64; 3])| (a.0 - b.0) / (2.0 * h);
    let up = [0.0, 1.0, 0.0];
    let along_x = change(at([h, 0.0, 0.0], up), at([-h, 0.0, 0.0], up));
    let along_z = change(at([0.0, 0.0, h], up), at([0.0, 0.0, -h], up));
    assert!(e > 0.05 && along_x > 0.03, "{e} {along_x}");
    assert!((t[0] - along_x).abs() < 0.1 * along_x, "{t:?}: {along_x}");
    assert!((t[2] - along_z).abs() < 0.1 * along_x && t[1].abs() < 1e-3, "{t:?}: {along_z}");
    // the normal bent towards the wall: N × N' is −z
    let mut bent = |s: f64| at([0.0; 3], [(s * h).sin(), (s * h).cos(), 0.0]);
    let turned = change(bent(1.0), bent(-1.0));
    assert!((-r[2] - turned).abs() < 0.1 * turned, "{r:?}: {turned}");
    assert!(r[0].abs() < 0.1 * turned && r[1].abs() < 0.1 * turned, "{r:?}: {turned}");
}

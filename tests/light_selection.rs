//! Asking fewer lights: which are left out, and that the mean of a random choice is right.

use crate::common::FromF64;
use crate::common::make::Make;
use whitted::math::Fixed;
use whitted::scene::{
    Area, AreaLight, AreaLightSpec, Falloff, Light, LightSpec, Material, MaterialSpec, Parts,
    Scene, Selection,
};
use whitted::shape::{Plane, Sphere};
use whitted::tally::Counts;
use whitted::trace::{Tracer, Work};

const UP: [f64; 3] = [0.0, 1.0, 0.0];

/// A floor that shines a little, under twelve lights of very different strength and an area; a ball
/// hides some.
macro_rules! scene {
    ($a:ident, $selection:expr, $then:expr) => {{
        let strengths = [0.2, 3.0, 0.05, 0.7, 9.0, 0.4, 1.5, 0.02, 5.0, 0.3, 2.0, 0.1];
        let mut lights = Vec::new();
        for (i, s) in strengths.iter().enumerate() {
            let turn = i as f64 * 0.7;
            let position = [2.0 * turn.cos(), 1.0 + 0.2 * i as f64, 2.0 * turn.sin()];
            let intensity = [*s, s * 0.8, s * (0.3 + 0.05 * i as f64)];
            let falloff = Falloff::InverseSquare;
            let spec = LightSpec::Point { position, intensity, falloff };
            lights.push(<$a as Make>::light(&spec).unwrap());
        }
        let areas = [
            AreaLight::<$a>::new(AreaLightSpec {
                area: Area::Disc { center: [0.5, 2.0, 0.0], normal: [0.0, -1.0, 0.0], radius: 0.4 },
                radiance: [2.0, 3.0, 4.0],
                error: 0.2,
                samples: [4, 16],
                body: None,
            }),
            // behind the floor's horizon, and turned away
            AreaLight::<$a>::new(AreaLightSpec {
                area: Area::Disc { center: [0.5, -2.0, 0.0], normal: UP, radius: 0.4 },
                radiance: [9.0; 3],
                error: 0.2,
                samples: [4, 16],
                body: None,
            }),
        ];
        let materials = [<$a as Make>::material(&MaterialSpec {
            diffuse: [0.7, 0.6, 0.5],
            specular: [0.3; 3],
            shininess: 20.0,
            ..MaterialSpec::BLACK
        })
        .unwrap()];
        let planes = [Plane::<$a>::new(UP, 0.0, 0)];
        let spheres = [Sphere::<$a>::new([1.0, 0.6, 0.4], 0.35, 0)];
        let scene = Scene::<$a>::checked(Parts {
            spheres: &spheres,
            planes: &planes,
            materials: &materials,
            lights: &lights,
            area_lights: &areas,
            light_jitter: Some(9),
            selection: $selection,
            ..Parts::EMPTY
        });
        $then(&scene)
    }};
}

/// The radiance of the floor at the origin for a key, and what it took.
fn look<A: FromF64>(scene: &Scene<'_, A>, key: u32) -> ([f64; 3], Counts) {
    let ray = crate::common::ray([-0.4, 0.9, -0.3], [0.4, -0.9, 0.3]);
    let mut work = Work::<A, 1>::new();
    let mut counts = Counts::default();
    let radiance = Tracer::new(scene, 1).with_key(key).radiance(ray, &mut work, &mut counts);
    (radiance.map(Into::into), counts)
}

/// The mean of many keys, and its standard error.
fn mean<A: FromF64>(scene: &Scene<'_, A>, keys: u32) -> ([f64; 3], [f64; 3]) {
    let (mut sum, mut squares) = ([0.0; 3], [0.0; 3]);
    for key in 0..keys {
        let (radiance, _) = look(scene, key.wrapping_mul(0x0100_0193));
        for i in 0..3 {
            sum[i] += radiance[i];
            squares[i] += radiance[i] * radiance[i];
        }
    }
    let n = f64::from(keys);
    let mean = sum.map(|s| s / n);
    let error = [0, 1, 2].map(|i| ((squares[i] / n - mean[i] * mean[i]) / n).sqrt());
    (mean, error)
}

macro_rules! the_mean_is_right {
    ($name:ident, $a:ident) => {
        #[test]
        fn $name() {
            type A = $a;
            let exact = scene!(A, Selection::All, |s: &Scene<'_, A>| mean(s, 4000).0);
            for count in [1, 3] {
                let keys = if count == 1 { 30_000 } else { 8000 };
                let (mean, error) =
                    scene!(A, Selection::Choose(count), |s: &Scene<'_, A>| mean(s, keys));
                for i in 0..3 {
                    let (off, part) = ((mean[i] - exact[i]).abs(), error[i] / exact[i]);
                    println!(
                        "{count} of 13: {mean:?} for {exact:?}, off {:.2} errors",
                        off / error[i]
                    );
                    assert!(part < 0.005, "a standard error of {:.2} %", part * 100.0);
                    assert!(off < 4.0 * error[i], "{mean:?} for {exact:?}, ±{error:?}");
                }
            }
        }
    };
}
the_mean_is_right!(the_mean_of_a_choice_is_right_in_fixed_point, Fixed);
the_mean_is_right!(the_mean_of_a_choice_is_right_in_f32, f32);
the_mean_is_right!(the_mean_of_a_choice_is_right_in_f64, f64);

#[test]
fn one_light_is_asked_and_the_same_key_gives_the_same() {
    scene!(f64, Selection::Choose(1), |scene: &Scene<'_, f64>| {
        let mut different = 0;
        for key in 0..100 {
            let (radiance, counts) = look(scene, key);
            assert_eq!(look(scene, key).0, radiance);
            // of an area all of its samples
            assert!(counts.shadow == 1 || counts.shadow >= 4, "{}", counts.shadow);
            different += i32::from(radiance != look(scene, key + 1).0);
        }
        // it is often the strongest
        assert!(different > 30);
    });
    scene!(f64, Selection::Choose(0), |scene: &Scene<'_, f64>| {
        assert_eq!(look(scene, 3).0, [0.0; 3]);
    });
}

/// A light of intensity I at height 1 gives I/r²·cos·k_d: those below the threshold are left out.
#[test]
fn a_threshold_leaves_out_what_would_add_less() {
    let light = |intensity: f64| Light::<f64>::point([0.0, 1.0, 0.0], [intensity, 0.0, 0.0]);
    let lights = [light(0.1), light(0.5), light(0.001)];
    let materials =
        [Material::<f64>::new(MaterialSpec { diffuse: [0.5; 3], ..MaterialSpec::BLACK })];
    let planes = [Plane::<f64>::new(UP, 0.0, 0)];
    let parts = Parts { planes: &planes, materials: &materials, lights: &lights, ..Parts::EMPTY };
    let at = |selection| {
        let scene = Scene::<f64>::checked(Parts { selection, ..parts });
        let ray = crate::common::ray([0.0, 0.5, 0.0], [0.0, -1.0, 0.0]);
        let (mut work, mut counts) = (Work::<f64, 1>::new(), Counts::default());
        let radiance = Tracer::new(&scene, 1).radiance(ray, &mut work, &mut counts);
        (radiance[0], counts.shadow)
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    for (threshold, sum, rays) in
        [(0.0, 0.3005, 3), (0.001, 0.3, 2), (0.06, 0.25, 1), (0.3, 0.0, 0)]
    {
        let (radiance, asked) = at(Selection::<f64>::above(threshold));
        assert!(near(radiance, sum) && asked == rays, "{threshold}: {radiance} {asked}");
    }
    assert!(near(at(Selection::All).0, 0.3005));
    assert!(Selection::<Fixed>::try_above(-1.0).is_err());
}

/// Nothing random where nothing is chosen: a scene with one light is that light.
#[test]
fn a_choice_among_one_is_no_choice() {
    fn check<A: FromF64>(all: [f64; 3], one: [f64; 3]) {
        for i in 0..3 {
            assert!(
                (all[i] - one[i]).abs() <= 2e-4 * (1.0 + all[i]),
                "{}: {all:?} {one:?}",
                A::NAME
            );
        }
    }
    macro_rules! in_arithmetic {
        ($a:ident) => {{
            let lights = [Light::<$a>::point([0.3, 1.0, 0.2], [3.0, 2.0, 0.1])];
            let white = MaterialSpec { diffuse: [0.5; 3], ..MaterialSpec::BLACK };
            let materials = [Material::<$a>::new(white)];
            let planes = [Plane::<$a>::new(UP, 0.0, 0)];
            let parts = Parts::<$a> {
                planes: &planes,
                materials: &materials,
                lights: &lights,
                ..Parts::EMPTY
            };
            let at = |selection| look(&Scene::<$a>::checked(Parts { selection, ..parts }), 5).0;
            check::<$a>(at(Selection::All), at(Selection::Choose(1)));
            check::<$a>(at(Selection::All), at(Selection::Choose(4)));
        }};
    }
    in_arithmetic!(Fixed);
    in_arithmetic!(f32);
    in_arithmetic!(f64);
}

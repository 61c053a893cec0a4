//! Facts about the tree of rays: which rays are sent, which shape counts, what is counted.

use crate::common::make::{Body, Make, Shapes};
use crate::common::{radiance, ray, weight};
use whitted::frame::{FrameError, Renderer, Sample, Sampling, Settings};
use whitted::math::Fixed;
use whitted::scene::{Background, Falloff, LightSpec, MaterialSpec, Parts, Rules, Scene};
use whitted::tally::Counts;
use whitted::trace::{Tracer, Work};

const BLACK: MaterialSpec = MaterialSpec::BLACK;
const DOWN: [f64; 3] = [0.0, -1.0, 0.0];
const UP: [f64; 3] = [0.0, 1.0, 0.0];

/// What a value may be off.
fn tolerance<A: Make>() -> f64 {
    match A::NAME {
        "fixed" => 4e-4,
        "f32" => 1e-5,
        _ => 1e-12,
    }
}

#[track_caller]
fn close<A: Make>(got: [f64; 3], exact: f64) {
    for channel in got {
        assert!((channel - exact).abs() <= tolerance::<A>(), "{}: {got:?} for {exact}", A::NAME);
    }
}

/// A scene of these shapes, materials and lights in a bright surrounding, handed to `look`.
fn with<A: Make, T>(
    bodies: &[(Body, u16)],
    materials: &[MaterialSpec],
    lights: &[LightSpec],
    rules: Rules<A>,
    background: Background<A>,
    look: impl FnOnce(&Scene<'_, A>) -> T,
) -> T {
    let shapes = Shapes::<A>::of(bodies, -16);
    let materials: Vec<_> =
        materials.iter().map(|spec| A::material(spec).expect("a material")).collect();
    let lights: Vec<_> = lights.iter().map(|spec| A::light(spec).expect("a light")).collect();
    let parts = Parts {
        materials: &materials,
        lights: &lights,
        ambient: A::ambient([1.0; 3]).expect("ambient"),
        background,
        rules,
        ..shapes.parts()
    };
    look(&Scene::new(parts).expect("a scene"))
}

fn white<A: Make>() -> Background<A> {
    A::uniform([1.0; 3]).expect("a background")
}

/// What one ray counts, and its radiance.
fn counted<A: Make>(
    scene: &Scene<'_, A>,
    depth: u8,
    o: [f64; 3],
    d: [f64; 3],
) -> (Counts, [f64; 3]) {
    let (mut work, mut counts) = (Work::<A, 8>::new(), Counts::default());
    let radiance = Tracer::new(scene, depth).radiance(ray(o, d), &mut work, &mut counts);
    (counts, radiance.map(Into::into))
}

macro_rules! in_all_arithmetics {
    ($($name:ident),* $(,)?) => {
        mod fixed {
            $(#[test]
            fn $name() {
                super::$name::<whitted::math::Fixed>();
            })*
        }
        mod single {
            $(#[test]
            fn $name() {
                super::$name::<f32>();
            })*
        }
        mod double {
            $(#[test]
            fn $name() {
                super::$name::<f64>();
            })*
        }
    };
}

in_all_arithmetics!(
    cutoff_takes_the_product_and_the_cosine,
    cutoff_is_sent_itself_and_by_the_largest_channel,
    transmitters_reflect,
    ties_go_to_the_lowest_number,
    inverted_sphere,
    mirror_ray_below_the_surface,
    air_glass_water,
    glass_of_water,
    depths_of_memory,
    counts_add_up,
);

/// Two mirrors face to face, met at 60° from their normals: ½ from the coefficient and ½ from the
/// cosine at each. Each surface adds 1 times what is left.
fn cutoff_takes_the_product_and_the_cosine<A: Make>() {
    let mirrors = [(Body::Plane(UP, 0.0), 0), (Body::Plane(UP, 2.0), 0)];
    let spec = MaterialSpec { ambient: [1.0; 3], reflection: [0.5; 3], ..BLACK };
    let d = [0.75f64.sqrt(), -0.5, 0.0];
    let seen = |rules: Rules<A>, cutoff: f64| {
        let rules = Rules::<A> { cutoff: weight::<A>(cutoff), ..rules };
        let background = Background::BLACK;
        with(&mirrors, &[spec], &[], rules, background, |s| radiance(s, 8, [0.0, 1.0, 0.0], d))
    };
    close::<A>(seen(Rules::COURSE, 0.3), 1.0);
    close::<A>(seen(Rules::COURSE, 0.1), 1.25);
    close::<A>(seen(Rules::COURSE, 0.05), 1.3125);
    close::<A>(seen(Rules::WHITTED, 0.3), 1.5);
    close::<A>(seen(Rules::WHITTED, 0.1), 1.875);
}

fn cutoff_is_sent_itself_and_by_the_largest_channel<A: Make>() {
    let floor = [(Body::Plane(UP, 0.0), 0)];
    let sent = |reflection: [f64; 3], cutoff: f64| {
        let spec = MaterialSpec { reflection, ..BLACK };
        let rules = Rules::<A> { cutoff: weight::<A>(cutoff), ..Rules::WHITTED };
        with(&floor, &[spec], &[], rules, white(), |s| {
            counted(s, 5, [0.0, 1.0, 0.0], DOWN).0.reflection
        })
    };
    assert_eq!(sent([0.5; 3], 0.5), 1);
    assert_eq!(sent([0.5; 3], 0.501), 0);
    assert_eq!(sent([0.1, 0.6, 0.0], 0.5), 1);
    assert_eq!(sent([0.1, 0.3, 0.4], 0.5), 0);
    // a coefficient of 0 sends nothing, even without a cut-off
    assert_eq!(sent([0.0; 3], 0.0), 0);
}

/// A pane without k_sg sends a mirror ray by this rule alone; it carries nothing.
fn transmitters_reflect<A: Make>() {
    let bodies = [(Body::Plane(UP, 0.0), 0), (Body::Plane(UP, -1.0), 1)];
    let pane = MaterialSpec { transmission: [0.5; 3], ..BLACK };
    let matt = MaterialSpec { ambient: [1.0; 3], ..BLACK };
    let look = |rules: Rules<A>| {
        with(&bodies, &[pane, matt], &[], rules, white(), |s| counted(s, 5, [0.0, 1.0, 0.0], DOWN))
    };
    for (transmitters_reflect, reflection) in [(false, 0), (true, 1)] {
        let (counts, radiance) = look(Rules { transmitters_reflect, ..Rules::NFF });
        assert_eq!((counts.reflection, counts.transmission), (reflection, 1));
        close::<A>(radiance, 0.5);
    }
    // nothing passes a cut-off with nothing
    let rules = Rules::<A> { transmitters_reflect: true, ..Rules::WHITTED };
    assert_eq!(look(rules).0.reflection, 0);
}

/// Two coincident shapes: the first one's material is seen, from both sides.
fn ties_go_to_the_lowest_number<A: Make>() {
    let materials = [0.25, 0.75].map(|k| MaterialSpec { ambient: [k; 3], ..BLACK });
    let square = [[-1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0]];
    for body in [
        Body::Sphere([0.0; 3], 1.0),
        Body::Triangle([square[0], square[1], square[2]]),
        Body::Smooth([square[0], square[1], square[2]], [UP; 3]),
        Body::Polygon(square.to_vec()),
        Body::Cuboid([-1.0; 3], [1.0; 3]),
        Body::Disc([0.0; 3], UP, 1.0),
        Body::Cylinder([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 0.5),
        Body::Cone([0.0, 0.0, -1.0], 0.5, [0.0, 0.0, 1.0], 0.3),
        Body::Plane(UP, 0.0),
    ] {
        for (first, second, value) in [(0, 1, 0.25), (1, 0, 0.75)] {
            let bodies = [(body.clone(), first), (body.clone(), second)];
            with(&bodies, &materials, &[], Rules::COURSE, white::<A>(), |s| {
                close::<A>(radiance(s, 5, [-0.2, 3.0, 0.1], DOWN), value);
                close::<A>(radiance(s, 5, [-0.2, -3.0, 0.1], UP), value);
            });
        }
    }
    // of a disc and a plane the disc has the lower number
    let bodies = [(Body::Plane(UP, 0.0), 1), (Body::Disc([0.0; 3], UP, 1.0), 0)];
    with(&bodies, &materials, &[], Rules::COURSE, white::<A>(), |s| {
        close::<A>(radiance(s, 5, [0.25, 3.0, 0.0], DOWN), 0.25);
        close::<A>(radiance(s, 5, [1.25, 3.0, 0.0], DOWN), 0.75);
    });
}

/// The inside of a ball of radius 2 with a light within: at (0, 0, 2) the light at (0, 1, 0) is
/// √5 away and 2/√5 from the normal. From outside the near wall isn't seen.
fn inverted_sphere<A: Make>() {
    let ball = [(Body::Sphere([0.0; 3], -2.0), 0)];
    let matt = [MaterialSpec { diffuse: [1.0; 3], ..BLACK }];
    let light = |position| {
        [LightSpec::Point { position, intensity: [5.0; 3], falloff: Falloff::InverseSquare }]
    };
    let ahead = [0.0, 0.0, 1.0];
    let cosine = 2.0 / 5f64.sqrt();
    with(&ball, &matt, &light([0.0, 1.0, 0.0]), Rules::COURSE, white::<A>(), |s| {
        close::<A>(radiance(s, 5, [0.0, 0.0, -1.0], ahead), cosine);
        close::<A>(radiance(s, 5, [0.0, 0.0, -9.0], ahead), cosine);
    });
    // a light without doesn't shine in: its ray meets the inside of the wall
    with(&ball, &matt, &light([0.0, 0.0, -3.0]), Rules::COURSE, white::<A>(), |s| {
        close::<A>(radiance(s, 5, [0.0, 0.0, -1.0], ahead), 0.0);
    });
}

/// About a normal tilted by asin 0.8 a ray straight down is mirrored to (0.96, −0.28), below the
/// surface: it is dropped; about one tilted by asin 0.6 to (0.96, 0.28), which isn't.
fn mirror_ray_below_the_surface<A: Make>() {
    let corners = [[-1.0, 0.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.0, -1.0]];
    let mirror = [MaterialSpec { reflection: [0.5; 3], ..BLACK }];
    for (normal, rays, value) in [([0.8, 0.6, 0.0], 0, 0.0), ([0.6, 0.8, 0.0], 1, 0.5)] {
        let bodies = [(Body::Smooth(corners, [normal; 3]), 0)];
        with(&bodies, &mirror, &[], Rules::WHITTED, white::<A>(), |s| {
            let (counts, radiance) = counted(s, 5, [0.0, 1.0, -0.5], DOWN);
            assert_eq!(counts.reflection, rays);
            close::<A>(radiance, value);
        });
    }
}

/// Flat layers of glass and water over a floor of two colours, whose border lies where the ray
/// must arrive: by Snell's law from layer to layer.
fn air_glass_water<A: Make>() {
    let layer = |front, behind, k| MaterialSpec {
        index_front: front,
        index_behind: behind,
        transmission: [k; 3],
        ..BLACK
    };
    let sin = 50f64.to_radians().sin();
    let tan = |index: f64| (sin / index) / (1.0 - (sin / index).powi(2)).sqrt();
    let arrival = tan(1.0) + tan(1.5) + tan(1.33);
    for (shift, value) in [(-0.002, 1.0), (0.002, 0.5)] {
        let pattern = Some(whitted::scene::PatternSpec {
            cell: [10.0, 0.0, 0.0],
            offset: [arrival + shift - 10.0, 0.0, 0.0],
            other: 3,
        });
        let bodies =
            [(Body::Plane(UP, 2.0), 0), (Body::Plane(UP, 1.0), 1), (Body::Plane(UP, 0.0), 2)];
        let materials = [
            layer(1.0, 1.5, 0.9),
            layer(1.5, 1.33, 0.8),
            MaterialSpec { ambient: [0.5; 3], pattern, ..BLACK },
            MaterialSpec { ambient: [1.0; 3], ..BLACK },
        ];
        with(&bodies, &materials, &[], Rules::WHITTED, white::<A>(), |s| {
            let d = [sin, -50f64.to_radians().cos(), 0.0];
            let (counts, radiance) = counted(s, 5, [0.0, 3.0, 0.0], d);
            assert_eq!(counts.transmission, 2);
            // shifted to the left, the border leaves the ray in the odd cell
            close::<A>(radiance, 0.9 * 0.8 * value);
        });
    }
}

/// A ball of water (0.8) in a ball of glass (1), met 0.4 off the axis: in each medium the path
/// passes the centre at 0.4/η, so the deviation is 2((i₁ − r₁) + (i₂ − r₂)) with sin i₁ = 0.4,
/// sin r₁ = 0.4/1.5, sin i₂ = 0.4/(1.5·0.8), sin r₂ = 0.4/(1.33·0.8). The background tells the
/// vertical component of where it goes.
fn glass_of_water<A: Make>() {
    let bodies = [(Body::Sphere([0.0; 3], 1.0), 0), (Body::Sphere([0.0; 3], 0.8), 1)];
    let materials = [
        MaterialSpec { transmission: [1.0; 3], index_behind: 1.5, ..BLACK },
        MaterialSpec { transmission: [1.0; 3], index_front: 1.5, index_behind: 1.33, ..BLACK },
    ];
    let b = 0.4f64;
    let first = b.asin() - (b / 1.5).asin();
    let second = (b / 1.5 / 0.8).asin() - (b / 1.33 / 0.8).asin();
    let deviation = 2.0 * (first + second);
    let background = A::gradient(UP, [0.0; 3], [1.0; 3]).expect("a background");
    with(&bodies, &materials, &[], Rules::WHITTED, background, |s| {
        let (o, d) = ([0.0, b, -3.0], [0.0, 0.0, 1.0]);
        let (counts, radiance) = counted(s, 5, o, d);
        assert_eq!(counts.transmission, 4);
        close::<A>(radiance, (1.0 - deviation.sin()) / 2.0);
        // the camera's ray and four more: one level less doesn't come out
        close::<A>(counted(s, 4, o, d).1, 0.0);
    });
}

/// Every depth that there is memory for is traced, none that there isn't; the memory's size
/// doesn't change what is seen.
fn depths_of_memory<A: Make>() {
    // One copy of the tracer for each depth.
    fn down<A: Make, const N: usize>(
        scene: &Scene<'_, A>,
        work: &mut Work<A, N>,
    ) -> (Counts, [f64; 3]) {
        let (mut counts, ray) = (Counts::default(), ray([0.0, 1.0, 0.0], DOWN));
        let seen = Tracer::new(scene, N as u8).radiance(ray, work, &mut counts);
        (counts, seen.map(Into::into))
    }
    fn depth<A: Make, const N: usize>(mirrors: &Scene<'_, A>, panes: &Scene<'_, A>) {
        let depth = N as u8;
        let mut work = Work::<A, N>::new();
        let camera = A::camera();
        for (asked, fits) in [(depth, true), (depth + 1, false), (0, false)] {
            let settings = Settings { depth: asked, ..Settings::new(1, 1) };
            let made = Renderer::new(mirrors, &camera, settings, &mut work, &mut []);
            let error = FrameError::Depth { depth: asked, max: depth };
            assert_eq!(made.map(|_| ()).err(), if fits { None } else { Some(error) });
        }
        let (_, seen) = down(mirrors, &mut work);
        close::<A>(seen, 2.0 - 0.5f64.powi(i32::from(depth) - 1));
        // both kinds of ray at every surface: as many wait as there is memory for
        let all = counted(panes, depth, [0.0, 1.0, 0.0], DOWN);
        assert_eq!(down(panes, &mut work), all);
    }
    let planes = |material| (0..8).map(move |i| (Body::Plane(UP, -f64::from(i)), material));
    let mirror = MaterialSpec { ambient: [1.0; 3], reflection: [0.5; 3], ..BLACK };
    let pane = MaterialSpec { transmission: [0.5; 3], ..mirror };
    let pair = [(Body::Plane(UP, 0.0), 0), (Body::Plane(UP, 2.0), 0)];
    let stack: Vec<_> = planes(0).collect();
    with(&pair, &[mirror], &[], Rules::NFF, Background::<A>::BLACK, |mirrors| {
        with(&stack, &[pane], &[], Rules::NFF, white::<A>(), |panes| {
            depth::<A, 1>(mirrors, panes);
            depth::<A, 2>(mirrors, panes);
            depth::<A, 3>(mirrors, panes);
            depth::<A, 4>(mirrors, panes);
            depth::<A, 5>(mirrors, panes);
            depth::<A, 6>(mirrors, panes);
            depth::<A, 7>(mirrors, panes);
            depth::<A, 8>(mirrors, panes);
            // a ball of rays: above the top pane there is nothing, below it both at each pane
            assert_eq!(counted(panes, 2, [0.0, 1.0, 0.0], DOWN).0.rays(), 3);
        });
    });
}

/// One camera ray a pixel, or a corner; a shadow ray from each hit to each light in front of it.
fn counts_add_up<A: Make>() {
    let lamp =
        |position| LightSpec::Point { position, intensity: [1.0; 3], falloff: Falloff::None };
    // in front of the wall, in front but behind the shade, behind the wall, on its plane
    let lights = [
        lamp([0.0, 0.0, -1.0]),
        lamp([0.0, 0.0, -9.0]),
        lamp([0.0, 0.0, 9.0]),
        LightSpec::Directional { direction: [1.0, 0.0, 0.0], intensity: [1.0; 3] },
    ];
    let ahead = [0.0, 0.0, 1.0];
    let bodies = [
        (Body::Disc([0.0, 0.0, 4.0], ahead, 1.0), 0),
        // behind the camera, between the second light and everything
        (Body::Disc([0.0, 0.0, -5.0], ahead, 100.0), 0),
    ];
    let matt = [MaterialSpec { diffuse: [1.0; 3], ..BLACK }];
    with(&bodies, &matt, &lights, Rules::COURSE, white::<A>(), |s| {
        for (sampling, rays) in [(Sampling::Center, 12 * 10), (Sampling::Corners, 13 * 11)] {
            let settings = Settings { sampling, ..Settings::new(12, 10) };
            let mut work = Work::<A, 5>::new();
            let mut samples = vec![Sample::NONE; sampling.samples(12)];
            let (camera, none) = (A::camera(), Counts::default());
            let mut renderer =
                Renderer::with_tally(s, &camera, settings, &mut work, &mut samples, none)
                    .expect("settings");
            assert_eq!(renderer.scan(0..12, 0..10).count(), 120);
            let counts = *renderer.tally();
            assert_eq!(counts.primary, rays);
            assert!(counts.primary_hits > 0 && counts.primary_hits < rays);
            assert_eq!(counts.shadow, 2 * counts.primary_hits);
            assert_eq!(counts.shadow_hits, counts.primary_hits);
            assert_eq!((counts.reflection, counts.transmission, counts.ambient), (0, 0, 0));
            assert_eq!(counts.rays(), rays + counts.shadow);
            assert_eq!(counts.nodes, 0);
            let mut twice = counts;
            twice += counts;
            assert_eq!(twice.rays(), 2 * counts.rays());
            assert_eq!(
                (twice.tests, twice.shadow_hits),
                (2 * counts.tests, 2 * counts.shadow_hits)
            );
        }
    });
}

/// A list looks at every shape for every ray, the one that it leaves too.
#[test]
fn tests_are_counted() {
    let bodies: Vec<_> =
        (0..5).map(|i| (Body::Disc([0.0, f64::from(i), 0.0], UP, 1.0), 0)).collect();
    let mirror = [MaterialSpec { reflection: [0.5; 3], ..BLACK }];
    with(&bodies, &mirror, &[], Rules::WHITTED, white::<Fixed>(), |s| {
        // down to the uppermost disc, and up again
        let (counts, _) = counted(s, 5, [0.0, 9.0, 0.0], DOWN);
        assert_eq!((counts.rays(), counts.tests, counts.nodes), (2, 5 + 5, 0));
    });
}

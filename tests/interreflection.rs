//! Diffuse interreflection against a path tracer, and the same bits whatever the order.

use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::gather::VirtualLightSpec;
use whitted::gather::{Draft, FillError, Gatherer, Gathering, GatheringSpec, Indirect, Record};
use whitted::gather::{VirtualLight, VirtualLights, VirtualLightsSettings, VirtualLightsSpec};
use whitted::math::{Arithmetic, Fixed};
use whitted::scene::{Area, AreaLight, AreaLightSpec, Background};
use whitted::scene::{Camera, Falloff, Light, LightSpec, Material, MaterialSpec, Parts, Scene};
use whitted::shape::Plane;
use whitted::tally::Counts;
use whitted::trace::Work;

const WIDTH: u16 = 48;
const HEIGHT: u16 = 36;
/// Six walls at ±1, a spot on the one at the back.
const NORMALS: [[f64; 3]; 6] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
];
const ALBEDOS: [[f64; 3]; 6] = [
    [0.7, 0.2, 0.2],
    [0.2, 0.7, 0.3],
    [0.6, 0.6, 0.6],
    [0.7, 0.7, 0.7],
    [0.5, 0.5, 0.7],
    [0.8, 0.8, 0.8],
];
const LAMP: [f64; 3] = [0.1, 0.3, 0.2];
const SHINE: [f64; 3] = [0.2, -0.1, 1.0];
const COS: [f64; 2] = [0.9, 0.8];
const EYE: [f64; 3] = [0.1, 0.2, -0.9];
const LOOK: [f64; 3] = [0.0, -0.2, 1.0];

macro_rules! scene {
    ($a:ty, $scene:ident, $camera:ident) => {
        let planes: [_; 6] = std::array::from_fn(|i| Plane::<$a>::new(NORMALS[i], -1.0, i as u16));
        let materials = ALBEDOS
            .map(|diffuse| Material::<$a>::new(MaterialSpec { diffuse, ..MaterialSpec::BLACK }));
        let lights = [Light::<$a>::new(LightSpec::Spot {
            position: LAMP,
            direction: SHINE,
            intensity: [2.0; 3],
            falloff: Falloff::InverseSquare,
            cos_inner: COS[0],
            cos_outer: COS[1],
        })];
        let $scene = Scene::<$a>::new(Parts {
            planes: &planes,
            materials: &materials,
            lights: &lights,
            ..Parts::EMPTY
        })
        .expect("a scene");
        let $camera = Camera::<$a>::look_at(EYE, LOOK, [0.0, 1.0, 0.0], 70.0);
    };
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let n = dot(v, v).sqrt();
    v.map(|x| x / n)
}

/// The wall that a ray in the box hits, and where.
fn hit(o: [f64; 3], d: [f64; 3]) -> (usize, [f64; 3]) {
    let (mut best, mut wall) = (f64::MAX, 0);
    for (i, n) in NORMALS.iter().enumerate() {
        let speed = -dot(*n, d);
        let t = (dot(*n, o) + 1.0) / speed;
        if speed > 0.0 && t < best {
            (best, wall) = (t, i);
        }
    }
    (wall, [0, 1, 2].map(|i| (o[i] + best * d[i]).clamp(-1.0, 1.0)))
}

/// What the spot gives a wall, over π: nothing stands between.
fn direct(wall: usize, p: [f64; 3]) -> f64 {
    let v = [0, 1, 2].map(|i| LAMP[i] - p[i]);
    let l = unit(v);
    let inside = -dot(l, unit(SHINE)) - COS[1];
    let f = (inside / (COS[0] - COS[1])).clamp(0.0, 1.0);
    2.0 * f * f * (3.0 - 2.0 * f) * dot(l, NORMALS[wall]).max(0.0) / dot(v, v)
}

/// The light that has been passed on `bounces` times at most, the direct light left out: paths
/// from the eye, in f64.
fn path_traced(
    o: [f64; 3],
    d: [f64; 3],
    bounces: usize,
    random: &mut dyn FnMut() -> f64,
) -> [f64; 3] {
    let (mut wall, mut p) = hit(o, d);
    let mut weight = ALBEDOS[wall];
    let mut sum = [0.0; 3];
    for _ in 0..bounces {
        (wall, p) = hit(p, anywhere(wall, random));
        for i in 0..3 {
            weight[i] *= ALBEDOS[wall][i];
            sum[i] += weight[i] * direct(wall, p);
        }
    }
    sum
}

/// The wall that is a window in [`a_box_with_a_window`], behind the camera.
const WINDOW: usize = 4;

/// The light of a sky of radiance 1 that comes by the window and by at most so many walls after the
/// first.
fn by_the_window(
    o: [f64; 3],
    d: [f64; 3],
    bounces: usize,
    random: &mut dyn FnMut() -> f64,
) -> [f64; 3] {
    let (mut wall, mut p) = hit(o, d);
    let mut weight = ALBEDOS[wall];
    for _ in 0..=bounces {
        (wall, p) = hit(p, anywhere(wall, random));
        if wall == WINDOW {
            return weight;
        }
        weight = [0, 1, 2].map(|i| weight[i] * ALBEDOS[wall][i]);
    }
    [0.0; 3]
}

/// A direction from a wall, with the cosine: towards a point on the unit sphere around the normal's
/// end.
fn anywhere(wall: usize, random: &mut dyn FnMut() -> f64) -> [f64; 3] {
    let (z, turn) = (2.0 * random() - 1.0, random() * std::f64::consts::TAU);
    let r = (1.0 - z * z).sqrt();
    let n = NORMALS[wall];
    unit([n[0] + r * turn.cos(), n[1] + r * turn.sin(), n[2] + z])
}

/// The indirect light of every pixel, by paths.
fn truth(bounces: usize, paths: usize) -> Vec<[f64; 3]> {
    traced(paths, |o, d, random| path_traced(o, d, bounces, random))
}

/// Every pixel, as the mean of what some paths from the eye find.
fn traced(
    paths: usize,
    path: impl Fn([f64; 3], [f64; 3], &mut dyn FnMut() -> f64) -> [f64; 3],
) -> Vec<[f64; 3]> {
    let camera = Camera::<f64>::look_at(EYE, LOOK, [0.0, 1.0, 0.0], 70.0);
    let view = whitted::scene::View::new(&camera, WIDTH, HEIGHT);
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    let mut random = move || {
        // splitmix64 (Steele, Lea, Flood 2014)
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut pixels = Vec::new();
    for y in 0..HEIGHT {
        let row = view.row(y, 128);
        for x in 0..WIDTH {
            let ray = view.ray(&row, x, 128);
            let mut sum = [0.0; 3];
            for _ in 0..paths {
                let one = path(ray.origin, ray.direction, &mut random);
                sum = [0, 1, 2].map(|i| sum[i] + one[i]);
            }
            pixels.push(sum.map(|s| s / paths as f64));
        }
    }
    pixels
}

macro_rules! picture {
    ($a:ty, $scene:expr, $camera:expr) => {{
        let mut work = Work::<$a, 5>::new();
        let settings = Settings::new(WIDTH, HEIGHT);
        let mut renderer =
            Renderer::new($scene, $camera, settings, &mut work, &mut []).expect("settings");
        let pixels: Vec<[f64; 3]> = renderer
            .scan(0..WIDTH, 0..HEIGHT)
            .map(|(_, _, radiance)| radiance.map(Into::into))
            .collect();
        pixels
    }};
}

/// The light in a picture that the surfaces send each other, picture less direct light, in the mean
/// of some pixels, relative to the truth.
fn compare(
    with: &[[f64; 3]],
    without: &[[f64; 3]],
    truth: &[[f64; 3]],
    shown: impl Fn(usize, usize) -> bool,
) -> f64 {
    let (mut sum, mut wanted) = (0.0, 0.0);
    for (pixel, ((a, b), t)) in with.iter().zip(without).zip(truth).enumerate() {
        if shown(pixel % usize::from(WIDTH), pixel / usize::from(WIDTH)) {
            for i in 0..3 {
                sum += a[i] - b[i];
                wanted += t[i];
            }
        }
    }
    sum / wanted - 1.0
}

fn everywhere(_: usize, _: usize) -> bool {
    true
}

const BOUNCES: u8 = 2;
const SPEC: GatheringSpec = GatheringSpec {
    error: 0.15,
    rings: 6,
    sectors: 18,
    bounces: BOUNCES,
    nearest: 0.6,
    farthest: 1.5,
    coarse: 8,
    fine: 1,
    ..GatheringSpec::DEFAULT
};

macro_rules! cached_box {
    ($name:ident, $a:ty) => {
        #[test]
        fn $name() {
            scene!($a, scene, camera);
            let mut pool = vec![Record::<$a>::NONE; 2500];
            let mut drafts = vec![Draft::<$a>::NONE; 2500];
            let mut work = Work::<$a, 5>::new();
            let mut counts = Counts::default();
            let cache = Gatherer::new(&scene, Gathering::<$a>::new(SPEC), &mut work, &mut counts)
                .expect("settings")
                .fill(&camera, (WIDTH, HEIGHT), &mut pool, &mut drafts)
                .expect("memory");
            let count = cache.records().len();
            assert!(!cache.is_full(), "{count}");
            let lit = scene.with_indirect(Indirect::Cache(cache)).expect("uses");
            let without = picture!($a, &scene, &camera);
            let with = picture!($a, &lit, &camera);
            let truth = truth(BOUNCES.into(), 1500);
            let mean = compare(&with, &without, &truth, everywhere);
            println!("{}: {count} records, mean {mean:+.4}, {counts:?}", <$a>::NAME);
            assert!(mean.abs() < 0.03, "{mean}");
        }
    };
}
cached_box!(a_box_with_a_bright_wall_in_fixed, Fixed);
cached_box!(a_box_with_a_bright_wall_in_f32, f32);
cached_box!(a_box_with_a_bright_wall_in_f64, f64);

macro_rules! box_by_virtual_lights {
    ($name:ident, $a:ty) => {
        #[test]
        fn $name() {
            scene!($a, scene, camera);
            let settings = VirtualLightsSettings::<$a>::new(VirtualLightsSpec {
                bounces: BOUNCES,
                tile: 2,
                ..VirtualLightsSpec::DEFAULT
            });
            let mut pool = vec![VirtualLight::<$a>::NONE; 512];
            let mut work = Work::<$a, 5>::new();
            let lights = VirtualLights::lay(&scene, &settings, &mut pool, &mut work, &mut ());
            let lit = scene.with_indirect(Indirect::VirtualLights(lights)).expect("uses");
            let without = picture!($a, &scene, &camera);
            let with = picture!($a, &lit, &camera);
            let truth = truth(BOUNCES.into(), 1500);
            let (w, h) = (usize::from(WIDTH), usize::from(HEIGHT));
            let third = |x, n| (n / 3..2 * n / 3).contains(&x);
            let middle = compare(&with, &without, &truth, |x, y| third(x, w) && third(y, h));
            let all = compare(&with, &without, &truth, everywhere);
            println!("{}: middle {middle:+.4}, everywhere {all:+.4}", <$a>::NAME);
            assert!(middle.abs() < 0.1, "{middle}");
        }
    };
}
box_by_virtual_lights!(a_box_by_virtual_lights_in_fixed, Fixed);
box_by_virtual_lights!(a_box_by_virtual_lights_in_f32, f32);
box_by_virtual_lights!(a_box_by_virtual_lights_in_f64, f64);

/// A box lit through a window by the sky, which an area light stands for: all its light, direct and
/// passed on, against paths that end in the sky.
macro_rules! a_box_with_a_window {
    ($name:ident, $a:ty) => {
        #[test]
        fn $name() {
            let numbers = [0, 1, 2, 3, 5u16];
            let planes = numbers.map(|i| Plane::<$a>::new(NORMALS[usize::from(i)], -1.0, i));
            let materials = ALBEDOS.map(|diffuse| {
                Material::<$a>::new(MaterialSpec { diffuse, ..MaterialSpec::BLACK })
            });
            let (u, v) = ([2.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
            let window = [AreaLight::<$a>::new(AreaLightSpec {
                area: Area::Rectangle { corner: [-1.0; 3], u, v },
                radiance: [1.0; 3],
                error: AreaLightSpec::ERROR,
                samples: [16, 16],
                body: None,
            })];
            let scene = Scene::<$a>::new(Parts {
                planes: &planes,
                materials: &materials,
                area_lights: &window,
                light_jitter: Some(1),
                background: Background::<$a>::uniform([1.0; 3]),
                ..Parts::EMPTY
            })
            .expect("a scene");
            let camera = Camera::<$a>::look_at(EYE, LOOK, [0.0, 1.0, 0.0], 70.0);
            let spec = GatheringSpec { error: 0.3, fine: 2, ..SPEC };
            let mut pool = vec![Record::<$a>::NONE; 800];
            let mut drafts = vec![Draft::<$a>::NONE; 800];
            let mut work = Work::<$a, 5>::new();
            let cache = Gatherer::new(&scene, Gathering::<$a>::new(spec), &mut work, &mut ())
                .expect("settings")
                .fill(&camera, (WIDTH, HEIGHT), &mut pool, &mut drafts)
                .expect("memory");
            let lit = scene.with_indirect(Indirect::Cache(cache)).expect("uses");
            let picture = picture!($a, &lit, &camera);
            let none = vec![[0.0; 3]; picture.len()];
            let truth = traced(200, |o, d, random| by_the_window(o, d, BOUNCES.into(), random));
            let mean = compare(&picture, &none, &truth, everywhere);
            println!("{}: {} records, mean {mean:+.4}", <$a>::NAME, cache.records().len());
            assert!(mean.abs() < 0.03, "{mean}");
        }
    };
}
a_box_with_a_window!(a_box_with_a_window_in_fixed, Fixed);
a_box_with_a_window!(a_box_with_a_window_in_f32, f32);
a_box_with_a_window!(a_box_with_a_window_in_f64, f64);

/// A virtual light outside shines in by an open window, but not by one that an area light stands
/// for: that one's radiance is all that comes from there. It does by the back of such a light.
#[test]
fn a_window_hides_the_virtual_lights_behind_it() {
    type A = Fixed;
    let planes = [Plane::<A>::new([0.0, 1.0, 0.0], -1.0, 0)];
    let white = MaterialSpec { diffuse: [1.0; 3], ..MaterialSpec::BLACK };
    let materials = [Material::<A>::new(white)];
    let lights = [VirtualLight::<A>::new(VirtualLightSpec {
        position: [0.0, 0.0, -2.0],
        normal: [0.0, 0.0, 1.0],
        intensity: 16.0,
        color: [1.0; 3],
    })];
    let (x, y) = ([2.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
    let window = |u, v| {
        [AreaLight::<A>::new(AreaLightSpec {
            area: Area::Rectangle { corner: [-1.0; 3], u, v },
            radiance: [0.0; 3],
            error: AreaLightSpec::ERROR,
            samples: [1, 1],
            body: None,
        })]
    };
    let settings = VirtualLightsSettings::<A>::new(VirtualLightsSpec::DEFAULT);
    let camera = Camera::<A>::look_at([0.0; 3], [0.0, -1.0, 0.5], [0.0, 1.0, 0.0], 10.0);
    let shown = |area_lights: &[AreaLight<A>]| {
        let parts = Parts { planes: &planes, materials: &materials, area_lights, ..Parts::EMPTY };
        let scene = Scene::<A>::new(parts).expect("a scene");
        let lights = VirtualLights::new(&lights, &settings);
        let lit = scene.with_indirect(Indirect::VirtualLights(lights)).expect("uses");
        picture!(A, &lit, &camera)
    };
    let open = shown(&[]);
    assert!(open.iter().all(|pixel| pixel[0] > 0.04));
    assert!(shown(&window(x, y)).iter().all(|pixel| *pixel == [0.0; 3]));
    assert_eq!(shown(&window(y, x)), open);
}

/// Rows in any order, in bands and in halves, give the bits that the whole gives, and a second
/// filling gives the same records.
#[test]
fn the_order_changes_no_bit() {
    type A = Fixed;
    scene!(A, scene, camera);
    let spec = GatheringSpec { bounces: 2, fine: 4, ..GatheringSpec::DEFAULT };
    let mut pools = [vec![Record::<A>::NONE; 300], vec![Record::<A>::NONE; 300]];
    let [first, second] = pools.each_mut().map(|pool| {
        let mut drafts = vec![Draft::<A>::NONE; 300];
        let mut work = Work::<A, 5>::new();
        Gatherer::new(&scene, Gathering::<A>::new(spec), &mut work, &mut ())
            .expect("settings")
            .fill(&camera, (WIDTH, HEIGHT), pool, &mut drafts)
            .expect("memory")
    });
    assert_eq!(first.records(), second.records());
    let lit = scene.with_indirect(Indirect::Cache(first)).expect("uses");
    drawn_in_any_order(&lit, &camera);
}

/// The same with virtual lights, whose parts take turns over the pixels of a tile; laid twice, they
/// are the same.
#[test]
fn the_order_changes_no_bit_of_virtual_light() {
    type A = Fixed;
    scene!(A, scene, camera);
    for tile in [1, 2, 4] {
        let settings = VirtualLightsSettings::<A>::new(VirtualLightsSpec {
            tile,
            ..VirtualLightsSpec::DEFAULT
        });
        let mut pools = [vec![VirtualLight::<A>::NONE; 128], vec![VirtualLight::<A>::NONE; 128]];
        let [first, second] = pools.each_mut().map(|pool| {
            let mut work = Work::<A, 5>::new();
            VirtualLights::lay(&scene, &settings, pool, &mut work, &mut ())
        });
        let specs = |lights: VirtualLights<'_, A>| {
            lights.lights().iter().map(VirtualLight::<A>::spec).collect::<Vec<_>>()
        };
        assert_eq!(specs(first), specs(second));
        let lit = scene.with_indirect(Indirect::VirtualLights(first)).expect("uses");
        drawn_in_any_order(&lit, &camera);
    }
}

/// Draws a picture whole, by pieces from the bottom up, by lines, and by bands of some heights.
fn drawn_in_any_order(lit: &Scene<'_, Fixed>, camera: &Camera<Fixed>) {
    let whole = picture!(Fixed, lit, camera);
    let mut work = Work::<Fixed, 5>::new();
    let settings = Settings::new(WIDTH, HEIGHT);
    let mut renderer = Renderer::new(lit, camera, settings, &mut work, &mut []).expect("settings");
    let middle = WIDTH / 2 - 3;
    for y in (0..HEIGHT).rev() {
        for columns in [middle..WIDTH, 0..middle] {
            for (x, y, radiance) in renderer.scan(columns, y..y + 1) {
                let pixel = usize::from(y) * usize::from(WIDTH) + usize::from(x);
                assert_eq!(radiance.map(Into::<f64>::into), whole[pixel], "{x} {y}");
            }
        }
    }
    let mut lines = vec![[Rgb888([0; 3]); WIDTH as usize]; HEIGHT.into()];
    for (y, line) in (0..HEIGHT).zip(&mut lines).rev() {
        renderer.line(y, &Output::SRGB, line);
    }
    let lines: Vec<u8> = lines.iter().flatten().flat_map(|pixel| pixel.0).collect();
    for height in [1, 7, HEIGHT] {
        let mut bytes = vec![0; usize::from(height) * usize::from(WIDTH) * 3];
        let (mut y, mut all) = (0, Vec::new());
        while y < HEIGHT {
            let rows = renderer.band::<Rgb888>(y, &Output::SRGB, &mut bytes);
            all.extend_from_slice(&bytes[..usize::from(rows) * usize::from(WIDTH) * 3]);
            y += rows;
        }
        assert!(all == lines, "bands of {height}");
    }
}

/// When the pool is full no more are added, and where none reaches, the least wrong one counts.
#[test]
fn a_full_pool() {
    type A = Fixed;
    scene!(A, scene, camera);
    let mut work = Work::<A, 5>::new();
    let gathering = Gathering::<A>::new(GatheringSpec::DEFAULT);
    let mut counts = Counts::default();
    let mut gatherer = Gatherer::new(&scene, gathering, &mut work, &mut counts).expect("settings");
    let mut large = vec![Record::<A>::NONE; 300];
    let mut small = [Record::<A>::NONE; 10];
    let all = gatherer.fill(&camera, (WIDTH, HEIGHT), &mut large, &mut []).expect("memory");
    let few = gatherer.fill(&camera, (WIDTH, HEIGHT), &mut small, &mut []).expect("memory");
    assert!(few.is_full() && !all.is_full());
    // The first that were found; where they lie in the pool says how they are found again.
    assert_eq!(few.records().len(), 10);
    assert!(few.records().iter().all(|record| all.records().contains(record)));
    let none = gatherer.fill(&camera, (WIDTH, HEIGHT), &mut [], &mut []).expect("memory");
    assert!(none.is_full() && none.records().is_empty());
    let lit = scene.with_indirect(Indirect::Cache(few)).expect("uses");
    let without = picture!(A, &scene, &camera);
    let with = picture!(A, &lit, &camera);
    // No pixel gets more than the brightest record can say, and none nothing but those whose
    // nearest record lies on the lit wall.
    let most = few.records().iter().map(|r| r.spec().irradiance[1]).fold(0.0, f64::max);
    assert!(with.iter().zip(&without).all(|(a, b)| a[1] - b[1] < 2.0 * most));
    let brighter = with.iter().zip(&without).filter(|(a, b)| a[1] > b[1]).count();
    assert!(brighter > with.len() / 4, "{brighter}");
    let gathering = Gathering::<A>::new(GatheringSpec { bounces: 2, ..GatheringSpec::DEFAULT });
    let mut gatherer = Gatherer::new(&scene, gathering, &mut work, &mut counts).expect("settings");
    let error = gatherer.fill(&camera, (WIDTH, HEIGHT), &mut small, &mut []).err();
    assert_eq!(error, Some(FillError::Drafts { needed: 10 }));
}

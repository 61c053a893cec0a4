//! What each sampling gives for its rays. `docs/sampling.md` has the figures.

use crate::common::make::{Body, Make, Shapes};
use crate::common::scenes::{Shot, Shots};
use whitted::frame::{
    Output, Passes, Pixel, Progress, Renderer, Rgb888, Sample, Sampling, Settings, Tone,
};
use whitted::math::{Arithmetic, Fixed, Rgb};
use whitted::scene::{Camera, MaterialSpec, Parts, Scene};
use whitted::tally::Counts;
use whitted::trace::Work;

/// Calls a function with a renderer that counts.
fn with<A: Arithmetic, R>(
    (scene, camera, depth): (&Scene<'_, A>, &Camera<A>, u8),
    size: (u16, u16),
    sampling: Sampling,
    act: impl FnOnce(&mut Renderer<'_, A, 5, Counts>) -> R,
) -> R {
    let settings = Settings { depth, sampling, ..Settings::new(size.0, size.1) };
    let mut work = Work::<A, 5>::new();
    let mut samples = vec![Sample::NONE; sampling.samples(size.0)];
    let counts = Counts::default();
    let made = Renderer::with_tally(scene, camera, settings, &mut work, &mut samples, counts);
    act(&mut made.expect("settings"))
}

/// A picture's radiances, row by row, and the rays it took.
fn picture<A: Arithmetic>(
    view: (&Scene<'_, A>, &Camera<A>, u8),
    size: (u16, u16),
    sampling: Sampling,
) -> (Vec<Rgb<A::Radiance>>, Counts) {
    with(view, size, sampling, |renderer| {
        let pixels = renderer.scan(0..size.0, 0..size.1).map(|(.., radiance)| radiance).collect();
        (pixels, *renderer.tally())
    })
}

/// A scene by its name.
fn view<A: Shots>(name: &str) -> (&'static Scene<'static, A>, &'static Camera<A>, u8) {
    let shot: &Shot<A> = A::SHOTS.iter().find(|shot| shot.name == name).expect("a scene");
    (shot.scene, shot.camera, shot.depth)
}

fn shown<A: Arithmetic>(pixels: &[Rgb<A::Radiance>]) -> Vec<[u8; 3]> {
    pixels.iter().map(|r| Output::SRGB.pixel::<A, Rgb888>(r, 0, 0).0).collect()
}

fn decibels(a: &[[u8; 3]], b: &[[u8; 3]]) -> f64 {
    let square = |(a, b): (&u8, &u8)| (f64::from(*a) - f64::from(*b)).powi(2);
    let sum: f64 = a.as_flattened().iter().zip(b.as_flattened()).map(square).sum();
    10.0 * (255.0 * 255.0 * 3.0 * a.len() as f64 / sum).log10()
}

/// The mean of 24×24 rays a pixel.
fn truth<A: Shots>(name: &str, size: (u16, u16)) -> Vec<[u8; 3]> {
    let (fine, _) = picture(view::<A>(name), (size.0 * 3, size.1 * 3), Sampling::Grid { side: 8 });
    let width = usize::from(size.0);
    let mut means = vec![[A::BLACK; 3]; width * usize::from(size.1)];
    for (i, pixel) in fine.iter().enumerate() {
        let mean = &mut means[i / (width * 9) * width + i / 3 % width];
        *mean = [0, 1, 2].map(|c| A::gather(mean[c], pixel[c]));
    }
    shown::<A>(&means.iter().map(|m| m.map(|sum| A::mean(sum, 9))).collect::<Vec<_>>())
}

/// A picture's pixels by a tone, row by row, and the rays it took.
fn pixels<A: Arithmetic, P: Pixel>(
    view: (&Scene<'_, A>, &Camera<A>, u8),
    size: (u16, u16),
    sampling: Sampling,
    tone: Tone,
) -> (Vec<P>, Counts) {
    with(view, size, sampling, |renderer| {
        let output = Output { tone, ..Output::SRGB };
        let pixels = renderer.pixels(0..size.0, 0..size.1, &output).map(|(.., pixel)| pixel);
        (pixels.collect(), *renderer.tally())
    })
}

fn rays<A: Shots>(name: &str, size: (u16, u16), sampling: Sampling) -> (Vec<[u8; 3]>, Counts) {
    toned::<A>(name, size, sampling, Tone::SRGB)
}

fn toned<A: Shots>(
    name: &str,
    size: (u16, u16),
    sampling: Sampling,
    tone: Tone,
) -> (Vec<[u8; 3]>, Counts) {
    let (pixels, counts) = pixels::<A, Rgb888>(view::<A>(name), size, sampling, tone);
    (pixels.into_iter().map(|Rgb888(rgb)| rgb).collect(), counts)
}

/// Display values as they are.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Values([u16; 3]);

impl Pixel for Values {
    const BYTES: usize = 3;

    fn quantize(rgb: [u16; 3], _: u16) -> Self {
        Self(rgb)
    }

    fn to_be_bytes(self) -> [u8; 3] {
        self.0.map(|value| (value >> 8) as u8)
    }
}

/// Every sampling against 24×24 rays a pixel; the table in `docs/sampling.md`.
#[test]
fn adaptive_sampling_is_nearly_64_rays_for_a_third_of_them() {
    for (name, size) in [("showcase", (160, 120)), ("limit", (160, 120))] {
        let truth = truth::<f32>(name, size);
        let (_, one) = rays::<f32>(name, size, Sampling::Center);
        let measured = |sampling| {
            let (pixels, counts) = rays::<f32>(name, size, sampling);
            let found = decibels(&pixels, &truth);
            let per = counts.primary as f64 / one.primary as f64;
            let part = counts.rays() as f64 / one.rays() as f64;
            println!(
                "{name}, {sampling:?}: {per:.2} rays a pixel, {part:.2} times all, {found:.1} dB"
            );
            (found, part)
        };
        let grid = |side| measured(Sampling::Grid { side });
        let (center, corners) = (measured(Sampling::Center), measured(Sampling::Corners));
        let (two, four, full) = (grid(2), grid(4), grid(8));
        assert!(center.0 < corners.0 && corners.0 < two.0 && two.0 < four.0 && four.0 < full.0);
        for side in [2, 4, 8] {
            measured(Sampling::Jittered { side, seed: 0 });
        }
        let adaptive = |depth| measured(Sampling::Adaptive { depth, threshold: 14 });
        let (one, two) = (adaptive(1), adaptive(2));
        let (some, part) = measured(Sampling::ADAPTIVE);
        assert!(one.0 < two.0 && two.0 < some && one.1 < two.1 && two.1 < part);
        assert!(some >= 46.0 && full.0 - some <= 4.0, "{name}: {some} dB, 8×8 {} dB", full.0);
        assert!(part < full.1 / 3.0, "{name}: {part} times the rays, 8×8 {}", full.1);
    }
}

#[test]
fn sparse_sampling_is_nearly_all_rays_for_a_third_of_them() {
    // The showcase's floor is a pattern up to the horizon, where there is nothing to interpolate: a large
    // picture has a smaller part of it.
    for (name, size, tone, enough, most_rays) in [
        ("showcase", (480, 320), Tone::SRGB, 40.0, 0.35),
        ("showcase", (1200, 800), Tone::SRGB, 41.5, 0.24),
        ("limit", (240, 240), Tone::SRGB, 41.0, 0.32),
        // As the boards draw it.
        ("limit", (240, 240), Tone::LINEAR, 40.0, 0.25),
    ] {
        let (all, most) = toned::<f32>(name, size, Sampling::Center, tone);
        let mut last = 0.0;
        for side in [8, 4, 2] {
            let Sampling::Sparse { threshold, .. } = Sampling::SPARSE else { unreachable!() };
            let sampling = Sampling::Sparse { side, threshold };
            let (some, fewer) = toned::<f32>(name, size, sampling, tone);
            let primary = fewer.primary as f64 / most.primary as f64;
            let part = fewer.rays() as f64 / most.rays() as f64;
            let some = decibels(&some, &all);
            println!(
                "{name} {size:?} {tone:?} {sampling:?}: {some:.1} dB, {primary:.3} of the camera's rays, {part:.3} of all"
            );
            if sampling == Sampling::SPARSE {
                assert!(some >= enough, "{name}: {some} dB");
                assert!(part < most_rays, "{name}: {part} of the rays");
            }
            assert!(some > last, "{name}: {some} dB, {last} dB with larger blocks");
            last = some;
        }
    }
}

/// Pieces of a sparse picture, in an order in which nothing that is remembered helps, and row by row.
#[test]
fn any_part_of_a_sparse_picture_is_the_same() {
    fn test<A: Shots>() {
        let size = (83, 50);
        for (side, threshold) in [(2, 9), (4, 19), (8, 5), (16, 3)] {
            let sampling = Sampling::Sparse { side, threshold };
            let view = view::<A>("every");
            let (whole, _) = pixels::<A, Values>(view, size, sampling, Tone::SRGB);
            let (center, _) = pixels::<A, Values>(view, size, Sampling::Center, Tone::SRGB);
            for y in (0..size.1).step_by(side.into()) {
                for x in (0..size.0).step_by(side.into()) {
                    let pixel = usize::from(y) * usize::from(size.0) + usize::from(x);
                    assert_eq!(whole[pixel], center[pixel], "{side}: {x}, {y}");
                }
            }
            with(view, size, sampling, |renderer| {
                for (columns, rows) in [
                    (41..42, 33..34),
                    (0..7, 20..50),
                    (16..49, 19..23),
                    (15..50, 0..3),
                    (33..83, 30..50),
                    (82..83, 0..50),
                    (0..83, 17..18),
                    (31..32, 0..50),
                    (4..80, 48..50),
                ] {
                    // Another tone in between leaves nothing behind.
                    let linear = Output { tone: Tone::LINEAR, ..Output::SRGB };
                    renderer
                        .pixels::<Values>(columns.clone(), rows.clone(), &linear)
                        .take(99)
                        .count();
                    for (x, y, pixel) in renderer.pixels::<Values>(columns, rows, &Output::SRGB) {
                        let expected = whole[usize::from(y) * usize::from(size.0) + usize::from(x)];
                        assert_eq!(pixel, expected, "{side}: {x}, {y}");
                    }
                }
            });
        }
    }
    test::<Fixed>();
    test::<f32>();
    test::<f64>();
}

#[test]
fn where_nothing_differs_few_rays_go() {
    fn test<A: Make>() {
        let parts = Parts { background: A::uniform([0.5; 3]).unwrap(), ..Parts::EMPTY };
        let scene = Scene::new(parts).unwrap();
        for (sampling, expected) in [
            (Sampling::Corners, 41 * 31),
            (Sampling::ADAPTIVE, 41 * 31 + 40 * 30),
            (Sampling::Sparse { side: 2, threshold: 0 }, 21 * 16),
            (Sampling::Sparse { side: 4, threshold: 0 }, 11 * 9),
            (Sampling::Sparse { side: 16, threshold: 0 }, 4 * 3),
        ] {
            let (pixels, counts) =
                pixels::<A, Rgb888>((&scene, &A::camera(), 5), (40, 30), sampling, Tone::SRGB);
            assert_eq!(counts.primary, expected, "{sampling:?} {}", A::NAME);
            assert!(pixels.iter().all(|rgb| rgb.0 == [188; 3]), "{sampling:?}");
        }
    }
    test::<Fixed>();
    test::<f32>();
    test::<f64>();
}

/// A bright background behind a black triangle that covers (a + b)/2 of the one pixel: its edge goes
/// from (a, 0) to (b, 1).
fn coverage<A: Make>(a: f64, b: f64, samplings: &[Sampling]) -> Vec<f64> {
    // Four units in front of a camera whose half angle is 45°, x and y are mirrored.
    let point = |x: f64, y: f64| [4.0 - 8.0 * x, 4.0 - 8.0 * y, 4.0];
    // A small triangle: in fixed point its edges are as exact as it is small.
    let along = |y: f64| point(a + (b - a) * y, y);
    let body = Body::Triangle([along(-0.6), along(1.6), point(-1.5, 0.5)]);
    let shapes = Shapes::<A>::of(&[(body, 0)], -16);
    let material = [A::material(&MaterialSpec::BLACK).unwrap()];
    let background = A::uniform([1.0; 3]).unwrap();
    let scene = Scene::new(Parts { materials: &material, background, ..shapes.parts() }).unwrap();
    let camera = A::look_at([0.0; 3], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 1.0).unwrap();
    let value = |&sampling: &Sampling| {
        let (pixels, _) = picture((&scene, &camera, 1), (1, 1), sampling);
        1.0 - Into::<f64>::into(pixels[0][0])
    };
    samplings.iter().map(value).collect()
}

#[test]
fn jittered_rays_find_how_much_of_a_pixel_is_covered() {
    let seeds: Vec<_> = (0..1000).map(|seed| Sampling::Jittered { side: 8, seed }).collect();
    fn test<A: Make>(seeds: &[Sampling]) {
        for (a, b) in [(0.3, 0.8), (0.45, 0.55), (0.9, 0.25)] {
            let exact = (a + b) / 2.0;
            let found = coverage::<A>(a, b, seeds);
            let worst = found.iter().map(|x| (x - exact).abs()).fold(0.0, f64::max);
            let mean = found.iter().sum::<f64>() / found.len() as f64;
            assert!(worst < 0.08, "{} {a} {b}: {worst}", A::NAME);
            assert!((mean - exact).abs() < 0.002, "{} {a} {b}: {mean}", A::NAME);
        }
    }
    test::<Fixed>(&seeds);
    test::<f32>(&seeds);
    test::<f64>(&seeds);
}

#[test]
fn adaptive_sampling_finds_it_as_fine_cells_do() {
    let adaptive = |depth| Sampling::Adaptive { depth, threshold: 10 };
    for (depth, cells) in [(1, 2.0), (2, 4.0), (3, 8.0)] {
        for (a, b) in [(0.3, 0.8), (0.9, 0.25), (0.6, 0.4)] {
            for found in [
                coverage::<Fixed>(a, b, &[adaptive(depth)])[0],
                coverage::<f32>(a, b, &[adaptive(depth)])[0],
                coverage::<f64>(a, b, &[adaptive(depth)])[0],
            ] {
                let error = (found - (a + b) / 2.0).abs();
                assert!(error < 0.5 / cells, "{a} {b} at {depth}: {found}");
            }
        }
    }
}

/// What a screen shows that starts black, after each number of rays.
fn screens<A: Shots>(
    name: &str,
    size: (u16, u16),
    sampling: Sampling,
    budgets: impl Iterator<Item = u64>,
) -> Vec<(Vec<[u8; 3]>, u64, u8, Progress)> {
    with(view::<A>(name), size, sampling, |renderer| {
        let mut passes = Passes::new(16).unwrap();
        let width = usize::from(size.0);
        let mut screen = vec![[0; 3]; width * usize::from(size.1)];
        let mut last_pass = 16;
        let mut screens = Vec::new();
        for budget in budgets {
            let out = |counts: &Counts| counts.rays() >= budget;
            let progress = renderer.refine(&mut passes, &Output::SRGB, out, |block| {
                let Rgb888(color) = block.pixel;
                for y in block.y..block.y + block.height {
                    let start = usize::from(y) * width + usize::from(block.x);
                    screen[start..][..usize::from(block.width)].fill(color);
                }
            });
            assert!(passes.side() <= last_pass);
            last_pass = passes.side();
            let taken = renderer.tally().rays();
            screens.push((screen.clone(), taken, passes.side(), progress));
            if progress == Progress::Done {
                break;
            }
        }
        screens
    })
}

fn deadlines<A: Shots>(name: &str, size: (u16, u16)) {
    let (all, counts) = rays::<A>(name, size, Sampling::Center);
    let total = counts.rays();
    let mut best = 0.0f64;
    let made = screens::<A>(name, size, Sampling::Center, (1..=10).map(|i| total * i / 10));
    for (screen, taken, side, progress) in &made {
        let now = decibels(screen, &all);
        println!("{name} {}: {taken} of {total} rays, side {side}: {now:.1} dB", A::NAME);
        assert!(now >= best - 0.1, "{name}: {now} dB after {best}");
        best = best.max(now);
        assert_eq!(*progress == Progress::Done, *taken == total, "{taken} {total}");
    }
    let (last, taken, ..) = made.last().unwrap();
    assert!(*last == all, "the last picture is the plain one");
    assert_eq!(*taken, total, "and no ray was sent twice");
}

#[test]
fn the_screen_gets_better_until_it_shows_the_plain_picture() {
    for (name, size) in [("showcase", (160, 120)), ("limit", (120, 121)), ("every", (61, 47))] {
        deadlines::<Fixed>(name, size);
        deadlines::<f32>(name, size);
        deadlines::<f64>(name, size);
    }
}

#[test]
fn each_pass_is_better_than_the_one_before() {
    for name in ["showcase", "limit", "every", "raystones", "ftb"] {
        let size = (160, 120);
        let (all, _) = rays::<f32>(name, size, Sampling::Center);
        let ends = with(view::<f32>(name), size, Sampling::Center, |renderer| {
            let mut passes = Passes::new(16).unwrap();
            let mut screen = vec![[0; 3]; all.len()];
            let (mut ends, mut side) = (Vec::new(), 16);
            loop {
                // A block at a time.
                let mut blocks = 0;
                let mut last = |_: &Counts| {
                    blocks += 1;
                    blocks > 1
                };
                let progress = renderer.refine(&mut passes, &Output::SRGB, &mut last, |block| {
                    let Rgb888(color) = block.pixel;
                    for y in block.y..block.y + block.height {
                        let start = usize::from(y) * usize::from(size.0) + usize::from(block.x);
                        screen[start..][..usize::from(block.width)].fill(color);
                    }
                });
                if progress == Progress::Done || passes.side() != side {
                    side = passes.side();
                    ends.push(decibels(&screen, &all));
                }
                if progress == Progress::Done {
                    return ends;
                }
            }
        });
        println!("{name}: {ends:.1?} dB");
        assert_eq!(ends.len(), 5);
        assert!(ends.windows(2).all(|two| two[0] < two[1]), "{name}: {ends:?}");
    }
}

#[test]
fn a_last_pass_gives_the_picture_of_any_sampling() {
    let size = (37, 29);
    for sampling in [
        Sampling::Corners,
        Sampling::Grid { side: 2 },
        Sampling::Jittered { side: 2, seed: 5 },
        Sampling::ADAPTIVE,
        Sampling::SPARSE,
    ] {
        let (plain, _) = rays::<Fixed>("every", size, sampling);
        // In one go, and in pieces that end in the middle of a row.
        for piece in [u64::MAX, 1000, 37] {
            // Beginning anew in a row costs rays again.
            let budgets = (1..).map(|i| piece.saturating_mul(i));
            let made = screens::<Fixed>("every", size, sampling, budgets);
            let (last, _, _, progress) = made.last().unwrap();
            assert_eq!(*progress, Progress::Done, "{sampling:?} by {piece}");
            assert!(*last == plain, "{sampling:?} by {piece}");
        }
    }
}

#[test]
fn what_samplings_remember_is_stated() {
    // `docs/sampling.md` gives these figures
    assert_eq!(size_of::<Sample<Fixed>>(), 16);
    assert_eq!(size_of::<Sample<f32>>(), 16);
    assert_eq!(size_of::<Sample<f64>>(), 32);
    assert_eq!(size_of::<Passes>(), 8);
    for (sampling, bytes) in [
        (Sampling::Center, 0),
        (Sampling::Grid { side: 8 }, 0),
        (Sampling::Jittered { side: 8, seed: 0 }, 0),
        (Sampling::Corners, 3872),
        (Sampling::ADAPTIVE, 4288),
        (Sampling::Sparse { side: 2, threshold: 0 }, 7728),
        (Sampling::Sparse { side: 4, threshold: 0 }, 8464),
        (Sampling::Sparse { side: 8, threshold: 0 }, 11008),
        (Sampling::Sparse { side: 16, threshold: 0 }, 16640),
    ] {
        assert_eq!(sampling.samples(240) * size_of::<Sample<Fixed>>(), bytes, "{sampling:?}");
    }
}

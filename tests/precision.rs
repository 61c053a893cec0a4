//! Fixed point and single precision against double precision, in decibels.
//!
//! Taken on 8-bit sRGB (or on what the scene says its display values are), at one ray a pixel and
//! at 4×4: there the picture is rendered four times as large and linear radiance averaged.

mod common;

use common::scenes::{Shot, Shots};
use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::math::{Arithmetic, Fixed};
use whitted::trace::Work;

const WIDTH: usize = 96;
const HEIGHT: usize = 64;

/// A picture as 8-bit display values, from `side`×`side` rays a pixel.
fn picture<A: Shots>(shot: &Shot<A>, side: usize) -> Vec<[u8; 3]> {
    let mut sums = vec![[0.0f64; 3]; WIDTH * HEIGHT];
    let (width, height) = ((WIDTH * side) as u16, (HEIGHT * side) as u16);
    let settings = Settings { depth: shot.depth, ..Settings::new(width, height) };
    let mut work = Work::<A, 5>::new();
    let mut renderer =
        Renderer::new(shot.scene, shot.camera, settings, &mut work, &mut []).expect("settings");
    for (x, y, radiance) in renderer.scan(0..width, 0..height) {
        let sum = &mut sums[usize::from(y) / side * WIDTH + usize::from(x) / side];
        for i in 0..3 {
            sum[i] += radiance[i].into();
        }
    }
    let output = Output { tone: shot.tone, ..Output::SRGB };
    let rays = (side * side) as f64;
    let show = |sum: &[f64; 3]| output.pixel::<f64, Rgb888>(&sum.map(|x| x / rays), 0, 0).0;
    sums.iter().map(show).collect()
}

fn decibels(a: &[[u8; 3]], b: &[[u8; 3]]) -> f64 {
    let square = |a: u8, b: u8| (f64::from(a) - f64::from(b)).powi(2);
    let sum: f64 = a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| square(*a, *b)).sum();
    let mean = sum / (a.len() * 3) as f64;
    10.0 * (255.0f64 * 255.0 / mean.max(1e-9)).log10()
}

/// What is asked of fixed point at one ray a pixel and at 4×4: the project's budgets.
const BUDGET: [f64; 2] = [42.0, 50.0];

fn against_double<A: Shots>(budget: [f64; 2]) {
    let mut short = Vec::new();
    for (shot, exact) in A::SHOTS.iter().zip(f64::SHOTS) {
        for (side, least) in [(1, budget[0]), (4, budget[1])] {
            let got = decibels(&picture(shot, side), &picture(exact, side));
            let line = format!("{}, {}, {side}x{side}: {got:.1} dB", A::NAME, shot.name);
            println!("{line}");
            if got < least {
                short.push(format!("{line}, less than {least}"));
            }
        }
    }
    assert!(short.is_empty(), "{}", short.join("\n"));
}

#[test]
fn fixed() {
    against_double::<Fixed>(BUDGET);
}

#[test]
fn single() {
    against_double::<f32>(BUDGET);
}

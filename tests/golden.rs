//! Checksums of small pictures in all three arithmetics: a change that was meant to leave every
//! bit alone shows here if it doesn't.
//!
//! Where a change of bits is meant, look at the pictures first (`cargo test --test pictures
//! --test precision` say more than a checksum), then paste the table that a failure prints.

mod common;

use common::scenes::{Shot, Shots};
use whitted::frame::{Renderer, Sampling, Settings};
use whitted::math::Fixed;
use whitted::scene::Scene;
use whitted::trace::Work;

const WIDTH: u16 = 32;
const HEIGHT: u16 = 24;

/// The scene, the arithmetic, and the checksum at pixel centres and at corners.
const GOLDEN: &[(&str, &str, u64, u64)] = &[];

/// FNV-1a (Fowler, Noll, Vo), 64 bits.
fn checksum(bytes: &[u8]) -> u64 {
    let step = |sum: u64, byte: &u8| (sum ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

/// The bytes of a picture's radiances, before any tone curve could hide a change.
fn picture<A: Shots>(scene: &Scene<'_, A>, shot: &Shot<A>, sampling: Sampling) -> Vec<u8> {
    let settings = Settings { depth: shot.depth, sampling, ..Settings::new(WIDTH, HEIGHT) };
    let mut work = Work::<A, 5>::new();
    let mut samples = vec![[A::BLACK; 3]; sampling.samples(WIDTH)];
    let mut renderer =
        Renderer::new(scene, shot.camera, settings, &mut work, &mut samples).expect("settings");
    let mut bytes = Vec::new();
    for (_, _, radiance) in renderer.scan(0..WIDTH, 0..HEIGHT) {
        for channel in radiance {
            bytes.extend(Into::<f64>::into(channel).to_be_bytes());
        }
    }
    bytes
}

fn sums<A: Shots>(all: &mut Vec<(&'static str, &'static str, u64, u64)>) {
    for shot in A::SHOTS {
        let sum = |sampling| checksum(&picture(shot.scene, shot, sampling));
        all.push((shot.name, A::NAME, sum(Sampling::Center), sum(Sampling::Corners)));
    }
}

#[test]
fn checksums() {
    let mut all = Vec::new();
    sums::<Fixed>(&mut all);
    sums::<f32>(&mut all);
    sums::<f64>(&mut all);
    let row = |(scene, arithmetic, a, b): &(&str, &str, u64, u64)| {
        format!("    (\"{scene}\", \"{arithmetic}\", {a:#018x}, {b:#018x}),\n")
    };
    let table: String = all.iter().map(row).collect();
    assert!(all == GOLDEN, "the bits have changed; the table is now\n{table}");
}

/// From the authors' list of test vectors.
#[test]
fn the_checksum_itself() {
    assert_eq!(checksum(b""), 0xcbf2_9ce4_8422_2325);
    assert_eq!(checksum(b"foobar"), 0x8594_4171_f739_67e8);
}

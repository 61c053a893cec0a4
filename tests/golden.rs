//! Checksums of small pictures in all three arithmetics: a change that was meant to leave every
//! bit alone shows here if it doesn't.
//!
//! Where a change of bits is meant, look at the pictures first (`cargo test --test pictures
//! --test precision` say more than a checksum), then paste the table that a failure prints.

mod common;

use common::scenes::{Shot, Shots};
use whitted::frame::{Renderer, Sample, Sampling, Settings};
use whitted::math::Fixed;
use whitted::scene::Scene;
use whitted::trace::Work;

const WIDTH: u16 = 32;
const HEIGHT: u16 = 24;

/// The scene, the arithmetic, and the checksum at pixel centres and at corners.
const GOLDEN: &[(&str, &str, u64, u64)] = &[
    ("small", "fixed", 0x4fce19efd2cd39ad, 0x603e6aeaed7af465),
    ("every", "fixed", 0xe8689d143d9983e3, 0xdb4476d0ce9f438d),
    ("showcase", "fixed", 0xa86367c8aed19535, 0x5e77ee35d663c5ac),
    ("limit", "fixed", 0xa8d89c4948281997, 0x213900ce0f543151),
    ("raystones", "fixed", 0x20285c314190b73e, 0x76e4137e7d46cb41),
    ("ftb", "fixed", 0xfd427b588ca78024, 0x0ee23107719a8ecc),
    ("small", "f32", 0xcb201c384e17fb63, 0x18f92a8a800265ba),
    ("every", "f32", 0xb87267001d1ee781, 0x0aa68c8517927ac0),
    ("showcase", "f32", 0x8127768cb5edac28, 0xcae947a34bea6382),
    ("limit", "f32", 0x89d3f35f46483e55, 0x4aa0b93aa008ef4c),
    ("raystones", "f32", 0xc1b7a36c545283bb, 0x242bf10d14caf6d8),
    ("ftb", "f32", 0xc6b3f9038accd474, 0x10c7221d418b46b5),
    ("small", "f64", 0x5b23a8a9cfd36c3a, 0xb6636982385be38f),
    ("every", "f64", 0xd20eeaf66afe4a4b, 0x0b9caef71bd733ce),
    ("showcase", "f64", 0x445a85f65e5688df, 0x45c8e36c0eb8643c),
    ("limit", "f64", 0xed2e1835910c7e64, 0x9b675832455db96a),
    ("raystones", "f64", 0x5c255e4b72ad350f, 0x3bb6df6e56ccb698),
    ("ftb", "f64", 0xfaff0f4057839c30, 0x65ffae8f6e35955a),
];

/// FNV-1a (Fowler, Noll, Vo), 64 bits.
fn checksum(bytes: &[u8]) -> u64 {
    let step = |sum: u64, byte: &u8| (sum ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

/// The bytes of a picture's radiances, before any tone curve could hide a change.
fn picture<A: Shots>(scene: &Scene<'_, A>, shot: &Shot<A>, sampling: Sampling) -> Vec<u8> {
    let settings = Settings { depth: shot.depth, sampling, ..Settings::new(WIDTH, HEIGHT) };
    let mut work = Work::<A, 5>::new();
    let mut samples = vec![Sample::NONE; sampling.samples(WIDTH)];
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

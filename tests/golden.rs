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
    ("small", "fixed", 0x87233e7eaba0c58d, 0xad171bc8cc6a478f),
    ("every", "fixed", 0xcbb062c2ee65c75a, 0xe9dbca5534723bf0),
    ("showcase", "fixed", 0xf7437cb3aab6c88d, 0x320de10bed89b892),
    ("limit", "fixed", 0x37298db241a4134d, 0xccfc626635480048),
    ("raystones", "fixed", 0x580518f9d1f31a54, 0xc9c384d82961bde1),
    ("ftb", "fixed", 0x676d7657d1e32235, 0xd5aff312b983bc42),
    ("small", "f32", 0xbfc9908b885c8571, 0xf2e537fc03c3e468),
    ("every", "f32", 0xc506b1b2044b6952, 0x6c28da969a56ca51),
    ("showcase", "f32", 0x6bd0459fef770ba3, 0xdb1ac946ef3ec70d),
    ("limit", "f32", 0x83718cac28ad0de2, 0x9d2067fa2ceed196),
    ("raystones", "f32", 0x59ae63b8e08227c6, 0x449124111cf0c33c),
    ("ftb", "f32", 0x3716eccb45b99ad4, 0xe6cd351936f4968b),
    ("small", "f64", 0xf44ff5661c26203d, 0x161b2cc70eb0ffc4),
    ("every", "f64", 0xa2e242d45f4bc4b8, 0xc3858b3d92ab3249),
    ("showcase", "f64", 0xb5798f563c757641, 0x73799263cc38ee27),
    ("limit", "f64", 0x43450eb477b8ae0d, 0x69f2fdeb04b97f43),
    ("raystones", "f64", 0x6b894d0e2a38fc86, 0x6fa3fa3c8ed83341),
    ("ftb", "f64", 0xad112dde8e1a2272, 0x4a1dcfc7105c7437),
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

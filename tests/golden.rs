//! Checksums of small pictures in all three arithmetics: a change that was meant to leave every
//! bit alone shows here if it doesn't.
//!
//! Where a change of bits is meant, look at the pictures first (`cargo test --test all --
//! pictures:: precision::` say more than a checksum), then paste the table that a failure prints.

use crate::common::scenes::{Shot, Shots};
use whitted::frame::{Renderer, Sample, Sampling, Settings};
use whitted::math::Fixed;
use whitted::scene::Scene;
use whitted::trace::Work;

const WIDTH: u16 = 32;
const HEIGHT: u16 = 24;

/// The scene, the arithmetic, and the checksum at pixel centres and at corners.
const GOLDEN: &[(&str, &str, u64, u64)] = &[
    ("small", "fixed", 0xe79301761d90786c, 0x77947439003a6447),
    ("every", "fixed", 0x534a2ba6d1cbbe56, 0x7c590b4235f848f2),
    ("showcase", "fixed", 0x34e50cc2459835e9, 0xab53dc1c360782eb),
    ("limit", "fixed", 0x3402e60bd089dda2, 0x9bf05ce3a7c4e3e0),
    ("raystones", "fixed", 0xdd4bdf67ce49c7e5, 0x385fd943e49fd961),
    ("ftb", "fixed", 0xb3de1a07a58dd606, 0x3b9c927ee3b9ee64),
    ("small", "f32", 0x280ab5ca23d8169c, 0x52ef7156c82ac754),
    ("every", "f32", 0x1ce8b6e27cd2f018, 0xe245b2a7aebc2947),
    ("showcase", "f32", 0x3102de3fb90851fb, 0x9ae516d58c5aacc9),
    ("limit", "f32", 0x953aeddb16aa25b5, 0x088c77e4eeabb4dc),
    ("raystones", "f32", 0x3df7093b0e2fa7a4, 0xa2bdd12deb294cd8),
    ("ftb", "f32", 0x3716eccb45b99ad4, 0xe6cd351936f4968b),
    ("small", "f64", 0x11d721fb77fb280c, 0xe5652f72b851dcfc),
    ("every", "f64", 0xe907200a51af60cb, 0x0812a65ffeec0715),
    ("showcase", "f64", 0x93dc73b6d2d94905, 0xc49152b75689fe78),
    ("limit", "f64", 0x500a03a31a7bf5ee, 0x81d23d1fd23e4862),
    ("raystones", "f64", 0x6f1302cb598e8553, 0x47b3c7de86d5c34e),
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

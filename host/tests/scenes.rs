//! Every scene in `host/scenes`: it is right, every arithmetic holds it, and it shows something.

mod common;

use std::path::{Path, PathBuf};

use common::{decibels, errors, files, pixels, said, whitted};

const SIZE: &str = "80x60";

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

/// The scenes themselves; what they include lies in directories.
fn names() -> Vec<String> {
    files(&scenes()).into_iter().filter(|name| name.ends_with(".toml")).collect()
}

/// The picture of a scene, all channels in a row.
fn render(name: &str, arguments: &[&str]) -> Vec<u8> {
    let place = tempfile::tempdir().expect("a directory");
    let out = place.path().join("picture.png");
    let path = out.to_str().expect("a plain name");
    let all = [&["render", name, "-q", "--size", SIZE, "-o", path], arguments].concat();
    let output = whitted(&scenes(), &all);
    assert!(output.status.success(), "{name}: {}", errors(&output));
    pixels(&out)
}

#[test]
fn each_shows_something() {
    for name in names() {
        let picture = render(&name, &[]);
        let mean = picture.iter().map(|&v| f64::from(v)).sum::<f64>() / picture.len() as f64;
        assert!((30.0..225.0).contains(&mean), "{name}: the mean is {mean}");
        let mut colors: Vec<&[u8]> = picture.chunks(3).collect();
        colors.sort_unstable();
        colors.dedup();
        assert!(colors.len() > 100, "{name} has {} colours", colors.len());
    }
}

#[test]
fn chips_show_the_same() {
    for name in names() {
        let reference = render(&name, &["--sampling", "grid:2"]);
        let text = std::fs::read_to_string(scenes().join(&name)).expect("it is there");
        // In fixed point an endless plane ends where the range does, a row or so below the
        // horizon; the showcase loses most by it.
        let fixed = if text.contains("[[plane]]") { 26.0 } else { 36.0 };
        for (arith, least) in [("f32", 45.0), ("fixed", fixed)] {
            let picture = render(&name, &["--sampling", "grid:2", "--arith", arith]);
            let db = decibels(&reference, &picture);
            println!("{name} {arith}: {db:.1} dB");
            assert!(db > least, "{name}: {arith} is {db:.1} dB from f64");
        }
    }
}

/// The number of rays that the command says it sent.
fn rays(name: &str) -> f64 {
    let place = tempfile::tempdir().expect("a directory");
    let out = place.path().join("picture.png");
    let arguments = ["render", name, "-o", out.to_str().expect("a plain name")];
    let output = whitted(&scenes(), &arguments);
    let text = said(&output) + &errors(&output);
    let line = text.lines().find_map(|line| line.split_once(" rays: "));
    line.unwrap_or_else(|| panic!("{name}: {text}")).0.parse().expect("a number")
}

#[test]
fn a_light_with_an_area_takes_ten_times_the_rays() {
    // In the course's slides it is 1,688,849 against 152,105 rays: 11.1 times.
    let times = rays("room-area.toml") / rays("room-point.toml");
    assert!((8.0..14.0).contains(&times), "{times:.2} times");
}

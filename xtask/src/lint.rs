//! Formatting, lints, documentation, and the tests that run on the host.

use std::path::Path;

use crate::machine::MACHINES;
use crate::report::Report;
use crate::shell::{self, boards, cargo, root};

/// Nothing may warn.
const STRICT: [&str; 3] = ["--", "-D", "warnings"];

/// The Pico's displays, and its log.
const PICO: [&str; 5] = [
    "st7789-240x240,rtt",
    "st7789-240x240",
    "st7789-240x320,rtt",
    "st7735s-160x80,rtt",
    "ili9341-320x240,rtt",
];

/// Formatting, clippy and rustdoc, on the host and for every chip.
pub(crate) fn check(report: &mut Report) {
    let mut step = |name: &str, dir: &Path, words: &str, strict: bool| {
        let args = words.split(' ').chain(STRICT.into_iter().take(if strict { 3 } else { 0 }));
        report.check(name, || shell::run(cargo(dir, args).env("RUSTDOCFLAGS", "-D warnings")));
    };
    let (root, boards) = (root(), boards());
    step("format", &root, "fmt --all --check", false);
    step("format, boards", &boards, "fmt --all --check", false);
    step("clippy, host", &root, "clippy -q --workspace --all-targets", true);
    for target in ["thumbv6m-none-eabi", "thumbv7em-none-eabihf"] {
        let words = format!("clippy -q --package whitted --target {target}");
        step(&format!("clippy, library, {target}"), &root, &words, true);
    }
    step("clippy, demo", &boards, "clippy -q --package whitted-demo --all-targets", true);
    let mut seen = Vec::new();
    for machine in &MACHINES {
        if seen.contains(&(machine.board, machine.target)) {
            continue;
        }
        seen.push((machine.board, machine.target));
        let name = format!("clippy, {}, {}", machine.board, machine.target);
        let words = format!("clippy -q --target {}", machine.target);
        // In the board's directory: its own settings hold only there.
        step(&name, &boards.join(machine.board), &words, true);
    }
    for features in PICO {
        let name = format!("clippy, pico, {features}");
        let words = format!("clippy -q --no-default-features --features {features}");
        step(&name, &boards.join("pico"), &words, true);
    }
    for chip in ["f411", "f405"] {
        let words = format!("clippy -q --no-default-features --features {chip}");
        step(&format!("clippy, stm32f4, {chip}"), &boards.join("stm32f4"), &words, true);
    }
    let bands = "clippy -q --package whitted-bands --all-targets";
    step("clippy, bands", &boards, bands, true);
    for board in ["pico-async", "microbit-v2"] {
        step(&format!("clippy, {board}"), &boards.join(board), "clippy -q", true);
    }
    step("clippy, room", &boards.join("room"), "clippy -q", true);
    // A workspace of its own.
    let pico2 = boards.join("pico2");
    step("format, pico2", &pico2, "fmt --all --check", false);
    for (target, features) in [
        ("thumbv8m.main-none-eabihf", "rtt,st7789-240x240"),
        ("thumbv8m.main-none-eabihf", "one-core,fixed,st7735s-160x80"),
        ("riscv32imac-unknown-none-elf", "rtt,st7789-240x240"),
    ] {
        let words = format!(
            "clippy -q --locked --target-dir ../target --target {target} --no-default-features \
             --features {features}"
        );
        step(&format!("clippy, pico2, {target}, {features}"), &pico2, &words, true);
    }
    // What people copy: its own workspace, and its own lock file, which must hold. It shares what
    // the boards have built.
    let template = root.join("template");
    step("format, template", &template, "fmt --all --check", false);
    step("clippy, template", &template, "clippy -q --locked --target-dir ../boards/target", true);
    step("template: it links", &template, "build -q --locked --target-dir ../boards/target", false);
    for name in ["nopanic", "size"] {
        let words = format!("clippy -q --package {name} --target thumbv6m-none-eabi");
        step(&format!("clippy, {name}"), &boards, &words, true);
    }
    step("documentation", &root, "doc -q --workspace --no-deps", false);
    step("documentation, demo", &boards, "doc -q --package whitted-demo --no-deps", false);
}

/// The tests of the host's workspace, and of the part of the firmware that runs anywhere.
pub(crate) fn host_tests(report: &mut Report) {
    tests(report, "host tests", &root(), &["test", "--workspace", "--no-fail-fast"]);
    tests(report, "tests of demo", &boards(), &["test", "--package", "whitted-demo"]);
    tests(report, "tests of bands", &boards(), &["test", "--package", "whitted-bands"]);
}

fn tests(report: &mut Report, name: &str, dir: &Path, args: &[&str]) {
    println!("     {name} …");
    let output = match cargo(dir, args).stderr(std::process::Stdio::inherit()).output() {
        Ok(output) => output,
        Err(error) => return report.add(&format!("{name}: {error}"), 0, 1),
    };
    let text = String::from_utf8_lossy(&output.stdout);
    let (passed, failed) =
        text.lines().filter_map(counts).fold((0, 0), |sum, n| (sum.0 + n.0, sum.1 + n.1));
    if !output.status.success() {
        println!("{text}");
    }
    let ok = output.status.success() && failed == 0;
    println!("{} {name}: {passed} passed, {failed} failed", if ok { "ok  " } else { "FAIL" });
    // A test program that doesn't build, or dies, counts as one.
    report.add(name, passed, if ok { 0 } else { failed.max(1) });
}

/// The numbers in `test result: ok. 5 passed; 0 failed; …`.
fn counts(line: &str) -> Option<(u64, u64)> {
    let (_, numbers) = line.strip_prefix("test result: ")?.split_once(". ")?;
    let mut parts = numbers.split("; ");
    let mut next = |word| parts.next()?.strip_suffix(word)?.trim().parse().ok();
    Some((next("passed")?, next("failed")?))
}

#[cfg(test)]
mod tests {
    use super::counts;

    #[test]
    fn result_lines() {
        let line = "test result: FAILED. 12 passed; 3 failed; 0 ignored; 0 measured; 0 filtered";
        assert_eq!(counts(line), Some((12, 3)));
        assert_eq!(counts("running 3 tests"), None);
    }
}

//! Formatting, lints, documentation, and the tests that run on the host.

use std::path::Path;

use crate::machine::{self, MACHINES};
use crate::report::Report;
use crate::shell::{self, cargo};

/// The Pico's displays, and its log.
const PICO: [&str; 6] = [
    "st7789-240x240,rtt,ram",
    "st7789-240x240",
    "st7789-240x320,rtt,ram",
    "st7735s-160x80,rtt,ram",
    "ili9341-320x240,rtt,ram",
    "st7789-240x240,rtt,ram,one-core,sparse",
];

/// Images that no emulator runs, with how they are built: whether they fit is to be seen.
const UNSEEN: [(&str, &str); 5] = [
    ("microbit-v2", ""),
    ("stm32f4", ""),
    ("pico", " --no-default-features --features st7789-240x320,rtt,ram"),
    ("pico", " --no-default-features --features ili9341-320x240,rtt,ram"),
    ("pico2", ""),
];

/// Runs cargo as a check.
fn step(report: &mut Report, name: &str, dir: &Path, words: &str) {
    // Nothing may warn.
    let strict: &[&str] = if words.starts_with("clippy") { &["--", "-D", "warnings"] } else { &[] };
    let args = words.split(' ').chain(strict.iter().copied());
    report.check(name, || shell::run(cargo(dir, args).env("RUSTDOCFLAGS", "-D warnings")));
}

/// Formatting, clippy and rustdoc of the library, on the host and for chips, and of what is built
/// for the host.
pub(crate) fn root(report: &mut Report) {
    let root = shell::root();
    step(report, "format", &root, "fmt --all --check");
    step(report, "clippy, host", &root, "clippy -q --workspace --all-targets");
    for target in ["thumbv6m-none-eabi", "thumbv7em-none-eabihf"] {
        let words = format!("clippy -q --package whitted --target {target}");
        step(report, &format!("clippy, library, {target}"), &root, &words);
    }
    step(report, "documentation", &root, "doc -q --workspace --no-deps");
}

/// Formatting, clippy and rustdoc of firmware, for every chip.
pub(crate) fn boards(report: &mut Report) {
    let boards = shell::boards();
    let clippy = |report: &mut Report, name: &str, dir: &Path, words: &str| {
        let words = format!("clippy -q {words}");
        step(report, &format!("clippy, {name}"), dir, words.trim_end());
    };
    step(report, "format, boards", &boards, "fmt --all --check");
    clippy(report, "demo", &boards, "--package whitted-demo --all-targets");
    let mut seen = Vec::new();
    for machine in &MACHINES {
        // What differs from chip to chip is the library's, which is linted for both kinds above.
        if seen.contains(&machine.board) {
            continue;
        }
        seen.push(machine.board);
        // In the board's directory: its own settings hold only there.
        let words = format!("--target {}", machine.target);
        clippy(report, machine.board, &boards.join(machine.board), &words);
    }
    for features in PICO {
        let words = format!("--no-default-features --features {features}");
        clippy(report, &format!("pico, {features}"), &boards.join("pico"), &words);
    }
    for chip in ["f411", "f405"] {
        let words = format!("--no-default-features --features {chip}");
        clippy(report, &format!("stm32f4, {chip}"), &boards.join("stm32f4"), &words);
    }
    clippy(report, "bands", &boards, "--package whitted-bands --all-targets");
    for board in ["pico-async", "microbit-v2", "room"] {
        clippy(report, board, &boards.join(board), "");
    }
    // What no emulator runs.
    for (board, words) in UNSEEN {
        let name =
            format!("{board}{}: it links", words.replace(" --no-default-features --features", ","));
        let _building = machine::building();
        step(
            report,
            &name,
            &boards.join(board),
            &format!("build -q --release --bin {board}{words}"),
        );
    }
    // A workspace of its own.
    let pico2 = boards.join("pico2");
    step(report, "format, pico2", &pico2, "fmt --all --check");
    for (target, features) in [
        ("thumbv8m.main-none-eabihf", "rtt,ram,st7789-240x240"),
        ("thumbv8m.main-none-eabihf", "one-core,fixed,st7735s-160x80"),
        ("riscv32imac-unknown-none-elf", "rtt,ram,st7789-240x240"),
    ] {
        let words = format!(
            "--locked --target-dir ../target --target {target} --no-default-features \
             --features {features}"
        );
        clippy(report, &format!("pico2, {target}, {features}"), &pico2, &words);
    }
    // What people copy: its own workspace, and its own lock file, which must hold. It shares what
    // the boards have built.
    let template = shell::root().join("template");
    step(report, "format, template", &template, "fmt --all --check");
    let words = "--locked --target-dir ../boards/target";
    clippy(report, "template", &template, words);
    step(report, "template: it links", &template, &format!("build -q {words}"));
    for name in ["nopanic", "size"] {
        clippy(report, name, &boards, &format!("--package {name} --target thumbv6m-none-eabi"));
    }
    step(report, "documentation, demo", &boards, "doc -q --package whitted-demo --no-deps");
}

/// The tests of the host's workspace.
pub(crate) fn host_tests(report: &mut Report) {
    tests(report, "host tests", &shell::root(), &["test", "--workspace", "--no-fail-fast"]);
}

/// The tests of those parts of the firmware that run anywhere.
pub(crate) fn boards_tests(report: &mut Report) {
    let boards = shell::boards();
    tests(report, "tests of demo", &boards, &["test", "--package", "whitted-demo"]);
    tests(report, "tests of bands", &boards, &["test", "--package", "whitted-bands"]);
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

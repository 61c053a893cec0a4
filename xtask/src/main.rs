//! What this repository needs done to it: `cargo xtask setup`, `test`, `bench`, `emulate` and
//! comparisons.

mod bench;
mod compare;
mod cores;
mod elf;
mod firmware;
mod lint;
mod machine;
mod nopanic;
mod oled;
mod pico;
mod pico2;
mod picture;
mod pov;
mod report;
mod setup;
mod shell;
mod stack;
mod stages;
mod stm32;

use std::process::ExitCode;

use report::Report;

const USAGE: &str = "\
cargo xtask setup                          install what the rest needs
cargo xtask test [--only GROUP]…           set up and run every check, or those of a group:
                                           lint, host, nopanic, boards, pico
cargo xtask bench [--check] [--machine M]  count on the emulated boards and write bench/table.md;
                                           --check compares with it instead
cargo xtask bench --stages [SCENE|JOB]… [--machine M] [--flame FILE.svg] [--folded FILE]
                                           what each stage of a frame costs; --flame draws the
                                           calls, --folded writes them as text
cargo xtask emulate pico [OPTION]…         run the Pico's image and save what its display shows;
                                           --help names the options
cargo xtask picture JOB|room [-o FILE.png] [--rgb565]
                                           what a board has to draw, as the host draws it
cargo xtask emulate pico2 [OPTION]…        have a core of the Pico 2's trace a frame
cargo xtask stack                          the stack of a frame at each depth, on every emulated
                                           board, as the table of docs/memory.md
cargo xtask nopanic                        the no-panic proof alone, naming culprits
cargo xtask pov SCENE [-o FILE] [--size WxH]
                                           write a scene in POV-Ray's language
cargo xtask compare A.png B.png [-o FILE]  how far two pictures are apart; FILE shows where,
                                           eight times enlarged";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let done = match args.as_slice() {
        ["setup"] => setup::run().and_then(|()| setup::python().map(drop)),
        ["test", options @ ..] => groups(options).and_then(|groups| test(&groups)),
        ["bench", "--stages", options @ ..] => {
            stages::Options::read(options).and_then(|o| stages::run(&o))
        }
        ["bench", options @ ..] => bench::Options::read(options).and_then(|o| bench::run(&o)),
        ["emulate", "pico", options @ ..] => pico::run(options),
        ["emulate", "pico2", options @ ..] => pico2::run(options),
        ["picture", words @ ..] => picture::run(words),
        ["stack"] => stack::run(),
        ["nopanic"] => setup::run().and_then(|()| summary(nopanic::check)),
        ["pov", words @ ..] => pov::run(words),
        ["compare", words @ ..] => compare::run(words),
        _ => Err(USAGE.into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Checks that belong together.
type Group = fn(&mut Report);

/// The groups, in the order they run.
const GROUPS: [(&str, Group); 6] = [
    ("lint", lint::check),
    ("host", lint::host_tests),
    ("nopanic", nopanic::check),
    ("boards", firmware::check),
    ("pico", pico::check),
    ("pico2", pico2::check),
];

/// The groups that `--only` names, or all.
fn groups(options: &[&str]) -> Result<Vec<Group>, String> {
    if options.is_empty() {
        return Ok(GROUPS.iter().map(|group| group.1).collect());
    }
    let (pairs, rest) = options.as_chunks::<2>();
    if !rest.is_empty() || pairs.iter().any(|[option, _]| *option != "--only") {
        return Err(USAGE.into());
    }
    let find = |name: &str| GROUPS.iter().find(|group| group.0 == name).map(|group| group.1);
    pairs
        .iter()
        .map(|[_, name]| find(name).ok_or_else(|| format!("no group `{name}`\n{USAGE}")))
        .collect()
}

fn test(groups: &[Group]) -> Result<(), String> {
    setup::run()?;
    summary(|report| groups.iter().for_each(|group| group(report)))
}

/// Runs checks and ends with the line of their numbers.
fn summary(checks: impl FnOnce(&mut Report)) -> Result<(), String> {
    let mut report = Report::default();
    checks(&mut report);
    report.finish()
}

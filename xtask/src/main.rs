//! What this repository needs done to it: `cargo xtask setup`, `test`, `bench`, `emulate` and
//! comparisons.

mod bench;
mod blob;
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
mod template;

use std::process::ExitCode;

use report::Report;

const USAGE: &str = "\
cargo xtask setup                          install what the rest needs
cargo xtask test [--only GROUP]…           set up and run every check, or those of a group:
                                           lint, template, host, nopanic, boards, pico, flash,
                                           pico2
cargo xtask bench [--check] [--machine M] [--images]
                                           count on the emulated boards and write bench/table.md;
                                           --check compares with it instead; --images renews
                                           how large programs are and leaves the rest
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
        ["test", options @ ..] => chosen(options).and_then(|names| test(&names)),
        ["bench", "--stages", options @ ..] => {
            stages::Options::read(options).and_then(|o| stages::run(&o))
        }
        ["bench", options @ ..] => bench::Options::read(options).and_then(|o| bench::run(&o)),
        ["emulate", "pico", options @ ..] => pico::run(options),
        ["emulate", "pico2", options @ ..] => pico2::run(options),
        ["picture", words @ ..] => picture::run(words),
        ["stack"] => stack::run(),
        ["nopanic"] => test(&["nopanic"]),
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
struct Group {
    name: &'static str,
    check: fn(&mut Report),
}

/// What is built in the root's workspace; then the boards of which little has to be built, and much to be
/// emulated.
const HOST: [Group; 5] = [
    Group { name: "lint", check: lint::root },
    Group { name: "host", check: lint::host_tests },
    Group { name: "pico", check: pico::check },
    Group { name: "flash", check: blob::check },
    Group { name: "pico2", check: pico2::check },
];

/// What is built in the boards' workspace. A group may have a part in either.
const BOARDS: [Group; 5] = [
    Group { name: "lint", check: lint::boards },
    Group { name: "template", check: template::check },
    Group { name: "host", check: lint::boards_tests },
    Group { name: "nopanic", check: nopanic::check },
    Group { name: "boards", check: firmware::check },
];

/// The names that `--only` gives; none for all groups.
fn chosen<'a>(options: &[&'a str]) -> Result<Vec<&'a str>, String> {
    let (pairs, rest) = options.as_chunks::<2>();
    if !rest.is_empty() || pairs.iter().any(|[option, _]| *option != "--only") {
        return Err(USAGE.into());
    }
    let known = |name: &str| HOST.iter().chain(&BOARDS).any(|group| group.name == name);
    match pairs.iter().find(|[_, name]| !known(name)) {
        Some([_, name]) => Err(format!("no group `{name}`\n{USAGE}")),
        None => Ok(pairs.iter().map(|[_, name]| *name).collect()),
    }
}

fn test(names: &[&str]) -> Result<(), String> {
    setup::run()?;
    let wanted = |group: &&Group| names.is_empty() || names.contains(&group.name);
    let run = |groups: &[Group]| {
        let mut report = Report::default();
        groups.iter().filter(wanted).for_each(|group| (group.check)(&mut report));
        report
    };
    // Firmware is linked by one thread for minutes, and an emulator is one: the other core has work meanwhile.
    let (boards, host) = std::thread::scope(|scope| {
        let boards = scope.spawn(|| run(&BOARDS));
        let host = run(&HOST);
        (boards.join(), host)
    });
    let mut report = host;
    report.merge(boards.map_err(|_| "the boards' checks panicked")?);
    report.finish()
}

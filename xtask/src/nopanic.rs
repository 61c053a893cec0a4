//! The proof that the library can't panic, by the linker: see `boards/nopanic`.

use std::path::Path;

use crate::elf;
use crate::report::Report;
use crate::shell::{boards, cargo, show};

const TARGET: &str = "thumbv6m-none-eabi";
/// What the panic handler calls, and nobody defines.
const MISSING: &str = "undefined symbol: THE_LIBRARY_CAN_PANIC";

/// The probe links, and its control doesn't.
pub(crate) fn check(report: &mut Report) {
    report.check("nopanic: the probe links", || match link("probe", &[])? {
        Linked::Yes => Ok(()),
        Linked::CanPanic => Err(culprits()),
    });
    report.check("nopanic: the control doesn't", || match link("control", &[])? {
        Linked::Yes => {
            Err("a program that panics has been linked: the probe proves nothing".into())
        }
        Linked::CanPanic => Ok(()),
    });
}

enum Linked {
    Yes,
    CanPanic,
}

/// Links a program, which fails for the one reason or is an error.
fn link(bin: &str, extra: &[&str]) -> Result<Linked, String> {
    let mut command = cargo(
        &boards(),
        ["rustc", "--quiet", "--release", "--package", "nopanic", "--target", TARGET, "--bin", bin],
    );
    command.arg("--").args(extra);
    let output = command.output().map_err(|error| format!("{}: {error}", show(&command)))?;
    let message = String::from_utf8_lossy(&output.stderr);
    if output.status.success() {
        Ok(Linked::Yes)
    } else if message.contains(MISSING) {
        Ok(Linked::CanPanic)
    } else {
        Err(format!("{} failed for another reason:\n{message}", show(&command)))
    }
}

/// Links the probe all the same, and says where it could panic.
fn culprits() -> String {
    // One program tells the calls by its relocations, the other, of the same layout, the source
    // lines: relocations that were applied confuse readers of debug information.
    let place =
        |name| std::env::temp_dir().join(format!("whitted-nopanic-{}-{name}", std::process::id()));
    let (calls, lines) = (place("calls"), place("lines"));
    let link_to = |program: &Path, option: &str| {
        let output = format!("link-arg=-o{}", program.display());
        let missing = "link-arg=--defsym=THE_LIBRARY_CAN_PANIC=0";
        link("probe", &["-C", missing, "-C", option, "-C", &output])
    };
    let found = link_to(&calls, "link-arg=--emit-relocs")
        .and_then(|_| link_to(&lines, "link-arg=--gc-sections"))
        .and_then(|_| elf::panics(&calls, &lines));
    for program in [calls, lines] {
        // Whether or not it was written.
        let _ = std::fs::remove_file(program);
    }
    let by_hand = "link with `-C link-arg=--defsym=THE_LIBRARY_CAN_PANIC=0`, disassemble, and \
                   look for calls of functions named panic or fail";
    match found {
        Ok(found) if found.is_empty() => {
            format!("a panic is reachable, by a way not found: {by_hand}")
        }
        Ok(found) => format!("panics are reachable:\n       {}", found.join("\n       ")),
        Err(error) => format!("a panic is reachable ({error}): {by_hand}"),
    }
}

//! The stack of frames on the emulated boards: at most what `docs/memory.md` says, for every depth
//! that there may be memory for.

use std::time::Duration;

use whitted::frame::Sampling;
use whitted_demo::depths::{self, DEEPEST, ROW, Words};
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::job::{ArithName, Job, MAX_SAMPLES, MAX_WIDTH};

use crate::firmware::result;
use crate::machine::{self, Log, MACHINES, Machine, Record};
use crate::report::Report;
use crate::shell::boards;
use crate::{pico, pico2, setup, stm32};

/// A small frame for each depth takes less than a second.
const PATIENCE: Duration = Duration::from_secs(120);

/// Bytes of `Work` without and for each generation of rays, in either arithmetic.
const WORK: [u64; 2] = [1_352, 48];
/// Bytes of a sample that a sampling remembers, and of a pixel in a row.
const SAMPLE: u64 = 16;
const PIXEL: u64 = 3;

/// Bytes of stack that each generation takes at most: twice what `Work` grows by, since a compiler
/// may make it in one place and move it to another.
const GENERATION: u64 = 96;

/// Bytes of stack that a firmware with a display takes at most beside its frames.
const BOARD: u64 = 1_024;

/// Bytes of stack that a frame takes at most beside generations, row and samples: what doesn't
/// depend on the depth of the tracer's memory, its calls, and the renderer.
const fn calls(arith: ArithName) -> u64 {
    match arith {
        ArithName::Fixed => 2_944,
        ArithName::F32 => 2_304,
    }
}

/// The bound on a frame's stack.
fn bound(arith: ArithName, depth: usize, row: u64, samples: usize) -> u64 {
    calls(arith) + GENERATION * depth as u64 + row + SAMPLE * samples as u64
}

/// A line of the table: a core's image at every depth.
struct Row {
    core: &'static str,
    arith: ArithName,
    stacks: Vec<u64>,
}

/// Each depth's frame, on all machines of QEMU but one, which has another board's code.
pub(crate) fn check(report: &mut Report) {
    for machine in MACHINES.iter().filter(|machine| !machine.only_counts()) {
        check_log(report, machine.core, machine.float, || said(machine));
    }
}

/// Each depth's frame on a board of which `run` has the log.
pub(crate) fn check_log(
    report: &mut Report,
    core: &'static str,
    float: bool,
    run: impl FnOnce() -> Result<Log, String>,
) {
    report.check(&format!("{core}: stack at depths 1 to {DEEPEST}"), || {
        for row in rows(core, float, &run()?)? {
            println!("     {}: {:?}", row.arith.name(), row.stacks);
        }
        Ok(())
    });
}

/// The command: every board, as the table of `docs/memory.md`.
pub(crate) fn run() -> Result<(), String> {
    setup::run()?;
    let heads: String = (1..=DEEPEST).map(|depth| format!(" {depth} |")).collect();
    println!("| core | arithmetic |{heads}\n|---|---|{}", "--:|".repeat(DEEPEST));
    let print = |core, float, log: Log| {
        for Row { core, arith, stacks } in rows(core, float, &log)? {
            let cells: String = stacks.iter().map(|bytes| format!(" {bytes} |")).collect();
            println!("| {core} | {} |{cells}", arith.name());
        }
        Ok::<_, String>(())
    };
    for machine in &MACHINES {
        print(machine.core, machine.float, said(machine)?)?;
    }
    print(stm32::CORE, true, stm32::depths()?)?;
    for (core, board) in pico::BOARDS {
        print(core, false, pico::depths(board)?)?;
    }
    for (core, target) in pico2::DEPTHS {
        print(core, false, pico2::depths(target)?)?;
    }
    Ok(())
}

/// What a machine's image says of each depth.
fn said(machine: &Machine) -> Result<Log, String> {
    let image = machine::build(&boards().join(machine.board), "depths", machine.target)?;
    machine.run::<&str>(&image, &[], &image.with_extension("ppm"), PATIENCE)
}

/// What a board has left in its memory, at `place`, in the words of those that speak; nothing as long as the
/// last line is missing.
pub(crate) fn left(place: u32, peek: impl Fn(u32) -> u32) -> Option<Log> {
    let size = size_of::<Words>() as u32;
    let line = |i: usize| -> Words {
        std::array::from_fn(|word| peek(place + i as u32 * size + 4 * word as u32))
    };
    (line(DEEPEST - 1)[0] != 0).then(|| {
        let lines: Vec<String> = (0..DEEPEST)
            .map(|i| {
                let [depth, memory, stack, low, high] = line(i);
                let arith = ArithName::Fixed.name();
                format!(
                    "depth arith={arith} depth={depth} checksum={high:08x}{low:08x} \
                     memory={memory} stack={stack}"
                )
            })
            .collect();
        Log::new(&lines.join("\n"))
    })
}

/// Compares pictures, memory and stack with what is to be.
fn rows(core: &'static str, float: bool, log: &Log) -> Result<Vec<Row>, String> {
    let mut rows = Vec::new();
    for arith in ArithName::ALL {
        let stacks = log
            .records("depth")
            .filter(|record| record.get("arith") == Ok(arith.name()))
            .zip(depths::all(arith))
            .map(|(record, here)| one(record, arith, &here))
            .collect::<Result<Vec<_>, _>>()?;
        match (stacks.len(), arith) {
            (DEEPEST, _) => rows.push(Row { core, arith, stacks }),
            // Software floating point is left out.
            (0, ArithName::F32) if !float => {}
            (n, _) => return Err(format!("{n} depths in {}", arith.name())),
        }
    }
    Ok(rows)
}

/// The stack at a depth, if all is as it should be.
fn one(record: Record<'_>, arith: ArithName, here: &depths::Depth) -> Result<u64, String> {
    let (depth, memory) = (record.number("depth")?, record.number("memory")?);
    let sum = format!("{:016x}", (here.draw)().value());
    if depth != here.depth as u64 || record.get("checksum")? != sum {
        return Err(format!("{record:?}, on the host depth {} has {sum}", here.depth));
    }
    if memory != WORK[0] + WORK[1] * depth {
        return Err(format!("{memory} bytes of Work at depth {depth}"));
    }
    let stack = record.number("stack")?;
    within(stack, bound(arith, here.depth, ROW as u64, 0))
        .map_err(|e| format!("depth {depth}: {e}"))
}

fn within(stack: u64, bound: u64) -> Result<u64, String> {
    if stack > 0 && stack <= bound {
        Ok(stack)
    } else {
        Err(format!("{stack} bytes of stack; at most {bound} are documented"))
    }
}

/// A frame into bands that lie elsewhere than on the stack, with memory for [`MAX_DEPTH`] generations, is within
/// the bound.
pub(crate) fn banded(arith: ArithName, stack: u64) -> Result<(), String> {
    within(stack, bound(arith, MAX_DEPTH, 0, 0)).map(drop)
}

/// So is a firmware's whole stack, from reset to the end of such a frame, with what pins, clocks, the display's driver
/// and sending take beside.
pub(crate) fn firmware(arith: ArithName, stack: u64, samples: usize) -> Result<(), String> {
    within(stack, bound(arith, MAX_DEPTH, 0, samples) + BOARD).map(drop)
}

/// The frames of a log are within the bound.
pub(crate) fn frames(log: &Log, jobs: &[Job]) -> Result<(), String> {
    let row = PIXEL * u64::from(MAX_WIDTH);
    for job in jobs {
        let samples = if job.sampling == Sampling::Center { 0 } else { MAX_SAMPLES };
        let stack = result(log, job)?.number("stack")?;
        within(stack, bound(job.arith, MAX_DEPTH, row, samples))
            .map_err(|e| format!("{job}: {e}"))?;
    }
    for shown in log.records("shown") {
        within(shown.number("stack")?, bound(ArithName::Fixed, MAX_DEPTH, row, 0))?;
    }
    Ok(())
}

//! The emulated boards against the host: the same scenes, the same bits.

use std::path::Path;
use std::time::Duration;

use whitted::tally::Counts;
use whitted_demo::frame;
use whitted_demo::job::{Job, JobError};
use whitted_demo::rebuild::{SHAPES, rebuild};

use crate::elf;
use crate::machine::{Log, MACHINES, Record};
use crate::oled;
use crate::report::Report;
use crate::shell::{boards, cargo, output};

/// A small frame takes a second or two; a busy machine may be slow.
const PATIENCE: Duration = Duration::from_secs(240);

/// Two cores are to be quicker than one by this factor.
pub(crate) const TWO_CORES: f64 = 1.8;

/// Runs every firmware and compares what it says, and shows, with the host.
pub(crate) fn check(report: &mut Report) {
    report.check("baked: a scene baked by the build script, read in place", baked);
    for machine in &MACHINES {
        let jobs: Vec<Job> = Job::small().filter(|job| machine.carries(job)).collect();
        let name = format!("{} ({}) runs", machine.core, machine.machine);
        let Some((log, dump)) = report.check(&name, || {
            let firmware = machine.build()?;
            let dump = firmware.with_extension("ppm");
            // A picture from before proves nothing.
            let _ = std::fs::remove_file(&dump);
            let mut words: Vec<String> = jobs.iter().map(Job::to_string).collect();
            if machine.rebuilds() {
                words.extend(SHAPES.map(|n| format!("rebuild:{n}")));
            }
            Ok((machine.run(&firmware, &words, &dump, PATIENCE)?, dump))
        }) else {
            continue;
        };
        report.check(&format!("{}: nothing computes in double precision", machine.core), || {
            no_double(&dump.with_extension(""))
        });
        report.check(&format!("{}: the clock counts instructions", machine.core), || clock(&log));
        for job in &jobs {
            report.check(&format!("{}: {job} has the host's bits", machine.core), || {
                same_bits(&log, job)
            });
        }
        for shapes in SHAPES.into_iter().filter(|_| machine.rebuilds()) {
            let name = format!("{}: a tree over {shapes} shapes is the host's", machine.core);
            report.check(&name, || rebuilt(&log, shapes).map(drop));
        }
        for record in log.records("shared") {
            let name = record.get("job").unwrap_or("a job");
            report.check(&format!("{}: {name}, each a share", machine.core), || shared(record));
        }
        if machine.display {
            report
                .check(&format!("{}: the display shows the host's picture", machine.core), || {
                    oled::compare(&dump)
                });
        }
    }
}

/// The example that bakes its scene when it is built: the blob that it reads in place gives the
/// host's picture.
fn baked() -> Result<(), String> {
    let said = output(&mut cargo(&boards().join("baked"), ["run", "-q", "--release"]))?;
    if said.contains("same-as-host=true") { Ok(()) } else { Err(said) }
}

/// An image holds no software for double precision: no board computes in it, and one slip in a
/// hot loop would cost thousands of instructions.
pub(crate) fn no_double(firmware: &Path) -> Result<(), String> {
    let found = elf::doubles(firmware)?;
    if found.is_empty() { Ok(()) } else { Err(format!("it holds {}", found.join(", "))) }
}

/// What a board said of a tree that it built, which is the host's to the word.
pub(crate) fn rebuilt(log: &Log, shapes: usize) -> Result<Record<'_>, String> {
    let record = log
        .records("rebuilt")
        .find(|record| record.number("shapes") == Ok(shapes as u64))
        .ok_or_else(|| format!("no tree over {shapes} shapes"))?;
    let there = record.get("checksum")?;
    let checksum = format!("{:016x}", rebuild(shapes, &mut ()).checksum.value());
    if there == checksum {
        Ok(record)
    } else {
        Err(format!("checksum {there}, on the host {checksum}"))
    }
}

/// Two cores draw the picture of one, and soon enough.
fn shared(record: Record<'_>) -> Result<(), String> {
    let job: Job = record.get("job")?.parse().map_err(|e: JobError| e.to_string())?;
    let checksum = format!("{:016x}", frame::count(&job).0.value());
    let there = record.get("checksum")?;
    if there != checksum {
        return Err(format!("checksum {there}, on the host {checksum}"));
    }
    let alone = record.number("alone")?;
    let cores = record.get("cores")?;
    let busier = cores.split(',').filter_map(|n| n.parse::<u64>().ok()).max().unwrap_or(u64::MAX);
    let ratio = alone as f64 / busier as f64;
    let line = format!("{alone} instructions on one core, {cores} on two: {ratio:.2} times");
    println!("     {line}");
    if ratio >= TWO_CORES { Ok(()) } else { Err(line) }
}

/// The loop of known length was counted right, to the tick at either end.
fn clock(log: &Log) -> Result<(), String> {
    let record = log.records("clock").next().ok_or("the firmware said nothing of its clock")?;
    let (instructions, counted) = (record.number("loop")?, record.number("counted")?);
    if counted.abs_diff(instructions) <= 200 {
        Ok(())
    } else {
        Err(format!("{instructions} instructions were counted as {counted}"))
    }
}

/// The result of a job in a log.
pub(crate) fn result<'a>(log: &'a Log, job: &Job) -> Result<Record<'a>, String> {
    let name = job.to_string();
    log.records("result")
        .find(|record| record.get("job") == Ok(&name))
        .ok_or_else(|| format!("no result for {name}"))
}

/// Checksum and rays are those of the same frame on the host.
fn same_bits(log: &Log, job: &Job) -> Result<(), String> {
    let record = result(log, job)?;
    let (checksum, rays) = frame::count(job);
    let checksum = format!("{:016x}", checksum.value());
    let Counts { primary, reflection, transmission, shadow, ambient, .. } = rays;
    let rays = format!("{primary},{reflection},{transmission},{shadow},{ambient}");
    let there = record.get("checksum")?;
    if there != checksum {
        return Err(format!("checksum {there}, on the host {checksum}"));
    }
    // Boards with little flash don't count.
    match record.get("rays") {
        Ok(there) if there != rays => Err(format!("rays {there}, on the host {rays}")),
        _ => Ok(()),
    }
}

//! The emulated boards against the host: the same scenes, the same bits.

use std::path::Path;
use std::time::Duration;

use whitted::tally::Counts;
use whitted_demo::frame;
use whitted_demo::job::{Job, JobError};
use whitted_demo::rebuild::{SHAPES, rebuild};

use crate::elf::{self, Sizes, sizes};
use crate::machine::{self, Log, MACHINES, Record, built};
use crate::oled;
use crate::report::Report;
use crate::shell::{boards, cargo, output, root};

/// A small frame takes a second or two; a busy machine may be slow.
const PATIENCE: Duration = Duration::from_secs(240);

/// Two cores are to be quicker than one by this factor.
pub(crate) const TWO_CORES: f64 = 1.8;

/// A ray among SPD's 7,382 balls may cost so many times what one among 92 costs.
const BALLS: f64 = 3.5;

/// Bytes of code that tracing the limit scene in fixed point may take on a Cortex-M0.
const KERNEL: u64 = 16 * 1024;

/// Runs every firmware and compares what it says, and shows, with the host.
pub(crate) fn check(report: &mut Report) {
    let surfaces = boards().join("baked/surfaces.toml");
    let name = "baked: a blob with textures, groups, solids, virtual lights, read in place";
    report.check(name, || baked("baked", Some(&surfaces)));
    let name = "baked: the bathroom, its window an area light, irradiance records in flash";
    report.check(name, || baked("source", None));
    let lights = boards().join("baked/lights.toml");
    let name = "baked: area lights of every form, a medium and a choice of lights";
    report.check(name, || baked("source", Some(&lights)));
    let name = "baked: textures and bumps, groups, solids, virtual lights";
    report.check(name, || baked("source", Some(&surfaces)));
    check_balls(report);
    oled::damaged(report);
    crate::stm32::check(report);
    crate::stack::check(report);
    report.check("Cortex-M0: code of the limit scene", kernel);
    report.check("room: area light, texture, instances, a cache filled on the chip", room);
    for machine in MACHINES.iter().filter(|machine| !machine.only_counts()) {
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
        report.check(&format!("{}: the frames' stack is within its bound", machine.core), || {
            crate::stack::frames(&log, &jobs)
        });
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

/// The program that is nothing but a tracer of the limit scene is small.
fn kernel() -> Result<(), String> {
    let program = machine::build(&boards().join("size"), "limit-fixed", "thumbv6m-none-eabi")?;
    let code = sizes(&program)?.text;
    println!("     {code} bytes of {KERNEL}");
    if code <= KERNEL { Ok(()) } else { Err(format!("{code} bytes are more than {KERNEL}")) }
}

/// The room's cache is filled, and its picture drawn, as on the host.
fn room() -> Result<(), String> {
    let said = output(&mut cargo(&boards().join("room"), ["run", "-q", "--release"]))?;
    let of = |kind: &str| {
        let line = said.lines().find_map(|line| line.strip_prefix(kind));
        line.map(Record::new).ok_or_else(|| said.clone())
    };
    let (result, shown) = (of("result ")?, of("shown ")?);
    let there = (result.get("checksum")?, result.number("records")?);
    let drawn = whitted_demo::room::draw(|_| {});
    let here = format!("{:016x}", drawn.checksum.value());
    let (instructions, stack) = (shown.number("instructions")?, shown.number("stack")?);
    println!("     {} records; {instructions} instructions, stack {stack} bytes", there.1);
    if there == (&here, drawn.records as u64) {
        Ok(())
    } else {
        Err(format!("{there:?}, on the host {here} and {} records", drawn.records))
    }
}

/// The example that bakes its scene when it is built, of another scene if one is named: the blob
/// that `baked` reads in place, or `source`'s Rust source, gives the host's picture. Instructions a ray.
fn baked(program: &str, scene: Option<&Path>) -> Result<f64, String> {
    // The build script bakes a scene for each of the two programs: the other's is a quick one.
    let quick = boards().join("baked/lights.toml");
    let (variable, other) = match program {
        "source" => ("WHITTED_SOURCE", "WHITTED_SCENE"),
        _ => ("WHITTED_SCENE", "WHITTED_SOURCE"),
    };
    let command = |arguments: &[&str]| {
        let mut command = cargo(&boards().join("baked"), arguments);
        command.env(other, &quick);
        match scene {
            Some(scene) => command.env(variable, scene),
            None => command.env_remove(variable),
        };
        command
    };
    let build = ["build", "-q", "--release", "--bin", program, "--message-format=json"];
    let firmware = built(&mut command(&build), program)?;
    let Sizes { text, constants } = sizes(&firmware)?;
    let said = output(&mut command(&["run", "-q", "--release", "--bin", program]))?;
    let line = said.lines().find_map(|line| line.strip_prefix("result "));
    let record = Record::new(line.ok_or_else(|| said.clone())?);
    if record.get("same-as-host")? != "true" {
        return Err(said);
    }
    let (instructions, rays) = (record.number("instructions")?, record.number("rays")?);
    let stack = record.number("stack")?;
    let each = instructions as f64 / rays as f64;
    println!(
        "     {instructions} instructions, {rays} rays, {each:.0} instructions a ray; stack {stack}; \
         flash {} bytes, {constants} of them constants",
        text + constants
    );
    Ok(each)
}

/// Thousands of shapes in the flash of a Pico, and what a ray costs against tens of them.
fn check_balls(report: &mut Report) {
    let spd = root().join("../shared/scenes/spd");
    let file = |name: &str| spd.join(name).canonicalize();
    let (Ok(few), Ok(many)) = (file("balls_s2.nff"), file("balls.nff")) else {
        println!("     SPD's scenes are not beside the repository: balls are left out");
        return;
    };
    let few = report.check("baked: SPD's balls_s2, 92 shapes", || baked("baked", Some(&few)));
    let many = report.check("baked: SPD's balls, 7,382 shapes", || baked("baked", Some(&many)));
    if let (Some(few), Some(many)) = (few, many) {
        report.check("baked: a ray among thousands costs at most 3.5 times one among tens", || {
            let times = many / few;
            println!("     {times:.2} times");
            if times <= BALLS { Ok(()) } else { Err(format!("{times:.2} times")) }
        });
    }
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

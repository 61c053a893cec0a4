//! Counting: instructions, rays, code and memory, in a table that is committed, so that a change
//! shows as a difference.

mod images;

use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use whitted::frame::Sampling;
use whitted_demo::job::{ArithName, Job, SAMPLINGS, SceneName};
use whitted_demo::rebuild::SHAPES;

use crate::elf;
use crate::firmware::{rebuilt, result};
use crate::machine::{MACHINES, Machine, Record};
use crate::pico;
use crate::setup;
use crate::shell::root;

/// Counts move by this with unrelated edits.
const TOLERANCE: f64 = 0.03;
/// A full frame in software floating point takes a minute on a busy machine.
const PATIENCE: Duration = Duration::from_secs(900);

/// What the bench is to do.
pub(crate) struct Options {
    /// Compare with the table, and leave it as it is.
    check: bool,
    /// Only this machine of QEMU, without writing the table.
    machine: Option<String>,
    /// Only how large programs are: the rest of the table stays as it is.
    images: bool,
}

impl Options {
    /// From the command line.
    pub(crate) fn read(words: &[&str]) -> Result<Self, String> {
        let mut options = Self { check: false, machine: None, images: false };
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            match (word, words.as_slice().first()) {
                ("--check", _) => options.check = true,
                ("--images", _) => options.images = true,
                ("--machine", Some(&name)) if MACHINES.iter().any(|m| m.machine == name) => {
                    options.machine = Some(name.into());
                    words.next();
                }
                _ => {
                    let names: Vec<_> = MACHINES.iter().map(|m| m.machine).collect();
                    return Err(format!(
                        "bench takes --check, --images, and --machine with one of {}",
                        names.join(", ")
                    ));
                }
            }
        }
        Ok(options)
    }
}

/// A table of the report. Its rows are known by the cells before `measure`, the one that is
/// compared; the cell after that is the change.
struct Table {
    title: &'static str,
    head: &'static [&'static str],
    measure: usize,
    rows: Vec<Vec<String>>,
}

const FRAMES: Table = Table {
    title: "Frames",
    head: &[
        "core",
        "scene",
        "arithmetic",
        "size",
        "instructions/pixel",
        "change",
        "rays/pixel",
        "shadow rays/pixel",
        "stack, bytes",
    ],
    measure: 4,
    rows: Vec::new(),
};

/// Of the emulated RP2040, whose memory never waits.
const CYCLES: Table = Table {
    title: "Cycles of the RP2040, one core",
    head: &["core", "scene", "arithmetic", "size", "cycles/pixel", "change"],
    measure: 4,
    rows: Vec::new(),
};

const REBUILDS: Table = Table {
    title: "Trees built on the chip",
    head: &["core", "shapes", "instructions", "change", "tree, words", "scratch, words"],
    measure: 2,
    rows: Vec::new(),
};

const IMAGES: Table = Table {
    title: "Images",
    head: &["image", "target", "code, bytes", "change", "constants, bytes", "static RAM, bytes"],
    measure: 2,
    rows: Vec::new(),
};

/// Counts, prints, and writes or compares.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    setup::run()?;
    let path = root().join("bench/table.md");
    let before = committed(&path);
    let (mut frames, mut images) = (FRAMES, IMAGES);
    let (mut rebuilds, mut rp2040) = (REBUILDS, CYCLES);
    if options.machine.is_none() {
        images::kernels(&mut images)?;
        images::others(&mut images)?;
        if !options.images {
            println!("RP2040 (rp2040py) …");
            cycles(&mut rp2040)?;
        }
    }
    let mut seen = Vec::new();
    for machine in &MACHINES {
        if options.machine.as_ref().is_some_and(|only| only != machine.machine) {
            continue;
        }
        println!("{} ({}) …", machine.core, machine.machine);
        let firmware = machine.build()?;
        if !options.images {
            count(machine, &firmware, &mut frames, &mut rebuilds)?;
        }
        if !seen.contains(&firmware) {
            let name = format!("firmware {}, all scenes in both", machine.board);
            let memory = elf::static_bytes(&firmware)?;
            images::image(&mut images, &name, machine.target, &firmware, Some(memory))?;
            seen.push(firmware);
        }
    }
    let mut worse = Vec::new();
    let mut text = if options.images { String::new() } else { HEADER.to_owned() };
    for table in [&mut frames, &mut rp2040, &mut rebuilds, &mut images] {
        if !options.images || table.title == IMAGES.title {
            compare(table, &before, &mut worse);
            text.push_str(&table.to_markdown());
        }
    }
    println!("{text}");
    if options.check {
        return if worse.is_empty() {
            println!("within {} % of bench/table.md", TOLERANCE * 100.0);
            Ok(())
        } else {
            Err(format!("worse than bench/table.md:\n{}", worse.join("\n")))
        };
    }
    if options.machine.is_none() {
        if options.images {
            let whole = std::fs::read_to_string(&path).unwrap_or_default();
            text = renewed(&whole, IMAGES.title, &text);
        }
        std::fs::create_dir_all(root().join("bench"))
            .and_then(|()| std::fs::write(&path, text))
            .map_err(|error| format!("bench/table.md: {error}"))?;
        println!("written to bench/table.md");
    }
    Ok(())
}

const HEADER: &str = "\
# Counts

Made by `cargo xtask bench`; the column `change` is against the table committed before. All of it
is emulated: QEMU with one nanosecond an instruction, so these are instructions, not cycles, and
the same on every machine.

- Instructions are those of tracing rows of 24-bit pixels; set-up and checksums aren't counted.
- Rays are all but shadow rays, the camera's among them.
- Stack is what a frame needs below its call: the tracer's memory for five generations and a row
  of 320 pixels (960 bytes) among it.
- A sampling stands behind its scene (`docs/sampling.md`); its stack holds 530 samples of 16 bytes.
- Software floating point (f32 on Cortex-M0 and M3) is counted on small frames.
- `gfxcat` is a plane and three mirrors, one bounce, one shadow ray; `spheres64` 64 spheres at random in
  an octree, one ray a pixel and no shading.
- The RP2040's cycles are rp2040py's, of tracing alone. It takes memory never to wait.
- A tree is built over spheres at random and checked, in the caller's memory.
- The images `limit-fixed` and `limit-f32` hold a row of the limit scene, 240 pixels of RGB565,
  and nothing else.
- Beside POV-Ray on a PC, in CPU seconds of one run, `whitted render` takes SPD's balls in `f32` 2.1 times as fast
  (0.82 s against 0.39): `docs/povray.md`, measured by hand, not by `cargo xtask bench`.
";

/// The pictures to count on, at the sizes their peers have.
fn jobs(machine: &Machine) -> Vec<Job> {
    let sizes = [
        (SceneName::Showcase, 160, 120),
        (SceneName::Limit, 240, 240),
        (SceneName::Raystones, 120, 60),
        (SceneName::Ftb, 160, 120),
        (SceneName::Gfxcat, 320, 240),
        (SceneName::Spheres64, 120, 120),
        (SceneName::Bathroom, 160, 120),
    ];
    let job = |(scene, width, height), arith| {
        let (width, height) =
            if arith == ArithName::F32 && !machine.float { (80, 60) } else { (width, height) };
        Job { scene, arith, width, height, sampling: Sampling::Center }
    };
    let all = sizes.into_iter().flat_map(|size| ArithName::ALL.map(|arith| job(size, arith)));
    // Cores without a floating-point unit have no flash for that.
    let soft = |job: &Job| job.scene.is_soft_in_fixed_alone() && job.arith == ArithName::F32;
    let mut jobs: Vec<Job> =
        all.filter(|job| machine.carries(job) && (machine.float || !soft(job))).collect();
    // The samplings, where they matter: the smallest core, and one with a floating-point unit.
    let arith = if machine.float { ArithName::F32 } else { ArithName::Fixed };
    if ["Cortex-M0", "Cortex-M4F"].contains(&machine.core) {
        for (_, sampling) in SAMPLINGS {
            // What takes many rays shows in a smaller picture.
            let side = if sampling == Sampling::SPARSE { 240 } else { 120 };
            jobs.push(Job { sampling, ..job((SceneName::Limit, side, side), arith) });
        }
    }
    jobs
}

/// The scenes that the Pico's image carries, and those that one for counting does.
fn cycles(table: &mut Table) -> Result<(), String> {
    let job = |(scene, width, height)| {
        let (arith, sampling) = (ArithName::Fixed, Sampling::Center);
        Job { scene, arith, width, height, sampling }
    };
    let carried = [
        (SceneName::Showcase, 80, 60),
        (SceneName::Limit, 240, 240),
        (SceneName::Raystones, 120, 60),
        (SceneName::Ftb, 160, 120),
    ]
    .map(job);
    let sparse = Job { sampling: Sampling::SPARSE, ..job((SceneName::Limit, 240, 240)) };
    let tree = job((SceneName::Spheres64, 120, 120));
    // The images for counting one by one: RAM doesn't hold them all.
    for jobs in [&carried[..], &[sparse], &[tree]] {
        for (job, cycles) in jobs.iter().zip(pico::cycles(jobs)?) {
            table.rows.push(row(job, cycles));
        }
    }
    Ok(())
}

/// A row of the RP2040.
fn row(job: &Job, cycles: u64) -> Vec<String> {
    let each = cycles as f64 / (f64::from(job.width) * f64::from(job.height));
    vec![
        "RP2040".into(),
        scene(job),
        job.arith.name().into(),
        format!("{}×{}", job.width, job.height),
        format!("{each:.0}"),
        String::new(),
    ]
}

/// Runs a machine's jobs.
fn count(
    machine: &Machine,
    firmware: &Path,
    table: &mut Table,
    rebuilds: &mut Table,
) -> Result<(), String> {
    let dump = firmware.with_extension("ppm");
    let jobs = jobs(machine);
    let mut words: Vec<String> = jobs.iter().map(Job::to_string).collect();
    let shapes = if machine.rebuilds() { &SHAPES[..] } else { &[] };
    words.extend(shapes.iter().map(|n| format!("rebuild:{n}")));
    let log = machine.run(firmware, &words, &dump, PATIENCE)?;
    for &shapes in shapes {
        let record = rebuilt(&log, shapes)?;
        let cell = |key| record.get(key).map(String::from);
        rebuilds.rows.push(vec![
            machine.core.into(),
            shapes.to_string(),
            cell("instructions")?,
            String::new(),
            cell("words")?,
            cell("scratch")?,
        ]);
    }
    for job in &jobs {
        table.rows.push(frame(machine, job, result(&log, job)?)?);
    }
    Ok(())
}

/// A job's scene, and the sampling if it isn't one ray a pixel.
fn scene(job: &Job) -> String {
    match job.sampling_name() {
        Some(sampling) => format!("{}, {sampling}", job.scene.name()),
        None => job.scene.name().into(),
    }
}

fn frame(machine: &Machine, job: &Job, record: Record<'_>) -> Result<Vec<String>, String> {
    let pixels = f64::from(job.width) * f64::from(job.height);
    // The same as on the board, which `cargo xtask test` sees to.
    let (_, counts) = whitted_demo::frame::count(job);
    let shadow = counts.shadow as f64;
    let others = (counts.rays() - counts.shadow) as f64;
    let instructions = record.number("instructions")? as f64 / pixels;
    Ok(vec![
        machine.core.into(),
        scene(job),
        job.arith.name().into(),
        format!("{}×{}", job.width, job.height),
        format!("{instructions:.0}"),
        String::new(),
        format!("{:.2}", others / pixels),
        format!("{:.2}", shadow / pixels),
        record.get("stack")?.into(),
    ])
}

/// The table as it was committed last, or as it lies there.
fn committed(path: &Path) -> String {
    let git = Command::new("git")
        .current_dir(root())
        .args(["show", "HEAD:bench/table.md"])
        .output()
        .ok()
        .filter(|output| output.status.success());
    match git {
        Some(output) => String::from_utf8_lossy(&output.stdout).into_owned(),
        None => std::fs::read_to_string(path).unwrap_or_default(),
    }
}

/// The whole with one table anew, from its title to the next one's or to the end.
fn renewed(whole: &str, title: &str, table: &str) -> String {
    let title = format!("\n## {title}\n");
    let (before, rest) = whole.split_once(&title).unwrap_or((whole, ""));
    let after = rest.find("\n## ").and_then(|at| rest.get(at..)).unwrap_or_default();
    format!("{before}{table}{after}")
}

/// Fills in the changes, and names what has grown worse by more than the tolerance.
fn compare(table: &mut Table, before: &str, worse: &mut Vec<String>) {
    let measure = table.measure;
    for row in &mut table.rows {
        let Some(old) = find(before, &row[..measure]) else {
            row[measure + 1] = "new".into();
            continue;
        };
        let new: f64 = row[measure].parse().unwrap_or(f64::NAN);
        let change = new / old - 1.0;
        row[measure + 1] =
            if new == old { "0".into() } else { format!("{:+.1} %", change * 100.0) };
        // Also where it isn't a number.
        if !(change <= TOLERANCE) {
            worse.push(format!("{}: {old} → {new}", row[..measure].join(", ")));
        }
    }
}

/// The number that follows these cells in some row.
fn find(text: &str, key: &[String]) -> Option<f64> {
    text.lines().find_map(|line| {
        let mut cells = line.strip_prefix('|')?.split('|').map(str::trim);
        key.iter().all(|cell| cells.next() == Some(cell)).then(|| cells.next()?.parse().ok())?
    })
}

impl Table {
    fn to_markdown(&self) -> String {
        let mut text = String::new();
        let mut line = |cells: &mut dyn Iterator<Item = &str>| {
            text.push('|');
            cells.for_each(|cell| {
                let _ = write!(text, " {cell} |");
            });
            text.push('\n');
        };
        line(&mut self.head.iter().copied());
        line(&mut self.head.iter().enumerate().map(|(i, _)| {
            // Numbers to the right.
            if i < self.measure { "---" } else { "--:" }
        }));
        for row in &self.rows {
            line(&mut row.iter().map(String::as_str));
        }
        format!("\n## {}\n\n{text}", self.title)
    }
}

#[cfg(test)]
mod tests {
    use super::{FRAMES, compare, renewed};

    fn table(instructions: &str) -> super::Table {
        let cells = ["Cortex-M0", "limit", "fixed", "8×8", instructions, "", "1", "1", "9"];
        super::Table { rows: vec![cells.map(str::to_owned).to_vec()], ..FRAMES }
    }

    #[test]
    fn one_table_is_renewed() {
        let whole = "head\n\n## A\n\n|1|\n\n## B\n\n|2|\n";
        assert_eq!(renewed(whole, "A", "\n## A\n\n|3|\n"), whole.replace('1', "3"));
        assert_eq!(renewed(whole, "B", "\n## B\n\n|3|\n"), whole.replace('2', "3"));
        assert_eq!(renewed(whole, "C", "\n## C\n"), format!("{whole}\n## C\n"));
    }

    #[test]
    fn changes_are_found_in_what_was_written() {
        let before = table("1000").to_markdown();
        for (now, change, bad) in
            [("1000", "0", false), ("1029", "+2.9 %", false), ("1031", "+3.1 %", true)]
        {
            let (mut now, mut worse) = (table(now), Vec::new());
            compare(&mut now, &before, &mut worse);
            assert_eq!(now.rows[0][5], change);
            assert_eq!(!worse.is_empty(), bad);
        }
        let mut new = table("1000");
        compare(&mut new, "", &mut Vec::new());
        assert_eq!(new.rows[0][5], "new");
    }
}

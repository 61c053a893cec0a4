//! `cargo xtask bench --stages`: what each stage of a frame costs, and who called it.
//!
//! The emulator tells every instruction that a frame executes; the program's debug information
//! tells which functions were inlined there, and so which stage it belongs to. The image is the one
//! that `bench` counts: debug information changes none of its bits.

mod follow;
mod place;
mod source;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::File;
use std::path::{Path, PathBuf};

use inferno::flamegraph;
use whitted::frame::Sampling;
use whitted_demo::job::{ArithName, Job, JobError, SceneName};

use crate::machine::{MACHINES, Machine};
use crate::setup;
use follow::Follower;
use place::Places;

/// Cycles of the emulated RP2040's first core, and not QEMU's instructions.
const RP2040: &str = "rp2040";

/// What is to be profiled.
pub(crate) struct Options {
    jobs: Vec<Job>,
    target: Target,
    /// Where the flame graph goes.
    flame: Option<PathBuf>,
    /// Where the same goes as text.
    folded: Option<PathBuf>,
}

/// Who runs it.
#[derive(Clone, Copy)]
enum Target {
    Qemu(&'static Machine),
    Rp2040,
}

impl Target {
    fn find(name: &str) -> Result<Self, String> {
        // One that shows a picture waits for its monitor.
        let mut machines = MACHINES.iter().filter(|m| !m.display);
        if name == RP2040 {
            return Ok(Self::Rp2040);
        }
        machines.clone().find(|m| m.machine == name).map(Self::Qemu).ok_or_else(|| {
            let names = machines.by_ref().fold(RP2040.to_owned(), |all, m| all + ", " + m.machine);
            format!("no machine `{name}`; there are {names}")
        })
    }

    fn unit(self) -> &'static str {
        match self {
            Self::Qemu(_) => "instructions",
            Self::Rp2040 => "cycles",
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Qemu(machine) => machine.core,
            Self::Rp2040 => "RP2040, one core",
        }
    }

    /// Its job of a scene: in the arithmetic that suits the core, and small, since every instruction
    /// is looked at.
    fn job(self, scene: SceneName) -> Job {
        let float = matches!(self, Self::Qemu(machine) if machine.float);
        let arith = if float { ArithName::F32 } else { ArithName::Fixed };
        let (width, height) = match scene {
            SceneName::Limit => (80, 80),
            SceneName::Bathroom => (40, 30),
            _ => (80, 60),
        };
        Job { scene, arith, width, height, sampling: Sampling::Center }
    }
}

impl Options {
    /// From the command line.
    pub(crate) fn read(words: &[&str]) -> Result<Self, String> {
        let (mut names, mut target) = (Vec::new(), Target::find("microbit")?);
        let (mut flame, mut folded) = (None, None);
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            let mut value = || words.next().copied().ok_or_else(|| format!("{word} wants a value"));
            match word {
                "--machine" => target = Target::find(value()?)?,
                "--flame" => flame = Some(PathBuf::from(value()?)),
                "--folded" => folded = Some(PathBuf::from(value()?)),
                name if !name.starts_with('-') => names.push(name),
                _ => return Err(format!("bench --stages knows no {word}")),
            }
        }
        if names.is_empty() {
            names = vec!["limit", "showcase"];
        }
        let job = |name: &&str| match SceneName::ALL.into_iter().find(|s| s.name() == *name) {
            Some(scene) => Ok(target.job(scene)),
            None => name.parse().map_err(|error: JobError| format!("{name}: {error}")),
        };
        let jobs = names.iter().map(job).collect::<Result<Vec<_>, _>>()?;
        if matches!(target, Target::Rp2040)
            && jobs.iter().any(|job| ![Sampling::Center, Sampling::SPARSE].contains(&job.sampling))
        {
            return Err("the Pico's program draws one ray a pixel, or sparse".into());
        }
        if jobs.len() > 1 && (flame.is_some() || folded.is_some()) {
            return Err("a flame graph is of one scene".into());
        }
        Ok(Self { jobs, target, flame, folded })
    }
}

/// Profiles each job and prints its table.
pub(crate) fn run(options: &Options) -> Result<(), String> {
    setup::run()?;
    let target = options.target;
    let image = source::build(target, &options.jobs)?;
    for job in &options.jobs {
        let mut follower = Follower::new(&image)?;
        let told = source::execute(target, &image, job, &mut follower)?;
        let mut places = Places::new(&image)?;
        let profile = Profile::of(&follower, &mut places);
        println!("{}", profile.table(job, target, told));
        if let Some(path) = &options.folded {
            std::fs::write(path, profile.folded.join("\n") + "\n")
                .map_err(|error| format!("{}: {error}", path.display()))?;
        }
        if let Some(path) = &options.flame {
            flame(path, &profile.folded, job, target)?;
        }
    }
    Ok(())
}

/// What was spent, by stage and by calls.
#[derive(Default)]
struct Profile {
    /// For each stage: all, and what of it was for shadow rays.
    stages: BTreeMap<String, [u64; 2]>,
    all: u64,
    /// Calls, the outermost first, and what was spent there: what flame graphs are made of.
    folded: Vec<String>,
}

impl Profile {
    fn of(follower: &Follower, places: &mut Places) -> Self {
        let mut profile = Self::default();
        let mut stacks: BTreeMap<String, u64> = BTreeMap::new();
        for (calls, address, spent) in follower.spent() {
            let stack = places.stack(&calls, address);
            let [all, shadow] = profile.stages.entry(stack.stage).or_default();
            *all += spent;
            *shadow += if stack.shadow { spent } else { 0 };
            profile.all += spent;
            *stacks.entry(stack.functions).or_default() += spent;
        }
        profile.folded = stacks.iter().map(|(stack, spent)| format!("{stack} {spent}")).collect();
        profile
    }

    fn table(&self, job: &Job, target: Target, told: Option<u64>) -> String {
        let pixels = f64::from(job.width) * f64::from(job.height);
        let each = |n: u64| n as f64 / pixels;
        let (unit, core) = (target.unit(), target.name());
        let mut text = format!("{job}, {core}: {:.0} {unit} a pixel", each(self.all));
        if let Some(told) = told {
            let _ = write!(text, "; the firmware counted {:.0}", each(told));
        }
        let _ = write!(text, "\n\n| stage | {unit}/pixel | share | for shadow rays |\n");
        text.push_str("|---|--:|--:|--:|\n");
        let mut rows: Vec<_> = self.stages.iter().collect();
        rows.sort_by_key(|(_, [all, _])| std::cmp::Reverse(*all));
        for (stage, &[all, shadow]) in rows {
            let share = 100.0 * all as f64 / self.all as f64;
            let _ = write!(text, "| {stage} | {:.1} | {share:.1} % | ", each(all));
            if shadow > 0 {
                let _ = write!(text, "{:.1} ", each(shadow));
            }
            text.push_str("|\n");
        }
        text
    }
}

/// Draws the calls: as wide as what was spent there.
fn flame(path: &Path, folded: &[String], job: &Job, target: Target) -> Result<(), String> {
    let place = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let mut options = flamegraph::Options::default();
    options.title = format!("{job}, {}", target.name());
    target.unit().clone_into(&mut options.count_name);
    let file = File::create(path).map_err(|error| place(&error))?;
    let lines = folded.iter().map(String::as_str);
    flamegraph::from_lines(&mut options, lines, file).map_err(|error| place(&error))
}

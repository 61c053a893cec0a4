//! The emulated boards: building their firmware, and running it in QEMU.

use std::fmt::Display;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use whitted_demo::job::Job;

use crate::shell::{boards, cargo, output};

/// A program of QEMU's.
#[derive(Clone, Copy)]
pub(crate) struct Emulator {
    /// As it is called.
    pub(crate) program: &'static str,
    /// Debian's package.
    pub(crate) package: &'static str,
    /// What it always has to be told.
    args: &'static [&'static str],
}

impl Emulator {
    /// For Arm.
    const ARM: Self = Self { program: "qemu-system-arm", package: "qemu-system-arm", args: &[] };
    /// For RISC-V, which would start with a BIOS.
    const RISCV: Self = Self {
        program: "qemu-system-riscv32",
        package: "qemu-system-misc",
        args: &["-bios", "none"],
    };
    /// All of them.
    pub(crate) const ALL: [Self; 2] = [Self::ARM, Self::RISCV];
}

/// A machine of QEMU with the firmware it runs.
pub(crate) struct Machine {
    /// As reports call it.
    pub(crate) core: &'static str,
    /// The directory below `boards/`, and the name of its program.
    pub(crate) board: &'static str,
    /// What it is built for.
    pub(crate) target: &'static str,
    /// QEMU's name.
    pub(crate) machine: &'static str,
    /// The program that emulates its kind of core.
    pub(crate) emulator: Emulator,
    /// Whether single precision is done by the core.
    pub(crate) float: bool,
    /// Which jobs its flash has room for.
    carries: Carries,
    /// Whether it shows a picture at the end, which ends with the monitor's `quit`.
    pub(crate) display: bool,
}

/// The jobs that a machine's flash has room for.
#[derive(Clone, Copy)]
enum Carries {
    /// All.
    All,
    /// Not what is there to be counted alone.
    Few,
    /// What another machine with the same code has no room for.
    Rest,
}

/// The one with a display.
pub(crate) const OLED: &Machine = &MACHINES[2];

/// All of them.
pub(crate) const MACHINES: [Machine; 9] = [
    Machine {
        core: "Cortex-M0",
        board: "microbit",
        target: "thumbv6m-none-eabi",
        machine: "microbit",
        emulator: Emulator::ARM,
        float: false,
        carries: Carries::Few,
        display: false,
    },
    // A Cortex-M3 runs the instructions of ARMv6-M, as many as a Cortex-M0 does.
    Machine {
        core: "Cortex-M0's code",
        board: "mps2",
        target: "thumbv6m-none-eabi",
        machine: "mps2-an385",
        emulator: Emulator::ARM,
        float: false,
        carries: Carries::Rest,
        display: false,
    },
    Machine {
        core: "Cortex-M3 with OLED",
        board: "lm3s6965evb",
        target: "thumbv7m-none-eabi",
        machine: "lm3s6965evb",
        emulator: Emulator::ARM,
        float: false,
        carries: Carries::Few,
        display: true,
    },
    Machine {
        core: "Cortex-M3",
        board: "mps2",
        target: "thumbv7m-none-eabi",
        machine: "mps2-an385",
        emulator: Emulator::ARM,
        float: false,
        carries: Carries::All,
        display: false,
    },
    Machine {
        core: "Cortex-M4F",
        board: "mps2",
        target: "thumbv7em-none-eabihf",
        machine: "mps2-an386",
        emulator: Emulator::ARM,
        float: true,
        carries: Carries::All,
        display: false,
    },
    Machine {
        core: "Cortex-M7",
        board: "mps2",
        target: "thumbv7em-none-eabihf",
        machine: "mps2-an500",
        emulator: Emulator::ARM,
        float: true,
        carries: Carries::All,
        display: false,
    },
    Machine {
        core: "Cortex-M33",
        board: "mps2-m33",
        target: "thumbv8m.main-none-eabihf",
        machine: "mps2-an505",
        emulator: Emulator::ARM,
        float: true,
        carries: Carries::All,
        display: false,
    },
    Machine {
        core: "two Cortex-M33",
        board: "mps2-an521",
        target: "thumbv8m.main-none-eabi",
        machine: "mps2-an521",
        emulator: Emulator::ARM,
        float: false,
        carries: Carries::Few,
        display: false,
    },
    Machine {
        core: "RISC-V",
        board: "virt",
        target: "riscv32imac-unknown-none-elf",
        machine: "virt",
        emulator: Emulator::RISCV,
        float: false,
        carries: Carries::All,
        display: false,
    },
];

/// What a firmware said.
pub(crate) struct Log {
    lines: Vec<String>,
}

impl Log {
    /// What a firmware wrote.
    pub(crate) fn new(text: &str) -> Self {
        Self { lines: text.lines().map(|line| line.trim().to_owned()).collect() }
    }

    /// Whether a line is in it, word for word.
    pub(crate) fn has(&self, line: &str) -> bool {
        self.lines.iter().any(|said| said == line)
    }

    /// What was said, line by line.
    pub(crate) fn text(&self) -> String {
        self.lines.join("\n")
    }

    /// The lines that begin with `word`, without it, as keys and values.
    pub(crate) fn records(&self, word: &str) -> impl Iterator<Item = Record<'_>> {
        self.lines
            .iter()
            .filter_map(move |line| Some(Record(line.strip_prefix(word)?.strip_prefix(' ')?)))
    }
}

/// A line of keys and values.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Record<'a>(&'a str);

impl<'a> Record<'a> {
    /// The keys and values of a line.
    pub(crate) fn new(line: &'a str) -> Self {
        Self(line)
    }

    /// The value of a key.
    pub(crate) fn get(self, key: &str) -> Result<&'a str, String> {
        self.0
            .split_whitespace()
            .find_map(|pair| pair.strip_prefix(key)?.strip_prefix('='))
            .ok_or_else(|| format!("no {key} in `{}`", self.0))
    }

    /// The value of a key, as a number.
    pub(crate) fn number(self, key: &str) -> Result<u64, String> {
        let text = self.get(key)?;
        text.parse().map_err(|_| format!("{key}={text} isn't a number"))
    }
}

/// Builds a program in a directory of its own settings and returns its path.
pub(crate) fn build(dir: &Path, bin: &str, target: &str) -> Result<PathBuf, String> {
    build_with(dir, bin, target, &[])
}

/// The same, with more for cargo to know.
pub(crate) fn build_with(
    dir: &Path,
    bin: &str,
    target: &str,
    more: &[&str],
) -> Result<PathBuf, String> {
    let args =
        ["build", "-q", "--release", "--bin", bin, "--target", target, "--message-format=json"];
    built(cargo(dir, args).args(more), bin)
}

/// Held while a program is built and put away: where cargo puts it doesn't depend on its features, and another
/// group of checks may build the same with others.
static BUILDING: Mutex<()> = Mutex::new(());

/// For builds whose program nobody runs.
pub(crate) fn building() -> MutexGuard<'static, ()> {
    BUILDING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What cargo builds, told to say it in JSON; a copy that no other build replaces.
pub(crate) fn built(command: &mut Command, bin: &str) -> Result<PathBuf, String> {
    let _building = building();
    let messages = output(command)?;
    // One message a line; only the finished program's names an executable that isn't null.
    let program = messages
        .lines()
        .filter_map(|line| {
            let (_, rest) = line.split_once("\"executable\":\"")?;
            let (path, _) = rest.split_once('"')?;
            Some(PathBuf::from(path.replace("\\\\", "\\")))
        })
        .next_back()
        .ok_or_else(|| format!("cargo names no program {bin}"))?;
    let mut hasher = DefaultHasher::new();
    command.get_current_dir().hash(&mut hasher);
    command.get_args().for_each(|word| word.hash(&mut hasher));
    let copy = program.with_file_name(format!("{bin}-{:08x}", hasher.finish() as u32));
    std::fs::copy(&program, &copy).map_err(|error| format!("{}: {error}", copy.display()))?;
    Ok(copy)
}

impl Machine {
    /// Builds the firmware.
    pub(crate) fn build(&self) -> Result<PathBuf, String> {
        build(&boards().join(self.board), self.board, self.target)
    }

    /// Whether its firmware is meant to draw a job.
    pub(crate) fn carries(&self, job: &Job) -> bool {
        match self.carries {
            Carries::All => true,
            Carries::Few => !job.scene.is_for_counting(),
            Carries::Rest => job.scene.is_for_counting(),
        }
    }

    /// Whether it has what is there to be counted, and nothing else: the other machines show that it
    /// is right.
    pub(crate) fn only_counts(&self) -> bool {
        matches!(self.carries, Carries::Rest)
    }

    /// Whether it builds trees when told to.
    pub(crate) fn rebuilds(&self) -> bool {
        !matches!(self.carries, Carries::Few)
    }

    /// The emulator, to be run with a firmware on jobs.
    pub(crate) fn emulate<J: Display>(&self, firmware: &Path, jobs: &[J]) -> Command {
        let mut qemu = Command::new(self.emulator.program);
        qemu.args(self.emulator.args);
        qemu.args(["-machine", self.machine, "-icount", "shift=0", "-display", "none"]);
        qemu.args(["-serial", "none", "-monitor", if self.display { "stdio" } else { "none" }]);
        let mut semihosting = String::from("enable=on,target=native,arg=firmware");
        for job in jobs {
            semihosting.push_str(&format!(",arg={job}"));
        }
        qemu.args(["-semihosting-config", &semihosting, "-kernel"]).arg(firmware);
        qemu
    }

    /// Runs a firmware on jobs. One that shows a picture has it dumped to `dump`.
    pub(crate) fn run<J: Display>(
        &self,
        firmware: &Path,
        jobs: &[J],
        dump: &Path,
        patience: Duration,
    ) -> Result<Log, String> {
        let mut qemu = self.emulate(firmware, jobs);
        qemu.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::inherit());
        let dir = dump.parent().unwrap_or(Path::new("."));
        qemu.current_dir(dir);
        // The monitor's words end at blanks, so it gets the name alone.
        let name = dump.file_name().unwrap_or_default().to_string_lossy();
        let commands = format!("screendump {name}\nquit\n");
        let child = qemu.spawn().map_err(|error| format!("{}: {error}", self.emulator.program))?;
        listen(Guard(child), &commands, patience)
    }
}

/// Ends the emulator when nobody waits for it any more.
pub(crate) struct Guard(pub(crate) Child);

impl Drop for Guard {
    fn drop(&mut self) {
        // It fails when the emulator has ended by itself, as it should.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Collects what the firmware says until the emulator ends; types `commands` when a picture is
/// shown.
fn listen(mut qemu: Guard, commands: &str, patience: Duration) -> Result<Log, String> {
    let mut stdin: Option<ChildStdin> = qemu.0.stdin.take();
    let stdout = qemu.0.stdout.take().ok_or("no output")?;
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        for line in BufReader::new(stdout).split(b'\n').map_while(Result::ok) {
            if sender.send(String::from_utf8_lossy(&line).into_owned()).is_err() {
                break;
            }
        }
    });
    let end = Instant::now() + patience;
    let mut lines: Vec<String> = Vec::new();
    loop {
        match receiver.recv_timeout(end.saturating_duration_since(Instant::now())) {
            Ok(line) => {
                // The monitor's prompt may stand before it.
                let line = line.trim().trim_start_matches("(qemu) ").to_owned();
                if line.starts_with("shown ") {
                    let mut monitor = stdin.take().ok_or("two pictures shown")?;
                    monitor.write_all(commands.as_bytes()).map_err(|e| e.to_string())?;
                    // Kept open until the emulator ends.
                    stdin = None;
                    std::mem::forget(monitor);
                }
                lines.push(line);
            }
            Err(RecvTimeoutError::Disconnected) => break,
            Err(RecvTimeoutError::Timeout) => {
                return Err(format!(
                    "not finished after {} s; its last line: {}",
                    patience.as_secs(),
                    lines.last().map_or("none", String::as_str)
                ));
            }
        }
    }
    let status = qemu.0.wait().map_err(|error| error.to_string())?;
    if status.success() {
        Ok(Log { lines })
    } else {
        Err(format!("the firmware failed:\n{}", lines.join("\n")))
    }
}

//! Who executes: QEMU, one instruction at a time, or the emulated RP2040.

use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc;
use std::time::Duration;

use whitted_demo::job::Job;

use super::Target;
use super::follow::Follower;
use super::place::{Mark, Places};
use crate::cores;
use crate::firmware::result;
use crate::machine::{Guard, Log, Machine};
use crate::pico;
use crate::shell::output;

/// Millions of instructions a minute are looked at.
const PATIENCE: Duration = Duration::from_secs(1800);
/// How far the count may be from the firmware's own, which counts the reading of its counter, too.
const TOLERANCE: f64 = 0.02;

/// The image of a target, with what these jobs draw.
pub(crate) fn build(target: Target, jobs: &[Job]) -> Result<PathBuf, String> {
    match target {
        Target::Qemu(machine) => machine.build(),
        Target::Rp2040 => pico::image(jobs),
    }
}

/// Runs a job and tells the follower of every instruction; what the firmware counted itself.
pub(crate) fn execute(
    target: Target,
    image: &Path,
    job: &Job,
    follower: &mut Follower,
) -> Result<Option<u64>, String> {
    match target {
        Target::Rp2040 => {
            cores::follow(image, job, |address, cycles| follower.step(address, cycles))?;
            Ok(None)
        }
        Target::Qemu(machine) => {
            let (all, told) = qemu(machine, image, job, follower)?;
            if (all as f64 / told as f64 - 1.0).abs() > TOLERANCE {
                return Err(format!("{job}: {all} instructions seen, {told} counted"));
            }
            Ok(Some(told))
        }
    }
}

/// The instructions between the marks, and those that the firmware counted.
fn qemu(
    machine: &Machine,
    image: &Path,
    job: &Job,
    follower: &mut Follower,
) -> Result<(u64, u64), String> {
    let mut command = machine.emulate(image, &[job]);
    command.args(one_at_a_time(machine)?).args(["-d", "exec,nochain"]);
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let name = machine.emulator.program;
    let mut qemu = Guard(command.spawn().map_err(|error| format!("{name}: {error}"))?);
    let (trace, said) = (qemu.0.stderr.take(), qemu.0.stdout.take());
    let (trace, mut said) = (trace.ok_or("no trace")?, said.ok_or("no output")?);
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        let mut text = String::new();
        // What can't be read holds no result, which is told.
        let _ = said.read_to_string(&mut text);
        let _ = sender.send(text);
    });
    let mut places = Places::new(image)?;
    let (mut counting, mut all) = (false, 0u64);
    let mut lines = BufReader::with_capacity(1 << 20, trace);
    let mut line = Vec::new();
    while lines.read_until(b'\n', &mut line).map_err(|error| error.to_string())? > 0 {
        if let Some(address) = traced(&line) {
            match places.mark(address) {
                Some(Mark::Before) => counting = true,
                Some(Mark::After) => counting = false,
                None => {
                    all += u64::from(counting);
                    follower.step(address, u64::from(counting));
                }
            }
        }
        line.clear();
    }
    let text = receiver.recv_timeout(PATIENCE).map_err(|_| format!("{name} doesn't end"))?;
    let log = Log::new(&text);
    let told = result(&log, job).map_err(|error| format!("{error}:\n{text}"))?;
    Ok((all, told.number("instructions")?))
}

/// The address in a line of QEMU's log, `Trace 0: 0x7f… [00000400/000001c0/…] …`.
fn traced(line: &[u8]) -> Option<u32> {
    let line = line.strip_prefix(b"Trace 0:")?;
    let mut parts = line.split(|&byte| byte == b'/');
    let hex = std::str::from_utf8(parts.nth(1)?).ok()?;
    u32::from_str_radix(hex, 16).ok()
}

/// How QEMU is told that a block is one instruction: newer ones have another option.
fn one_at_a_time(machine: &Machine) -> Result<&'static [&'static str], String> {
    let text = output(Command::new(machine.emulator.program).arg("--version"))?;
    let version = text.split("version ").nth(1).ok_or("QEMU tells no version")?;
    let mut numbers = version.split(['.', ' ']).map_while(|number| number.parse::<u32>().ok());
    let version = (numbers.next().unwrap_or(0), numbers.next().unwrap_or(0));
    Ok(if version >= (8, 1) { &["-accel", "tcg,one-insn-per-tb=on"] } else { &["-singlestep"] })
}

#[cfg(test)]
mod tests {
    use super::traced;

    #[test]
    fn addresses_are_found_in_the_log() {
        let line = b"Trace 0: 0x7f8b4c000100 [00000400/000001c0/00000110/ff000000] main\n";
        assert_eq!(traced(line), Some(0x1c0));
        assert_eq!(traced(b"Trace 1: 0x7f8b4c000100 [00000400/000001c0/00000110]"), None);
        assert_eq!(traced(b"qemu-system-arm: warning"), None);
    }
}

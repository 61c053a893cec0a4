//! The Raspberry Pi Pico 2, emulated: one core of either kind traces a frame, which is compared with
//! the host's.
//!
//! `rp2350-emu` runs no image as it is. It needs a boot ROM, which is nobody's to pass on with it: cores
//! start where the ROM would have led them. Of Armv8-M it knows neither loads that acquire nor stores that
//! release; with one core at work, plain ones do the same, and take their place here. Of the floating-point unit it
//! refuses whatever names registers in pairs, as `vpush {d8}` does though nothing is computed in double precision;
//! the instructions for single registers, as many, take their place. And it reads the bits of `vsel`, `vmaxnm` and
//! `vminnm` in another order than Arm writes them: here they are written in its own.

use std::path::{Path, PathBuf};

use rp2350_emu::{Arch, Config, Emulator, EmulatorBuilder};
use whitted::frame::Sampling;
use whitted_demo::job::{ArithName, Job, SceneName};
use whitted_demo::rgb565;

use crate::elf;
use crate::machine::{self, Log};
use crate::report::Report;
use crate::setup;
use crate::shell::boards;
use crate::stack;

const FLASH: u64 = 0x1000_0000;
const FLASH_SIZE: usize = 4 << 20;
const RAM: u64 = 0x2000_0000;
const ROM_SIZE: usize = 32 << 10;
/// Where the other core waits for ever, in the ROM: `wfe`, and back.
const ASIDE: u32 = 0x100;
const WAITING: [u8; 4] = [0x20, 0xbf, 0xfd, 0xe7];
/// High while a frame is drawn.
const MARK: u8 = 15;
/// Cycles without a frame: a minute or so.
const PATIENCE: u64 = 500_000_000;
/// What the check draws.
const SMALL: (u16, u16) = (60, 45);

const USAGE: &str = "\
cargo xtask emulate pico2 [--scene NAME] [--size WIDTHxHEIGHT] [--cores arm|riscv] [--arith fixed|f32]
    traces a frame on one core, in fixed point unless told otherwise, which a RISC-V core can't be; scenes are showcase, limit, raystones, ftb and
    bathroom; the size is 60x45 unless given, at most 240x240";

/// The kinds of cores.
const CORES: [(&str, &str); 2] =
    [("arm", "thumbv8m.main-none-eabihf"), ("riscv", "riscv32imac-unknown-none-elf")];

/// Those whose stack is measured at each depth.
pub(crate) const DEPTHS: [(&str, &str); 2] =
    [("RP2350, Arm", CORES[0].1), ("RP2350, RISC-V", CORES[1].1)];

/// The command: traces a scene, compares, and says what it took.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let (mut scene, mut size, mut cores) = (SceneName::Limit, SMALL, CORES[0]);
    let mut arith = ArithName::Fixed;
    let (pairs, rest) = words.as_chunks::<2>();
    if !rest.is_empty() {
        return Err(USAGE.into());
    }
    for &[option, value] in pairs {
        match option {
            "--scene" => {
                scene = *SceneName::ALL.iter().find(|s| s.name() == value).ok_or(USAGE)?;
            }
            "--size" => {
                let (width, height) = value.split_once('x').ok_or(USAGE)?;
                let side = |text: &str| text.parse().ok().filter(|n| (1..=240).contains(n));
                size = (side(width).ok_or(USAGE)?, side(height).ok_or(USAGE)?);
            }
            "--arith" => {
                arith = ArithName::ALL.into_iter().find(|a| a.name() == value).ok_or(USAGE)?;
            }
            "--cores" => cores = *CORES.iter().find(|cores| cores.0 == value).ok_or(USAGE)?,
            _ => return Err(USAGE.into()),
        }
    }
    if arith == ArithName::F32 && cores != CORES[0] {
        return Err(USAGE.into());
    }
    setup::run()?;
    let took = trace(cores.1, &Job { arith, ..job(scene, size) })?;
    println!("{took}; the pixels sum to the host's");
    Ok(())
}

/// The check: an Arm core traces what the host does. A RISC-V core's image takes as long to build again:
/// it is left to the command.
pub(crate) fn check(report: &mut Report) {
    let (name, target) = CORES[0];
    for arith in ArithName::ALL {
        let job = Job { arith, ..job(SceneName::Limit, SMALL) };
        report.check(&format!("Pico 2, {name} (rp2350-emu): {job}"), || {
            println!("     {}", trace(target, &job)?);
            Ok(())
        });
    }
    let (core, target) = DEPTHS[0];
    stack::check_log(report, core, false, || depths(target));
}

fn job(scene: SceneName, (width, height): (u16, u16)) -> Job {
    Job { scene, arith: ArithName::Fixed, width, height, sampling: Sampling::Center }
}

/// Builds the image, runs it until the frame is traced, compares, and says what it took.
fn trace(target: &str, job: &Job) -> Result<String, String> {
    let image = build("pico2", target, job.arith)?;
    let riscv = elf::is_riscv(&image)?;
    if !riscv {
        elf::in_ram(&image, job.arith)?;
    }
    let mut chip = boot(&image, Some(job))?;
    let start = wait(&mut chip, true, job)?;
    if !riscv {
        // What the frame needs is in RAM.
        chip.load_flash(&vec![0xff; FLASH_SIZE]);
    }
    let cycles = wait(&mut chip, false, job)? - start;

    let mut picture = vec![0; usize::from(job.width) * usize::from(job.height) * rgb565::BYTES];
    rgb565::draw(job, &mut picture);
    let expected = rgb565::sum(0, &picture);
    let sum = chip.peek(elf::symbol(&image, "TRACED")?.0 as u32);
    if sum != expected {
        return Err(format!("{job}: the pixels sum to {sum:#x}, the host's to {expected:#x}"));
    }
    let pixel = cycles / (u64::from(job.width) * u64::from(job.height));
    // The emulator takes one cycle for each of RISC-V's instructions.
    let what = if riscv { "instructions" } else { "cycles" };
    Ok(format!("{cycles} {what}, {pixel} a pixel"))
}

fn build(bin: &str, target: &str, arith: ArithName) -> Result<PathBuf, String> {
    let features = match arith {
        ArithName::Fixed => "st7789-240x240,rtt,ram,one-core,fixed",
        ArithName::F32 => "st7789-240x240,rtt,ram,one-core",
    };
    let more = ["--no-default-features", "--features", features];
    machine::build_with(&boards().join("pico2"), bin, target, &more)
}

/// The stack of a frame at each depth, on a core of a kind.
pub(crate) fn depths(target: &str) -> Result<Log, String> {
    let image = build("depths", target, ArithName::Fixed)?;
    let mut chip = boot(&image, None)?;
    let (place, _) = elf::symbol(&image, "DEPTHS")?;
    while chip.core_cycles(0) < PATIENCE {
        chip.step().map_err(|error| format!("{error:?}"))?;
        if let Some(log) = stack::left(place as u32, |address| chip.peek(address)) {
            return Ok(log);
        }
        if is_faulty(&chip) {
            break;
        }
    }
    Err(format!("a fault, or no end, after {} cycles", chip.core_cycles(0)))
}

/// The chip with an image, which may have to be told what to trace, about to begin it.
fn boot(image: &Path, job: Option<&Job>) -> Result<Emulator, String> {
    let mut flash = vec![0xff; FLASH_SIZE];
    let riscv = elf::is_riscv(image)?;
    for elf::Segment { address, mut data, is_code, .. } in elf::segments(image)? {
        // What lies in RAM has no beginning: it is the log's buffer.
        let Some(start) = address.checked_sub(FLASH).filter(|&start| start < RAM - FLASH) else {
            continue;
        };
        if is_code && !riscv {
            make_plain(&mut data);
        }
        let start = start as usize;
        let place = flash.get_mut(start..start + data.len()).ok_or("larger than the flash")?;
        place.copy_from_slice(&data);
    }
    if let Some(job) = job {
        let (order, size) = elf::symbol(image, "ORDER")?;
        let start = (order - FLASH) as usize;
        let text = format!("{:width$}", format!("{job} trace"), width = size as usize);
        flash[start..start + text.len()].copy_from_slice(text.as_bytes());
    }

    let arch = if riscv { Arch::RiscV } else { Arch::Arm };
    let builder = EmulatorBuilder::new(Config::default()).arch(arch).step_quantum(1);
    let mut chip = builder.build().map_err(|error| format!("{error:?}"))?;
    let mut rom = vec![0; ROM_SIZE];
    if !riscv {
        // The stack's end and the program's start.
        rom[..8].copy_from_slice(&flash[..8]);
        rom[ASIDE as usize..][..WAITING.len()].copy_from_slice(&WAITING);
    }
    chip.load_bootrom(&rom);
    chip.load_flash(&flash);
    chip.reset();
    if riscv {
        chip.core_riscv_mut(0).set_pc(FLASH as u32);
        chip.core_riscv_mut(1).set_halted(true);
    } else {
        chip.core_mut(1).regs.set_pc(ASIDE);
    }
    Ok(chip)
}

/// Puts plain loads and stores, and plain exclusive ones, in the place of those that acquire and
/// release, and single registers of the floating-point unit in the place of pairs.
fn make_plain(code: &mut [u8]) {
    let mut at = 0;
    while let Some(bytes) = code.get_mut(at..at + 4) {
        let half = |i: usize| u16::from_le_bytes([bytes[i], bytes[i + 1]]);
        let found = plain([half(0), half(2)]);
        if let Some([first, second]) = found {
            bytes[..2].copy_from_slice(&first.to_le_bytes());
            bytes[2..].copy_from_slice(&second.to_le_bytes());
        }
        at += if found.is_some() { 4 } else { 2 };
    }
}

/// What the emulator takes for one that acquires or releases, moves pairs of registers, or selects (Armv8-M
/// Architecture Reference Manual).
fn plain([first, second]: [u16; 2]) -> Option<[u16; 2]> {
    // VPUSH, VPOP, VLDM and VSTM, with addresses that rise or fall, and VMOV from or to two core registers: a pair
    // and its first register have the same number in the instruction, and words are counted.
    let moves = matches!((first & 0xffc0, first & 0xffe0), (0xec80, _) | (_, 0xed20 | 0xec40));
    if moves && second & 0x0f00 == 0x0b00 {
        return Some([first, second ^ 0x0100]);
    }
    // VSEL, VMAXNM and VMINNM: the emulator looks for the target register's lowest bit where the condition ends.
    if first & 0xff00 == 0xfe00 && second & 0x0f10 == 0x0a00 {
        let (low, condition) = (first >> 6 & 1, first >> 4 & 3);
        return Some([first & 0xff8f | condition << 5 | low << 4, second]);
    }
    let (n, t, status) = (first & 15, second & 0xf000, second & 15);
    Some(match (first & 0xfff0, second & 0x0ff0, status) {
        // LDAB, LDAH, LDA
        (0xe8d0, 0xf80, 15) => [0xf890 | n, t],
        (0xe8d0, 0xf90, 15) => [0xf8b0 | n, t],
        (0xe8d0, 0xfa0, 15) => [0xf8d0 | n, t],
        // STLB, STLH, STL
        (0xe8c0, 0xf80, 15) => [0xf880 | n, t],
        (0xe8c0, 0xf90, 15) => [0xf8a0 | n, t],
        (0xe8c0, 0xfa0, 15) => [0xf8c0 | n, t],
        // LDAEXB, LDAEXH, LDAEX
        (0xe8d0, 0xfc0, 15) => [0xe8d0 | n, t | 0xf4f],
        (0xe8d0, 0xfd0, 15) => [0xe8d0 | n, t | 0xf5f],
        (0xe8d0, 0xfe0, 15) => [0xe850 | n, t | 0xf00],
        // STLEXB, STLEXH, STLEX
        (0xe8c0, 0xfc0, status) => [0xe8c0 | n, t | 0xf40 | status],
        (0xe8c0, 0xfd0, status) => [0xe8c0 | n, t | 0xf50 | status],
        (0xe8c0, 0xfe0, status) => [0xe840 | n, t | status << 8],
        _ => return None,
    })
}

/// Runs until the mark is at a level; the first core's cycles until then.
fn wait(chip: &mut Emulator, level: bool, job: &Job) -> Result<u64, String> {
    let end = chip.core_cycles(0) + PATIENCE;
    while chip.core_cycles(0) < end {
        chip.step().map_err(|error| format!("{error:?}"))?;
        if chip.gpio_read(MARK) == level {
            return Ok(chip.core_cycles(0));
        }
        if is_faulty(chip) {
            return Err(format!("{job}: a fault after {} cycles", chip.core_cycles(0)));
        }
    }
    Err(format!("{job}: no frame"))
}

/// Whether an Arm core is where no image has code: it has met a fault.
fn is_faulty(chip: &Emulator) -> bool {
    chip.cores.is_arm() && (8..ASIDE).contains(&chip.core(0).regs.pc())
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn acquiring_becomes_plain() {
        // ldab r3, [r3]; stlb r0, [r1]; lda r0, [r1]; by LLVM's assembler, as the plain ones
        assert_eq!(plain([0xe8d3, 0x3f8f]), Some([0xf893, 0x3000]));
        assert_eq!(plain([0xe8c1, 0x0f8f]), Some([0xf881, 0x0000]));
        assert_eq!(plain([0xe8d1, 0x0faf]), Some([0xf8d1, 0x0000]));
        // ldaex r1, [r0]; stlex r2, r1, [r0]
        assert_eq!(plain([0xe8d0, 0x1fef]), Some([0xe850, 0x1f00]));
        assert_eq!(plain([0xe8c0, 0x1fe2]), Some([0xe840, 0x1200]));
        // ldrexb r3, [r3]
        assert_eq!(plain([0xe8d3, 0x3f4f]), None);
    }

    #[test]
    fn the_floating_point_unit_s_become_the_emulator_s() {
        // vpush {d8, d9} and {s16-s19}; vpop {d8-d15} and {s16-s31}; vmov d0, r0, r1 and s0, s1, r0, r1
        assert_eq!(plain([0xed2d, 0x8b04]), Some([0xed2d, 0x8a04]));
        assert_eq!(plain([0xecbd, 0x8b10]), Some([0xecbd, 0x8a10]));
        assert_eq!(plain([0xec41, 0x0b10]), Some([0xec41, 0x0a10]));
        // vselgt.f32 s0, s1, s2 and s1, s1, s2
        assert_eq!(plain([0xfe30, 0x0a81]), Some([0xfe60, 0x0a81]));
        assert_eq!(plain([0xfe70, 0x0a81]), Some([0xfe70, 0x0a81]));
        // vldr d8, [r0]: a pair in one load
        assert_eq!(plain([0xed90, 0x8b00]), None);
    }
}

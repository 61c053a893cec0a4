//! The Pico's two cores, in an emulator that has both but no display: the frame is traced and
//! kept.

use std::path::Path;
use std::process::Command;

use rp2040_emu::{Config, Emulator};
use whitted_demo::job::Job;

use crate::elf;
use crate::machine::Log;
use crate::setup;
use crate::shell::{self, boards};
use crate::stack;

const FLASH: u64 = 0x1000_0000;
const FLASH_SIZE: usize = 2 << 20;
/// High while a frame is drawn.
const MARK: u8 = 15;
/// Steps of the emulator without a frame: some minutes.
const PATIENCE: u64 = 2_000_000_000;
/// What the second core's stack is filled with beforehand.
const PAINT: u32 = 0xa5c3_3c5a;
/// The lowest bytes of it, which the core may not reach (a guard of `rp2040-hal`).
const GUARD: u64 = 32;

/// What a frame took.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    /// Cycles of either core between the edges of the mark.
    pub(crate) cycles: [u64; 2],
    /// The sum over the pixels.
    pub(crate) sum: u32,
    /// Bytes of the second core's stack: the deepest it was, and all but the guard.
    pub(crate) stack: [u64; 2],
}

/// Runs an image, which has its code in RAM, from its reset vector until the frame is traced. In the meantime the
/// flash is empty: whatever the frame still needed of it would be missed.
pub(crate) fn trace(image: &Path, job: &Job) -> Result<Frame, String> {
    let mut chip = boot(image, Some(job))?;
    let [bottom, top] = ["_second_stack_end", "_second_stack_start"]
        .map(|name| elf::symbol(image, name).map(|(address, _)| address));
    let (bottom, top) = (bottom?, top?);
    let words = || (bottom..top).step_by(4).map(|address| address as u32);
    words().for_each(|address| chip.poke(address, PAINT));
    let start = wait(&mut chip, true, job, |_| {})?;
    chip.load_flash(&vec![0xff; FLASH_SIZE]);
    let end = wait(&mut chip, false, job, |_| {})?;
    let cycles = [end[0] - start[0], end[1] - start[1]];
    let (result, _) = elf::symbol(image, "TRACED")?;
    let free = words().take_while(|&address| chip.peek(address) == PAINT).count() as u64 * 4;
    let stack = [top - bottom - free, top - bottom - GUARD];
    Ok(Frame { cycles, sum: chip.peek(result as u32), stack })
}

/// The same on the first core alone, telling each instruction of the frame: its address, and the
/// cycles it took.
pub(crate) fn follow(
    image: &Path,
    job: &Job,
    mut each: impl FnMut(u32, u64),
) -> Result<(), String> {
    let mut chip = boot(image, Some(job))?;
    // One instruction at a time.
    chip.step_quantum = 1;
    let before = wait(&mut chip, true, job, |_| {})?[0];
    let (mut address, mut before) = (chip.core(0).regs.pc(), before);
    wait(&mut chip, false, job, |chip| {
        let now = chip.core_cycles(0);
        if now != before {
            each(address, now - before);
            (address, before) = (chip.core(0).regs.pc(), now);
        }
    })?;
    Ok(())
}

/// Runs an image that leaves the stack of a frame at each depth in its memory.
pub(crate) fn depths(image: &Path) -> Result<Log, String> {
    let mut chip = boot(image, None)?;
    let (place, _) = elf::symbol(image, "DEPTHS")?;
    for _ in 0..PATIENCE {
        chip.step().map_err(|error| error.to_string())?;
        if let Some(log) = stack::left(place as u32, |address| chip.peek(address)) {
            return Ok(log);
        }
    }
    Err("the frames don't end".into())
}

/// The chip with an image, which may have to be told what to trace, at its reset vector.
fn boot(image: &Path, job: Option<&Job>) -> Result<Emulator, String> {
    let rom = image.with_extension("rom");
    let python = setup::python()?;
    shell::run(Command::new(python).arg("-B").arg(boards().join("pico/emulate/rom.py")).arg(&rom))?;
    let rom = std::fs::read(&rom).map_err(|error| format!("{}: {error}", rom.display()))?;

    let mut flash = vec![0xff; FLASH_SIZE];
    for elf::Segment { address, data, .. } in elf::segments(image)? {
        let start = address.checked_sub(FLASH).ok_or("a segment below the flash")? as usize;
        let place = flash.get_mut(start..start + data.len()).ok_or("larger than the flash")?;
        place.copy_from_slice(&data);
    }
    if let Some(job) = job {
        let (order, size) = elf::symbol(image, "ORDER")?;
        let start = (order - FLASH) as usize;
        let text = format!("{:width$}", format!("{job} trace"), width = size as usize);
        flash[start..start + text.len()].copy_from_slice(text.as_bytes());
    }

    let mut chip = Emulator::new(Config::default());
    chip.load_bootrom(&rom);
    chip.load_flash(&flash);
    chip.reset();
    chip.direct_boot_from_flash(0x100);
    Ok(chip)
}

/// Runs until the mark is at a level, with a look at the chip after each step; the cycles of both
/// cores until then.
fn wait(
    chip: &mut Emulator,
    level: bool,
    job: &Job,
    mut look: impl FnMut(&Emulator),
) -> Result<[u64; 2], String> {
    for _ in 0..PATIENCE {
        chip.step().map_err(|error| error.to_string())?;
        look(chip);
        if chip.gpio_read(MARK) == level {
            return Ok([0, 1].map(|core| chip.core_cycles(core)));
        }
        // A fault, whose handler's address can't be read either.
        if chip.core(0).regs.pc() == 0 {
            return Err(format!("{job}: the core wanted something of the erased flash"));
        }
    }
    Err(format!("{job}: no frame"))
}

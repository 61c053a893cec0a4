//! The STM32F4 board's image on an emulated STM32F405: QEMU notes every write to a register, and
//! from those to SPI and to the pins comes the picture that the display would show.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::Command;

use whitted::frame::Sampling;
use whitted_demo::job::{ArithName, Job, SceneName};
use whitted_demo::rgb565;

use crate::machine::{self, Log};
use crate::report::Report;
use crate::shell::{boards, output};
use crate::stack;

const BOARD: &str = "stm32f4";
/// As reports call it.
pub(crate) const CORE: &str = "STM32F405";
const TARGET: &str = "thumbv7em-none-eabihf";
/// Seconds.
const PATIENCE: &str = "240";
/// What the emulator is to draw.
const SIZE: (u16, u16) = (60, 45);

/// The display's pixels across and down, lying.
const DISPLAY: (u16, u16) = (320, 240);
/// Port A's register that sets pins (lower half) and clears them (upper half).
const SET_CLEAR: u32 = 0x4002_0018;
/// SPI1's data register.
const DATA: u32 = 0x4001_300C;
/// The pins of port A: data (high) or command (low), and select, when low.
const DATA_COMMAND: u32 = 3;
const SELECT: u32 = 4;

/// Commands of the ILI9341's data sheet.
const COLUMNS: u8 = 0x2A;
const ROWS: u8 = 0x2B;
const WRITE: u8 = 0x2C;
const MEMORY_ACCESS: u8 = 0x36;
const PIXEL_FORMAT: u8 = 0x3A;

/// Builds the image, runs it, and compares what the display gets with the host's pictures.
pub(crate) fn check(report: &mut Report) {
    let Some(image) = report.check("STM32F405: the image is built", || build(BOARD)) else {
        return;
    };
    for arith in ArithName::ALL {
        let (width, height) = SIZE;
        let scene = SceneName::Limit;
        let job = Job { scene, arith, width, height, sampling: Sampling::Center };
        let name = format!("STM32F405 (netduinoplus2): {job}, the display gets the host's picture");
        report.check(&name, || compare(&job, &emulate(&image, &job)?));
    }
    stack::check_log(report, CORE, true, depths);
}

fn build(bin: &str) -> Result<PathBuf, String> {
    let more = ["--no-default-features", "--features", "f405"];
    machine::build_with(&boards().join(BOARD), bin, TARGET, &more)
}

/// The emulator, to be run with an image, and with more for it to know.
fn emulator(image: &Path, semihosting: &str, more: &[&str]) -> Command {
    let mut qemu = Command::new("timeout");
    qemu.args([PATIENCE, "qemu-system-arm", "-machine", "netduinoplus2", "-display", "none"]);
    qemu.args(["-icount", "shift=0", "-serial", "none", "-monitor", "none"]);
    qemu.args([
        "-semihosting-config",
        &format!("enable=on,target=native,arg=firmware{semihosting}"),
    ]);
    qemu.args(more).arg("-kernel").arg(image);
    qemu
}

/// The stack of a frame at each depth.
pub(crate) fn depths() -> Result<Log, String> {
    Ok(Log::new(&output(&mut emulator(&build("depths")?, "", &[]))?))
}

/// Runs the image on a job; what the display holds then.
fn emulate(image: &Path, job: &Job) -> Result<Vec<u8>, String> {
    let trace = image.with_extension("trace");
    // Writes from before prove nothing.
    let _ = std::fs::remove_file(&trace);
    let events = format!("memory_region_ops_write,file={}", trace.display());
    let said = output(&mut emulator(image, &format!(",arg={job}"), &["-trace", &events]))?;
    println!("     {}", said.trim());
    let log = Log::new(&said);
    let record = log.records("frame").next().ok_or("it says nothing of a frame")?;
    stack::banded(job.arith, record.number("stack")?)?;
    let file = std::fs::File::open(&trace).map_err(|e| format!("{}: {e}", trace.display()))?;
    let mut panel = Panel::new();
    for line in BufReader::new(file).lines() {
        let line = line.map_err(|e| format!("{}: {e}", trace.display()))?;
        if let Some((address, value)) = write(&line) {
            panel.take(address, value)?;
        }
    }
    let _ = std::fs::remove_file(&trace);
    Ok(panel.memory)
}

/// The address and the value in a line of the trace.
fn write(line: &str) -> Option<(u32, u32)> {
    let number = |word| {
        let (_, rest) = line.split_once(word)?;
        u32::from_str_radix(rest.split_whitespace().next()?.strip_prefix("0x")?, 16).ok()
    };
    Some((number(" addr ")?, number(" value ")?))
}

/// The display, as far as the driver uses it.
struct Panel {
    /// Of two bytes a pixel.
    memory: Vec<u8>,
    data: bool,
    selected: bool,
    command: u8,
    /// Of the command, or of the pixel.
    arguments: Vec<u8>,
    /// First and last.
    columns: [u16; 2],
    rows: [u16; 2],
    /// Where the next pixel goes.
    next: (u16, u16),
    /// Lying, and of 16 bits a pixel.
    ready: [bool; 2],
}

impl Panel {
    fn new() -> Self {
        Self {
            memory: vec![0xA5; usize::from(DISPLAY.0) * usize::from(DISPLAY.1) * rgb565::BYTES],
            data: false,
            selected: false,
            command: 0,
            arguments: Vec::new(),
            columns: [0; 2],
            rows: [0; 2],
            next: (0, 0),
            ready: [false; 2],
        }
    }

    /// A write to a register of the chip.
    fn take(&mut self, address: u32, value: u32) -> Result<(), String> {
        match address {
            SET_CLEAR => {
                for (pin, high) in [(DATA_COMMAND, &mut self.data), (SELECT, &mut self.selected)] {
                    // The select line is on when low.
                    let on = if pin == SELECT { [16, 0] } else { [0, 16] };
                    if value >> (pin + on[0]) & 1 == 1 {
                        *high = true;
                    } else if value >> (pin + on[1]) & 1 == 1 {
                        *high = false;
                    }
                }
                Ok(())
            }
            DATA if !self.selected => Err("a byte is sent and the display isn't selected".into()),
            DATA => self.byte((value & 0xFF) as u8),
            _ => Ok(()),
        }
    }

    fn byte(&mut self, byte: u8) -> Result<(), String> {
        if !self.data {
            self.command = byte;
            self.arguments.clear();
            if byte == WRITE {
                self.next = (self.columns[0], self.rows[0]);
            }
            return Ok(());
        }
        self.arguments.push(byte);
        match (self.command, self.arguments.as_slice()) {
            (COLUMNS, &[a, b, c, d]) => self.columns = range([a, b, c, d], DISPLAY.0)?,
            (ROWS, &[a, b, c, d]) => self.rows = range([a, b, c, d], DISPLAY.1)?,
            // Rows and columns exchanged.
            (MEMORY_ACCESS, &[bits]) => self.ready[0] = bits & 0x20 != 0,
            (PIXEL_FORMAT, &[bits]) => self.ready[1] = bits & 7 == 5,
            (WRITE, &[high, low]) => {
                self.arguments.clear();
                return self.pixel([high, low]);
            }
            _ => {}
        }
        Ok(())
    }

    fn pixel(&mut self, bytes: [u8; rgb565::BYTES]) -> Result<(), String> {
        if self.ready != [true; 2] {
            return Err("pixels before the display is turned and set to 16 bits".into());
        }
        let (x, y) = self.next;
        if y > self.rows[1] {
            return Err(format!("a pixel beyond row {}", self.rows[1]));
        }
        let at = (usize::from(y) * usize::from(DISPLAY.0) + usize::from(x)) * rgb565::BYTES;
        self.memory[at..at + rgb565::BYTES].copy_from_slice(&bytes);
        self.next = if x < self.columns[1] { (x + 1, y) } else { (self.columns[0], y + 1) };
        Ok(())
    }
}

/// First and last, within the display.
fn range([a, b, c, d]: [u8; 4], side: u16) -> Result<[u16; 2], String> {
    let (first, last) = (u16::from_be_bytes([a, b]), u16::from_be_bytes([c, d]));
    if first <= last && last < side {
        Ok([first, last])
    } else {
        Err(format!("a window from {first} to {last} of {side}"))
    }
}

/// The picture in the upper left corner of black, and nothing else.
fn compare(job: &Job, memory: &[u8]) -> Result<(), String> {
    let line = |width: u16| usize::from(width) * rgb565::BYTES;
    let mut expected = vec![0; memory.len()];
    let mut picture = vec![0; line(job.width) * usize::from(job.height)];
    rgb565::draw(job, &mut picture);
    for (row, traced) in
        expected.chunks_exact_mut(line(DISPLAY.0)).zip(picture.chunks_exact(line(job.width)))
    {
        row[..traced.len()].copy_from_slice(traced);
    }
    let wrong: Vec<_> = (0..memory.len()).filter(|&i| memory[i] != expected[i]).collect();
    match wrong.first() {
        None => Ok(()),
        Some(&i) => Err(format!(
            "{} bytes differ; the first at ({}, {})",
            wrong.len(),
            i % line(DISPLAY.0) / rgb565::BYTES,
            i / line(DISPLAY.0)
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::{DATA, Panel, SET_CLEAR, write};

    #[test]
    fn a_pixel_arrives_where_the_window_is() {
        let mut panel = Panel::new();
        assert!(panel.take(DATA, 0).is_err(), "not selected");
        panel.take(SET_CLEAR, 1 << 20).unwrap();
        let mut send = |command: u32, arguments: &[u32]| {
            panel.take(SET_CLEAR, 1 << 19)?;
            panel.take(DATA, command)?;
            panel.take(SET_CLEAR, 1 << 3)?;
            arguments.iter().try_for_each(|&byte| panel.take(DATA, byte))
        };
        assert!(send(0x2C, &[1, 2]).is_err(), "not set up");
        send(0x36, &[0x28]).unwrap();
        send(0x3A, &[0x55]).unwrap();
        assert!(send(0x2A, &[1, 0x40, 1, 0x40]).is_err(), "beyond the display");
        send(0x2A, &[0, 2, 0, 2]).unwrap();
        send(0x2B, &[0, 1, 0, 1]).unwrap();
        assert!(send(0x2C, &[7, 8, 9, 9]).is_err(), "more than the window holds");
        assert_eq!(panel.memory[(320 + 2) * 2..][..3], [7, 8, 0xA5]);
    }

    #[test]
    fn lines_of_the_trace() {
        let line =
            "memory_region_ops_write cpu 0 mr 0x5 addr 0x4001300c value 0x2a size 4 name 'x'";
        assert_eq!(write(line), Some((DATA, 0x2A)));
        assert_eq!(write("something else"), None);
    }
}

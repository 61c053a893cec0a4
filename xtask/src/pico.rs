//! The Raspberry Pi Pico, emulated: its image runs from reset, boot ROM first, and a model of the
//! display receives the picture, which is compared with the host's.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::process::Command;

use embedded_graphics::pixelcolor::raw::RawU16;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use whitted_demo::job::{ArithName, Job, SceneName};
use whitted_demo::rgb565;

use crate::elf;
use crate::machine::{self, Record};
use crate::report::Report;
use crate::setup;
use crate::shell::{boards, output};

const TARGET: &str = "thumbv6m-none-eabi";
/// The display of the board's default features.
const DISPLAY: (u16, u16) = (240, 240);
/// What the checks draw: the emulator does some ten million cycles a second, if nothing else runs.
const SMALL: (u16, u16) = (60, 45);
/// How frames get to the display.
const WAYS: [&str; 3] = ["bands", "graphics", "trace"];
/// Sending by DMA may add this to tracing.
const SENDING: f64 = 0.03;

const USAGE: &str = "\
cargo xtask emulate pico [--scene NAME] [-o FILE.png] [--size WIDTHxHEIGHT|full] [--way WAY]
    scenes are showcase, limit, raystones and ftb; the size is 60x45 unless given, at most the
    display's; ways are bands (by DMA, the default), graphics (embedded-graphics) and trace
    (nothing is sent)";

/// A frame to emulate.
struct Order<'a> {
    job: Job,
    way: &'a str,
}

/// What came of it.
struct Frame {
    /// The display's memory.
    memory: Vec<u8>,
    cycles: u64,
    /// The emulator's line.
    line: String,
}

/// The command: draws a scene, writes what the display shows, compares, and says what it took.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let mut scene = SceneName::Showcase;
    let (mut size, mut way, mut file) = (SMALL, WAYS[0], None);
    let (pairs, rest) = words.as_chunks::<2>();
    if !rest.is_empty() {
        return Err(USAGE.into());
    }
    for &[option, value] in pairs {
        match option {
            "--scene" => {
                scene = *SceneName::ALL.iter().find(|s| s.name() == value).ok_or(USAGE)?;
            }
            "--size" if value == "full" => size = DISPLAY,
            "--size" => {
                let (width, height) = value.split_once('x').ok_or(USAGE)?;
                let side = |text: &str| text.parse::<u16>().ok().filter(|&n| n > 0).ok_or(USAGE);
                size = (side(width)?, side(height)?);
                if size.0 > DISPLAY.0 || size.1 > DISPLAY.1 {
                    return Err(USAGE.into());
                }
            }
            "--way" => way = *WAYS.iter().find(|&&way| way == value).ok_or(USAGE)?,
            "-o" => file = Some(PathBuf::from(value)),
            _ => return Err(USAGE.into()),
        }
    }
    setup::run()?;
    let image = build()?;
    let order = Order { job: job(scene, size), way };
    let frame = emulate(&image, &order)?;
    if let Some(file) = file {
        png(&file, &frame.memory)?;
    }
    let record = Record::new(&frame.line);
    let pixels = u64::from(size.0) * u64::from(size.1);
    println!(
        "{} cycles, {} a pixel, {:.1} ms at 125 MHz (emulated, without flash-cache misses)",
        frame.cycles,
        frame.cycles / pixels,
        frame.cycles as f64 / 125e3
    );
    println!(
        "{} bytes sent; {} bytes of RAM free; {} cycles from reset to the frame",
        record.get("bytes")?,
        record.get("stack_free")?,
        record.get("boot")?
    );
    let sizes = elf::sizes(&image)?;
    println!("image: {} bytes of code, {} of constants", sizes.text, sizes.constants);
    compare(&order, &frame)?;
    if way != "trace" {
        println!("the picture is the host's, to the bit");
    }
    Ok(())
}

/// The checks: a small frame by either way is the host's, and DMA hides the sending.
pub(crate) fn check(report: &mut Report) {
    let Some(image) = report.check("Pico: the image is built", build) else { return };
    let job = job(SceneName::Limit, SMALL);
    let mut cycles = Vec::new();
    for way in WAYS {
        let name = format!("Pico (rp2040py): {job} by {way}");
        cycles.extend(report.check(&name, || {
            let order = Order { job, way };
            let frame = emulate(&image, &order)?;
            compare(&order, &frame)?;
            Ok(frame.cycles)
        }));
    }
    if let &[bands, _, trace] = cycles.as_slice() {
        report.check("Pico: DMA sends while the core traces", || {
            let more = bands as f64 / trace as f64 - 1.0;
            let line =
                format!("{bands} cycles, of which tracing {trace}: {:.2} % more", 100.0 * more);
            println!("     {line}");
            if more <= SENDING { Ok(()) } else { Err(line) }
        });
    }
}

fn job(scene: SceneName, (width, height): (u16, u16)) -> Job {
    Job { scene, arith: ArithName::Fixed, width, height }
}

fn build() -> Result<PathBuf, String> {
    machine::build(&boards().join("pico"), "pico", TARGET)
}

/// Runs the image until the frame is drawn.
fn emulate(image: &Path, order: &Order<'_>) -> Result<Frame, String> {
    let dump = image.with_extension("rgb565");
    // A picture from before proves nothing.
    let _ = std::fs::remove_file(&dump);
    let mut python = Command::new(setup::python()?);
    // Nothing is to be written into the sources.
    python.arg("-B").arg(boards().join("pico/emulate/emulate.py")).arg(image);
    python.arg(format!("{} {}", order.job, order.way));
    python.args([DISPLAY.0, DISPLAY.1, 0, 0].map(|n| n.to_string())).arg(&dump);
    let text = output(&mut python)?;
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("frame "))
        .ok_or("the emulator says nothing of a frame")?
        .to_owned();
    let cycles = Record::new(&line).number("cycles")?;
    let memory = std::fs::read(&dump).map_err(|error| format!("{}: {error}", dump.display()))?;
    Ok(Frame { memory, cycles, line })
}

/// What the display is to hold: the picture in the upper left corner of black, or just that.
fn expected(order: &Order<'_>) -> Vec<u8> {
    let Job { scene, width, height, .. } = order.job;
    let line = |width: u16| usize::from(width) * rgb565::BYTES;
    let mut memory = vec![0; line(DISPLAY.0) * usize::from(DISPLAY.1)];
    if order.way != "trace" {
        let mut picture = vec![0; line(width) * usize::from(height)];
        rgb565::draw(scene, width, height, &mut picture);
        let rows = memory.chunks_exact_mut(line(DISPLAY.0));
        for (row, traced) in rows.zip(picture.chunks_exact(line(width))) {
            row[..traced.len()].copy_from_slice(traced);
        }
    }
    memory
}

fn compare(order: &Order<'_>, frame: &Frame) -> Result<(), String> {
    let expected = expected(order);
    let (here, _) = expected.as_chunks::<{ rgb565::BYTES }>();
    let (there, _) = frame.memory.as_chunks::<{ rgb565::BYTES }>();
    if here.len() != there.len() {
        return Err(format!("{} pixels instead of {}", there.len(), here.len()));
    }
    let wrong: Vec<_> = (0..here.len()).filter(|&i| here[i] != there[i]).collect();
    match wrong.first() {
        None => Ok(()),
        Some(&i) => Err(format!(
            "{} of {} pixels differ; the first, at ({}, {}), is {:02x?}, on the host {:02x?}",
            wrong.len(),
            here.len(),
            i % usize::from(DISPLAY.0),
            i / usize::from(DISPLAY.0),
            there[i],
            here[i]
        )),
    }
}

/// Writes the display's memory as a PNG.
fn png(path: &Path, memory: &[u8]) -> Result<(), String> {
    let rgb: Vec<u8> = memory
        .as_chunks::<{ rgb565::BYTES }>()
        .0
        .iter()
        .flat_map(|&bytes| {
            let color = Rgb888::from(Rgb565::from(RawU16::new(u16::from_be_bytes(bytes))));
            [color.r(), color.g(), color.b()]
        })
        .collect();
    let place = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let file = File::create(path).map_err(|error| place(&error))?;
    let (width, height) = (u32::from(DISPLAY.0), u32::from(DISPLAY.1));
    let mut encoder = png::Encoder::new(BufWriter::new(file), width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(&rgb).and_then(|()| writer.finish()))
        .map_err(|error| place(&error))
}

#[cfg(test)]
mod tests {
    use super::{DISPLAY, Frame, Order, WAYS, compare, expected, job};
    use whitted_demo::job::SceneName;

    #[test]
    fn one_wrong_bit_is_found() {
        let order = Order { job: job(SceneName::Limit, (8, 6)), way: WAYS[0] };
        let mut frame = Frame { memory: expected(&order), cycles: 0, line: String::new() };
        assert!(frame.memory.iter().any(|&byte| byte != 0));
        assert_eq!(compare(&order, &frame), Ok(()));
        // The second pixel of the second row.
        frame.memory[(usize::from(DISPLAY.0) + 1) * 2 + 1] ^= 1;
        let error = compare(&order, &frame).unwrap_err();
        assert!(error.starts_with("1 of 57600 pixels differ; the first, at (1, 1)"), "{error}");
        frame.memory.pop();
        frame.memory.pop();
        assert!(compare(&order, &frame).is_err());
    }
}

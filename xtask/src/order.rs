//! What the Picos' emulators are to draw, what comes of it, and whether it is the host's picture.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use embedded_graphics::pixelcolor::raw::RawU16;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use whitted::frame::Sampling;
use whitted_demo::job::{ArithName, Job, SceneName};
use whitted_demo::rgb565;

/// A display that the board is built for.
pub(crate) struct Display {
    /// As the board's feature.
    pub(crate) name: &'static str,
    /// Pixels across and down.
    pub(crate) size: (u16, u16),
    /// Where they begin in the controller's memory.
    pub(crate) offset: (u16, u16),
}

/// All of them, the one of the default features first.
pub(crate) const DISPLAYS: [Display; 4] = [
    Display { name: "st7789-240x240", size: (240, 240), offset: (0, 0) },
    Display { name: "st7789-240x320", size: (240, 320), offset: (0, 0) },
    Display { name: "st7735s-160x80", size: (160, 80), offset: (1, 26) },
    Display { name: "ili9341-320x240", size: (320, 240), offset: (0, 0) },
];
/// What the checks draw: the emulator does some ten million cycles a second, if nothing else runs.
pub(crate) const SMALL: (u16, u16) = (60, 45);
/// How frames get to the display.
pub(crate) const WAYS: [&str; 3] = ["bands", "graphics", "trace"];

/// A frame to emulate.
pub(crate) struct Order<'a> {
    pub(crate) display: &'a Display,
    pub(crate) job: Job,
    pub(crate) way: &'a str,
    /// SPI stands still after so many bytes of the frame, once.
    pub(crate) stick: Option<u32>,
}

/// What came of it.
pub(crate) struct Frame {
    /// The display's memory.
    pub(crate) memory: Vec<u8>,
    /// Between the edges of the mark.
    pub(crate) cycles: u64,
    /// Sent in between.
    pub(crate) bytes: u64,
    /// Bytes of RAM that the stack has never touched.
    pub(crate) free: u64,
    /// Cycles from reset to the mark.
    pub(crate) boot: u64,
    /// What the firmware logged.
    pub(crate) log: Vec<String>,
}

/// The words of a command.
pub(crate) struct Options {
    pub(crate) display: &'static Display,
    pub(crate) job: Job,
    pub(crate) way: &'static str,
    file: Option<PathBuf>,
}

impl Options {
    /// Reads them; those that are not known here go to `other`, which knows them or doesn't.
    pub(crate) fn read(
        words: &[&str],
        usage: &str,
        mut other: impl FnMut(&str, &str) -> bool,
    ) -> Result<Self, String> {
        let mut scene = SceneName::Showcase;
        let (mut size, mut way, mut file, mut display) =
            (Some(SMALL), WAYS[0], None, &DISPLAYS[0]);
        let (pairs, rest) = words.as_chunks::<2>();
        if !rest.is_empty() {
            return Err(usage.into());
        }
        for &[option, value] in pairs {
            match option {
                "--scene" => {
                    scene = *SceneName::ALL.iter().find(|s| s.name() == value).ok_or(usage)?;
                }
                "--size" if value == "full" => size = None,
                "--size" => {
                    let (width, height) = value.split_once('x').ok_or(usage)?;
                    let side =
                        |text: &str| text.parse::<u16>().ok().filter(|&n| n > 0).ok_or(usage);
                    size = Some((side(width)?, side(height)?));
                }
                "--display" => display = DISPLAYS.iter().find(|d| d.name == value).ok_or(usage)?,
                "--way" => way = *WAYS.iter().find(|&&way| way == value).ok_or(usage)?,
                "-o" => file = Some(PathBuf::from(value)),
                _ if other(option, value) => {}
                _ => return Err(usage.into()),
            }
        }
        let size = size.unwrap_or(display.size);
        if size.0 > display.size.0 || size.1 > display.size.1 {
            return Err(usage.into());
        }
        Ok(Self { display, job: job(scene, size), way, file })
    }

    /// Writes what the display shows, if it is wanted, says what it took at so many megahertz, and
    /// compares.
    pub(crate) fn report(&self, order: &Order<'_>, frame: &Frame, mhz: f64) -> Result<(), String> {
        if let Some(file) = &self.file {
            png(file, self.display, &frame.memory)?;
        }
        let pixels = u64::from(order.job.width) * u64::from(order.job.height);
        println!(
            "{} cycles, {} a pixel, {:.1} ms at {mhz} MHz (emulated, without flash-cache misses)",
            frame.cycles,
            frame.cycles / pixels,
            frame.cycles as f64 / (1e3 * mhz)
        );
        println!(
            "{} bytes sent; {} bytes of RAM free; {} cycles from reset to the frame",
            frame.bytes, frame.free, frame.boot
        );
        compare(order, frame)?;
        if order.way != "trace" {
            println!("the picture is the host's, to the bit");
        }
        Ok(())
    }
}

/// A scene in fixed point, one ray a pixel.
pub(crate) fn job(scene: SceneName, (width, height): (u16, u16)) -> Job {
    Job { scene, arith: ArithName::Fixed, width, height, sampling: Sampling::Center }
}

/// What the display is to hold: the picture in the upper left corner of black, or just that.
fn expected(order: &Order<'_>) -> Vec<u8> {
    let Job { scene, arith, width, height, .. } = order.job;
    let line = |width: u16| usize::from(width) * rgb565::BYTES;
    let (across, down) = order.display.size;
    let mut memory = vec![0; line(across) * usize::from(down)];
    if order.way != "trace" {
        let mut picture = vec![0; line(width) * usize::from(height)];
        rgb565::draw_in(arith, scene, width, height, &mut picture);
        let rows = memory.chunks_exact_mut(line(across));
        for (row, traced) in rows.zip(picture.chunks_exact(line(width))) {
            row[..traced.len()].copy_from_slice(traced);
        }
    }
    memory
}

pub(crate) fn compare(order: &Order<'_>, frame: &Frame) -> Result<(), String> {
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
            i % usize::from(order.display.size.0),
            i / usize::from(order.display.size.0),
            there[i],
            here[i]
        )),
    }
}

/// Writes the display's memory as a PNG.
fn png(path: &Path, display: &Display, memory: &[u8]) -> Result<(), String> {
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
    let (width, height) = (u32::from(display.size.0), u32::from(display.size.1));
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
    use super::{DISPLAYS, Frame, Order, WAYS, compare, expected, job};
    use whitted_demo::job::SceneName;

    #[test]
    fn one_wrong_bit_is_found() {
        let display = &DISPLAYS[0];
        let order =
            Order { display, job: job(SceneName::Limit, (8, 6)), way: WAYS[0], stick: None };
        let memory = expected(&order);
        let mut frame = Frame { memory, cycles: 0, bytes: 0, free: 0, boot: 0, log: Vec::new() };
        assert!(frame.memory.iter().any(|&byte| byte != 0));
        assert_eq!(compare(&order, &frame), Ok(()));
        // The second pixel of the second row.
        frame.memory[(usize::from(display.size.0) + 1) * 2 + 1] ^= 1;
        let error = compare(&order, &frame).unwrap_err();
        assert!(error.starts_with("1 of 57600 pixels differ; the first, at (1, 1)"), "{error}");
        frame.memory.pop();
        frame.memory.pop();
        assert!(compare(&order, &frame).is_err());
    }
}

//! A scene that lies by itself in the emulated Pico's flash, as a blob: what its display shows is what the host draws
//! of the same bytes, damaged ones included.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use embedded_graphics::framebuffer::{Framebuffer, buffer_size};
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::pixelcolor::raw::{BigEndian, RawU16};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use whitted::blob::Blob;
use whitted::math::Fixed;
use whitted_demo::rgb565::BYTES;
use whitted_demo::{fault, flash};
use whitted_host::bake::{Baked, Thrift};
use whitted_host::{document, read};

use crate::elf;
use crate::machine::{self, Record};
use crate::report::Report;
use crate::setup;
use crate::shell::{boards, output, root};

const TARGET: &str = "thumbv6m-none-eabi";
/// The board as it is built: a display and its log.
const FEATURES: &str = "st7789-240x240,rtt";
/// The display's pixels, either way; the blob's camera is for pictures of this shape.
const DISPLAY: u32 = 240;
/// Those that are drawn.
const SIDE: u32 = 48;
/// A picture of fewer colours says little.
const FEWEST_COLORS: usize = 50;

/// The display's memory: big-endian pixels.
type Memory = Framebuffer<
    Rgb565,
    RawU16,
    BigEndian,
    { DISPLAY as usize },
    { DISPLAY as usize },
    { buffer_size::<Rgb565>(DISPLAY as usize, DISPLAY as usize) },
>;

/// How many colours are in it.
fn colors(memory: &Memory) -> usize {
    memory.data().as_chunks::<BYTES>().0.iter().collect::<BTreeSet<_>>().len()
}

/// The firmware with a whole scene, a damaged one, and none.
pub(crate) fn check(report: &mut Report) {
    let built = report.check("Pico, scene in flash: the image is built", || {
        let more = ["--no-default-features", "--features", FEATURES];
        let image = machine::build_with(&boards().join("pico"), "flash", TARGET, &more)?;
        let sizes = elf::sizes(&image)?;
        println!("     {} bytes of code, {} of constants", sizes.text, sizes.constants);
        Ok(image)
    });
    let Some(image) = built else { return };
    let balls = root().join("../shared/scenes/spd/balls.nff");
    let (name, scene) = if balls.exists() {
        ("SPD's balls, 7,382 shapes", balls)
    } else {
        println!("     SPD's scenes are not beside the repository: the showcase is drawn instead");
        ("showcase", root().join("host/scenes/showcase.toml"))
    };
    let Some(blob) = report.check(&format!("Pico, scene in flash: {name}, baked"), || bake(&scene))
    else {
        return;
    };
    report.check(&format!("Pico, scene in flash (rp2040py): {name}, {SIDE}x{SIDE}"), || {
        run(&image, &blob)
    });
    let mut damaged = blob.clone();
    if let Some(byte) = damaged.get_mut(blob.len() / 2) {
        *byte ^= 0xFF;
    }
    let cases = [("a byte changed", damaged), ("erased", vec![0xFF; blob.len()])];
    for (what, bytes) in cases {
        report.check(&format!("Pico, scene in flash (rp2040py): {what}"), || run(&image, &bytes));
    }
}

/// A scene's blob.
fn bake(scene: &Path) -> Result<Vec<u8>, String> {
    let document = read::read(scene).map_err(|error| error.to_string())?;
    let size = document::Size { width: DISPLAY, height: DISPLAY };
    let blob = Baked::<Fixed>::with(&document, Thrift::Flash).and_then(|baked| baked.blob(size));
    let bytes = blob.map_err(|flaw| flaw.of(scene).to_string())?.bytes;
    println!("     {} bytes", bytes.len());
    Ok(bytes)
}

/// Runs the image with these bytes in flash, and compares picture and log with what they are here.
fn run(image: &Path, bytes: &[u8]) -> Result<(), String> {
    let said = emulate(image, bytes)?;
    let line = said.lines().find_map(|line| line.strip_prefix("frame "));
    let record = Record::new(line.ok_or("the emulator says nothing of a frame")?);
    let free = record.number("stack_free")?;
    if free == 0 {
        return Err("the stack has reached the statics".into());
    }
    let memory = elf::symbol(image, "_stack_start")?.0 - elf::symbol(image, "__sheap")?.0;
    let stack = memory.saturating_sub(free);
    println!("     {} cycles, stack {stack} bytes", record.get("cycles")?);
    let log: Vec<&str> = said.lines().filter_map(|line| line.strip_prefix("log ")).collect();
    log.iter().for_each(|line| println!("     {line}"));

    let mut here = Memory::new();
    let area = Rectangle::new(Point::zero(), Size::new_equal(SIDE));
    let error = Blob::<Fixed>::open(bytes).err();
    let Ok(()) = match error {
        None => flash::show(bytes, &mut here.cropped(&area), |_| {}),
        Some(_) => fault::pattern(&mut here.cropped(&area)),
    };
    let errors: Vec<_> =
        log.iter().filter_map(|line| line.strip_prefix("scene in flash: ")).collect();
    let wanted: Vec<_> = error.iter().map(ToString::to_string).collect();
    if errors != wanted {
        return Err(format!("the log has {errors:?}, on the host {wanted:?}"));
    }
    if error.is_none() && colors(&here) < FEWEST_COLORS {
        return Err(format!("only {} colours", colors(&here)));
    }
    let there = fs::read(dump(image)).map_err(|error| error.to_string())?;
    let wrong = there.iter().zip(here.data()).filter(|(there, here)| there != here).count();
    if there.len() == here.data().len() && wrong == 0 {
        Ok(())
    } else {
        Err(format!("{wrong} bytes of {} differ", here.data().len()))
    }
}

/// Where the emulator leaves the display's memory.
fn dump(image: &Path) -> PathBuf {
    image.with_extension("rgb565")
}

/// What the emulator says when the frame is drawn. The flash isn't erased meanwhile: the scene is in it, and the tracer.
fn emulate(image: &Path, bytes: &[u8]) -> Result<String, String> {
    let scene = image.with_extension("bin");
    fs::write(&scene, bytes).map_err(|error| format!("{}: {error}", scene.display()))?;
    // A picture from before proves nothing.
    let _ = fs::remove_file(dump(image));
    let mut python = Command::new(setup::python()?);
    python.arg("-B").arg(boards().join("pico/emulate/emulate.py"));
    python.arg("--scene").arg(scene).arg(image).arg(format!("{SIDE}x{SIDE}"));
    output(python.args(["240", "240", "0", "0", "240", "320"]).arg(dump(image)))
}

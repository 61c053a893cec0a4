//! The Raspberry Pi Pico, emulated: its image runs from reset, boot ROM first, and a model of the
//! display receives the picture, which is compared with the host's.

use std::path::{Path, PathBuf};
use std::process::Command;

use whitted_demo::job::{Job, SceneName};
use whitted_demo::rgb565;

use crate::cores;
use crate::elf;
use crate::firmware::TWO_CORES;
use crate::machine::{self, Record};
use crate::order::{DISPLAYS, Display, Frame, Options, Order, SMALL, WAYS, compare, job};
use crate::report::Report;
use crate::setup;
use crate::shell::{boards, output};

const TARGET: &str = "thumbv6m-none-eabi";
/// What they draw twice.
const TINY: (u16, u16) = (30, 20);
/// How frames get to the display.
const WAYS: [&str; 3] = ["bands", "graphics", "trace"];
/// Sending by DMA may add this to tracing.
const SENDING: f64 = 0.03;

/// The chip's clock.
const MHZ: f64 = 125.0;

const USAGE: &str = "\
cargo xtask emulate pico [--scene NAME] [-o FILE.png] [--size WIDTHxHEIGHT|full] [--way WAY]
                         [--display DISPLAY]
    scenes are showcase, limit, raystones and ftb; the size is 60x45 unless given, at most the
    display's; ways are bands (by DMA, the default), graphics (embedded-graphics) and trace
    (nothing is sent); displays are st7789-240x240, the default, st7789-240x320, st7735s-160x80
    and ili9341-320x240";

/// The command: draws a scene, writes what the display shows, compares, and says what it took.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let options = Options::read(words, USAGE, |_, _| false)?;
    setup::run()?;
    let image = build(options.display)?;
    let Options { display, job, way, .. } = options;
    let order = Order { display, job, way, stick: None };
    let frame = emulate(&image, &order)?;
    let sizes = elf::sizes(&image)?;
    println!("image: {} bytes of code, {} of constants", sizes.text, sizes.constants);
    options.report(&order, &frame, MHZ)
}

/// The cycles that the firmware of the first display spends tracing, on one core.
pub(crate) fn cycles(jobs: &[Job]) -> Result<Vec<u64>, String> {
    let display = &DISPLAYS[0];
    let image = build(display)?;
    let traced = |&job: &Job| {
        let order = Order { display, job, way: WAYS[2], stick: None };
        emulate(&image, &order).map(|frame| frame.cycles)
    };
    jobs.iter().map(traced).collect()
}

/// The checks: a small frame by either way is the host's, on displays of two kinds, and DMA hides
/// the sending.
pub(crate) fn check(report: &mut Report) {
    let job = job(SceneName::Limit, SMALL);
    let mut cycles = Vec::new();
    for (display, ways) in [(&DISPLAYS[0], &WAYS[..]), (&DISPLAYS[2], &WAYS[..1])] {
        let name = format!("Pico with {}: the image is built", display.name);
        let Some(image) = report.check(&name, || build(display)) else { continue };
        for &way in ways {
            let name = format!("Pico with {} (rp2040py): {job} by {way}", display.name);
            cycles.extend(report.check(&name, || {
                let order = Order { display, job, way, stick: None };
                let frame = emulate(&image, &order)?;
                compare(&order, &frame)?;
                Ok(frame.cycles)
            }));
        }
        if display.name == DISPLAYS[0].name {
            faults(report, display, &image);
        }
    }
    report.check(&format!("Pico (rp2040-emu): {job} on both cores"), || both_cores(&job));
    report.check(&format!("Pico on embassy (rp2040py): {job}"), || on_embassy(job));
    // Of the first display; all or none.
    if let &[bands, _, trace, _] = cycles.as_slice() {
        report.check("Pico: DMA sends while the core traces", || {
            let more = bands as f64 / trace as f64 - 1.0;
            let line =
                format!("{bands} cycles, of which tracing {trace}: {:.2} % more", 100.0 * more);
            println!("     {line}");
            if more <= SENDING { Ok(()) } else { Err(line) }
        });
    }
}

/// The image on embassy, on the same display: the same bits. Its cycles stand beside the other's.
fn on_embassy(job: Job) -> Result<(), String> {
    let image = machine::build_with(&boards().join("pico-async"), "pico-async", TARGET, &[])?;
    let order = Order { display: &DISPLAYS[0], job, way: WAYS[0], stick: None };
    let frame = emulate(&image, &order)?;
    println!("     {} cycles", frame.cycles);
    compare(&order, &frame)
}

/// SPI stands still once: among the commands that open the window, and among a band's pixels. The
/// log says so, and the frame that is drawn again is whole.
fn faults(report: &mut Report, display: &Display, image: &Path) {
    let job = job(SceneName::Limit, TINY);
    for (what, stick) in [("a command", 3), ("the pixels", 400)] {
        report.check(&format!("Pico (rp2040py): SPI stands still in {what}"), || {
            let order = Order { display, job, way: WAYS[0], stick: Some(stick) };
            let frame = emulate(image, &order)?;
            let wanted = "limit: SPI stands still; the frame is drawn again";
            if frame.log.first().map(String::as_str) != Some(wanted) {
                return Err(format!("the log begins with {:?}", frame.log.first()));
            }
            println!("     {wanted}");
            compare(&order, &frame)
        });
    }
}

/// Two cores against one: the same bits, and how much sooner.
fn both_cores(job: &Job) -> Result<(), String> {
    // Where an image is doesn't depend on its features: each is run before the next is built.
    let run = |features| cores::trace(&build_with(&DISPLAYS[0], features)?, job);
    let one = run("one-core")?;
    let two = run("rtt")?;
    let mut picture = vec![0; usize::from(job.width) * usize::from(job.height) * rgb565::BYTES];
    rgb565::draw(job.scene, job.width, job.height, &mut picture);
    let sum = rgb565::sum(0, &picture);
    if one.sum != sum || two.sum != sum {
        return Err(format!("the host's pixels sum to {sum:#x}, {one:#x?} and {two:#x?}"));
    }
    let busier = two.cycles[0].max(two.cycles[1]);
    let ratio = one.cycles[0] as f64 / busier as f64;
    println!("     one core {} cycles, two {:?}: {ratio:.2} times", one.cycles[0], two.cycles);
    if ratio >= TWO_CORES { Ok(()) } else { Err(format!("only {ratio:.2} times as fast")) }
}

fn build(display: &Display) -> Result<PathBuf, String> {
    build_with(display, "rtt,one-core")
}

fn build_with(display: &Display, more: &str) -> Result<PathBuf, String> {
    let features = format!("{},{more}", display.name);
    let more = ["--no-default-features", "--features", &features];
    machine::build_with(&boards().join("pico"), "pico", TARGET, &more)
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
    let Display { size, offset, .. } = order.display;
    python.args([size.0, size.1, offset.0, offset.1].map(|n| n.to_string())).arg(&dump);
    python.args(order.stick.map(|bytes| bytes.to_string()));
    let text = output(&mut python)?;
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("frame "))
        .ok_or("the emulator says nothing of a frame")?;
    let record = Record::new(line);
    let [cycles, bytes, free, boot] = ["cycles", "bytes", "stack_free", "boot"]
        .map(|key| record.number(key));
    let memory = std::fs::read(&dump).map_err(|error| format!("{}: {error}", dump.display()))?;
    let log = text.lines().filter_map(|line| Some(line.strip_prefix("log ")?.to_owned())).collect();
    Ok(Frame { memory, cycles: cycles?, bytes: bytes?, free: free?, boot: boot?, log })
}


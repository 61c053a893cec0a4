//! The display's picture, as the emulator dumps it, against the host's.

use std::convert::Infallible;
use std::path::Path;

use embedded_graphics::pixelcolor::Gray4;
use embedded_graphics::prelude::*;
use whitted_demo::oled::{self, SIZE};

const WIDTH: usize = SIZE.width as usize;
const HEIGHT: usize = SIZE.height as usize;
/// The emulator shows each pixel as a square of this side.
const SCALE: usize = 4;
/// A grey of 0 to 15 is shown as 0 to 255.
const STEP: u8 = 17;
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

/// Compares a screen dump with the picture drawn here, pixel by pixel.
pub(crate) fn compare(dump: &Path) -> Result<(), String> {
    let dump = std::fs::read(dump).map_err(|error| format!("{}: {error}", dump.display()))?;
    let shown = greys(&dump)?;
    let mut here = Memory([[0; WIDTH]; HEIGHT]);
    let Ok(()) = oled::draw(&mut here);

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
    let found = (0..16).filter(|grey| pixels().any(|(x, y)| shown[y][x] == *grey)).count();
    if found < FEWEST_GREYS {
        return Err(format!("only {found} greys in the picture: too few to know them apart"));
    }
    Ok(())
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

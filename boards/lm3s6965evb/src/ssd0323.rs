//! Solomon Systech SSD0323, a controller for OLED displays of 128×80 pixels in 16 greys; this
//! board's display has 64 rows.
//!
//! A window of columns and rows is chosen by two commands, then data fill it row by row. A byte
//! holds two neighbouring pixels, the left one in the upper half, so a window is a whole number
//! of column *pairs*. Nothing here keeps a picture, so where an area begins or ends in the middle
//! of a pair, the pixel that completes the pair becomes black. Draw at even columns.

use embedded_graphics::pixelcolor::{Gray4, GrayColor};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::SpiDevice;

/// Pixels in a row.
const WIDTH: u32 = 128;
/// Rows.
const HEIGHT: u32 = 64;

/// Chooses the first and last pair of columns.
const COLUMNS: u8 = 0x15;
/// Chooses the first and last row.
const ROWS: u8 = 0x75;
/// Chooses the order of pixels; its bits follow.
const REMAP: u8 = 0xA0;
const DISPLAY_ON: u8 = 0xAF;

/// What can go wrong: the bus or the pin.
#[derive(Debug)]
pub(crate) enum Error<S, P> {
    Spi(S),
    Pin(P),
}

/// The display behind an SPI device and a data/command pin.
pub(crate) struct Ssd0323<S, P> {
    spi: S,
    data_command: P,
}

impl<S: SpiDevice, P: OutputPin> Ssd0323<S, P> {
    /// Switches the display on.
    pub(crate) fn new(spi: S, data_command: P) -> Result<Self, Error<S::Error, P::Error>> {
        let mut display = Self { spi, data_command };
        // Columns from the left, rows from the top, the left pixel in the upper half, data
        // running along rows; the rows' wiring is split even and odd.
        display.command(&[REMAP, 1 << 6 | 1 << 1])?;
        display.clear(Gray4::BLACK)?;
        display.command(&[DISPLAY_ON])?;
        Ok(display)
    }

    fn command(&mut self, bytes: &[u8]) -> Result<(), Error<S::Error, P::Error>> {
        self.data_command.set_low().map_err(Error::Pin)?;
        self.spi.write(bytes).map_err(Error::Spi)
    }

    /// Opens a window on pairs of columns and on rows, all bounds inclusive.
    fn window(&mut self, pairs: [u8; 2], rows: [u8; 2]) -> Result<(), Error<S::Error, P::Error>> {
        self.command(&[COLUMNS, pairs[0], pairs[1]])?;
        self.command(&[ROWS, rows[0], rows[1]])?;
        self.data_command.set_high().map_err(Error::Pin)
    }
}

impl<S, P> OriginDimensions for Ssd0323<S, P> {
    fn size(&self) -> Size {
        Size::new(WIDTH, HEIGHT)
    }
}

impl<S: SpiDevice, P: OutputPin> DrawTarget for Ssd0323<S, P> {
    type Color = Gray4;
    type Error = Error<S::Error, P::Error>;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Self::Error>
    where
        I: IntoIterator<Item = Pixel<Gray4>>,
    {
        for Pixel(p, color) in pixels {
            self.fill_contiguous(&Rectangle::new(p, Size::new_equal(1)), [color])?;
        }
        Ok(())
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), Self::Error>
    where
        I: IntoIterator<Item = Gray4>,
    {
        let seen = area.intersection(&self.bounding_box());
        let Some(last) = seen.bottom_right() else { return Ok(()) };
        let first = seen.top_left;
        // Within 0 to 127 and 0 to 63, being inside the display.
        let pairs = [(first.x / 2) as u8, (last.x / 2) as u8];
        self.window(pairs, [first.y as u8, last.y as u8])?;

        let mut colors = colors.into_iter();
        let mut bytes = [0; WIDTH as usize / 2];
        let pair_count = usize::from(pairs[1] - pairs[0]) + 1;
        let bytes = &mut bytes[..pair_count];
        for y in area.rows() {
            bytes.fill(0);
            // The caller gives a colour for every pixel of the area, seen or not.
            for x in area.columns() {
                let Some(color) = colors.next() else { break };
                if x >= first.x && x <= last.x {
                    let byte = &mut bytes[(x / 2 - first.x / 2) as usize];
                    *byte |= if x % 2 == 0 { color.luma() << 4 } else { color.luma() };
                }
            }
            if y >= first.y && y <= last.y {
                self.spi.write(bytes).map_err(Error::Spi)?;
            }
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: Gray4) -> Result<(), Self::Error> {
        self.fill_contiguous(area, core::iter::repeat(color))
    }
}

//! What a display shows when there is no picture to show: diagonal stripes, which no scene looks
//! like and which are seen from across a room. The words are for the log.

use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::prelude::*;

/// Pixels across a stripe, measured along a row.
const STRIPE: i32 = 8;

/// Covers the display with stripes, light and dark. It needs no memory and no tracer.
///
/// # Errors
/// The display's.
pub fn pattern<D>(display: &mut D) -> Result<(), D::Error>
where
    D: DrawTarget,
    D::Color: From<BinaryColor>,
{
    let area = display.bounding_box();
    let (light, dark) = (BinaryColor::On.into(), BinaryColor::Off.into());
    let stripes = area.points().map(move |p| {
        // Along a diagonal the sum stays.
        if (p.x + p.y).div_euclid(STRIPE) % 2 == 0 { light } else { dark }
    });
    display.fill_contiguous(&area, stripes)
}

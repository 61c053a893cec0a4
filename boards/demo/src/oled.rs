//! What the display of 16 greys shows.

use embedded_graphics::pixelcolor::Gray4;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;

/// The display's size.
pub const SIZE: Size = Size::new(128, 64);

/// The showcase, for 128×64 pixels in 16 greys.
pub fn picture() -> impl ImageDrawable<Color = Gray4> {
    Gradient
}

struct Gradient;

impl OriginDimensions for Gradient {
    fn size(&self) -> Size {
        SIZE
    }
}

impl ImageDrawable for Gradient {
    type Color = Gray4;

    fn draw<D: DrawTarget<Color = Gray4>>(&self, target: &mut D) -> Result<(), D::Error> {
        let area = self.bounding_box();
        target.fill_contiguous(&area, area.points().map(|p| Gray4::new((p.x / 8 + p.y / 3) as u8)))
    }

    fn draw_sub_image<D: DrawTarget<Color = Gray4>>(
        &self,
        target: &mut D,
        _area: &Rectangle,
    ) -> Result<(), D::Error> {
        self.draw(target)
    }
}

//! Displays, one chosen by feature.

use mipidsi::Builder;
use mipidsi::interface::Interface;
#[cfg(any(feature = "st7735s-160x80", feature = "ili9341-320x240"))]
use mipidsi::options::Rotation;
use mipidsi::options::{ColorInversion, ColorOrder, Orientation};

use crate::chip::hal::fugit::HertzU32;

/// What differs from display to display.
struct Panel {
    /// As it is seen.
    size: (u16, u16),
    /// Unturned, as the controller counts.
    native: (u16, u16),
    /// Where the glass begins in the controller's memory.
    offset: (u16, u16),
    orientation: Orientation,
    inversion: ColorInversion,
    order: ColorOrder,
    /// The clock's rate, which is brought to one that the chip can divide to.
    spi_mhz: u32,
}

#[cfg(any(feature = "st7789-240x240", feature = "st7789-240x320"))]
mod controller {
    pub(crate) use mipidsi::models::ST7789 as Model;
}
#[cfg(feature = "st7735s-160x80")]
mod controller {
    pub(crate) use mipidsi::models::ST7735s as Model;
}
#[cfg(feature = "ili9341-320x240")]
mod controller {
    pub(crate) use mipidsi::models::ILI9341Rgb565 as Model;
}

#[cfg(any(feature = "st7789-240x240", feature = "st7789-240x320"))]
const PANEL: Panel = {
    let size = if cfg!(feature = "st7789-240x320") { (240, 320) } else { (240, 240) };
    Panel {
        size,
        native: size,
        offset: (0, 0),
        orientation: Orientation::new(),
        inversion: ColorInversion::Inverted,
        order: ColorOrder::Rgb,
        spi_mhz: 63,
    }
};

#[cfg(feature = "st7735s-160x80")]
const PANEL: Panel = Panel {
    size: (160, 80),
    native: (80, 160),
    offset: (26, 1),
    orientation: Orientation::new().rotate(Rotation::Deg90),
    inversion: ColorInversion::Inverted,
    order: ColorOrder::Bgr,
    spi_mhz: 16,
};

#[cfg(feature = "ili9341-320x240")]
const PANEL: Panel = Panel {
    size: (320, 240),
    native: (240, 320),
    offset: (0, 0),
    orientation: Orientation::new().rotate(Rotation::Deg90).flip_horizontal(),
    inversion: ColorInversion::Normal,
    order: ColorOrder::Bgr,
    spi_mhz: 32,
};

pub(crate) use controller::Model;

/// The controller.
pub(crate) const MODEL: Model = Model;
/// Pixels across and down.
pub(crate) const SIZE: (u16, u16) = PANEL.size;
/// SPI's clock.
pub(crate) const SPI: HertzU32 = HertzU32::MHz(PANEL.spi_mhz);

/// Tells the driver what it has to know.
pub(crate) fn options<DI: Interface<Word = u8>>(
    builder: Builder<DI, Model, mipidsi::NoResetPin>,
) -> Builder<DI, Model, mipidsi::NoResetPin> {
    let Panel { native, offset, orientation, inversion, order, .. } = PANEL;
    builder
        .display_size(native.0, native.1)
        .display_offset(offset.0, offset.1)
        .orientation(orientation)
        .invert_colors(inversion)
        .color_order(order)
}

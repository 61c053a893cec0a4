//! A scene that lies in flash as a blob. Flash wears out, is written halfway, or holds another
//! version's scene: the bytes are checked before anything is read from them.

use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::prelude::*;
use whitted::blob::{Blob, BlobError};
use whitted::frame::{Dither, Output, Renderer, Settings};
use whitted::math::Fixed;
use whitted::scene::{Light, Material, MaterialSpec, Scene};
use whitted::trace::Work;
use whitted::{Color, Picture};

use crate::fault;
use crate::frame::MAX_DEPTH;

/// The showcase, as the build script baked it.
pub static BLOB: &[u8] = whitted::include_blob!(concat!(env!("OUT_DIR"), "/showcase.bin"));

/// Room in RAM for what a blob doesn't hold ready to use.
const MATERIALS: usize = 16;
const LIGHTS: usize = 4;

/// Draws the scene of a blob over the whole display, dithered. If the bytes are no such scene,
/// `log` gets to know why, and the display shows [`fault::pattern`].
///
/// # Errors
/// The display's.
pub fn show<D>(bytes: &[u8], display: &mut D, log: impl FnOnce(&BlobError)) -> Result<(), D::Error>
where
    D: DrawTarget,
    D::Color: Color + From<BinaryColor>,
{
    match draw(bytes, display) {
        Ok(sent) => sent,
        Err(error) => {
            log(&error);
            fault::pattern(display)
        }
    }
}

/// Not inlined, so that the memory for the scene is free again when stripes are drawn.
#[inline(never)]
fn draw<D>(bytes: &[u8], display: &mut D) -> Result<Result<(), D::Error>, BlobError>
where
    D: DrawTarget,
    D::Color: Color,
{
    let blob = Blob::<Fixed>::open(bytes)?;
    let mut materials = [Material::<Fixed>::new(MaterialSpec::BLACK); MATERIALS];
    let mut lights = [Light::<Fixed>::point([0.0; 3], [0.0; 3]); LIGHTS];
    let scene: Scene<'_, Fixed> = blob.scene(&mut materials, &mut lights)?;
    let camera = blob.camera()?;
    let Size { width, height } = display.bounding_box().size;
    let mut work = Work::<Fixed, MAX_DEPTH>::new();
    let settings = Settings {
        depth: blob.depth().min(MAX_DEPTH as u8),
        ..Settings::new(width as u16, height as u16)
    };
    let renderer = Renderer::new(&scene, &camera, settings, &mut work, &mut [])
        .expect("a display with sides, and a depth that there is memory for");
    let output = Output { dither: Dither::Ordered, ..Output::SRGB };
    let picture = Picture::<_, D::Color, MAX_DEPTH>::from_renderer(renderer, output);
    Ok(Image::new(&picture, Point::zero()).draw(display))
}

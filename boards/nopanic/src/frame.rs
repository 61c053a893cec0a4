//! Every way in which a picture leaves.

use core::hint::black_box as any;

use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor as eg;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use whitted::frame::{self, Dither, Output, Passes, Renderer, Sample, Sampling, Settings, Tone};
use whitted::math::Arithmetic;
use whitted::scene::{Camera, Scene};
use whitted::tally::Tally;
use whitted::trace::{Terms, Tracer, Work};
use whitted::{Color, Picture};

/// All of them, of one scene.
#[inline(never)]
pub(crate) fn render<A: Arithmetic, T: Tally + Copy>(
    scene: &Scene<'_, A>,
    camera: &Camera<A>,
    tally: T,
) -> Option<()> {
    let mut work = any(Work::<A, 5>::default());
    let mut samples = any([Sample::NONE; 400]);
    let settings = Settings {
        depth: any(5),
        sampling: any(Sampling::Corners),
        terms: any(Terms::DIRECT.with(Terms::AMBIENT).without(Terms::NONE)),
        ..Settings::new(any(60), any(60))
    };
    any(settings.sampling.samples(any(60)));
    any(settings.sampling.uses());
    let samples = &mut samples[..];
    let mut renderer =
        Renderer::with_tally(scene, camera, settings, &mut work, any(samples), tally).ok()?;
    any(renderer.settings());
    any(renderer.tally_mut());
    let output =
        any(Output { tone: Tone::SRGB.with_exposure(any(256)), dither: any(Dither::Ordered) });
    for (x, y, radiance) in renderer.scan(any(0)..any(9), any(0)..any(9)) {
        any(output.pixel::<A, frame::Rgb888>(&radiance, x, y));
    }
    any(renderer.scan(any(3)..any(1), any(7)..any(2)).next());
    for pixel in renderer.pixels::<frame::Rgb888>(any(0)..any(9), any(0)..any(9), &output) {
        any(pixel);
    }
    let ray = any(renderer.ray(any(3), any(4)));
    any(renderer.radiance(&ray));
    pixels(&mut renderer, &output);
    let mut passes = any(Passes::new(any(16))).ok()?;
    any(renderer.refine(
        &mut passes,
        &output,
        |_| any(false),
        |block: &frame::Block<frame::Gray8>| {
            any(block.x);
        },
    ));
    any((passes.side(), passes.is_done()));
    let renderer = picture::<A, T, eg::Gray4>(renderer, output)?;
    any(renderer.tally());

    let tracer = any(Tracer::new(scene, any(5)).with_key(any(7)).with_terms(any(Terms::ALL)));
    let mut tally = tally;
    any(tracer.nearest(&ray, &mut work, &mut tally));
    any(tracer.radiance(ray, &mut work, &mut tally));
    let picture = Picture::<A, eg::Gray8, 5>::new(scene, camera, settings, &mut work, &mut []);
    any(picture.ok()?.size());
    let _ = any(Renderer::new(scene, camera, settings, &mut work, &mut []));
    Some(())
}

/// One pixel format each: the tracer is compiled into every one of these calls, and the formats
/// are asked by themselves in [`formats`](crate::numbers::formats).
#[inline(never)]
fn pixels<A: Arithmetic, T: Tally>(renderer: &mut Renderer<'_, A, 5, T>, output: &Output) {
    let mut line = any([frame::Rgb888::default(); 60]);
    if let Some(line) = line.get_mut(..any(60)) {
        renderer.line(any(0), output, line);
    }
    let mut bytes = any([0; 240]);
    if let Some(bytes) = bytes.get_mut(..any(240)) {
        any(renderer.band::<frame::Rgb565>(any(0), output, bytes));
    }
    any((line, bytes));
}

#[inline(never)]
fn picture<'a, A: Arithmetic, T: Tally, C: Color>(
    renderer: Renderer<'a, A, 5, T>,
    output: Output,
) -> Option<Renderer<'a, A, 5, T>> {
    let mut display = Display { size: any(Size::new(240, 240)), color: None };
    let picture = Picture::<A, C, 5, T>::from_renderer(renderer, output);
    let picture = any(picture.with_dither(any(Dither::None)));
    any(Image::new(&picture, any(Point::zero())).draw(&mut display).is_ok());
    let area = Rectangle::new(any(Point::zero()), any(Size::new(9, 9)));
    any(picture.draw_sub_image(&mut display, &area).is_ok());
    if let Ok(mut passes) = Passes::new(any(8)) {
        let place = any(Point::zero());
        any(picture.refine(&mut display, place, &mut passes, |_| any(false)).is_ok());
    }
    any(display.color);
    picture.into_renderer()
}

/// A display that may fail.
struct Display<C> {
    size: Size,
    color: Option<C>,
}

impl<C> OriginDimensions for Display<C> {
    fn size(&self) -> Size {
        self.size
    }
}

impl<C: PixelColor> DrawTarget for Display<C> {
    type Color = C;
    type Error = ();

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), ()> {
        pixels.into_iter().for_each(|Pixel(_, color)| self.color = any(Some(color)));
        any(Err(()))
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), ()> {
        any(area);
        colors.into_iter().for_each(|color| self.color = any(Some(color)));
        any(Err(()))
    }

    fn fill_solid(&mut self, area: &Rectangle, color: C) -> Result<(), ()> {
        any(area);
        self.color = any(Some(color));
        any(Ok(()))
    }
}

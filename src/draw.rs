//! The picture as an image of embedded-graphics: the one file that knows it.

use crate::frame::{Dither, FrameError, Output, Passes, Pixel, Progress, Renderer};
use crate::frame::{Gray1, Gray4, Gray8, Rgb565, Rgb888};
use crate::frame::{Sample, Settings};
use crate::math::Arithmetic;
use crate::scene::{Camera, Scene, SceneRef};
use crate::tally::Tally;
use crate::trace::Work;
use core::cell::Cell;
use core::marker::PhantomData;
use core::ops::Range;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
use embedded_graphics_core::image::ImageDrawable;
use embedded_graphics_core::pixelcolor as eg;
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;

/// A colour of embedded-graphics that a picture can be drawn in.
pub trait Color: PixelColor {
    /// The pixel format behind it.
    type Pixel: Pixel;

    /// The colour of a pixel.
    fn from_pixel(pixel: Self::Pixel) -> Self;
}

impl Color for eg::Rgb565 {
    type Pixel = Rgb565;

    #[inline(always)]
    fn from_pixel(Rgb565(bits): Rgb565) -> Self {
        Self::new((bits >> 11) as u8, (bits >> 5 & 63) as u8, (bits & 31) as u8)
    }
}

impl Color for eg::Rgb888 {
    type Pixel = Rgb888;

    #[inline(always)]
    fn from_pixel(Rgb888([r, g, b]): Rgb888) -> Self {
        Self::new(r, g, b)
    }
}

impl Color for eg::Gray8 {
    type Pixel = Gray8;

    #[inline(always)]
    fn from_pixel(Gray8(level): Gray8) -> Self {
        Self::new(level)
    }
}

impl Color for eg::Gray4 {
    type Pixel = Gray4;

    #[inline(always)]
    fn from_pixel(Gray4(level): Gray4) -> Self {
        Self::new(level)
    }
}

impl Color for eg::BinaryColor {
    type Pixel = Gray1;

    #[inline(always)]
    fn from_pixel(Gray1(level): Gray1) -> Self {
        if level != 0 { Self::On } else { Self::Off }
    }
}

/// A ray-traced picture that embedded-graphics draws like any other image:
/// `Image::new(&picture, position).draw(&mut display)`.
///
/// Only what the target's bounding box shows is traced, in one contiguous fill.
pub struct Picture<'a, A: Arithmetic, C, const MAX_DEPTH: usize, T = (), S = &'a Scene<'a, A>> {
    /// Drawing borrows the picture, tracing changes the working memory: it is taken out for the
    /// time and put back.
    renderer: Cell<Option<Renderer<'a, A, MAX_DEPTH, T, S>>>,
    settings: Settings,
    output: Output,
    color: PhantomData<C>,
}

impl<'a, 's, A, C, const MAX_DEPTH: usize, S, const USES: u64> Picture<'a, A, C, MAX_DEPTH, (), S>
where
    A: Arithmetic,
    C: Color,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    /// A picture of a scene in sRGB. `samples` is memory for
    /// [`Sampling::samples`](crate::frame::Sampling::samples) samples.
    ///
    /// # Errors
    /// A size, depth or memory that doesn't fit.
    pub fn new(
        scene: S,
        camera: &Camera<A>,
        settings: Settings,
        work: &'a mut Work<A, MAX_DEPTH>,
        samples: &'a mut [Sample<A>],
    ) -> Result<Self, FrameError> {
        let renderer = Renderer::new(scene, camera, settings, work, samples)?;
        Ok(Self::from_renderer(renderer, Output::SRGB))
    }
}

impl<'a, 's, A, C, const MAX_DEPTH: usize, T, S, const USES: u64> Picture<'a, A, C, MAX_DEPTH, T, S>
where
    A: Arithmetic,
    C: Color,
    T: Tally,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    /// A picture of what a renderer renders.
    pub fn from_renderer(renderer: Renderer<'a, A, MAX_DEPTH, T, S>, output: Output) -> Self {
        let settings = *renderer.settings();
        Self { renderer: Cell::new(Some(renderer)), settings, output, color: PhantomData }
    }

    /// The same picture with another dither.
    #[must_use]
    pub fn with_dither(mut self, dither: Dither) -> Self {
        self.output.dither = dither;
        self
    }

    /// The renderer, with what it has counted.
    pub fn into_renderer(self) -> Option<Renderer<'a, A, MAX_DEPTH, T, S>> {
        self.renderer.into_inner()
    }

    /// Goes on drawing the picture at `position` from coarse to fine, until it is finished or
    /// `deadline` says that time is up: see [`Renderer::refine`]. Each block is one
    /// [`fill_solid`](DrawTarget::fill_solid); what the target doesn't show isn't traced.
    ///
    /// # Errors
    /// Those of the target; the next call begins with the block that couldn't be drawn.
    pub fn refine<D: DrawTarget<Color = C>>(
        &self,
        target: &mut D,
        position: Point,
        passes: &mut Passes,
        deadline: impl FnMut(&T) -> bool,
    ) -> Result<Progress, D::Error> {
        let whole = Rectangle::new(Point::zero(), self.size());
        let (columns, rows) = self.visible(target, &whole, -position);
        // As in `fill`.
        let Some(mut renderer) = self.renderer.take() else { return Ok(Progress::Interrupted) };
        let output = self.output;
        let result = renderer.refine_area(passes, &output, (columns, rows), deadline, |block| {
            let corner = Point::new(block.x.into(), block.y.into()) + position;
            let size = Size::new(block.width.into(), block.height.into());
            target.fill_solid(&Rectangle::new(corner, size), C::from_pixel(block.pixel))
        });
        self.renderer.set(Some(renderer));
        result
    }

    /// The columns and rows of an area of the picture that the target shows, which is drawn moved
    /// by −`offset`.
    fn visible<D: DrawTarget<Color = C>>(
        &self,
        target: &D,
        area: &Rectangle,
        offset: Point,
    ) -> (Range<u16>, Range<u16>) {
        let whole = Rectangle::new(Point::zero(), self.size());
        let shown =
            Rectangle::new(target.bounding_box().top_left + offset, target.bounding_box().size);
        let visible = area.intersection(&whole).intersection(&shown);
        let (x, y) = (visible.top_left.x as u16, visible.top_left.y as u16);
        let columns = x..x.saturating_add(visible.size.width as u16);
        (columns, y..y.saturating_add(visible.size.height as u16))
    }

    fn fill<D: DrawTarget<Color = C>>(
        &self,
        target: &mut D,
        area: &Rectangle,
        offset: Point,
    ) -> Result<(), D::Error> {
        let (columns, rows) = self.visible(target, area, offset);
        if columns.is_empty() || rows.is_empty() {
            return Ok(());
        }
        // Nothing that draws can be called while this one draws: the renderer is there.
        let Some(mut renderer) = self.renderer.take() else { return Ok(()) };
        let corner = Point::new(columns.start.into(), rows.start.into());
        let size = Size::new(columns.len() as u32, rows.len() as u32);
        let colors =
            renderer.pixels(columns, rows, &self.output).map(|(_, _, pixel)| C::from_pixel(pixel));
        let place = Rectangle::new(corner - offset, size);
        let result = target.fill_contiguous(&place, colors);
        self.renderer.set(Some(renderer));
        result
    }
}

impl<A: Arithmetic, C, const MAX_DEPTH: usize, T, S> OriginDimensions
    for Picture<'_, A, C, MAX_DEPTH, T, S>
{
    fn size(&self) -> Size {
        Size::new(u32::from(self.settings.width), u32::from(self.settings.height))
    }
}

impl<'s, A, C, const MAX_DEPTH: usize, T, S, const USES: u64> ImageDrawable
    for Picture<'_, A, C, MAX_DEPTH, T, S>
where
    A: Arithmetic,
    C: Color,
    T: Tally,
    S: SceneRef<Target = Scene<'s, A, USES>>,
{
    type Color = C;

    fn draw<D: DrawTarget<Color = C>>(&self, target: &mut D) -> Result<(), D::Error> {
        self.fill(target, &Rectangle::new(Point::zero(), self.size()), Point::zero())
    }

    fn draw_sub_image<D: DrawTarget<Color = C>>(
        &self,
        target: &mut D,
        area: &Rectangle,
    ) -> Result<(), D::Error> {
        // A sub-image is drawn with its upper left corner at the origin.
        self.fill(target, area, area.top_left)
    }
}

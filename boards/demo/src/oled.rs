//! What the display of 16 greys shows.

use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::Gray4;
use embedded_graphics::prelude::*;
use whitted::Picture;
use whitted::frame::{Dither, Output, Renderer, Settings};
use whitted::math::Fixed;
use whitted::scene::{Scene, SceneRef};
use whitted::trace::Work;

use crate::frame::MAX_DEPTH;
use crate::job::SceneName;
use crate::scenes::{Shot, Shots, View};

/// The display's size.
pub const SIZE: Size = Size::new(128, 64);

/// Draws the showcase, dithered: sixteen greys are few.
///
/// # Errors
/// The display's.
///
/// # Panics
/// Never: the scene is no deeper than the memory.
pub fn draw<D: DrawTarget<Color = Gray4>>(display: &mut D) -> Result<(), D::Error> {
    Fixed::shot(SceneName::Showcase, On(display))
}

/// A display to draw on.
struct On<'a, D>(&'a mut D);

impl<D: DrawTarget<Color = Gray4>> View<Fixed> for On<'_, D> {
    type Output = Result<(), D::Error>;

    #[inline(always)]
    fn view<S, const USES: u64>(self, shot: Shot<Fixed, S>) -> Result<(), D::Error>
    where
        S: SceneRef<Target = Scene<'static, Fixed, USES>>,
    {
        let mut work = Work::<Fixed, MAX_DEPTH>::new();
        let settings =
            Settings { depth: shot.depth, ..Settings::new(SIZE.width as u16, SIZE.height as u16) };
        let renderer = Renderer::new(shot.scene, shot.camera, settings, &mut work, &mut [])
            .expect("the memory fits");
        let output = Output { dither: Dither::Ordered, ..shot.output };
        let picture = Picture::<_, Gray4, MAX_DEPTH, (), S>::from_renderer(renderer, output);
        Image::new(&picture, Point::zero()).draw(self.0)
    }
}

//! Pictures that somebody watches: from coarse to fine, and anew whenever the camera moves.

use std::cell::Cell;

use whitted::frame::{Output, Passes, Pixel, Progress, Renderer, Rgb565, Rgb888};
use whitted::scene::Scene;
use whitted::tally::Counts;

use super::{MAX_DEPTH, Settings, with_renderer};
use crate::bake::{Baked, Construct};
use crate::document;
use crate::error::{Flaw, Problem};
use crate::indirect::Pools;
use crate::picture::Picture;

/// What to do after a look at the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// Go on with this picture.
    GoOn,
    /// Begin again: the camera has moved.
    Anew,
    /// Nobody watches any more.
    Stop,
}

/// The colours that a screen knows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colors {
    /// Eight bits a channel.
    Rgb888,
    /// Five bits red, six green, five blue, as displays on SPI take them.
    Rgb565,
}

/// Somebody who watches.
pub trait Watcher {
    /// Where the next picture is seen from, in the scene's own coordinates.
    fn camera(&mut self) -> document::Camera;

    /// The arithmetic can't hold that camera: the next one has to be another.
    fn refused(&mut self);

    /// Whether it is time for a look, after so many pixels of this picture have been traced.
    fn is_due(&mut self, traced: u64) -> bool;

    /// A look at the picture. `side` is that of the blocks being painted, 0 in a last pass of more
    /// rays a pixel. A finished picture is shown again and again, so wait a little there.
    fn look(&mut self, picture: &Picture, side: u8, progress: Progress) -> Next;
}

/// Renders from coarse to fine, from blocks of `side` pixels, for somebody who watches, until they
/// have seen enough.
///
/// # Errors
/// A size, depth or side that is out of range, or a first camera that the arithmetic can't hold.
pub fn live<A: Construct>(
    baked: &Baked<A>,
    settings: &Settings,
    side: u8,
    colors: Colors,
    watcher: &mut impl Watcher,
) -> Result<(), Flaw> {
    let passes =
        Passes::new(side).map_err(|error| Problem::Settings(error.to_string()).anywhere())?;
    // A bad camera of the scene's own is an error, one that somebody moved to isn't.
    baked.camera(settings.size)?;
    let mut picture = Picture::new(settings.size);
    baked.with_scene(|scene| {
        loop {
            match frame(baked, scene, settings, passes, colors, &mut picture, watcher)? {
                Next::Stop => return Ok(()),
                Next::GoOn | Next::Anew => {}
            }
        }
    })?
}

fn frame<A: Construct>(
    baked: &Baked<A>,
    scene: &Scene<'_, A>,
    settings: &Settings,
    mut passes: Passes,
    colors: Colors,
    picture: &mut Picture,
    watcher: &mut impl Watcher,
) -> Result<Next, Flaw> {
    let Ok(camera) = baked.camera_of(&watcher.camera(), settings.size) else {
        watcher.refused();
        return Ok(Next::Anew);
    };
    let core = settings.for_core(baked.document().rules.terms);
    let mut pools = Pools::default();
    let mut made = Counts::default();
    let lit = pools.light(baked, scene, &camera, settings.size, settings.indirect, &mut made)?;
    with_renderer(&lit, &camera, core, |renderer| {
        let mut live = Live { renderer, passes: &mut passes, picture, traced: Cell::new(0) };
        loop {
            let progress = match colors {
                Colors::Rgb888 => live.refine(watcher, |Rgb888(color)| color),
                Colors::Rgb565 => live.refine(watcher, shown),
            };
            match watcher.look(live.picture, live.passes.side(), progress) {
                Next::GoOn => {}
                next => return next,
            }
        }
    })
}

/// A picture that somebody watches.
struct Live<'l, 'r, A: Construct> {
    renderer: &'l mut Renderer<'r, A, MAX_DEPTH, Counts>,
    passes: &'l mut Passes,
    picture: &'l mut Picture,
    /// Pixels, so far.
    traced: Cell<u64>,
}

impl<A: Construct> Live<'_, '_, A> {
    /// Goes on with it until a look is due.
    fn refine<P: Pixel>(
        &mut self,
        watcher: &mut impl Watcher,
        color: impl Fn(P) -> [u8; 3],
    ) -> Progress {
        let Self { renderer, passes, picture, traced } = self;
        renderer.refine(
            passes,
            &Output::SRGB,
            |_| watcher.is_due(traced.get()),
            |block| {
                traced.set(traced.get() + 1);
                let (left, top) = (usize::from(block.x), usize::from(block.y));
                let rows = picture.rows_mut().skip(top).take(block.height.into());
                let color = color(block.pixel);
                rows.for_each(|row| row[left..][..usize::from(block.width)].fill(color));
            },
        )
    }
}

/// What a display shows for 16 bits: its levels stand evenly between black and white.
pub fn shown(Rgb565(bits): Rgb565) -> [u8; 3] {
    let spread = |level: u16, most: u16| ((level * 255 + most / 2) / most) as u8;
    [spread(bits >> 11, 31), spread(bits >> 5 & 63, 63), spread(bits & 31, 31)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Size;
    use crate::read::{Format, parse};
    use crate::render::{Sampling, render};
    use std::num::NonZeroUsize;
    use whitted::frame::Pixel;
    use whitted::math::Fixed;

    #[test]
    fn sixteen_bits_reach_black_and_white_and_come_back() {
        assert_eq!(shown(Rgb565(0)), [0; 3]);
        assert_eq!(shown(Rgb565(0xffff)), [255; 3]);
        for bits in 0..=u16::MAX {
            let rgb = shown(Rgb565(bits)).map(|v| u16::from(v) * 257);
            assert_eq!(Rgb565::quantize(rgb, 32768), Rgb565(bits));
        }
    }

    /// Looks after every hundredth pixel, tries a camera that can't be, and leaves when done.
    struct Guest {
        camera: document::Camera,
        refusals: u32,
        looks: u32,
        last: Option<Picture>,
        next: u64,
    }

    impl Watcher for Guest {
        fn camera(&mut self) -> document::Camera {
            let far = document::Camera { eye: [1e9; 3], ..self.camera };
            if self.refusals == 0 { far } else { self.camera }
        }

        fn refused(&mut self) {
            self.refusals += 1;
        }

        fn is_due(&mut self, traced: u64) -> bool {
            let due = traced >= self.next;
            self.next += if due { 100 } else { 0 };
            due
        }

        fn look(&mut self, picture: &Picture, _: u8, progress: Progress) -> Next {
            self.looks += 1;
            self.last = Some(picture.clone());
            if progress == Progress::Done { Next::Stop } else { Next::GoOn }
        }
    }

    #[test]
    fn the_last_look_is_the_picture() {
        let text = include_bytes!("../../scenes/limit.toml");
        let document = parse(Format::Toml, text).unwrap();
        let baked = Baked::<Fixed>::new(&document).unwrap();
        for sampling in [Sampling::Center, Sampling::Grid { side: 2 }] {
            let settings = Settings {
                size: Size { width: 40, height: 32 },
                depth: 4,
                sampling,
                indirect: None,
                show: None,
                threads: NonZeroUsize::MIN,
            };
            let camera = document.camera;
            let mut guest = Guest { camera, refusals: 0, looks: 0, last: None, next: 100 };
            live(&baked, &settings, 16, Colors::Rgb888, &mut guest).unwrap();
            assert_eq!(guest.refusals, 1);
            let pixels = if sampling == Sampling::Center { 1280 } else { 2560 };
            assert_eq!(guest.looks, (pixels - 1) / 100 + 1);
            assert_eq!(guest.last, Some(render(&baked, &settings, |_| {}).unwrap().picture));
        }
    }
}

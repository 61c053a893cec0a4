//! The three ways a picture leaves: all give the same pixels, and no more rays than are shown.

use crate::common::scenes::{CAMERA, SCENE};
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor as eg;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use whitted::Picture;
use whitted::frame::Settings;
use whitted::frame::{FrameError, Output, Passes, Progress, Renderer, Rgb565, Sample, Sampling};
use whitted::math::Fixed;
use whitted::tally::Counts;
use whitted::trace::Work;

const WIDTH: u16 = 40;
const HEIGHT: u16 = 30;

/// A display of any size that keeps what it is sent, and fails after some pixels if told to.
struct Screen {
    size: Size,
    pixels: Vec<u16>,
    fills: usize,
    fail_after: Option<usize>,
}

impl Screen {
    fn new(width: u32, height: u32) -> Self {
        let pixels = vec![0xdead; (width * height) as usize];
        Self { size: Size::new(width, height), pixels, fills: 0, fail_after: None }
    }
}

impl OriginDimensions for Screen {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Screen {
    type Color = eg::Rgb565;
    type Error = &'static str;

    fn draw_iter<I: IntoIterator<Item = Pixel<Self::Color>>>(
        &mut self,
        _: I,
    ) -> Result<(), Self::Error> {
        Err("the picture is drawn by fill_contiguous alone")
    }

    fn fill_solid(&mut self, area: &Rectangle, color: Self::Color) -> Result<(), Self::Error> {
        if self.fail_after.is_some_and(|after| after <= self.fills) {
            return Err("cable");
        }
        self.fills += 1;
        let shown = area.intersection(&self.bounding_box());
        assert_eq!(shown, *area, "nothing is drawn beyond the screen");
        for point in area.points() {
            let index = point.y as usize * self.size.width as usize + point.x as usize;
            self.pixels[index] = color.into_storage();
        }
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = Self::Color>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), Self::Error> {
        self.fills += 1;
        let mut count = 0;
        for (point, color) in area.points().zip(colors) {
            if self.fail_after == Some(count) {
                return Err("cable");
            }
            let index = point.y as usize * self.size.width as usize + point.x as usize;
            self.pixels[index] = color.into_storage();
            count += 1;
        }
        assert_eq!(count, (area.size.width * area.size.height) as usize, "every pixel is given");
        Ok(())
    }
}

fn settings(sampling: Sampling) -> Settings {
    Settings { sampling, ..Settings::new(WIDTH, HEIGHT) }
}

fn by_lines(sampling: Sampling) -> Vec<u16> {
    let mut work = Work::<Fixed, 5>::new();
    let mut samples = vec![Sample::NONE; sampling.samples(WIDTH)];
    let mut renderer =
        Renderer::new(&SCENE, &CAMERA, settings(sampling), &mut work, &mut samples).unwrap();
    let mut all = Vec::new();
    for y in 0..HEIGHT {
        let mut line = [Rgb565(0); WIDTH as usize];
        renderer.line(y, &Output::SRGB, &mut line);
        all.extend(line.map(|p| p.0));
    }
    all
}

const ALL: [Sampling; 9] = [
    Sampling::Center,
    Sampling::Corners,
    Sampling::Grid { side: 2 },
    Sampling::Jittered { side: 2, seed: 3 },
    Sampling::Adaptive { depth: 2, threshold: 8 },
    Sampling::Sparse { side: 2, threshold: 8 },
    Sampling::SPARSE,
    Sampling::Sparse { side: 8, threshold: 0 },
    Sampling::Sparse { side: 16, threshold: 255 },
];

#[test]
fn bands_are_the_lines_whatever_their_height() {
    for sampling in ALL {
        let lines = by_lines(sampling);
        for height in [1, 7, 30, 40] {
            let mut work = Work::<Fixed, 5>::new();
            let mut samples = vec![Sample::NONE; sampling.samples(WIDTH)];
            let mut renderer =
                Renderer::new(&SCENE, &CAMERA, settings(sampling), &mut work, &mut samples)
                    .unwrap();
            let mut bytes = vec![0; height * WIDTH as usize * 2 + 5];
            let (mut y, mut all) = (0, Vec::new());
            loop {
                let rows = renderer.band::<Rgb565>(y, &Output::SRGB, &mut bytes);
                if rows == 0 {
                    break;
                }
                let used = &bytes[..usize::from(rows * WIDTH) * 2];
                all.extend(used.chunks(2).map(|b| u16::from_be_bytes([b[0], b[1]])));
                y += rows;
            }
            assert_eq!(y, HEIGHT);
            assert_eq!(all, lines, "{sampling:?}, bands of {height}");
        }
    }
}

#[test]
fn lines_in_any_order_are_the_same() {
    for sampling in ALL {
        let lines = by_lines(sampling);
        let mut work = Work::<Fixed, 5>::new();
        let mut samples = vec![Sample::NONE; sampling.samples(WIDTH)];
        let mut renderer =
            Renderer::new(&SCENE, &CAMERA, settings(sampling), &mut work, &mut samples).unwrap();
        for y in [29, 3, 4, 2, 2, 17, 0] {
            // a line cut short must not disturb the next one
            renderer.line(y, &Output::SRGB, &mut [Rgb565(0); 11]);
            let mut line = [Rgb565(0); WIDTH as usize];
            renderer.line(y, &Output::SRGB, &mut line);
            let start = usize::from(y) * WIDTH as usize;
            assert_eq!(line.map(|p| p.0), lines[start..start + WIDTH as usize]);
        }
    }
}

/// Draws at a place of a 25×20 screen; what it shows and how many camera rays it took.
fn drawn(sampling: Sampling, place: Point) -> (Screen, u64) {
    let mut work = Work::<Fixed, 5>::new();
    let mut samples = vec![Sample::NONE; sampling.samples(WIDTH)];
    let renderer = Renderer::with_tally(
        &SCENE,
        &CAMERA,
        settings(sampling),
        &mut work,
        &mut samples,
        Counts::default(),
    )
    .unwrap();
    let picture = Picture::<_, eg::Rgb565, 5, _>::from_renderer(renderer, Output::SRGB);
    let mut screen = Screen::new(25, 20);
    Image::new(&picture, place).draw(&mut screen).unwrap();
    let rays = picture.into_renderer().unwrap().tally().primary;
    (screen, rays)
}

#[test]
fn only_what_shows_is_traced_in_one_fill() {
    for sampling in ALL {
        let lines = by_lines(sampling);
        for (x, y) in [(0, 0), (-15, -10), (10, 5), (-30, 12), (24, 19)] {
            let (screen, rays) = drawn(sampling, Point::new(x, y));
            let mut shown = 0;
            for (i, pixel) in screen.pixels.iter().enumerate() {
                let (px, py) = (i as i32 % 25 - x, i as i32 / 25 - y);
                if (0..40).contains(&px) && (0..30).contains(&py) {
                    shown += 1;
                    assert_eq!(*pixel, lines[(py * 40 + px) as usize]);
                } else {
                    assert_eq!(*pixel, 0xdead);
                }
            }
            assert_eq!(screen.fills, 1);
            if sampling == Sampling::Center {
                assert_eq!(rays, shown);
            }
        }
        for (x, y) in [(25, 0), (0, 20), (-40, 0), (0, -30)] {
            let (screen, rays) = drawn(sampling, Point::new(x, y));
            assert_eq!((screen.fills, rays), (0, 0), "nothing shows at {x}, {y}");
        }
    }
}

#[test]
fn a_sub_image_is_the_same_pixels_at_its_own_place() {
    let lines = by_lines(Sampling::Center);
    let mut work = Work::<Fixed, 5>::new();
    let picture: Picture<'_, _, eg::Rgb565, 5> =
        Picture::new(&SCENE, &CAMERA, settings(Sampling::Center), &mut work, &mut []).unwrap();
    let area = Rectangle::new(Point::new(12, 8), Size::new(10, 6));
    let mut screen = Screen::new(25, 20);
    Image::new(&picture.sub_image(&area), Point::new(3, 4)).draw(&mut screen).unwrap();
    for y in 0..6 {
        for x in 0..10 {
            assert_eq!(screen.pixels[(y + 4) * 25 + x + 3], lines[(y + 8) * 40 + x + 12]);
        }
    }
}

#[test]
fn from_coarse_to_fine_only_what_shows_is_traced() {
    let lines = by_lines(Sampling::Center);
    for (x, y) in [(0, 0), (-15, -10), (10, 5), (-30, 12), (24, 19), (25, 0), (-40, 3)] {
        let mut work = Work::<Fixed, 5>::new();
        let counts = Counts::default();
        let settings = settings(Sampling::Center);
        let renderer =
            Renderer::with_tally(&SCENE, &CAMERA, settings, &mut work, &mut [], counts).unwrap();
        let picture = Picture::<_, eg::Rgb565, 5, _>::from_renderer(renderer, Output::SRGB);
        let mut screen = Screen::new(25, 20);
        let mut passes = Passes::new(8).unwrap();
        let mut calls = 0;
        // By some rays at a time, and with a cable that fails now and then.
        loop {
            calls += 1;
            screen.fail_after = (calls % 3 == 0).then_some(screen.fills + 7);
            let deadline = |counts: &Counts| counts.rays() >= 100 * calls;
            match picture.refine(&mut screen, Point::new(x, y), &mut passes, deadline) {
                Ok(Progress::Done) => break,
                Ok(Progress::Interrupted) | Err("cable") => {}
                Err(other) => panic!("{other}"),
            }
        }
        assert!(passes.is_done());
        let mut shown = 0;
        for (i, pixel) in screen.pixels.iter().enumerate() {
            let (px, py) = (i as i32 % 25 - x, i as i32 / 25 - y);
            if (0..40).contains(&px) && (0..30).contains(&py) {
                shown += 1;
                assert_eq!(*pixel, lines[(py * 40 + px) as usize]);
            } else {
                assert_eq!(*pixel, 0xdead);
            }
        }
        let rays = picture.into_renderer().unwrap().tally().primary;
        // Blocks that reach into view may begin beside it, 50 at most over the three passes; what
        // failed is traced again.
        assert!(rays >= shown && rays <= shown + 50 + calls, "{rays} rays for {shown}");
    }
}

#[test]
fn after_an_error_the_next_frame_is_whole() {
    for sampling in ALL {
        let lines = by_lines(sampling);
        let mut work = Work::<Fixed, 5>::new();
        let mut samples = vec![Sample::NONE; sampling.samples(WIDTH)];
        let picture: Picture<'_, _, eg::Rgb565, 5> =
            Picture::new(&SCENE, &CAMERA, settings(sampling), &mut work, &mut samples).unwrap();
        let image = Image::new(&picture, Point::zero());
        let mut screen = Screen::new(40, 30);
        for fail in [0, 1, 39, 40, 41, 500, 1199] {
            screen.fail_after = Some(fail);
            assert_eq!(image.draw(&mut screen), Err("cable"));
            screen.fail_after = None;
            image.draw(&mut screen).unwrap();
            assert_eq!(screen.pixels, lines);
        }
    }
}

#[test]
fn what_does_not_fit_is_said_when_the_renderer_is_made() {
    let mut work = Work::<Fixed, 5>::new();
    let mut error = |settings, samples: usize| {
        let mut samples = vec![Sample::NONE; samples];
        Renderer::new(&SCENE, &CAMERA, settings, &mut work, &mut samples).err()
    };
    assert_eq!(error(Settings::new(10, 10), 0), None);
    assert_eq!(error(Settings::new(0, 10), 0), Some(FrameError::Size));
    assert_eq!(error(Settings::new(10, 16385), 0), Some(FrameError::Size));
    let deep = |depth| Settings { depth, ..Settings::new(10, 10) };
    assert_eq!(error(deep(0), 0), Some(FrameError::Depth { depth: 0, max: 5 }));
    assert_eq!(error(deep(6), 0), Some(FrameError::Depth { depth: 6, max: 5 }));
    let corners = Settings { sampling: Sampling::Corners, ..Settings::new(10, 10) };
    assert_eq!(error(corners, 11), Some(FrameError::Samples { needed: 12 }));
    assert_eq!(error(corners, 12), None);
    let cells = |side| Settings { sampling: Sampling::Grid { side }, ..Settings::new(10, 10) };
    assert_eq!(error(cells(8), 0), None);
    assert_eq!(error(cells(0), 0), Some(FrameError::Cells { side: 0 }));
    assert_eq!(error(cells(9), 0), Some(FrameError::Cells { side: 9 }));
    let sampled = |sampling| Settings { sampling, ..Settings::new(10, 10) };
    for depth in [0, 4, 255] {
        let adaptive = sampled(Sampling::Adaptive { depth, threshold: 0 });
        assert_eq!(error(adaptive, 999), Some(FrameError::Halvings { depth }));
    }
    assert_eq!(error(sampled(Sampling::ADAPTIVE), 37), Some(FrameError::Samples { needed: 38 }));
    for side in [0, 1, 3, 6, 12, 32, 255] {
        let sparse = sampled(Sampling::Sparse { side, threshold: 0 });
        assert_eq!(error(sparse, 999), Some(FrameError::Block { side }));
    }
    assert_eq!(error(sampled(Sampling::SPARSE), 29), Some(FrameError::Samples { needed: 30 }));
    assert_eq!(error(sampled(Sampling::SPARSE), 30), None);
    for side in [0, 3, 129] {
        assert_eq!(Passes::new(side), Err(FrameError::Pass { side }));
    }
    for error in [
        FrameError::Halvings { depth: 4 },
        FrameError::Block { side: 3 },
        FrameError::Pass { side: 3 },
    ] {
        let message = error.to_string();
        assert!(message.contains(" 1 ") || message.contains("2, 4, 8"), "{message}");
    }
}

#[test]
fn working_memory_is_bounded() {
    // The README gives the first.
    assert!(size_of::<Work<Fixed, 5>>() <= 1592, "{}", size_of::<Work<Fixed, 5>>());
    assert!(size_of::<Work<Fixed, 8>>() <= 1736, "{}", size_of::<Work<Fixed, 8>>());
}

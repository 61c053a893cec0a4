//! A wire that fails: whichever transfer of a frame it is, the error comes out as the display's, and
//! the next frame is whole. The driver is the one of the real boards, the display a model of its
//! controller.

use std::cell::RefCell;
use std::convert::Infallible;
use std::rc::Rc;

use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor;
use embedded_graphics::prelude::*;
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::spi::{self, ErrorKind, Operation, SpiDevice};
use mipidsi::interface::{Interface, SpiError, SpiInterface};
use mipidsi::models::ST7789;
use mipidsi::{Builder, Display, NoResetPin};
use whitted::Picture;
use whitted::frame::{Rgb565, Sampling};
use whitted::math::Fixed;
use whitted::scene::{Scene, SceneRef};
use whitted::trace::Work;
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::job::{ArithName, Job, SceneName};
use whitted_demo::rgb565;
use whitted_demo::scenes::{Shot, Shots, View};

const WIDTH: u16 = 20;
const HEIGHT: u16 = 12;
/// The scene that is drawn.
const SCENE: SceneName = SceneName::Limit;
/// Bytes that the driver gathers before it sends: less than a row, so that pixels take many
/// transfers.
const BUFFER: usize = 32;
/// Rows of a band.
const BAND: usize = 3;

/// A wire came off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Fault;

impl spi::Error for Fault {
    fn kind(&self) -> ErrorKind {
        ErrorKind::Other
    }
}

/// What the controller knows: the window, and where in it the next byte goes.
#[derive(Default)]
struct Controller {
    is_data: bool,
    command: u8,
    arguments: Vec<u8>,
    columns: (u16, u16),
    rows: (u16, u16),
    next: usize,
    memory: Vec<u8>,
    /// Transfers until one fails.
    left: Option<usize>,
    transfers: usize,
}

const COLUMNS: u8 = 0x2a;
const ROWS: u8 = 0x2b;
const WRITE: u8 = 0x2c;

impl Controller {
    fn take(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            if !self.is_data {
                self.command = byte;
                self.arguments.clear();
                self.next = 0;
                continue;
            }
            self.arguments.push(byte);
            let pair = match *self.arguments.as_slice() {
                [a, b, c, d] => Some((u16::from_be_bytes([a, b]), u16::from_be_bytes([c, d]))),
                _ => None,
            };
            match self.command {
                COLUMNS => self.columns = pair.unwrap_or(self.columns),
                ROWS => self.rows = pair.unwrap_or(self.rows),
                WRITE => self.pixel(byte),
                _ => {}
            }
        }
    }

    fn pixel(&mut self, byte: u8) {
        let width = usize::from(self.columns.1 - self.columns.0 + 1);
        let (pixel, half) = (self.next / 2, self.next % 2);
        let x = usize::from(self.columns.0) + pixel % width;
        let y = usize::from(self.rows.0) + pixel / width;
        assert!(y <= usize::from(self.rows.1), "no pixels beyond the window");
        self.memory[(y * usize::from(WIDTH) + x) * 2 + half] = byte;
        self.next += 1;
    }
}

/// SPI with a chip select.
struct Wire(Rc<RefCell<Controller>>);
/// The line that tells data from commands.
struct DataLine(Rc<RefCell<Controller>>);

impl spi::ErrorType for Wire {
    type Error = Fault;
}

impl SpiDevice for Wire {
    fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Fault> {
        let mut controller = self.0.borrow_mut();
        for operation in operations {
            let Operation::Write(bytes) = operation else { panic!("displays are only written to") };
            if controller.left == Some(0) {
                controller.left = None;
                // Some of it arrives, and not in whole pixels.
                controller.take(&bytes[..bytes.len() / 2]);
                return Err(Fault);
            }
            controller.left = controller.left.map(|left| left - 1);
            controller.transfers += 1;
            controller.take(bytes);
        }
        Ok(())
    }
}

impl digital::ErrorType for DataLine {
    type Error = Infallible;
}

impl OutputPin for DataLine {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.borrow_mut().is_data = false;
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.borrow_mut().is_data = true;
        Ok(())
    }
}

struct NoDelay;

impl DelayNs for NoDelay {
    fn delay_ns(&mut self, _: u32) {}
}

type Screen = Display<SpiInterface<'static, Wire, DataLine>, ST7789, NoResetPin>;
/// Draws a frame.
type Draw<'a> = &'a mut dyn FnMut(&mut Screen) -> Sent;
type Sent = Result<(), SpiError<Fault, Infallible>>;

/// A way of drawing a frame.
#[derive(Clone, Copy)]
enum Way {
    Drawable,
    Bands,
}

/// A frame on a screen, drawn by what is given a way to draw it.
struct Frame<'a> {
    screen: &'a mut Screen,
    way: Way,
    times: &'a mut dyn FnMut(Draw<'_>, &mut Screen),
}

impl View<Fixed> for Frame<'_> {
    type Output = ();

    fn view<S, const USES: u64>(self, shot: Shot<Fixed, S>)
    where
        S: SceneRef<Target = Scene<'static, Fixed, USES>>,
    {
        let mut work = Work::new();
        let mut renderer = rgb565::renderer(&shot, WIDTH, HEIGHT, &mut work);
        match self.way {
            Way::Drawable => {
                let picture = Picture::<_, pixelcolor::Rgb565, MAX_DEPTH, (), S>::from_renderer(
                    renderer,
                    shot.output,
                );
                let image = Image::new(&picture, Point::zero());
                (self.times)(&mut |screen| image.draw(screen), self.screen);
            }
            Way::Bands => (self.times)(
                &mut |screen| {
                    screen.set_pixels(0, 0, WIDTH - 1, HEIGHT - 1, core::iter::empty())?;
                    // SAFETY: only pixels of the window that was opened are sent.
                    let link = unsafe { screen.dcs() };
                    let mut bytes = [0; BAND * WIDTH as usize * rgb565::BYTES];
                    let mut y = 0;
                    loop {
                        let rows = renderer.band::<Rgb565>(y, &shot.output, &mut bytes);
                        if rows == 0 {
                            return Ok(());
                        }
                        let used = usize::from(rows * WIDTH) * rgb565::BYTES;
                        let (pixels, _) = bytes[..used].as_chunks::<{ rgb565::BYTES }>();
                        link.send_pixels(pixels.iter().copied())?;
                        y += rows;
                    }
                },
                self.screen,
            ),
        }
    }
}

fn every_transfer_may_fail(way: Way, least: usize) {
    const BYTES: usize = WIDTH as usize * HEIGHT as usize * rgb565::BYTES;
    let mut wanted = vec![0; BYTES];
    let job = Job {
        scene: SCENE,
        arith: ArithName::Fixed,
        width: WIDTH,
        height: HEIGHT,
        sampling: Sampling::Center,
    };
    rgb565::draw(&job, &mut wanted);
    let controller = Rc::new(RefCell::new(Controller::default()));
    // The driver wants it for as long as it lives.
    let buffer = Box::leak(Box::new([0; BUFFER]));
    let link = SpiInterface::new(Wire(controller.clone()), DataLine(controller.clone()), buffer);
    let mut screen = Builder::new(ST7789, link)
        .display_size(WIDTH, HEIGHT)
        .init(&mut NoDelay)
        .expect("nothing fails yet");
    let mut tried = 0;
    // One renderer draws all frames: nothing of one that failed may stay in it.
    let mut times = |draw: Draw<'_>, screen: &mut Screen| {
        let black = || {
            let mut controller = controller.borrow_mut();
            (controller.memory, controller.transfers) = (vec![0; BYTES], 0);
        };
        black();
        draw(screen).expect("nothing fails yet");
        let transfers = controller.borrow().transfers;
        assert_eq!(controller.borrow().memory, wanted);
        for failing in 0..transfers {
            black();
            controller.borrow_mut().left = Some(failing);
            let error = draw(screen).expect_err("the wire's error comes out");
            assert!(matches!(error, SpiError::Spi(Fault)), "{failing}: {error:?}");
            assert_eq!(controller.borrow().transfers, failing, "nothing is sent after it");
            black();
            draw(screen).expect("the wire is back");
            assert_eq!(controller.borrow().memory, wanted, "after transfer {failing} failed");
            tried += 1;
        }
    };
    Fixed::shot(SCENE, Frame { screen: &mut screen, way, times: &mut times });
    assert!(tried >= least, "{tried} transfers were tried");
}

#[test]
fn every_transfer_of_a_drawable_may_fail() {
    // Window and write command, and the pixels by the driver's buffer.
    every_transfer_may_fail(Way::Drawable, 5 + 480 / BUFFER);
}

#[test]
fn every_transfer_of_bands_may_fail() {
    // Each band by itself.
    every_transfer_may_fail(Way::Bands, 5 + 16);
}

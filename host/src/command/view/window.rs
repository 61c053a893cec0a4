//! The window.

use std::path::PathBuf;
use std::thread::sleep;
use std::time::{Duration, Instant};

use minifb::{MouseButton, MouseMode, Scale, Window, WindowOptions};
use whitted_host::document::{Camera, Size};
use whitted_host::picture::Picture;
use whitted_host::render::{Next, Progress, Watcher};

use super::super::{Failure, print};
use super::keys::{self, Pressed, Wish};
use super::orbit::Orbit;
use super::pace;

/// How long one looks at a picture before the next look.
const GLANCE: Duration = Duration::from_millis(25);
/// Windows of pictures smaller than this show each pixel as four.
const SMALL: u32 = 400;

/// Somebody at a window.
pub(super) struct Viewer {
    window: Window,
    pressed: Pressed,
    orbit: Orbit,
    /// What the arithmetic held last.
    held: Orbit,
    size: (usize, usize),
    pixels: Vec<u32>,
    name: String,
    out: PathBuf,
    quiet: bool,
    /// Seconds a pixel; 0 is as fast as it goes.
    seconds: f64,
    /// When this picture began, and when it was looked at last.
    begun: Instant,
    looked: Instant,
    /// Where the mouse was when it was last seen with its button down.
    mouse: Option<(f32, f32)>,
    title: String,
    failure: Option<Failure>,
}

/// Whether there may be a display.
///
/// # Errors
/// There is none, in words.
pub(super) fn is_possible() -> Result<(), Failure> {
    let named = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    if cfg!(all(unix, not(target_os = "macos"))) && !named("DISPLAY") {
        let why = match named("WAYLAND_DISPLAY") {
            true => "DISPLAY isn't set: windows are X11's, on Wayland by Xwayland",
            false => "neither DISPLAY nor WAYLAND_DISPLAY is set",
        };
        return Err(no_display(why));
    }
    Ok(())
}

fn no_display(why: &str) -> Failure {
    Failure::Input(format!(
        "there is no display to open a window on ({why}); `whitted render` saves a picture instead"
    ))
}

impl Viewer {
    /// Opens a window.
    ///
    /// # Errors
    /// It can't be opened, in words.
    pub(super) fn open(
        camera: Camera,
        size: Size,
        name: &str,
        out: PathBuf,
        quiet: bool,
    ) -> Result<Self, Failure> {
        let scale = if size.width.max(size.height) < SMALL { Scale::X2 } else { Scale::X1 };
        let options = WindowOptions { scale, ..WindowOptions::default() };
        let (width, height) = (size.width as usize, size.height as usize);
        let mut window = Window::new(name, width, height, options)
            .map_err(|error| no_display(&error.to_string()))?;
        // Looks are as often as `is_due` says.
        window.set_target_fps(0);
        let pressed = Pressed::default();
        window.set_input_callback(Box::new(pressed.clone()));
        let orbit = Orbit::new(camera);
        Ok(Self {
            window,
            pressed,
            orbit,
            held: orbit,
            size: (width, height),
            pixels: vec![0; width * height],
            name: name.to_string(),
            out,
            quiet,
            seconds: 0.0,
            begun: Instant::now(),
            looked: Instant::now(),
            mouse: None,
            title: String::new(),
            failure: None,
        })
    }

    /// Draws no faster than a pixel in so many seconds.
    pub(super) fn pace(&mut self, seconds: f64) {
        self.seconds = seconds;
    }

    /// The end: what went wrong, if anything did.
    pub(super) fn close(self) -> Result<(), Failure> {
        self.failure.map_or(Ok(()), Err)
    }

    fn save(&mut self, picture: &Picture) {
        let saved = picture.save(&self.out);
        let told = match saved {
            Err(error) => Err(Failure::Output(self.out.clone(), error)),
            Ok(()) if self.quiet => Ok(()),
            Ok(()) => print(format_args!("{}\n", self.out.display())),
        };
        self.failure = told.err().or(self.failure.take());
    }

    /// What a person has asked for since the last look.
    fn wishes(&mut self) -> Vec<Wish> {
        let mut wishes = self.pressed.wishes();
        if let Some((_, clicks)) = self.window.get_scroll_wheel()
            && clicks != 0.0
        {
            wishes.push(Wish::Zoom(f64::from(clicks.signum())));
        }
        let down = self.window.get_mouse_down(MouseButton::Left);
        let mouse = self.window.get_mouse_pos(MouseMode::Pass).filter(|_| down);
        if let Some((from, to)) = self.mouse.zip(mouse)
            && from != to
        {
            wishes.push(keys::drag(from, to, self.size));
        }
        self.mouse = mouse;
        if !self.window.is_open() {
            wishes.push(Wish::Quit);
        }
        wishes
    }

    fn entitle(&mut self, side: u8, progress: Progress) {
        let name = &self.name;
        let title = match (progress, side) {
            (Progress::Done, _) => name.clone(),
            _ if self.seconds > 0.0 => format!("{name}: drawing"),
            (_, 0) => format!("{name}: last pass"),
            (_, side) => format!("{name}: blocks of {side}x{side}"),
        };
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
    }
}

impl Watcher for Viewer {
    fn camera(&mut self) -> Camera {
        self.begun = Instant::now();
        self.orbit.camera()
    }

    fn refused(&mut self) {
        self.orbit = self.held;
    }

    fn is_due(&mut self, traced: u64) -> bool {
        traced >= pace::pixels(self.seconds, self.begun.elapsed())
            || self.looked.elapsed() >= GLANCE
    }

    fn look(&mut self, picture: &Picture, side: u8, progress: Progress) -> Next {
        self.held = self.orbit;
        self.entitle(side, progress);
        for (to, [r, g, b]) in self.pixels.iter_mut().zip(picture.pixels()) {
            *to = u32::from_be_bytes([0, *r, *g, *b]);
        }
        let (width, height) = self.size;
        if let Err(error) = self.window.update_with_buffer(&self.pixels, width, height) {
            self.failure = Some(Failure::Input(format!("the window is gone: {error}")));
            return Next::Stop;
        }
        for wish in self.wishes() {
            self.orbit = match wish {
                Wish::Move(turn, lift) => self.orbit.moved(turn, lift),
                Wish::Zoom(clicks) => self.orbit.zoomed(clicks),
                Wish::Home => self.orbit.home(),
                Wish::Save => {
                    self.save(picture);
                    self.orbit
                }
                Wish::Quit => return Next::Stop,
            };
        }
        // Ahead of the board, or done: there is nothing to do until the next look.
        if let Some(rest) = GLANCE.checked_sub(self.looked.elapsed()) {
            sleep(rest);
        }
        self.looked = Instant::now();
        if self.orbit == self.held { Next::GoOn } else { Next::Anew }
    }
}

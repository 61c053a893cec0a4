//! What the firmware does: the frame that is ordered, or else scene after scene.

use embedded_hal::digital::InputPin;
use whitted::frame::Sampling;
use whitted_demo::job::SceneName;
use whitted_demo::stack;

use crate::board::Board;
use crate::chip;
use crate::order::{Frame, Order, Way};
use crate::panel;

/// How long a picture stays, unless the button is pressed.
const PAUSE_MS: u32 = 3_000;
/// How often the button is looked at.
const GLANCE_MS: u32 = 20;

/// Everything, from reset on.
pub(crate) fn run() -> ! {
    let top = stack::paint();
    let (mut board, display) = Board::take();
    let (width, height) = panel::SIZE;
    match Order::given() {
        Some(order) if order.way == Way::Trace => board.frame(None, &order, top),
        Some(order) => {
            let mut display = display.start(&mut board.sleep);
            board.frame(Some(&mut display), &order, top);
        }
        None => {
            let mut display = display.start(&mut board.sleep);
            for scene in SceneName::ALL.into_iter().cycle() {
                let frame = Frame { scene, width, height, sampling: Sampling::Center };
                board.frame(Some(&mut display), &Order { frame, way: Way::Bands }, top);
                board.pause();
            }
        }
    }
    loop {
        chip::wait();
    }
}

impl Board {
    /// Waits for the next scene's turn: some seconds, or until the button has been pressed and let
    /// go.
    fn pause(&mut self) {
        let mut pressed = false;
        for _ in 0..PAUSE_MS / GLANCE_MS {
            // The pin can't fail.
            let low = self.button.is_low().unwrap_or(false);
            if pressed && !low {
                return;
            }
            pressed |= low;
            self.sleep.ms(GLANCE_MS);
        }
    }
}

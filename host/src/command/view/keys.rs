//! What keys do.

use std::cell::RefCell;
use std::rc::Rc;

use minifb::{InputCallback, Key};

/// What a person wants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Wish {
    /// Radians to the right and upwards, for the camera.
    Move(f64, f64),
    /// Clicks nearer.
    Zoom(f64),
    /// Back to the scene's own camera.
    Home,
    /// The picture as a file.
    Save,
    /// The end.
    Quit,
}

/// The keys, for people.
pub(super) const HELP: &str = "drag or arrow keys: orbit; wheel, + -: zoom; R: back to the scene's \
                               camera; S: save a PNG; Esc, Q: quit";

/// The keys that were pressed since the last look, in their order; a tap shorter than the time between
/// two looks is among them.
#[derive(Clone, Default)]
pub(super) struct Pressed(Rc<RefCell<Vec<Key>>>);

impl Pressed {
    /// What they ask for.
    pub(super) fn wishes(&self) -> Vec<Wish> {
        self.0.take().into_iter().filter_map(wish).collect()
    }
}

impl InputCallback for Pressed {
    fn add_char(&mut self, _: u32) {}

    fn set_key_state(&mut self, key: Key, down: bool) {
        if down {
            self.0.borrow_mut().push(key);
        }
    }
}

/// A twelfth of a right angle a press.
const STEP: f64 = std::f64::consts::FRAC_PI_2 / 12.0;

/// What a key does, if it does anything. Arrows move the camera.
pub(super) fn wish(key: Key) -> Option<Wish> {
    Some(match key {
        Key::Left => Wish::Move(-STEP, 0.0),
        Key::Right => Wish::Move(STEP, 0.0),
        Key::Up => Wish::Move(0.0, STEP),
        Key::Down => Wish::Move(0.0, -STEP),
        Key::Equal | Key::NumPadPlus => Wish::Zoom(1.0),
        Key::Minus | Key::NumPadMinus => Wish::Zoom(-1.0),
        Key::R => Wish::Home,
        Key::S => Wish::Save,
        Key::Escape | Key::Q => Wish::Quit,
        _ => return None,
    })
}

/// What a drag does, by parts of the window: the near side of things follows the mouse, and half a turn
/// goes from edge to edge.
pub(super) fn drag(from: (f32, f32), to: (f32, f32), size: (usize, usize)) -> Wish {
    let part = |from: f32, to: f32, side: usize| f64::from(to - from) / side.max(1) as f64;
    let (x, y) = (part(from.0, to.0, size.0), part(from.1, to.1, size.1));
    Wish::Move(-x * std::f64::consts::PI, y * std::f64::consts::PI)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn keys_and_their_opposites() {
        assert_eq!(wish(Key::Escape), Some(Wish::Quit));
        assert_eq!(wish(Key::Q), Some(Wish::Quit));
        assert_eq!(wish(Key::S), Some(Wish::Save));
        assert_eq!(wish(Key::R), Some(Wish::Home));
        assert_eq!(wish(Key::A), None);
        assert_eq!(wish(Key::Left), Some(Wish::Move(-STEP, 0.0)));
        assert_eq!(wish(Key::Right), Some(Wish::Move(STEP, 0.0)));
        assert_eq!(wish(Key::Up), Some(Wish::Move(0.0, STEP)));
        assert_eq!(wish(Key::Down), Some(Wish::Move(0.0, -STEP)));
        assert_eq!(wish(Key::Equal), wish(Key::NumPadPlus));
        assert_eq!(wish(Key::Minus), Some(Wish::Zoom(-1.0)));
    }

    #[test]
    fn a_short_tap_counts() {
        let pressed = Pressed::default();
        let mut window = pressed.clone();
        for (key, down) in [(Key::S, true), (Key::S, false), (Key::A, true), (Key::Q, true)] {
            window.set_key_state(key, down);
        }
        assert_eq!(pressed.wishes(), [Wish::Save, Wish::Quit]);
        assert_eq!(pressed.wishes(), []);
    }

    #[test]
    fn half_a_turn_from_edge_to_edge() {
        assert_eq!(drag((0.0, 5.0), (200.0, 5.0), (200, 100)), Wish::Move(-PI, 0.0));
        assert_eq!(drag((0.0, 50.0), (0.0, 0.0), (200, 100)), Wish::Move(0.0, -FRAC_PI_2));
    }
}

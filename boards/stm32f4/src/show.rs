//! Scene after scene on the board, with a line in the log for each.

use cortex_m::peripheral::DWT;
use embedded_hal::delay::DelayNs;
use whitted::frame::Sampling;
use whitted_demo::job::{ArithName, Job, SceneName};
use whitted_demo::stack;
use {defmt_rtt as _, panic_probe as _};

use crate::board::{Board, CLOCK_MHZ, Wait};
use crate::draw;

/// The display's pixels across and down.
const SIZE: (u16, u16) = (320, 240);
/// How long a picture stays, unless the button is pressed.
const PAUSE_MS: u32 = 3_000;
/// How often the button is looked at.
const GLANCE_MS: u32 = 20;

/// Goes from scene to scene.
///
/// # Panics
/// When called twice.
pub(crate) fn run(mut board: Board) -> ! {
    let mut core = cortex_m::Peripherals::take().expect("a board is taken once");
    core.DCB.enable_trace();
    core.DWT.enable_cycle_counter();
    let (width, height) = SIZE;
    loop {
        for scene in SceneName::ALL {
            for arith in ArithName::ALL {
                let job = Job { scene, arith, width, height, sampling: Sampling::Center };
                let top = stack::paint();
                let start = DWT::cycle_count();
                let sent = draw::frame(&mut board.display, &job);
                // Right up to 42 seconds.
                let us = DWT::cycle_count().wrapping_sub(start) / CLOCK_MHZ;
                defmt::info!(
                    "{=str} {=str} {=u16}x{=u16}: {=u32} us, stack {=usize} bytes, static RAM {=usize} bytes",
                    scene.name(),
                    arith.name(),
                    width,
                    height,
                    us,
                    stack::used(top),
                    stack::static_bytes()
                );
                if let Err(error) = sent {
                    defmt::error!(
                        "{=str}: the frame isn't whole: {}",
                        scene.name(),
                        defmt::Debug2Format(&error)
                    );
                    // The next one follows at once.
                    continue;
                }
                pause(&board);
            }
        }
    }
}

/// Waits for the next picture's turn: some seconds, or until the button has been pressed and let
/// go.
fn pause(board: &Board) {
    let mut pressed = false;
    for _ in 0..PAUSE_MS / GLANCE_MS {
        let low = board.button.is_low();
        if pressed && !low {
            return;
        }
        pressed |= low;
        Wait.delay_ms(GLANCE_MS);
    }
}

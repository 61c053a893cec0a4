//! The second core: it traces rows of the frame that the first is drawing.

use whitted::frame::Sampling;

use crate::chip::hal::sio::SioFifo;
use crate::chip::hal::{Sio, pac};
use crate::draw;
use crate::order::Frame;
use crate::rows::{self, Empty, Row, Source};

/// The second core, seen from the first.
pub(crate) struct Second {
    fifo: SioFifo,
    started: bool,
}

impl Second {
    /// Starts it, unless the image is built for one core.
    pub(crate) fn start(mut fifo: SioFifo, psm: &mut pac::PSM, ppb: &mut pac::PPB) -> Self {
        let started = cfg!(not(feature = "one-core")) && spawn(&mut fifo, psm, ppb);
        Self { fifo, started }
    }

    /// Has it trace rows of the frame that is dealt, while `first` runs on this core; returns when
    /// it has stopped. By sparse sampling a row takes what was learnt from those above: then this core
    /// works alone.
    pub(crate) fn help(&mut self, frame: Frame, first: impl FnOnce()) {
        let helps = self.started && frame.sampling == Sampling::Center;
        if helps {
            frame.words().into_iter().for_each(|word| self.fifo.write_blocking(word));
        }
        first();
        if helps {
            self.fifo.read_blocking();
        }
    }
}

/// Starts the second core; whether that worked.
#[cfg(target_arch = "arm")]
fn spawn(fifo: &mut SioFifo, psm: &mut pac::PSM, ppb: &mut pac::PPB) -> bool {
    use crate::chip::hal::multicore::{Multicore, StackAllocation};

    unsafe extern "C" {
        /// The lower end of the second core's stack, a bank of RAM of its own, by the memory map.
        static mut _second_stack_end: usize;
        /// The upper end, where it begins.
        static mut _second_stack_start: usize;
    }

    let mut cores = Multicore::new(psm, ppb, fifo);
    let [_, second] = cores.cores() else { return false };
    // SAFETY: the map gives this memory to nothing else, and this is called once: the parts it takes
    // are there once. At the lower end the core has a guard.
    let stack = unsafe {
        StackAllocation::from_raw_parts(&raw mut _second_stack_end, &raw mut _second_stack_start)
    };
    second.spawn(stack, serve).is_ok()
}

/// The chip's crate starts no second core of this kind.
#[cfg(not(target_arch = "arm"))]
fn spawn(_: &mut SioFifo, _: &mut pac::PSM, _: &mut pac::PPB) -> bool {
    let _ = serve as fn();
    false
}

/// What the second core does: frames, until the power is off. Not inlined, so that it is this module's
/// code, which is in RAM.
#[inline(never)]
fn serve() {
    // SAFETY: of the chip's registers this core uses its own end of the FIFO alone.
    let mut fifo = Sio::new(unsafe { pac::Peripherals::steal() }.SIO).fifo;
    loop {
        let words = [(); Frame::WORDS].map(|()| fifo.read_blocking());
        let frame = Frame::from_words(words);
        draw::trace(frame, &mut Leftovers { line: frame.line() });
        fifo.write_blocking(1);
    }
}

/// What the second core traces: every row that the first hasn't taken.
struct Leftovers {
    line: usize,
}

impl Source for Leftovers {
    fn next(&mut self) -> Option<Row> {
        loop {
            match rows::claim(self.line) {
                Ok(row) => return Some(row),
                Err(Empty::Now) => {}
                Err(Empty::Forever) => return None,
            }
        }
    }
}

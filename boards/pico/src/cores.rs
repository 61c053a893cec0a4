//! The second core: it traces rows of the frame that the first is drawing.

use rp2040_hal::Sio;
use rp2040_hal::multicore::{Multicore, Stack};
use rp2040_hal::pac;
use rp2040_hal::sio::SioFifo;

use crate::draw;
use crate::order::Frame;
use crate::rows::{self, Empty, Row, Source};

/// Bytes of stack for the second core; the deepest frame takes some 3,000. Below it lies a guard.
const STACK: usize = 6 * 1024;

static MEMORY: Stack<{ STACK / 4 }> = Stack::new();

/// The second core, seen from the first.
pub(crate) struct Second {
    fifo: SioFifo,
    started: bool,
}

impl Second {
    /// Starts it, unless the image is built for one core.
    pub(crate) fn start(mut fifo: SioFifo, psm: &mut pac::PSM, ppb: &mut pac::PPB) -> Self {
        let mut started = false;
        if cfg!(not(feature = "one-core"))
            && let Some(memory) = MEMORY.take()
        {
            let mut cores = Multicore::new(psm, ppb, &mut fifo);
            let [_, second] = cores.cores() else { return Self { fifo, started } };
            started = second.spawn(memory, serve).is_ok();
        }
        Self { fifo, started }
    }

    /// Has it trace rows of the frame that is dealt, while `first` runs on this core; returns when
    /// it has stopped.
    pub(crate) fn help(&mut self, frame: Frame, first: impl FnOnce()) {
        if self.started {
            frame.words().into_iter().for_each(|word| self.fifo.write_blocking(word));
        }
        first();
        if self.started {
            self.fifo.read_blocking();
        }
    }
}

/// What the second core does: frames, until the power is off.
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

//! Sending by DMA.

use stm32f4xx_hal::dma::config::DmaConfig;
use stm32f4xx_hal::dma::traits::StreamISR;
use stm32f4xx_hal::dma::{MemoryToPeripheral, Stream3, StreamsTuple, Transfer};
use stm32f4xx_hal::pac::{DMA2, SPI1};
use stm32f4xx_hal::rcc::Rcc;
use stm32f4xx_hal::spi::{Spi, Tx};

use crate::link::Band;

/// Sending hasn't come to its end in time: the DMA failed, or SPI stands still.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Error;

/// How often it is looked whether a band is sent. Each look takes ten cycles and more, a band
/// 164,000.
const LOOKS: u32 = 1_000_000;

/// SPI1's stream and channel, which the HAL holds to the chip's table of requests.
type Stream = Stream3<DMA2>;
type Sending = Transfer<Stream, 3, Tx<SPI1>, MemoryToPeripheral, Band>;

// SAFETY: the bytes are static and nobody else's as long as the band exists, and they don't move.
unsafe impl embedded_dma::ReadBuffer for Band {
    type Word = u8;

    unsafe fn read_buffer(&self) -> (*const u8, usize) {
        (self.filled().as_ptr(), self.filled().len())
    }
}

/// Taken out and put back within one call.
pub(crate) struct Sender(Option<State>);

enum State {
    Idle(Stream, Tx<SPI1>, Band),
    Busy(Sending),
}

impl State {
    /// Waits until the last bit has left, or for so long that it never will.
    fn wait(self) -> ((Stream, Tx<SPI1>, Band), Result<(), Error>) {
        match self {
            Self::Idle(stream, wires, band) => ((stream, wires, band), Ok(())),
            Self::Busy(sending) => {
                // The DMA is done when SPI has taken the last byte, not when that is sent.
                let sent = (0..LOOKS).any(|_| sending.is_transfer_complete() && is_quiet());
                // This stops the DMA if it is still at it.
                let (stream, wires, band, _) = sending.release();
                ((stream, wires, band), if sent { Ok(()) } else { Err(Error) })
            }
        }
    }
}

/// Whether SPI has nothing more to send.
fn is_quiet() -> bool {
    // SAFETY: it only reads, and a register that reading doesn't change.
    let status = unsafe { &*SPI1::PTR }.sr().read();
    status.txe().bit_is_set() && status.bsy().bit_is_clear()
}

const PUT_BACK: &str = "put back by every call";

impl Sender {
    /// Sends by the stream that belongs to SPI1; `band` is an empty one.
    pub(crate) fn new(spi: Spi<SPI1>, dma: DMA2, band: Band, rcc: &mut Rcc) -> Self {
        let stream = StreamsTuple::new(dma, rcc).3;
        Self(Some(State::Idle(stream, spi.use_dma().tx(), band)))
    }

    /// Starts sending a buffer as soon as the other is sent, which comes back; an error is that
    /// one's.
    pub(crate) fn exchange(&mut self, full: Band) -> (Band, Result<(), Error>) {
        let ((stream, wires, band), sent) = self.0.take().expect(PUT_BACK).wait();
        let config = DmaConfig::default().memory_increment(true);
        let mut sending = Transfer::init_memory_to_peripheral(stream, wires, full, None, config);
        sending.start(|_| {});
        self.0 = Some(State::Busy(sending));
        (band, sent)
    }

    /// Waits until everything is sent.
    ///
    /// # Errors
    /// If the last buffer isn't.
    pub(crate) fn wait(&mut self) -> Result<(), Error> {
        let ((stream, wires, band), sent) = self.0.take().expect(PUT_BACK).wait();
        self.0 = Some(State::Idle(stream, wires, band));
        sent
    }
}

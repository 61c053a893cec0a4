//! Sending by DMA.

use core::convert::Infallible;

use stm32f4xx_hal::dma::config::DmaConfig;
use stm32f4xx_hal::dma::{MemoryToPeripheral, Stream3, StreamsTuple, Transfer};
use stm32f4xx_hal::pac::{DMA2, SPI1};
use stm32f4xx_hal::rcc::Rcc;
use stm32f4xx_hal::spi::{Spi, Tx};

use crate::link::Band;

/// Neither DMA from RAM nor SPI that only sends can fail.
pub(crate) type Error = Infallible;

/// SPI1's stream and channel, by the reference manual's table of DMA requests.
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
    /// Waits until the last bit has left.
    fn wait(self) -> (Stream, Tx<SPI1>, Band) {
        match self {
            Self::Idle(stream, wires, band) => (stream, wires, band),
            Self::Busy(sending) => {
                sending.wait();
                // SAFETY: only reads, of a register that reading doesn't change.
                let spi = unsafe { &*SPI1::PTR };
                // The DMA is done when SPI has taken the last byte, not when that is sent.
                while spi.sr().read().txe().bit_is_clear() {}
                while spi.sr().read().bsy().bit_is_set() {}
                let (stream, wires, band, _) = sending.release();
                (stream, wires, band)
            }
        }
    }
}

const PUT_BACK: &str = "put back by every call";

impl Sender {
    /// Sends by the stream that belongs to SPI1; `band` is an empty one.
    pub(crate) fn new(spi: Spi<SPI1>, dma: DMA2, band: Band, rcc: &mut Rcc) -> Self {
        let stream = StreamsTuple::new(dma, rcc).3;
        Self(Some(State::Idle(stream, spi.use_dma().tx(), band)))
    }

    /// Starts sending a buffer as soon as the other is sent, which comes back.
    pub(crate) fn exchange(&mut self, full: Band) -> (Band, Result<(), Error>) {
        let (stream, wires, band) = self.0.take().expect(PUT_BACK).wait();
        let config = DmaConfig::default().memory_increment(true);
        let mut sending = Transfer::init_memory_to_peripheral(stream, wires, full, None, config);
        sending.start(|_| {});
        self.0 = Some(State::Busy(sending));
        (band, Ok(()))
    }

    /// Waits until everything is sent.
    pub(crate) fn wait(&mut self) {
        let (stream, wires, band) = self.0.take().expect(PUT_BACK).wait();
        self.0 = Some(State::Idle(stream, wires, band));
    }
}

//! Sending while the core waits, for the emulator, which has no DMA.

use stm32f4xx_hal::pac::SPI1;
use stm32f4xx_hal::spi::Spi;

use crate::link::Band;

pub(crate) type Error = stm32f4xx_hal::spi::Error;

pub(crate) struct Sender {
    spi: Spi<SPI1>,
    /// The buffer that was sent last.
    sent: Option<Band>,
}

impl Sender {
    /// `band` is an empty one.
    pub(crate) fn new(spi: Spi<SPI1>, band: Band) -> Self {
        Self { spi, sent: Some(band) }
    }

    /// Sends a buffer; the other comes back.
    pub(crate) fn exchange(&mut self, full: Band) -> (Band, Result<(), Error>) {
        let sent = self.spi.write(full.filled());
        (self.sent.replace(full).expect("there is always one"), sent)
    }

    /// Everything is sent.
    pub(crate) fn wait(&mut self) -> Result<(), Error> {
        Ok(())
    }
}

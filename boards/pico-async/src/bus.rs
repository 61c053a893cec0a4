//! SPI1 as a bus that sends by DMA and can be given up at any point.
//!
//! The HAL's own waits for the last bit, and for each byte of a command, in loops that know no end. Here
//! every wait is a future: whoever drops it has the bus back. What is in SPI's FIFO by then still
//! leaves, which `flush` awaits.

use core::future;
use core::task::Poll;

use embassy_rp::dma::Channel;
use embassy_rp::pac;
use embassy_rp::pac::dma::vals::TreqSel;
use embassy_rp::peripherals::SPI1;
use embassy_rp::spi::{Blocking, Spi};
use embedded_hal::spi::{ErrorKind, ErrorType};
use embedded_hal_async::spi::SpiBus;

/// The bus.
pub(crate) struct Bus<'d> {
    channel: Channel<'d>,
    /// Keeps the pins and the clock as they are.
    _spi: Spi<'d, SPI1, Blocking>,
}

impl<'d> Bus<'d> {
    pub(crate) fn new(spi: Spi<'d, SPI1, Blocking>, channel: Channel<'d>) -> Self {
        Self { channel, _spi: spi }
    }
}

/// Only sends. The HAL stops with a message if DMA meets an error on the chip's bus.
impl ErrorType for Bus<'_> {
    type Error = ErrorKind;
}

impl SpiBus for Bus<'_> {
    async fn write(&mut self, bytes: &[u8]) -> Result<(), ErrorKind> {
        let to = pac::SPI1.dr().as_ptr().cast::<u8>();
        // SAFETY: the bytes are borrowed until the transfer has ended or, dropped, is stopped; the
        // register is SPI1's, which this has. What comes in meanwhile is never read, and may be lost.
        unsafe { self.channel.write(bytes, to, TreqSel::SPI1_TX, false) }.await;
        self.flush().await
    }

    async fn flush(&mut self) -> Result<(), ErrorKind> {
        // There is no interrupt for the last bit: it is looked again at the next turn.
        future::poll_fn(|context| {
            if pac::SPI1.sr().read().bsy() {
                context.waker().wake_by_ref();
                Poll::Pending
            } else {
                Poll::Ready(Ok(()))
            }
        })
        .await
    }

    async fn read(&mut self, _: &mut [u8]) -> Result<(), ErrorKind> {
        Err(ErrorKind::Other)
    }

    async fn transfer(&mut self, _: &mut [u8], _: &[u8]) -> Result<(), ErrorKind> {
        Err(ErrorKind::Other)
    }

    async fn transfer_in_place(&mut self, _: &mut [u8]) -> Result<(), ErrorKind> {
        Err(ErrorKind::Other)
    }
}

//! The way to the display: bands of bytes, each handed to a [`Sender`], which gives back the one
//! before. On the board that is a DMA: one band is sent while the other is filled.

use mipidsi::interface::{Interface, InterfaceKind};
use stm32f4xx_hal::gpio::{Output, Pin};

use crate::sender::{Error, Sender};

/// Bytes in a band: eight rows of 320 pixels.
const BAND: usize = 8 * 320 * 2;

/// A buffer, and how many of its bytes are to be sent.
pub(crate) struct Band {
    bytes: &'static mut [u8; BAND],
    len: usize,
}

impl Band {
    /// An empty one of memory that is nobody else's.
    pub(crate) fn new(bytes: &'static mut [u8; BAND]) -> Self {
        Self { bytes, len: 0 }
    }

    /// What is to be sent.
    pub(crate) fn filled(&self) -> &[u8] {
        self.bytes.get(..self.len).unwrap_or_default()
    }

    /// Has the buffer filled by `fill`, which says how many bytes it wrote; returns that.
    fn fill(&mut self, fill: impl FnOnce(&mut [u8]) -> usize) -> usize {
        self.len = fill(&mut *self.bytes).min(BAND);
        self.len
    }
}

/// The display's connection.
pub(crate) struct Link {
    sender: Sender,
    /// The buffer that is being filled; taken out and put back within one call.
    band: Option<Band>,
    select: Pin<'A', 4, Output>,
    data_command: Pin<'A', 3, Output>,
}

impl Link {
    pub(crate) fn new(
        sender: Sender,
        band: Band,
        mut select: Pin<'A', 4, Output>,
        data_command: Pin<'A', 3, Output>,
    ) -> Self {
        select.set_high();
        Self { sender, band: Some(band), select, data_command }
    }

    /// Sends bytes in bands: `fill` gets one buffer, while the other is sent, and says how many
    /// bytes it wrote; 0 is the end. Returns when the last bit has left.
    ///
    /// # Errors
    /// If SPI fails. The display is let go then too.
    pub(crate) fn send_bands(
        &mut self,
        mut fill: impl FnMut(&mut [u8]) -> usize,
    ) -> Result<(), Error> {
        let mut band = self.band.take().expect("put back by every call");
        self.select.set_low();
        let mut sent = Ok(());
        while sent.is_ok() && band.fill(&mut fill) > 0 {
            (band, sent) = self.sender.exchange(band);
        }
        let ended = self.sender.wait();
        self.select.set_high();
        self.band = Some(band);
        sent.and(ended)
    }

    fn send(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let mut bytes = bytes.iter();
        self.send_bands(|band| copy(band, &mut bytes))
    }
}

/// Fills a buffer as far as there are bytes; how many there were.
fn copy<'a>(band: &mut [u8], bytes: &mut impl Iterator<Item = &'a u8>) -> usize {
    // Places first: a byte that has been taken must have one.
    band.iter_mut().zip(bytes).map(|(place, &byte)| *place = byte).count()
}

impl Interface for Link {
    type Word = u8;
    type Error = Error;

    const KIND: InterfaceKind = InterfaceKind::Serial4Line;

    fn send_command(&mut self, command: u8, args: &[u8]) -> Result<(), Error> {
        self.data_command.set_low();
        let sent = self.send(&[command]);
        self.data_command.set_high();
        sent?;
        self.send(args)
    }

    fn send_pixels<const N: usize>(
        &mut self,
        pixels: impl IntoIterator<Item = [u8; N]>,
    ) -> Result<(), Error> {
        let mut pixels = pixels.into_iter();
        self.send_bands(|band| {
            let places = band.chunks_exact_mut(N).zip(&mut pixels);
            places.map(|(place, pixel)| place.copy_from_slice(&pixel)).count() * N
        })
    }

    fn send_repeated_pixel<const N: usize>(
        &mut self,
        pixel: [u8; N],
        count: u32,
    ) -> Result<(), Error> {
        self.send_pixels((0..count).map(|_| pixel))
    }
}

/// The two buffers there are.
///
/// # Panics
/// When called twice.
pub(crate) fn bands() -> [Band; 2] {
    let memory = cortex_m::singleton!(: [[u8; BAND]; 2] = [[0; BAND]; 2]).expect("taken once");
    memory.each_mut().map(Band::new)
}

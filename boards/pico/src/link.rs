//! The way to the display: commands one by one, pixels by DMA from two buffers. While one is
//! sent, the other is filled.

use core::convert::Infallible;

use embedded_dma::ReadBuffer;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::SpiBus;
use mipidsi::interface::{Interface, InterfaceKind};
use rp2040_hal::dma::single_buffer::{Config, Transfer};
use rp2040_hal::dma::{CH0, Channel};
use rp2040_hal::gpio::bank0::{Gpio8, Gpio9, Gpio10, Gpio11};
use rp2040_hal::gpio::{FunctionSioOutput, FunctionSpi, Pin, PullDown};
use rp2040_hal::pac::SPI1;
use rp2040_hal::spi::{Enabled, Spi};

/// Bytes a buffer holds: eight rows of 240 pixels.
const BAND: usize = 240 * 2 * 8;

/// SPI1 with its clock and its data line.
type Wires =
    Spi<Enabled, SPI1, (Pin<Gpio11, FunctionSpi, PullDown>, Pin<Gpio10, FunctionSpi, PullDown>)>;
/// An output.
type Output<I> = Pin<I, FunctionSioOutput, PullDown>;

/// A buffer, and how much of it is to be sent.
pub(crate) struct Band {
    bytes: &'static mut [u8; BAND],
    filled: usize,
}

// SAFETY: the bytes are static and stay where they are, and `filled` counts from their start and
// is at most their number.
unsafe impl ReadBuffer for Band {
    type Word = u8;

    unsafe fn read_buffer(&self) -> (*const u8, usize) {
        (self.bytes.as_ptr(), self.filled.min(BAND))
    }
}

/// The two buffers.
pub(crate) struct Bands(Band, Band);

impl Bands {
    /// The two there are.
    ///
    /// # Panics
    /// When called twice.
    pub(crate) fn take() -> Self {
        let first = cortex_m::singleton!(FIRST: [u8; BAND] = [0; BAND]);
        let second = cortex_m::singleton!(SECOND: [u8; BAND] = [0; BAND]);
        let band = |bytes: Option<&'static mut _>| Band {
            bytes: bytes.expect("buffers are taken once"),
            filled: 0,
        };
        Self(band(first), band(second))
    }
}

/// What sends, and the buffer that goes with it.
enum Sender {
    Idle(Channel<CH0>, Wires, Band),
    Busy(Transfer<Channel<CH0>, Band, Wires>),
}

impl Sender {
    /// Waits for the buffer to be sent.
    fn wait(self) -> (Channel<CH0>, Wires, Band) {
        match self {
            Self::Idle(channel, wires, band) => (channel, wires, band),
            Self::Busy(transfer) => {
                let (channel, band, wires) = transfer.wait();
                (channel, wires, band)
            }
        }
    }
}

/// The display's connection.
pub(crate) struct Link {
    /// Taken out and put back within one call.
    sender: Option<Sender>,
    /// The buffer that is being filled.
    band: Option<Band>,
    select: Output<Gpio9>,
    data_command: Output<Gpio8>,
}

const PUT_BACK: &str = "put back by every call";

impl Link {
    pub(crate) fn new(
        wires: Wires,
        channel: Channel<CH0>,
        Bands(first, second): Bands,
        select: Output<Gpio9>,
        data_command: Output<Gpio8>,
    ) -> Self {
        let sender = Some(Sender::Idle(channel, wires, first));
        Self { sender, band: Some(second), select, data_command }
    }

    /// Sends pixels in bands: `fill` gets one buffer, while the other is sent, and says how many
    /// bytes it wrote; 0 is the end.
    pub(crate) fn send_bands(
        &mut self,
        mut fill: impl FnMut(&mut [u8]) -> usize,
    ) -> Result<(), Infallible> {
        self.select.set_low()?;
        let mut band = self.band.take().expect(PUT_BACK);
        loop {
            band.filled = fill(band.bytes);
            if band.filled == 0 {
                break;
            }
            band = self.exchange(band);
        }
        self.band = Some(band);
        self.finish()
    }

    /// Has a buffer filled again and again, and sends nothing: to know what sending costs.
    pub(crate) fn keep_bands(&mut self, mut fill: impl FnMut(&mut [u8]) -> usize) {
        if let Some(band) = &mut self.band {
            while fill(band.bytes) > 0 {
                core::hint::black_box(&mut *band.bytes);
            }
        }
    }

    /// Starts sending a buffer as soon as the other is sent, which comes back.
    fn exchange(&mut self, full: Band) -> Band {
        let (channel, wires, mut band) = self.sender.take().expect(PUT_BACK).wait();
        self.sender = Some(Sender::Busy(Config::new(channel, full, wires).start()));
        band.filled = 0;
        band
    }

    /// Waits until the last bit has left, and lets go of the display.
    fn finish(&mut self) -> Result<(), Infallible> {
        let (channel, mut wires, band) = self.sender.take().expect(PUT_BACK).wait();
        wires.flush()?;
        self.sender = Some(Sender::Idle(channel, wires, band));
        self.select.set_high()
    }

    /// Sends bytes while the core waits.
    fn write(&mut self, bytes: &[u8]) -> Result<(), Infallible> {
        let (channel, mut wires, band) = self.sender.take().expect(PUT_BACK).wait();
        wires.write(bytes)?;
        // The data/command line changes next.
        wires.flush()?;
        self.sender = Some(Sender::Idle(channel, wires, band));
        Ok(())
    }
}

impl Interface for Link {
    type Word = u8;
    type Error = Infallible;

    const KIND: InterfaceKind = InterfaceKind::Serial4Line;

    fn send_command(&mut self, command: u8, args: &[u8]) -> Result<(), Infallible> {
        self.data_command.set_low()?;
        self.select.set_low()?;
        self.write(&[command])?;
        self.data_command.set_high()?;
        self.write(args)?;
        self.select.set_high()
    }

    fn send_pixels<const N: usize>(
        &mut self,
        pixels: impl IntoIterator<Item = [u8; N]>,
    ) -> Result<(), Infallible> {
        let mut pixels = pixels.into_iter();
        self.send_bands(|bytes| {
            let mut filled = 0;
            // Places first: a pixel that has been taken must have one.
            for (place, pixel) in bytes.chunks_exact_mut(N).zip(&mut pixels) {
                place.copy_from_slice(&pixel);
                filled += N;
            }
            filled
        })
    }

    fn send_repeated_pixel<const N: usize>(
        &mut self,
        pixel: [u8; N],
        count: u32,
    ) -> Result<(), Infallible> {
        self.send_pixels((0..count).map(|_| pixel))
    }
}

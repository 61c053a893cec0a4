//! The way to the display: commands one by one, pixels by DMA from two buffers. While one is
//! sent, the other is filled.

use core::convert::Infallible;

use embedded_hal::digital::OutputPin;
use embedded_hal::spi::SpiBus;
use mipidsi::interface::{Interface, InterfaceKind};
use rp2040_hal::dma::single_buffer::{Config, Transfer};
use rp2040_hal::dma::{CH0, Channel};
use rp2040_hal::gpio::bank0::{Gpio8, Gpio9, Gpio10, Gpio11};
use rp2040_hal::gpio::{FunctionSioOutput, FunctionSpi, Pin, PullDown};
use rp2040_hal::pac::SPI1;
use rp2040_hal::spi::{Enabled, Spi};

use crate::rows::{self, Band};

/// SPI1 with its clock and its data line.
type Wires =
    Spi<Enabled, SPI1, (Pin<Gpio11, FunctionSpi, PullDown>, Pin<Gpio10, FunctionSpi, PullDown>)>;
/// An output.
type Output<I> = Pin<I, FunctionSioOutput, PullDown>;

/// What sends, and the buffer that goes with it.
enum Sender {
    Idle(Channel<CH0>, Wires, Band),
    Busy(Transfer<Channel<CH0>, Band, Wires>),
}

impl Sender {
    /// Whether nothing is on its way.
    fn is_done(&self) -> bool {
        match self {
            Self::Idle(..) => true,
            Self::Busy(transfer) => transfer.is_done(),
        }
    }

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
        select: Output<Gpio9>,
        data_command: Output<Gpio8>,
    ) -> Self {
        let sender = Some(Sender::Idle(channel, wires, Band::half(false)));
        Self { sender, band: Some(Band::half(true)), select, data_command }
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
            if band.fill(&mut fill) == 0 {
                break;
            }
            band = self.exchange(band);
        }
        self.band = Some(band);
        self.finish()
    }

    /// Sends the rows of the frame that is dealt, of `line` bytes each, in bands as they are
    /// finished, and traces rows in the meantime.
    pub(crate) fn send_rows(
        &mut self,
        line: usize,
        row: &mut dyn FnMut(u16, &mut [u8]),
    ) -> Result<(), Infallible> {
        self.select.set_low()?;
        // The band that is being sent.
        let mut sending = None;
        while !rows::is_over() {
            if self.sender.as_ref().is_some_and(Sender::is_done)
                && let Some(band) = sending.take()
            {
                rows::free(&band);
            }
            if sending.is_none() {
                sending = rows::take_band();
                if let Some(band) = &sending {
                    self.exchange(Band::of(band, line));
                }
            }
            rows::work(line, &mut *row);
        }
        self.finish()
    }

    /// Starts sending a buffer as soon as the other is sent, which comes back.
    fn exchange(&mut self, full: Band) -> Band {
        let (channel, wires, band) = self.sender.take().expect(PUT_BACK).wait();
        self.sender = Some(Sender::Busy(Config::new(channel, full, wires).start()));
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

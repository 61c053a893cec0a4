//! The way to the display: commands one by one, pixels by DMA from two buffers. While one is
//! sent, the other is filled.
//!
//! An SPI that only sends can't know whether a display listens. What it can know is that bytes don't
//! leave, and that DMA met an error on the chip's bus. No wait is longer than [`PATIENCE`]; after
//! an error the display is let go of and the channel is free, so that the next frame begins anew.

use core::convert::Infallible;
use core::ops::Range;

use embedded_hal::digital::OutputPin;
use embedded_hal_nb::spi::FullDuplex;
use mipidsi::interface::{Interface, InterfaceKind};

use crate::chip::Timer;
use crate::chip::hal::dma::single_buffer::{Config, Transfer};
use crate::chip::hal::dma::{CH0, Channel};
use crate::chip::hal::fugit::MicrosDurationU64;
use crate::chip::hal::gpio::bank0::{Gpio8, Gpio9, Gpio10, Gpio11};
use crate::chip::hal::gpio::{FunctionSioOutput, FunctionSpi, Pin, PullDown};
use crate::chip::hal::pac::{self, SPI1};
use crate::chip::hal::spi::{Enabled, Spi};
use crate::chip::hal::timer::Instant;
use crate::rows::{self, Band, Row, Source};

/// SPI1 with its clock and its data line.
type Wires =
    Spi<Enabled, SPI1, (Pin<Gpio11, FunctionSpi, PullDown>, Pin<Gpio10, FunctionSpi, PullDown>)>;
/// An output.
type Output<I> = Pin<I, FunctionSioOutput, PullDown>;

/// A band takes a millisecond or two, at the slowest clock of SPI.
const PATIENCE: MicrosDurationU64 = MicrosDurationU64::millis(50);

/// What can go wrong on the way to the display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fault {
    /// Bytes don't leave in time: SPI or DMA stands still.
    Stuck,
    /// DMA met an error on the chip's bus.
    Bus,
}

impl Fault {
    /// For a log.
    pub(crate) const fn words(self) -> &'static str {
        match self {
            Self::Stuck => "SPI stands still",
            Self::Bus => "DMA met an error on the bus",
        }
    }
}

/// Pins can't fail.
impl From<Infallible> for Fault {
    fn from(never: Infallible) -> Self {
        match never {}
    }
}

/// Whether the channel has met an error since it was last asked.
fn is_bus_error() -> bool {
    // SAFETY: this module has the channel, and nothing else looks at its flags.
    let channel = unsafe { &*pac::DMA::ptr() }.ch(0);
    let met = channel.ch_ctrl_trig().read().ahb_error().bit_is_set();
    if met {
        // By the register that starts nothing.
        channel.ch_al1_ctrl().write(|w| {
            // SAFETY: the two flags alone, which are cleared by writing 1; the channel is off.
            unsafe { w.bits(1 << 30 | 1 << 29) }
        });
    }
    met
}

/// What sends, and the buffer that goes with it.
enum Sender {
    Idle(Channel<CH0>, Wires, Band),
    Busy(Transfer<Channel<CH0>, Band, Wires>, Instant),
}

impl Sender {
    /// Whether nothing is on its way any more, be it that it takes too long.
    fn is_over(&self, timer: Timer) -> bool {
        match self {
            Self::Idle(..) => true,
            Self::Busy(transfer, since) => {
                transfer.is_done() || timer.get_counter() - *since > PATIENCE
            }
        }
    }

    /// Waits for the buffer to be sent; if it can't be, what is left of it isn't.
    fn wait(self, timer: Timer) -> (Channel<CH0>, Wires, Band, Result<(), Fault>) {
        match self {
            Self::Idle(channel, wires, band) => (channel, wires, band, Ok(())),
            Self::Busy(transfer, since) => {
                let done = wait(timer, since, || transfer.is_done());
                let (channel, band, wires) =
                    if done.is_ok() { transfer.wait() } else { transfer.abort() };
                let done = if is_bus_error() { Err(Fault::Bus) } else { done };
                (channel, wires, band, done)
            }
        }
    }
}

/// Waits until something holds, for as long as there is patience.
fn wait(timer: Timer, since: Instant, holds: impl Fn() -> bool) -> Result<(), Fault> {
    while !holds() {
        // Looked at again: the core may have been away between the two.
        if timer.get_counter() - since > PATIENCE && !holds() {
            return Err(Fault::Stuck);
        }
    }
    Ok(())
}

/// The display's connection.
pub(crate) struct Link {
    /// Taken out and put back within one call.
    sender: Option<Sender>,
    /// The buffer that is being filled.
    band: Option<Band>,
    select: Output<Gpio9>,
    data_command: Output<Gpio8>,
    timer: Timer,
}

const PUT_BACK: &str = "put back by every call";

impl Link {
    pub(crate) fn new(
        wires: Wires,
        channel: Channel<CH0>,
        select: Output<Gpio9>,
        data_command: Output<Gpio8>,
        timer: Timer,
    ) -> Self {
        let sender = Some(Sender::Idle(channel, wires, Band::half(false)));
        Self { sender, band: Some(Band::half(true)), select, data_command, timer }
    }

    /// Selects the display, when no bytes of a frame that failed are left.
    fn begin(&mut self) -> Result<(), Fault> {
        self.flush()?;
        self.select.set_low()?;
        Ok(())
    }

    /// Lets go of the display, whatever happened.
    fn end(&mut self, sent: Result<(), Fault>) -> Result<(), Fault> {
        let flushed = self.flush();
        self.select.set_high()?;
        sent.and(flushed)
    }

    /// Waits until the last bit has left.
    fn flush(&mut self) -> Result<(), Fault> {
        let (channel, wires, band, sent) = self.sender.take().expect(PUT_BACK).wait(self.timer);
        let start = self.timer.get_counter();
        let flushed = sent.and_then(|()| wait(self.timer, start, || !wires.is_busy()));
        self.sender = Some(Sender::Idle(channel, wires, band));
        flushed
    }

    /// Sends pixels in bands: `fill` gets one buffer, while the other is sent, and says how many
    /// bytes it wrote; 0 is the end.
    pub(crate) fn send_bands(
        &mut self,
        mut fill: impl FnMut(&mut [u8]) -> usize,
    ) -> Result<(), Fault> {
        self.begin()?;
        let mut band = self.band.take().expect(PUT_BACK);
        let mut sent = Ok(());
        while sent.is_ok() && band.fill(&mut fill) != 0 {
            (band, sent) = self.exchange(band);
        }
        self.band = Some(band);
        self.end(sent)
    }

    /// Sends the rows of the frame that is dealt, of `line` bytes each, in bands as they are
    /// finished; in the meantime `trace` takes rows from what it is given. After an error no more rows are dealt.
    pub(crate) fn send_rows(
        &mut self,
        line: usize,
        trace: impl FnOnce(&mut dyn Source),
    ) -> Result<(), Fault> {
        let sent = self.begin();
        let mut sending = Sending { link: self, line, band: None, sent };
        trace(&mut sending);
        let sent = sending.sent;
        self.end(sent)
    }

    /// Waits for what is being sent, and takes note of how that went.
    fn collect(&mut self) -> Result<(), Fault> {
        let (channel, wires, band, sent) = self.sender.take().expect(PUT_BACK).wait(self.timer);
        self.sender = Some(Sender::Idle(channel, wires, band));
        sent
    }

    /// Starts sending a buffer as soon as the other is sent, which comes back; not if that failed.
    fn exchange(&mut self, full: Band) -> (Band, Result<(), Fault>) {
        let (channel, wires, band, sent) = self.sender.take().expect(PUT_BACK).wait(self.timer);
        if sent.is_err() {
            self.sender = Some(Sender::Idle(channel, wires, band));
            return (full, sent);
        }
        let transfer = Config::new(channel, full, wires).start();
        self.sender = Some(Sender::Busy(transfer, self.timer.get_counter()));
        (band, Ok(()))
    }

    /// Sends bytes while the core waits.
    fn write(&mut self, bytes: &[u8]) -> Result<(), Fault> {
        let start = self.timer.get_counter();
        if let Some(Sender::Idle(_, wires, _)) = &mut self.sender {
            for &byte in bytes {
                while wires.write(byte).is_err() {
                    if self.timer.get_counter() - start > PATIENCE {
                        return Err(Fault::Stuck);
                    }
                }
            }
        }
        // The data/command line changes next.
        self.flush()
    }

    /// Sends a command and what belongs to it.
    fn command(&mut self, command: u8, args: &[u8]) -> Result<(), Fault> {
        self.data_command.set_low()?;
        self.write(&[command])?;
        self.data_command.set_high()?;
        self.write(args)
    }
}

/// A frame whose bands are sent while its rows are traced.
struct Sending<'a> {
    link: &'a mut Link,
    /// Bytes in a row.
    line: usize,
    /// The rows that are on their way.
    band: Option<Range<u16>>,
    sent: Result<(), Fault>,
}

impl Sending<'_> {
    /// Frees the band that has been sent, and sends the next that is traced.
    fn go_on(&mut self) {
        if self.link.sender.as_ref().is_some_and(|sender| sender.is_over(self.link.timer))
            && let Some(band) = self.band.take()
        {
            self.sent = self.sent.and(self.link.collect());
            rows::free(&band);
        }
        if self.sent.is_err() {
            rows::stop();
        }
        if self.band.is_none() {
            self.band = rows::take_band();
            if let (Some(band), Ok(())) = (&self.band, self.sent) {
                let (_, before) = self.link.exchange(Band::of(band, self.line));
                self.sent = before;
            }
        }
    }
}

impl Source for Sending<'_> {
    fn next(&mut self) -> Option<Row> {
        while !rows::is_over() {
            self.go_on();
            if let Ok(row) = rows::claim(self.line) {
                return Some(row);
            }
        }
        None
    }
}

impl Interface for Link {
    type Word = u8;
    type Error = Fault;

    const KIND: InterfaceKind = InterfaceKind::Serial4Line;

    fn send_command(&mut self, command: u8, args: &[u8]) -> Result<(), Fault> {
        self.begin()?;
        let sent = self.command(command, args);
        self.end(sent)
    }

    fn send_pixels<const N: usize>(
        &mut self,
        pixels: impl IntoIterator<Item = [u8; N]>,
    ) -> Result<(), Fault> {
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
    ) -> Result<(), Fault> {
        self.send_pixels((0..count).map(|_| pixel))
    }
}

//! The way to the display: commands one by one while the core waits, pixels by DMA from two
//! buffers.
//!
//! A bus that only sends can't know whether a display listens. What can be known is that bytes don't
//! leave: no transfer gets more time than [`PATIENCE`]. After an error the display is let go of, and
//! the next command waits for what is left in the bus, so that the next frame begins anew.

use core::convert::Infallible;
use core::mem;
use core::pin::pin;
use core::task::{Context, Poll, Waker};

use embassy_futures::join::join;
use embassy_futures::select::{Either, select};
use embassy_time::{Duration, Instant, Timer};
use embedded_hal::digital::OutputPin;
use embedded_hal_async::spi::SpiBus;
use mipidsi::interface::{Interface, InterfaceKind};

/// Bytes in a band: eight rows of 240 pixels.
pub const BAND: usize = 8 * 240 * 2;
/// Two bands. A DMA reads them: not on a stack that goes away, nor in flash.
pub type Buffers = [[u8; BAND]; 2];

/// Pixels that are sent by the driver itself go in pieces of so many bytes.
const PIECE: usize = 128;
/// A band takes two milliseconds at the slowest clock of SPI.
const PATIENCE: Duration = Duration::from_millis(50);

/// What can go wrong on the way to the display.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault<E> {
    /// Bytes don't leave in time: the bus or its DMA stands still.
    Stuck,
    /// The bus tells of an error.
    Bus(E),
}

impl<E> Fault<E> {
    /// For a log.
    pub const fn words(&self) -> &'static str {
        match self {
            Self::Stuck => "SPI stands still",
            Self::Bus(_) => "SPI met an error",
        }
    }
}

/// A display's connection: a bus, and the lines for select and for data or command.
///
/// A transfer that takes too long is dropped, which has to stop it.
pub struct Link<S, C, D> {
    bus: S,
    select: C,
    data_command: D,
}

impl<S, C, D> Link<S, C, D>
where
    S: SpiBus,
    C: OutputPin<Error = Infallible>,
    D: OutputPin<Error = Infallible>,
{
    /// A connection that nobody else uses; `select` is high.
    pub fn new(bus: S, select: C, data_command: D) -> Self {
        Self { bus, select, data_command }
    }

    /// Sends pixels in bands, after the driver has opened a window: `fill` gets one buffer while the
    /// other is sent, and says how many bytes it wrote; 0 is the end.
    ///
    /// # Errors
    /// If the bus fails or stands still. The display is let go then too, and takes the next command.
    pub async fn send(
        &mut self,
        buffers: &mut Buffers,
        fill: impl FnMut(&mut [u8]) -> usize,
    ) -> Result<(), Fault<S::Error>> {
        self.begin()?;
        let sent = self.send_bands(buffers, fill).await;
        self.end(sent)
    }

    async fn send_bands(
        &mut self,
        buffers: &mut Buffers,
        mut fill: impl FnMut(&mut [u8]) -> usize,
    ) -> Result<(), Fault<S::Error>> {
        let [mut full, mut empty] = buffers.each_mut();
        let mut len = fill(full);
        while let Some(band @ [_, ..]) = full.get(..len) {
            // The first is asked first, which starts the DMA; then the second has the core. However long
            // that keeps it, a band that has left by then is in time.
            let (sent, next) = join(in_time(self.bus.write(band)), async { fill(empty) }).await;
            sent?;
            len = next;
            mem::swap(&mut full, &mut empty);
        }
        in_time(self.bus.flush()).await
    }

    /// Selects the display, when no bytes of a frame that failed are left.
    fn begin(&mut self) -> Result<(), Fault<S::Error>> {
        wait(self.bus.flush())?;
        let Ok(()) = self.select.set_low();
        Ok(())
    }

    /// Lets go of the display, whatever happened.
    fn end(&mut self, sent: Result<(), Fault<S::Error>>) -> Result<(), Fault<S::Error>> {
        let Ok(()) = self.select.set_high();
        sent
    }

    /// Sends bytes while the core waits, to the last bit: a line changes next.
    fn write(&mut self, bytes: &[u8]) -> Result<(), Fault<S::Error>> {
        wait(self.bus.write(bytes))?;
        wait(self.bus.flush())
    }

    /// Sends a command and what belongs to it.
    fn command(&mut self, command: u8, args: &[u8]) -> Result<(), Fault<S::Error>> {
        let Ok(()) = self.data_command.set_low();
        let sent = self.write(&[command]);
        let Ok(()) = self.data_command.set_high();
        sent?;
        if args.is_empty() { Ok(()) } else { self.write(args) }
    }
}

/// Awaits a transfer, and drops it if that takes too long.
async fn in_time<E>(transfer: impl Future<Output = Result<(), E>>) -> Result<(), Fault<E>> {
    match select(transfer, Timer::after(PATIENCE)).await {
        Either::First(sent) => sent.map_err(Fault::Bus),
        Either::Second(()) => Err(Fault::Stuck),
    }
}

/// The same while the core waits.
fn wait<E>(transfer: impl Future<Output = Result<(), E>>) -> Result<(), Fault<E>> {
    let start = Instant::now();
    let mut transfer = pin!(transfer);
    let mut context = Context::from_waker(Waker::noop());
    loop {
        match transfer.as_mut().poll(&mut context) {
            Poll::Ready(sent) => return sent.map_err(Fault::Bus),
            Poll::Pending if start.elapsed() > PATIENCE => return Err(Fault::Stuck),
            Poll::Pending => {}
        }
    }
}

impl<S, C, D> Interface for Link<S, C, D>
where
    S: SpiBus,
    C: OutputPin<Error = Infallible>,
    D: OutputPin<Error = Infallible>,
{
    type Word = u8;
    type Error = Fault<S::Error>;

    const KIND: InterfaceKind = InterfaceKind::Serial4Line;

    fn send_command(&mut self, command: u8, args: &[u8]) -> Result<(), Self::Error> {
        self.begin()?;
        let sent = self.command(command, args);
        self.end(sent)
    }

    fn send_pixels<const N: usize>(
        &mut self,
        pixels: impl IntoIterator<Item = [u8; N]>,
    ) -> Result<(), Self::Error> {
        let mut bytes = pixels.into_iter().flatten();
        let mut piece = [0; PIECE];
        self.begin()?;
        let sent = loop {
            let mut len = 0;
            // Places first: a byte that has been taken must have one.
            for (place, byte) in piece.iter_mut().zip(&mut bytes) {
                *place = byte;
                len += 1;
            }
            match piece.get(..len) {
                Some(piece @ [_, ..]) => {
                    if let Err(error) = self.write(piece) {
                        break Err(error);
                    }
                }
                _ => break Ok(()),
            }
        };
        self.end(sent)
    }

    fn send_repeated_pixel<const N: usize>(
        &mut self,
        pixel: [u8; N],
        count: u32,
    ) -> Result<(), Self::Error> {
        self.send_pixels((0..count).map(|_| pixel))
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use core::cell::RefCell;
    use core::convert::Infallible;
    use core::future;
    use std::vec::Vec;

    use embassy_futures::{block_on, yield_now};
    use embedded_hal::digital::{ErrorType as PinError, OutputPin};
    use embedded_hal::spi::{ErrorKind, ErrorType};
    use embedded_hal_async::spi::SpiBus;
    use mipidsi::interface::Interface;

    use super::{BAND, Fault, Link};

    /// What happened, in order.
    #[derive(Debug, PartialEq, Eq)]
    enum Event {
        Selected(bool),
        Filled,
        Started,
        Stopped,
        Sent(Vec<u8>),
    }

    type Log = RefCell<Vec<Event>>;

    struct Pin<'a>(Option<&'a Log>);

    impl PinError for Pin<'_> {
        type Error = Infallible;
    }

    impl OutputPin for Pin<'_> {
        fn set_low(&mut self) -> Result<(), Infallible> {
            self.0.into_iter().for_each(|log| log.borrow_mut().push(Event::Selected(true)));
            Ok(())
        }

        fn set_high(&mut self) -> Result<(), Infallible> {
            self.0.into_iter().for_each(|log| log.borrow_mut().push(Event::Selected(false)));
            Ok(())
        }
    }

    /// How a bus goes wrong.
    #[derive(Clone, Copy)]
    enum Wrong {
        Fails,
        Sticks,
    }

    /// A bus that goes wrong at a transfer, if that many are made; those after it are good.
    struct Bus<'a> {
        log: &'a Log,
        good: usize,
        wrong: Wrong,
    }

    /// A transfer that is under way.
    struct Moving<'a>(&'a Log);

    impl Drop for Moving<'_> {
        fn drop(&mut self) {
            self.0.borrow_mut().push(Event::Stopped);
        }
    }

    impl ErrorType for Bus<'_> {
        type Error = ErrorKind;
    }

    impl SpiBus for Bus<'_> {
        async fn read(&mut self, _: &mut [u8]) -> Result<(), ErrorKind> {
            Err(ErrorKind::Other)
        }
        async fn write(&mut self, bytes: &[u8]) -> Result<(), ErrorKind> {
            self.log.borrow_mut().push(Event::Started);
            let good = self.good.checked_sub(1);
            self.good = good.unwrap_or(usize::MAX);
            match (good, self.wrong) {
                (None, Wrong::Fails) => return Err(ErrorKind::Overrun),
                (None, Wrong::Sticks) => {
                    let _moving = Moving(self.log);
                    future::pending::<()>().await;
                }
                _ => yield_now().await,
            }
            self.log.borrow_mut().push(Event::Sent(bytes.to_vec()));
            Ok(())
        }
        async fn transfer(&mut self, _: &mut [u8], _: &[u8]) -> Result<(), ErrorKind> {
            Err(ErrorKind::Other)
        }
        async fn transfer_in_place(&mut self, _: &mut [u8]) -> Result<(), ErrorKind> {
            Err(ErrorKind::Other)
        }
        async fn flush(&mut self) -> Result<(), ErrorKind> {
            Ok(())
        }
    }

    fn link(log: &Log, good: usize, wrong: Wrong) -> Link<Bus<'_>, Pin<'_>, Pin<'_>> {
        Link::new(Bus { log, good, wrong }, Pin(Some(log)), Pin(None))
    }

    /// Sends two bands, of one byte and of two.
    fn send(link: &mut Link<Bus<'_>, Pin<'_>, Pin<'_>>, log: &Log) -> Result<(), Fault<ErrorKind>> {
        let mut bands = [&[1][..], &[2, 3]].into_iter();
        block_on(link.send(&mut [[0; BAND]; 2], |bytes| {
            log.borrow_mut().push(Event::Filled);
            let band = bands.next().unwrap_or_default();
            bytes[..band.len()].copy_from_slice(band);
            band.len()
        }))
    }

    /// What a frame without errors is.
    fn whole() -> [Event; 9] {
        use Event::{Filled, Selected, Sent, Started};
        [
            Selected(true),
            Filled,
            Started,
            Filled,
            Sent([1].to_vec()),
            Started,
            Filled,
            Sent([2, 3].to_vec()),
            Selected(false),
        ]
    }

    #[test]
    fn a_band_is_filled_while_one_is_sent() {
        let log = Log::default();
        assert_eq!(send(&mut link(&log, 2, Wrong::Fails), &log), Ok(()));
        assert_eq!(*log.borrow(), whole());
    }

    #[test]
    fn an_error_is_told_and_the_display_let_go_and_the_next_frame_is_whole() {
        let faults =
            [(Wrong::Fails, Fault::Bus(ErrorKind::Overrun)), (Wrong::Sticks, Fault::Stuck)];
        for (wrong, fault) in faults {
            for good in 0..2 {
                let log = Log::default();
                let mut link = link(&log, good, wrong);
                assert_eq!(send(&mut link, &log), Err(fault));
                assert_eq!(log.borrow().last(), Some(&Event::Selected(false)));
                let stopped = log.borrow().contains(&Event::Stopped);
                assert_eq!(stopped, fault == Fault::Stuck);
                log.borrow_mut().clear();
                assert_eq!(send(&mut link, &log), Ok(()));
                assert_eq!(*log.borrow(), whole());
            }
        }
    }

    #[test]
    fn a_command_that_sticks_is_given_up() {
        // The command's own byte, and what belongs to it.
        for good in 0..2 {
            let log = Log::default();
            let mut link = link(&log, good, Wrong::Sticks);
            assert_eq!(link.send_command(0x2A, &[0, 0, 0, 7]), Err(Fault::Stuck));
            assert_eq!(log.borrow().last(), Some(&Event::Selected(false)));
            assert_eq!(link.send_command(0x2A, &[0, 0, 0, 7]), Ok(()));
        }
    }
}

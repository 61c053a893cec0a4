//! The way to the display: commands one by one while the core waits, pixels by DMA from two
//! buffers.

use core::convert::Infallible;
use core::mem;

use embassy_futures::join::join;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::SpiBus;
use embedded_hal_async::spi::SpiBus as AsyncBus;
use mipidsi::interface::{Interface, InterfaceKind};

/// Bytes in a band: eight rows of 240 pixels.
pub const BAND: usize = 8 * 240 * 2;
/// Two bands. A DMA reads them: not on a stack that goes away, nor in flash.
pub type Buffers = [[u8; BAND]; 2];

/// Pixels that are sent by the driver itself go in pieces of so many bytes.
const PIECE: usize = 128;

/// A display's connection: a bus, and the lines for select and for data or command.
pub struct Link<S, C, D> {
    bus: S,
    select: C,
    data_command: D,
}

impl<S, C, D> Link<S, C, D>
where
    S: SpiBus + AsyncBus,
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
    /// If the bus fails. The display is let go then too, and takes the next command.
    pub async fn send(
        &mut self,
        buffers: &mut Buffers,
        fill: impl FnMut(&mut [u8]) -> usize,
    ) -> Result<(), <S as embedded_hal::spi::ErrorType>::Error> {
        let Ok(()) = self.select.set_low();
        let sent = self.send_bands(buffers, fill).await;
        let Ok(()) = self.select.set_high();
        sent
    }

    async fn send_bands(
        &mut self,
        buffers: &mut Buffers,
        mut fill: impl FnMut(&mut [u8]) -> usize,
    ) -> Result<(), <S as embedded_hal::spi::ErrorType>::Error> {
        let [mut full, mut empty] = buffers.each_mut();
        let mut len = fill(full);
        while let Some(band @ [_, ..]) = full.get(..len) {
            // The first is asked first, which starts the DMA; then the second has the core.
            let (sent, next) =
                join(AsyncBus::write(&mut self.bus, band), async { fill(empty) }).await;
            sent?;
            len = next;
            mem::swap(&mut full, &mut empty);
        }
        AsyncBus::flush(&mut self.bus).await
    }

    /// Sends bytes while the core waits, to the last bit: a line changes next.
    fn write(&mut self, bytes: &[u8]) -> Result<(), <Self as Interface>::Error> {
        SpiBus::write(&mut self.bus, bytes)?;
        SpiBus::flush(&mut self.bus)
    }
}

impl<S, C, D> Interface for Link<S, C, D>
where
    S: SpiBus + AsyncBus,
    C: OutputPin<Error = Infallible>,
    D: OutputPin<Error = Infallible>,
{
    type Word = u8;
    type Error = <S as embedded_hal::spi::ErrorType>::Error;

    const KIND: InterfaceKind = InterfaceKind::Serial4Line;

    fn send_command(&mut self, command: u8, args: &[u8]) -> Result<(), Self::Error> {
        let Ok(()) = self.data_command.set_low();
        let Ok(()) = self.select.set_low();
        let mut sent = self.write(&[command]);
        let Ok(()) = self.data_command.set_high();
        if sent.is_ok() && !args.is_empty() {
            sent = self.write(args);
        }
        let Ok(()) = self.select.set_high();
        sent
    }

    fn send_pixels<const N: usize>(
        &mut self,
        pixels: impl IntoIterator<Item = [u8; N]>,
    ) -> Result<(), Self::Error> {
        let mut bytes = pixels.into_iter().flatten();
        let mut piece = [0; PIECE];
        let Ok(()) = self.select.set_low();
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
        let Ok(()) = self.select.set_high();
        sent
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
    use std::vec::Vec;

    use embassy_futures::{block_on, yield_now};
    use embedded_hal::digital::{ErrorType as PinError, OutputPin};
    use embedded_hal::spi::{ErrorKind, ErrorType, SpiBus};
    use embedded_hal_async::spi::SpiBus as AsyncBus;

    use super::{BAND, Link};

    /// What happened, in order.
    #[derive(Debug, PartialEq, Eq)]
    enum Event {
        Selected(bool),
        Filled,
        Started,
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

    /// A bus that fails at a transfer, if that many are made.
    struct Bus<'a>(&'a Log, usize);

    impl ErrorType for Bus<'_> {
        type Error = ErrorKind;
    }

    impl SpiBus for Bus<'_> {
        fn read(&mut self, _: &mut [u8]) -> Result<(), ErrorKind> {
            Err(ErrorKind::Other)
        }
        fn write(&mut self, _: &[u8]) -> Result<(), ErrorKind> {
            Err(ErrorKind::Other)
        }
        fn transfer(&mut self, _: &mut [u8], _: &[u8]) -> Result<(), ErrorKind> {
            Err(ErrorKind::Other)
        }
        fn transfer_in_place(&mut self, _: &mut [u8]) -> Result<(), ErrorKind> {
            Err(ErrorKind::Other)
        }
        fn flush(&mut self) -> Result<(), ErrorKind> {
            Ok(())
        }
    }

    impl AsyncBus for Bus<'_> {
        async fn read(&mut self, _: &mut [u8]) -> Result<(), ErrorKind> {
            Err(ErrorKind::Other)
        }
        async fn write(&mut self, bytes: &[u8]) -> Result<(), ErrorKind> {
            self.0.borrow_mut().push(Event::Started);
            yield_now().await;
            self.0.borrow_mut().push(Event::Sent(bytes.to_vec()));
            self.1 = self.1.checked_sub(1).ok_or(ErrorKind::Overrun)?;
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

    /// Sends two bands, of one byte and of two.
    fn send(log: &Log, good: usize) -> Result<(), ErrorKind> {
        let mut link = Link::new(Bus(log, good), Pin(Some(log)), Pin(None));
        let mut bands = [&[1][..], &[2, 3]].into_iter();
        block_on(link.send(&mut [[0; BAND]; 2], |bytes| {
            log.borrow_mut().push(Event::Filled);
            let band = bands.next().unwrap_or_default();
            bytes[..band.len()].copy_from_slice(band);
            band.len()
        }))
    }

    #[test]
    fn a_band_is_filled_while_one_is_sent() {
        use Event::{Filled, Selected, Sent, Started};
        let log = Log::default();
        assert_eq!(send(&log, 2), Ok(()));
        let expected = [
            Selected(true),
            Filled,
            Started,
            Filled,
            Sent([1].to_vec()),
            Started,
            Filled,
            Sent([2, 3].to_vec()),
            Selected(false),
        ];
        assert_eq!(*log.borrow(), expected);
    }

    #[test]
    fn an_error_is_told_and_the_display_let_go() {
        for good in 0..2 {
            let log = Log::default();
            assert_eq!(send(&log, good), Err(ErrorKind::Overrun));
            assert_eq!(log.borrow().last(), Some(&Event::Selected(false)));
        }
    }
}

//! The few peripherals of the LM3S6965 that this board needs: clock gates, output pins, and the
//! synchronous serial interface (an Arm PL022) as an SPI bus.

use core::convert::Infallible;
use core::ptr;

use embedded_hal::digital::{self, OutputPin};
use embedded_hal::spi::{self, SpiBus};

/// A block of registers at a fixed address.
#[derive(Clone, Copy)]
struct Registers(usize);

impl Registers {
    fn read(self, offset: usize) -> u32 {
        // SAFETY: only this module makes `Registers`, with the base addresses of peripherals
        // that the data sheet lists; all offsets used here are aligned registers of theirs.
        unsafe { ptr::read_volatile(ptr::with_exposed_provenance::<u32>(self.0 + offset)) }
    }

    fn write(self, offset: usize, value: u32) {
        // SAFETY: as in `read`; no register written here has an effect on memory.
        unsafe {
            ptr::write_volatile(ptr::with_exposed_provenance_mut::<u32>(self.0 + offset), value);
        }
    }

    fn set(self, offset: usize, bits: u32) {
        self.write(offset, self.read(offset) | bits);
    }
}

const SYSTEM_CONTROL: Registers = Registers(0x400F_E000);
const GPIO_A: Registers = Registers(0x4000_4000);
const GPIO_C: Registers = Registers(0x4000_6000);
const GPIO_D: Registers = Registers(0x4000_7000);
const SSI0: Registers = Registers(0x4000_8000);

/// The peripherals that lead to the display.
pub(crate) struct Peripherals {
    /// SPI: clock on A2, data on A5.
    pub(crate) ssi: Ssi,
    /// C7: data (high) or command (low).
    pub(crate) data_command: Pin,
    /// A3: selects the display when low.
    pub(crate) select: Pin,
}

impl Peripherals {
    /// Switches them on. To be called once: two `Ssi` would mix their bytes.
    pub(crate) fn new() -> Self {
        /// Run-time clock gates 1 (serial interfaces) and 2 (ports).
        const RCGC1: usize = 0x104;
        const RCGC2: usize = 0x108;
        SYSTEM_CONTROL.set(RCGC1, 1 << 4);
        SYSTEM_CONTROL.set(RCGC2, 1 << 0 | 1 << 2 | 1 << 3);
        // A clock takes three cycles to arrive.
        SYSTEM_CONTROL.read(RCGC2);
        // D0 selects the card slot on the same bus when low. (The emulator selects the display
        // with the same line, when high, and knows nothing of A3.)
        Pin::new(GPIO_D, 0).write(1);
        Self { ssi: Ssi::new(), data_command: Pin::new(GPIO_C, 7), select: Pin::new(GPIO_A, 3) }
    }
}

/// An output pin.
pub(crate) struct Pin {
    port: Registers,
    mask: u32,
}

impl Pin {
    fn new(port: Registers, number: u32) -> Self {
        /// Direction, and digital function.
        const DIR: usize = 0x400;
        const DEN: usize = 0x51C;
        let mask = 1 << number;
        port.set(DIR, mask);
        port.set(DEN, mask);
        Self { port, mask }
    }

    /// The data register is one for each mask of pins, so that a write changes no other pin: the
    /// mask stands in bits 9 to 2 of the address.
    fn write(&self, value: u32) {
        self.port.write((self.mask as usize) << 2, value);
    }
}

impl digital::ErrorType for Pin {
    type Error = Infallible;
}

impl OutputPin for Pin {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.write(0);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.write(self.mask);
        Ok(())
    }
}

/// The serial interface as a bus: eight bits, mode 0.
pub(crate) struct Ssi(());

impl Ssi {
    const CR0: usize = 0x00;
    const CR1: usize = 0x04;
    const DR: usize = 0x08;
    const SR: usize = 0x0C;
    const CPSR: usize = 0x10;
    /// The transmit FIFO has room.
    const NOT_FULL: u32 = 1 << 1;
    /// The receive FIFO has something.
    const RECEIVED: u32 = 1 << 2;
    /// Something is being sent.
    const BUSY: u32 = 1 << 4;

    fn new() -> Self {
        /// Alternate function, and digital function, of A2 and A5.
        const AFSEL: usize = 0x420;
        const DEN: usize = 0x51C;
        GPIO_A.set(AFSEL, 1 << 2 | 1 << 5);
        GPIO_A.set(DEN, 1 << 2 | 1 << 5);
        // Off while it is set up.
        SSI0.write(Self::CR1, 0);
        // The display takes up to 4 MHz: a quarter of the core's 12.5 MHz.
        SSI0.write(Self::CPSR, 4);
        SSI0.write(Self::CR0, 8 - 1);
        SSI0.write(Self::CR1, 1 << 1);
        Self(())
    }

    /// Sends a byte and returns the one that came meanwhile.
    fn exchange(&mut self, byte: u8) -> u8 {
        while SSI0.read(Self::SR) & Self::NOT_FULL == 0 {}
        SSI0.write(Self::DR, u32::from(byte));
        while SSI0.read(Self::SR) & Self::RECEIVED == 0 {}
        SSI0.read(Self::DR) as u8
    }
}

impl spi::ErrorType for Ssi {
    type Error = Infallible;
}

impl SpiBus for Ssi {
    fn read(&mut self, words: &mut [u8]) -> Result<(), Infallible> {
        for word in words {
            *word = self.exchange(0);
        }
        Ok(())
    }

    fn write(&mut self, words: &[u8]) -> Result<(), Infallible> {
        for &word in words {
            self.exchange(word);
        }
        Ok(())
    }

    fn transfer(&mut self, read: &mut [u8], write: &[u8]) -> Result<(), Infallible> {
        for i in 0..read.len().max(write.len()) {
            let came = self.exchange(write.get(i).copied().unwrap_or(0));
            if let Some(word) = read.get_mut(i) {
                *word = came;
            }
        }
        Ok(())
    }

    fn transfer_in_place(&mut self, words: &mut [u8]) -> Result<(), Infallible> {
        for word in words {
            *word = self.exchange(*word);
        }
        Ok(())
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        while SSI0.read(Self::SR) & Self::BUSY != 0 {}
        Ok(())
    }
}

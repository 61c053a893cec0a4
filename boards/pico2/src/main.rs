//! Raspberry Pi Pico 2 (RP2350): traces on one of its Arm cores, in `f32` on the floating-point unit or,
//! with the feature `fixed`, in fixed point, and draws on an ST7789 of 240×240 pixels. It goes from
//! scene to scene.
#![no_std]
#![no_main]

use defmt_rtt as _;
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor;
use embedded_graphics::prelude::*;
use embedded_hal::delay::DelayNs;
use embedded_hal::spi::MODE_3;
use embedded_hal_bus::spi::ExclusiveDevice;
use mipidsi::Builder;
use mipidsi::interface::SpiInterface;
use mipidsi::models::ST7789;
use mipidsi::options::ColorInversion;
use panic_probe as _;
use rp235x_hal::block::ImageDef;
use rp235x_hal::clocks::{Clock, init_clocks_and_plls};
use rp235x_hal::fugit::RateExtU32;
use rp235x_hal::gpio::{FunctionSpi, PinState, Pins};
use rp235x_hal::{Sio, Spi, Timer, Watchdog, pac};
use whitted::Picture;
use whitted::math::Arithmetic;
use whitted::trace::Work;
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::job::SceneName;
use whitted_demo::rgb565;
use whitted_demo::scenes::{Shot, Shots, View};

#[cfg(feature = "fixed")]
type Number = whitted::math::Fixed;
#[cfg(not(feature = "fixed"))]
type Number = f32;

/// What the boot ROM wants to know: an image for the Arm cores, in their secure state.
// SAFETY: `memory.x` places this section where the boot ROM looks for the definition.
#[unsafe(link_section = ".start_block")]
#[used]
static IMAGE: ImageDef = ImageDef::secure_exe();

/// The display's pixels across and down.
const SIZE: (u16, u16) = (240, 240);
/// How long a picture stays.
const PAUSE_MS: u32 = 3000;
const CRYSTAL_HZ: u32 = 12_000_000;
/// What an ST7789 is sure to take.
const SPI_MHZ: u32 = 32;

#[rp235x_hal::entry]
fn main() -> ! {
    let mut chip = pac::Peripherals::take().expect("taken once");
    let mut watchdog = Watchdog::new(chip.WATCHDOG);
    let clocks = init_clocks_and_plls(
        CRYSTAL_HZ,
        chip.XOSC,
        chip.CLOCKS,
        chip.PLL_SYS,
        chip.PLL_USB,
        &mut chip.RESETS,
        &mut watchdog,
    )
    .expect("the crystal of a Pico 2");
    let mut timer = Timer::new_timer0(chip.TIMER0, &mut chip.RESETS, &clocks);
    let sio = Sio::new(chip.SIO);
    let pins = Pins::new(chip.IO_BANK0, chip.PADS_BANK0, sio.gpio_bank0, &mut chip.RESETS);

    let data = pins.gpio11.into_function::<FunctionSpi>();
    let clock = pins.gpio10.into_function::<FunctionSpi>();
    let select = pins.gpio9.into_push_pull_output_in_state(PinState::High);
    let data_command = pins.gpio8.into_push_pull_output();
    let reset = pins.gpio12.into_push_pull_output_in_state(PinState::High);
    // Mode 3 works with and without a select line.
    let spi = Spi::<_, _, _, 8>::new(chip.SPI1, (data, clock)).init(
        &mut chip.RESETS,
        clocks.peripheral_clock.freq(),
        SPI_MHZ.MHz(),
        MODE_3,
    );
    let device = ExclusiveDevice::new_no_delay(spi, select).expect("pins can't fail");
    let mut buffer = [0; 480];
    let mut display = Builder::new(ST7789, SpiInterface::new(device, data_command, &mut buffer))
        .display_size(SIZE.0, SIZE.1)
        .invert_colors(ColorInversion::Inverted)
        .reset_pin(reset)
        .init(&mut timer)
        .expect("pins and SPI can't fail");

    for scene in SceneName::ALL.into_iter().filter(|scene| !scene.is_for_counting()).cycle() {
        let start = timer.get_counter();
        match Number::shot(scene, Draw { display: &mut display }) {
            Ok(()) => {
                let took = timer.get_counter() - start;
                defmt::info!("{=str}: {=u64} us", scene.name(), took.to_micros());
            }
            Err(_) => defmt::error!("SPI: the frame isn't whole"),
        }
        timer.delay_ms(PAUSE_MS);
    }
    unreachable!("the scenes go round")
}

/// Drawing with embedded-graphics.
struct Draw<'a, D> {
    display: &'a mut D,
}

impl<A: Arithmetic, D: DrawTarget<Color = pixelcolor::Rgb565>> View<A> for Draw<'_, D> {
    type Output = Result<(), D::Error>;

    /// Not inlined, so that the stack it takes is its own.
    #[inline(never)]
    fn view<const USES: u64>(self, shot: Shot<A, USES>) -> Self::Output {
        let mut work = Work::<A, MAX_DEPTH>::new();
        let renderer = rgb565::renderer(&shot, SIZE.0, SIZE.1, &mut work);
        let picture = Picture::<_, pixelcolor::Rgb565, MAX_DEPTH, (), USES>::from_renderer(
            renderer,
            shot.output,
        );
        Image::new(&picture, Point::zero()).draw(self.display)
    }
}

//! STM32F411 "Black Pill": traces a scene band by band of rows, and sends each to an ILI9341 by DMA
//! while it traces the next.
//!
//! Left to itself it goes from scene to scene, in both arithmetics, and on at a press of the KEY
//! button. Built for an STM32F405 it draws what the emulator's command line asks for.
#![no_std]
#![no_main]

mod board;
mod draw;
mod link;
#[cfg_attr(feature = "f411", path = "dma.rs")]
#[cfg_attr(feature = "f405", path = "blocking.rs")]
mod sender;
#[cfg(feature = "f411")]
mod show;

#[cfg(feature = "f411")]
#[cortex_m_rt::entry]
fn main() -> ! {
    show::run(board::Board::take())
}

#[cfg(feature = "f405")]
#[cortex_m_rt::entry]
fn main() -> ! {
    use whitted_demo::{board as demo, stack};

    let mut board = board::Board::take();
    demo::for_each_job(|job| {
        let top = stack::paint();
        let sent = draw::frame(&mut board.display, job);
        let (stack, memory) = (stack::used(top), stack::static_bytes());
        if let Err(error) = sent {
            semihosting::println!("error {job}: the frame isn't whole: {error:?}");
            demo::exit(false)
        }
        semihosting::println!("frame job={job} stack={stack} static={memory}");
    });
    demo::exit(true)
}

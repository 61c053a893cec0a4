//! The bathroom under the area light of its window, what its surfaces send each other in irradiance
//! records, baked to Rust source by the build script, drawn and compared with the picture that the
//! host made.
#![no_std]
#![no_main]

use semihosting::println;
use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::trace::Work;
use whitted_demo::board::{self, Board};
use whitted_demo::checksum::Checksum;
use whitted_demo::stack;

/// As the build script baked it.
#[allow(dead_code, unreachable_pub, reason = "as it was baked")]
mod scene {
    include!(env!("SOURCE"));
}

use scene::{Baked, CAMERA, DEPTH, SIZE};

/// The checksum of the host's picture, and its rays.
const WANTED: &str = env!("SOURCE_WANTED");
const RAYS: &str = env!("SOURCE_RAYS");

/// The machine's clock.
const CLOCK_KHZ: u32 = 25_000;

/// Never inlined: what its caller measures of the stack begins with its frame.
#[inline(never)]
fn draw(board: &mut Board) -> Option<u64> {
    let mut work = Work::<scene::A, { DEPTH as usize }>::new();
    let settings = Settings { depth: DEPTH, ..Settings::new(SIZE.0, SIZE.1) };
    let mut renderer = Renderer::new(Baked, &CAMERA, settings, &mut work, &mut []).ok()?;
    let mut line = [Rgb888::default(); SIZE.0 as usize];
    let mut sum = Checksum::EMPTY;
    for y in 0..SIZE.1 {
        board.counted(|| renderer.line(y, &Output::SRGB, &mut line));
        sum.add(line.iter().flat_map(|pixel| pixel.0));
    }
    Some(sum.value())
}

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut board = Board::new("source", CLOCK_KHZ);
    let top = stack::paint();
    let drawn = draw(&mut board);
    let (stack, statics) = (stack::used(top), stack::static_bytes());
    let Some(sum) = drawn else {
        println!("error: settings that don't fit the scene");
        board::exit(false)
    };
    let same = WANTED.parse() == Ok(sum);
    let instructions = board.instructions();
    println!(
        "result board=source checksum={sum:016x} same-as-host={same} \
         instructions={instructions} rays={RAYS} stack={stack} static={statics}"
    );
    board::exit(same)
}

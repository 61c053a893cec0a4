//! What a firmware does: draws its jobs, and prints a line about each.
//!
//! Lines are `result key=value …`, for programs to read:
//!
//! | key | value |
//! |---|---|
//! | `board` | the firmware |
//! | `job` | what was drawn |
//! | `checksum` | of the pixels, hexadecimal |
//! | `instructions` | spent tracing, without set-up and checksum |
//! | `stack` | bytes of stack, row buffer and the tracer's work memory included |
//! | `static` | bytes of static RAM |
//! | `rays` | primary, reflection, transmission, shadow, ambient; with the feature `rays` |

use core::panic::PanicInfo;

use semihosting::{print, println};

use crate::counter::{self, Counter};
use crate::depths;
use crate::frame::{self, Watch};
use crate::job::{ArithName, Job};
use crate::stack;

/// Room for the command line: the firmware's path and a job for each scene.
const COMMAND_LINE: usize = 1024;
/// Rounds of the loop that checks the clock.
const ROUNDS: u32 = 1_000_000;

/// A board as this module needs it.
pub struct Board {
    name: &'static str,
    clock_khz: u32,
    counter: Counter,
}

impl Board {
    /// The board `name`, whose counter runs at `clock_khz`. Prints what a loop of two
    /// million instructions counted as, which shows whether that clock is right.
    ///
    /// # Panics
    /// When called twice.
    #[must_use]
    pub fn new(name: &'static str, clock_khz: u32) -> Self {
        let mut board = Self { name, clock_khz, counter: Counter::new() };
        board.counter.before();
        counter::spin(ROUNDS);
        board.counter.after();
        let counted = board.instructions();
        println!("clock board={name} loop={} counted={counted}", 2 * ROUNDS);
        board
    }

    /// Draws the jobs of the command line, or else [`Job::small`], one result line each.
    pub fn draw_all(&mut self) {
        let any = for_each_word(|word| {
            #[cfg(feature = "counted")]
            if let Some(shapes) = word.strip_prefix("rebuild:").and_then(|n| n.parse().ok()) {
                return self.rebuild(shapes);
            }
            self.draw(&job(word));
        });
        if !any {
            Job::small().for_each(|job| self.draw(&job));
        }
    }

    /// Draws one job and prints its result.
    pub fn draw(&mut self, job: &Job) {
        let top = stack::paint();
        let checksum = frame::draw(job, &mut self.counter, |_| {});
        let stack = stack::used(top);
        let instructions = self.instructions();
        print!(
            "result board={} job={job} checksum={:016x} instructions={instructions} \
             stack={stack} static={}",
            self.name,
            checksum.value(),
            stack::static_bytes(),
        );
        #[cfg(feature = "rays")]
        print_rays(job, checksum);
        println!();
    }

    /// Builds a tree over so many shapes and prints a line `rebuilt …`.
    #[cfg(feature = "counted")]
    fn rebuild(&mut self, shapes: usize) {
        let built = crate::rebuild::rebuild(shapes, &mut self.counter);
        let instructions = self.instructions();
        println!(
            "rebuilt board={} shapes={shapes} checksum={:016x} instructions={instructions} \
             words={} scratch={}",
            self.name,
            built.checksum.value(),
            built.words,
            built.scratch,
        );
    }

    /// Draws the frame of [`depths`] with memory for each depth, and prints a line `depth …` about
    /// each: the bytes of `Work` (`memory`), and of stack. In `f32` too, where the core computes it.
    #[inline]
    pub fn depths(&mut self) {
        /// Each arithmetic is eight copies of the tracer.
        const HERE: &[ArithName] =
            if cfg!(target_abi = "eabihf") { &ArithName::ALL } else { &[ArithName::Fixed] };
        for &arith in HERE {
            for depths::Depth { depth, memory, draw } in depths::all(arith) {
                let top = stack::paint();
                let checksum = draw();
                let stack = stack::used(top);
                println!(
                    "depth board={} arith={} depth={depth} checksum={:016x} memory={memory} \
                     stack={stack}",
                    self.name,
                    arith.name(),
                    checksum.value(),
                );
            }
        }
    }

    /// Draws on a display, then prints a line `shown …` with what that took, tracing included.
    pub fn shown(&mut self, draw: impl FnOnce()) {
        let top = stack::paint();
        self.counter.before();
        draw();
        self.counter.after();
        let stack = stack::used(top);
        let instructions = self.instructions();
        println!("shown board={} instructions={instructions} stack={stack}", self.name);
    }

    /// Does something of the firmware's own and counts its instructions: 670 million at most, for
    /// [`instructions`](Self::instructions) to add up.
    pub fn counted<R>(&mut self, act: impl FnOnce() -> R) -> R {
        self.counter.before();
        let made = act();
        self.counter.after();
        made
    }

    /// The instructions counted since this was last asked.
    pub fn instructions(&mut self) -> u64 {
        self.counter.take() * 1_000_000 / u64::from(self.clock_khz)
    }
}

/// Does something with each word of the command line; whether there are any.
fn for_each_word(mut each: impl FnMut(&str)) -> bool {
    let args = semihosting::experimental::env::args::<COMMAND_LINE>().ok();
    // The first is the firmware's path.
    let words = args.iter().flatten().skip(1).filter_map(Result::ok);
    let mut any = false;
    for word in words {
        any = true;
        each(word);
    }
    any
}

/// The job that a word of the command line asks for.
fn job(word: &str) -> Job {
    match word.parse() {
        Ok(job) => job,
        Err(error) => {
            println!("error {word}: {error}");
            exit(false)
        }
    }
}

/// Does something with the jobs of the command line, or else with [`Job::small`].
pub fn for_each_job(mut each: impl FnMut(&Job)) {
    if !for_each_word(|word| each(&job(word))) {
        Job::small().for_each(|job| each(&job));
    }
}

/// Draws the job again, counting: with the first time's instructions, those of counting would have
/// been counted too.
#[cfg(feature = "rays")]
fn print_rays(job: &Job, checksum: crate::checksum::Checksum) {
    let (again, rays) = frame::count(job);
    if again != checksum {
        println!("\nerror {job}: counting rays changes the picture");
        exit(false)
    }
    print!(
        " rays={},{},{},{},{}",
        rays.primary, rays.reflection, rays.transmission, rays.shadow, rays.ambient
    );
}

/// Ends the emulator, with success or without.
pub fn exit(success: bool) -> ! {
    semihosting::process::exit(i32::from(!success))
}

/// Leaves the picture on the display.
pub fn idle() -> ! {
    loop {
        #[cfg(target_arch = "arm")]
        cortex_m::asm::wfi();
        #[cfg(target_arch = "riscv32")]
        riscv::asm::wfi();
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    println!("error {info}");
    exit(false)
}

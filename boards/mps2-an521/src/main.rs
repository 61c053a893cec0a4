//! Arm MPS2 with two Cortex-M33: both trace one picture, a row at a time, whoever is free.
//!
//! Every job of one ray a pixel is drawn twice, by the first core alone and by both, and must come out
//! the same. A line
//! `shared board=… job=… checksum=… alone=… cores=…,…` says how many instructions each took.
#![no_std]
#![no_main]

mod rows;
mod second;

use semihosting::println;
use whitted_demo::board::{self, Board};
use whitted_demo::job::Job;

#[cortex_m_rt::entry]
fn main() -> ! {
    // Its clock is AN505's.
    let mut board = Board::new("mps2-an521", rows::CLOCK_KHZ);
    second::start();
    let args = semihosting::experimental::env::args::<1024>().ok();
    // The first is the firmware's path.
    let args = args.iter().flatten().skip(1).filter_map(Result::ok);
    let mut any = false;
    for job in args.map(str::parse) {
        match job {
            Ok(job) => draw(&mut board, &job),
            Err(error) => {
                println!("error {error}");
                board::exit(false)
            }
        }
        any = true;
    }
    if !any {
        Job::small().for_each(|job| draw(&mut board, &job));
    }
    board::exit(true)
}

fn draw(board: &mut Board, job: &Job) {
    board.draw(job);
    if job.sampling_name().is_some() {
        // Those that remember a row would trace it twice.
        return;
    }
    rows::begin(job);
    let alone = rows::work();
    let picture = rows::checksum();
    rows::begin(job);
    second::begin();
    let first = rows::work();
    let second = second::end();
    if rows::checksum() != picture {
        println!("error {job}: two cores draw another picture");
        board::exit(false)
    }
    println!(
        "shared board=mps2-an521 job={job} checksum={:016x} alone={alone} cores={first},{second}",
        picture.value()
    );
}

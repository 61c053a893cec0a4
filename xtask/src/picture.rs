//! What a board draws, as the host draws it: the pictures in the boards' READMEs.

use std::path::Path;

use embedded_graphics::pixelcolor::raw::RawU16;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use whitted_demo::checksum::Checksum;
use whitted_demo::job::{Job, JobError};
use whitted_demo::{frame, rgb565, room};
use whitted_host::document::Size;
use whitted_host::picture::Picture;

const USAGE: &str = "\
cargo xtask picture JOB|room [-o FILE.png] [--rgb565]
    a job is as a board gets it, limit:fixed:120x90; --rgb565 rounds to a display's 16 bits";

/// The command: draws a job, writes it, and says the checksum that a board has to print.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let (job, mut words) = words.split_first().ok_or(USAGE)?;
    let (mut file, mut narrow) = (None, false);
    while let [option, rest @ ..] = words {
        words = match (*option, rest) {
            ("--rgb565", rest) => {
                narrow = true;
                rest
            }
            ("-o", [name, rest @ ..]) => {
                file = Some(Path::new(*name));
                rest
            }
            _ => return Err(USAGE.into()),
        };
    }
    let mut pixels = Vec::new();
    let mut keep = |row: &[whitted::frame::Rgb888]| pixels.extend(row.iter().map(|p| p.0));
    let (size, checksum): ((u16, u16), Checksum) = if *job == "room" {
        (room::SIZE, room::draw(&mut keep).checksum)
    } else {
        let job: Job = job.parse().map_err(|error: JobError| format!("{error}\n{USAGE}"))?;
        let size = (job.width, job.height);
        let checksum = frame::draw(&job, &mut (), &mut keep);
        if narrow {
            let mut bytes = vec![0; usize::from(size.0) * usize::from(size.1) * rgb565::BYTES];
            rgb565::draw_in(job.arith, job.scene, size.0, size.1, &mut bytes);
            pixels = widened(&bytes);
        }
        (size, checksum)
    };
    println!("checksum {:016x}", checksum.value());
    file.map_or(Ok(()), |file| save(file, size, &pixels))
}

/// The colours of a display's pixels, big-endian, as 24 bits.
fn widened(bytes: &[u8]) -> Vec<[u8; 3]> {
    let (pixels, _) = bytes.as_chunks::<{ rgb565::BYTES }>();
    let wide = |&pixel| {
        let color = Rgb888::from(Rgb565::from(RawU16::new(u16::from_be_bytes(pixel))));
        [color.r(), color.g(), color.b()]
    };
    pixels.iter().map(wide).collect()
}

/// Writes what a display's memory holds as a PNG.
pub(crate) fn save_rgb565(path: &Path, size: (u16, u16), bytes: &[u8]) -> Result<(), String> {
    save(path, size, &widened(bytes))
}

/// Writes pixels as a PNG.
fn save(path: &Path, (width, height): (u16, u16), pixels: &[[u8; 3]]) -> Result<(), String> {
    let mut picture = Picture::new(Size { width: width.into(), height: height.into() });
    picture.pixels_mut().copy_from_slice(pixels);
    picture.save(path).map_err(|error| format!("{}: {error}", path.display()))
}

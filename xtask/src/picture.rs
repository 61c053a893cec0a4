//! What a board draws, as the host draws it: the pictures in the boards' READMEs.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use embedded_graphics::pixelcolor::raw::RawU16;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use whitted_demo::checksum::Checksum;
use whitted_demo::job::{Job, JobError};
use whitted_demo::{frame, rgb565, room};

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
    let mut keep = |row: &[whitted::frame::Rgb888]| pixels.extend(row.iter().flat_map(|p| p.0));
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
    file.map_or(Ok(()), |file| png(file, size, &pixels))
}

/// The colours of a display's pixels, big-endian, as 24 bits.
fn widened(bytes: &[u8]) -> Vec<u8> {
    let (pixels, _) = bytes.as_chunks::<{ rgb565::BYTES }>();
    pixels
        .iter()
        .flat_map(|&pixel| {
            let color = Rgb888::from(Rgb565::from(RawU16::new(u16::from_be_bytes(pixel))));
            [color.r(), color.g(), color.b()]
        })
        .collect()
}

/// Writes pixels of 24 bits as a PNG.
fn png(path: &Path, size: (u16, u16), rgb: &[u8]) -> Result<(), String> {
    let place = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let file = File::create(path).map_err(|error| place(&error))?;
    let mut encoder = png::Encoder::new(BufWriter::new(file), size.0.into(), size.1.into());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(rgb).and_then(|()| writer.finish()))
        .map_err(|error| place(&error))
}

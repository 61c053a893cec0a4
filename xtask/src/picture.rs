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

/// What the command was told.
struct Order<'a> {
    /// A job, or `room`.
    job: &'a str,
    /// Where the picture goes.
    file: Option<&'a Path>,
    /// Whether its colours are a display's of 16 bits.
    narrow: bool,
}

impl<'a> Order<'a> {
    fn parse(words: &[&'a str]) -> Result<Self, String> {
        let (job, mut words) = words.split_first().ok_or(USAGE)?;
        let mut order = Self { job, file: None, narrow: false };
        while let [option, rest @ ..] = words {
            words = match (*option, rest) {
                ("--rgb565", rest) => {
                    order.narrow = true;
                    rest
                }
                ("-o", [name, rest @ ..]) => {
                    order.file = Some(Path::new(*name));
                    rest
                }
                _ => return Err(USAGE.into()),
            };
        }
        Ok(order)
    }

    /// Draws, and sums what a board sums.
    fn draw(&self) -> Result<(Picture, Checksum), String> {
        let mut pixels = Vec::new();
        let mut keep = |row: &[whitted::frame::Rgb888]| pixels.extend(row.iter().map(|p| p.0));
        if self.job == "room" {
            let checksum = room::draw(&mut keep).checksum;
            return Ok((picture(room::SIZE, &pixels), checksum));
        }
        let job: Job = self.job.parse().map_err(|error: JobError| format!("{error}\n{USAGE}"))?;
        let size = (job.width, job.height);
        let checksum = frame::draw(&job, &mut (), &mut keep);
        if self.narrow {
            let mut bytes = vec![0; usize::from(size.0) * usize::from(size.1) * rgb565::BYTES];
            rgb565::draw(&job, &mut bytes);
            pixels = widened(&bytes);
        }
        Ok((picture(size, &pixels), checksum))
    }
}

/// The command: draws a job, writes it, and says the checksum that a board has to print.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let order = Order::parse(words)?;
    let (picture, checksum) = order.draw()?;
    println!("checksum {:016x}", checksum.value());
    order.file.map_or(Ok(()), |file| save(file, &picture))
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
    save(path, &picture(size, &widened(bytes)))
}

fn picture((width, height): (u16, u16), pixels: &[[u8; 3]]) -> Picture {
    let mut picture = Picture::new(Size { width: width.into(), height: height.into() });
    picture.pixels_mut().copy_from_slice(pixels);
    picture
}

fn save(path: &Path, picture: &Picture) -> Result<(), String> {
    picture.save(path).map_err(|error| format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::Order;
    use crate::{compare, shell};

    /// The boards whose READMEs show a picture that `cargo xtask picture` draws. Of the others, `baked`
    /// shows one that `whitted render` draws, and `lm3s6965evb` its display's sixteen greys.
    const BOARDS: [&str; 10] = [
        "microbit",
        "microbit-v2",
        "mps2",
        "mps2-an521",
        "mps2-m33",
        "pico",
        "pico-async",
        "room",
        "stm32f4",
        "virt",
    ];

    #[test]
    fn readmes_show_what_their_commands_draw() {
        for board in BOARDS {
            let readme = shell::root().join("boards").join(board).join("README.md");
            let text = std::fs::read_to_string(&readme).unwrap();
            let (_, command) = text.split_once("`cargo xtask picture").expect(board);
            let (command, _) = command.split_once('`').expect(board);
            let words: Vec<_> = command.split_whitespace().collect();
            let order = Order::parse(&words).unwrap();
            let (picture, checksum) = order.draw().unwrap();

            let shown = shell::root().join("docs/pictures/boards").join(format!("{board}.png"));
            let shown = compare::open(&shown).unwrap();
            assert_eq!(shown.size(), picture.size(), "{board}");
            assert!(shown.pixels() == picture.pixels(), "{board}: draw it anew: {words:?}");
            // Those that are read as pixels of a display print no checksum.
            if !order.narrow {
                let checksum = format!("{:016x}", checksum.value());
                assert!(text.contains(&checksum), "{board}: {checksum}");
            }
        }
    }
}

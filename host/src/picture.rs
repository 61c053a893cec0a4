//! Pictures: rows of 8-bit sRGB pixels, as PNG and as text for a terminal.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::Path;

use crate::document::Size;

/// A picture, 8-bit sRGB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    size: Size,
    pixels: Vec<[u8; 3]>,
}

impl Picture {
    /// A black picture.
    pub fn new(size: Size) -> Self {
        Self { size, pixels: vec![[0; 3]; size.width as usize * size.height as usize] }
    }

    /// Its size.
    pub fn size(&self) -> Size {
        self.size
    }

    /// All pixels, row by row from above.
    pub fn pixels(&self) -> &[[u8; 3]] {
        &self.pixels
    }

    /// All pixels, row by row from above.
    pub fn pixels_mut(&mut self) -> &mut [[u8; 3]] {
        &mut self.pixels
    }

    /// The rows from above.
    pub fn rows_mut(&mut self) -> impl Iterator<Item = &mut [[u8; 3]]> {
        self.pixels.chunks_exact_mut(self.size.width.max(1) as usize)
    }

    /// Writes it as a PNG.
    ///
    /// # Errors
    /// What the writer has.
    pub fn write_png(&self, to: impl Write) -> io::Result<()> {
        let mut encoder = png::Encoder::new(to, self.size.width, self.size.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels.as_flattened())?;
        Ok(writer.finish()?)
    }

    /// Saves it as a PNG: whole or not at all.
    ///
    /// # Errors
    /// What the file system has.
    pub fn save(&self, path: &Path) -> io::Result<()> {
        save(path, |file| self.write_png(io::BufWriter::new(file)))
    }

    /// The picture as lines of half blocks in 24-bit colour, two rows of pixels a line, reduced
    /// to `columns` and `lines` if it is larger.
    pub fn to_terminal(&self, columns: u32, lines: u32) -> String {
        let Size { width, height } = self.size;
        let shrink = (f64::from(width) / f64::from(columns.max(1)))
            .max(f64::from(height) / (2.0 * f64::from(lines.max(1))))
            .max(1.0);
        let columns = ((f64::from(width) / shrink) as u32).max(1);
        let rows = ((f64::from(height) / shrink) as u32).max(1);
        let mut text = String::new();
        for y in (0..rows).step_by(2) {
            for x in 0..columns {
                let [r, g, b] = self.mean(x, y, columns, rows);
                let _ = write!(text, "\x1b[38;2;{r};{g};{b}");
                if y + 1 < rows {
                    let [r, g, b] = self.mean(x, y + 1, columns, rows);
                    let _ = write!(text, ";48;2;{r};{g};{b}");
                }
                text.push_str("m▀");
            }
            text.push_str("\x1b[0m\n");
        }
        text
    }

    /// The mean of the pixels that fall into one of `columns` × `rows` cells.
    fn mean(&self, x: u32, y: u32, columns: u32, rows: u32) -> [u8; 3] {
        let span = |i: u32, n: u32, all: u32| {
            let edge = |i: u32| (u64::from(i) * u64::from(all) / u64::from(n)) as usize;
            edge(i)..edge(i + 1).max(edge(i) + 1)
        };
        let mut sum = [0u64; 3];
        let mut count = 0;
        for row in span(y, rows, self.size.height) {
            for column in span(x, columns, self.size.width) {
                let index = row * self.size.width as usize + column;
                let Some(pixel) = self.pixels.get(index) else { continue };
                sum.iter_mut().zip(pixel).for_each(|(s, &p)| *s += u64::from(p));
                count += 1;
            }
        }
        sum.map(|s| (s / count.max(1)) as u8)
    }
}

/// Writes a file beside `path` and renames it: a reader finds the old file, the new one or
/// none, never half of one. A link stays a link, and what is no file (a pipe, a device) is written to.
///
/// # Errors
/// What the file system has, or `write`.
pub fn save(
    path: &Path,
    write: impl FnOnce(&mut std::fs::File) -> io::Result<()>,
) -> io::Result<()> {
    let known = path.metadata();
    if known.as_ref().is_ok_and(|about| !about.is_file() && !about.is_dir()) {
        return write(&mut std::fs::File::options().write(true).open(path)?);
    }
    let path = &if known.is_ok() { path.canonicalize()? } else { path.to_owned() };
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".whitted-");
    // As `File::create` would make it; temporary files are their owner's alone by default.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder)?;
    write(file.as_file_mut())?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_as_text() {
        let mut picture = Picture::new(Size { width: 2, height: 2 });
        picture.pixels_mut().copy_from_slice(&[[1, 2, 3], [4, 5, 6], [7, 8, 9], [10, 11, 12]]);
        assert_eq!(
            picture.to_terminal(80, 25),
            "\x1b[38;2;1;2;3;48;2;7;8;9m▀\x1b[38;2;4;5;6;48;2;10;11;12m▀\x1b[0m\n"
        );
        assert_eq!(picture.to_terminal(1, 1), "\x1b[38;2;5;6;7m▀\x1b[0m\n");
    }

    #[cfg(unix)]
    #[test]
    fn links_and_pipes_are_written_to_and_not_replaced() {
        use std::io::Read;
        let place = tempfile::tempdir().unwrap();
        let at = |name: &str| place.path().join(name);
        std::fs::write(at("file"), "old").unwrap();
        std::os::unix::fs::symlink("file", at("link")).unwrap();
        save(&at("link"), |file| file.write_all(b"new")).unwrap();
        assert!(at("link").symlink_metadata().unwrap().is_symlink());
        assert_eq!(std::fs::read(at("file")).unwrap(), b"new");

        let made = std::process::Command::new("mkfifo").arg(at("pipe")).status();
        if !made.is_ok_and(|status| status.success()) {
            return eprintln!("skipped: there is no mkfifo");
        }
        let pipe = at("pipe");
        let reader = std::thread::spawn(move || {
            let mut bytes = Vec::new();
            std::fs::File::open(pipe).unwrap().read_to_end(&mut bytes).map(|_| bytes).unwrap()
        });
        save(&at("pipe"), |file| file.write_all(b"through")).unwrap();
        assert_eq!(reader.join().unwrap(), b"through");
    }

    #[test]
    fn a_png_comes_back() {
        let mut picture = Picture::new(Size { width: 3, height: 1 });
        picture.pixels_mut()[2] = [9, 8, 7];
        let mut bytes = Vec::new();
        picture.write_png(&mut bytes).unwrap();
        let mut reader = png::Decoder::new(io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = [0; 9];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!(pixels, [0, 0, 0, 0, 0, 0, 9, 8, 7]);
    }
}

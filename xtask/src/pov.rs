//! `cargo xtask pov`: a scene in POV-Ray's language, for pictures to compare with.

use std::path::{Path, PathBuf};

use whitted_host::document::Size;

use crate::USAGE;

/// What the command line asks for.
struct Options {
    scene: PathBuf,
    out: PathBuf,
    size: Option<Size>,
}

impl Options {
    fn read(words: &[&str]) -> Result<Self, String> {
        let (mut scene, mut out, mut size) = (None, None, None);
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            match word {
                "-o" => out = Some(*words.next().ok_or(USAGE)?),
                "--size" => size = Some(words.next().and_then(|w| sides(w)).ok_or(USAGE)?),
                _ if scene.is_none() && !word.starts_with('-') => scene = Some(word),
                _ => return Err(USAGE.into()),
            }
        }
        let scene = PathBuf::from(scene.ok_or(USAGE)?);
        let out = out.map_or_else(
            || Path::new(scene.file_stem().unwrap_or_default()).with_extension("pov"),
            PathBuf::from,
        );
        Ok(Self { scene, out, size })
    }
}

fn sides(text: &str) -> Option<Size> {
    let (width, height) = text.split_once('x')?;
    let side = |t: &str| t.parse().ok().filter(|n| (1..=Size::LARGEST).contains(n));
    Some(Size { width: side(width)?, height: side(height)? })
}

/// Reads a scene and writes it for POV-Ray.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let options = Options::read(words)?;
    let document = whitted_host::read::read(&options.scene).map_err(|error| error.to_string())?;
    // The camera has the proportions of the picture.
    let size = options.size.or(document.size).unwrap_or(Size { width: 320, height: 240 });
    let text = whitted_host::pov::to_pov(&document, size);
    let out = &options.out;
    std::fs::write(out, text).map_err(|error| format!("{}: {error}", out.display()))?;
    println!(
        "{out}: now povray +I{out} +O{picture} +W{w} +H{h} -A -D +FN8",
        out = out.display(),
        picture = out.with_extension("png").display(),
        w = size.width,
        h = size.height
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::Options;

    #[test]
    fn words() {
        let options = Options::read(&["a/b.nff", "--size", "8x6"]).unwrap();
        assert_eq!(options.out.to_str(), Some("b.pov"));
        assert_eq!(options.size.map(|s| (s.width, s.height)), Some((8, 6)));
        for wrong in [&[][..], &["a", "b"], &["-o", "a"], &["a", "-o"], &["a", "--size", "0x1"]] {
            assert!(Options::read(wrong).is_err(), "{wrong:?}");
        }
    }
}

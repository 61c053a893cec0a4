//! From a path to a [`Document`], by the ending of the file's name.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::document::Document;
use crate::error::{Flaw, Problem, SceneError};

/// More than any scene that fits a chip; keeps a wrong file from filling the memory.
const LARGEST: u64 = 256 << 20;

/// The formats that a scene can come in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Our own.
    Toml,
    /// Neutral File Format.
    Nff,
}

impl Format {
    /// The format that the ending of a name tells.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "toml" => Some(Self::Toml),
            "nff" => Some(Self::Nff),
            _ => None,
        }
    }

    /// Reads a text of this format.
    ///
    /// # Errors
    /// The first thing that is wrong with it, with its line.
    pub fn parse(self, text: &str) -> Result<Document, Flaw> {
        match self {
            Self::Toml => crate::toml::parse(text),
            Self::Nff => crate::nff::parse(text),
        }
    }
}

/// Reads a scene file.
///
/// # Errors
/// The first thing that is wrong with it, with file and line.
pub fn read(path: &Path) -> Result<Document, SceneError> {
    let (format, bytes) = load(path).map_err(|problem| problem.anywhere().of(path))?;
    parse(format, &bytes).map_err(|flaw| flaw.of(path))
}

/// Reads the bytes of a scene file.
///
/// # Errors
/// The first thing that is wrong with it, with its line.
pub fn parse(format: Format, bytes: &[u8]) -> Result<Document, Flaw> {
    let text = std::str::from_utf8(bytes).map_err(|e| not_text(bytes, e.valid_up_to()))?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if let Some(at) = text.bytes().position(|b| b == 0) {
        return Err(not_text(text.as_bytes(), at));
    }
    if text.trim().is_empty() {
        return Err(Problem::Empty.at(1));
    }
    format.parse(text)
}

fn load(path: &Path) -> Result<(Format, Vec<u8>), Problem> {
    let about = std::fs::metadata(path).map_err(Problem::Io)?;
    if about.is_dir() {
        return Err(Problem::Directory);
    }
    let format = Format::of(path).ok_or_else(|| Problem::Format {
        ending: path.extension().unwrap_or_default().to_string_lossy().into_owned(),
    })?;
    let mut bytes = Vec::new();
    let mut file = File::open(path).map_err(Problem::Io)?.take(LARGEST + 1);
    file.read_to_end(&mut bytes).map_err(Problem::Io)?;
    if bytes.len() as u64 > LARGEST {
        return Err(Problem::TooLarge { bytes: about.len().max(LARGEST + 1), most: LARGEST });
    }
    Ok((format, bytes))
}

fn not_text(bytes: &[u8], at: usize) -> Flaw {
    let line = 1 + bytes.iter().take(at).filter(|&&b| b == b'\n').count();
    Problem::NotText.at(line)
}

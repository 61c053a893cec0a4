//! From a path to a [`Document`], by the ending of the file's name.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

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
    /// Wavefront OBJ.
    Obj,
    /// glTF 2.0, as text or in one piece.
    Gltf,
}

impl Format {
    /// The format that the ending of a name tells.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "toml" => Some(Self::Toml),
            "nff" => Some(Self::Nff),
            "obj" => Some(Self::Obj),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }

    /// Reads a text of this format.
    ///
    /// # Errors
    /// The first thing that is wrong with it, with its line.
    pub fn parse(self, text: &str, around: &Around) -> Result<Document, Flaw> {
        match self {
            Self::Toml => crate::toml::parse(text, around),
            Self::Nff => crate::nff::parse(text),
            Self::Obj => crate::obj::parse(text, around),
            Self::Gltf => crate::gltf::parse(text.as_bytes(), around),
        }
    }
}

/// Where a text comes from: what it includes lies beside it.
#[derive(Clone, Debug, Default)]
pub struct Around {
    /// The file's name, and those of the files that include it, outermost first.
    chain: Vec<PathBuf>,
}

impl Around {
    /// A text that is no file: nothing lies beside it.
    pub const NOWHERE: Self = Self { chain: Vec::new() };

    /// The text of a file.
    pub fn file(path: &Path) -> Self {
        Self { chain: vec![path.to_owned()] }
    }

    /// Whether another file includes this one.
    pub fn is_included(&self) -> bool {
        self.chain.len() > 1
    }

    /// The file of a name as this one says it.
    ///
    /// # Errors
    /// The text is no file, or the name is that of a file that includes this one.
    pub fn beside(&self, name: &str) -> Result<Self, Problem> {
        /// More than anyone writes on purpose.
        const DEEPEST: usize = 32;
        let Some(file) = self.chain.last() else {
            let words = "a text that is no file can't include another".to_string();
            return Err(Problem::Syntax(words));
        };
        let path = file.parent().unwrap_or(Path::new("")).join(name);
        let real = |p: &Path| p.canonicalize().unwrap_or_else(|_| p.to_owned());
        let target = real(&path);
        if self.chain.len() >= DEEPEST || self.chain.iter().any(|p| real(p) == target) {
            return Err(Problem::Circle);
        }
        let mut chain = self.chain.clone();
        chain.push(path);
        Ok(Self { chain })
    }

    /// The path of a file that this one names: relative to it, if it is a file itself.
    pub fn file_beside(&self, name: &str) -> PathBuf {
        self.path().parent().unwrap_or(Path::new("")).join(name)
    }

    /// The file's name.
    pub fn path(&self) -> &Path {
        self.chain.last().map_or(Path::new(""), PathBuf::as_path)
    }

    /// The file's bytes, whatever it is.
    ///
    /// # Errors
    /// It can't be read, or is larger than it may be.
    pub fn bytes(&self) -> Result<Vec<u8>, Problem> {
        bytes(self.path())
    }

    /// Reads the file.
    ///
    /// # Errors
    /// The first thing that is wrong with it, with its line, not yet with its name.
    pub fn read(&self) -> Result<Document, Flaw> {
        let (format, bytes) = load(self.path()).map_err(Problem::anywhere)?;
        parse_around(format, &bytes, self)
    }
}

/// Reads a scene file.
///
/// # Errors
/// The first thing that is wrong with it, with file and line.
pub fn read(path: &Path) -> Result<Document, SceneError> {
    Around::file(path).read().map_err(|flaw| flaw.of(path))
}

/// Reads the bytes of a scene file.
///
/// # Errors
/// The first thing that is wrong with it, with its line.
pub fn parse(format: Format, bytes: &[u8]) -> Result<Document, Flaw> {
    parse_around(format, bytes, &Around::NOWHERE)
}

fn parse_around(format: Format, bytes: &[u8], around: &Around) -> Result<Document, Flaw> {
    if format == Format::Gltf {
        // Of which a part may be no text.
        return crate::gltf::parse(bytes, around);
    }
    let text = std::str::from_utf8(bytes).map_err(|e| not_text(bytes, e.valid_up_to()))?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if let Some(at) = text.bytes().position(|b| b == 0) {
        return Err(not_text(text.as_bytes(), at));
    }
    if text.trim().is_empty() {
        return Err(Problem::Empty.at(1));
    }
    format.parse(text, around)
}

fn load(path: &Path) -> Result<(Format, Vec<u8>), Problem> {
    let about = std::fs::metadata(path).map_err(Problem::Io)?;
    if about.is_dir() {
        return Err(Problem::Directory);
    }
    let format = Format::of(path).ok_or_else(|| Problem::Format {
        ending: path.extension().unwrap_or_default().to_string_lossy().into_owned(),
    })?;
    Ok((format, bytes(path)?))
}

/// A file's bytes.
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>, Problem> {
    let about = std::fs::metadata(path).map_err(Problem::Io)?;
    if about.is_dir() {
        return Err(Problem::Directory);
    }
    let mut bytes = Vec::new();
    let mut file = File::open(path).map_err(Problem::Io)?.take(LARGEST + 1);
    file.read_to_end(&mut bytes).map_err(Problem::Io)?;
    if bytes.len() as u64 > LARGEST {
        return Err(Problem::TooLarge { bytes: about.len().max(LARGEST + 1), most: LARGEST });
    }
    Ok(bytes)
}

fn not_text(bytes: &[u8], at: usize) -> Flaw {
    let line = 1 + bytes.iter().take(at).filter(|&&b| b == b'\n').count();
    Problem::NotText.at(line)
}

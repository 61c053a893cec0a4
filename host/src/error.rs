//! What can be wrong with a scene: where, which value, and what would be right.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// A scene that can't be used, and why.
///
/// Displayed as `file:line: reason`, or `file: reason` where no line is to blame.
#[derive(Debug)]
pub struct SceneError {
    /// The file, as the user named it.
    pub file: PathBuf,
    /// The line, from 1.
    pub line: Option<usize>,
    /// What is wrong with it.
    pub problem: Problem,
}

/// A problem at a line, before the reader's caller says which file it was.
#[derive(Debug)]
pub struct Flaw {
    /// The line, from 1.
    pub line: Option<usize>,
    /// The file, if it isn't the one that was read but one that it includes.
    pub file: Option<PathBuf>,
    /// What is wrong with it.
    pub problem: Problem,
}

/// What is wrong with a scene.
#[derive(Debug)]
#[non_exhaustive]
pub enum Problem {
    /// The file can't be opened or read.
    Io(io::Error),
    /// It is a directory.
    Directory,
    /// It is larger than the reader takes.
    TooLarge {
        /// Its bytes.
        bytes: u64,
        /// The most there may be.
        most: u64,
    },
    /// It is not UTF-8, or holds control characters.
    NotText,
    /// Its name ends in nothing we know.
    Format {
        /// The ending found.
        ending: String,
    },
    /// It is within a file that it includes, or is that file.
    Circle,
    /// There is nothing in it.
    Empty,
    /// Its grammar is broken, in the parser's words.
    Syntax(String),
    /// It ends in the middle of something.
    Ended {
        /// What should have followed.
        wanted: String,
    },
    /// Something else than what should be there.
    Found {
        /// What is there.
        found: String,
        /// What should be there.
        wanted: String,
    },
    /// A number out of its range.
    Range {
        /// What the number is.
        what: String,
        /// The number.
        value: f64,
        /// What it must be.
        right: String,
    },
    /// A word or key that means nothing here.
    Unknown {
        /// "key", "word", "material" …
        what: &'static str,
        /// The word.
        found: String,
        /// Those that mean something.
        known: Vec<String>,
    },
    /// Something that must be there isn't.
    Missing {
        /// What, and how to write it.
        what: String,
    },
    /// Something that may be there once is there again.
    Twice {
        /// What.
        what: String,
        /// The line of the first.
        first: usize,
    },
    /// A shape or camera that has no extent, direction or area.
    Degenerate {
        /// The kind of thing.
        what: String,
        /// Why.
        why: String,
    },
    /// The settings of the picture are out of range, in the core's words.
    Settings(String),
    /// It is right, but the arithmetic asked for can't hold it.
    Unrepresentable {
        /// What.
        what: String,
        /// Why, and what would help.
        why: String,
    },
}

impl Problem {
    /// At a line.
    pub(crate) fn at(self, line: usize) -> Flaw {
        Flaw { line: Some(line), file: None, problem: self }
    }

    /// Of the whole file.
    pub(crate) fn anywhere(self) -> Flaw {
        Flaw { line: None, file: None, problem: self }
    }

    pub(crate) fn range(what: impl Into<String>, value: f64, right: impl Into<String>) -> Self {
        Self::Range { what: what.into(), value, right: right.into() }
    }

    pub(crate) fn degenerate(what: impl Into<String>, why: impl Into<String>) -> Self {
        Self::Degenerate { what: what.into(), why: why.into() }
    }

    pub(crate) fn unknown(what: &'static str, found: &str, known: &[&str]) -> Self {
        let known = known.iter().map(ToString::to_string).collect();
        Self::Unknown { what, found: shown(found), known }
    }
}

impl Flaw {
    /// In this file, or in the one that it includes.
    pub fn of(self, file: &Path) -> SceneError {
        let file = self.file.unwrap_or_else(|| file.to_owned());
        SceneError { file, line: self.line, problem: self.problem }
    }

    /// In an included file, unless one further in is known.
    #[must_use]
    pub(crate) fn within(mut self, file: Option<&Path>) -> Self {
        self.file = self.file.or_else(|| file.map(Path::to_owned));
        self
    }
}

/// A word of a file for a message: printable, and not longer than a line.
pub(crate) fn shown(word: &str) -> String {
    const LONGEST: usize = 40;
    let mut text: String = word.chars().take(LONGEST).flat_map(char::escape_debug).collect();
    if word.chars().nth(LONGEST).is_some() {
        text.push('…');
    }
    text
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => write!(f, "can't be read: {error}"),
            Self::Directory => write!(f, "is a directory; a scene is a file"),
            Self::TooLarge { bytes, most } => {
                write!(f, "has {bytes} bytes; a scene file may have {most}")
            }
            Self::NotText => write!(f, "is not text (a scene file is UTF-8)"),
            Self::Format { ending } => {
                write!(
                    f,
                    "unknown format \"{}\"; known: .toml, .nff, .obj, .gltf, .glb",
                    shown(ending)
                )
            }
            Self::Circle => write!(f, "is included by itself: a scene can't contain itself"),
            Self::Empty => write!(f, "there is no scene in this file; it is empty"),
            Self::Syntax(words) | Self::Settings(words) => write!(f, "{words}"),
            Self::Ended { wanted } => write!(f, "the file ends where {wanted} should follow"),
            Self::Found { found, wanted } => write!(f, "found {found}; {wanted} should be here"),
            Self::Range { what, value, right } => {
                write!(f, "{what} {value} is out of range: it must be {right}")
            }
            Self::Unknown { what, found, known } => {
                write!(f, "unknown {what} \"{found}\"")?;
                if known.is_empty() { Ok(()) } else { write!(f, "; known: {}", known.join(", ")) }
            }
            Self::Missing { what } => write!(f, "{what} is missing"),
            Self::Twice { what, first } => {
                write!(f, "a second {what}; the first is at line {first}")
            }
            Self::Degenerate { what, why } => write!(f, "{what}: {why}"),
            Self::Unrepresentable { what, why } => write!(f, "{what} can't be represented: {why}"),
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            // Formats that aren't text have no lines.
            Some(line @ 1..) => write!(f, "{}:{line}: {}", self.file.display(), self.problem),
            _ => write!(f, "{}: {}", self.file.display(), self.problem),
        }
    }
}

impl std::error::Error for SceneError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.problem {
            Problem::Io(error) => Some(error),
            _ => None,
        }
    }
}

//! What to draw: a scene, an arithmetic and a size, written `limit:fixed:120x90`.

use core::fmt;
use core::str::FromStr;

/// The scenes that firmware carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneName {
    /// Glass and mirror spheres over a checker floor; the library's example.
    Showcase,
    /// The scene that budgets are counted on.
    Limit,
    /// A peer's scene: tinyraytracer's four spheres.
    Raystones,
    /// A peer's scene: the "business card" spheres of FTB.
    Ftb,
}

impl SceneName {
    /// Every scene.
    pub const ALL: [Self; 4] = [Self::Showcase, Self::Limit, Self::Raystones, Self::Ftb];

    /// The name as written in a job.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Showcase => "showcase",
            Self::Limit => "limit",
            Self::Raystones => "raystones",
            Self::Ftb => "ftb",
        }
    }
}

/// The arithmetics that boards draw in. (`f64` is the host's.)
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArithName {
    /// Fixed point.
    Fixed,
    /// Single precision.
    F32,
}

impl ArithName {
    /// Every arithmetic.
    pub const ALL: [Self; 2] = [Self::Fixed, Self::F32];

    /// The name as written in a job.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::F32 => "f32",
        }
    }
}

/// The widest row a firmware has room for.
pub const MAX_WIDTH: u16 = 320;
/// The most rows a job may ask for: enough for any display this project knows.
pub const MAX_HEIGHT: u16 = 480;

/// One picture to draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Job {
    /// Which scene.
    pub scene: SceneName,
    /// In which arithmetic.
    pub arith: ArithName,
    /// Pixels in a row, 1 to [`MAX_WIDTH`].
    pub width: u16,
    /// Rows, 1 to [`MAX_HEIGHT`].
    pub height: u16,
}

impl Job {
    /// What firmware draws when nobody says what: every scene in both arithmetics, at a size that
    /// software floating point finishes in a second or so.
    pub fn small() -> impl Iterator<Item = Self> {
        SceneName::ALL.into_iter().flat_map(|scene| {
            ArithName::ALL.into_iter().map(move |arith| Self {
                scene,
                arith,
                width: 80,
                height: 60,
            })
        })
    }
}

impl fmt::Display for Job {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}x{}", self.scene.name(), self.arith.name(), self.width, self.height)
    }
}

/// Why a job can't be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JobError {
    /// Not of the form `scene:arithmetic:WIDTHxHEIGHT`.
    Form,
    /// No scene of that name.
    Scene,
    /// No arithmetic of that name.
    Arithmetic,
    /// Not a size, or one that firmware has no room for.
    Size,
}

impl fmt::Display for JobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Form => f.write_str("a job is written scene:arithmetic:WIDTHxHEIGHT"),
            Self::Scene => f.write_str("scenes are showcase, limit, raystones and ftb"),
            Self::Arithmetic => f.write_str("arithmetics are fixed and f32"),
            Self::Size => write!(f, "sizes go from 1x1 to {MAX_WIDTH}x{MAX_HEIGHT}"),
        }
    }
}

impl core::error::Error for JobError {}

impl FromStr for Job {
    type Err = JobError;

    fn from_str(s: &str) -> Result<Self, JobError> {
        let (scene, rest) = s.split_once(':').ok_or(JobError::Form)?;
        let (arith, size) = rest.split_once(':').ok_or(JobError::Form)?;
        let (width, height) = size.split_once('x').ok_or(JobError::Size)?;
        let scene =
            SceneName::ALL.into_iter().find(|s| s.name() == scene).ok_or(JobError::Scene)?;
        let arith =
            ArithName::ALL.into_iter().find(|a| a.name() == arith).ok_or(JobError::Arithmetic)?;
        let side = |text: &str, most| {
            text.parse::<u16>().ok().filter(|&n| n > 0 && n <= most).ok_or(JobError::Size)
        };
        Ok(Self { scene, arith, width: side(width, MAX_WIDTH)?, height: side(height, MAX_HEIGHT)? })
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use std::string::ToString;

    use super::{Job, JobError};

    #[test]
    fn written_and_read() {
        for job in Job::small() {
            assert_eq!(job.to_string().parse(), Ok(job));
        }
    }

    #[test]
    fn mistakes_are_named() {
        for (text, error) in [
            ("limit", JobError::Form),
            ("limit:fixed", JobError::Form),
            ("moon:fixed:8x8", JobError::Scene),
            ("limit:f64:8x8", JobError::Arithmetic),
            ("limit:fixed:8", JobError::Size),
            ("limit:fixed:0x8", JobError::Size),
            ("limit:fixed:321x8", JobError::Size),
            ("limit:fixed:8x-8", JobError::Size),
        ] {
            assert_eq!(text.parse::<Job>(), Err(error), "{text}");
        }
    }
}

//! What to draw: a scene, an arithmetic and a size, written `limit:fixed:120x90`,
//! and a sampling if it isn't one ray a pixel, `limit:fixed:120x90:sparse`.

use core::fmt;
use core::str::FromStr;

use whitted::frame::Sampling;

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
    /// A scene like gfxcat's: three mirroring spheres on a plane, one bounce, one light.
    Gfxcat,
    /// 64 glowing spheres in an octree: a pixel is one ray.
    Spheres64,
    /// A room of 451 shapes, lit through its window: baked from
    /// `host/scenes/bathroom-small.toml`.
    Bathroom,
}

impl SceneName {
    /// Every scene.
    pub const ALL: [Self; 7] = [
        Self::Showcase,
        Self::Limit,
        Self::Raystones,
        Self::Ftb,
        Self::Gfxcat,
        Self::Spheres64,
        Self::Bathroom,
    ];

    /// Whether it is there to be counted, on boards with flash to spare: those with the feature
    /// `counted`.
    #[must_use]
    pub const fn is_for_counting(self) -> bool {
        matches!(self, Self::Gfxcat | Self::Spheres64)
    }

    /// Whether Arm cores that would compute `f32` in software have it in fixed point alone, for
    /// want of flash.
    #[must_use]
    pub const fn is_soft_in_fixed_alone(self) -> bool {
        matches!(self, Self::Gfxcat | Self::Spheres64 | Self::Bathroom)
    }

    /// The name as written in a job.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Showcase => "showcase",
            Self::Limit => "limit",
            Self::Raystones => "raystones",
            Self::Ftb => "ftb",
            Self::Gfxcat => "gfxcat",
            Self::Spheres64 => "spheres64",
            Self::Bathroom => "bathroom",
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
    /// Where its rays go; but for the limit scene, one through each pixel's centre.
    pub sampling: Sampling,
}

/// Samples that a firmware remembers at most: sparse ones for a row of 240 pixels.
pub const MAX_SAMPLES: usize = 530;

/// The samplings that jobs may ask for, as they are written.
pub const SAMPLINGS: [(&str, Sampling); 5] = [
    ("corners", Sampling::Corners),
    ("grid:2", Sampling::Grid { side: 2 }),
    ("jittered:2", Sampling::Jittered { side: 2, seed: 0 }),
    ("adaptive", Sampling::ADAPTIVE),
    ("sparse", Sampling::SPARSE),
];

impl Job {
    /// What firmware draws when nobody says what: every scene in both arithmetics, at a size that
    /// software floating point finishes in a second or so.
    /// The samplings, and what not every board has in `f32`, are tried in fixed point.
    pub fn small() -> impl Iterator<Item = Self> {
        let job = |scene, arith, sampling| {
            let (width, height) = if scene == SceneName::Bathroom { (40, 30) } else { (80, 60) };
            Self { scene, arith, width, height, sampling }
        };
        let scenes = SceneName::ALL
            .into_iter()
            .flat_map(move |s| ArithName::ALL.map(|arith| job(s, arith, Sampling::Center)))
            .filter(|job| !job.scene.is_soft_in_fixed_alone() || job.arith == ArithName::Fixed)
            .filter(|job| carried(job.scene, job.arith));
        let fixed = ArithName::Fixed;
        scenes.chain(SAMPLINGS.map(|(_, sampling)| job(SceneName::Limit, fixed, sampling)))
    }

    /// How the sampling is written; nothing for pixel centres.
    #[must_use]
    pub fn sampling_name(&self) -> Option<&'static str> {
        SAMPLINGS.into_iter().find_map(|(name, s)| (s == self.sampling).then_some(name))
    }
}

impl fmt::Display for Job {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}x{}", self.scene.name(), self.arith.name(), self.width, self.height)?;
        self.sampling_name().map_or(Ok(()), |name| write!(f, ":{name}"))
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
    /// No such sampling, or one of another scene than the limit scene.
    Sampling,
}

impl fmt::Display for JobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Form => f.write_str("a job is written scene:arithmetic:WIDTHxHEIGHT"),
            Self::Scene => f.write_str(
                "scenes are showcase, limit, raystones, ftb, gfxcat, spheres64 and bathroom",
            ),
            Self::Arithmetic => f.write_str(
                "arithmetics are fixed and f32, \
                 this without some scenes and all samplings where it is computed in software",
            ),
            Self::Size => write!(
                f,
                "sizes go from 1x1 to {MAX_WIDTH}x{MAX_HEIGHT}, as far as {MAX_SAMPLES} samples do"
            ),
            Self::Sampling => f.write_str(
                "the limit scene takes corners, grid:2, jittered:2, adaptive and sparse, others none",
            ),
        }
    }
}

impl core::error::Error for JobError {}

/// Whether `f32` is computed in software, on an Arm core.
const SOFT: bool = cfg!(all(target_arch = "arm", target_abi = "eabi"));

/// Whether a scene is there in an arithmetic; on a PC all are.
const fn carried(scene: SceneName, arith: ArithName) -> bool {
    if scene.is_for_counting() && !cfg!(any(feature = "counted", not(target_os = "none"))) {
        return false;
    }
    !(SOFT && matches!(arith, ArithName::F32) && scene.is_soft_in_fixed_alone())
}

/// Whether the samplings are there in an arithmetic: not where `f32` is computed in software, since the
/// smallest flash would not hold them.
pub(crate) const fn sampled(arith: ArithName) -> bool {
    !(SOFT && matches!(arith, ArithName::F32))
}

impl FromStr for Job {
    type Err = JobError;

    fn from_str(s: &str) -> Result<Self, JobError> {
        let (scene, rest) = s.split_once(':').ok_or(JobError::Form)?;
        let (arith, size) = rest.split_once(':').ok_or(JobError::Form)?;
        let (size, sampling) = match size.split_once(':') {
            Some((size, sampling)) => (size, Some(sampling)),
            None => (size, None),
        };
        let (width, height) = size.split_once('x').ok_or(JobError::Size)?;
        let scene =
            SceneName::ALL.into_iter().find(|s| s.name() == scene).ok_or(JobError::Scene)?;
        let arith =
            ArithName::ALL.into_iter().find(|a| a.name() == arith).ok_or(JobError::Arithmetic)?;
        if !carried(scene, arith) {
            return Err(JobError::Arithmetic);
        }
        let side = |text: &str, most| {
            text.parse::<u16>().ok().filter(|&n| n > 0 && n <= most).ok_or(JobError::Size)
        };
        let (width, height) = (side(width, MAX_WIDTH)?, side(height, MAX_HEIGHT)?);
        let sampling = match sampling {
            None => Sampling::Center,
            Some(_) if !sampled(arith) => return Err(JobError::Arithmetic),
            Some(name) => SAMPLINGS
                .into_iter()
                .find_map(|(known, s)| (known == name && scene == SceneName::Limit).then_some(s))
                .ok_or(JobError::Sampling)?,
        };
        if sampling.samples(width) > MAX_SAMPLES {
            return Err(JobError::Size);
        }
        Ok(Self { scene, arith, width, height, sampling })
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
            ("limit:fixed:8x8:fine", JobError::Sampling),
            ("ftb:fixed:8x8:sparse", JobError::Sampling),
            ("limit:fixed:320x8:sparse", JobError::Size),
        ] {
            assert_eq!(text.parse::<Job>(), Err(error), "{text}");
        }
    }
}

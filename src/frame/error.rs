use core::fmt;

/// Why a frame can't be rendered as it was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum FrameError {
    /// The picture has no pixels, or more than 16,384 either way.
    Size,
    /// The depth is 0, or beyond what the working memory was made for.
    Depth {
        /// What was asked for.
        depth: u8,
        /// What there is memory for.
        max: u8,
    },
    /// A pixel can be cut into 1×1 to 8×8 cells.
    Cells {
        /// How many each way were asked for.
        side: u8,
    },
    /// Adaptive sampling halves a pixel 1 to 3 times.
    Halvings {
        /// How often was asked for.
        depth: u8,
    },
    /// Blocks of sparse sampling have a side of 2, 4, 8 or 16 pixels.
    Block {
        /// What was asked for.
        side: u8,
    },
    /// The first pass from coarse to fine has blocks of 1, 2, 4, … or 128 pixels.
    Pass {
        /// What was asked for.
        side: u8,
    },
    /// The scene is tailored, and not to this sampling or to leaving terms out: what
    /// [`Sampling::uses`](super::Sampling::uses) says, or [`uses::TERMS`](crate::scene::uses::TERMS),
    /// has to be among its uses.
    Tailored,
    /// The sampling needs to remember more than the slice holds.
    Samples {
        /// How many samples it needs.
        needed: usize,
    },
}

impl fmt::Display for FrameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size => f.write_str("a picture has 1 to 16384 pixels each way"),
            Self::Depth { depth, max } => {
                write!(f, "depth {depth} isn't within 1 and the memory's {max}")
            }
            Self::Cells { side } => {
                write!(f, "a pixel can be cut into 1 to 8 cells each way, not {side}")
            }
            Self::Halvings { depth } => {
                write!(f, "adaptive sampling halves a pixel 1 to 3 times, not {depth}")
            }
            Self::Block { side } => {
                write!(f, "a block of sparse sampling has a side of 2, 4, 8 or 16, not {side}")
            }
            Self::Pass { side } => {
                write!(f, "the first pass has blocks of 1, 2, 4, 8, 16, 32, 64 or 128, not {side}")
            }
            Self::Tailored => f.write_str(
                "the scene is tailored without this: add Sampling::uses() or uses::TERMS",
            ),
            Self::Samples { needed } => {
                write!(f, "this sampling must remember {needed} samples")
            }
        }
    }
}

impl core::error::Error for FrameError {}

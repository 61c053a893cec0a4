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
    /// The sampling needs to remember more radiances than the slice holds.
    Samples {
        /// How many it needs.
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
            Self::Samples { needed } => {
                write!(f, "this sampling must remember {needed} radiances")
            }
        }
    }
}

impl core::error::Error for FrameError {}

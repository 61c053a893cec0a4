use core::fmt;

/// What of a scene's parts doesn't fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum SceneError {
    /// A shape or a pattern names a material that isn't there.
    Material {
        /// The index it names.
        index: u16,
    },
    /// There are 2³¹ shapes or more.
    Shapes,
}

impl SceneError {
    /// What is wrong, in words.
    pub const fn message(self) -> &'static str {
        match self {
            Self::Material { .. } => "a shape or a pattern names a material that isn't there",
            Self::Shapes => "there are too many shapes",
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Material { index } => {
                write!(f, "a shape or a pattern names material {index}, which isn't there")
            }
            Self::Shapes => f.write_str(self.message()),
        }
    }
}

impl core::error::Error for SceneError {}

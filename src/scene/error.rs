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
    /// A material names a texture that isn't there.
    Texture {
        /// The index it names.
        index: u16,
    },
    /// A material names an absorption that isn't there.
    Absorption {
        /// The index it names.
        index: u16,
    },
    /// A polygon names edges that aren't there.
    Edges {
        /// The polygon's index.
        polygon: u32,
    },
    /// A solid names operands that aren't there.
    Operands {
        /// The solid's index.
        solid: u32,
    },
    /// The octree is over another number of shapes than there are besides planes.
    Tree {
        /// The number of shapes that the tree is over.
        shapes: u32,
    },
    /// An area light names corners that aren't there.
    Fan {
        /// The light's index among the area lights.
        light: u32,
    },
    /// A group has no shapes, or they are too large for a bounding sphere.
    Group,
    /// There are more shapes in instances than numbers.
    Numbers,
    /// A tailored scene uses what it said it doesn't.
    Uses {
        /// The bits of [`uses`](super::uses) that are missing.
        missing: u64,
    },
}

impl SceneError {
    /// What is wrong, in words.
    pub const fn message(self) -> &'static str {
        match self {
            Self::Material { .. } => "a shape or a pattern names a material that isn't there",
            Self::Texture { .. } => "a material names a texture that isn't there",
            Self::Absorption { .. } => "a material names an absorption that isn't there",
            Self::Edges { .. } => "a polygon names edges that aren't there",
            Self::Operands { .. } => "a solid names operands that aren't there",
            Self::Tree { .. } => "the octree is over another number of shapes",
            Self::Fan { .. } => "an area light names corners that aren't there",
            Self::Group => "a group has no shapes, or is too large for a bounding sphere",
            Self::Numbers => "there are too many shapes in instances",
            Self::Uses { .. } => "the scene uses what its type says it doesn't",
        }
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Material { index } => {
                write!(f, "a shape or a pattern names material {index}, which isn't there")
            }
            Self::Texture { index } => {
                write!(f, "a material names texture {index}, which isn't there")
            }
            Self::Absorption { index } => {
                write!(f, "a material names absorption {index}, which isn't there")
            }
            Self::Edges { polygon } => {
                write!(f, "polygon {polygon} names edges that aren't there")
            }
            Self::Operands { solid } => {
                write!(f, "solid {solid} names operands that aren't there")
            }
            Self::Tree { shapes } => {
                write!(f, "the octree is over {shapes} shapes, the scene has another number")
            }
            Self::Fan { light } => {
                write!(f, "area light {light} names corners that aren't there")
            }
            Self::Group | Self::Numbers => f.write_str(self.message()),
            Self::Uses { missing } => {
                write!(f, "the scene uses {missing:#x}, which its type says it doesn't")
            }
        }
    }
}

impl core::error::Error for SceneError {}

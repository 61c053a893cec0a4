use core::fmt;

use crate::octree::TreeError;
use crate::scene::SceneError;
use crate::shape::ShapeError;

/// Why bytes are not a blob, or not one for this program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum BlobError {
    /// They don't begin as a blob does.
    Magic,
    /// Another version of the layout.
    Version {
        /// The one found.
        found: u16,
    },
    /// Another arithmetic than the one asked for.
    Arithmetic {
        /// The one found: 1 fixed point, 2 `f32`, 3 `f64`.
        found: u16,
    },
    /// Shapes of other sizes: it was baked for another version of the library.
    Layout,
    /// Fewer bytes than the header says, or none.
    Length {
        /// How many there should be.
        wanted: u32,
    },
    /// The checksum is another.
    Checksum,
    /// The bytes don't start where shapes may: see [`ALIGNMENT`](super::ALIGNMENT).
    Alignment,
    /// This core is big-endian; blobs are little-endian and read in place.
    Endian,
    /// The parts don't fill the bytes exactly.
    Parts,
    /// A shape has a value that no constructor makes.
    Shape {
        /// Its number among those of all kinds, edges counted as shapes.
        index: u32,
    },
    /// A solid or one of its operands is none.
    Solid,
    /// The tree is none.
    Tree(TreeError),
    /// A material, light or camera, or what surrounds the scene.
    Value(ShapeError),
    /// A switch or kind that this version doesn't know.
    Unknown,
    /// More materials or lights than the caller has room for.
    Room {
        /// Materials in the blob.
        materials: u16,
        /// Lights in the blob.
        lights: u16,
    },
    /// More of what a [`Room`](super::Room) has besides than the caller has room for.
    RoomBesides {
        /// Lights with an area in the blob.
        area_lights: u16,
        /// Corners of their fans.
        fans: u16,
        /// Textures.
        textures: u16,
        /// Media.
        absorptions: u16,
    },
    /// More solids and groups than the caller has room for.
    RoomForGroups {
        /// Solids, those of groups among them.
        solids: u32,
        /// Their operands.
        operands: u32,
        /// Groups.
        groups: u16,
        /// Instances of them.
        instances: u16,
    },
    /// The parts don't fit together.
    Scene(SceneError),
}

impl fmt::Display for BlobError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = match self {
            Self::Magic => "not a baked scene",
            Self::Version { found } => {
                return write!(f, "layout version {found}; this library reads {}", super::VERSION);
            }
            Self::Arithmetic { found } => {
                let name = match found {
                    1 => "fixed point",
                    2 => "f32",
                    3 => "f64",
                    _ => "an unknown arithmetic",
                };
                return write!(f, "baked for {name}");
            }
            Self::Layout => "baked for another version of the library",
            Self::Length { wanted } => return write!(f, "truncated: {wanted} bytes are wanted"),
            Self::Checksum => "the checksum is wrong",
            Self::Alignment => "the bytes are not aligned",
            Self::Endian => "this core is big-endian",
            Self::Parts => "the parts don't fill the bytes",
            Self::Shape { index } => return write!(f, "shape {index} has a value out of range"),
            Self::Solid => "a solid or one of its operands is none",
            Self::Tree(error) => return write!(f, "{error}"),
            Self::Value(error) => return write!(f, "{error}"),
            Self::Unknown => "a kind or switch that this version doesn't know",
            Self::Room { materials, lights } => {
                return write!(f, "there are {materials} materials and {lights} lights: no room");
            }
            Self::RoomBesides { area_lights, fans, textures, absorptions } => {
                return write!(
                    f,
                    "there are {area_lights} area lights with {fans} corners, {textures} textures \
                     and {absorptions} media: no room"
                );
            }
            Self::RoomForGroups { solids, operands, groups, instances } => {
                return write!(
                    f,
                    "there are {solids} solids of {operands} operands, {groups} groups and \
                     {instances} instances: no room"
                );
            }
            Self::Scene(error) => return write!(f, "{error}"),
        };
        f.write_str(words)
    }
}

impl core::error::Error for BlobError {}

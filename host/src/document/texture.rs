//! Textures: patterns and pictures on surfaces, in the core's own words.

use std::path::PathBuf;

use whitted::scene::TextureSpec;

/// A texture of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// What it shows and where. Its `other` doesn't count: the document's is below.
    pub spec: TextureSpec<'static>,
    /// The material that it shows in places, instead of colours.
    pub other: Option<usize>,
    /// The file of its picture.
    pub file: Option<PathBuf>,
    /// The line of the file that it starts on.
    pub line: usize,
}

//! What a render took, as `--stats` writes it.

use serde::Serialize;
use whitted::tally::Counts;
use whitted::trace::Paths;

use crate::document::Size;

/// The object that `--stats` writes.
#[derive(Clone, Debug, Serialize)]
pub struct Stats {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// What the arithmetic is called.
    pub arithmetic: &'static str,
    /// The paths of light that the picture covers, as `L D S* E`.
    pub paths: String,
    /// Rays sent.
    pub rays: Rays,
    /// Rays that hit something.
    pub hits: Hits,
    /// The octree's work.
    pub octree: Octree,
    /// Times.
    pub seconds: Seconds,
}

/// Rays by kind.
#[derive(Clone, Debug, Serialize)]
pub struct Rays {
    /// From the camera.
    pub primary: u64,
    /// Mirrored.
    pub reflection: u64,
    /// Refracted.
    pub transmission: u64,
    /// Towards lights.
    pub shadow: u64,
    /// To gather irradiance.
    pub ambient: u64,
}

/// Rays that hit something, by kind.
#[derive(Clone, Debug, Serialize)]
pub struct Hits {
    /// From the camera.
    pub primary: u64,
    /// Towards lights: those in shadow.
    pub shadow: u64,
}

/// The octree's work.
#[derive(Clone, Debug, Serialize)]
pub struct Octree {
    /// Nodes visited.
    pub nodes_visited: u64,
    /// Shapes tested.
    pub shapes_tested: u64,
}

/// Times, in seconds.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Seconds {
    /// Reading the file.
    pub load: f64,
    /// Making the scene and its octree.
    pub build: f64,
    /// Tracing.
    pub render: f64,
}

impl Stats {
    /// From the tracer's counts.
    pub fn new(
        size: Size,
        arithmetic: &'static str,
        paths: Paths,
        counts: &Counts,
        seconds: Seconds,
    ) -> Self {
        Self {
            width: size.width,
            height: size.height,
            arithmetic,
            paths: paths.to_string(),
            rays: Rays {
                primary: counts.primary,
                reflection: counts.reflection,
                transmission: counts.transmission,
                shadow: counts.shadow,
                ambient: counts.ambient,
            },
            hits: Hits { primary: counts.primary_hits, shadow: counts.shadow_hits },
            octree: Octree { nodes_visited: counts.nodes, shapes_tested: counts.tests },
            seconds,
        }
    }
}

//! A room with an area light, a texture, two instances of a group, and an irradiance cache that the
//! chip fills itself before it draws.

#[path = "../../../examples/room/scene.rs"]
mod scene;

use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::gather::{Draft, Gatherer, Indirect, Record};
use whitted::trace::Work;

use crate::checksum::Checksum;

/// What the scene is in.
type A = whitted::math::Fixed;

/// The picture's size.
pub const SIZE: (u16, u16) = (64, 48);
/// How many records there is room for; with what makes them, 84 bytes each.
const RECORDS: usize = 256;

/// A room that was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Drawn {
    /// Of its pixels, red first.
    pub checksum: Checksum,
    /// The records that the cache took.
    pub records: usize,
}

/// Fills the cache, then draws, giving each row to `show`.
///
/// # Panics
/// Never: the scene is made for a cache, the memory is deep enough, and there is a draft for each
/// record.
#[inline(never)]
pub fn draw(mut show: impl FnMut(&[Rgb888])) -> Drawn {
    let mut work = Work::<A, 4>::new();
    let mut records = [Record::<A>::NONE; RECORDS];
    let mut drafts = [Draft::<A>::NONE; RECORDS];
    let cache = Gatherer::new(&scene::SCENE, scene::GATHERING, &mut work, &mut ())
        .expect("the scene has room for a cache")
        .fill(&scene::CAMERA, SIZE, &mut records, &mut drafts)
        .expect("a draft for each record");
    let taken = cache.records().len();
    let scene =
        scene::SCENE.with_indirect(Indirect::Cache(cache)).expect("it has room for a cache");

    let settings = Settings { depth: 4, ..Settings::new(SIZE.0, SIZE.1) };
    let mut renderer =
        Renderer::new(&scene, &scene::CAMERA, settings, &mut work, &mut []).expect("it fits");
    let mut row = [Rgb888::default(); SIZE.0 as usize];
    let mut checksum = Checksum::EMPTY;
    for y in 0..SIZE.1 {
        renderer.line(y, &Output::SRGB, &mut row);
        checksum.add(row.iter().flat_map(|&Rgb888(rgb)| rgb));
        show(&row);
    }
    Drawn { checksum, records: taken }
}

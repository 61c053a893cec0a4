//! Draws a room that lies in statics, after filling an irradiance cache for it, as firmware does:
//! `cargo run --release --example room`.

mod scene;

use whitted::frame::{Gray8, Output, Renderer, Settings};
use whitted::gather::{Draft, Gatherer, Indirect, Record};
use whitted::trace::Work;

/// The arithmetic: fixed point, for cores without a floating-point unit.
type A = whitted::math::Fixed;

/// From black to white.
const INK: [char; 10] = [' ', '.', ':', '-', '=', '+', '*', '#', '%', '@'];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // All the memory there is: a ray for each level of the tree, 256 records of irradiance with
    // what makes them, and one line.
    let mut work = Work::<A, 4>::new();
    let mut records = [Record::<A>::NONE; 256];
    let mut drafts = [Draft::<A>::NONE; 256];
    let mut line = [Gray8::default(); 78];

    let settings = Settings { depth: 4, ..Settings::new(78, 60) };
    let size = (settings.width, settings.height);
    let cache = Gatherer::new(&scene::SCENE, scene::GATHERING, &mut work, &mut ())?.fill(
        &scene::CAMERA,
        size,
        &mut records,
        &mut drafts,
    )?;
    println!("{} records", cache.records().len());
    let room = scene::SCENE.with_indirect(Indirect::Cache(cache))?;
    let mut renderer = Renderer::new(&room, &scene::CAMERA, settings, &mut work, &mut [])?;
    // Characters are twice as high as wide: every other line will do.
    for y in (0..settings.height).step_by(2) {
        renderer.line(y, &Output::SRGB, &mut line);
        let text: String =
            line.iter().map(|&Gray8(level)| INK[usize::from(level) * INK.len() / 256]).collect();
        println!("{text}");
    }
    Ok(())
}

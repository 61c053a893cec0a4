//! Draws a scene that lies in a static, as firmware does: `cargo run --example showcase`.
//!
//! On a display, `main` would end with `Image::new(&picture, position).draw(&mut display)`. A
//! terminal is no draw target, so lines go out one by one here.

mod scene;

use whitted::frame::{Gray8, Output, Renderer, Settings};
use whitted::trace::Work;

/// The arithmetic: fixed point, for cores without a floating-point unit.
type A = whitted::math::Fixed;

/// From black to white.
const INK: [char; 10] = [' ', '.', ':', '-', '=', '+', '*', '#', '%', '@'];

fn main() -> Result<(), whitted::frame::FrameError> {
    // All the memory there is: a ray for each level of the tree, and one line.
    let mut work = Work::<A, 5>::new();
    let mut line = [Gray8::default(); 78];

    let settings = Settings::new(78, 60);
    let mut renderer = Renderer::new(&scene::SCENE, &scene::CAMERA, settings, &mut work, &mut [])?;
    // Characters are twice as high as wide: every other line will do.
    for y in (0..settings.height).step_by(2) {
        renderer.line(y, &Output::SRGB, &mut line);
        let text: String =
            line.iter().map(|&Gray8(level)| INK[usize::from(level) * INK.len() / 256]).collect();
        println!("{text}");
    }
    Ok(())
}

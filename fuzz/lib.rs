//! What the targets share.

use whitted::frame::{Output, Renderer, Rgb888, Sample, Settings};
use whitted::math::Fixed;
use whitted::trace::Work;
use whitted_host::bake::{Baked, Construct};
use whitted_host::document::Size;
use whitted_host::read::{Format, parse};

/// Shapes beyond which baking takes longer than a fuzzer likes to wait.
const MOST_SHAPES: usize = 200;

/// Reads a text; if that works, bakes it and traces a few pixels. The only wrong answers are a panic
/// and a hang.
pub fn survives(format: Format, bytes: &[u8]) {
    let Ok(document) = parse(format, bytes) else { return };
    if document.shapes.len() > MOST_SHAPES {
        return;
    }
    if let Ok(baked) = Baked::<f64>::new(&document) {
        look(&baked);
    }
    if let Ok(baked) = Baked::<Fixed>::new(&document) {
        look(&baked);
    }
}

/// Traces a picture of a few pixels.
fn look<A: Construct>(baked: &Baked<A>) {
    const SIDE: u16 = 4;
    let size = Size { width: SIDE.into(), height: SIDE.into() };
    let Ok(camera) = baked.camera(size) else { return };
    let _ = baked.with_scene(|scene| {
        let mut work = Work::<A, 4>::new();
        let mut samples = [Sample::NONE; 0];
        let settings = Settings { depth: 4, ..Settings::new(SIDE, SIDE) };
        let Ok(mut renderer) = Renderer::new(scene, &camera, settings, &mut work, &mut samples)
        else {
            return;
        };
        let mut line = [Rgb888::default(); SIDE as usize];
        for y in 0..SIDE {
            renderer.line(y, &Output::SRGB, &mut line);
        }
    });
}

//! A row of the limit scene, and nothing else.

use whitted::frame::{Renderer, Rgb565, Settings};
use whitted::trace::Work;
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::job::SceneName;
use whitted_demo::scenes::Shots;

/// Renders row `y` of a picture 240 pixels wide.
#[inline(always)]
pub(crate) fn row<A: Shots>(work: &mut Work<A, MAX_DEPTH>, y: u16, row: &mut [Rgb565; 240]) {
    let shot = A::shot(SceneName::Limit);
    let settings = Settings { depth: shot.depth, ..Settings::new(240, 240) };
    if let Ok(mut renderer) = Renderer::new(shot.scene, shot.camera, settings, work, &mut []) {
        renderer.line(y, &shot.output, row);
    }
}

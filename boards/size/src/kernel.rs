//! A row of the limit scene, and nothing else.

use whitted::frame::{Renderer, Rgb565, Settings};
use whitted::math::Arithmetic;
use whitted::scene::{Scene, SceneRef};
use whitted::trace::Work;
use whitted_demo::frame::MAX_DEPTH;
use whitted_demo::job::SceneName;
use whitted_demo::scenes::{Shot, Shots, View};

/// Renders row `y` of a picture 240 pixels wide.
#[inline(always)]
pub(crate) fn row<A: Shots>(work: &mut Work<A, MAX_DEPTH>, y: u16, row: &mut [Rgb565; 240]) {
    A::shot(SceneName::Limit, Row { work, y, row });
}

struct Row<'a, A: Arithmetic> {
    work: &'a mut Work<A, MAX_DEPTH>,
    y: u16,
    row: &'a mut [Rgb565; 240],
}

impl<A: Arithmetic> View<A> for Row<'_, A> {
    type Output = ();

    #[inline(always)]
    fn view<S, const USES: u64>(self, shot: Shot<A, S>)
    where
        S: SceneRef<Target = Scene<'static, A, USES>>,
    {
        let Self { work, y, row } = self;
        let settings = Settings { depth: shot.depth, ..Settings::new(240, 240) };
        if let Ok(mut renderer) = Renderer::new(shot.scene, shot.camera, settings, work, &mut []) {
            renderer.line(y, &shot.output, row);
        }
    }
}

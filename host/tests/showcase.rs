//! The showcase is written down twice: as a file for the command, as a static for firmware and the
//! library's example. Both are the same scene.

#[path = "../../examples/showcase/scene.rs"]
mod scene;

use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::trace::Work;
use whitted_host::bake::Baked;
use whitted_host::document::Size;
use whitted_host::{read, render};

type A = f64;

#[test]
fn the_static_is_the_file() {
    let text = include_bytes!("../scenes/showcase.toml");
    let document = read::parse(read::Format::Toml, text).unwrap();
    let depth = document.rules.depth;
    let settings = render::Settings {
        indirect: None,
        size: Size { width: 60, height: 40 },
        depth,
        sampling: render::Sampling::Center,
        show: None,
        threads: std::num::NonZeroUsize::MIN,
    };
    let file = render::render(&Baked::<A>::new(&document).unwrap(), &settings, |_| {}).unwrap();

    let mut work = Work::<A, 8>::new();
    let settings = Settings { depth, ..Settings::new(60, 40) };
    let mut renderer =
        Renderer::new(&scene::SCENE, &scene::CAMERA, settings, &mut work, &mut []).unwrap();
    let mut same = 0;
    for (y, row) in (0..).zip(file.picture.pixels().chunks(60)) {
        let mut line = [Rgb888::default(); 60];
        renderer.line(y, &Output::SRGB, &mut line);
        same += row.iter().zip(line).filter(|(a, b)| **a == b.0).count();
    }
    // The file's camera takes the system's tangent, which may differ in its last bit.
    assert!(same >= 60 * 40 - 4, "{same} of 2400 pixels are the same");
}

//! What was baked renders as the host renders the file, to the bit.

use std::path::Path;

use whitted::blob::Blob;
use whitted::frame::{Output, Renderer, Rgb888, Settings};
use whitted::math::Fixed;
use whitted::scene::{Camera, Light, Material, MaterialSpec, Scene};
use whitted::trace::Work;
use whitted_host::bake::{Baked, Construct};
use whitted_host::document::Size;
use whitted_host::read;

/// Smaller than the scenes ask for; the camera doesn't know.
const SIZE: Size = Size { width: 96, height: 64 };

fn render<A: Construct, const USES: u64>(
    scene: &Scene<'_, A, USES>,
    camera: &Camera<A>,
    depth: u8,
) -> Vec<Rgb888> {
    let settings = Settings { depth, ..Settings::new(SIZE.width as u16, SIZE.height as u16) };
    let mut work = Work::<A, 16>::new();
    let mut renderer = Renderer::new(scene, camera, settings, &mut work, &mut []).unwrap();
    let mut picture = Vec::new();
    for y in 0..SIZE.height as u16 {
        let mut line = [Rgb888::default(); SIZE.width as usize];
        renderer.line(y, &Output::SRGB, &mut line);
        picture.extend(line);
    }
    picture
}

fn host<A: Construct>(file: &str, depth: u8) -> Vec<Rgb888> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes").join(file);
    let document = read::read(&file).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(document.rules.depth, depth);
    let baked = Baked::<A>::new(&document).unwrap();
    baked.with_scene(|scene| render(scene, &baked.camera(SIZE).unwrap(), depth)).unwrap()
}

macro_rules! same {
    ($module:ident, $a:ty, $file:literal) => {
        #[test]
        fn $module() {
            use whitted_baked::$module::{BLOB, CAMERA, DEPTH, SCENE};
            let wanted = host::<$a>($file, DEPTH);
            assert!(render(&SCENE, &CAMERA, DEPTH) == wanted, "the source");
            let blob = Blob::<$a>::open(BLOB).unwrap();
            let mut materials = [Material::<$a>::new(MaterialSpec::BLACK); 32];
            let mut lights = [Light::<$a>::point([0.0; 3], [0.0; 3]); 8];
            let scene: Scene<'_, $a> = blob.scene(&mut materials, &mut lights).unwrap();
            let camera = blob.camera().unwrap();
            assert!(render(&scene, &camera, blob.depth()) == wanted, "the blob");
            assert_eq!(blob.uses(), scene.parts().uses());
        }
    };
}

same!(showcase, Fixed, "showcase.toml");
same!(raystones, Fixed, "raystones.toml");
same!(shapes, f32, "shapes.toml");

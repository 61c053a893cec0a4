//! Surface detail from the file to the ray: a scene with all of it, and what scaling into fixed point's
//! range leaves as it was.

mod common;

use whitted::math::{Arithmetic, Fixed};
use whitted_host::bake::{Baked, Construct};
use whitted_host::document::{Document, Size};
use whitted_host::number::to_f64;
use whitted_host::read::read;

fn scene(text: &str) -> Document {
    let place = tempfile::tempdir().unwrap();
    // Two rows of two: red and white, black and blue.
    let file = std::fs::File::create(place.path().join("four.png")).unwrap();
    let mut encoder = png::Encoder::new(file, 2, 2);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(&[255, 0, 0, 255, 255, 255, 0, 0, 0, 0, 0, 255]).unwrap();
    writer.finish().unwrap();
    let path = place.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    read(&path).unwrap_or_else(|error| panic!("{error}"))
}

/// The radiance through the middle of the picture.
fn middle<A: Construct>(document: &Document) -> [f64; 3] {
    use whitted::frame::{Renderer, Settings};
    use whitted::trace::Work;
    let baked = Baked::<A>::new(document).unwrap_or_else(|flaw| panic!("{}", flaw.problem));
    let camera = baked.camera(Size { width: 1, height: 1 });
    let camera = camera.unwrap_or_else(|flaw| panic!("{}", flaw.problem));
    let radiance = baked.with_scene(|scene| {
        let mut work = Work::<A, 8>::new();
        let settings = Settings { depth: 8, ..Settings::new(1, 1) };
        let mut renderer = Renderer::new(scene, &camera, settings, &mut work, &mut []).unwrap();
        let ray = renderer.ray(0, 0);
        renderer.radiance(&ray).map(to_f64)
    });
    radiance.unwrap_or_else(|flaw| panic!("{}", flaw.problem))
}

fn shows<A: Arithmetic>(got: [f64; 3], exact: [f64; 3], tolerance: f64) {
    for i in 0..3 {
        let right = (got[i] - exact[i]).abs() < tolerance;
        assert!(right, "{}: {got:?} for {exact:?}", A::NAME);
    }
}

fn all(text: &str, exact: [f64; 3], tolerance: f64) {
    let document = scene(text);
    shows::<f64>(middle::<f64>(&document), exact, tolerance);
    shows::<f32>(middle::<f32>(&document), exact, tolerance);
    shows::<Fixed>(middle::<Fixed>(&document), exact, tolerance);
}

/// Looks along −z at (x, y) of the plane z = 0.
fn facing(x: f64, y: f64, material: &str) -> String {
    format!(
        "ambient = 1\n[camera]\neye = [{x}, {y}, 5]\nlook_at = [{x}, {y}, 0]\n\
         [[material]]\nname = \"a\"\nambient = 1\n{material}\n\
         [[box]]\nmin = [-40, -30, -1]\nmax = [40, 30, 0]\n"
    )
}

#[test]
fn a_picture_beside_the_scene() {
    let picture = |x, y| {
        let texture = "texture = { type = \"image\", file = \"four.png\", size = 4, \
                       filter = \"nearest\" }";
        facing(x, y, texture)
    };
    all(&picture(1.0, 3.0), [1.0, 0.0, 0.0], 1e-3);
    all(&picture(3.0, 3.0), [1.0; 3], 1e-3);
    all(&picture(1.0, 1.0), [0.0; 3], 1e-3);
    all(&picture(7.0, -3.0), [0.0, 0.0, 1.0], 1e-3);
}

#[test]
fn a_gradient_stays_where_it_is() {
    let texture = "texture = { type = \"gradient\", origin = [3, 0, 0], size = 20, \
                   colors = [[0, 0, 0], [1, 0.5, 0.25]] }";
    all(&facing(8.0, 2.0, texture), [0.25, 0.125, 0.0625], 2e-3);
}

#[test]
fn a_triangle_with_coordinates_mirrored_too() {
    for (mirrored, x) in [("", 1.0), ("scale = [-1, 1, 1]", -1.0)] {
        let text = format!(
            "ambient = 1\n[camera]\neye = [{x}, 3, 5]\nlook_at = [{x}, 3, 0]\n\
             [[material]]\nname = \"a\"\nambient = 1\n\
             texture = {{ type = \"image\", file = \"four.png\", mapping = \"uv\", \
             filter = \"nearest\" }}\n\
             [[triangle]]\ncorners = [[0, 0, 0], [8, 0, 0], [0, 8, 0]]\n\
             uv = [[0, 0], [2, 0], [0, 2]]\n{mirrored}\n"
        );
        all(&text, [1.0, 0.0, 0.0], 1e-3);
    }
}

#[test]
fn absorption_goes_by_the_scenes_own_lengths() {
    // A way of 4 through a slab in front of a white background, whatever the scale.
    for scale in [0.01, 1.0, 300.0] {
        let rates = [0.1, 0.25, 0.5].map(|a| a / scale);
        let text = format!(
            "background = 1\n[camera]\neye = [0, 0, {}]\nlook_at = [0, 0, 0]\n\
             [render]\nspecular_cosine = false\n\
             [[material]]\nname = \"a\"\ndiffuse = 0\ntransmission = 1\nabsorption = {rates:?}\n\
             [[box]]\nmin = [{1}, {1}, {2}]\nmax = [{3}, {3}, {4}]\n",
            9.0 * scale,
            -3.0 * scale,
            -2.0 * scale,
            3.0 * scale,
            2.0 * scale
        );
        all(&text, [-0.4f64, -1.0, -2.0].map(f64::exp), 1e-3);
    }
}

/// What a unit of length may absorb is limited in the units that the arithmetic gives the scene; the
/// error says so in the scene's own, at the line that is wrong.
#[test]
fn what_absorbs_too_much_is_refused_at_its_line() {
    fn refused<A: Construct>(scale: f64) {
        let text = |rate: f64| {
            format!(
                "[camera]\neye = [0, 0, {}]\nlook_at = [0, 0, 0]\n\
                 [[material]]\nname = \"a\"\ntransmission = 1\n\
                 absorption_front = 0.001\nabsorption = [0, {rate}, 0]\n\
                 [[sphere]]\ncenter = [0, 0, 0]\nradius = {scale}\n",
                9.0 * scale,
            )
        };
        let baked = Baked::<A>::new(&scene(&text(0.001))).unwrap();
        let most = 170.0 * baked.placement.scale();
        Baked::<A>::new(&scene(&text(most))).unwrap_or_else(|flaw| panic!("{}", flaw.problem));
        let flaw = Baked::<A>::new(&scene(&text(most * 1.5))).unwrap_err();
        assert_eq!(flaw.line, Some(8));
        let said = flaw.problem.to_string();
        let right = format!(
            "absorption {} is out of range: it must be 0 to {most} (in {} arithmetic, in this scene)",
            most * 1.5,
            A::NAME
        );
        assert_eq!(said, right);
    }
    for scale in [0.1, 1.0, 300.0] {
        refused::<Fixed>(scale);
        refused::<f32>(scale);
        refused::<f64>(scale);
    }
}

#[test]
fn a_scene_of_everything() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/textures.toml");
    let document = read(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(document.materials.iter().filter(|m| m.texture.is_some()).count(), 10);
    let pov = whitted_host::pov::to_pov(&document, Size { width: 4, height: 3 });
    assert_eq!(pov.matches('{').count(), pov.matches('}').count());
    let render = |arithmetic: &str| {
        let place = tempfile::tempdir().unwrap();
        let file = path.to_str().unwrap();
        let args =
            ["render", file, "--arith", arithmetic, "--size", "96x60", "-o", "out.png", "-q"];
        let output = common::whitted(place.path(), &args);
        assert!(output.status.success(), "{}", common::errors(&output));
        let file = std::fs::File::open(place.path().join("out.png")).unwrap();
        let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        pixels
    };
    let reference = render("f64");
    for (arithmetic, least) in [("fixed", 40.0), ("f32", 50.0)] {
        let other = render(arithmetic);
        let squares: f64 = other
            .iter()
            .zip(&reference)
            .map(|(&a, &b)| (f64::from(a) - f64::from(b)).powi(2))
            .sum();
        let decibels = 10.0 * (255.0f64.powi(2) * other.len() as f64 / squares.max(1e-9)).log10();
        assert!(decibels > least, "{arithmetic}: {decibels} dB");
        println!("{arithmetic}: {decibels:.1} dB");
    }
}

//! Small pictures as text, one a feature, so that a change shows in a diff as what it is.
//!
//! Fixed point, sixteen levels of grey without dither: ` ` is black, `@` is white. A character is
//! about twice as high as wide, so cameras here squeeze the picture. To renew one, look at what a
//! failure prints, and paste it once it is what should be seen.

mod common;

use common::make::{Body, Make, Shapes};
use whitted::frame::{Gray4, Output, Renderer, Settings};
use whitted::math::Fixed;
use whitted::scene::{Falloff, LightSpec, MaterialSpec, Parts, PatternSpec, Rules, Scene};
use whitted::trace::Work;

const WIDTH: u16 = 28;
const HEIGHT: u16 = 12;
const LEVELS: &[u8; 16] = b" .,:;-~=+*oxOX#@";

const MATT: MaterialSpec =
    MaterialSpec { ambient: [0.15; 3], diffuse: [0.7; 3], ..MaterialSpec::BLACK };
const DARK: MaterialSpec =
    MaterialSpec { ambient: [0.03; 3], diffuse: [0.1; 3], ..MaterialSpec::BLACK };
/// Cells of 1, dark ones of material 1.
const CHECKER: MaterialSpec = MaterialSpec {
    pattern: Some(PatternSpec { cell: [1.0, 0.0, 1.0], offset: [0.5, 0.0, 0.0], other: 1 }),
    ..MATT
};
const LAMP: LightSpec =
    LightSpec::Point { position: [-4.0, 6.0, -4.0], intensity: [0.9; 3], falloff: Falloff::None };

/// What a camera at (0, 1.6, −4) sees: materials are the checker, the dark one, and `spec`.
fn view(bodies: &[Body], spec: MaterialSpec, lights: &[LightSpec], floor: bool) -> String {
    let mut all: Vec<_> = bodies.iter().map(|body| (body.clone(), 2)).collect();
    if floor {
        all.push((Body::Plane([0.0, 1.0, 0.0], 0.0), 0));
    }
    let shapes = Shapes::<Fixed>::of(&all, -16);
    let materials = [CHECKER, DARK, spec].map(|spec| Fixed::material(&spec).expect("a material"));
    let lights: Vec<_> = lights.iter().map(|l| Fixed::light(l).expect("a light")).collect();
    let scene = Scene::new(Parts {
        materials: &materials,
        lights: &lights,
        ambient: Fixed::ambient([0.6; 3]).expect("ambient"),
        background: Fixed::gradient([0.0, 1.0, 0.0], [0.9; 3], [0.0; 3]).expect("sky"),
        rules: Rules::WHITTED,
        ..shapes.parts()
    })
    .expect("a scene");
    // down a little, and the characters' proportions
    let (forward, right, down) = ([0.0, -0.25, 1.0], [0.25, 0.0, 0.0], [0.0, -0.5, -0.125]);
    let camera = Fixed::vectors([0.0, 1.6, -4.0], forward, right, down).expect("a camera");
    let mut work = Work::<Fixed, 5>::new();
    let settings = Settings::new(WIDTH, HEIGHT);
    let mut renderer =
        Renderer::new(&scene, &camera, settings, &mut work, &mut []).expect("settings");
    let mut text = String::new();
    for y in 0..HEIGHT {
        let mut line = [Gray4(0); WIDTH as usize];
        renderer.line(y, &Output::SRGB, &mut line);
        text.extend(line.map(|Gray4(level)| char::from(LEVELS[usize::from(level)])));
        text.push('\n');
    }
    text
}

/// Compares, and prints both pictures where they differ. Frames keep the lines' ends.
fn check(name: &str, got: &str, expected: &str) {
    let framed = |text: &str| text.lines().map(|line| format!("|{line}|\n")).collect::<String>();
    let expected: String = expected
        .trim_matches([' ', '\n'])
        .lines()
        .map(|line| format!("{}\n", line.trim().trim_matches('|')))
        .collect();
    assert!(got == expected, "{name} is\n{}and should be\n{}", framed(got), framed(&expected));
}

/// A ball on a checker, lit from the upper left: its shadow falls to the right and back.
#[test]
fn a_ball_and_its_shadow() {
    let got = view(&[Body::Sphere([0.0, 0.8, 0.5], 0.8)], MATT, &[LAMP], true);
    check("a_ball_and_its_shadow", &got, "");
}

/// A mirror ball shows sky above, the floor below.
#[test]
fn a_mirror() {
    let got = view(
        &[Body::Sphere([0.0, 0.8, 0.5], 0.8)],
        MaterialSpec { reflection: [0.9; 3], ..MaterialSpec::BLACK },
        &[LAMP],
        true,
    );
    check("a_mirror", &got, "");
}

/// A glass ball shows the world upside down: the bright floor and horizon above, dark sky below.
#[test]
fn glass() {
    let got = view(
        &[Body::Sphere([0.0, 0.8, 0.5], 0.8)],
        MaterialSpec { transmission: [0.9; 3], index_behind: 1.5, ..MaterialSpec::BLACK },
        &[LAMP],
        true,
    );
    check("glass", &got, "");
}

/// A pool of light on the floor that fades towards its edge.
#[test]
fn a_spot() {
    let got = view(
        &[],
        MATT,
        &[LightSpec::Spot {
            position: [0.0, 4.0, 1.0],
            direction: [0.0, -1.0, 0.0],
            intensity: [1.2; 3],
            falloff: Falloff::None,
            cos_inner: 0.98,
            cos_outer: 0.93,
        }],
        true,
    );
    check("a_spot", &got, "");
}

/// A gradient, brightest below.
#[test]
fn sky() {
    let got = view(&[], MATT, &[], false);
    check("sky", &got, "");
}

#[test]
fn a_triangle() {
    let got = view(
        &[Body::Triangle([[-1.2, 0.0, 0.0], [1.2, 0.0, 0.0], [0.0, 1.8, 0.0]])],
        MATT,
        &[LAMP],
        true,
    );
    check("a_triangle", &got, "");
}

/// As the flat one, but darker towards the right.
#[test]
fn a_smooth_triangle() {
    let got = view(
        &[Body::Smooth(
            [[-1.2, 0.0, 0.0], [1.2, 0.0, 0.0], [0.0, 1.8, 0.0]],
            [[-1.5, 0.0, -1.0], [1.5, 0.0, -1.0], [0.0, 0.5, -1.0]],
        )],
        MATT,
        &[LAMP],
        true,
    );
    check("a_smooth_triangle", &got, "");
}

/// A hexagon.
#[test]
fn a_polygon() {
    let got = view(
        &[Body::Polygon(vec![
            [-0.6, 0.1, 0.0],
            [0.6, 0.1, 0.0],
            [1.1, 0.9, 0.0],
            [0.6, 1.7, 0.0],
            [-0.6, 1.7, 0.0],
            [-1.1, 0.9, 0.0],
        ])],
        MATT,
        &[LAMP],
        true,
    );
    check("a_polygon", &got, "");
}

/// Front and top, the top lighter.
#[test]
fn a_box() {
    let got = view(&[Body::Cuboid([-0.9, 0.0, -0.3], [0.7, 1.1, 1.2])], MATT, &[LAMP], true);
    check("a_box", &got, "");
}

#[test]
fn a_disc() {
    let got = view(&[Body::Disc([0.0, 1.0, 0.4], [-0.2, 0.6, -1.0], 0.9)], MATT, &[LAMP], true);
    check("a_disc", &got, "");
}

/// Open above: the far wall is seen from within, the lower part of it in shadow.
#[test]
fn a_cylinder() {
    let got = view(&[Body::Cylinder([0.0, 0.0, 0.5], [0.0, 1.4, 0.5], 0.7)], MATT, &[LAMP], true);
    check("a_cylinder", &got, "");
}

#[test]
fn a_cone() {
    let got = view(&[Body::Cone([0.0, 0.0, 0.5], 1.0, [0.0, 1.9, 0.5], 0.0)], MATT, &[LAMP], true);
    check("a_cone", &got, "");
}

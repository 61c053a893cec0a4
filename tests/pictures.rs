//! Small pictures as text, one a feature, so that a change shows in a diff as what it is.
//!
//! Fixed point, sixteen levels of grey without dither: ` ` is black, `@` is white. A character is
//! about twice as high as wide, so cameras here squeeze the picture. To renew one, look at what a
//! failure prints, and paste it once it is what should be seen.

use crate::common::make::{Body, Make, Shapes};
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
        background: Fixed::gradient([0.0, 1.0, 0.0], [0.0; 3], [1.0; 3]).expect("sky"),
        rules: Rules::WHITTED,
        ..shapes.parts()
    })
    .expect("a scene");
    // down a little, and the characters' proportions
    let (forward, right, down) = ([0.0, -0.2, 1.0], [0.18, 0.0, 0.0], [0.0, -0.36, -0.07]);
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
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |=:=:=:=:=:XXXOOxo*:=:=:=:=:=|
        |;***;;**OXXXOOOxo*+-**;;***;|
        |oo;;;oooOOOOOxxo*+~-ooo;;;oo|
        |xx-----xoxxxoo**=~--o;;;;;oo|
        |xxxxx----=++++=~---,,,,--xxx|
        |---OOOOOOO-,----,,----xxx---|
        |O---------OOOOOOxx---------x|
        |---------OOOOOOOOOO---------|
        |OOOOOOOO------------OOOOxxxx|
    ";
    check("a_ball_and_its_shadow", &got, expected);
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
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |=:=:=:=:=:X######X:=:=:=:=:=|
        |;***;;**xOXX####XXOx**;;***;|
        |oo;;;ooo+xxxOOOOxxx+ooo;;;oo|
        |xx-----xx-O-OOxx;x;oo;;;;;oo|
        |xxxxx----xx-xxxx-x-,,,,--xxx|
        |---OOOOOOO-,,,,,,,----xxx---|
        |O---------OOOOOOxx---------x|
        |---------OOOOOOOOOO---------|
        |OOOOOOOO------------OOOOxxxx|
    ";
    check("a_mirror", &got, expected);
}

/// A glass ball shows the world upside down: the floor above, the bright sky below.
#[test]
fn glass() {
    let got = view(
        &[Body::Sphere([0.0, 0.8, 0.5], 0.8)],
        MaterialSpec { transmission: [0.9; 3], index_behind: 1.4, ..MaterialSpec::BLACK },
        &[LAMP],
        true,
    );
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |=:=:=:=:=:,;;;;;;;:=:=:=:=:=|
        |;***;;**,oooooooooo;**;;***;|
        |oo;;;ooo;**;;;;;;**;ooo;;;oo|
        |xx-----xxo:::++:::oxo;;;;;oo|
        |xxxxx----OxxxxxxxxO,,,,--xxx|
        |---OOOOOOO-,XXXX,,----xxx---|
        |O---------OOOOOOxx---------x|
        |---------OOOOOOOOOO---------|
        |OOOOOOOO------------OOOOxxxx|
    ";
    check("glass", &got, expected);
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
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |-,-,-,-,-,-,-,,-,-,-,-,-,-,-|
        |,---,,--,,,--,,--,,,--,,---,|
        |--,,,----,,,----,,,----,,,--|
        |--,,,,,-----,,,,-----,,,,,--|
        |-----:;-~~~######~~~-;:-----|
        |,,,-=oOX##~~~~~~~~##XOo=-,,,|
        |-,,,,,,::;*ooxxoo*;::,,,,,,-|
        |,,,,,,,,,----------,,,,,,,,,|
        |--------,,,,,,,,,,,,--------|
    ";
    check("a_spot", &got, expected);
}

/// A gradient, brightest above.
#[test]
fn sky() {
    let got = view(&[], MATT, &[], false);
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxooooooooooooooooooxxxxx|
        |oooooooooooooooooooooooooooo|
        |oooooooooooooooooooooooooooo|
        |ooooooooooo******ooooooooooo|
        |****************************|
        |****************************|
        |********++++++++++++********|
        |++++++++++++++++++++++++++++|
    ";
    check("sky", &got, expected);
}

#[test]
fn a_triangle() {
    let got = view(
        &[Body::Triangle([[-1.2, 0.0, 0.0], [1.2, 0.0, 0.0], [0.0, 1.8, 0.0]])],
        MATT,
        &[LAMP],
        true,
    );
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxxooxxxxxxxxxxxxx|
        |=:=:=:=:=:=:oooo:=:=:=:=:=:=|
        |;***;;**;;oooooooo;;**;;***;|
        |oo;;;oooooooooooooooooo;;;oo|
        |xx-----xooooooooooooo;;;;;oo|
        |xxxxx-oooooooooooooooo,-xxxx|
        |---OOoooooooooooooooooo-x---|
        |O---------OOOOOOxx---------x|
        |---------OOOOOOOOOO---------|
        |OOOOOOOO------------OOOOxxxx|
    ";
    check("a_triangle", &got, expected);
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
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxxOOxxxxxxxxxxxxx|
        |=:=:=:=:=:=:OOxx:=:=:=:=:=:=|
        |;***;;**;;OOOOxxoo;;**;;***;|
        |oo;;;ooooOOOOOxxoo*oooo;;;oo|
        |xx-----xOOOOOxxoo*++o;;;;;oo|
        |xxxxx-OOOOOOxxxo**+=~-,-xxxx|
        |---OOxxxxxxxxxo**+=~----x---|
        |O---------OOOOOOxx---------x|
        |---------OOOOOOOOOO---------|
        |OOOOOOOO------------OOOOxxxx|
    ";
    check("a_smooth_triangle", &got, expected);
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
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxooooooooxxxxxxxx|
        |=:=:=:=xxxooooooooooo=:=:=:=|
        |;***;;xooooooooooooooo;;***;|
        |oo;;;oooooooooooooooooo;;;oo|
        |xx----oooooooooooooooo;;;;oo|
        |xxxxx--oooooooooooooo,,-----|
        |---OOOOOOoooooooooo---------|
        |O---------OOOOOOxx---------x|
        |---------OOOOOOOOOO---------|
        |OOOOOOOO------------OOOOxxxx|
    ";
    check("a_polygon", &got, expected);
}

/// Front and top, the top lighter.
#[test]
fn a_box() {
    let got = view(&[Body::Cuboid([-0.9, 0.0, -0.3], [0.7, 1.1, 1.2])], MATT, &[LAMP], true);
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |=:=:=:=:=:=:=::=:=:=:=:=:=:=|
        |;***;;*xxxxxxxxxxxx;**;;***;|
        |oo;;;oooooooooooooooooo;;;oo|
        |xx----ooooooooooooooo;;;;;oo|
        |xxxxx-oooooooooooooo,,,--xxx|
        |---OOOoooooooooooooo-----,--|
        |O-----oooooooooooooo-------x|
        |---------OOOOOOOOOO---------|
        |OOOOOOOO------------OOOOxxxx|
    ";
    check("a_box", &got, expected);
}

#[test]
fn a_disc() {
    let got = view(&[Body::Disc([0.0, 1.0, 0.4], [-0.2, 0.6, -1.0], 0.9)], MATT, &[LAMP], true);
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxXXXOOOOxxxxxxxxxx|
        |=:=:=:=:=XXXXOOOOOOO:=:=:=:=|
        |;***;;**XXXXOOOOOOOOO*;;***;|
        |oo;;;ooXXXOOOOOOOOOOOoo;;;oo|
        |xx-----xOOOOOOOOOOOOo;;;;;oo|
        |xxxxx----OOOOOOOOO,,,,,----x|
        |---OOOOOOO-,,,,,,,-----xx---|
        |O---------OOOOOOxx---------x|
        |---------OOOOOOOOOO---------|
        |OOOOOOOO------------OOOOxxxx|
    ";
    check("a_disc", &got, expected);
}

/// Open above: the far wall is seen from within, the lower part of it in shadow.
#[test]
fn a_cylinder() {
    let got = view(&[Body::Cylinder([0.0, 0.0, 0.5], [0.0, 1.4, 0.5], 0.7)], MATT, &[LAMP], true);
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |=:=:=:=:=-=*oxxOOOO=:=:=:=:=|
        |;***;;**;OOxxoo*+~-;**;;***;|
        |oo;;;ooooxxxxoo*+~-oooo;;;oo|
        |xx-----xxxxxxoo*+~-xo;;;;;oo|
        |xxxxx----xxxxoo*+~-,,,,---xx|
        |---OOOOOOxxxxoo*+~---xxxx---|
        |O---------OOOOOOxx---------x|
        |---------OOOOOOOOOO---------|
        |OOOOOOOO------------OOOOxxxx|
    ";
    check("a_cylinder", &got, expected);
}

#[test]
fn a_cone() {
    let got = view(&[Body::Cone([0.0, 0.0, 0.5], 1.0, [0.0, 1.9, 0.5], 0.0)], MATT, &[LAMP], true);
    let expected = "
        |OOOOOOOOOOOOOOOOOOOOOOOOOOOO|
        |xxxxxxxxxxxxxxxxxxxxxxxxxxxx|
        |xxxxxxxxxxxxxXoxxxxxxxxxxxxx|
        |=:=:=:=:=:=:XOx+:=:=:=:=:=:=|
        |;***;;**;;;XXOxo+;;;**;;***;|
        |oo;;;oooo;XXXOxx*=;oooo;;;oo|
        |xx-----xxXXXOOxxo*=xo;;;;;oo|
        |xxxxx---OXXOOOxxo*+~,,,xxxxx|
        |---OOOOOXXXOOOxxoo*+~-xxx---|
        |O-------XXOOOOxxxo**-------x|
        |---------OOOOOOOOOO---------|
        |OOOOOOOO------------OOOOxxxx|
    ";
    check("a_cone", &got, expected);
}

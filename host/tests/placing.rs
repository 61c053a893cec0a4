//! Placement, repetition and files within files.

mod common;

use std::fs;
use std::path::Path;

use common::{errors, said, whitted};
use whitted_host::document::{Body, Document, LightKind, Point};
use whitted_host::read::{self, Format};

const HEAD: &str = "[camera]\neye = [0, 1, -5]\nlook_at = [0, 0, 0]\n\
                    [[material]]\nname = \"red\"\n";

fn parsed(text: &str) -> Document {
    let all = format!("{HEAD}{text}");
    read::parse(Format::Toml, all.as_bytes()).unwrap_or_else(|f| panic!("{}\n{all}", f.problem))
}

fn centers(document: &Document) -> Vec<Point> {
    let center = |shape: &whitted_host::document::Shape| match shape.body {
        Body::Sphere { center, .. } => center,
        _ => panic!("{shape:?}"),
    };
    document.shapes.iter().map(center).collect()
}

#[test]
fn scaled_then_turned_then_moved() {
    let ball = "[[sphere]]\ncenter = [1, 0, 0]\nradius = 1\n";
    let document = parsed(&format!("{ball}scale = 2\nrotate = [0, 0, 90]\nmove = [0, 0, 5]\n"));
    assert_eq!(document.shapes[0].body, Body::Sphere { center: [0.0, 2.0, 5.0], radius: 2.0 });
    let other = "rotate = { axis = [0, 0, 3], angle = 90 }\ntranslate = [0, 0, 5]\nscale = 2\n";
    assert_eq!(parsed(&format!("{ball}{other}")).shapes[0].body, document.shapes[0].body);
    let in_place = parsed(&format!("{ball}scale = 3\nrotate = [5, 6, 7]\npivot = [1, 0, 0]\n"));
    let Body::Sphere { center, radius } = in_place.shapes[0].body else { panic!() };
    assert!((0..3).all(|i| (center[i] - [1.0, 0.0, 0.0][i]).abs() < 1e-12));
    assert!((radius - 3.0).abs() < 1e-12);
}

#[test]
fn rows_of_rows() {
    let document = parsed(
        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 0.1\nmove = [1, 0, 0]\n\
         repeat = [{ count = 2, step = [1, 0, 0] }, { count = 3, step = [0, 10, 0] }]\n",
    );
    let rows = [0.0, 10.0, 20.0].map(|y| [[1.0, y, 0.0], [2.0, y, 0.0]]);
    assert_eq!(centers(&document), rows.concat());
}

#[test]
fn around_an_axis() {
    let document = parsed(
        "[[sphere]]\ncenter = [3, 0, 0]\nradius = 0.1\n\
         repeat = { count = 4, rotate = [0, 0, 90], pivot = [1, 0, 0], step = [0, 0, 1] }\n",
    );
    let wanted = [[3.0, 0.0, 0.0], [1.0, 2.0, 1.0], [-1.0, 0.0, 2.0], [1.0, -2.0, 3.0]];
    assert_eq!(centers(&document), wanted);
}

#[test]
fn copies_keep_the_order_of_the_file() {
    let document = parsed(
        "[[box]]\nmin = [0, 0, 0]\nmax = [1, 1, 1]\nrotate = [0, 45, 0]\n\
         [[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n\
         [[box]]\nmin = [0, 0, 0]\nmax = [1, 1, 1]\nscale = [1, 2, 3]\n",
    );
    let names: Vec<&str> = document.shapes.iter().map(|s| s.body.name()).collect();
    let face = "polygon";
    assert_eq!(names, [face, face, face, face, face, face, "sphere", "box"]);
}

/// A turned box is the same to a ray as the box met by the turned ray.
#[test]
fn a_turned_box_looks_like_one() {
    let place = tempfile::tempdir().unwrap();
    let scene = |eye: &str, turn: &str| {
        format!(
            "background = 0.5\nambient = 1\n[camera]\neye = {eye}\nlook_at = [0, 0, 0]\n\
             [[material]]\nname = \"a\"\n[[box]]\nmin = [-1, -1, -1]\nmax = [1, 1, 1]\n{turn}"
        )
    };
    // The camera turned by -30 degrees about y sees what a box turned by 30 shows.
    fs::write(place.path().join("a.toml"), scene("[0, 0, 8]", "rotate = [0, 30, 0]")).unwrap();
    fs::write(place.path().join("b.toml"), scene("[-4, 0, 6.92820323027551]", "")).unwrap();
    let picture = |name: &str| {
        let scene = format!("{name}.toml");
        let output = whitted(place.path(), &["-q", "render", &scene, "--size", "64x64", "-o", "-"]);
        assert_eq!(errors(&output), "");
        output.stdout
    };
    assert_eq!(picture("a"), picture("b"));
}

fn included(directory: &Path) -> String {
    let lamp = "[[light]]\nposition = [0, 1, 0]\nintensity = 3\n\
                [[light]]\ntype = \"directional\"\ndirection = [1, 0, 0]\n\
                [[material]]\nname = \"shade\"\nchecker = { with = \"foot\" }\n\
                [[material]]\nname = \"foot\"\n\
                [[sphere]]\ncenter = [0, 1, 0]\nradius = 0.5\nmaterial = \"shade\"\n";
    fs::create_dir(directory.join("parts")).unwrap();
    fs::write(directory.join("parts/lamp.toml"), lamp).unwrap();
    let two = "[[include]]\nfile = \"lamp.toml\"\nrepeat = { count = 2, step = [4, 0, 0] }\n";
    fs::write(directory.join("parts/two.toml"), two).unwrap();
    let room = "[[include]]\nfile = \"parts/two.toml\"\nscale = 2\nrotate = [0, 90, 0]\n\
                [[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"foot\"\n";
    format!("{HEAD}{room}")
}

#[test]
fn files_within_files() {
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("room.toml");
    fs::write(&file, included(place.path())).unwrap();
    let document = read::read(&file).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(centers(&document), [[0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 2.0, -8.0]]);
    let name = |shape: usize| document.materials[document.shapes[shape].material].name.as_str();
    assert_eq!([name(0), name(1), name(2)], ["foot", "shade", "shade"]);
    let checker = document.materials[document.shapes[1].material].checker.unwrap();
    assert_eq!(document.materials[checker.other].name, "foot");
    assert_eq!(document.lights.len(), 4);
    assert_eq!(document.lights[2].position(), Some([0.0, 2.0, -8.0]));
    assert_eq!(document.lights[2].color, [12.0; 3]);
    let LightKind::Directional { direction } = document.lights[3].kind else { panic!() };
    assert_eq!(direction.map(f64::round), [0.0, 0.0, -2.0]);
    let lamp = Some(place.path().join("parts/lamp.toml"));
    assert_eq!(document.file_of_shape(0), None);
    assert_eq!(document.file_of_shape(2).map(Path::to_owned), lamp);
    assert_eq!(document.file_of_light(1).map(Path::to_owned), lamp);
    let check = whitted(place.path(), &["check", "room.toml"]);
    assert!(said(&check).contains("3 (3 spheres)"), "{}", said(&check));
}

#[test]
fn what_is_wrong_in_another_file_is_said_of_it() {
    let place = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(place.path().join(name), text).unwrap();
    write("all.toml", &format!("include = \"part.toml\"\n{HEAD}"));
    let cases = [
        ("[[sphere]]\nradius = 1\n", "part.toml:1: key \"material\" of this sphere is missing"),
        ("x = [", "part.toml:1: unclosed array"),
        ("include = \"all.toml\"\n", "part.toml:1: include \"all.toml\": this file is within"),
        ("include = [\"no.toml\"]\n", "part.toml:1: no.toml: can't be read"),
        (
            "[[material]]\nname = \"a\"\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1e-9\n\
             [[sphere]]\ncenter = [1e4, 0, 0]\nradius = 1\n",
            "part.toml:3: sphere can't be represented",
        ),
    ];
    for (text, says) in cases {
        write("part.toml", text);
        let more = ["render", "all.toml", "--arith", "fixed", "--size", "4x4", "-o", "a.png"];
        let output = whitted(place.path(), &more);
        assert!(errors(&output).contains(says), "{text}: {}", errors(&output));
        assert_eq!(output.status.code(), Some(2));
    }
    write("part.toml", "[[material]]\nname = \"b\"\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n");
    write("two.toml", "[[material]]\nname = \"b\"\n");
    let both = format!(
        "include = [\"part.toml\", \"two.toml\"]\n{HEAD}\
         [[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"b\"\n"
    );
    write("all.toml", &both);
    let output = whitted(place.path(), &["check", "all.toml"]);
    let says = "all.toml:10: material \"b\": both part.toml and two.toml have one of this name";
    assert!(errors(&output).contains(says), "{}", errors(&output));
}

//! Groups and their instances: the same picture as the shapes written out.

use whitted::math::Fixed;
use whitted_host::bake::{Baked, Construct};
use whitted_host::document::Size;
use whitted_host::picture::Picture;
use whitted_host::pov::to_pov;
use whitted_host::read::{self, Format};
use whitted_host::render::{Sampling, Settings, render};

/// A floor under two towers, written out or as instances of a group.
const HEAD: &str = "ambient = 0.2\nbackground = 0.5\n\
    [camera]\neye = [203, 9, -9]\nlook_at = [201, 1, 0]\nangle = 30\n\
    [[light]]\nposition = [205, 8, -6]\nintensity = 90\n\
    [[material]]\nname = \"floor\"\n\
    [[material]]\nname = \"red\"\ndiffuse = [0.8, 0.1, 0.1]\nreflection = 0.2\n\
    [[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\nmaterial = \"floor\"\n";

/// A tower of a box, a ball and a pole; `of` is what its tables are called.
fn tower(of: &str, place: &str) -> String {
    format!(
        "[[{of}box]]\nmin = [-1, 0, -1]\nmax = [1, 1, 1]\nmaterial = \"red\"\n{place}\
         [[{of}sphere]]\ncenter = [0, 2, 0]\nradius = 1\nmaterial = \"red\"\n{place}\
         [[{of}cylinder]]\nbase = [0, 2, 0]\napex = [1, 4, 0]\nradius = 0.3\nmaterial = \"red\"\n\
         {place}"
    )
}

const PLACES: [&str; 2] = [
    "rotate = [0, 35, 10]\nmove = [200, 0, 0]\n",
    "scale = 0.5\nrotate = [0, -20, 0]\nmove = [203, 0, 1]\n",
];

fn picture<A: Construct>(text: &str) -> Picture {
    let document = read::parse(Format::Toml, text.as_bytes())
        .unwrap_or_else(|flaw| panic!("{:?}: {}\n{text}", flaw.line, flaw.problem));
    let baked = Baked::<A>::new(&document).unwrap_or_else(|flaw| panic!("{}", flaw.problem));
    let size = Size { width: 96, height: 72 };
    let settings = Settings {
        indirect: None,
        size,
        depth: 4,
        sampling: Sampling::Grid { side: 2 },
        show: None,
        threads: std::num::NonZeroUsize::MIN,
    };
    render(&baked, &settings, |_| {}).unwrap_or_else(|flaw| panic!("{}", flaw.problem)).picture
}

fn decibels(a: &Picture, b: &Picture) -> f64 {
    let differences = a.pixels().iter().flatten().zip(b.pixels().iter().flatten());
    let square = |(x, y): (&u8, &u8)| (f64::from(*x) - f64::from(*y)).powi(2);
    let sum: f64 = differences.map(square).sum();
    let mean = sum / (a.pixels().len() * 3) as f64;
    10.0 * (255.0 * 255.0 / mean.max(1e-9)).log10()
}

fn instanced() -> String {
    let places = PLACES.map(|place| format!("[[instance]]\ngroup = \"tower\"\n{place}"));
    format!("{HEAD}[[group]]\nname = \"tower\"\n{}{}", tower("group.", ""), places.concat())
}

#[test]
fn the_same_picture() {
    let written = format!("{HEAD}{}", PLACES.map(|place| tower("", place)).concat());
    let reference = picture::<f64>(&written);
    let double = decibels(&reference, &picture::<f64>(&instanced()));
    assert!(double > 60.0, "{double}");
    // Fixed point is as far from the reference either way.
    let fixed = decibels(&reference, &picture::<Fixed>(&instanced()));
    let plain = decibels(&reference, &picture::<Fixed>(&written));
    println!("f64 {double:.1} dB, fixed {fixed:.1} dB, written out {plain:.1} dB");
    assert!(fixed > 40.0 && fixed > plain - 2.0, "{fixed} {plain}");
}

#[test]
fn patterns_move_with_the_group() {
    // A checker in the group's space, in fixed point too, whose scene lies far from the origin.
    let text = |place: &str, eye: &str, at: &str| {
        format!(
            "ambient = 1\n[camera]\neye = {eye}\nlook_at = {at}\n\
             [[material]]\nname = \"a\"\ndiffuse = 1\nchecker = {{ with = \"b\" }}\n\
             [[material]]\nname = \"b\"\ndiffuse = 0\n\
             [[group]]\nname = \"ball\"\n\
             [[group.sphere]]\ncenter = [0.1, 0.2, 0.3]\nradius = 2\nmaterial = \"a\"\n\
             [[instance]]\ngroup = \"ball\"\n{place}"
        )
    };
    let here = text("", "[0, 0, -6]", "[0, 0, 0]");
    let there = text("move = [100.3, 20.6, 0]\n", "[100.3, 20.6, -6]", "[100.3, 20.6, 0]");
    let near = decibels(&picture::<f64>(&here), &picture::<f64>(&there));
    assert!(near > 50.0, "{near}");
    let fixed = decibels(&picture::<f64>(&here), &picture::<Fixed>(&there));
    assert!(fixed > 40.0, "{fixed}");
}

#[test]
fn pov_ray_gets_unions() {
    let document = read::parse(Format::Toml, instanced().as_bytes())
        .unwrap_or_else(|f| panic!("{}", f.problem));
    let text = to_pov(&document, Size { width: 4, height: 3 });
    assert_eq!(text.matches("union {").count(), 2);
    assert_eq!(text.matches("matrix <").count(), 2);
    assert_eq!(text.matches('{').count(), text.matches('}').count());
}

#[test]
fn solids_and_caps_have_their_words() {
    let document = read::parse(Format::Toml, include_bytes!("../scenes/solids.toml"))
        .unwrap_or_else(|flaw| panic!("{:?}: {}", flaw.line, flaw.problem));
    let text = to_pov(&document, Size { width: 4, height: 3 });
    for word in ["difference {", "intersection {", "merge {", "union {", "plane {"] {
        assert!(text.contains(word), "{word}");
    }
    assert!(!text.contains(" open"));
    assert_eq!(text.matches('{').count(), text.matches('}').count());
}

/// A solid of one shape is that shape; fixed point draws solids, caps and instances as f64 does.
#[test]
fn solids_in_pictures() {
    let head = "ambient = 0.3\nbackground = 0.5\n[camera]\neye = [1, 2, -6]\n\
                look_at = [0, 0, 0]\n[[light]]\nposition = [4, 6, -5]\nintensity = 50\n\
                [[material]]\nname = \"a\"\nreflection = 0.2\n";
    let tube = "{ base = [-1, 0, 0], apex = [1, 0.5, 0], radius = 0.8 }";
    let closed = format!(
        "{head}[[cylinder]]\nbase = [-1, 0, 0]\napex = [1, 0.5, 0]\nradius = 0.8\ncaps = true\n"
    );
    let solid = format!("{head}[[solid]]\nunion = [{{ cylinder = {tube} }}]\n");
    assert!(decibels(&picture::<f64>(&closed), &picture::<f64>(&solid)) > 100.0);
    let scene = include_str!("../scenes/solids.toml");
    let fixed = decibels(&picture::<f64>(scene), &picture::<Fixed>(scene));
    println!("solids: fixed {fixed:.1} dB");
    assert!(fixed > 42.0, "{fixed}");
}

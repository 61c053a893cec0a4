//! Area lights from files: what they cost, and that they are what the library makes of them.

use std::num::NonZeroUsize;

use whitted_host::bake::{Baked, Construct};
use whitted_host::document::{Document, Size};
use whitted_host::picture::Picture;
use whitted_host::pov::to_pov;
use whitted_host::read::{Format, parse};
use whitted_host::render::{Rendered, Sampling, Settings, render};

use whitted::math::Fixed;

/// A room of 4×2.6×5 with a table, a ball, a mirror and a lamp under the ceiling.
const ROOM: &str = r#"
ambient = 0.03
[camera]
eye = [2.1, 1.5, 0.2]
look_at = [1.9, 1.1, 5]
angle = 62
[render]
specular_cosine = false
[[material]]
name = "wall"
diffuse = [0.7, 0.68, 0.64]
[[material]]
name = "red"
diffuse = [0.6, 0.15, 0.1]
[[material]]
name = "wood"
diffuse = [0.45, 0.3, 0.18]
specular = 0.1
[[material]]
name = "steel"
diffuse = 0.1
reflection = 0.7
[[polygon]]
material = "wood"
corners = [[0, 0, 0], [0, 0, 5], [4, 0, 5], [4, 0, 0]]
[[polygon]]
material = "wall"
corners = [[0, 2.6, 0], [4, 2.6, 0], [4, 2.6, 5], [0, 2.6, 5]]
[[polygon]]
material = "red"
corners = [[0, 0, 0], [0, 2.6, 0], [0, 2.6, 5], [0, 0, 5]]
[[polygon]]
material = "wall"
corners = [[4, 0, 0], [4, 0, 5], [4, 2.6, 5], [4, 2.6, 0]]
[[polygon]]
material = "wall"
corners = [[0, 0, 5], [0, 2.6, 5], [4, 2.6, 5], [4, 0, 5]]
[[polygon]]
material = "wall"
corners = [[0, 0, 0], [4, 0, 0], [4, 2.6, 0], [0, 2.6, 0]]
[[box]]
material = "wood"
min = [0.8, 0.65, 2.8]
max = [2.4, 0.72, 3.8]
[[cylinder]]
material = "steel"
base = [1, 0, 3]
apex = [1, 0.65, 3]
radius = 0.04
[[cylinder]]
material = "steel"
base = [2.2, 0, 3]
apex = [2.2, 0.65, 3]
radius = 0.04
[[sphere]]
material = "red"
center = [1.3, 0.94, 3.3]
radius = 0.22
[[sphere]]
material = "steel"
center = [3, 0.45, 3.4]
radius = 0.45
[[box]]
material = "wall"
min = [1.9, 0.72, 3.2]
max = [2.1, 1.0, 3.4]
"#;

/// The lamp, of half a square metre, as a polygon.
const LAMP: &str = r#"
[[light]]
type = "polygon"
corners = [[1.65, 2.55, 2.2], [2.35, 2.55, 2.2], [2.35, 2.55, 2.9], [1.65, 2.55, 2.9]]
look_at = [2, 0, 2.5]
radiance = 14
visible = true
"#;

/// A point of the same power straight down: L_e·A/π.
const BULB: &str = "[[light]]\nposition = [2, 2.55, 2.55]\nintensity = 2.18\n";

fn document(light: &str) -> Document {
    parse(Format::Toml, format!("{ROOM}{light}").as_bytes())
        .unwrap_or_else(|e| panic!("{}", e.problem))
}

fn picture<A: Construct>(document: &Document, size: Size, sampling: Sampling) -> Rendered {
    let settings = Settings {
        indirect: None,
        size,
        depth: document.rules.depth,
        sampling,
        show: None,
        threads: NonZeroUsize::MIN,
    };
    render(&Baked::<A>::new(document).unwrap(), &settings, |_| {}).unwrap()
}

const SIZE: Size = Size { width: 96, height: 72 };

/// The course's own pair, 152,105 rays with a point light and 1,688,849 with a polygonal one, is
/// 11.1 times as many.
#[test]
fn a_polygonal_lamp_takes_about_ten_times_the_rays_of_a_bulb() {
    let point = picture::<f64>(&document(BULB), SIZE, Sampling::Center).counts;
    let polygon = picture::<f64>(&document(LAMP), SIZE, Sampling::Center).counts;
    let times = polygon.rays() as f64 / point.rays() as f64;
    println!("point {}, polygon {}: {times:.1} times", point.rays(), polygon.rays());
    assert!((8.0..14.0).contains(&times), "{point:?} {polygon:?} {times}");
}

/// A polygon of three corners is a triangle, shown too, whichever way round it is listed.
#[test]
fn three_corners_are_a_polygon_too() {
    let lamp = |kind: &str, corners: &str| {
        let text = format!(
            "[[light]]\ntype = \"{kind}\"\nradiance = 8\ncorners = {corners}\nlook_at = [2, 0, 2]\n\
             visible = true\n"
        );
        picture::<f64>(&document(&text), Size { width: 24, height: 18 }, Sampling::Center)
    };
    let one = lamp("triangle", "[[1.5, 2.5, 2], [2.5, 2.5, 2], [2, 2.5, 3]]");
    for corners in [
        "[[1.5, 2.5, 2], [2.5, 2.5, 2], [2, 2.5, 3]]",
        "[[1.5, 2.5, 2], [2, 2.5, 3], [2.5, 2.5, 2]]",
    ] {
        let other = lamp("polygon", corners);
        assert!(decibels(&one.picture, &other.picture) > 50.0);
        assert_eq!(one.counts.primary_hits, other.counts.primary_hits);
    }
}

fn decibels(a: &Picture, b: &Picture) -> f64 {
    let square = |(a, b): (&[u8; 3], &[u8; 3])| {
        (0..3).map(|i| (f64::from(a[i]) - f64::from(b[i])).powi(2)).sum::<f64>()
    };
    let sum: f64 = a.pixels().iter().zip(b.pixels()).map(square).sum();
    10.0 * (255.0f64.powi(2) / (sum / (3.0 * a.pixels().len() as f64))).log10()
}

/// The same places on the light, hashed from the pixel, whatever the arithmetic.
#[test]
fn noise_is_the_same_in_all_arithmetics() {
    let document = document(LAMP);
    let exact = picture::<f64>(&document, SIZE, Sampling::Center);
    let single = picture::<f32>(&document, SIZE, Sampling::Center);
    let fixed = picture::<Fixed>(&document, SIZE, Sampling::Center);
    let (single, fixed) =
        (decibels(&exact.picture, &single.picture), decibels(&exact.picture, &fixed.picture));
    println!("f32 {single:.1} dB, fixed {fixed:.1} dB");
    assert!(single > 45.0 && fixed > 38.0, "{single} {fixed}");
}

#[test]
fn a_lamp_for_pov_ray() {
    let text = to_pov(&document(LAMP), SIZE);
    assert!(text.contains("area_light") && text.contains("emission") && text.contains("no_shadow"));
    assert_eq!(text.matches('{').count(), text.matches('}').count());
}

//! Wavefront OBJ and MTL: meshes that the tests write.

mod common;

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use common::{errors, said, whitted};
use whitted_host::document::{Body, Document, Material, ShadowThrough};
use whitted_host::read;

fn document(directory: &Path, name: &str) -> Document {
    read::read(&directory.join(name)).unwrap_or_else(|e| panic!("{e}"))
}

fn warned(document: &Document) -> String {
    document.warnings.iter().map(|w| format!("{}: {}\n", w.line, w.text)).collect()
}

/// A pot of quads with normals: a profile turned about the y axis, as other programs write it.
fn pot(around: usize, up: usize) -> String {
    let mut text = String::from("# a pot\nmtllib pot.mtl\no pot\n");
    let profile = |t: f64| (0.2 + 0.8 * (PI * t).sin(), 1.6 * t);
    for j in 0..=up {
        let t = j as f64 / up as f64;
        let (r, y) = profile(t);
        let slope = (profile(t + 1e-6).0 - profile(t - 1e-6).0) / 2e-6 / 1.6;
        for i in 0..around {
            let (s, c) = (TAU * i as f64 / around as f64).sin_cos();
            let _ = writeln!(text, "v {} {y} {}\nvn {c} {} {s}", r * c, r * s, -slope);
        }
    }
    text.push_str("usemtl china\ns 1\n");
    for j in 0..up {
        for i in 0..around {
            let at = |i: usize, j: usize| j * around + i % around + 1;
            let corners = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            let words = corners.map(|k| format!("{k}//{k}")).join(" ");
            let _ = writeln!(text, "f {words}");
        }
    }
    text
}

const CHINA: &str =
    "newmtl china\nKd 0.7 0.6 0.5\nKa 0.1 0.1 0.1\nKs 0.4 0.4 0.4\nNs 60\nillum 3\n";

#[test]
fn a_pot_imports_and_renders_alike_alone_and_placed() {
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("pot.obj"), pot(40, 24)).unwrap();
    fs::write(place.path().join("pot.mtl"), CHINA).unwrap();
    let pot = document(place.path(), "pot.obj");
    assert_eq!(pot.shapes.len(), 2 * 40 * 24);
    assert!(pot.shapes.iter().all(|s| matches!(s.body, Body::SmoothTriangle { .. })));
    assert_eq!(pot.materials[0].reflection, [0.4; 3]);
    assert!(warned(&pot).contains("no camera: seen from") && warned(&pot).contains("no light"));
    let bounds = pot.bounds().unwrap();
    assert!((bounds.high[1] - 1.6).abs() < 1e-9 && (bounds.high[0] - 1.0).abs() < 1e-3);

    let eye = pot.camera.eye.map(|x| x.to_string()).join(", ");
    let at = pot.camera.look_at.map(|x| x.to_string()).join(", ");
    let scene = format!(
        "ambient = 0.15\n[camera]\neye = [{eye}]\nlook_at = [{at}]\nangle = 40\n\
         [render]\nspecular_cosine = false\nhighlight_cosine = false\nfalloff = \"none\"\n\
         [[light]]\ntype = \"directional\"\ndirection = [0.6, -1, -0.7]\ncolor = 0.9\n\
         [[mesh]]\nfile = \"pot.obj\"\n"
    );
    fs::write(place.path().join("scene.toml"), scene).unwrap();
    let picture = |scene: &str, arithmetic: &str| {
        let more = ["-q", "render", scene, "--size", "48x48", "--arith", arithmetic, "-o", "-"];
        let output = whitted(place.path(), &more);
        assert_eq!(errors(&output), "");
        output.stdout
    };
    for arithmetic in ["fixed", "f32", "f64"] {
        assert_eq!(picture("pot.obj", arithmetic), picture("scene.toml", arithmetic));
    }
}

#[test]
fn a_mesh_takes_a_material_of_the_scene() {
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("pot.obj"), pot(5, 3)).unwrap();
    fs::write(place.path().join("pot.mtl"), CHINA).unwrap();
    let scene = "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\n\
                 [[material]]\nname = \"red\"\n\
                 [[mesh]]\nfile = \"pot.obj\"\nmaterial = \"red\"\nmove = [0, 5, 0]\n\
                 repeat = { count = 2, step = [3, 0, 0] }\n\
                 [[mesh]]\nfile = \"pot.obj\"\n\
                 [[sphere]]\nmaterial = \"china\"\ncenter = [0, 0, 0]\nradius = 1\n";
    fs::write(place.path().join("scene.toml"), scene).unwrap();
    let scene = document(place.path(), "scene.toml");
    let name = |m: usize| scene.materials[m].name.as_str();
    let of = |range: std::ops::Range<usize>| {
        scene.shapes[range].iter().map(|s| name(s.material)).collect::<Vec<_>>()
    };
    assert_eq!(of(0..1), ["china"]);
    assert!(of(1..61).iter().all(|n| *n == "red"));
    assert!(of(61..91).iter().all(|n| *n == "china"));
    assert_eq!(scene.materials.len(), 2);
    assert_eq!(scene.shapes.len(), 91);
    assert!(scene.shapes[1].body.bounds().unwrap().low[1] >= 5.0);
}

#[test]
fn faces_of_all_kinds() {
    let place = tempfile::tempdir().unwrap();
    let text = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0 # a dent\nv 0 2 0\nv 0 0 5 1\n\
                f 1 2 3 \\\n 4 5\nf -6 -5 -1\ng back\nf 1 1 2\nl 1 2\np 1\nf 1/ 2/ 3/\n";
    fs::write(place.path().join("a.obj"), text).unwrap();
    let read = document(place.path(), "a.obj");
    // The dent takes three triangles.
    let kinds: Vec<_> = read.shapes.iter().map(|s| (s.body.name(), s.line)).collect();
    let triangle = "triangle";
    assert_eq!(kinds, [(triangle, 7), (triangle, 7), (triangle, 7), (triangle, 9), (triangle, 14)]);
    let area: f64 = read.shapes[..3]
        .iter()
        .map(|s| {
            let Body::Triangle { corners: [a, b, c] } = s.body else { panic!() };
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
        })
        .sum();
    assert!((area - 2.5).abs() < 1e-12, "{area}");
    let warnings = warned(&read);
    assert!(warnings.contains("11: 1 faces without area skipped"), "{warnings}");
    assert!(warnings.contains("12: points and lines aren't"), "{warnings}");

    let text = "v 0 0 0\nv 2 0 0\nv 2 2 0\nvn 1 0 1\nf 1//1 2//1 3\n";
    fs::write(place.path().join("a.obj"), text).unwrap();
    let read = document(place.path(), "a.obj");
    assert!(matches!(read.shapes[0].body, Body::Triangle { .. }));
    assert!(warned(&read).contains("5: 1 faces have normals at some corners alone"));
}

#[test]
fn smoothing_groups_make_normals() {
    let place = tempfile::tempdir().unwrap();
    // A roof: smooth over the ridge in group 1, a flat wall outside.
    let text = "v 0 0 0\nv 0 0 1\nv 1 1 0\nv 1 1 1\nv 2 0 0\nv 2 0 1\n\
                s 1\nf 1 2 4 3\nf 3 4 6 5\ns off\nf 1 3 5\n";
    fs::write(place.path().join("a.obj"), text).unwrap();
    let read = document(place.path(), "a.obj");
    assert_eq!(read.shapes.len(), 5);
    let Body::SmoothTriangle { corners, normals } = read.shapes[0].body else { panic!() };
    for (corner, normal) in corners.into_iter().zip(normals) {
        let ridge = corner[0] == 1.0;
        assert_eq!(normal[0].abs() < 1e-12, ridge, "{corner:?} {normal:?}");
    }
    assert!(matches!(read.shapes[4].body, Body::Triangle { .. }));
}

fn material(text: &str) -> (Material, String) {
    let place = tempfile::tempdir().unwrap();
    let mesh = "mtllib my own.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    fs::write(place.path().join("a.obj"), mesh).unwrap();
    fs::write(place.path().join("my own.mtl"), format!("newmtl a\n{text}")).unwrap();
    let read = document(place.path(), "a.obj");
    (read.materials[read.shapes[0].material].clone(), warned(&read))
}

#[test]
fn materials_by_their_illumination() {
    let base = "Kd 0.5 0.4 0.3\nKs 0.2 0.3 0.4\nNs 20\nNi 1.5\n";
    let none = [0.0; 3];
    let (plain, _) = material(&format!("{base}illum 1\n"));
    assert_eq!((plain.diffuse, plain.specular), ([0.5, 0.4, 0.3], none));
    let (shiny, _) = material(&format!("{base}illum 2\n"));
    assert_eq!((shiny.specular, shiny.shininess, shiny.reflection), ([0.2, 0.3, 0.4], 20.0, none));
    let (mirror, _) = material(&format!("{base}illum 3\nd 1\n"));
    assert_eq!((mirror.reflection, mirror.transmission), ([0.2, 0.3, 0.4], none));
    let (glass, warnings) =
        material(&format!("{base}Ke 1 2 0\nillum 7\nTf 0.9 0.8 0.7\nmap_Ks a.png\n"));
    assert_eq!(glass.emission, [1.0, 2.0, 0.0]);
    assert_eq!((glass.transmission, glass.index_behind), ([0.9, 0.8, 0.7], 1.5));
    assert_eq!(glass.shadow, ShadowThrough::Filtered);
    assert!(warnings.contains("1: my own.mtl:9: maps other than map_Kd (map_"), "{warnings}");
    assert!(warnings.contains("my own.mtl:1: material \"a\": illum 5 and 7 weigh"), "{warnings}");
    let (dark, _) = material(&format!("{base}illum 4\nd 0.25\nTf 0.9 0.8 0.4\n"));
    assert_eq!((dark.reflection, dark.diffuse), ([0.2, 0.3, 0.4], [0.125, 0.1, 0.075]));
    assert!((dark.transmission[2] - 0.3).abs() < 1e-12 && dark.index_behind == 1.5);
    let (clear, warnings) = material(&format!("{base}illum 6\n"));
    assert_eq!((clear.transmission, clear.reflection), ([1.0; 3], [0.2, 0.3, 0.4]));
    assert!(!warnings.contains("material \"a\""), "{warnings}");
    let (mirror, warnings) = material(&format!("{base}illum 5\n"));
    assert_eq!((mirror.reflection, mirror.transmission), ([0.2, 0.3, 0.4], none));
    assert!(warnings.contains("illum 5 and 7 weigh mirrors by angle"), "{warnings}");
    let (flat, warnings) = material(&format!("{base}Ka 0.1 0.2 0.3\nillum 0\n"));
    assert_eq!((flat.ambient, flat.specular, flat.reflection), ([0.1, 0.2, 0.3], none, none));
    assert!(warnings.contains("illum 0 is lit here as illum 1 is"), "{warnings}");
    let (thin, warnings) = material(&format!("{base}d -halo 0.5\n"));
    assert_eq!(thin.transmission, [0.5; 3]);
    assert!(warnings.contains("d -halo thins towards the middle"), "{warnings}");
    let (veil, _) = material(&format!("{base}Tr 0.75\n"));
    assert_eq!((veil.transmission, veil.diffuse), ([0.75; 3], [0.125, 0.1, 0.075]));
}

/// A picture of two by two pixels: red, green above; blue, white below.
fn four_colors(file: &Path) {
    let mut encoder = png::Encoder::new(fs::File::create(file).unwrap(), 2, 2);
    encoder.set_color(png::ColorType::Rgb);
    let pixels = [255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255];
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
}

#[test]
fn a_map_is_shown_where_the_mesh_says() {
    let place = tempfile::tempdir().unwrap();
    four_colors(&place.path().join("my map.png"));
    fs::write(place.path().join("a.mtl"), "newmtl a\nmap_Kd my map.png\n").unwrap();
    // A square of five by five whose picture is repeated: 3.0 to 4.0.
    let mesh = "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 5 0 0\nv 5 5 0\nv 0 5 0\n\
                vt 3 -7\nvt 4 -7\nvt 4 -6\nvt 3 -6 0\nf 1/1 2/2 3/3 4/4\n";
    fs::write(place.path().join("a.obj"), mesh).unwrap();
    let read = document(place.path(), "a.obj");
    assert_eq!(read.shapes.len(), 2, "polygons have no coordinates, triangles have");
    assert_eq!(read.shapes[0].uv, Some([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]));
    let scene = "ambient = 1\n[camera]\neye = [2.5, 2.5, 9]\nlook_at = [2.5, 2.5, 0]\nangle = 30\n\
                 [[mesh]]\nfile = \"a.obj\"\n";
    fs::write(place.path().join("scene.toml"), scene).unwrap();
    let output = whitted(
        place.path(),
        &["-q", "render", "scene.toml", "--size", "8x8", "--sampling", "center", "-o", "a.png"],
    );
    assert_eq!(errors(&output), "");
    let file = std::io::BufReader::new(fs::File::open(place.path().join("a.png")).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    let largest = |x: usize, y: usize| {
        let rgb = &bytes[3 * (8 * y + x)..][..3];
        (0..3).map(|i| rgb[i] > 128).collect::<Vec<_>>()
    };
    assert_eq!(largest(1, 1), [true, false, false]);
    assert_eq!(largest(6, 1), [false, true, false]);
    assert_eq!(largest(1, 6), [false, false, true]);
    assert_eq!(largest(6, 6), [true, true, true]);

    let wrong = mesh.replace("f 1/1 2/2 3/3 4/4", "f 1 2 3");
    fs::write(place.path().join("a.obj"), wrong).unwrap();
    fs::remove_file(place.path().join("my map.png")).unwrap();
    let read = document(place.path(), "a.obj");
    assert!(warned(&read).contains("1: a.mtl:2: map_Kd \"my map.png\": can't be read"));
    assert!(read.materials[0].texture.is_none());
}

/// The Utah teapot's triangles from the databases, as another program would write them.
#[test]
fn the_teapot_as_a_mesh() {
    let Some(spd) = common::spd() else { return };
    let teapot = read::read(&spd.join("teapot_s12.nff")).unwrap();
    let (mut positions, mut faces, mut count) = (String::new(), String::new(), 0);
    for shape in &teapot.shapes {
        let Body::SmoothTriangle { corners, normals } = &shape.body else { continue };
        for ([x, y, z], [i, j, k]) in corners.iter().zip(normals) {
            let _ = writeln!(positions, "v {x} {y} {z}\nvn {i} {j} {k}");
        }
        let [a, b, c] = [count + 1, count + 2, count + 3];
        let _ = writeln!(faces, "f {a}//{a} {b}//{b} {c}//{c}");
        count += 3;
    }
    assert!(count > 3 * 8000, "{count}");
    let place = tempfile::tempdir().unwrap();
    fs::write(place.path().join("teapot.obj"), positions + &faces).unwrap();
    let read = document(place.path(), "teapot.obj");
    assert_eq!(read.shapes.len(), count / 3);
    let output = whitted(place.path(), &["bake", "teapot.obj"]);
    assert!(output.status.success(), "{}", errors(&output));
    let output = whitted(place.path(), &["-q", "render", "teapot.obj", "--size", "96x96"]);
    assert!(output.status.success(), "{}", errors(&output));
}

#[test]
fn what_is_wrong_in_the_material_library_is_said_of_it() {
    let place = tempfile::tempdir().unwrap();
    let mesh = "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    fs::write(place.path().join("a.obj"), mesh).unwrap();
    let output = whitted(place.path(), &["check", "a.obj"]);
    assert!(
        errors(&output).contains("a.obj:1: warning: material library \"a.mtl\": can't be read")
    );
    assert!(said(&output).contains("1 (1 triangle)"));
    for (text, says) in [
        ("Kd 1 1 1\n", "a.mtl:1: a material (newmtl name) before this line is missing"),
        ("newmtl a\nKd 1 1\n", "a.mtl:2: a number or name (Kd blue) on this line is missing"),
        ("newmtl a\nKd 1 1 -1\n", "a.mtl:2: Kd blue -1 is out of range: it must be 0 to 15.9"),
        ("newmtl a\nd 2\n", "a.mtl:2: d 2 is out of range: it must be 0 to 1"),
        ("newmtl a\nillum 4\nNi 9\n", "a.mtl:3: Ni 9 is out of range: it must be 0.25 to 4"),
        ("newmtl a\nillum 2.5\n", "a.mtl:2: illum 2.5 is out of range: it must be a whole"),
        ("newmtl a\nKa spectral x.rfl\n", "a.mtl:2: found \"spectral\"; red green blue"),
        ("newmtl a\nshine 3\n", "a.mtl:2: unknown word \"shine\"; known: newmtl, Ka"),
        ("newmtl a\nnewmtl a\n", "a.mtl:2: a second material \"a\"; the first is at line 1"),
    ] {
        fs::write(place.path().join("a.mtl"), text).unwrap();
        let output = whitted(place.path(), &["check", "a.obj"]);
        assert!(errors(&output).contains(says), "{text}: {}", errors(&output));
        assert_eq!(output.status.code(), Some(2));
    }
}

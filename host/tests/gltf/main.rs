//! glTF 2.0: files that the tests write, right and wrong.

mod accessor;
#[path = "../common/mod.rs"]
mod common;
mod file;
mod picture;
mod wrong;

use std::fs;
use std::path::Path;

use common::{errors, whitted};
use file::{bytes, document, glb, text};
use serde_json::json;
use whitted_host::document::{Body, LightKind};
use whitted_host::read::{self, Format};

#[test]
fn two_nodes_and_a_camera() {
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("two.glb");
    fs::write(&file, glb(&text(), &bytes())).unwrap();
    let read = document(&file);
    assert_eq!(read.warnings, []);
    let name = |i: usize| read.materials[read.shapes[i].material].name.as_str();
    assert_eq!([0, 1, 2, 3].map(name), ["clay", "clay", "lamp", "lamp"]);
    assert_eq!(read.shapes.len(), 4);
    let Body::SmoothTriangle { corners, .. } = read.shapes[0].body else { panic!() };
    assert_eq!(corners, [[-2.0, -2.0, -1.0], [2.0, -2.0, -1.0], [2.0, 2.0, -1.0]]);
    // Within the first: 2·0.25 of a square, 2·0.5 before it. It is mirrored, and yet faces the eye.
    for shape in &read.shapes[2..] {
        let Body::Triangle { corners: [a, b, c] } = shape.body else { panic!() };
        assert!([a, b, c].iter().all(|p| p[2] == 0.0 && p[0].abs() == 0.5 && p[1].abs() == 0.5));
        assert!((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0);
    }
    assert_eq!((read.camera.eye, read.camera.look_at), ([0.0, 0.0, 6.0], [0.0, 0.0, 5.0]));
    assert!((read.camera.angle - 0.8f64.to_degrees()).abs() < 1e-5);
    assert!(matches!(read.lights[0].kind, LightKind::Point { position: [1.0, 2.0, 4.0], .. }));
    assert!((read.lights[0].color[0] - 60.0 / std::f64::consts::PI).abs() < 1e-4);
    let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6);
    let [clay, lamp] = &read.materials[..] else { panic!() };
    // Roughness 1/2: (2·16 − 2)/4; 0.04·(7.5 + 2)/2.
    assert!(near(clay.diffuse, [0.8, 0.3, 0.1]) && near(clay.specular, [0.19; 3]));
    assert!((clay.shininess - 7.5).abs() < 1e-6 && near(clay.reflection, [0.0; 3]));
    // Metal without roughness mirrors its colour.
    assert!(near(lamp.reflection, [0.5, 0.6, 0.7]) && near(lamp.diffuse, [0.0; 3]));
    assert!(near(lamp.emission, [0.2, 0.3, 0.4]));

    for arguments in
        [&["bake", "two.glb"][..], &["-q", "render", "two.glb", "--size", "64x48", "-o", "two.png"]]
    {
        let output = whitted(place.path(), arguments);
        assert!(output.status.success(), "{}", errors(&output));
    }
    if let Some(out) = std::env::var_os("WHITTED_TEST_PICTURES") {
        fs::copy(place.path().join("two.png"), Path::new(&out).join("gltf.png")).unwrap();
    }
}

#[test]
fn a_text_with_its_buffer_beside_it_and_within_a_scene() {
    let place = tempfile::tempdir().unwrap();
    let mut text = text();
    text["buffers"][0]["uri"] = "a%20buffer.bin".into();
    fs::write(place.path().join("a buffer.bin"), bytes()).unwrap();
    fs::write(place.path().join("two.gltf"), text.to_string()).unwrap();
    fs::write(place.path().join("two.glb"), glb(&self::text(), &bytes())).unwrap();
    let alone = document(&place.path().join("two.gltf"));
    assert_eq!(alone, document(&place.path().join("two.glb")));
    let scene = "[camera]\neye = [0, 0, 9]\nlook_at = [0, 0, 0]\n\
                 [[mesh]]\nfile = \"two.glb\"\nmove = [0, 5, 0]\n";
    fs::write(place.path().join("scene.toml"), scene).unwrap();
    let placed = document(&place.path().join("scene.toml"));
    assert_eq!((placed.shapes.len(), placed.lights.len()), (4, 1));
    assert_eq!(placed.camera.eye, [0.0, 0.0, 9.0]);
    assert!(placed.shapes[0].body.bounds().unwrap().low[1] >= 3.0);
}

#[test]
fn what_the_model_lacks_is_said() {
    let mut text = text();
    text["cameras"][0] = json!({ "type": "orthographic",
        "orthographic": { "xmag": 1, "ymag": 1, "zfar": 9, "znear": 1 } });
    text["meshes"][1]["primitives"][0]["mode"] = 1.into();
    text["extensionsUsed"] = json!(["KHR_lights_punctual", "KHR_materials_clearcoat"]);
    text["materials"][0]["normalTexture"] = json!({ "index": 0 });
    let read = read::parse(Format::Gltf, &glb(&text, &bytes())).unwrap_or_else(|_| panic!());
    let said: String = read.warnings.iter().map(|w| format!("{}\n", w.text)).collect();
    for what in [
        "orthographic cameras aren't in the model: 1 left out (the first: cameras[0])",
        "points and lines aren't in the model: 1 left out (the first: meshes[1].primitives[0])",
        "textures other than the base colour's aren't in the model: 1 left out (the first: materials[0])",
        "things of the extension KHR_materials_clearcoat aren't",
        "no camera: seen from",
    ] {
        assert!(said.contains(what), "{what} isn't in:\n{said}");
    }
}

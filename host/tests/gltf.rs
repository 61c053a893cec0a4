//! glTF 2.0: files that the tests write, right and wrong.

mod common;

use std::fs;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use common::{errors, whitted};
use serde_json::{Value, json};
use whitted_host::document::{Body, Document, LightKind};
use whitted_host::read::{self, Format};

/// A square's corners and normals, the indices of its two triangles, and those of a strip.
fn bytes() -> Vec<u8> {
    let positions = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0f32, 1.0, 0.0]];
    let normals = [[-0.6, 0.0, 0.8], [0.6, 0.0, 0.8], [0.6, 0.0, 0.8], [-0.6f32, 0.0, 0.8]];
    let floats = positions.iter().chain(&normals).flatten();
    let mut bytes: Vec<u8> = floats.flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    bytes.extend([1u8, 2, 0, 3]);
    bytes
}

/// Two nodes with meshes, one in the other, a camera and a light.
fn text() -> Value {
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0, 2, 3] }],
        "nodes": [
            { "mesh": 0, "children": [1], "translation": [0, 0, -1], "scale": [2, 2, 2] },
            { "mesh": 1, "scale": [-0.25, 0.25, 1], "translation": [0, 0, 0.5] },
            { "camera": 0, "translation": [0, 0, 6] },
            { "translation": [1, 2, 4], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        ],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": {
            "lights": [{ "type": "point", "intensity": 60, "color": [1, 1, 0.9] }],
        } },
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.8, "znear": 0.1 } }],
        "materials": [
            { "name": "clay", "pbrMetallicRoughness": {
                "baseColorFactor": [0.8, 0.3, 0.1, 1], "metallicFactor": 0, "roughnessFactor": 0.5,
            } },
            { "name": "lamp", "emissiveFactor": [0.2, 0.3, 0.4], "pbrMetallicRoughness": {
                "baseColorFactor": [0.5, 0.6, 0.7, 1], "roughnessFactor": 0,
            } },
        ],
        "meshes": [
            { "primitives": [{
                "attributes": { "POSITION": 0, "NORMAL": 1 }, "indices": 2, "material": 0,
            }] },
            { "primitives": [{
                "attributes": { "POSITION": 0 }, "indices": 3, "mode": 5, "material": 1,
            }] },
        ],
        "buffers": [{ "byteLength": 112 }],
        "bufferViews": [
            { "buffer": 0, "byteLength": 96, "byteStride": 12 },
            { "buffer": 0, "byteOffset": 96, "byteLength": 16 },
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" },
            { "bufferView": 1, "byteOffset": 12, "componentType": 5121, "count": 4,
              "type": "SCALAR" },
        ],
    })
}

fn glb(text: &Value, bytes: &[u8]) -> Vec<u8> {
    let mut text = text.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut file = b"glTF\x02\0\0\0".to_vec();
    let word = |n: usize| (n as u32).to_le_bytes();
    file.extend(word(12 + 8 + text.len() + 8 + bytes.len()));
    file.extend(word(text.len()));
    file.extend(b"JSON");
    file.extend(text);
    file.extend(word(bytes.len()));
    file.extend(b"BIN\0");
    file.extend(bytes);
    file
}

fn document(file: &Path) -> Document {
    read::read(file).unwrap_or_else(|error| panic!("{error}"))
}

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

/// The square with a picture on it, whose bytes lie behind the others.
fn pictured(picture: &[u8]) -> (Value, Vec<u8>) {
    let (mut text, mut bytes) = (text(), bytes());
    // The upper left quarter of the picture, twice as large, to the right of the square's middle.
    let uvs = [[-1.0, 1.0], [1.0, 1.0], [1.0, 0.0], [-1.0f32, 0.0]];
    bytes.extend(uvs.iter().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend(picture);
    text["buffers"][0]["byteLength"] = bytes.len().into();
    let views = text["bufferViews"].as_array_mut().unwrap();
    views.push(json!({ "buffer": 0, "byteOffset": 112, "byteLength": 32 }));
    views.push(json!({ "buffer": 0, "byteOffset": 144, "byteLength": picture.len() }));
    let accessors = text["accessors"].as_array_mut().unwrap();
    accessors.push(json!({ "bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2" }));
    text["images"] = json!([{ "bufferView": 3, "mimeType": "image/png" }]);
    text["samplers"] = json!([{ "magFilter": 9728 }]);
    text["textures"] = json!([{ "source": 0, "sampler": 0 }]);
    text["materials"][0]["pbrMetallicRoughness"] =
        json!({ "metallicFactor": 0, "baseColorTexture": { "index": 0, "texCoord": 0 } });
    text["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 4.into();
    // Nothing before the square.
    text["scenes"][0]["nodes"] = json!([0, 2, 3]);
    text["nodes"][0].as_object_mut().unwrap().remove("children");
    (text, bytes)
}

/// Four quarters, 8×8 pixels each: red, green; blue, white.
const QUARTERS: [[u8; 3]; 4] = [[224, 32, 32], [32, 192, 64], [32, 64, 224], [240, 240, 240]];

fn png(side: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, side, side);
    encoder.set_color(png::ColorType::Rgb);
    let quarter =
        |at: u32| QUARTERS[(at % side / (side / 2) + at / side / (side / 2) * 2) as usize];
    let pixels: Vec<u8> = (0..side * side).flat_map(quarter).collect();
    encoder.write_header().unwrap().write_image_data(&pixels).unwrap();
    bytes
}

#[test]
fn a_picture_on_a_mesh() {
    let place = tempfile::tempdir().unwrap();
    let (text, bytes) = pictured(&png(16));
    let file = place.path().join("pictured.glb");
    fs::write(&file, glb(&text, &bytes)).unwrap();
    let read = document(&file);
    assert_eq!(read.warnings, []);
    // v goes down there and up here; whole pictures to the side are the same.
    let first = read.shapes[0].uv.unwrap();
    assert_eq!(first, [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]]);
    let texture = read.materials[0].texture.as_ref().unwrap();
    let whitted::scene::Pattern::Image(image) = texture.spec.pattern else { panic!() };
    assert_eq!(image.size(), (16, 16));

    // Seen: the picture twice in a row.
    let arguments = ["-q", "render", "pictured.glb", "--size", "96x72", "-o", "p.png"];
    let output = whitted(place.path(), &arguments);
    assert!(output.status.success(), "{}", errors(&output));
    let shown = common::pixels(&place.path().join("p.png"));
    let at = |x: usize, y: usize| <[u8; 3]>::try_from(&shown[(y * 96 + x) * 3..][..3]).unwrap();
    let strongest = |c: [u8; 3]| (0..3).max_by_key(|&i| c[i]).unwrap();
    for (x, y, channel) in
        [(30, 26, 0), (42, 26, 1), (54, 26, 0), (66, 26, 1), (30, 46, 2), (54, 46, 2)]
    {
        assert_eq!(strongest(at(x, y)), channel, "{:?} at {x} {y}", at(x, y));
    }
    if let Some(out) = std::env::var_os("WHITTED_TEST_PICTURES") {
        fs::copy(place.path().join("p.png"), Path::new(&out).join("gltf-picture.png")).unwrap();
    }

    // A file beside it, as JPEG; and a picture within the text, too large for a chip.
    let mut other = text.clone();
    other["images"][0] = json!({ "uri": "a%20b.jpg" });
    fs::write(place.path().join("a b.jpg"), include_bytes!("data/quarters.jpg")).unwrap();
    fs::write(&file, glb(&other, &bytes)).unwrap();
    let read = document(&file);
    assert_eq!(read.warnings, []);
    let texture = read.materials[0].texture.as_ref().unwrap();
    assert_eq!(texture.file.as_deref(), Some(&*place.path().join("a b.jpg")));
    other["images"][0] =
        json!({ "uri": format!("data:image/png;base64,{}", STANDARD.encode(png(600))) });
    fs::write(&file, glb(&other, &bytes)).unwrap();
    let read = document(&file);
    let said = &read.warnings[0].text;
    assert_eq!(said, "images[0]: 600×600 pixels, reduced to 200×200");
}

#[test]
fn pictures_that_arent() {
    let said = |text: &Value, bytes: &[u8]| match read::parse(Format::Gltf, &glb(text, bytes)) {
        Ok(read) => read.warnings.iter().map(|w| format!("{}\n", w.text)).collect(),
        Err(flaw) => flaw.problem.to_string(),
    };
    let (text, bytes) = pictured(&png(16));
    let alone = "the material's colour alone instead";
    let changed = |place: &str, value: Value| {
        let mut text = text.clone();
        *text.pointer_mut(place).unwrap() = value;
        text
    };
    let (unreadable, garbage) = pictured(b"\x89PNG no");
    for (text, bytes, wanted) in [
        (unreadable, &garbage, "images[0]: is no picture in PNG or JPEG"),
        (changed("/images/0", json!({ "uri": "no.png" })), &bytes, "images[0]: a text that"),
        (changed("/images/0", json!({})), &bytes, "images[0].uri or bufferView is missing"),
        (changed("/images/0/bufferView", 9.into()), &bytes, "images[0].bufferView 9 is out"),
        (changed("/textures/0/source", 7.into()), &bytes, "textures[0] 7 is out of range"),
        (changed("/textures/0/sampler", 7.into()), &bytes, "textures[0] 7 is out of range"),
        (changed("/samplers/0", json!({ "wrapS": 33648 })), &bytes, "repeated mirrored"),
        (changed("/accessors/4/count", 3.into()), &bytes, "TEXCOORD_0 count 3"),
        (
            changed("/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord", 3.into()),
            &bytes,
            "2 faces with a map have no texture coordinates",
        ),
    ] {
        let said: String = said(&text, bytes);
        assert!(said.contains(wanted), "{wanted} isn't in {said}");
        if wanted.starts_with("images[0]: ") {
            assert!(said.contains(alone), "{said}");
        }
    }
    // Whatever bytes a picture has.
    let jpeg = include_bytes!("data/quarters.jpg");
    for end in (0..jpeg.len()).step_by(7) {
        let (text, bytes) = pictured(&jpeg[..end]);
        let _: String = said(&text, &bytes);
        let mut changed = jpeg.to_vec();
        changed[end] ^= 0x55;
        let (text, bytes) = pictured(&changed);
        let _: String = said(&text, &bytes);
    }
}

#[test]
fn sparse_accessors() {
    let mut text = text();
    // The third corner higher; and, of an accessor without a view, zeros but for two.
    let mut bytes = bytes();
    bytes.extend([2, 0, 0, 3]);
    bytes.extend([1.0, 5.0, 0.0, 7.0, 8.0, 9.0f32].iter().flat_map(|x| x.to_le_bytes()));
    text["buffers"][0]["byteLength"] = bytes.len().into();
    let views = text["bufferViews"].as_array_mut().unwrap();
    views.push(json!({ "buffer": 0, "byteOffset": 112, "byteLength": 4 }));
    views.push(json!({ "buffer": 0, "byteOffset": 116, "byteLength": 24 }));
    let sparse = |count: u32, index: u32| {
        json!({ "count": count,
            "indices": { "bufferView": 2, "byteOffset": index, "componentType": 5121 },
            "values": { "bufferView": 3, "byteOffset": 0 } })
    };
    text["accessors"][0]["sparse"] = sparse(1, 0);
    let parse = |text: &Value| read::parse(Format::Gltf, &glb(text, &bytes));
    let read = parse(&text).unwrap_or_else(|flaw| panic!("{}", flaw.problem));
    let Body::SmoothTriangle { corners, .. } = read.shapes[0].body else { panic!() };
    // Scaled by two, and moved.
    assert_eq!(corners, [[-2.0, -2.0, -1.0], [2.0, -2.0, -1.0], [2.0, 10.0, -1.0]]);

    let positions = &mut text["accessors"][0];
    positions.as_object_mut().unwrap().remove("bufferView");
    positions["sparse"] = sparse(2, 2);
    let read = parse(&text).unwrap_or_else(|flaw| panic!("{}", flaw.problem));
    // (1, 5, 0), 0, 0, (7, 8, 9) along the first triangle's fan: 0 1 2 and 0 2 3.
    let Body::SmoothTriangle { corners, .. } = read.shapes[0].body else { panic!() };
    assert_eq!(corners, [[2.0, 10.0, -1.0], [0.0, 0.0, -1.0], [14.0, 16.0, 17.0]]);

    for (change, value, wanted) in [
        ("/accessors/0/sparse/count", json!(3), "accessors[0].sparse.indices.count 3 is out"),
        ("/accessors/0/sparse/count", json!(9), "accessors[0].sparse.indices.count 9 is out"),
        ("/accessors/0/sparse/indices/bufferView", json!(9), "indices.bufferView 9 is out of"),
        ("/accessors/0/sparse/indices/componentType", json!(5126), "indices of an unknown type"),
        ("/accessors/0/count", json!(3), "accessors[0].sparse.indices 3 is out of range"),
        ("/accessors/0/count", json!(5_000_000), "number of elements of all accessors"),
    ] {
        let mut text = text.clone();
        *text.pointer_mut(change).unwrap() = value;
        let Err(flaw) = parse(&text) else { panic!("{change}") };
        assert!(flaw.problem.to_string().contains(wanted), "{wanted} isn't in {}", flaw.problem);
    }
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

/// A place in the file, what stands there, and what the error says.
fn wrong() -> Vec<(&'static str, Value, &'static str)> {
    let triangles = 4_000_000_000u32;
    vec![
        (
            "/accessors/0/count",
            json!(triangles),
            "accessors[0].count 4000000000 is out of range: it must be at most 8: bufferViews[0] ends there",
        ),
        (
            "/accessors/1/count",
            json!(5),
            "accessors[1].count 5 is out of range: it must be at most 4",
        ),
        (
            "/accessors/1/byteOffset",
            json!(u64::MAX),
            "accessors[1].count 4 is out of range: it must be at most 0",
        ),
        (
            "/accessors/0/bufferView",
            json!(7),
            "accessors[0].bufferView 7 is out of range: it must be below 2, the number of bufferViews",
        ),
        ("/accessors/0/type", json!("VEC2"), "found accessors[0].type Vec2; Vec3 should be here"),
        ("/accessors/0/componentType", json!(5124), "found accessors[0] of an unknown type"),
        ("/accessors/2/componentType", json!(5122), "indices of I16; unsigned whole numbers"),
        (
            "/bufferViews/0/byteLength",
            json!(113),
            "bufferViews[0]: byteOffset + byteLength 113 is out of range: it must be within the 112 bytes",
        ),
        (
            "/bufferViews/0/byteOffset",
            json!(u64::MAX),
            "bufferViews[0]: byteOffset + byteLength 1844674",
        ),
        (
            "/bufferViews/0/byteStride",
            json!(0),
            "bufferViews[0].byteStride 0 is out of range: it must be 12 to 252",
        ),
        (
            "/bufferViews/0/buffer",
            json!(3),
            "bufferViews[0].buffer 3 is out of range: it must be below 1",
        ),
        (
            "/buffers/0/byteLength",
            json!(113),
            "buffers[0].byteLength 113 is out of range: it must be at most 112",
        ),
        (
            "/buffers/0/uri",
            json!("data:x,y"),
            "found buffers[0].uri \"data:x,y\"; data:application",
        ),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(99),
            "meshes[0].primitives[0].attributes.POSITION 99 is out of range: it must be below 4",
        ),
        (
            "/meshes/0/primitives/0/attributes/NORMAL",
            json!(2),
            "found accessors[2].type Scalar; Vec3",
        ),
        ("/meshes/0/primitives/0/indices", json!(0), "found accessors[0].type Vec3; Scalar"),
        (
            "/meshes/0/primitives/0/material",
            json!(2),
            "meshes[0].primitives[0].material 2 is out of range",
        ),
        (
            "/meshes/0/primitives/0/mode",
            json!(9),
            "found meshes[0].primitives[0].mode of another kind; 0 to 6",
        ),
        (
            "/nodes/0/mesh",
            json!(5),
            "nodes[0].mesh 5 is out of range: it must be below 2, the number of meshes",
        ),
        ("/nodes/0/children/0", json!(0), "nodes[0].children: nodes[0] is there a second time"),
        (
            "/nodes/0/children/0",
            json!(9),
            "nodes[0].children 9 is out of range: it must be below 4",
        ),
        ("/nodes/0/scale", json!([1e30, 1, 1]), "nodes[0]: it lies beyond"),
        (
            "/nodes/0/rotation",
            json!([0, 0, 0, 0]),
            "nodes[0].rotation's length 0 is out of range: it must be 1",
        ),
        ("/nodes/2/camera", json!(1), "nodes[2].camera 1 is out of range: it must be below 1"),
        (
            "/cameras/0/perspective/yfov",
            json!(3.5),
            "cameras[0].perspective.yfov 3.5 is out of range",
        ),
        (
            "/materials/0/pbrMetallicRoughness/metallicFactor",
            json!(-1),
            "materials[0].pbrMetallicRoughness.metallicFactor -1 is out of range: it must be 0 to 1",
        ),
        (
            "/extensions/KHR_lights_punctual/lights/0/intensity",
            json!(-2),
            "KHR_lights_punctual.lights[0].intensity -2 is out of range",
        ),
        (
            "/extensions/KHR_lights_punctual/lights/0/type",
            json!("sun"),
            "KHR_lights_punctual.lights[0].type of another kind; point, directional or spot",
        ),
        (
            "/extensions/KHR_lights_punctual/lights",
            json!([]),
            "nodes[3] light 0 is out of range: it must be below 0, the number of lights",
        ),
        ("/scene", json!(1), "scene 1 is out of range: it must be below 1, the number of scenes"),
        (
            "/scenes/0/nodes",
            json!([]),
            "a triangle with an area (in a mesh of a node of the scene) is missing",
        ),
        ("/asset/version", json!("1.0"), "found asset.version \"1.0\"; \"2.0\" should be here"),
        (
            "/extensionsRequired",
            json!(["KHR_draco_mesh_compression"]),
            "unknown required extension \"KHR_draco_mesh_compression\"; known: KHR_lights",
        ),
        ("/nodes", json!(1), "is no glTF: invalid type: integer"),
    ]
}

#[test]
fn each_wrong_value_is_named() {
    let place = tempfile::tempdir().unwrap();
    let file = place.path().join("bad.glb");
    let mut failed = String::new();
    for (pointer, value, says) in wrong() {
        let mut text = text();
        match text.pointer_mut(pointer) {
            Some(there) => *there = value.clone(),
            None => {
                let (parent, key) = pointer.rsplit_once('/').unwrap();
                text.pointer_mut(parent).unwrap()[key] = value.clone();
            }
        }
        fs::write(&file, glb(&text, &bytes())).unwrap();
        let error = match read::read(&file) {
            Ok(_) => "nothing".to_string(),
            Err(error) => error.to_string(),
        };
        if !error.contains("bad.glb: ") || !error.contains(says) {
            failed += &format!("{pointer} {value}\nsays: {error}\nnot:  {says}\n\n");
        }
    }
    assert!(failed.is_empty(), "{failed}");
    let output = whitted(place.path(), &["check", "bad.glb"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn wrong_bytes() {
    let whole = glb(&text(), &bytes());
    // Numbers that are none, and an index beyond the corners.
    for (at, word, says) in [
        (0, f32::NAN.to_le_bytes(), "POSITION[0] x NaN is out of range: it must be finite"),
        (96, [9, 0, 0, 0], "indices[0] 9 is out of range: it must be below 4, the number of"),
    ] {
        let mut bytes = bytes();
        bytes[at..at + 4].copy_from_slice(&word);
        let Err(flaw) = read::parse(Format::Gltf, &glb(&text(), &bytes)) else { panic!() };
        assert!(flaw.problem.to_string().contains(says), "{}", flaw.problem);
    }
    // Every truncation is an error, every changed byte of the frame one or a scene: none a panic.
    for end in 0..whole.len() {
        assert!(read::parse(Format::Gltf, &whole[..end]).is_err(), "{end}");
    }
    for at in (0..24).chain(whole.len() - 130..whole.len()) {
        for change in [1, 0x80, 0xff] {
            let mut changed = whole.clone();
            changed[at] ^= change;
            let _ = read::parse(Format::Gltf, &changed);
        }
    }
}

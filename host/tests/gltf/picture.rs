//! Pictures on meshes.

use std::fs;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use whitted_host::read::{self, Format};

use super::common::{self, errors, whitted};
use super::file::{bytes, document, glb, text};

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
    fs::write(place.path().join("a b.jpg"), include_bytes!("../data/quarters.jpg")).unwrap();
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
    let jpeg = include_bytes!("../data/quarters.jpg");
    for end in (0..jpeg.len()).step_by(7) {
        let (text, bytes) = pictured(&jpeg[..end]);
        let _: String = said(&text, &bytes);
        let mut changed = jpeg.to_vec();
        changed[end] ^= 0x55;
        let (text, bytes) = pictured(&changed);
        let _: String = said(&text, &bytes);
    }
}

//! Files that are wrong.

use std::fs;

use serde_json::{Value, json};
use whitted_host::read::{self, Format};

use super::common::whitted;
use super::file::{bytes, glb, text};

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

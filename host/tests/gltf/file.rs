//! A small file of two nodes with meshes, a camera and a light, for tests to change.

use std::path::Path;

use serde_json::{Value, json};
use whitted_host::document::Document;
use whitted_host::read;

/// A square's corners and normals, the indices of its two triangles, and those of a strip.
pub(super) fn bytes() -> Vec<u8> {
    let positions = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0f32, 1.0, 0.0]];
    let normals = [[-0.6, 0.0, 0.8], [0.6, 0.0, 0.8], [0.6, 0.0, 0.8], [-0.6f32, 0.0, 0.8]];
    let floats = positions.iter().chain(&normals).flatten();
    let mut bytes: Vec<u8> = floats.flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    bytes.extend([1u8, 2, 0, 3]);
    bytes
}

/// Two nodes with meshes, one in the other, a camera and a light.
pub(super) fn text() -> Value {
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

pub(super) fn glb(text: &Value, bytes: &[u8]) -> Vec<u8> {
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

pub(super) fn document(file: &Path) -> Document {
    read::read(file).unwrap_or_else(|error| panic!("{error}"))
}

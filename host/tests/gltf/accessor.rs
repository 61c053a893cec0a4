//! Sparse accessors.

use serde_json::{Value, json};
use whitted_host::document::Body;
use whitted_host::read::{self, Format};

use super::file::{bytes, glb, text};

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

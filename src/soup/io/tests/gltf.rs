//! glTF: scenes, transforms, primitives, accessors and buffers.

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

use super::super::{Attribute, Attributes, Format, parse_in};
use super::{faces, read, refusal};
use crate::soup::SoupError;

/// The corners of a square, then the numbers 0 1 2 0 2 3 as 16-bit integers.
fn buffer() -> Vec<u8> {
    let square = [
        [0.0_f32, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let numbers = square.as_flattened().iter();
    let mut bytes: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([0_u16, 1, 2, 0, 2, 3].iter().flat_map(|v| v.to_le_bytes()));
    bytes
}

fn with_buffer(mut document: Value, buffer: &[u8]) -> Value {
    let data = STANDARD.encode(buffer);
    document["buffers"] = json!([{
        "byteLength": buffer.len(),
        "uri": format!("data:application/octet-stream;base64,{data}"),
    }]);
    document
}

fn square() -> Value {
    with_buffer(
        json!({
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
            ],
            "bufferViews": [
                {"buffer": 0, "byteLength": 48},
                {"buffer": 0, "byteOffset": 48, "byteLength": 12},
            ],
        }),
        &buffer(),
    )
}

pub(super) fn text() -> String {
    square().to_string()
}

pub(super) fn glb() -> Vec<u8> {
    let mut document = square();
    document["buffers"] = json!([{"byteLength": 60}]);
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((28 + json.len() as u32 + 60).to_le_bytes());
    bytes.extend((json.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend(60_u32.to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(buffer());
    bytes
}

/// The message about a square with this changed.
fn refused(change: impl Fn(&mut Value)) -> String {
    let mut document = square();
    change(&mut document);
    refusal(document.to_string(), Format::Gltf)
}

#[test]
fn both_containers_are_read() {
    for soup in [
        read(text(), Format::Gltf),
        read(glb(), Format::Glb),
        read(glb(), Format::Gltf),
    ] {
        assert_eq!(faces(&soup), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(soup.positions()[2], [1.0, 1.0, 0.0]);
    }
    let whole = glb();
    assert!(refusal(&whole[..whole.len() - 1], Format::Glb).contains("declares"));
    let old = text().replace("2.0", "1.0");
    assert!(refusal(old, Format::Gltf).contains("glTF 1.0"));
    let error = super::super::parse(
        b"{\n\"asset\": {\"version\": \"2.0\"},\n\"nodes\": 3}",
        Format::Gltf,
    );
    assert!(
        matches!(error, Err(SoupError::Parse { line: 3, .. })),
        "{error:?}"
    );
}

#[test]
fn every_mode_that_holds_triangles_is_read() {
    for (mode, expected) in [
        (0, vec![]),
        (3, vec![]),
        (4, vec![[0, 1, 2], [0, 2, 3]]),
        // 0 1 2, 2 1 0, then nothing of 2 0 2, and 0 2 3 turned.
        (5, vec![[0, 1, 2], [2, 1, 0], [2, 0, 3]]),
        (6, vec![[1, 2, 0], [2, 0, 0], [0, 2, 0], [2, 3, 0]]),
    ] {
        let mut document = square();
        document["meshes"][0]["primitives"][0]["mode"] = mode.into();
        let soup = read(document.to_string(), Format::Gltf);
        assert_eq!(faces(&soup), expected, "{mode}");
    }
    assert!(refused(|d| d["meshes"][0]["primitives"][0]["mode"] = 7.into()).contains("mode 7"));
    assert!(refused(|d| d["accessors"][1]["count"] = 5.into()).contains("multiple of 3"));
    let mut document = square();
    document["meshes"][0]["primitives"][0]["mode"] = 6.into();
    document["meshes"][0]["primitives"][0]["indices"] = Value::Null;
    assert_eq!(
        faces(&read(document.to_string(), Format::Gltf)),
        [[1, 2, 0], [2, 3, 0]]
    );
}

#[test]
fn transforms_are_applied_and_mirrors_turn_the_triangles() {
    let mut document = square();
    document["nodes"] = json!([
        {"children": [1, 2], "translation": [10, 0, 0], "scale": [2, 2, 2]},
        {"mesh": 0, "rotation": [0, 0, 0.5_f64.sqrt(), 0.5_f64.sqrt()]},
        {"mesh": 0, "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]},
    ]);
    let soup = read(document.to_string(), Format::Gltf);
    let expected = [
        [10.0, 0.0, 0.0],
        [10.0, 2.0, 0.0],
        [8.0, 2.0, 0.0],
        [8.0, 0.0, 0.0],
        [10.0, 0.0, 10.0],
        [8.0, 0.0, 10.0],
        [8.0, 2.0, 10.0],
        [10.0, 2.0, 10.0],
    ];
    for (found, expected) in soup.positions().iter().zip(expected) {
        for axis in 0..3 {
            assert!(
                (found[axis] - expected[axis]).abs() < 1e-12,
                "{found:?} {expected:?}"
            );
        }
    }
    assert_eq!(faces(&soup), [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]]);
}

#[test]
fn the_scene_says_which_meshes_there_are() {
    let count = |change: &dyn Fn(&mut Value)| {
        let mut document = square();
        document["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "children": [2]}, {"mesh": 0}]);
        change(&mut document);
        read(document.to_string(), Format::Gltf).polygon_count() / 2
    };
    assert_eq!(count(&|_| ()), 1);
    assert_eq!(count(&|d| d["scenes"][0]["nodes"] = json!([1])), 2);
    assert_eq!(count(&|d| d["scene"] = Value::Null), 1);
    let without = |d: &mut Value| {
        d["scene"] = Value::Null;
        d["scenes"] = json!([]);
    };
    assert_eq!(count(&without), 3);
    assert_eq!(count(&|d| d["nodes"] = json!([])), 1);
    assert_eq!(count(&|d| d["nodes"] = json!([{"name": "camera"}])), 1);
    for (nodes, message) in [
        (json!([{"mesh": 0, "children": [0]}]), "descendant"),
        (
            json!([{"mesh": 0, "children": [1]}, {"children": [0]}]),
            "descendant",
        ),
        (json!([{"mesh": 0, "children": [1, 1]}, {}]), "two parents"),
        (json!([{"mesh": 0, "children": [9]}]), "no node 9"),
        (json!([{"mesh": 9}]), "no mesh 9"),
    ] {
        assert!(
            refused(|d| d["nodes"] = nodes.clone()).contains(message),
            "{message}"
        );
    }
    assert!(refused(|d| d["scene"] = 4.into()).contains("no scene 4"));
}

#[test]
fn primitives_share_vertices_and_numbers_of_none_stay_so() {
    let mut document = square();
    let primitive = document["meshes"][0]["primitives"][0].clone();
    document["meshes"][0]["primitives"] = json!([primitive, primitive]);
    document["accessors"][0]["count"] = 3.into();
    let soup = read(document.to_string(), Format::Gltf);
    assert_eq!(soup.positions().len(), 3);
    assert_eq!(faces(&soup), [[0, 1, 2], [0, 2, -4], [0, 1, 2], [0, 2, -4]]);
}

#[test]
fn accessors_are_interleaved_sparse_normalised_and_of_all_types() {
    // Interleaved: a position every 16 bytes, from byte 4 on.
    let mut bytes = Vec::new();
    for position in [
        [0.0_f32, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ] {
        bytes.extend([9; 4]);
        bytes.extend(position.iter().flat_map(|x| x.to_le_bytes()));
    }
    bytes.extend([0, 1, 2, 0, 2, 3]);
    let mut document = square();
    document["bufferViews"] = json!([
        {"buffer": 0, "byteLength": 64, "byteStride": 16},
        {"buffer": 0, "byteOffset": 64, "byteLength": 6},
    ]);
    document["accessors"][0]["byteOffset"] = 4.into();
    document["accessors"][1]["componentType"] = 5121.into();
    let soup = read(with_buffer(document, &bytes).to_string(), Format::Gltf);
    assert_eq!(soup, read(text(), Format::Gltf));

    // Sparse, over an array and over zeros: vertex 2 is replaced by vertex 1.
    let sparse = json!({
        "count": 1,
        "indices": {"bufferView": 1, "byteOffset": 4, "componentType": 5123},
        "values": {"bufferView": 0, "byteOffset": 12},
    });
    let mut document = square();
    document["accessors"][0]["sparse"] = sparse;
    let soup = read(document.to_string(), Format::Gltf);
    assert_eq!(soup.positions()[1..3], [[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]);
    document["accessors"][0]["bufferView"] = Value::Null;
    let soup = read(document.to_string(), Format::Gltf);
    assert_eq!(
        soup.positions(),
        [[0.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [0.0; 3]]
    );
    document["accessors"][0]["count"] = 2.into();
    assert!(refusal(document.to_string(), Format::Gltf).contains("sparse index 2"));
    document["accessors"][0]["count"] = 99_999_999_999_u64.into();
    assert!(refusal(document.to_string(), Format::Gltf).contains("99999999999"));

    // Quantised, normalised or not.
    for (kind, size, one) in [
        (5120, 1, 127.0),
        (5121, 1, 255.0),
        (5122, 2, 32767.0),
        (5123, 2, 65535.0),
    ] {
        let bytes: Vec<u8> = [100, 1, 255].repeat(12);
        let mut document = square();
        document["extensionsRequired"] = json!(["KHR_mesh_quantization", "KHR_materials_unlit"]);
        document["meshes"][0]["primitives"][0]["indices"] = Value::Null;
        document["bufferViews"] = json!([{"buffer": 0, "byteLength": 36}]);
        document["accessors"][0] = json!({
            "bufferView": 0, "componentType": kind, "count": 3, "type": "VEC3", "normalized": true,
        });
        let soup = read(
            with_buffer(document.clone(), &bytes).to_string(),
            Format::Gltf,
        );
        document["accessors"][0]["normalized"] = false.into();
        let whole = read(with_buffer(document, &bytes).to_string(), Format::Gltf);
        let expected: [f64; 3] = match size {
            1 if kind == 5120 => [100.0, 1.0, -1.0],
            1 => [100.0, 1.0, 255.0],
            _ => {
                let pair = |a: u8, b: u8| u16::from_le_bytes([a, b]);
                [pair(100, 1), pair(255, 100), pair(1, 255)].map(|x| match kind {
                    5122 => f64::from(x as i16),
                    _ => f64::from(x),
                })
            }
        };
        assert_eq!(whole.positions()[0], expected, "{kind}");
        assert_eq!(
            soup.positions()[0],
            expected.map(|x| (x / one).max(-1.0)),
            "{kind}"
        );
    }
}

#[test]
fn arrays_that_lie_outside_their_buffers_are_refused() {
    let places: [(&[&str], u64); 9] = [
        (&["accessors", "0", "count"], 5),
        (&["accessors", "0", "count"], u64::MAX),
        (&["accessors", "0", "byteOffset"], 1),
        (&["accessors", "0", "byteOffset"], u64::MAX),
        (&["bufferViews", "0", "byteOffset"], 13),
        (&["bufferViews", "0", "byteLength"], u64::MAX),
        (&["bufferViews", "0", "byteLength"], 47),
        (&["bufferViews", "0", "byteStride"], 17),
        (&["buffers", "0", "byteLength"], 61),
    ];
    for (path, value) in places {
        let pointer = format!("/{}", path.join("/"));
        let mut document = square();
        let (parent, key) = pointer.rsplit_once('/').expect("a path");
        document.pointer_mut(parent).expect("a parent")[key] = value.into();
        let message = refusal(document.to_string(), Format::Gltf);
        assert!(message.contains("buffer"), "{pointer} {value}: {message}");
    }
    for (pointer, value, message) in [
        ("/accessors/0/bufferView", json!(9), "no buffer view 9"),
        ("/bufferViews/0/buffer", json!(9), "no buffer 9"),
        ("/meshes/0/primitives/0/indices", json!(9), "no accessor 9"),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(9),
            "no accessor 9",
        ),
        ("/accessors/0/type", json!("VEC2"), "VEC2"),
        ("/accessors/0/componentType", json!(5124), "5124"),
        ("/accessors/1/componentType", json!(5122), "unsigned"),
        ("/buffers/0/uri", Value::Null, "no data"),
        ("/buffers/0/uri", json!("data:;base64,???"), "base64"),
        ("/buffers/0/uri", json!("data:,abc"), "base64"),
    ] {
        let change = |d: &mut Value| *d.pointer_mut(pointer).expect("there") = value.clone();
        assert!(refused(change).contains(message), "{pointer}");
    }
    let strided = |d: &mut Value| d["bufferViews"][0]["byteStride"] = 0.into();
    assert!(refused(strided).contains("stride of 0"));
}

#[test]
fn extensions_that_change_surfaces_are_named() {
    for name in [
        "KHR_draco_mesh_compression",
        "EXT_meshopt_compression",
        "ACME_shapes",
    ] {
        let message = refused(|d| d["extensionsRequired"] = json!([name]));
        assert!(message.contains(name), "{message}");
    }
    let message = refused(|d| {
        d["meshes"][0]["primitives"][0]["extensions"] = json!({"KHR_draco_mesh_compression": {}});
        d["accessors"][0]["bufferView"] = Value::Null;
    });
    assert!(message.contains("draco"), "{message}");
    let compressed = |d: &mut Value| {
        d["bufferViews"][0]["extensions"] = json!({"EXT_meshopt_compression": {"x": 1}});
    };
    assert!(refused(compressed).contains("meshopt"));
    let instanced = |d: &mut Value| {
        d["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": {}});
    };
    assert!(refused(instanced).contains("instancing"));
    let mut document = square();
    document["extensionsUsed"] = json!(["ACME_shapes"]);
    document["extensions"] = json!({"ACME_shapes": {"a": [1, 2]}});
    document["images"] = json!([{"uri": "none.png"}]);
    document["textures"] = json!([{"source": 0}]);
    document["materials"] = json!([{"extensions": {"ACME_glow": true}}]);
    assert_eq!(
        read(document.to_string(), Format::Gltf),
        read(text(), Format::Gltf)
    );
}

#[test]
fn a_scene_that_multiplies_its_meshes_is_bounded() {
    let mut document = square();
    let count = 3_000_000;
    let view = json!([{"buffer": 0, "byteLength": 12}, {"buffer": 0, "byteLength": 12}]);
    document["bufferViews"] = view;
    document["accessors"][0] = json!({
        "componentType": 5126, "count": count, "type": "VEC3", "sparse": {
            "count": 1,
            "indices": {"bufferView": 0, "componentType": 5121},
            "values": {"bufferView": 1},
        },
    });
    document["meshes"][0]["primitives"][0]["indices"] = Value::Null;
    document["nodes"] = (0..100).map(|_| json!({"mesh": 0})).collect();
    document["scenes"][0]["nodes"] = (0..100).collect();
    assert!(refusal(document.to_string(), Format::Gltf).contains("repeats its meshes"));
}

#[test]
fn buffers_are_files_next_to_the_mesh() {
    let folder = std::env::temp_dir().join(format!("roundel-gltf-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("data")).expect("a folder");
    std::fs::write(folder.join("data/a square.bin"), buffer()).expect("writable");
    let with = |uri: &str| {
        let mut document = square();
        document["buffers"][0]["uri"] = uri.into();
        document.to_string().into_bytes()
    };
    let parsed = |uri: &str, folder: Option<&Path>| parse_in(&with(uri), Format::Gltf, folder);
    let plain = read(text(), Format::Gltf);
    for uri in ["data/a%20square.bin", "./data/a square.bin"] {
        assert_eq!(parsed(uri, Some(&folder)).as_ref(), Ok(&plain));
    }
    std::fs::write(folder.join("mesh.gltf"), with("data/a%20square.bin")).expect("writable");
    assert_eq!(
        super::super::read(folder.join("mesh.gltf")).as_ref(),
        Ok(&plain)
    );
    for uri in ["none.bin", "data"] {
        let error = parsed(uri, Some(&folder)).expect_err("no file");
        assert!(
            matches!(&error, SoupError::Io { message } if message.contains(uri)),
            "{error}"
        );
    }
    for uri in [
        "../x.bin",
        "/etc/hostname",
        "https://example.org/x.bin",
        "%2e%2e/x.bin",
    ] {
        let error = parsed(uri, Some(&folder)).expect_err("outside");
        assert!(error.to_string().contains("not in the folder"), "{error}");
    }
    let error = parsed("data/a%20square.bin", None).expect_err("no folder");
    assert!(error.to_string().contains("without a folder"), "{error}");
    std::fs::write(folder.join("data/a square.bin"), &buffer()[..59]).expect("writable");
    let error = parsed("data/a%20square.bin", Some(&folder)).expect_err("too short");
    assert!(
        error.to_string().contains("declares 60 bytes, and has 59"),
        "{error}"
    );
    std::fs::remove_dir_all(folder).expect("removable");
}

#[test]
fn triangles_have_the_material_of_their_primitive() {
    let mut document = square();
    document["materials"] = json!([{"name": "skin"}, {}, {"name": " "}]);
    let primitive = document["meshes"][0]["primitives"][0].clone();
    let with = |material: Value, mode: u32| {
        let mut primitive = primitive.clone();
        primitive["mode"] = mode.into();
        primitive["material"] = material;
        primitive
    };
    // Lines are no triangles, and a strip has three here.
    document["meshes"][0]["primitives"] = json!([
        with(2.into(), 4),
        with(0.into(), 3),
        with(Value::Null, 5),
        with(0.into(), 4)
    ]);
    let text = document.to_string();
    let soup = read(text.clone(), Format::Gltf);
    let found = Attributes::parse(text.as_bytes(), Format::Gltf, &soup).unwrap();
    let none = u32::MAX;
    let labels = [2, 2, none, none, none, 0, 0];
    assert_eq!(found.labels(Attribute::Materials), Some(&labels[..]));
    let names = ["skin", "material 1", "material 2"];
    assert_eq!(found.names(Attribute::Materials), names);
    assert!(Attributes::are_in(text.as_bytes(), Format::Gltf).unwrap());

    document["meshes"][0]["primitives"][3]["material"] = 3.into();
    let text = document.to_string();
    let error = Attributes::parse(text.as_bytes(), Format::Gltf, &soup).unwrap_err();
    assert!(error.to_string().contains("no material 3"), "{error}");

    let plain = self::text();
    assert!(!Attributes::are_in(plain.as_bytes(), Format::Gltf).unwrap());
    let soup = read(plain.clone(), Format::Gltf);
    let found = Attributes::parse(plain.as_bytes(), Format::Gltf, &soup).unwrap();
    assert_eq!(found.present().count(), 0);
}

/// Two squares: the first has texture coordinates, normals and colours, of which two corners share theirs.
fn with_arrays() -> Value {
    let mut bytes = buffer();
    let textures = [[0.0_f32, 1.0], [1.0, 1.0], [1.0, 0.25], [0.0, 1.0]];
    let normals = [[0.0_f32, 0.0, 1.0]; 4];
    let colors = [[255_u8, 0, 0, 255], [0, 51, 0, 0], [0; 4], [255; 4]];
    for x in textures.as_flattened().iter().chain(normals.as_flattened()) {
        bytes.extend(x.to_le_bytes());
    }
    bytes.extend(colors.as_flattened());
    let mut document = square();
    document["meshes"][0]["primitives"] = json!([
        {
            "attributes": {"POSITION": 0, "TEXCOORD_0": 2, "NORMAL": 3, "COLOR_0": 4},
            "indices": 1,
        },
        {"attributes": {"POSITION": 5}, "indices": 1},
    ]);
    let arrays = [
        (60, 32, 5126, "VEC2", false),
        (92, 48, 5126, "VEC3", false),
        (140, 16, 5121, "VEC4", true),
    ];
    let mut add = |list: &str, value: Value| document[list].as_array_mut().unwrap().push(value);
    for (view, (start, length, kind, shape, normalized)) in (2..).zip(arrays) {
        add(
            "bufferViews",
            json!({"buffer": 0, "byteOffset": start, "byteLength": length}),
        );
        add(
            "accessors",
            json!({
                "bufferView": view, "componentType": kind, "count": 4, "type": shape,
                "normalized": normalized,
            }),
        );
    }
    add(
        "accessors",
        json!({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}),
    );
    with_buffer(document, &bytes)
}

#[test]
fn corners_have_texture_coordinates_and_normals_and_vertices_have_colors() {
    let text = with_arrays().to_string();
    assert!(Attributes::are_in(text.as_bytes(), Format::Gltf).unwrap());
    let soup = read(text.clone(), Format::Gltf);
    assert_eq!((soup.positions().len(), soup.polygon_count()), (8, 4));
    let found = Attributes::parse(text.as_bytes(), Format::Gltf, &soup).unwrap();
    let none = u32::MAX;
    let of_first = |labels: [u32; 6]| [labels, [none; 6]].concat();
    // The corners are 0 1 2 0 2 3, and 3 has the texture coordinates of 0.
    let seams = of_first([0, 1, 2, 0, 2, 0]);
    assert_eq!(found.labels(Attribute::Seams), Some(&seams[..]));
    assert_eq!(
        found.texture_coordinates()[..3],
        [[0.0, 0.0], [1.0, 0.0], [1.0, 0.75]]
    );
    assert_eq!(
        found.labels(Attribute::Normals),
        Some(&of_first([0; 6])[..])
    );
    assert_eq!(found.labels(Attribute::Materials), None);
    let colors = found.vertex_colors().unwrap();
    assert_eq!(colors[0], [1.0, 0.0, 0.0, 1.0]);
    assert_eq!(colors[1], [0.0, 0.2, 0.0, 0.0]);
    assert!(colors[4..].as_flattened().iter().all(|x| x.is_nan()));
}

#[test]
fn colors_without_alpha_are_opaque_and_arrays_of_other_lengths_are_refused() {
    let mut document = with_arrays();
    document["accessors"][4]["type"] = "VEC3".into();
    let text = document.to_string();
    let soup = read(text.clone(), Format::Gltf);
    let found = Attributes::parse(text.as_bytes(), Format::Gltf, &soup).unwrap();
    assert_eq!(found.vertex_colors().unwrap()[0], [1.0, 0.0, 0.0, 1.0]);
    for (place, name) in [(2, "TEXCOORD_0"), (3, "NORMAL"), (4, "COLOR_0")] {
        let mut document = with_arrays();
        document["accessors"][place]["count"] = 3.into();
        let text = document.to_string();
        let error = Attributes::parse(text.as_bytes(), Format::Gltf, &soup).unwrap_err();
        let expected = format!("accessor {place}: {name} of 3 vertices, where there are 4");
        assert!(error.to_string().contains(&expected), "{error}");
    }
}

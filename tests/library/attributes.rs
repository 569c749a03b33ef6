//! Attributes of surfaces: written, and read back here and by `tobj`; from a mesh to its quads.

use std::collections::HashMap;

use roundel::mesh::attributes::{FaceNames, NO_NAME, SurfaceAttributes, VertexScalar};
use roundel::mesh::features::FeatureGraph;
use roundel::mesh::io::{Format, Polygons, encode_polygons};
use roundel::mesh::{TriangleMesh, shape};
use roundel::quad::{QuadOptions, quadrangulate};
use roundel::soup::io::{Attribute, Attributes, parse};
use roundel::soup::{PolygonSoup, RepairOptions};
use roundel::transfer::transfer_attributes;
use roundel::{Monitor, map::Sizing};

const SQUARES: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.5],
    [2.0, 0.0, 0.0],
    [3.0, 0.0, 0.25],
    [0.0, 1.0, 0.0],
    [1.0, 1.0, 0.1],
    [2.0, 1.0, 0.0],
    [3.0, 1.0, 1e-3],
];

const FACES: [&[u32]; 4] = [&[0, 1, 5, 4], &[1, 2, 6], &[1, 6, 5], &[2, 3, 7, 6]];

fn named(names: &[&str], of_face: &[u32]) -> FaceNames {
    FaceNames {
        names: names.iter().map(|&name| name.to_owned()).collect(),
        of_face: of_face.to_vec(),
    }
}

fn all() -> SurfaceAttributes {
    let third = 1.0 / 3.0;
    SurfaceAttributes {
        libraries: vec!["two words.mtl".into(), "b.mtl".into()],
        materials: Some(named(&["red", "dark blue"], &[0, 1, 1, 0])),
        groups: Some(named(&["left", "right"], &[NO_NAME, 0, 1, 1])),
        face_colors: Some(vec![
            [0.2, 0.4, 0.6, 1.0],
            [1.0; 4],
            [0.0, 0.0, 0.0, 0.4],
            [0.2, 0.4, 0.6, 1.0],
        ]),
        uv: Some(
            [
                [[0.0, 0.0], [0.5, 0.0], [0.5, 1.0], [0.0, 1.0]].as_slice(),
                &[[0.5, 0.0], [third, 0.1], [third, 0.9]],
                &[[f64::NAN; 2]; 3],
                &[[-1e-30, 1e30], [0.5, 0.0], [0.5, 1.0], [0.0, 1.0]],
            ]
            .concat(),
        ),
        vertex_colors: Some(
            (0..8)
                .map(|v| [f64::from(v) / 17.0, third, 1.0, 1.0])
                .collect(),
        ),
        scalars: vec![
            VertexScalar {
                name: "quality".into(),
                values: (0..8).map(|v| f64::from(v) / 3.0).collect(),
            },
            VertexScalar {
                name: "heat".into(),
                values: (0..8).map(|v| f64::from(v).exp()).collect(),
            },
        ],
    }
}

fn encoded(attributes: Option<&SurfaceAttributes>, format: Format) -> Vec<u8> {
    let polygons = Polygons {
        vertices: &SQUARES,
        faces: FACES.to_vec(),
        attributes,
    };
    encode_polygons(&polygons, format).unwrap()
}

fn read(bytes: &[u8], format: Format) -> (PolygonSoup, Attributes) {
    assert!(Attributes::are_in(bytes, format).unwrap());
    let soup = parse(bytes, format).unwrap();
    let read = Attributes::parse(bytes, format, &soup).unwrap();
    assert_eq!(soup.positions(), SQUARES);
    let faces: Vec<Vec<u32>> = soup
        .polygons()
        .map(|corners| corners.iter().map(|&v| v as u32).collect())
        .collect();
    assert_eq!(faces, FACES);
    (soup, read)
}

/// The name of each face.
fn names(read: &Attributes, attribute: Attribute) -> Vec<&str> {
    let labels = read.labels(attribute).unwrap();
    let name = |&label: &u32| {
        read.names(attribute)
            .get(label as usize)
            .map_or("", String::as_str)
    };
    labels.iter().map(name).collect()
}

#[test]
fn obj_is_read_back_as_it_was_written() {
    let given = all();
    let bytes = encoded(Some(&given), Format::Obj);
    let (_, read) = read(&bytes, Format::Obj);
    assert_eq!(
        names(&read, Attribute::Materials),
        ["red", "dark blue", "dark blue", "red"]
    );
    assert_eq!(
        names(&read, Attribute::Groups),
        ["", "left", "right", "right"]
    );
    assert_eq!(read.libraries(), given.libraries);
    let labels = read.labels(Attribute::Seams).unwrap();
    for (label, expected) in labels.iter().zip(given.uv.as_ref().unwrap()) {
        match expected[0].is_nan() {
            true => assert_eq!(*label, u32::MAX),
            false => assert_eq!(read.texture_coordinates()[*label as usize], *expected),
        }
    }
    assert_eq!(read.vertex_colors(), given.vertex_colors.as_deref());
}

#[test]
fn another_reader_finds_the_same_in_obj() {
    let given = all();
    let bytes = encoded(Some(&given), Format::Obj);
    let options = tobj::LoadOptions::default();
    let asked = std::cell::RefCell::new(Vec::new());
    let loaded = tobj::load_obj_buf(&mut bytes.as_slice(), &options, |path| {
        asked.borrow_mut().push(path.to_str().unwrap().to_owned());
        let material = |name: &str| tobj::Material {
            name: name.into(),
            ..Default::default()
        };
        let numbers: &[(&str, usize)] = &[("red", 0), ("dark blue", 1)];
        let numbers = numbers
            .iter()
            .map(|&(name, k)| (name.to_owned(), k))
            .collect();
        Ok((vec![material("red"), material("dark blue")], numbers))
    });
    let (models, _) = loaded.unwrap();
    assert!(
        asked.borrow().iter().any(|name| name == "b.mtl"),
        "{asked:?}"
    );
    // Parts of one material and group each, in the order of the file.
    let parts: Vec<_> = models
        .iter()
        .map(|m| (m.name.as_str(), m.mesh.material_id))
        .collect();
    let groups: Vec<_> = parts.iter().map(|part| part.0).collect();
    assert_eq!(groups[1..], ["left", "right", "right"]);
    let materials: Vec<_> = parts.iter().map(|part| part.1.map(|id| id % 2)).collect();
    assert_eq!(materials, [Some(0), Some(1), Some(1), Some(0)]);
    let uv = given.uv.unwrap();
    let mut corner = 0;
    for (model, face) in models.iter().zip(FACES) {
        let mesh = &model.mesh;
        assert_eq!(mesh.indices.len(), face.len());
        for (k, &v) in face.iter().enumerate() {
            let at = mesh.indices[k] as usize;
            assert_eq!(mesh.positions[3 * at..3 * at + 3], SQUARES[v as usize]);
            let color = &given.vertex_colors.as_ref().unwrap()[v as usize];
            assert_eq!(mesh.vertex_color[3 * at..3 * at + 3], color[..3]);
            let expected = uv[corner + k];
            // Where there are none, `tobj` makes some up.
            if !expected[0].is_nan() {
                let at = mesh.texcoord_indices[k] as usize;
                assert_eq!(mesh.texcoords[2 * at..2 * at + 2], expected);
            }
        }
        corner += face.len();
    }
}

#[test]
fn ply_is_read_back_as_it_was_written() {
    let given = all();
    let bytes = encoded(Some(&given), Format::Ply);
    let (_, read) = read(&bytes, Format::Ply);
    let scalars: Vec<_> = read.scalars().collect();
    let expected: Vec<_> = given
        .scalars
        .iter()
        .map(|s| (s.name.as_str(), s.values.as_slice()))
        .collect();
    assert_eq!(scalars, expected);
    // Colours have a byte a channel; those of the faces are whole bytes.
    for (found, given) in read
        .vertex_colors()
        .unwrap()
        .iter()
        .zip(given.vertex_colors.unwrap())
    {
        for (x, y) in found.iter().zip(given) {
            assert!((x - y).abs() <= 0.5 / 255.0 + 1e-15, "{found:?} {given:?}");
        }
    }
    let labels = read.labels(Attribute::Colors).unwrap();
    let colors: Vec<_> = labels
        .iter()
        .map(|&label| read.face_colors()[label as usize])
        .collect();
    assert_eq!(colors, given.face_colors.unwrap());
    let header = String::from_utf8_lossy(&bytes);
    for line in [
        "comment material 1 dark blue",
        "property int material_index",
        "property int group_index",
    ] {
        assert!(header.contains(line), "{line}");
    }
}

#[test]
fn attributes_do_not_change_the_geometry() {
    for format in [
        Format::Obj,
        Format::Ply,
        Format::Usda,
        Format::Off,
        Format::Stl,
        Format::Glb,
    ] {
        let plain = encoded(None, format);
        assert_eq!(
            encoded(Some(&SurfaceAttributes::default()), format),
            plain,
            "{format:?}"
        );
    }
    let without_attributes = |bytes: Vec<u8>| {
        let text = String::from_utf8(bytes).unwrap();
        let lines = text
            .lines()
            .filter(|line| line.starts_with("v ") || line.starts_with("f "));
        let words = lines.map(|line| {
            let words = line
                .split(' ')
                .take(if line.starts_with('v') { 4 } else { 9 });
            words
                .map(|word| word.split('/').next().unwrap().to_owned())
                .collect()
        });
        words.collect::<Vec<Vec<String>>>()
    };
    let plain = without_attributes(encoded(None, Format::Obj));
    assert_eq!(
        without_attributes(encoded(Some(&all()), Format::Obj)),
        plain
    );
}

#[test]
fn attributes_that_do_not_fit_are_not_written() {
    let wrong: [fn(&mut SurfaceAttributes); 6] = [
        |a| a.uv = Some(vec![[0.0; 2]; 13]),
        |a| a.scalars[0].values.truncate(7),
        |a| a.scalars[1].values[2] = f64::INFINITY,
        |a| a.vertex_colors = Some(Vec::new()),
        |a| {
            a.materials = Some(FaceNames {
                names: vec!["one".into()],
                of_face: vec![0, 0, 1, 0],
            })
        },
        |a| {
            a.groups = Some(FaceNames {
                names: Vec::new(),
                of_face: vec![NO_NAME; 5],
            })
        },
    ];
    for (k, wrong) in wrong.into_iter().enumerate() {
        let mut attributes = all();
        wrong(&mut attributes);
        let polygons = Polygons {
            vertices: &SQUARES,
            faces: FACES.to_vec(),
            attributes: Some(&attributes),
        };
        for format in [Format::Obj, Format::Stl] {
            let error = encode_polygons(&polygons, format).unwrap_err();
            assert_eq!(error.code(), "invalid_argument", "{k}");
        }
    }
}

/// The attributes of the mesh that repair makes of a file.
fn of_file(
    text: &str,
    format: Format,
    options: &RepairOptions,
) -> (TriangleMesh, SurfaceAttributes) {
    let soup = parse(text.as_bytes(), format).unwrap();
    let read = Attributes::parse(text.as_bytes(), format, &soup).unwrap();
    let (mesh, repaired) = TriangleMesh::from_soup(&soup, options).unwrap();
    let found = SurfaceAttributes::of_file(&mesh, (&soup, Some(&repaired)), &read).unwrap();
    (mesh, found)
}

#[test]
fn attributes_survive_repair() {
    // A degenerate face comes first, the last face runs the other way and has a vertex of its own in the place of
    // another one, and one vertex belongs to nothing.
    let text = "mtllib a.mtl\nv 9 9 9 1 1 1\nv 0 0 0 0 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 1 0\nv 0 1 0 0 1 0\nv 2 0 0 1 0 .5\n\
                v 1 1 0 1 1 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 5 5\n\
                usemtl waste\nf 2/1 2/1 3/1\no box\ng top\nusemtl red\nf 2/1 3/2 4/3 5/4\ng\nusemtl blue\nf 7/3 8/5 6/5 3/2\n";
    let (mesh, found) = of_file(text, Format::Obj, &RepairOptions::default());
    assert_eq!((mesh.vertex_count(), mesh.face_count()), (6, 4));
    let materials = found.materials.as_ref().unwrap();
    let groups = found.groups.as_ref().unwrap();
    for face in 0..4 {
        let is_left = mesh.face_centroid(face)[0] < 1.0;
        let name = |names: &FaceNames| names.names[names.of_face[face] as usize].clone();
        assert_eq!(name(materials), if is_left { "red" } else { "blue" });
        assert_eq!(name(groups), if is_left { "box top" } else { "box" });
        for (k, vertex) in mesh.corners(face).into_iter().enumerate() {
            let [x, y, _] = mesh.position(vertex);
            let expected = if x < 2.0 { [x, y] } else { [5.0; 2] };
            assert_eq!(found.uv.as_ref().unwrap()[3 * face + k], expected);
        }
    }
    for (p, color) in mesh
        .vertices()
        .iter()
        .zip(found.vertex_colors.as_ref().unwrap())
    {
        match *p {
            [2.0, 1.0, _] => assert!(color[0].is_nan()),
            [2.0, 0.0, _] => assert_eq!(*color, [1.0, 0.0, 0.5, 1.0]),
            [x, y, _] => assert_eq!(*color, [x, y, 0.0, 1.0]),
        }
    }
    assert_eq!(found.libraries, ["a.mtl"]);
}

#[test]
fn faces_that_fill_holes_have_no_material() {
    // A square of four triangles without one of them.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 .5\nusemtl red\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n\
                f 2 1 4 3\n";
    let open = text.replace("f 2 3 5\n", "");
    let options = RepairOptions {
        fill_holes: 10,
        ..RepairOptions::default()
    };
    let (mesh, found) = of_file(&open, Format::Obj, &options);
    assert_eq!(mesh.face_count(), 6);
    let labels = &found.materials.unwrap().of_face;
    for (face, &label) in labels.iter().enumerate() {
        let is_filled = mesh.face_centroid(face)[0] > 0.7;
        assert_eq!(label, if is_filled { NO_NAME } else { 0 });
    }
}

#[test]
fn numbers_of_ply_vertices_are_read_by_name() {
    let text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                property float nx\nproperty uchar red\nproperty int age\nproperty uchar green\nproperty uchar blue\n\
                property float alpha\nproperty list uchar int knots\nproperty double age\nelement face 1\n\
                property list uchar int vertex_indices\nproperty float heat\nend_header\n\
                0 0 0 1 255 -7 51 0 0.5 2 8 9 1\n1 0 0 1 0 8 0 0 1 0 2\n0 1 0 1 0 9 0 255 1 0 3\n3 0 1 2 9\n";
    let (_, found) = of_file(text, Format::Ply, &RepairOptions::default());
    // The first of two properties of one name counts.
    let age = VertexScalar {
        name: "age".into(),
        values: vec![-7.0, 8.0, 9.0],
    };
    assert_eq!(found.scalars, [age]);
    let colors = found.vertex_colors.unwrap();
    assert_eq!(
        colors,
        [
            [1.0, 0.2, 0.0, 0.5],
            [0.0, 0.0, 0.0, 1.0],
            [0.0, 0.0, 1.0, 1.0]
        ]
    );
}

#[test]
fn files_without_attributes_are_told_apart_from_others() {
    let none = "# usemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\ns 1\nf 1//1 2//1 3//1\n";
    assert!(!Attributes::are_in(none.as_bytes(), Format::Obj).unwrap());
    for some in ["usemtl a", "g a", "o a", " vt 0 0"] {
        let text = format!("{none}{some}\n");
        assert!(
            Attributes::are_in(text.as_bytes(), Format::Obj).unwrap(),
            "{some}"
        );
    }
    let colored = none.replace("v 0 0 0", "v 0 0 0 1 0 0");
    assert!(Attributes::are_in(colored.as_bytes(), Format::Obj).unwrap());
    let header = |property: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n{property}\
             element face 0\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    for (property, expected) in [
        ("", false),
        ("property float nx\n", false),
        ("property float heat\n", true),
    ] {
        let found = Attributes::are_in(header(property).as_bytes(), Format::Ply).unwrap();
        assert_eq!(found, expected, "{property}");
    }
    assert!(!Attributes::are_in(b"OFF\n0 0 0\n", Format::Off).unwrap());
}

/// The side of a cube about the origin on which a point lies.
fn side(p: [f64; 3]) -> u32 {
    let axis = (0..3).fold(
        0,
        |best, k| if p[k].abs() > p[best].abs() { k } else { best },
    );
    2 * axis as u32 + u32::from(p[axis] > 0.0)
}

#[test]
fn quads_of_a_cube_have_the_material_of_their_side() {
    let squares = [
        [0u32, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let vertices = (0..8).map(|v: u32| [0, 1, 2].map(|k| f64::from(v >> k & 1) * 2.0 - 1.0));
    let triangles = squares
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    let mesh = TriangleMesh::new(vertices.collect(), triangles.collect()).unwrap();
    let materials = FaceNames {
        names: (0..6).map(|side| format!("side {side}")).collect(),
        of_face: (0..12).map(|face| side(mesh.face_centroid(face))).collect(),
    };
    // Two sides of the cube share a chart, as others do not.
    let uv = (0..12).flat_map(|face| {
        let shift = 10.0 * f64::from(side(mesh.face_centroid(face)));
        mesh.corner_positions(face)
            .map(|[x, y, z]| [shift + x + 0.5 * y, shift + z + 0.25 * y])
    });
    let given = SurfaceAttributes {
        materials: Some(materials),
        uv: Some(uv.collect()),
        ..SurfaceAttributes::default()
    };
    let mut options = QuadOptions {
        sizing: Sizing::Quads(600),
        ..QuadOptions::default()
    };
    let features = FeatureGraph::by_angle(&mesh, 40f64.to_radians()).unwrap();
    options.guidance.feature_edges = features.edges().collect();
    let made = quadrangulate(&mesh, &options, Monitor::default).unwrap();
    assert!(made.quads.is_conforming() && made.missed_features.is_empty());
    let found = transfer_attributes(&mesh, &made.quads, &given, &mut Monitor::default()).unwrap();
    let of_face = found.materials.unwrap().of_face;
    let uv = found.uv.unwrap();
    let mut seen = HashMap::new();
    for (q, quad) in made.quads.quads.iter().enumerate() {
        let corners = quad.map(|v| made.quads.vertices[v as usize]);
        let center = [0, 1, 2].map(|k| corners.iter().map(|p| p[k]).sum::<f64>());
        assert_eq!(of_face[q], side(center), "quad {q}");
        *seen.entry(of_face[q]).or_insert(0) += 1;
        // Texture coordinates are those of the side, up to its edges.
        let shift = 10.0 * f64::from(side(center));
        for ([x, y, z], [u, v]) in corners.into_iter().zip(&uv[4 * q..]) {
            let expected = [shift + x + 0.5 * y, shift + z + 0.25 * y];
            assert!((u - expected[0]).abs() < 1e-9 && (v - expected[1]).abs() < 1e-9);
        }
    }
    assert_eq!(seen.len(), 6);
    assert!(seen.values().all(|&count| count > 50), "{seen:?}");
}

#[test]
fn numbers_that_are_linear_in_space_are_linear_on_quads() {
    // Quads lie on the triangles, so that what is linear in space comes back on every shape.
    let mesh = shape::by_name("genus-2", 2_000).unwrap();
    let options = QuadOptions {
        sizing: Sizing::Quads(500),
        ..QuadOptions::default()
    };
    let quads = quadrangulate(&mesh, &options, Monitor::default)
        .unwrap()
        .quads;
    let linear = |p: &[f64; 3]| 0.5 + 2.0 * p[0] - p[1] + 0.25 * p[2];
    let scalar = VertexScalar {
        name: "height".into(),
        values: mesh.vertices().iter().map(linear).collect(),
    };
    let given = SurfaceAttributes {
        scalars: vec![scalar],
        ..SurfaceAttributes::default()
    };
    let found = transfer_attributes(&mesh, &quads, &given, &mut Monitor::default()).unwrap();
    for (p, value) in quads.vertices.iter().zip(&found.scalars[0].values) {
        assert!((value - linear(p)).abs() < 1e-12, "{p:?} {value}");
    }
}

#[test]
fn usd_text_has_primvars_and_subsets() {
    let text = String::from_utf8(encoded(Some(&all()), Format::Usda)).unwrap();
    for part in [
        "    texCoord2f[] primvars:st = [(0, 0), (0.5, 0), (0.5, 1), (0, 1), (0.5, 0), ",
        "color3f[] primvars:displayColor = [(0, 0.3333333333333333, 1), ",
        "    double[] primvars:heat = [1, 2.718281828459045, ",
        "        int[] indices = [1, 2]\n        rel material:binding = </mesh/materials/dark_blue>\n",
        "        def Material \"dark_blue\" (\n            displayName = \"dark blue\"\n",
        "    def GeomSubset \"group_1\" (\n        displayName = \"right\"\n    )\n    {\n",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    assert!(!text.contains("displayOpacity"));
    let mut opaque = all();
    opaque.vertex_colors = None;
    let text = String::from_utf8(encoded(Some(&opaque), Format::Usda)).unwrap();
    let opacity =
        "float[] primvars:displayOpacity = [1, 1, 0.4, 1] (\n        interpolation = \"uniform\"\n";
    assert!(text.contains(opacity), "{text}");
}

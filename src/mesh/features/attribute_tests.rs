//! Features by attributes on small files of which the edges are counted by hand.

use super::FeatureGraph;
use crate::mesh::TriangleMesh;
use crate::soup::io::{Attribute, Attributes, Format, parse};
use crate::soup::{EditKind, RepairOptions};

/// Vertices of a square of two by two squares; number 5 is the middle one.
const GRID: &str =
    "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 0 2 0\nv 1 2 0\nv 2 2 0\n";

/// The ends of the feature edges of a file, as positions in the plane, after repair.
fn found(text: &str, format: Format, attribute: Attribute) -> crate::Result<Vec<[[i64; 2]; 2]>> {
    let soup = parse(text.as_bytes(), format)?;
    let attributes = Attributes::parse(text.as_bytes(), format, &soup)?;
    let (mesh, repaired) = TriangleMesh::from_soup(&soup, &RepairOptions::default())?;
    let graph =
        FeatureGraph::by_attribute(&mesh, (&soup, Some(&repaired)), &attributes, attribute)?;
    let mut ends: Vec<_> = graph
        .edges()
        .map(|edge| {
            let mut ends = mesh.edge(edge).vertices.map(|v| {
                let [x, y, _] = mesh.position(v);
                [x as i64, y as i64]
            });
            ends.sort_unstable();
            ends
        })
        .collect();
    ends.sort_unstable();
    Ok(ends)
}

fn in_obj(faces: &str, attribute: Attribute) -> crate::Result<Vec<[[i64; 2]; 2]>> {
    found(&format!("{GRID}{faces}"), Format::Obj, attribute)
}

/// The line x = 1 through the middle.
const MIDDLE: [[[i64; 2]; 2]; 2] = [[[1, 0], [1, 1]], [[1, 1], [1, 2]]];

#[test]
fn faces_of_other_materials_groups_and_smoothing_meet_at_features() {
    let left = "f 1 2 5 4\nf 4 5 8 7\n";
    let right = "f 2 3 6 5\nf 5 6 9 8\n";
    for (attribute, a, b, again) in [
        (
            Attribute::Materials,
            "usemtl red",
            "usemtl blue",
            "usemtl red # the same",
        ),
        (Attribute::Groups, "g left", "g right", "g  left "),
        (Attribute::Groups, "o left", "o right", "o left"),
        (Attribute::Smoothing, "s 1", "s off", "s 1"),
    ] {
        let two = in_obj(&format!("{a}\n{left}{b}\n{right}"), attribute).unwrap();
        assert_eq!(two, MIDDLE, "{a}");
        let unnamed = in_obj(&format!("{left}{b}\n{right}"), attribute).unwrap();
        assert_eq!(unnamed, MIDDLE, "{b}");
        let one = in_obj(&format!("{a}\n{left}{again}\n{right}"), attribute).unwrap();
        assert!(one.is_empty(), "{a}");
    }
    let off = in_obj(&format!("s off\n{left}s 0\n{right}"), Attribute::Smoothing).unwrap();
    assert!(off.is_empty());
}

#[test]
fn seams_and_normals_are_compared_by_value() {
    let values = "vt 0 0\nvt 1 0\nvt 0 -0\nvn 0 0 1\nvn 0 1 0\nvn 0 0 1.0\n";
    // The texture differs at the lower end of the lower edge alone.
    let seam = "f 1/1/1 2/1/1 5/1/1 4/1/1\nf 2/2/1 3/1/1 6/1/1 5/3/3\nf 4/1/1 5/1/1 8/1/1 7/1/1\n\
        f 5/3/1 6/3/1 9/3/1 8/3/1\n";
    let seams = in_obj(&format!("{values}{seam}"), Attribute::Seams).unwrap();
    assert_eq!(seams, [[[1, 0], [1, 1]]]);
    let same = in_obj(&format!("{values}{seam}"), Attribute::Normals).unwrap();
    assert!(same.is_empty());
    let hard = "f 1//1 2//1 5//1 4//1\nf 4//1 5//1 8//1 7//1\nf 2//2 3//2 6//2 5//2\nf 5//2 6//2 9//2 8//2\n";
    let hard = in_obj(&format!("{hard}{values}"), Attribute::Normals).unwrap();
    assert_eq!(hard, MIDDLE);
}

#[test]
fn attributes_survive_welding_turning_and_dropping() {
    // The right half has its own vertices and runs the other way, and a degenerate face and one that
    // repeats another come first.
    let copies = "v 1 0 0\nv 1 1 0\nv 1 2 0\n";
    let faces = "usemtl waste\nf 1 1 2\nusemtl red\nf 1/1 2/1 5/1 4/1\nf 4/1 5/1 8/1 7/1\nusemtl blue\n\
        f 11/2 6/2 3/2 10/2\nf 12/2 9/2 6/2 11/2\nvt 0 0\nvt 1 1\n";
    let text = format!("{GRID}{copies}{faces}");
    let soup = parse(text.as_bytes(), Format::Obj).unwrap();
    let (_, repaired) = TriangleMesh::from_soup(&soup, &RepairOptions::default()).unwrap();
    for kind in [
        EditKind::VertexWelded,
        EditKind::PolygonDegenerate,
        EditKind::PolygonTurned,
    ] {
        assert!(repaired.edits.count(kind) > 0, "{kind:?}");
    }
    for attribute in [Attribute::Materials, Attribute::Seams] {
        assert_eq!(found(&text, Format::Obj, attribute).unwrap(), MIDDLE);
    }
}

#[test]
fn faces_of_other_colours_meet_at_features() {
    let header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
        property float z\nelement face 2\nproperty uchar red\nproperty list uchar int vertex_indices\n\
        property uchar green\nproperty uchar blue\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    let with = |faces: &str| found(&format!("{header}{faces}"), Format::Ply, Attribute::Colors);
    assert_eq!(
        with("9 3 0 1 2 0 0\n9 3 0 2 3 0 1\n").unwrap(),
        [[[0, 0], [1, 1]]]
    );
    assert!(with("9 3 0 1 2 0 0\n9 3 0 2 3 0 0\n").unwrap().is_empty());
}

#[test]
fn what_a_file_lacks_is_refused_with_what_it_has() {
    let faces = "usemtl red\nf 1/1 2/1 5/1 4/1\nvt 0 0\n";
    let error = in_obj(faces, Attribute::Normals).unwrap_err();
    assert_eq!(error.code(), "invalid_argument");
    assert_eq!(
        error.to_string(),
        "the file has no normals; it has materials, seams"
    );
    let error = in_obj("f 1 2 5 4\n", Attribute::Groups).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the file has no groups; it has no attributes that are read"
    );
    for (faces, line) in [
        ("f 1/2 2/1 5/1 4/1\nvt 0 0\n", 10),
        ("vt 0 0\nf 1/1 2/0 5/1 4/1\n", 11),
        ("vt 0 0\nf 1/1 2/-2 5/1 4/1\n", 11),
        ("vt x 0\nf 1/1 2/1 5/1 4/1\n", 10),
        ("vn 0 0\nf 1//1 2//1 5//1 4//1\n", 10),
    ] {
        assert_eq!(
            in_obj(faces, Attribute::Seams).unwrap_err().line(),
            Some(line),
            "{faces}"
        );
    }
}

#[test]
fn attributes_of_another_soup_are_refused() {
    let text = format!("{GRID}usemtl red\nf 1 2 5 4\nf 4 5 8 7\n");
    let soup = parse(text.as_bytes(), Format::Obj).unwrap();
    let attributes = Attributes::parse(text.as_bytes(), Format::Obj, &soup).unwrap();
    let other = parse(format!("{GRID}f 1 2 5\n").as_bytes(), Format::Obj).unwrap();
    let (mesh, repaired) = TriangleMesh::from_soup(&other, &RepairOptions::default()).unwrap();
    let refused = |soup, repaired| {
        FeatureGraph::by_attribute(&mesh, (soup, repaired), &attributes, Attribute::Materials)
            .unwrap_err()
            .code()
    };
    assert_eq!(refused(&other, Some(&repaired)), "malformed");
    assert_eq!(refused(&soup, None), "length_mismatch");
}

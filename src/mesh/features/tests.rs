//! Feature graphs of shapes whose features are known, and of files.

use std::collections::BTreeSet;
use std::f64::consts::FRAC_PI_4;

use super::FeatureGraph;
use crate::mesh::{TriangleMesh, shape};

/// A box of the cubes of 1 x 1 x 1, every side cut into `n` x `n` squares of two triangles.
fn cube(n: usize) -> TriangleMesh {
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let mut triangles = Vec::new();
    for side in 0..6 {
        let (axis, high) = (side % 3, side / 3);
        let mut number = |i: usize, j: usize| {
            let mut p = [0.0; 3];
            p[axis] = high as f64;
            p[(axis + 1) % 3] = i as f64 / n as f64;
            p[(axis + 2) % 3] = j as f64 / n as f64;
            let found = vertices.iter().position(|&q| q == p);
            found.unwrap_or_else(|| {
                vertices.push(p);
                vertices.len() - 1
            }) as u32
        };
        for i in 0..n {
            for j in 0..n {
                let [a, b, c, d] =
                    [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| number(i, j));
                match high {
                    1 => triangles.extend([[a, b, c], [a, c, d]]),
                    _ => triangles.extend([[a, c, b], [a, d, c]]),
                }
            }
        }
    }
    TriangleMesh::new(vertices, triangles).unwrap()
}

/// What must hold of any graph: curves are chains that hold every feature edge once, and end at
/// nodes alone.
fn check(mesh: &TriangleMesh, graph: &FeatureGraph) {
    let mut seen = BTreeSet::new();
    let nodes: BTreeSet<usize> = graph
        .corners()
        .iter()
        .chain(graph.open_ends())
        .copied()
        .collect();
    for curve in graph.curves() {
        assert_eq!(curve.vertices.len(), curve.edges.len() + 1);
        for (i, &e) in curve.edges.iter().enumerate() {
            let ends = BTreeSet::from(mesh.edge(e).vertices);
            assert_eq!(
                ends,
                BTreeSet::from([curve.vertices[i], curve.vertices[i + 1]])
            );
            assert!(seen.insert(e), "edge {e} lies on two curves");
        }
        let inner = &curve.vertices[1..curve.vertices.len() - 1];
        assert!(inner.iter().all(|v| !nodes.contains(v)));
        let ends_at_nodes = nodes.contains(&curve.vertices[0]);
        assert!(ends_at_nodes || curve.is_loop());
    }
    assert_eq!(
        seen.into_iter().collect::<Vec<_>>(),
        graph.edges().collect::<Vec<_>>()
    );
}

#[test]
fn a_cube_has_twelve_curves_between_eight_corners() {
    for n in [1, 2, 5] {
        let mesh = cube(n);
        let graph = FeatureGraph::by_angle(&mesh, FRAC_PI_4).unwrap();
        check(&mesh, &graph);
        assert_eq!((graph.curves().len(), graph.corners().len()), (12, 8));
        assert!(graph.open_ends().is_empty());
        assert!(
            graph
                .curves()
                .iter()
                .all(|c| c.edges.len() == n && !c.is_loop())
        );
    }
}

#[test]
fn a_gear_has_as_many_corners_as_its_outline_and_two_round_rims_at_the_bore() {
    let mesh = shape::by_name("gear", 6_000).unwrap();
    let graph = FeatureGraph::by_angle(&mesh, FRAC_PI_4).unwrap();
    check(&mesh, &graph);
    let loops = graph.curves().iter().filter(|c| c.is_loop()).count();
    assert_eq!(loops, 2);
    // An extruded outline of n corners: n curves at the top, n at the bottom, n between.
    let corners = graph.corners().len();
    assert_eq!(corners % 2, 0);
    assert_eq!(graph.curves().len() - loops, 3 * corners / 2);
    assert!(graph.corners().iter().all(|&v| graph.degree(v) == 3));
}

#[test]
fn the_boundary_of_a_square_turns_at_four_corners_and_holes_are_loops() {
    let mesh = shape::by_name("plane", 200).unwrap();
    let graph = FeatureGraph::boundary(&mesh);
    check(&mesh, &graph);
    assert_eq!((graph.curves().len(), graph.corners().len()), (4, 4));
    let none = FeatureGraph::by_angle(&mesh, 0.1).unwrap();
    assert_eq!(none, FeatureGraph::none(&mesh));
    assert_eq!(none.with(&mesh, &graph).unwrap(), graph);
}

#[test]
fn a_chain_inside_a_surface_has_two_open_ends() {
    let mesh = shape::by_name("sphere", 500).unwrap();
    let [a, b] = mesh.edge(7).vertices;
    let (face, k) = mesh.edge(7).first;
    let c = mesh.corners(face)[(k + 2) % 3];
    let graph = FeatureGraph::from_lines(&mesh, &[[b, a], [a, c]]).unwrap();
    check(&mesh, &graph);
    let mut ends = [b, c];
    ends.sort_unstable();
    assert_eq!(graph.open_ends(), ends);
    assert_eq!(graph.edges().count(), 2);
}

#[test]
fn what_is_no_edge_is_refused_by_position() {
    let mesh = cube(2);
    let error = FeatureGraph::from_edges(&mesh, &[0, mesh.edge_count()]).unwrap_err();
    assert_eq!(
        (error.code(), error.index()),
        ("index_out_of_range", Some(1))
    );
    let [a, b] = mesh.edge(0).vertices;
    let far = mesh.vertex_count();
    let error = FeatureGraph::from_lines(&mesh, &[[a, b], [a, far]]).unwrap_err();
    assert_eq!(
        (error.code(), error.index()),
        ("index_out_of_range", Some(1))
    );
    let error = FeatureGraph::from_lines(&mesh, &[[a, b], [b, a], [a, a]]).unwrap_err();
    assert_eq!((error.code(), error.index()), ("invalid_argument", Some(2)));
    for angle in [0.0, -1.0, 3.2, f64::NAN, f64::INFINITY] {
        assert_eq!(
            FeatureGraph::by_angle(&mesh, angle).unwrap_err().code(),
            "invalid_argument"
        );
    }
    let other = FeatureGraph::none(&cube(1));
    let error = FeatureGraph::none(&mesh).with(&mesh, &other).unwrap_err();
    assert_eq!(error.code(), "length_mismatch");
}

#[cfg(feature = "mesh-io")]
#[test]
fn line_elements_of_a_file_are_features_and_what_is_wrong_is_named_by_its_line() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    let mesh = crate::mesh::io::parse(text.as_bytes(), crate::mesh::io::Format::Obj).unwrap();
    let read = |lines: &str| FeatureGraph::parse(&mesh, &format!("{text}{lines}"));
    let expected = FeatureGraph::from_lines(&mesh, &[[0, 2], [2, 3]]).unwrap();
    for lines in [
        "l 1 3 4 # a chain\n",
        "l 1/7 3/8\nl 4 3\n",
        "l -4 -2\nl -1 -2 -1\n",
    ] {
        assert_eq!(read(lines).unwrap(), expected, "{lines}");
    }
    assert_eq!(read("").unwrap(), FeatureGraph::none(&mesh));
    for (lines, line) in [
        ("l 1\n", 7),
        ("l 1 2\nl 2 4\n", 8),
        ("l 0 1\n", 7),
        ("l 1 5\n", 7),
    ] {
        assert_eq!(read(lines).unwrap_err().line(), Some(line), "{lines}");
    }
}

#[test]
fn sharp_edges_enclose_no_face_unless_it_is_asked_for() {
    // All edges of an octahedron turn alike.
    let vertices = [0, 1, 2].into_iter().flat_map(|axis| {
        [1.0, -1.0].map(|sign| {
            let mut p = [0.0; 3];
            p[axis] = sign;
            p
        })
    });
    let faces = [
        [0, 2, 4],
        [2, 1, 4],
        [1, 3, 4],
        [3, 0, 4],
        [2, 0, 5],
        [1, 2, 5],
        [3, 1, 5],
        [0, 3, 5],
    ];
    let mesh = TriangleMesh::new(vertices.collect(), faces.to_vec()).unwrap();
    let none = FeatureGraph::none(&mesh);
    let sharp = none.with_sharp(&mesh, 1.0).unwrap();
    for face in 0..8 {
        let count = (0..3)
            .filter(|&k| sharp.contains(mesh.edge_of(face, k)))
            .count();
        assert!(count < 3);
    }
    assert!(2 * sharp.edges().count() >= mesh.edge_count());
    // What is asked for by name stays.
    let all: Vec<usize> = (0..mesh.edge_count()).collect();
    let named = FeatureGraph::from_edges(&mesh, &all).unwrap();
    let kept = named.clone().with_sharp(&mesh, 1.0).unwrap();
    assert_eq!(kept, named);
}

/// The top of a box of 8 x 8 squares a side, and the graph of chains between points of it, in squares.
fn chains(of: &[&[[usize; 2]]]) -> (TriangleMesh, FeatureGraph) {
    let mesh = cube(8);
    let vertex = |[i, j]: [usize; 2]| {
        let p = [i as f64 / 8.0, j as f64 / 8.0, 1.0];
        (0..mesh.vertex_count())
            .find(|&v| mesh.position(v) == p)
            .unwrap()
    };
    let step = |a: usize, b: usize, k: usize| if b > a { a + k } else { a - k };
    let mut lines = Vec::new();
    for pair in of.iter().flat_map(|chain| chain.windows(2)) {
        let [[a, b], [c, d]] = [pair[0], pair[1]];
        let count = a.abs_diff(c) + b.abs_diff(d);
        let at = |k: usize| match a == c {
            true => vertex([a, step(b, d, k)]),
            false => vertex([step(a, c, k), b]),
        };
        lines.extend((0..count).map(|k| [at(k), at(k + 1)]));
    }
    let graph = FeatureGraph::from_lines(&mesh, &lines).unwrap();
    (mesh, graph)
}

#[test]
fn loose_ends_are_left_out_and_the_shortest_first() {
    let (mesh, graph) = chains(&[&[[1, 4], [7, 4]], &[[4, 4], [4, 6]], &[[1, 1], [3, 1]]]);
    let none = FeatureGraph::none(&mesh);
    let long = |length| graph.clone().without_short(&mesh, &none, length).unwrap();
    assert_eq!(long(0.25), graph);
    // Without the branch, the halves of the stem are one curve.
    let (_, stem) = chains(&[&[[1, 4], [7, 4]]]);
    assert_eq!(long(0.5), stem);
    assert_eq!(long(0.75), stem);
    assert_eq!(long(0.76), none);
    let (_, held) = chains(&[&[[1, 1], [3, 1]]]);
    let kept = graph.clone().without_short(&mesh, &held, 0.76).unwrap();
    assert_eq!(kept, held);
    assert_eq!(long(0.5).without_short(&mesh, &none, 0.5).unwrap(), stem);
    // A loop without an end is no loose curve.
    let square = [[1, 1], [5, 1], [5, 5], [1, 5], [1, 1]];
    let (mesh, square) = chains(&[&square, &[[5, 5], [7, 5]]]);
    let found = square.without_short(&mesh, &none, 0.3).unwrap();
    let (_, expected) = chains(&[&[[1, 1], [5, 1], [5, 5], [1, 5], [1, 1]]]);
    assert_eq!(found, expected);
}

#[test]
fn small_patches_are_joined_to_the_side_to_which_the_surface_turns_least() {
    // A patch of one square, beside a line from edge to edge of the side.
    let corner = [[0, 7], [1, 7], [1, 8]];
    let (mesh, graph) = chains(&[&corner]);
    let sharp = FeatureGraph::by_angle(&mesh, 1.0).unwrap();
    let both = graph.with(&mesh, &sharp).unwrap();
    let none = FeatureGraph::none(&mesh);
    let found = |length| both.clone().without_short(&mesh, &none, length).unwrap();
    // The area of the patch is that of a square of side 1/8.
    assert_eq!(found(0.49), both);
    assert_eq!(found(0.51), sharp);
    let held = both.clone().without_short(&mesh, &both, 9.0).unwrap();
    assert_eq!(held, both);
    // All sides of the box are too small, and then two together, and then four.
    let patches = |graph: FeatureGraph| graph.edges().count() / 8;
    assert_eq!([patches(found(4.1)), patches(found(9.0))], [8, 0]);
    let other = shape::by_name("sphere", 500).unwrap();
    assert!(both.without_short(&other, &none, 1.0).is_err());
}

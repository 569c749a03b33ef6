//! Cones that collapse, on flat meshes of a few faces, where coordinates are positions.
//!
//! The tests name the cones, because a flat field has none.

use super::super::held_elements::{HeldElements, NearCones};
use super::*;
use crate::field::{Constraint, FieldProblem};
use crate::map::Sizing;
use crate::mesh::features::FeatureGraph;
use crate::search::Options;
use crate::solve::solve;

/// A mesh and the problem of its map along x and y.
struct Flat {
    mesh: TriangleMesh,
    problem: SeamlessProblem,
}

impl Flat {
    /// The first edge of the first face must be along x. `length` is that of edges of quads.
    fn new(points: Vec<[f64; 3]>, faces: Vec<[u32; 3]>, length: f64, lines: &[[usize; 2]]) -> Self {
        let mesh = TriangleMesh::new(points, faces).unwrap();
        let (face, angle) = (0, 0.0);
        let field = FieldProblem::new(&mesh, &[Constraint { face, angle }]).unwrap();
        let solution = solve(field.problem(), &Options::default()).unwrap();
        let field = field.field(&mesh, &solution).unwrap();
        let features = FeatureGraph::from_lines(&mesh, lines).unwrap();
        let sizing = Sizing::EdgeLength(length);
        let problem = SeamlessProblem::with_features(&mesh, &field, &sizing, &features).unwrap();
        assert!(problem.cones().is_empty());
        Flat { mesh, problem }
    }

    /// Unit squares of two triangles each, `columns` along x and `rows` along y. Vertex (i, j) is (rows +
    /// 1) i + j.
    fn grid(columns: usize, rows: usize, length: f64, lines: &[[usize; 2]]) -> Self {
        let at = |i: usize, j: usize| (i * (rows + 1) + j) as u32;
        let points = (0..=columns).flat_map(|i| (0..=rows).map(move |j| [i as f64, j as f64, 0.0]));
        let squares = (0..columns).flat_map(|i| (0..rows).map(move |j| (i, j)));
        let faces = squares.flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        let flat = Self::new(points.collect(), faces.collect(), length, lines);
        // One copy of every vertex, and u along x.
        assert_eq!(flat.problem.sectors.count(), flat.mesh.vertex_count());
        assert_near(flat.problem.aim(&flat.mesh, 0, 0, 1), [1.0 / length, 0.0]);
        flat
    }

    /// Which coordinates integers hold: both of these copies, and of no other copy.
    fn held(&self, copies: &[usize]) -> Vec<[bool; 2]> {
        let copy = 0..self.problem.sectors.count();
        copy.map(|copy| [copies.contains(&copy); 2]).collect()
    }

    /// The elements that integers may collapse where they hold these coordinates.
    fn elements(&self, held: &[[bool; 2]]) -> HeldElements {
        HeldElements::new(&self.problem, &self.mesh, held)
    }

    /// The pairs of near cones if these vertices are cones: each pair starts at its lower vertex.
    fn near(&self, cones: &[usize]) -> Vec<([u32; 2], [f64; 2])> {
        let found = self.elements(&self.held(cones)).pairs;
        let mut pairs = Vec::new();
        for NearCones {
            copies,
            vertices,
            aim,
        } in found
        {
            assert_eq!(copies, vertices);
            let [a, b] = vertices;
            pairs.push(match a < b {
                true => ([a, b], aim),
                false => ([b, a], aim.map(|x| -x)),
            });
        }
        pairs.sort_by_key(|pair| pair.0);
        pairs
    }

    /// The map that places each vertex at `at` of its position.
    fn map(&self, at: impl Fn([f64; 2]) -> [f64; 2]) -> SeamlessMap {
        let points = self.mesh.vertices().iter();
        let values: Vec<f64> = points.flat_map(|&[x, y, _]| at([x, y])).collect();
        SeamlessMap::new(&self.problem, &self.mesh, &values).unwrap()
    }

    /// The elements of these cones that a map collapses.
    fn collapsed(&self, cones: &[usize], at: impl Fn([f64; 2]) -> [f64; 2]) -> Collapsed {
        let elements = HeldElements {
            isoline_triangles: Vec::new(),
            ..self.elements(&self.held(cones))
        };
        Collapsed::find(&elements, &self.map(at))
    }
}

fn assert_near(found: [f64; 2], expected: [f64; 2]) {
    let off = [0, 1].map(|i| (found[i] - expected[i]).abs());
    assert!(off[0].max(off[1]) < 1e-9, "{found:?} for {expected:?}");
}

/// Checks which pairs of vertices are joined, and by how much their coordinates should differ.
fn assert_pairs(found: &[([u32; 2], [f64; 2])], expected: &[([u32; 2], [f64; 2])]) {
    let vertices = |pairs: &[([u32; 2], [f64; 2])]| pairs.iter().map(|p| p.0).collect::<Vec<_>>();
    assert_eq!(vertices(found), vertices(expected));
    for (found, expected) in found.iter().zip(expected) {
        assert_near(found.1, expected.1);
    }
}

fn apart(from: u32, to: u32, axis: usize, by: f64) -> SeparationConstraint {
    SeparationConstraint::new([from, to], axis, by)
}

#[test]
fn cones_are_near_when_a_path_of_four_edges_joins_them() {
    let strip = Flat::grid(8, 1, 1.0, &[]);
    assert_pairs(&strip.near(&[0, 8]), &[([0, 8], [4.0, 0.0])]);
    // Diagonals lead from below to above, so that the way down is one edge longer.
    assert_pairs(&strip.near(&[0, 9]), &[([0, 9], [4.0, 1.0])]);
    assert_pairs(&strip.near(&[1, 8]), &[]);
    assert_pairs(&strip.near(&[0, 10]), &[]);
}

#[test]
fn where_quads_are_long_cones_are_near_over_more_edges() {
    // The two edges of each face that are measured are 1/4 and root 2 / 4 long: two units are six.
    let strip = Flat::grid(8, 1, 4.0, &[]);
    assert_pairs(&strip.near(&[0, 12]), &[([0, 12], [1.5, 0.0])]);
    assert_pairs(&strip.near(&[0, 14]), &[]);
}

#[test]
fn a_cone_hides_those_behind_it() {
    // Both vertices of the third column, and one on each side.
    let strip = Flat::grid(8, 1, 1.0, &[]);
    let expected = [
        ([0, 4], [2.0, 0.0]),
        ([0, 5], [2.0, 1.0]),
        ([4, 5], [0.0, 1.0]),
        ([4, 8], [2.0, 0.0]),
        ([5, 8], [2.0, -1.0]),
    ];
    assert_pairs(&strip.near(&[0, 4, 5, 8]), &expected);
}

#[test]
fn vertices_of_which_one_coordinate_is_held_are_no_cones() {
    let strip = Flat::grid(8, 1, 1.0, &[]);
    let mut held = strip.held(&[0, 8]);
    held[8] = [true, false];
    assert_eq!(strip.elements(&held).pairs, []);
}

#[test]
fn an_isoline_joins_cones_however_far_apart_to_the_next_one() {
    // Along the middle row of three.
    let vertex = |i: usize| 3 * i + 1;
    let lines: Vec<[usize; 2]> = (0..20).map(|i| [vertex(i), vertex(i + 1)]).collect();
    let strip = Flat::grid(20, 2, 1.0, &lines);
    let cones = [0, 8, 20].map(vertex);
    let [a, b, c] = cones.map(|v| v as u32);
    let expected = [([a, b], [8.0, 0.0]), ([b, c], [12.0, 0.0])];
    assert_pairs(&strip.near(&cones), &expected);
    // Elsewhere nothing joins them.
    assert_pairs(&strip.near(&[0, 8, 20].map(|i| 3 * i)), &[]);
}

#[test]
fn no_path_leads_across_the_cut() {
    // A prism of twelve sides, two high: its cut leads from one end to the other.
    let (sides, length) = (12, 1.0);
    let at = |i: usize, j: usize| (3 * (i % sides) + j) as u32;
    let points = (0..sides).flat_map(|i| {
        let (y, x) = (i as f64 / sides as f64 * std::f64::consts::TAU).sin_cos();
        (0..3).map(move |j| [2.0 * x, 2.0 * y, j as f64])
    });
    let squares = (0..sides).flat_map(|i| (0..2).map(move |j| (i, j)));
    let faces = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    let Flat { mesh, problem } = Flat::new(points.collect(), faces.collect(), length, &[]);
    let copies = |v: usize| problem.sectors.first[v]..problem.sectors.first[v + 1];
    let side_of = |v: usize| copies(v).len() > 1;
    let near = |cones: [usize; 2]| {
        let mut held = vec![[false; 2]; problem.sectors.count()];
        let all = cones.into_iter().flat_map(copies);
        all.for_each(|copy| held[copy as usize] = [true; 2]);
        HeldElements::new(&problem, &mesh, &held).pairs.len()
    };
    let mut cut = 0;
    for i in 0..sides {
        let row = |i: usize| at(i, 1) as usize;
        let ends = [row(i), row(i + 2)];
        if ends.into_iter().any(side_of) {
            continue;
        }
        // Two edges around the prism, over one vertex between.
        let is_cut = side_of(row(i + 1));
        assert_eq!(near(ends), usize::from(!is_cut), "{i}");
        cut += usize::from(is_cut);
    }
    assert!(cut > 0);
}

#[test]
fn two_cones_are_collapsed_at_one_point_or_the_wrong_way_round() {
    let strip = Flat::grid(2, 1, 1.0, &[]);
    // (0, 0) and (2, 0): by two to the right.
    let count = |at: fn([f64; 2]) -> [f64; 2]| {
        let found = strip.collapsed(&[0, 4], at);
        assert!(found.faces.is_empty() && found.isoline_triangles.is_empty());
        assert!(found.pairs.iter().all(|pair| pair.vertices == [0, 4]));
        assert_eq!(found.count(), found.pairs.len());
        found.count()
    };
    assert_eq!(count(|[x, y]| [x, y]), 0);
    assert_eq!(count(|[x, y]| [0.5 * x, y]), 0);
    assert_eq!(count(|[x, y]| [x, y + 7.0 * x]), 0);
    assert_eq!(count(|[_, y]| [3.0, y]), 1);
    assert_eq!(count(|[x, y]| [-x, y]), 1);
    // By none along x, whatever else: what is not yet an integer is taken for the nearest.
    assert_eq!(count(|[x, y]| [0.0, y + x]), 1);
    assert_eq!(count(|[x, y]| [0.24 * x, y]), 1);
    assert_eq!(count(|[x, y]| [0.26 * x, y]), 0);
}

#[test]
fn a_face_of_three_cones_is_collapsed_on_one_line_or_clockwise() {
    // Vertices: 0 at (0, 0), 1 at (0, 1), 2 at (1, 0), 3 at (1, 1). Faces: 0 2 3 and 0 3 1.
    let square = Flat::grid(1, 1, 1.0, &[]);
    let with_last_at = |cones: &[usize], last: [f64; 2]| {
        let at = |p: [f64; 2]| if p == [1.0, 1.0] { last } else { p };
        square.collapsed(cones, at).faces
    };
    let all = [0, 1, 2, 3];
    assert!(with_last_at(&all, [1.0, 1.0]).is_empty());
    assert_eq!(with_last_at(&all, [2.0, 0.0]), [0]);
    assert_eq!(with_last_at(&all, [1.0, -1.0]), [0]);
    assert_eq!(with_last_at(&all, [-1.0, 1.0]), [1]);
    assert_eq!(with_last_at(&all, [-1.0, -1.0]), [0, 1]);
    // Rounded it is on a line, though not yet.
    assert_eq!(with_last_at(&all, [2.3, 0.4]), [0]);
    // Two of its cones at one point are a pair.
    assert!(with_last_at(&all, [1.0, 0.0]).is_empty());
    // A corner that may move makes room.
    assert!(with_last_at(&[0, 1, 2], [2.0, 0.0]).is_empty());
}

#[test]
fn a_pair_is_held_apart_along_its_longer_coordinate_by_that_or_one_unit() {
    let strip = Flat::grid(3, 1, 1.0, &[]);
    let held = |aim: [f64; 2]| {
        let pairs = vec![NearCones {
            copies: [6, 1],
            vertices: [6, 1],
            aim,
        }];
        let collapsed = Collapsed {
            pairs,
            faces: Vec::new(),
            isoline_triangles: Vec::new(),
        };
        let map = strip.map(|_| [0.0; 2]);
        collapsed.separation(&strip.mesh, &strip.problem, &map)
    };
    assert_eq!(held([3.2, 0.4]), [apart(6, 1, 0, 3.0)]);
    assert_eq!(held([-0.2, -2.6]), [apart(6, 1, 1, -3.0)]);
    assert_eq!(held([0.3, -0.2]), [apart(6, 1, 0, 1.0)]);
    assert_eq!(held([0.1, -0.3]), [apart(6, 1, 1, -1.0)]);
}

#[test]
fn a_face_is_held_open_as_the_nearest_triangle_of_units() {
    let square = Flat::grid(1, 1, 0.9, &[]);
    let at = |p: [f64; 2]| if p == [1.0, 1.0] { [2.0, 0.0] } else { p };
    let collapsed = square.collapsed(&[0, 1, 2, 3], at);
    assert_eq!(collapsed.faces, [0]);
    let faces = Collapsed {
        pairs: Vec::new(),
        ..collapsed
    };
    let map = square.map(at);
    let found = faces.separation(&square.mesh, &square.problem, &map);
    // From vertex 0 to vertex 2 by (1, 0), to vertex 3 by (1, 1).
    let u = [apart(0, 2, 0, 1.0), apart(0, 3, 0, 1.0)];
    let v = [apart(0, 2, 1, 0.0), apart(0, 3, 1, 1.0)];
    assert_eq!(found, [u, v].concat());
}

#[test]
fn a_face_on_one_isoline_is_held_open_by_one_unit() {
    // Widest along x is the diagonal from 0 to 2, which both faces have: one constraint for both.
    let points = [[0.0, 0.0], [1.0, 0.0], [1.3, 1.0], [0.1, 1.0]];
    let points = points.map(|[x, y]| [x, y, 0.0]).to_vec();
    let flat = Flat::new(points, vec![[0, 1, 2], [0, 2, 3]], 0.2, &[]);
    let held = [[true, false]; 4];
    let elements = flat.elements(&held);
    assert_eq!(elements.isoline_triangles.len(), 2);
    let map = flat.map(|[_, y]| [0.0, 5.0 * y]);
    let collapsed = Collapsed::find(&elements, &map);
    assert_eq!(
        (collapsed.isoline_triangles.len(), collapsed.count()),
        (2, 2)
    );
    let found = collapsed.separation(&flat.mesh, &flat.problem, &map);
    assert_eq!(found, [apart(2, 0, 0, -1.0)]);
    // In the map as it should be nothing is wrong.
    let map = flat.map(|[x, y]| [5.0 * x, 5.0 * y]);
    assert!(Collapsed::find(&elements, &map).count() == 0);
}

#[test]
fn no_two_cones_are_joined_twice() {
    // The first face of a square joins 0, 2 and 3. The second shares 0 and 3 with it; of the pairs, the
    // first is joined already, the second is new, and the third is joined by the second.
    let square = Flat::grid(1, 1, 1.0, &[]);
    let pair = |a: u32, b: u32| NearCones {
        copies: [a, b],
        vertices: [a, b],
        aim: [0.0, 1.0],
    };
    let collapsed = Collapsed {
        pairs: vec![pair(0, 3), pair(0, 1), pair(1, 3)],
        faces: vec![0, 1],
        isoline_triangles: Vec::new(),
    };
    let map = square.map(|_| [0.0; 2]);
    let found = collapsed.separation(&square.mesh, &square.problem, &map);
    assert_eq!(found.len(), 5);
    assert_eq!(found[4], apart(0, 1, 1, 1.0));
}

//! Base complexes and motorcycle graphs of small surfaces, against a search that shares no code with them.

use std::collections::{BTreeMap, BTreeSet};

use super::*;
use crate::linalg::DisjointSets;
use crate::mesh::vector::Vec3;
use crate::mesh::{MeshError, shape};
use crate::test_random::Random;

/// The numbers below `count` in any order.
fn permutation(random: &mut Random, count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    (1..count).for_each(|i| order.swap(i, random.below(i + 1)));
    order
}

type Quads = (Vec<Vec3>, Vec<[u32; 4]>);

/// `columns` times `rows` quads. Where it is closed, the last column is beside the first, and the last row
/// beside the first one moved by `shift`.
fn grid(columns: usize, rows: usize, closed: [bool; 2], shift: usize) -> Quads {
    let m = columns + usize::from(!closed[0]);
    let n = rows + usize::from(!closed[1]);
    let at = |i: usize, j: usize| match closed[1] && j == n {
        true => ((i + shift) % m) as u32,
        false => (j * m + i % m) as u32,
    };
    let positions = (0..m * n).map(|v| [(v % m) as f64, (v / m) as f64, (v % 3) as f64 * 0.1]);
    let quads = (0..columns * rows).map(|q| {
        let (i, j) = (q % columns, q / columns);
        [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
    });
    (positions.collect(), quads.collect())
}

/// Every quad divided into `k` times `k`, and vertices welded.
fn divided(quads: &Quads, k: usize) -> Quads {
    divided_by(quads, |_| k)
}

/// Every strip of quads divided into as many as `parts` gives for its number, and vertices welded.
fn divided_by((positions, quads): &Quads, parts: impl Fn(usize) -> usize) -> Quads {
    let mut edges: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    let mut edge = |a: u32, b: u32| {
        let next = edges.len();
        *edges.entry([a.min(b), a.max(b)]).or_insert(next)
    };
    let sides: Vec<[usize; 4]> = quads
        .iter()
        .map(|q| [0, 1, 2, 3].map(|k| edge(q[k], q[(k + 1) % 4])))
        .collect();
    let mut strips = DisjointSets::new(edges.len());
    for side in &sides {
        strips.join(side[0], side[2]);
        strips.join(side[1], side[3]);
    }
    let mut number: BTreeMap<[i64; 3], u32> = BTreeMap::new();
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    for (quad, side) in quads.iter().zip(&sides) {
        let p = quad.map(|v| positions[v as usize]);
        let [m, n] = [0, 1].map(|k| parts(strips.root(side[k])));
        let mut at = |i: usize, j: usize| {
            let (s, t) = (i as f64 / m as f64, j as f64 / n as f64);
            let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
            let point = [0, 1, 2].map(|c| (0..4).map(|a| weights[a] * p[a][c]).sum::<f64>());
            let key = point.map(|x| (x * 1e6).round() as i64);
            *number.entry(key).or_insert_with(|| {
                points.push(point);
                points.len() as u32 - 1
            })
        };
        for (i, j) in (0..m * n).map(|q| (q % m, q / m)) {
            faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    (points, faces)
}

fn cube(k: usize) -> Quads {
    let positions = (0..8).map(|v| [0, 1, 2].map(|c| f64::from(v >> c & 1)));
    let quads = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    divided(&(positions.collect(), quads.to_vec()), k)
}

/// Every triangle of a shape divided into three quads, and these into `k` times `k`.
fn of_triangles(name: &str, triangles: usize, k: usize) -> Quads {
    let mesh = shape::by_name(name, triangles).unwrap();
    let mut positions = mesh.vertices().to_vec();
    let middle = |positions: &[Vec3], of: &[u32]| {
        let sum = |c: usize| of.iter().map(|&v| positions[v as usize][c]).sum::<f64>();
        [0, 1, 2].map(|c| sum(c) / of.len() as f64)
    };
    let mut of_edge: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    let mut quads = Vec::new();
    for f in 0..mesh.face_count() {
        let corners = mesh.triangles()[f];
        let middles = [0, 1, 2].map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            *of_edge.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push(middle(&positions, &[a, b]));
                positions.len() as u32 - 1
            })
        });
        positions.push(middle(&positions, &corners));
        let center = positions.len() as u32 - 1;
        quads.extend((0..3).map(|i| [corners[i], middles[i], center, middles[(i + 2) % 3]]));
    }
    divided(&(positions, quads), k)
}

fn surface((positions, quads): &Quads) -> QuadSurface {
    QuadSurface::new(positions.clone(), quads.clone()).unwrap()
}

/// Holds a layout to everything that a layout is: every quad in one patch, patches that are rectangles of the
/// surface, sides that are the arcs named, and Euler's formula.
fn check(surface: &QuadSurface, layout: &FoundLayout) {
    let mut count = vec![0; layout.patches.len()];
    for &patch in &layout.patch_of {
        count[patch as usize] += 1;
    }
    let quads: BTreeSet<[u32; 4]> = surface.quads().iter().copied().collect();
    for (patch, &count) in layout.patches.iter().zip(&count) {
        let [m, n] = patch.size;
        assert_eq!(count, m * n);
        for (i, j) in (0..m * n).map(|q| (q % m, q / m)) {
            let mut quad =
                [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(a, b)| patch.vertex(i + a, j + b));
            let is_there = (0..4).any(|_| {
                quad.rotate_left(1);
                quads.contains(&quad)
            });
            assert!(is_there, "{quad:?}");
        }
        for (k, side) in patch.sides.iter().enumerate() {
            let edges: usize = side
                .iter()
                .map(|&a| layout.arcs[a as usize].vertices.len() - 1)
                .sum();
            assert_eq!(edges, patch.size[k % 2]);
        }
        for corner in patch.corners() {
            assert!(layout.nodes.binary_search(&corner).is_ok());
        }
    }
    let euler = layout.nodes.len() as i64 - layout.arcs.len() as i64 + layout.patches.len() as i64;
    assert_eq!(euler, surface.euler_characteristic());
    for v in (0..surface.positions().len()).filter(|&v| surface.is_irregular(v)) {
        assert!(layout.nodes.binary_search(&(v as u32)).is_ok());
    }
}

fn both(quads: &Quads) -> [usize; 2] {
    let surface = surface(quads);
    let [base, motorcycle] = [
        FoundLayout::base_complex(&surface),
        FoundLayout::motorcycle_graph(&surface),
    ];
    check(&surface, &base);
    check(&surface, &motorcycle);
    assert_eq!(base.t_junctions(), 0);
    assert!(motorcycle.patches.len() <= base.patches.len());
    [base.patches.len(), motorcycle.patches.len()]
}

/// The number of regions that separatrices leave: an edge is one if it ends at an irregular vertex or goes straight
/// on from one. Edges are pairs of vertices; those opposite at a vertex share no quad.
fn regions(surface: &QuadSurface) -> usize {
    let mut quads_of: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    let mut edges_at: BTreeMap<u32, BTreeSet<[u32; 2]>> = BTreeMap::new();
    for (q, quad) in surface.quads().iter().enumerate() {
        for k in 0..4 {
            let (a, b) = (quad[k], quad[(k + 1) % 4]);
            let edge = [a.min(b), a.max(b)];
            quads_of.entry(edge).or_default().push(q);
            edges_at.entry(a).or_default().insert(edge);
            edges_at.entry(b).or_default().insert(edge);
        }
    }
    let is_boundary = |edge: &[u32; 2]| quads_of[edge].len() == 1;
    let boundary = |v: u32| edges_at[&v].iter().any(is_boundary);
    let irregular = |v: u32| edges_at[&v].len() != if boundary(v) { 3 } else { 4 };
    let mut walls: BTreeSet<[u32; 2]> = quads_of.keys().copied().filter(is_boundary).collect();
    let mut open: Vec<([u32; 2], u32)> = Vec::new();
    for (&v, edges) in edges_at.iter().filter(|&(&v, _)| irregular(v)) {
        open.extend(
            edges
                .iter()
                .map(|&edge| (edge, if edge[0] == v { edge[1] } else { edge[0] })),
        );
    }
    while let Some((edge, v)) = open.pop() {
        walls.insert(edge);
        if irregular(v) || boundary(v) {
            continue;
        }
        let shares = |other: &[u32; 2]| quads_of[other].iter().any(|q| quads_of[&edge].contains(q));
        let on = *edges_at[&v].iter().find(|other| !shares(other)).unwrap();
        open.push((on, if on[0] == v { on[1] } else { on[0] }));
    }
    let mut region = vec![usize::MAX; surface.quads().len()];
    let mut count = 0;
    for first in 0..region.len() {
        if region[first] != usize::MAX {
            continue;
        }
        let mut open = vec![first];
        while let Some(q) = open.pop() {
            if std::mem::replace(&mut region[q], count) == count {
                continue;
            }
            let sides = quads_of
                .iter()
                .filter(|(edge, of)| of.contains(&q) && !walls.contains(*edge));
            open.extend(
                sides
                    .flat_map(|(_, of)| of)
                    .filter(|&&o| region[o] != count),
            );
        }
        count += 1;
    }
    count
}

#[test]
fn a_cube_has_six_patches() {
    for k in [1, 2, 5] {
        assert_eq!(both(&cube(k)), [6, 6]);
        let layout = FoundLayout::base_complex(&surface(&cube(k)));
        assert_eq!((layout.nodes.len(), layout.arcs.len()), (8, 12));
        assert!(layout.patches.iter().all(|patch| patch.size == [k, k]));
    }
}

#[test]
fn a_rectangle_is_one_patch_and_so_is_a_ring_and_a_torus() {
    for (columns, rows) in [(1, 1), (4, 3), (7, 1)] {
        assert_eq!(both(&grid(columns, rows, [false, false], 0)), [1, 1]);
    }
    assert_eq!(both(&grid(5, 4, [true, false], 0)), [1, 1]);
    assert_eq!(both(&grid(5, 4, [true, true], 0)), [1, 1]);
}

#[test]
fn lines_of_a_twisted_torus_wind_until_they_close() {
    // A row closes at once, a column after as many rounds as the shift needs.
    for (shift, rounds) in [(1, 6), (2, 3), (3, 2)] {
        let torus = grid(6, 4, [true, true], shift);
        assert_eq!(both(&torus), [rounds, 1]);
        let layout = FoundLayout::motorcycle_graph(&surface(&torus));
        assert_eq!(layout.nodes.len(), 2);
    }
}

#[test]
fn an_irregular_vertex_on_the_boundary_starts_a_separatrix() {
    // Three squares around a corner: an L.
    let (positions, mut quads) = grid(2, 2, [false, false], 0);
    quads.pop();
    assert_eq!(both(&divided(&(positions[..8].to_vec(), quads), 3)), [3, 3]);
}

#[test]
fn a_base_complex_is_what_flood_fill_finds() {
    for (name, triangles) in [
        ("sphere", 60),
        ("torus", 80),
        ("genus-2", 150),
        ("disk", 40),
        ("plate-with-holes", 120),
    ] {
        for k in [1, 2] {
            let quads = of_triangles(name, triangles, k);
            let [base, _] = both(&quads);
            assert_eq!(base, regions(&surface(&quads)), "{name}");
        }
    }
}

/// The patches of the base complex, and of the simple one, which becomes a layout with every arc drawn.
fn simple(quads: &Quads) -> [usize; 2] {
    let surface = surface(quads);
    let base = FoundLayout::base_complex(&surface);
    let simple = FoundLayout::simple_complex(&surface);
    let drawn = simple.drawn(&surface).unwrap();
    assert_eq!(drawn.layout.polygons().len(), simple.patches.len());
    assert_eq!(drawn.curves.len(), simple.arcs.len());
    for (arc, points) in &drawn.curves {
        let ends = drawn.layout.arcs()[*arc].map(|v| drawn.layout.positions()[v as usize]);
        assert_eq!([points[0], points[points.len() - 1]], ends);
    }
    assert!(base.nodes.iter().all(|node| simple.nodes.contains(node)));
    [base.patches.len(), simple.patches.len()]
}

#[test]
fn arcs_that_join_the_same_nodes_are_divided() {
    assert_eq!(simple(&cube(3)), [6, 6]);
    assert_eq!(simple(&grid(5, 4, [false, false], 0)), [1, 1]);
    assert_eq!(simple(&grid(5, 4, [true, false], 0)), [1, 3]);
    assert_eq!(simple(&grid(5, 4, [true, true], 0)), [1, 9]);
    for name in ["genus-2", "torus", "disk"] {
        let [base, simple] = simple(&of_triangles(name, 60, 3));
        assert!(base <= simple, "{name}");
    }
}

#[test]
fn a_graph_with_t_junctions_is_no_layout() {
    let torus = surface(&grid(6, 4, [true, true], 2));
    let graph = FoundLayout::motorcycle_graph(&torus);
    assert!(graph.t_junctions() > 0);
    let error = graph.drawn(&torus).unwrap_err();
    assert!(error.to_string().contains("T-junction"), "{error}");
}

#[test]
fn strips_of_any_width_have_layouts() {
    let mut random = Random::new(3);
    for round in 0..40 {
        let name = ["sphere", "torus", "genus-2", "disk"][round % 4];
        let coarse = of_triangles(name, 60, 1);
        let widths: Vec<usize> = coarse
            .1
            .iter()
            .flat_map(|_| [1 + random.below(4), 1 + random.below(4)])
            .collect();
        both(&divided_by(&coarse, |strip| widths[strip % widths.len()]));
    }
}

#[test]
fn of_two_that_meet_at_a_right_angle_one_goes_on() {
    // A square without two opposite corners. The lines of the two reflex corners meet at the other two corners of
    // the square between them.
    let (positions, quads) = grid(6, 6, [false, false], 0);
    let is_out = |q: usize| q % 6 < 2 && q / 6 < 2 || q % 6 >= 4 && q / 6 >= 4;
    let kept = (0..36).filter(|&q| !is_out(q)).map(|q| quads[q]);
    assert_eq!(both(&compacted(&positions, kept.collect())), [7, 5]);
}

/// Quads with the vertices that they use.
fn compacted(positions: &[Vec3], quads: Vec<[u32; 4]>) -> Quads {
    let used: BTreeSet<u32> = quads.iter().flatten().copied().collect();
    let number: BTreeMap<u32, u32> = used.iter().copied().zip(0..).collect();
    let kept = used.iter().map(|&v| positions[v as usize]).collect();
    (kept, quads.iter().map(|q| q.map(|v| number[&v])).collect())
}

#[test]
fn numbers_of_vertices_and_quads_do_not_matter() {
    let mut random = Random::new(7);
    for quads in [
        cube(3),
        of_triangles("genus-2", 150, 2),
        of_triangles("disk", 60, 3),
        grid(6, 4, [true, true], 2),
    ] {
        let (positions, faces) = &quads;
        let order = permutation(&mut random, positions.len());
        let mut moved = vec![[0.0; 3]; positions.len()];
        for (v, &to) in order.iter().enumerate() {
            moved[to] = positions[v];
        }
        let mut renamed: Vec<[u32; 4]> = permutation(&mut random, faces.len())
            .iter()
            .map(|&f| faces[f])
            .collect();
        for (f, quad) in renamed.iter_mut().enumerate() {
            *quad = quad.map(|v| order[v as usize] as u32);
            quad.rotate_left(f % 4);
        }
        assert_eq!(both(&quads), both(&(moved, renamed)));
    }
}

#[test]
fn what_is_no_surface_of_quads_is_refused_with_its_element() {
    let (positions, quads) = grid(3, 2, [false, false], 0);
    let refused = |positions: &[Vec3], quads: &[[u32; 4]]| {
        QuadSurface::new(positions.to_vec(), quads.to_vec()).unwrap_err()
    };
    assert_eq!(refused(&positions, &[]), MeshError::NoFaces.into());
    let mut lost = positions.clone();
    lost[3][1] = f64::NAN;
    assert_eq!(
        refused(&lost, &quads),
        MeshError::NotFinite { vertex: 3 }.into()
    );
    let with = |f: usize, quad: [u32; 4]| {
        let mut quads = quads.clone();
        quads[f] = quad;
        quads
    };
    let [a, b, c, d] = quads[1];
    assert_eq!(
        refused(&positions, &with(1, [a, b, 99, d])),
        MeshError::IndexOutOfRange {
            face: 1,
            vertex: 99,
            vertices: 12
        }
        .into()
    );
    assert_eq!(
        refused(&positions, &with(1, [a, b, c, a])),
        MeshError::RepeatedVertex {
            face: 1,
            vertex: a as usize
        }
        .into()
    );
    assert!(matches!(
        refused(&positions, &with(1, [d, c, b, a])),
        FoundError::Mesh(MeshError::InconsistentOrientation { .. })
    ));
    let mut three = quads.clone();
    three.push([a, b, 8, 11]);
    assert!(matches!(
        refused(&positions, &three),
        FoundError::Mesh(
            MeshError::NonManifoldEdge { .. } | MeshError::InconsistentOrientation { .. }
        )
    ));
    let mut more = positions.clone();
    more.push([9.0; 3]);
    assert_eq!(
        refused(&more, &quads),
        MeshError::IsolatedVertex { vertex: 12 }.into()
    );
    let apart = [quads[0], quads[4]];
    let kept: Vec<u32> = vec![0, 1, 4, 5, 6, 9, 10];
    let renamed =
        apart.map(|quad| quad.map(|v| kept.iter().position(|&k| k == v).map_or(0, |k| k as u32)));
    assert_eq!(
        refused(&positions[..7], &renamed),
        MeshError::NonManifoldVertex { vertex: 3 }.into()
    );
    let mut soup = crate::soup::PolygonSoup::new(positions);
    soup.add_polygon([0, 1, 5, 4]);
    soup.add_polygon([1, 2, 6]);
    assert_eq!(
        QuadSurface::from_soup(&soup).unwrap_err(),
        FoundError::NotAQuad {
            face: 1,
            corners: 3
        }
    );
}

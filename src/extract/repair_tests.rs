//! The moves of `repair`, one by one, on drawings on the sphere small enough to be drawn by hand.

use super::graph::{Graph, Place, Walk};
use super::repair::repair;

/// The drawing whose vertices have these lines around them, counter-clockwise; a line is a letter,
/// named at both of its ends, or at one where it leaves the surface.
fn drawing(rings: &[&str]) -> Graph {
    let mut graph = Graph::default();
    let mut ends: Vec<(char, u32)> = Vec::new();
    for (vertex, ring) in rings.iter().enumerate() {
        let first = graph.port_count() as u32;
        graph.add(Place::Vertex(vertex as u32), &vec![0; ring.len()]);
        ends.extend(ring.chars().zip(first..));
    }
    ends.sort_unstable();
    for line in ends
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|ends| ends.len() == 2)
    {
        graph.join(line[0].1, line[1].1, 0);
    }
    graph
}

/// A cube, seen from above: the bottom's corners 0 to 3 around those of the top, 4 to 7.
///
/// ```text
/// 3 ------ c ------ 2
/// |  l           k  |
/// |    7 - g - 6    |
/// d    h       f    b
/// |    4 - e - 5    |
/// |  i           j  |
/// 0 ------ a ------ 1
/// ```
const CUBE: [&str; 8] = ["aid", "bja", "ckb", "dlc", "ehi", "fej", "gfk", "glh"];

/// The cube with some vertices, the first or new ones, drawn otherwise.
fn cube_but(changed: &[(usize, &'static str)]) -> Graph {
    let mut rings = CUBE.to_vec();
    for &(vertex, ring) in changed {
        rings.resize(rings.len().max(vertex + 1), "");
        rings[vertex] = ring;
    }
    drawing(&rings)
}

/// How many lines each vertex has that has any, and how many sides each cell, in increasing order.
fn figures(graph: &Graph) -> (Vec<usize>, Vec<usize>) {
    let mut lines = vec![0; graph.places.len()];
    for port in 0..graph.port_count() as u32 {
        if let Some(lines) = lines.get_mut(graph.vertex(port) as usize) {
            *lines += 1;
        }
    }
    lines.retain(|&lines| lines > 0);
    lines.sort_unstable();
    let mut sides = Vec::new();
    graph.for_each_cell(|cell, end| {
        assert_eq!(end, Walk::Closed);
        sides.push(cell.len());
    });
    sides.sort_unstable();
    // Still a drawing on the sphere.
    let ends: usize = lines.iter().sum();
    assert_eq!(lines.len() + sides.len(), ends / 2 + 2);
    (lines, sides)
}

#[track_caller]
fn assert_is_cube(graph: &Graph) {
    assert_eq!(figures(graph), (vec![3; 8], vec![4; 6]));
}

/// The vertices that lines lead to from this one, counter-clockwise from the least.
fn neighbours(graph: &Graph, vertex: u32) -> Vec<u32> {
    let mut ports = 0..graph.port_count() as u32;
    let first = ports.find(|&port| graph.vertex(port) == vertex).unwrap();
    let far = |&port: &u32| graph.vertex(graph.mate(port).unwrap());
    let mut found: Vec<u32> = graph.ring(first).iter().map(far).collect();
    let least = (0..found.len()).min_by_key(|&i| found[i]).unwrap();
    found.rotate_left(least);
    found
}

#[test]
fn quads_without_doublets_are_left_alone() {
    let mut cube = drawing(&CUBE);
    assert_is_cube(&cube);
    assert_eq!(repair(&mut cube), 0);
    assert_is_cube(&cube);
    assert_eq!(neighbours(&cube, 4), [0, 5, 7]);
}

#[test]
fn a_cell_of_two_sides_is_closed() {
    // Lines next to one edge of the cube, one and then two.
    let mut graph = cube_but(&[(0, "xaid"), (1, "bjax")]);
    assert_eq!(figures(&graph).1, [2, 4, 4, 4, 4, 4, 4]);
    assert_eq!(repair(&mut graph), 1);
    assert_is_cube(&graph);
    let mut graph = cube_but(&[(0, "yxaid"), (1, "bjaxy")]);
    assert_eq!(repair(&mut graph), 2);
    assert_is_cube(&graph);
    assert_eq!(neighbours(&graph, 0), [1, 4, 3]);
}

#[test]
fn lines_that_end_inside_of_a_cell_go() {
    let mut graph = cube_but(&[(0, "azid"), (8, "z")]);
    assert_eq!(figures(&graph).1, [4, 4, 4, 4, 4, 6]);
    assert_eq!(repair(&mut graph), 1);
    assert_is_cube(&graph);
    // A fork: its two tips, and then what is left of it.
    let mut graph = cube_but(&[(0, "azid"), (8, "zyx"), (9, "y"), (10, "x")]);
    assert_eq!(figures(&graph).1, [4, 4, 4, 4, 4, 10]);
    assert_eq!(repair(&mut graph), 3);
    assert_is_cube(&graph);
}

#[test]
fn a_loop_that_bounds_nothing_goes() {
    let mut graph = cube_but(&[(0, "azzid")]);
    assert_eq!(figures(&graph).1, [1, 4, 4, 4, 4, 4, 5]);
    assert_eq!(repair(&mut graph), 1);
    assert_is_cube(&graph);
}

#[test]
fn a_doublet_goes_with_the_edge_between_its_cells() {
    // On the cube's top, from corner to corner.
    let mut graph = cube_but(&[(4, "emhi"), (6, "gnfk"), (8, "mn")]);
    assert_eq!(
        figures(&graph),
        (vec![2, 3, 3, 3, 3, 3, 3, 4, 4], vec![4; 7])
    );
    assert_eq!(repair(&mut graph), 1);
    assert_is_cube(&graph);
    assert_eq!(neighbours(&graph, 4), [0, 5, 7]);
}

#[test]
fn no_doublet_is_taken_that_makes_another() {
    // The doublet, and on one of its quads a second one that ends at its vertex.
    let mut graph = cube_but(&[(4, "emhi"), (5, "fpej"), (6, "gnfk"), (8, "mqn"), (9, "pq")]);
    let before = figures(&graph);
    assert_eq!(before, (vec![2, 3, 3, 3, 3, 3, 3, 4, 4, 4], vec![4; 8]));
    assert_eq!(repair(&mut graph), 0);
    assert_eq!(figures(&graph), before);
}

/// Two poles, 0 and 1, and meridians between them with so many vertices each.
fn meridians(inner: &[usize]) -> Vec<String> {
    let mut names = 'A'..;
    let mut rings = vec![String::new(); 2];
    for &count in inner {
        let lines: Vec<char> = names.by_ref().take(count + 1).collect();
        rings[0].push(lines[0]);
        rings[1].insert(0, lines[count]);
        rings.extend(lines.windows(2).map(|pair| pair.iter().collect()));
    }
    rings
}

fn drawn(rings: &[String]) -> Graph {
    drawing(&rings.iter().map(String::as_str).collect::<Vec<_>>())
}

#[test]
fn no_surface_is_left_fewer_vertices_than_a_cube() {
    // Nothing but doublets.
    for count in 4..=10 {
        let mut graph = drawn(&meridians(&vec![1; count]));
        assert_eq!(figures(&graph).1, vec![4; count]);
        let expected = count.min(6);
        assert_eq!(repair(&mut graph), count - expected);
        let mut lines = vec![2; expected];
        lines.extend([expected; 2]);
        assert_eq!(figures(&graph), (lines, vec![4; expected]));
    }
    // A vertex that goes by another move does not count.
    let mut rings = meridians(&[1; 6]);
    rings[0].insert(0, 'z');
    rings.insert(0, "z".into());
    let mut graph = drawn(&rings);
    assert_eq!(repair(&mut graph), 1);
    assert_eq!(figures(&graph).1, [4; 6]);
}

#[test]
fn no_doublet_is_taken_that_is_not_between_two_quads() {
    // Between every other pair of meridians a cell of six sides.
    let mut graph = drawn(&meridians(&[3, 1, 1, 3, 1, 1]));
    assert_eq!(figures(&graph).1, [4, 4, 6, 6, 6, 6]);
    // The four cells are filled, and no vertex goes.
    assert_eq!(repair(&mut graph), 4);
    let (lines, sides) = figures(&graph);
    assert_eq!((lines.len(), sides), (16, vec![4; 14]));
}

#[test]
fn a_cell_of_six_sides_is_filled_through_its_corners_of_fewest_lines() {
    // One half of a cube, a corner and its three faces: the other half has the other corners.
    let half = ["af", "abx", "bc", "cdy", "de", "efz", "xyz"];
    for turn in 0..6 {
        let mut rings = half;
        rings[..6].rotate_left(turn as usize);
        let mut graph = drawing(&rings);
        assert_eq!(figures(&graph).1, [4, 4, 4, 6]);
        assert_eq!(repair(&mut graph), 1);
        assert_is_cube(&graph);
        let corners: Vec<u32> = (0..6).filter(|v| (v + turn) % 2 == 0).collect();
        let found = neighbours(&graph, 7);
        assert!(found == corners || found == [corners[0], corners[2], corners[1]]);
        let Place::Middle(members) = &graph.places[7] else {
            panic!("{:?}", graph.places[7]);
        };
        assert!(corners.iter().all(|corner| members.contains(corner)));
    }
}

#[test]
fn a_cell_of_eight_sides_is_filled_by_four_quads() {
    // Every other vertex of an octagon joined to a pole.
    let rings = ["ah", "abw", "bc", "cdx", "de", "efy", "fg", "ghz", "wxyz"];
    let mut graph = drawing(&rings);
    assert_eq!(figures(&graph).1, [4, 4, 4, 4, 8]);
    assert_eq!(repair(&mut graph), 1);
    assert_eq!(
        figures(&graph),
        (vec![3, 3, 3, 3, 3, 3, 3, 3, 4, 4], vec![4; 8])
    );
    assert_eq!(graph.ring(graph.port_count() as u32 - 1).len(), 3);
}

#[test]
fn cells_of_an_odd_number_of_sides_stay() {
    let mut graph = drawing(&["ag", "ba", "cb", "dc", "ed", "fe", "gf"]);
    assert_eq!(repair(&mut graph), 0);
    assert_eq!(figures(&graph), (vec![2; 7], vec![7, 7]));
}

#[test]
fn cells_that_the_border_of_the_surface_cuts_are_not_filled() {
    // A heptagon on both sides, one of them with a line that leaves the surface: eight lines there.
    let mut graph = drawing(&["axg", "ba", "cb", "dc", "ed", "fe", "gf"]);
    assert_eq!(repair(&mut graph), 0);
    let mut walks = Vec::new();
    graph.for_each_cell(|cell, end| walks.push((cell.len(), end)));
    assert_eq!(walks, [(8, Walk::Cut), (7, Walk::Closed)]);
}

#[test]
fn of_two_lines_between_the_same_vertices_one_goes() {
    // Vertices 0 and 1 joined by x and y, and on both sides of these by a path of three edges.
    let rings = ["axfy", "xcyd", "ab", "bc", "de", "ef"];
    let mut graph = drawing(&rings);
    assert_eq!(figures(&graph).1, [4; 4]);
    assert_eq!(repair(&mut graph), 1);
    let (lines, sides) = figures(&graph);
    assert_eq!((lines.len(), sides), (7, vec![4; 5]));
    let far = neighbours(&graph, 0);
    assert_eq!(far.iter().filter(|&&v| v == 1).count(), 1, "{far:?}");
}

#[test]
fn two_lines_between_the_same_vertices_stay_where_their_cells_are_no_quads() {
    // The same with paths of four edges: four cells of five sides.
    let rings = ["axhy", "xdye", "ab", "bc", "cd", "ef", "fg", "gh"];
    let mut graph = drawing(&rings);
    assert_eq!(figures(&graph).1, [5; 4]);
    assert_eq!(repair(&mut graph), 0);
    assert_eq!(figures(&graph).1, [5; 4]);
}

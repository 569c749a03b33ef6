//! Step 2, where asked for: vertices within a tolerance become one.
//!
//! Clusters are the connected components of the graph of all pairs within the tolerance, so that they do not
//! depend on the order of the vertices; the lowest vertex of each stands for it. Pairs are found with a
//! grid whose cells are so small that all vertices of a cell are within the tolerance of each other.

use std::collections::BTreeMap;

use super::lists::NONE;
use crate::linalg::vector::{Vec3, dot, sub};

/// The rows of cells that may hold a near vertex, without those that look back at this row.
const AHEAD: [(i64, i64); 13] = [
    (0, 0),
    (0, 1),
    (0, 2),
    (1, -2),
    (1, -1),
    (1, 0),
    (1, 1),
    (1, 2),
    (2, -2),
    (2, -1),
    (2, 0),
    (2, 1),
    (2, 2),
];

/// Welds further: `stands_for` holds the vertices already welded.
pub(super) fn within(positions: &[Vec3], tolerance: f64, stands_for: &mut [u32]) {
    // A little less than the side of a cube whose diagonal is the tolerance.
    let side = tolerance / 3f64.sqrt() * (1.0 - 1e-9);
    let mut cells: BTreeMap<[i64; 3], Vec<u32>> = BTreeMap::new();
    for (v, position) in positions.iter().enumerate() {
        if stands_for[v] != v as u32 {
            continue;
        }
        let cell = position.map(|x| (x / side).floor());
        // Farther out, numbers next to each other are farther apart than the tolerance.
        if cell.iter().all(|x| x.abs() < 9e15) {
            cells
                .entry(cell.map(|x| x as i64))
                .or_default()
                .push(v as u32);
        }
    }
    for members in cells.values() {
        for &v in &members[1..] {
            unite(stands_for, members[0], v);
        }
    }
    let near = |a: u32, b: u32| {
        let apart = sub(positions[a as usize], positions[b as usize]);
        dot(apart, apart) <= tolerance * tolerance
    };
    for (&[x, y, z], members) in &cells {
        for (dx, dy) in AHEAD {
            let low = [
                x + dx,
                y + dy,
                if (dx, dy) == (0, 0) { z + 1 } else { z - 2 },
            ];
            for (_, others) in cells.range(low..=[x + dx, y + dy, z + 2]) {
                if find(stands_for, members[0]) == find(stands_for, others[0]) {
                    continue;
                }
                if members.iter().any(|&a| others.iter().any(|&b| near(a, b))) {
                    unite(stands_for, members[0], others[0]);
                }
            }
        }
    }
    flatten(stands_for);
}

/// Lets every vertex name the vertex that stands for it at last.
pub(super) fn flatten(stands_for: &mut [u32]) {
    for v in 0..stands_for.len() {
        if stands_for[v] != NONE {
            stands_for[v] = find(stands_for, v as u32);
        }
    }
}

fn find(stands_for: &mut [u32], vertex: u32) -> u32 {
    let mut root = vertex;
    while stands_for[root as usize] != root {
        root = stands_for[root as usize];
    }
    let mut v = vertex;
    while v != root {
        v = std::mem::replace(&mut stands_for[v as usize], root);
    }
    root
}

fn unite(stands_for: &mut [u32], a: u32, b: u32) {
    let (a, b) = (find(stands_for, a), find(stands_for, b));
    stands_for[a.max(b) as usize] = a.min(b);
}

//! Whether arcs that are laid divide the surface as they divide the layout.
//!
//! Around nodes arcs follow each other as in the layout, and so the curves that bound the regions on both sides
//! correspond. What is left to check is that the same curves bound the same regions, with the same nodes inside,
//! and that these have the same Euler characteristic.

use super::surface::{NONE, Surface};
use crate::layout::base_layout::{BaseLayout, Dart};
use crate::linalg::DisjointSets;

/// Regions, each named by one of its cells.
struct Regions {
    /// The region of each cell.
    of: Vec<u32>,
    /// The Euler characteristic of the inside of each region, at the cell that names it.
    euler: Vec<i64>,
}

impl Regions {
    /// From pairs of cells that edges join.
    fn new(cells: usize, edges: &[[u32; 2]]) -> Self {
        let mut sets = DisjointSets::new(cells);
        for &[a, b] in edges {
            sets.join(a as usize, b as usize);
        }
        let of: Vec<u32> = (0..cells).map(|cell| sets.root(cell) as u32).collect();
        let mut euler = vec![0; cells];
        for &region in &of {
            euler[region as usize] += 1;
        }
        for &[a, _] in edges {
            euler[of[a as usize] as usize] -= 1;
        }
        Regions { of, euler }
    }

    fn add_vertex(&mut self, cell: u32) {
        self.euler[self.of[cell as usize] as usize] += 1;
    }

    fn names(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.of.len()).filter(|&cell| self.of[cell] as usize == cell)
    }
}

/// Whether the regions of the surface are those of the layout. `chains` has the vertices of each arc that is laid.
pub(super) fn are_those_of(
    layout: &BaseLayout,
    surface: &Surface,
    nodes: &[u32],
    chains: &[Vec<u32>],
) -> bool {
    let is_laid = |arc: usize| !chains[arc].is_empty();
    let open = (0..layout.arc_count()).filter(|&arc| !is_laid(arc));
    let joined: Vec<[u32; 2]> = open
        .filter_map(|arc| {
            let sides = [2 * arc, 2 * arc + 1].map(|dart| layout.polygon_left_of(dart as Dart));
            Some([sides[0]? as u32, sides[1]? as u32])
        })
        .collect();
    let mut wanted = Regions::new(layout.polygons().len(), &joined);
    let inner = (0..surface.twin.len()).filter(|&half| {
        let other = surface.twin[half];
        other != NONE && half < other as usize && surface.dart[half] == NONE
    });
    let across: Vec<[u32; 2]> = inner
        .map(|half| [half as u32 / 3, surface.twin[half] / 3])
        .collect();
    let mut found = Regions::new(surface.triangles.len(), &across);
    let mut pairs = Vec::new();
    let mut is_free = vec![true; surface.positions.len()];
    for half in 0..surface.dart.len() {
        let dart = surface.dart[half];
        if dart != NONE {
            is_free[surface.tail(half as u32) as usize] = false;
            is_free[surface.tip(half as u32) as usize] = false;
            match layout.polygon_left_of(dart) {
                Some(polygon) => pairs.push((polygon as u32, half as u32 / 3)),
                None => return false,
            }
        }
    }
    for (number, &node) in nodes.iter().enumerate() {
        if is_free[node as usize] {
            let cell = layout
                .around(number)
                .find_map(|dart| layout.polygon_left_of(dart));
            if let Some((cell, half)) = cell.zip(surface.around(node).next()) {
                wanted.add_vertex(cell as u32);
                pairs.push((cell as u32, half / 3));
            }
        }
    }
    for v in (0..surface.positions.len()).filter(|&v| is_free[v]) {
        if let Some(half) = surface.around(v as u32).next() {
            found.add_vertex(half / 3);
        }
    }
    correspond(&wanted, &found, &pairs)
}

/// Whether these pairs of cells match regions one to one, with equal characteristics.
fn correspond(wanted: &Regions, found: &Regions, pairs: &[(u32, u32)]) -> bool {
    let mut forth = vec![NONE; wanted.of.len()];
    let mut back = vec![NONE; found.of.len()];
    for &(polygon, face) in pairs {
        let (a, b) = (wanted.of[polygon as usize], found.of[face as usize]);
        for (partner, one, other) in [(&mut forth, a, b), (&mut back, b, a)] {
            let known = &mut partner[one as usize];
            if *known != NONE && *known != other {
                return false;
            }
            *known = other;
        }
    }
    let is_like = |region: usize| {
        let partner = forth[region] as usize;
        forth[region] != NONE && wanted.euler[region] == found.euler[partner]
    };
    wanted.names().all(is_like) && found.names().all(|region| back[region] != NONE)
}

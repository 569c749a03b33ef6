//! A layout of quads: nodes, arcs and patches, named by the vertices and quads of the surface.

use super::rectangle::Rectangle;
use super::walls::{LineEnd, Walls};
use super::{QuadSurface, base, motorcycle};
use crate::error::{Error, Result};
use crate::layout::{BaseLayout, DrawnLayout};
use crate::mesh::vector::Vec3;

const NONE: u32 = u32::MAX;

/// A division of quads into rectangles.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundLayout {
    /// The vertices where arcs meet, in increasing order.
    pub nodes: Vec<u32>,
    /// The lines between nodes.
    pub arcs: Vec<LayoutArc>,
    /// The rectangles.
    pub patches: Vec<LayoutPatch>,
    /// The patch of every quad.
    pub patch_of: Vec<u32>,
}

/// A line of edges of quads between two nodes, without nodes between.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LayoutArc {
    /// Its ends, as numbers of nodes.
    pub nodes: [u32; 2],
    /// Its vertices from end to end: one more than the number of its quads, `n_e`.
    pub vertices: Vec<u32>,
}

/// A rectangle of quads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LayoutPatch {
    /// The number of quads along the first side, and along the second.
    pub size: [usize; 2],
    /// Its `size[0] + 1` times `size[1] + 1` vertices, in rows along the first side.
    pub vertices: Vec<u32>,
    /// The arcs of each side, counter-clockwise around the patch. In a base complex each side is one arc; where there
    /// are T-junctions on it, it has several.
    pub sides: [Vec<u32>; 4],
}

impl LayoutPatch {
    fn has_t_junction(&self) -> bool {
        self.sides.iter().any(|side| side.len() > 1)
    }

    /// The vertex in a column and a row.
    pub fn vertex(&self, column: usize, row: usize) -> u32 {
        self.vertices[row * (self.size[0] + 1) + column]
    }

    /// The vertices at its corners, counter-clockwise.
    pub fn corners(&self) -> [u32; 4] {
        let [m, n] = self.size;
        [(0, 0), (m, 0), (m, n), (0, n)].map(|(i, j)| self.vertex(i, j))
    }

    /// Whether side `k` begins, counter-clockwise around the patch, as these vertices do.
    pub(super) fn runs_along(&self, k: usize, vertices: &[u32]) -> bool {
        let [m, n] = self.size;
        let first = [
            [(0, 0), (1, 0)],
            [(m, 0), (m, 1)],
            [(m, n), (m - 1, n)],
            [(0, n), (0, n - 1)],
        ];
        vertices.starts_with(&first[k].map(|(i, j)| self.vertex(i, j)))
    }
}

impl FoundLayout {
    /// The base complex: all separatrices, which cross each other and run on to irregular vertices or the boundary.
    ///
    /// A part of the surface without corners, a ring or a torus, is opened by more lines: a torus by the shorter line
    /// through its lowest vertex, and a ring by the line across it that has the fewest edges, of equals by that from
    /// the lowest vertex.
    pub fn base_complex(surface: &QuadSurface) -> Self {
        Self::between(base::walls(surface), LineEnd::Closed)
    }

    /// The motorcycle graph: separatrices that start at once, advance at one speed, and stop where they meet the
    /// trail of another. Patches are rectangles, but their corners may be on the sides of others (T-junctions).
    ///
    /// Lines are added as to the base complex, but end at the first wall.
    pub fn motorcycle_graph(surface: &QuadSurface) -> Self {
        Self::between(motorcycle::walls(surface), LineEnd::Wall)
    }

    /// The base complex, divided by further lines until two nodes have one arc between them at most, and no arc returns
    /// to its node: the form that a [`BaseLayout`](crate::layout::BaseLayout) has.
    pub fn simple_complex(surface: &QuadSurface) -> Self {
        let mut walls = base::walls(surface);
        walls.rectangles(LineEnd::Closed);
        while walls.divide_a_parallel_arc() {}
        Self::between(walls, LineEnd::Closed)
    }

    fn between(mut walls: Walls, end: LineEnd) -> Self {
        let rectangles = walls.rectangles(end);
        let surface = walls.surface;
        let nodes = walls.nodes();
        let (arcs, arc_of) = arcs(&walls, &nodes);
        let mut patch_of = vec![NONE; surface.quads().len()];
        for (patch, rectangle) in rectangles.iter().enumerate() {
            for &bottom in &rectangle.bottoms {
                patch_of[bottom as usize / 4] = patch as u32;
            }
        }
        let patches = rectangles
            .iter()
            .map(|rectangle| patch(surface, rectangle, &arc_of));
        FoundLayout {
            patches: patches.collect(),
            nodes,
            arcs,
            patch_of,
        }
    }

    /// The layout whose vertices are the nodes and whose polygons are the patches, with all arcs drawn. That of
    /// a [`simple_complex`](Self::simple_complex) leads back to quads.
    ///
    /// # Errors
    /// Those of [`BaseLayout::new`], with the patch or the node, where arcs join the same nodes or a patch has a node
    /// twice; [`Error::InvalidArgument`] with the patch for a T-junction.
    pub fn drawn(&self, surface: &QuadSurface) -> Result<DrawnLayout> {
        let place = |&v: &u32| surface.positions()[v as usize];
        let number = |v: u32| self.nodes.partition_point(|&node| node < v) as u32;
        if let Some(patch) = self.patches.iter().position(LayoutPatch::has_t_junction) {
            return Err(Error::InvalidArgument {
                what: format!("patch {patch} has a T-junction on a side; a layout has none"),
                index: Some(patch),
            });
        }
        let corners = |patch: &LayoutPatch| patch.corners().map(number).to_vec();
        let layout = BaseLayout::new(
            self.nodes.iter().map(place).collect(),
            self.patches.iter().map(corners).collect(),
        )?;
        let mut curves = Vec::with_capacity(self.arcs.len());
        for arc in &self.arcs {
            let [from, to] = arc.nodes.map(|node| node as usize);
            if let Some(number) = layout.arc_between(from, to) {
                let mut points: Vec<Vec3> = arc.vertices.iter().map(place).collect();
                if layout.arcs()[number][0] as usize != from {
                    points.reverse();
                }
                curves.push((number, points));
            }
        }
        Ok(DrawnLayout { layout, curves })
    }

    /// The number of nodes on sides of patches.
    pub fn t_junctions(&self) -> usize {
        let arcs = self.patches.iter().flat_map(|patch| &patch.sides);
        arcs.map(|side| side.len() - 1).sum()
    }
}

/// The lines of walls between nodes, and the line of every half-edge that is a wall.
pub(super) fn arcs(walls: &Walls, nodes: &[u32]) -> (Vec<LayoutArc>, Vec<u32>) {
    let surface = walls.surface;
    let mut node_of = vec![NONE; surface.positions().len()];
    for (node, &v) in nodes.iter().enumerate() {
        node_of[v as usize] = node as u32;
    }
    let mut arc_of = vec![NONE; surface.half_edges()];
    let mut arcs = Vec::new();
    for (node, &from) in nodes.iter().enumerate() {
        for first in surface.around(from as usize) {
            if !walls.contains(first) || arc_of[first] != NONE {
                continue;
            }
            let mut vertices = vec![from];
            let mut h = first;
            let end = loop {
                arc_of[h] = arcs.len() as u32;
                arc_of[surface.twin(h)] = arcs.len() as u32;
                let v = surface.to(h);
                vertices.push(v);
                if node_of[v as usize] != NONE {
                    break node_of[v as usize];
                }
                let back = surface.twin(h);
                let mut others = surface.around(v as usize);
                // There is one: the wall goes on where it has no node.
                h = others
                    .find(|&o| o != back && walls.contains(o))
                    .unwrap_or(back);
            };
            arcs.push(LayoutArc {
                nodes: [node as u32, end],
                vertices,
            });
        }
    }
    (arcs, arc_of)
}

fn patch(surface: &QuadSurface, rectangle: &Rectangle, arc_of: &[u32]) -> LayoutPatch {
    let [columns, rows] = rectangle.size;
    let bottoms = rectangle.bottoms.chunks(columns);
    let mut vertices = Vec::with_capacity((columns + 1) * (rows + 1));
    for row in bottoms {
        vertices.extend(row.iter().map(|&h| surface.from(h as usize)));
        vertices.push(surface.to(row[columns - 1] as usize));
    }
    let top = rectangle.sides[2].iter().rev();
    vertices.extend(top.map(|&h| surface.to(h as usize)));
    vertices.push(surface.from(rectangle.sides[2][0] as usize));
    let sides = rectangle.sides.each_ref().map(|side| {
        let mut arcs: Vec<u32> = side.iter().map(|&h| arc_of[h as usize]).collect();
        arcs.dedup();
        arcs
    });
    LayoutPatch {
        size: rectangle.size,
        vertices,
        sides,
    }
}

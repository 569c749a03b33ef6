//! Closes the gaps that the map leaves in the chains of quad edges along curves.
//!
//! A curve is an isoline, so quads have a chain of edges along it. But where the map folds, some vertices of
//! the chain lie beside the curve, and where a curve ends on the surface there may be no integer point. Every
//! node of the curves therefore gets the nearest vertex of the chain. The shortest path through vertices
//! beside the curve closes each gap, and the vertices of the path are spread evenly.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use super::quality::scaled_jacobian;
use super::square::mean_edge;
use super::surface::{Bond, Surface};
use crate::extract::QuadMesh;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{Vec3, norm, sub};

/// The largest number of vertices that close a gap.
const LONGEST: usize = 8;

/// The largest distance of these vertices from the curve, in mean edge lengths.
const NEAR: f64 = 1.0;

/// The cost of a step in addition to the distance from the curve, in mean edge lengths.
const STEP: f64 = 0.2;

/// Binds vertices to curves and nodes, and moves them there.
pub(super) fn close(quads: &mut QuadMesh, mesh: &TriangleMesh, surface: &mut Surface) {
    if surface.curves.is_empty() {
        return;
    }
    let mut on_curve = vec![Vec::new(); surface.curves.len()];
    let mut at_node = vec![Vec::new(); mesh.vertex_count()];
    for v in 0..quads.vertices.len() {
        match (surface.bonds[v], surface.node[v]) {
            (Bond::Curve(curve), _) => on_curve[curve as usize].push(v as u32),
            (_, Some(node)) => at_node[node].push(v as u32),
            _ => {}
        }
    }
    let mut chains = Chains {
        on_curve,
        at_node,
        neighbours: neighbours(quads),
        quads_at: quads.around(),
        edge: mean_edge(quads),
        quads,
        surface,
    };
    chains.take_nodes(mesh);
    for curve in 0..chains.surface.curves.len() {
        chains.close(curve);
    }
}

/// The neighbours of every vertex, in increasing order.
fn neighbours(quads: &QuadMesh) -> Vec<Vec<u32>> {
    let mut neighbours = vec![Vec::new(); quads.vertices.len()];
    for face in quads.faces() {
        for (&a, &b) in face.iter().zip(face.iter().cycle().skip(1)) {
            neighbours[a as usize].push(b);
            neighbours[b as usize].push(a);
        }
    }
    for list in &mut neighbours {
        list.sort_unstable();
        list.dedup();
    }
    neighbours
}

struct Chains<'a> {
    quads: &'a mut QuadMesh,
    surface: &'a mut Surface,
    /// The vertices on each curve before any vertex was moved.
    on_curve: Vec<Vec<u32>>,
    /// The vertices at each node of the curves, by vertex of the mesh.
    at_node: Vec<Vec<u32>>,
    neighbours: Vec<Vec<u32>>,
    /// The quads at every vertex.
    quads_at: Vec<Vec<u32>>,
    edge: f64,
}

impl Chains<'_> {
    /// The vertices on a curve with their arc lengths, in order, including those at its ends.
    fn members(&self, curve: usize) -> Vec<(f64, u32)> {
        let line = &self.surface.curves[curve];
        let mut members = Vec::new();
        for &v in &self.on_curve[curve] {
            if self.surface.bonds[v as usize] == Bond::Curve(curve as u32) {
                members.push((line.arc(self.quads.vertices[v as usize]).0, v));
            }
        }
        for (end, arc) in line.ends.into_iter().zip([0.0, line.length()]) {
            members.extend(self.at_node[end].iter().map(|&v| (arc, v)));
        }
        members.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        members
    }

    /// Fixes a vertex at every node that has none: the nearest of the last vertices of its chains and
    /// their neighbours.
    fn take_nodes(&mut self, mesh: &TriangleMesh) {
        for curve in 0..self.surface.curves.len() {
            let ends = self.surface.curves[curve].ends;
            if ends[0] == ends[1] {
                continue;
            }
            for (end, node) in ends.into_iter().enumerate() {
                if !self.at_node[node].is_empty() {
                    continue;
                }
                let members = self.members(curve);
                let last = [members.first(), members.last()][end];
                let Some(&(_, last)) = last else {
                    continue;
                };
                let place = mesh.position(node);
                let far = |&v: &u32| norm(sub(self.quads.vertices[v as usize], place));
                let around = self.neighbours[last as usize].iter().copied();
                let free = around.filter(|&v| self.is_free(v));
                let is_bound = |&v: &u32| self.surface.node[v as usize].is_none();
                let candidates = free.chain(Some(last).filter(is_bound));
                let nearest = candidates.min_by(|a, b| far(a).total_cmp(&far(b)));
                let near = nearest.filter(|v| far(v) < NEAR * self.edge);
                if let Some(v) = near.filter(|&v| self.moves(&[v], &[place])) {
                    self.at_node[node].push(v);
                    self.surface.bonds[v as usize] = Bond::Fixed;
                    self.surface.node[v as usize] = Some(node);
                    self.surface.fixed[v as usize] = place;
                }
            }
        }
    }

    fn is_free(&self, v: u32) -> bool {
        self.surface.bonds[v as usize] == Bond::Surface
    }

    /// Closes the gaps of one curve.
    fn close(&mut self, curve: usize) {
        let mut members = self.members(curve);
        let Some(&first) = members.first() else {
            return;
        };
        let line = &self.surface.curves[curve];
        let is_loop = line.ends[0] == line.ends[1];
        if is_loop && self.surface.bonds[first.1 as usize] != Bond::Fixed {
            members.push((first.0 + line.length(), first.1));
        }
        for pair in members.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            if from.1 == to.1 || self.neighbours[from.1 as usize].contains(&to.1) {
                continue;
            }
            let way = self.way(curve, from, to);
            let part = (to.0 - from.0) / (way.len() + 1) as f64;
            let line = &self.surface.curves[curve];
            let places = (0..way.len()).map(|i| line.point(from.0 + (i + 1) as f64 * part));
            let places: Vec<Vec3> = places.collect();
            if self.moves(&way, &places) {
                for v in way {
                    self.surface.bonds[v as usize] = Bond::Curve(curve as u32);
                }
            }
        }
    }

    /// Moves all vertices to these places. Moves none if that would invert a quad.
    fn moves(&mut self, way: &[u32], places: &[Vec3]) -> bool {
        let around = way.iter().flat_map(|&v| &self.quads_at[v as usize]);
        let around: BTreeSet<u32> = around.copied().collect();
        let before: Vec<Vec3> = way
            .iter()
            .map(|&v| self.quads.vertices[v as usize])
            .collect();
        let inverted = |quads: &QuadMesh| {
            let corners = |&q: &u32| quads.quads[q as usize].map(|v| quads.vertices[v as usize]);
            let jacobians = around.iter().map(corners).map(scaled_jacobian);
            jacobians.filter(|&jacobian| jacobian <= 0.0).count()
        };
        let put = |quads: &mut QuadMesh, places: &[Vec3]| {
            for (&v, &place) in way.iter().zip(places) {
                quads.vertices[v as usize] = place;
            }
        };
        let allowed = inverted(self.quads);
        put(self.quads, places);
        let is_good = inverted(self.quads) <= allowed;
        if !is_good {
            put(self.quads, &before);
        }
        is_good
    }

    /// The free vertices on the cheapest path between two vertices. Empty if there is no path near the curve.
    fn way(&self, curve: usize, from: (f64, u32), to: (f64, u32)) -> Vec<u32> {
        /// Costs are integers, because integers have a total order.
        const UNIT: f64 = 1e6;
        let line = &self.surface.curves[curve];
        let cost = |v: u32| -> Option<u64> {
            let (arc, off) = line.arc(self.quads.vertices[v as usize]);
            // Around a loop, the arc that is between them.
            let arc = if arc < from.0 {
                arc + line.length()
            } else {
                arc
            };
            let beyond = if arc > to.0 { arc - to.0 } else { 0.0 };
            let beyond = beyond.min((from.0 + line.length() - arc).max(0.0));
            let off = (off + beyond) / self.edge;
            (off < NEAR).then_some(((off + STEP) * UNIT) as u64)
        };
        let mut open = BinaryHeap::from([Reverse((0, 0, from.1, from.1))]);
        let mut before: BTreeMap<u32, u32> = BTreeMap::new();
        while let Some(Reverse((spent, steps, v, last))) = open.pop() {
            if before.contains_key(&v) {
                continue;
            }
            before.insert(v, last);
            if v == to.1 {
                let mut way = Vec::new();
                let mut at = last;
                while at != from.1 {
                    way.push(at);
                    at = before[&at];
                }
                way.reverse();
                return way;
            }
            for &next in &self.neighbours[v as usize] {
                if next == to.1 && v != from.1 {
                    open.push(Reverse((spent, steps, next, v)));
                } else if steps < LONGEST
                    && self.is_free(next)
                    && let Some(more) = cost(next)
                {
                    open.push(Reverse((spent + more, steps + 1, next, v)));
                }
            }
        }
        Vec::new()
    }
}

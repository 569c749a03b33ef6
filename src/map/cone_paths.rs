//! Shortest paths from a cut graph to the cones that it does not reach yet.
//!
//! One sweep of Dijkstra's algorithm starts from the cut graph and the boundary. When it settles a
//! cone, the path to the cone joins the cut graph, and its vertices become sources at distance
//! zero. Every cone thus joins what is nearest to it at that time (the shortest-path heuristic for
//! Steiner trees, `takahashi1980`).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::error::Result;
use crate::mesh::{Components, TriangleMesh};
use crate::monitor::{collect_in_parts, may_continue_at};

/// The least number of edges that are worth a thread.
const LEAST: usize = 1 << 14;

/// Adds the paths to `is_cut`.
pub(super) fn join_cones(mut sweep: Sweep, cones: &[usize], is_cut: &mut [bool]) -> Result<()> {
    let mesh = sweep.mesh;
    for (e, edge) in mesh.edges().enumerate() {
        if is_cut[e] || edge.second.is_none() {
            edge.vertices.into_iter().for_each(|v| sweep.start(v));
        }
    }
    let seeds = sweep.seed_closed_spheres(cones);
    sweep.run(is_cut)?;
    for seed in seeds {
        // A sphere is a disk only when an edge is cut, not when a vertex is marked.
        let mut spokes = mesh.ring(seed).map(|(f, k)| mesh.edge_of(f, k));
        if let Some(lowest) = mesh.ring(seed).map(|(f, k)| mesh.edge_of(f, k)).min()
            && !spokes.any(|e| is_cut[e])
        {
            is_cut[lowest] = true;
        }
    }
    Ok(())
}

/// The sweep, which starts from nothing yet.
pub(super) struct Sweep<'a> {
    mesh: &'a TriangleMesh,
    components: Components,
    /// The length of every edge.
    length: Vec<f64>,
    distance: Vec<f64>,
    /// The edge over which a vertex is reached.
    via: Vec<u32>,
    /// Cones not yet joined.
    is_open: Vec<bool>,
    /// By distance, ties by number. Distances are not negative, so their bits sort as they do.
    heap: BinaryHeap<Reverse<(u64, u32)>>,
}

impl<'a> Sweep<'a> {
    pub(super) fn new(mesh: &'a TriangleMesh, cones: &[usize]) -> Self {
        let mut is_open = vec![false; mesh.vertex_count()];
        cones.iter().for_each(|&v| is_open[v] = true);
        let length = |e| {
            let (face, k) = mesh.edge(e).first;
            mesh.edge_length(face, k)
        };
        Sweep {
            mesh,
            components: mesh.components(),
            length: collect_in_parts(mesh.edge_count(), LEAST, length),
            distance: vec![f64::INFINITY; mesh.vertex_count()],
            via: vec![0; mesh.vertex_count()],
            is_open,
            heap: BinaryHeap::new(),
        }
    }

    /// Makes a vertex one from which paths start.
    fn start(&mut self, v: usize) {
        self.is_open[v] = false;
        if self.distance[v] != 0.0 {
            self.reach(v, 0.0);
        }
    }

    fn reach(&mut self, v: usize, distance: f64) {
        self.distance[v] = distance;
        self.heap.push(Reverse((distance.to_bits(), v as u32)));
    }

    /// Starts at one vertex of every component that has neither cut nor boundary, and returns
    /// these: the lowest cone there, or the lowest vertex.
    fn seed_closed_spheres(&mut self, cones: &[usize]) -> Vec<usize> {
        let components = &self.components;
        let of_vertex = |v: usize| {
            let face = self.mesh.ring(v).next().map_or(0, |(face, _)| face);
            components.of_face[face] as usize
        };
        let mut has_start = vec![false; components.count];
        for v in 0..self.distance.len() {
            has_start[of_vertex(v)] |= self.distance[v] == 0.0;
        }
        let mut sorted = cones.to_vec();
        sorted.sort_unstable();
        let mut seeds = Vec::new();
        for v in sorted.into_iter().chain(0..self.distance.len()) {
            if !has_start[of_vertex(v)] {
                has_start[of_vertex(v)] = true;
                seeds.push(v);
            }
        }
        seeds.iter().for_each(|&v| self.start(v));
        seeds
    }

    fn run(&mut self, is_cut: &mut [bool]) -> Result<()> {
        let mut open = self.is_open.iter().filter(|&&c| c).count();
        let mut settled = 0;
        while open > 0 {
            may_continue_at(settled)?;
            settled += 1;
            let Some(Reverse((bits, v))) = self.heap.pop() else {
                break;
            };
            let (distance, v) = (f64::from_bits(bits), v as usize);
            if distance > self.distance[v] {
                continue;
            }
            if self.is_open[v] {
                open -= 1;
                self.join(v, is_cut);
            } else {
                self.relax(v, distance);
            }
        }
        Ok(())
    }

    fn relax(&mut self, v: usize, distance: f64) {
        let mesh = self.mesh;
        for (face, k) in mesh.ring(v) {
            let tip = mesh.corners(face)[(k + 1) % 3];
            let edge = mesh.edge_of(face, k);
            let farther = distance + self.length[edge];
            if farther < self.distance[tip] {
                self.via[tip] = edge as u32;
                self.reach(tip, farther);
            }
        }
    }

    /// Cuts the path to `cone`, and starts from all its vertices.
    fn join(&mut self, cone: usize, is_cut: &mut [bool]) {
        let mut v = cone;
        while self.distance[v] > 0.0 {
            let edge = self.via[v] as usize;
            is_cut[edge] = true;
            self.start(v);
            let [a, b] = self.mesh.edge(edge).vertices;
            v = if v == a { b } else { a };
        }
    }
}

//! Feature edges taken apart into curves between nodes.

use super::{CORNER_TURN, FeatureCurve, FeatureGraph};
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{cross, dot, norm, sub};

impl FeatureGraph {
    /// The graph of the marked edges.
    pub(super) fn of(mesh: &TriangleMesh, is_feature: Vec<bool>) -> Self {
        let spokes = Spokes::new(mesh, &is_feature);
        let mut degree = vec![0; mesh.vertex_count()];
        for &v in &spokes.vertices {
            degree[v] = spokes.of(v).len() as u32;
        }
        let vertices = spokes.vertices.iter().copied();
        let is_corner = |&v: &usize| is_corner(mesh, &spokes, v);
        let corners: Vec<usize> = vertices.clone().filter(is_corner).collect();
        let open_ends: Vec<usize> = vertices.filter(|&v| degree[v] == 1).collect();
        let mut is_node = vec![false; mesh.vertex_count()];
        for &v in corners.iter().chain(&open_ends) {
            is_node[v] = true;
        }
        let curves = curves(mesh, &spokes, &is_node);
        FeatureGraph {
            is_feature,
            degree,
            corners,
            open_ends,
            curves,
        }
    }
}

/// The feature edges at every vertex, in increasing order.
struct Spokes {
    /// The vertices with feature edges, in increasing order.
    vertices: Vec<usize>,
    start: Vec<u32>,
    edge: Vec<u32>,
}

impl Spokes {
    fn new(mesh: &TriangleMesh, is_feature: &[bool]) -> Self {
        let mut ends: Vec<(u32, u32)> = Vec::new();
        for e in (0..is_feature.len()).filter(|&e| is_feature[e]) {
            let vertices = mesh.edge(e).vertices;
            ends.extend(vertices.map(|v| (v as u32, e as u32)));
        }
        ends.sort_unstable();
        let mut start = vec![0; mesh.vertex_count() + 1];
        for &(v, _) in &ends {
            start[v as usize + 1] += 1;
        }
        for v in 0..mesh.vertex_count() {
            start[v + 1] += start[v];
        }
        let mut vertices: Vec<usize> = ends.iter().map(|&(v, _)| v as usize).collect();
        vertices.dedup();
        let edge = ends.into_iter().map(|(_, e)| e).collect();
        Spokes {
            vertices,
            start,
            edge,
        }
    }

    fn of(&self, vertex: usize) -> &[u32] {
        &self.edge[self.start[vertex] as usize..self.start[vertex + 1] as usize]
    }
}

fn is_corner(mesh: &TriangleMesh, spokes: &Spokes, vertex: usize) -> bool {
    match *spokes.of(vertex) {
        [] | [_] => false,
        [a, b] => {
            let [a, b] = [a, b].map(|e| {
                let tip = other_end(mesh, e as usize, vertex);
                sub(mesh.position(tip), mesh.position(vertex))
            });
            norm(cross(a, b)).atan2(-dot(a, b)) > CORNER_TURN
        }
        _ => true,
    }
}

fn other_end(mesh: &TriangleMesh, edge: usize, vertex: usize) -> usize {
    let [a, b] = mesh.edge(edge).vertices;
    if a == vertex { b } else { a }
}

fn curves(mesh: &TriangleMesh, spokes: &Spokes, is_node: &[bool]) -> Vec<FeatureCurve> {
    let mut is_done = vec![false; mesh.edge_count()];
    let mut curves = Vec::new();
    // What is left once all curves at nodes are followed are loops without one.
    for starts_at_node in [true, false] {
        let vertices = spokes.vertices.iter().copied();
        for v in vertices.filter(|&v| is_node[v] == starts_at_node) {
            for &e in spokes.of(v) {
                if !is_done[e as usize] {
                    curves.push(follow(mesh, spokes, is_node, &mut is_done, v, e as usize));
                }
            }
        }
    }
    curves
}

fn follow(
    mesh: &TriangleMesh,
    spokes: &Spokes,
    is_node: &[bool],
    is_done: &mut [bool],
    start: usize,
    first: usize,
) -> FeatureCurve {
    let mut curve = FeatureCurve {
        edges: Vec::new(),
        vertices: vec![start],
    };
    let (mut v, mut next) = (start, Some(first));
    while let Some(e) = next {
        is_done[e] = true;
        v = other_end(mesh, e, v);
        curve.edges.push(e);
        curve.vertices.push(v);
        let mut onward = spokes.of(v).iter().map(|&e| e as usize);
        next = onward.find(|&e| !is_done[e]).filter(|_| !is_node[v]);
    }
    curve
}

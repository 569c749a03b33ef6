//! Faces cut so that curves on the surface are chains of edges.
//!
//! Points of a curve become vertices, in a face or on an edge, and straight pieces between them become edges: where an
//! edge lies across, it is split. Delaunay flips inside each face follow, and leave edges of curves as they are.

use std::collections::BTreeMap;

use super::diagonal;
use super::flat::Regions;
use super::refined::Refined;
use super::simplify::simplified;
use super::working_mesh::{WorkingMesh, next};
use crate::error::{Error, Result};
use crate::mesh::connectivity::NONE;
use crate::mesh::features::{FeatureGraph, edge_between};
use crate::mesh::vector::{Vec3, add, dot, norm, scale, sub};
use crate::mesh::{TriangleMesh, closest_on_segment, orientation};
use crate::monitor::may_continue_at;

/// A curve runs through a vertex that is nearer than this part of the shortest edge of the face, and than
/// [`MOST_SNAP`].
const SNAP: f64 = 0.1;

/// The same as a part of the diagonal of the bounding box.
const MOST_SNAP: f64 = 1e-3;

/// The most edges that one piece may cross inside a face, besides two for each part of the face.
const CROSSINGS: usize = 64;

/// A straight piece of a curve in a face: the weights of the corners where it begins and ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Piece {
    pub(crate) face: usize,
    pub(crate) from: [f64; 3],
    pub(crate) to: [f64; 3],
}

impl Piece {
    /// Its ends in space.
    pub(crate) fn ends(&self, mesh: &TriangleMesh) -> [Vec3; 2] {
        [self.from, self.to].map(|weights| point_of(mesh, self.face, weights))
    }
}

fn point_of(mesh: &TriangleMesh, face: usize, weights: [f64; 3]) -> Vec3 {
    let corners = mesh.corner_positions(face);
    let parts = [0, 1, 2].map(|k| scale(corners[k], weights[k]));
    add(add(parts[0], parts[1]), parts[2])
}

/// A mesh whose faces are cut along curves.
#[derive(Debug, Clone)]
pub struct CutAlong {
    /// The mesh, and what its elements are on the one that was given.
    pub cut: Refined,
    /// The edges of each curve, in its order; an edge twice where the curve returns along it.
    pub curves: Vec<Vec<usize>>,
}

impl CutAlong {
    /// The edges of all curves, in increasing order.
    pub fn edges(&self) -> Vec<usize> {
        let mut edges = self.curves.concat();
        edges.sort_unstable();
        edges.dedup();
        edges
    }
}

/// Cuts a mesh along curves, each as pieces that follow each other.
pub(crate) fn cut_along_pieces(mesh: &TriangleMesh, curves: &[Vec<Piece>]) -> Result<CutAlong> {
    let regions = Regions::of_single_faces(mesh);
    let mut cut = Cut::new(mesh, &regions);
    let mut chains = Vec::with_capacity(curves.len());
    for (number, pieces) in curves.iter().enumerate() {
        let pieces = simplified(mesh, &from_an_edge(pieces), |face| cut.near[face]);
        let chain = cut.curve(number, &pieces)?;
        if chain.len() < 2 {
            return Err(Error::InvalidArgument {
                what: format!("curve {number} is too short: nothing of it is left on the mesh"),
                index: Some(number),
            });
        }
        chains.push(chain);
    }
    let split = cut.split;
    let cut = cut.work.finish(true)?;
    let edges = |chain: &Vec<u32>| {
        let mut edges = Vec::with_capacity(chain.len());
        for pair in chain.windows(2) {
            edges_between(&cut.mesh, &split, [pair[0], pair[1]], &mut edges);
        }
        edges
    };
    let curves = chains.iter().map(edges).collect();
    Ok(CutAlong { cut, curves })
}

/// A closed curve that starts inside a face, from an edge on: so it needs no vertex where it started.
fn from_an_edge(pieces: &[Piece]) -> Vec<Piece> {
    let mut turned = pieces.to_vec();
    if let [first, .., last] = pieces
        && first.face == last.face
        && first.from == last.to
        && first.from.iter().all(|&w| w > 0.0)
    {
        let on_edge = |piece: &Piece| piece.from.contains(&0.0);
        turned.rotate_left(pieces.iter().position(on_edge).unwrap_or(0));
    }
    turned
}

/// The edges that an edge of a curve was split into.
fn edges_between(
    mesh: &TriangleMesh,
    split: &BTreeMap<[u32; 2], u32>,
    ends: [u32; 2],
    edges: &mut Vec<usize>,
) {
    let mut open = vec![ends];
    while let Some([a, b]) = open.pop() {
        match split.get(&[a.min(b), a.max(b)]) {
            Some(&m) => open.extend([[m, b], [a, m]]),
            None => edges.extend(edge_between(mesh, [a as usize, b as usize])),
        }
    }
}

struct Cut<'a> {
    mesh: &'a TriangleMesh,
    work: WorkingMesh<'a>,
    /// The faces that each face of the mesh is divided into, where it is.
    parts: BTreeMap<u32, Vec<u32>>,
    /// The vertex that was put on a held edge between these.
    split: BTreeMap<[u32; 2], u32>,
    /// The distance at which a curve runs through a vertex, in each face.
    near: Vec<f64>,
}

impl<'a> Cut<'a> {
    fn new(mesh: &'a TriangleMesh, regions: &'a Regions) -> Self {
        let most = MOST_SNAP * diagonal(mesh);
        let near = |face: usize| {
            let sides = [0, 1, 2].map(|k| mesh.edge_length(face, k));
            most.min(SNAP * sides[0].min(sides[1]).min(sides[2]))
        };
        Cut {
            mesh,
            work: WorkingMesh::new(mesh, &FeatureGraph::none(mesh), regions),
            parts: BTreeMap::new(),
            split: BTreeMap::new(),
            near: (0..mesh.face_count()).map(near).collect(),
        }
    }

    /// The vertices of a curve, after its edges are there.
    fn curve(&mut self, number: usize, pieces: &[Piece]) -> Result<Vec<u32>> {
        let mut chain = Vec::with_capacity(pieces.len() + 1);
        for (step, piece) in pieces.iter().enumerate() {
            may_continue_at(step)?;
            let face = piece.face as u32;
            if chain.is_empty() {
                chain.push(self.vertex(face, piece.from));
            }
            let to = self.vertex(face, piece.to);
            let from = chain[chain.len() - 1];
            for v in self.connect(number, face, from, to)? {
                // Forth and back along a short edge comes from running through vertices.
                let back = chain.len() >= 2 && chain[chain.len() - 2] == v;
                let [p, q] = [v, chain[chain.len() - 1]].map(|v| self.work.position(v));
                match back && norm(sub(p, q)) <= 2.0 * self.near[piece.face] {
                    true => {
                        chain.pop();
                    }
                    false => chain.push(v),
                }
            }
        }
        Ok(chain)
    }

    fn parts_of(&self, face: u32) -> Vec<u32> {
        self.parts.get(&face).cloned().unwrap_or_else(|| vec![face])
    }

    /// Notes of which face those after the first `count` are parts.
    fn note_parts(&mut self, count: usize) {
        for part in count..self.work.triangles.len() {
            let face = self.work.region(part as u32);
            self.parts
                .entry(face)
                .or_insert_with(|| vec![face])
                .push(part as u32);
        }
    }

    /// A vertex at a point of a face: one that is near, or a new one.
    fn vertex(&mut self, face: u32, weights: [f64; 3]) -> u32 {
        let p = point_of(self.mesh, face as usize, weights);
        // On an edge of the face, only what lies on it is near.
        let side = (0..3).find(|&k| weights[(k + 2) % 3] == 0.0);
        let edge = side.map(|k| self.mesh.edge_of(face as usize, k) as u32);
        let near = match edge {
            // The same seen from both faces.
            Some(e) => {
                let sides = self.mesh.edge(e as usize);
                let both = std::iter::once(sides.first).chain(sides.second);
                both.fold(f64::INFINITY, |m, (f, _)| m.min(self.near[f]))
            }
            None => self.near[face as usize],
        };
        let parts = self.parts_of(face);
        let halves = parts.iter().flat_map(|&part| 3 * part..3 * part + 3);
        let is_there = |&half: &u32| edge.is_none_or(|e| self.work.held[half as usize] == e);
        let halves: Vec<u32> = halves.filter(is_there).collect();
        let off = |v: u32| norm(sub(self.work.position(v), p));
        let mut ends: Vec<u32> = Vec::with_capacity(2 * halves.len());
        halves.iter().for_each(|&h| ends.extend(self.work.ends(h)));
        let closest = ends.into_iter().min_by(|&a, &b| off(a).total_cmp(&off(b)));
        if let Some(v) = closest.filter(|&v| off(v) <= near) {
            return v;
        }
        let beside = |h: u32| self.distance(p, self.work.ends(h));
        let nearest = halves
            .into_iter()
            .min_by(|&a, &b| beside(a).total_cmp(&beside(b)));
        if let Some(half) = nearest.filter(|&h| edge.is_some() || beside(h) <= near)
            && let Some(v) = self.split_edge(half, p, edge.is_some())
        {
            return v;
        }
        if edge.is_none()
            && let Some(v) = self.split_face(face, p)
        {
            return v;
        }
        // There is no room for a vertex.
        closest.unwrap_or(self.mesh.triangles()[face as usize][0])
    }

    /// A vertex in the part of a face that holds a point.
    fn split_face(&mut self, face: u32, p: Vec3) -> Option<u32> {
        let q = self.work.regions.planes[face as usize].coordinates(p);
        let depth = |part: u32| {
            let [a, b, c] = self.work.in_plane(face, self.work.triangles[part as usize]);
            let areas = [[a, b, q], [b, c, q], [c, a, q]].map(orientation);
            areas.into_iter().fold(f64::INFINITY, f64::min)
        };
        let parts = self.parts_of(face).into_iter();
        let part = parts.max_by(|&a, &b| depth(a).total_cmp(&depth(b)))?;
        let count = self.work.triangles.len();
        let is_done = self.work.split_face(part, p, face);
        self.note_parts(count);
        is_done.then(|| self.work.vertices.len() as u32 - 1)
    }

    /// A vertex on an edge: at a point that is on it, or at the foot of one that is near.
    fn split_edge(&mut self, half: u32, p: Vec3, is_on: bool) -> Option<u32> {
        let [a, b] = self.work.ends(half);
        let at = match is_on {
            true => p,
            false => self.foot(p, [a, b]),
        };
        let (count, held) = (self.work.triangles.len(), self.work.is_held(half));
        let face = self.work.region(half / 3);
        let is_done = self.work.split_edge(half, at, face);
        self.note_parts(count);
        if !is_done {
            return None;
        }
        let m = self.work.vertices.len() as u32 - 1;
        if held {
            self.split.insert([a.min(b), a.max(b)], m);
        }
        Some(m)
    }

    /// Makes the straight line between two vertices of a face edges, and gives the vertices after the first.
    fn connect(&mut self, number: usize, face: u32, from: u32, to: u32) -> Result<Vec<u32>> {
        let (mut here, mut path) = (from, Vec::new());
        let mut targets = if from == to { Vec::new() } else { vec![to] };
        let mut left = CROSSINGS + 2 * self.parts_of(face).len();
        while let Some(&target) = targets.last() {
            if self.hold(face, here, target) {
                (here, _) = (target, targets.pop());
                path.push(here);
                continue;
            }
            let way = (left > 0).then(|| self.way(face, here, target)).flatten();
            left = left.saturating_sub(1);
            match way {
                Some(Way::Vertex(v)) => targets.push(v),
                Some(Way::Edge(half, p)) => {
                    let [a, b] = self.work.ends(half);
                    let split = self.split_edge(half, p, false);
                    let nearer = |a: u32, b: u32| {
                        let [u, w] = [a, b].map(|v| norm(sub(self.work.position(v), p)));
                        if u <= w { a } else { b }
                    };
                    targets.push(split.unwrap_or_else(|| nearer(a, b)));
                }
                None => {
                    return Err(Error::InvalidArgument {
                        what: format!("curve {number} cannot be cut into face {face}"),
                        index: Some(number),
                    });
                }
            }
        }
        Ok(path)
    }

    /// Holds the edge between two vertices of a face, if there is one.
    fn hold(&mut self, face: u32, a: u32, b: u32) -> bool {
        let halves = self.parts_of(face).into_iter();
        let found = halves.flat_map(|part| 3 * part..3 * part + 3).find(
            |&half| matches!(self.work.ends(half), [u, v] if [u, v] == [a, b] || [v, u] == [a, b]),
        );
        if let Some(half) = found
            && !self.work.is_held(half)
        {
            // As no edge of the mesh.
            let name = self.mesh.edge_count() as u32;
            self.work.held[half as usize] = name;
            let other = self.work.twin[half as usize];
            if other != NONE {
                self.work.held[other as usize] = name;
            }
        }
        found.is_some()
    }

    /// What lies first on the way from a vertex of a face to another.
    fn way(&self, face: u32, here: u32, target: u32) -> Option<Way> {
        let plane = &self.work.regions.planes[face as usize];
        let at = |v: u32| plane.coordinates(self.work.position(v));
        let [from, to] = [here, target].map(at);
        let near = self.near[face as usize];
        let mut best: Option<(f64, u32)> = None;
        for part in self.parts_of(face) {
            for half in (3 * part..3 * part + 3).filter(|&h| self.work.tail(h) == here) {
                let across = next(half);
                let [b, c] = self.work.ends(across);
                // The direction lies between the two sides of the corner by this much.
                let [left, right] = [[from, at(b), to], [from, to, at(c)]].map(orientation);
                let inside = left.min(right);
                if best.is_none_or(|(most, _)| inside > most) {
                    best = Some((inside, across));
                }
            }
        }
        let (_, across) = best?;
        let [b, c] = self.work.ends(across);
        let ends = [here, target];
        let is_ahead = |v: u32| {
            let [p, q, r] = [here, target, v].map(|v| self.work.position(v));
            dot(sub(q, p), sub(r, p)) > 0.0 && dot(sub(p, q), sub(r, q)) > 0.0
        };
        let off = |v: u32| self.distance(self.work.position(v), ends);
        let closest = if off(b) <= off(c) { b } else { c };
        if off(closest) <= near && is_ahead(closest) {
            return Some(Way::Vertex(closest));
        }
        let [left, right] = [b, c].map(|v| orientation([from, to, at(v)]).abs());
        let share = left / (left + right);
        let [p, q] = [b, c].map(|v| self.work.position(v));
        (share.is_finite()).then(|| Way::Edge(across, add(p, scale(sub(q, p), share))))
    }

    fn foot(&self, p: Vec3, ends: [u32; 2]) -> Vec3 {
        closest_on_segment(ends.map(|v| self.work.position(v)), p)
    }

    fn distance(&self, p: Vec3, ends: [u32; 2]) -> f64 {
        norm(sub(self.foot(p, ends), p))
    }
}

/// The first thing on a way through a face.
enum Way {
    Vertex(u32),
    /// The half-edge that is crossed, and where.
    Edge(u32, Vec3),
}

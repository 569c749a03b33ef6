//! Polygons and their mirror images, which share the vertices of the seam.
//!
//! Vertices are of the seam of a plane if an edge of the boundary there lies in it. The image has their
//! numbers for them, and runs the other way.

use std::collections::BTreeMap;

use crate::extract::QuadMesh;
use crate::mesh::mirror::{Half, MirrorPlane};

/// How far vertices of the seam may be from their plane, as a part of the length of their edge.
const ON_PLANE: f64 = 1e-6;

/// The planes on whose seams vertices and edges of the boundary lie.
pub(super) struct Seams {
    /// Of each vertex, as bits.
    vertices: Vec<u8>,
    /// Of each edge, as bits.
    edges: Vec<u8>,
    faces: usize,
}

impl Seams {
    /// Those of the part that was cut out.
    pub(super) fn of_half(half: &Half) -> Self {
        let mut seams = Seams {
            vertices: vec![0; half.mesh.vertex_count()],
            edges: vec![0; half.mesh.edge_count()],
            faces: half.mesh.face_count(),
        };
        for &e in &half.seam {
            let [a, b] = half.mesh.edge(e).vertices;
            seams.mark(e, [a, b], half.on[a] & half.on[b]);
        }
        seams
    }

    /// Those of its quads. Their vertices are moved onto the planes: by rounding.
    pub(super) fn of_quads(quads: &mut QuadMesh, planes: &[MirrorPlane], half: &Half) -> Self {
        let sides = quads.sides();
        let edges: Vec<_> = sides.chunk_by(|a, b| a.0 == b.0).collect();
        let mut seams = Seams {
            vertices: vec![0; quads.vertices.len()],
            edges: vec![0; edges.len()],
            faces: quads.faces().count(),
        };
        let near = ON_PLANE * half.mesh.mean_edge_length();
        for (e, side) in edges.iter().enumerate().filter(|(_, side)| side.len() == 1) {
            let ends = side[0].0.map(|v| v as usize);
            for (k, plane) in planes.iter().enumerate() {
                if ends
                    .iter()
                    .all(|&v| plane.height(quads.vertices[v]).abs() <= near)
                {
                    seams.mark(e, ends, 1 << k);
                }
            }
        }
        for (v, on) in seams.vertices.iter().enumerate() {
            let own = planes.iter().enumerate().filter(|&(k, _)| on >> k & 1 == 1);
            for (_, plane) in own {
                quads.vertices[v] = plane.project(quads.vertices[v]);
            }
        }
        seams
    }

    fn mark(&mut self, edge: usize, ends: [usize; 2], planes: u8) {
        self.edges[edge] |= planes;
        ends.iter().for_each(|&v| self.vertices[v] |= planes);
    }

    /// Counts the image behind a plane as well: what is not on its seam is there twice.
    pub(super) fn count_image(&mut self, plane: usize) {
        for list in [&mut self.vertices, &mut self.edges] {
            let images: Vec<u8> = list
                .iter()
                .copied()
                .filter(|on| on >> plane & 1 == 0)
                .collect();
            list.extend(images);
        }
        self.faces *= 2;
    }

    /// Vertices minus edges plus faces.
    pub(super) fn euler(&self) -> i64 {
        self.vertices.len() as i64 - self.edges.len() as i64 + self.faces as i64
    }
}

/// Adds the image behind the plane of number `k`. Where a quad at the seam is missing, its two other sides and
/// their images bound a quad of their own; such quads are added if the Euler characteristic is then that of
/// `whole`.
pub(super) fn with_image(
    quads: &mut QuadMesh,
    seams: &mut Seams,
    plane: &MirrorPlane,
    k: usize,
    whole: i64,
) {
    let notches = notches(quads, seams, k);
    let mut image = Vec::with_capacity(quads.vertices.len());
    for v in 0..quads.vertices.len() {
        if seams.vertices[v] >> k & 1 == 1 {
            image.push(v as u32);
            continue;
        }
        image.push(quads.vertices.len() as u32);
        quads.vertices.push(plane.reflect(quads.vertices[v]));
        quads.origins.push(quads.origins[v]);
        seams.vertices.push(seams.vertices[v]);
    }
    let of = |&[a, b, c, d]: &[u32; 4]| [a, d, c, b].map(|v| image[v as usize]);
    let images: Vec<[u32; 4]> = quads.quads.iter().map(of).collect();
    quads.quads.extend(images);
    let of = |polygon: &Vec<u32>| polygon.iter().rev().map(|&v| image[v as usize]).collect();
    let images: Vec<Vec<u32>> = quads.others.iter().map(of).collect();
    quads.others.extend(images);
    let missing = whole - quads.figures().euler;
    if !notches.is_empty() && missing == notches.len() as i64 {
        let filled = notches
            .iter()
            .map(|&[a, b, c]| [b, a, image[b as usize], c]);
        quads.quads.extend(filled);
    }
}

/// The three vertices of each two edges of the boundary that lead from the seam to the seam, through a vertex
/// that is not on it.
fn notches(quads: &QuadMesh, seams: &Seams, k: usize) -> Vec<[u32; 3]> {
    let is_on = |v: u32| seams.vertices[v as usize] >> k & 1 == 1;
    let sides = quads.sides();
    let boundary = sides
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|side| side.len() == 1);
    let mut next = BTreeMap::new();
    let mut from_seam = Vec::new();
    for &([low, high], forth) in boundary.map(|side| &side[0]) {
        let (from, to) = if forth { (low, high) } else { (high, low) };
        match (is_on(from), is_on(to)) {
            (true, false) => from_seam.push([from, to]),
            (false, true) => {
                next.insert(from, to);
            }
            _ => {}
        }
    }
    let notch = |[from, middle]: [u32; 2]| Some([from, middle, *next.get(&middle)?]);
    let found = from_seam.into_iter().filter_map(notch);
    found.filter(|&[from, _, to]| from != to).collect()
}

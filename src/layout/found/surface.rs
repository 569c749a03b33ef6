//! Quads as a surface: checked, with half-edges on both sides of every edge.
//!
//! Half-edge `4 f + k` runs from corner `k` of quad `f` to the next, with the quad on its left. Every boundary
//! edge has a second half-edge with nothing on its left, so that one rule turns around every vertex.

use super::FoundError;
use crate::mesh::MeshError;
use crate::mesh::vector::Vec3;
use crate::soup::PolygonSoup;

const NONE: u32 = u32::MAX;

/// An oriented manifold of quads, with or without boundary, of any number of components.
#[derive(Debug, Clone, PartialEq)]
pub struct QuadSurface {
    positions: Vec<Vec3>,
    quads: Vec<[u32; 4]>,
    /// Of every half-edge: first those of the quads, then those outside the boundary.
    twin: Vec<u32>,
    /// The next of each half-edge outside the boundary.
    next_outside: Vec<u32>,
    /// A half-edge that leaves each vertex, at the boundary the one outside.
    first: Vec<u32>,
    /// The number of quads at each vertex.
    valence: Vec<u32>,
}

impl QuadSurface {
    /// Checks quads, whose corners are counter-clockwise.
    ///
    /// # Errors
    /// [`FoundError::Mesh`] for no quads, a coordinate that is not finite, a corner that names no vertex or is there
    /// twice, an edge of more than two quads, neighbours of different orientation, and vertices of no quad or of
    /// several fans.
    pub fn new(positions: Vec<Vec3>, quads: Vec<[u32; 4]>) -> Result<Self, FoundError> {
        check(&positions, &quads)?;
        let (vertices, inner) = (positions.len(), 4 * quads.len());
        let mut surface = QuadSurface {
            twin: twins(&quads)?,
            positions,
            quads,
            next_outside: Vec::new(),
            first: vec![NONE; vertices],
            valence: vec![0; vertices],
        };
        surface.add_outside();
        for h in 0..surface.twin.len() {
            let v = surface.from(h) as usize;
            surface.valence[v] += u32::from(h < inner);
            if surface.first[v] == NONE || h >= inner {
                surface.first[v] = h as u32;
            }
        }
        surface.check_fans()?;
        Ok(surface)
    }

    /// The surface of a soup of quads.
    ///
    /// # Errors
    /// [`FoundError::NotAQuad`], and those of [`new`](Self::new).
    pub fn from_soup(soup: &PolygonSoup) -> Result<Self, FoundError> {
        let vertices = soup.positions().len();
        let mut quads = Vec::with_capacity(soup.polygon_count());
        for (face, corners) in soup.polygons().enumerate() {
            let Ok(corners) = <[i64; 4]>::try_from(corners) else {
                let corners = corners.len();
                return Err(FoundError::NotAQuad { face, corners });
            };
            let is_known = |v: &&i64| usize::try_from(**v).is_ok_and(|v| v < vertices);
            if let Some(&vertex) = corners.iter().find(|v| !is_known(v)) {
                return Err(out_of_range(face, vertex, vertices).into());
            }
            quads.push(corners.map(|v| v as u32));
        }
        Self::new(soup.positions().to_vec(), quads)
    }

    /// Positions of all vertices.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Corners of all quads, counter-clockwise.
    pub fn quads(&self) -> &[[u32; 4]] {
        &self.quads
    }

    /// Vertices minus edges plus faces.
    pub fn euler_characteristic(&self) -> i64 {
        let edges = self.twin.len() / 2;
        self.positions.len() as i64 - edges as i64 + self.quads.len() as i64
    }

    /// Whether a vertex is on the boundary.
    pub fn is_boundary(&self, vertex: usize) -> bool {
        self.is_outside(self.first[vertex] as usize)
    }

    /// The number of quads at a vertex.
    pub fn valence(&self, vertex: usize) -> usize {
        self.valence[vertex] as usize
    }

    /// Whether a vertex is irregular: with a number of quads other than four, or than two on the boundary.
    pub fn is_irregular(&self, vertex: usize) -> bool {
        let regular = if self.is_boundary(vertex) { 2 } else { 4 };
        self.valence(vertex) != regular
    }

    /// The number of half-edges.
    pub(in crate::layout) fn half_edges(&self) -> usize {
        self.twin.len()
    }

    /// Whether a half-edge has no quad on its left.
    pub(in crate::layout) fn is_outside(&self, h: usize) -> bool {
        h >= 4 * self.quads.len()
    }

    /// The other half-edge of the same edge.
    pub(in crate::layout) fn twin(&self, h: usize) -> usize {
        self.twin[h] as usize
    }

    /// The next half-edge around the same quad, or along the boundary.
    pub(in crate::layout) fn next(&self, h: usize) -> usize {
        match self.is_outside(h) {
            true => self.next_outside[h - 4 * self.quads.len()] as usize,
            false => h - h % 4 + (h + 1) % 4,
        }
    }

    /// The half-edge before this one around its quad.
    pub(super) fn before(&self, h: usize) -> usize {
        debug_assert!(!self.is_outside(h));
        h - h % 4 + (h + 3) % 4
    }

    /// The vertex where a half-edge begins.
    pub(in crate::layout) fn from(&self, h: usize) -> u32 {
        match self.is_outside(h) {
            true => self.from(self.next(self.twin(h))),
            false => self.quads[h / 4][h % 4],
        }
    }

    /// The vertex where a half-edge ends.
    pub(super) fn to(&self, h: usize) -> u32 {
        self.from(self.twin(h))
    }

    /// The half-edges that leave a vertex, clockwise; at the boundary from the one outside on.
    pub(in crate::layout) fn around(&self, vertex: usize) -> impl Iterator<Item = usize> + '_ {
        let first = self.first[vertex] as usize;
        let mut next = Some(first);
        std::iter::from_fn(move || {
            let h = next?;
            next = Some(self.next(self.twin(h))).filter(|&h| h != first);
            Some(h)
        })
    }

    /// The half-edge that goes straight on where `h` ends, if that is a regular vertex off the boundary.
    pub(super) fn straight(&self, h: usize) -> Option<usize> {
        let vertex = self.to(h) as usize;
        let is_crossing = !self.is_boundary(vertex) && !self.is_irregular(vertex);
        is_crossing.then(|| self.next(self.twin(self.next(h))))
    }

    /// Adds the half-edges outside the boundary.
    fn add_outside(&mut self) {
        let inner = self.twin.len();
        for h in 0..inner {
            if self.twin[h] == NONE {
                self.twin[h] = self.twin.len() as u32;
                self.twin.push(h as u32);
            }
        }
        for outside in inner..self.twin.len() {
            // Around the vertex where it ends, counter-clockwise to the other boundary edge.
            let mut h = self.twin(outside);
            let next = loop {
                let over = self.twin(self.before(h));
                if over >= inner {
                    break over;
                }
                h = over;
            };
            self.next_outside.push(next as u32);
        }
    }

    fn check_fans(&self) -> Result<(), FoundError> {
        for vertex in 0..self.positions.len() {
            if self.first[vertex] == NONE {
                return Err(MeshError::IsolatedVertex { vertex }.into());
            }
            let inner = self.around(vertex).filter(|&h| !self.is_outside(h));
            if inner.count() != self.valence(vertex) {
                return Err(MeshError::NonManifoldVertex { vertex }.into());
            }
        }
        Ok(())
    }
}

/// Checks sizes, coordinates and quads one by one.
fn check(positions: &[Vec3], quads: &[[u32; 4]]) -> Result<(), MeshError> {
    let (vertices, faces) = (positions.len(), quads.len());
    if faces == 0 {
        return Err(MeshError::NoFaces);
    }
    // Half-edges on both sides of all edges have numbers below `NONE`.
    if vertices >= u32::MAX as usize || faces >= u32::MAX as usize / 8 {
        return Err(MeshError::TooLarge { vertices, faces });
    }
    let infinite = |p: &Vec3| p.iter().any(|x| !x.is_finite());
    if let Some(vertex) = positions.iter().position(infinite) {
        return Err(MeshError::NotFinite { vertex });
    }
    for (face, corners) in quads.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
            return Err(out_of_range(face, vertex.into(), vertices));
        }
    }
    for (face, corners) in quads.iter().enumerate() {
        let is_repeated = |k: &usize| corners[k + 1..].contains(&corners[*k]);
        if let Some(k) = (0..3).find(is_repeated) {
            let vertex = corners[k] as usize;
            return Err(MeshError::RepeatedVertex { face, vertex });
        }
    }
    Ok(())
}

fn out_of_range(face: usize, vertex: i64, vertices: usize) -> MeshError {
    MeshError::IndexOutOfRange {
        face,
        vertex,
        vertices,
    }
}

/// The twins of the half-edges of quads; at the boundary none.
fn twins(quads: &[[u32; 4]]) -> Result<Vec<u32>, MeshError> {
    let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(4 * quads.len());
    for (f, quad) in quads.iter().enumerate() {
        for k in 0..4 {
            let (a, b) = (quad[k], quad[(k + 1) % 4]);
            sides.push(([a.min(b), a.max(b)], (4 * f + k) as u32));
        }
    }
    sides.sort_unstable();
    let from = |h: u32| quads[h as usize / 4][h as usize % 4];
    let mut twin = vec![NONE; sides.len()];
    for edge in sides.chunk_by(|a, b| a.0 == b.0) {
        let vertices = edge[0].0.map(|v| v as usize);
        match *edge {
            [_] => {}
            [(_, a), (_, b)] if from(a) != from(b) => {
                twin[a as usize] = b;
                twin[b as usize] = a;
            }
            [(_, a), (_, b)] => {
                let ends = match from(a) as usize == vertices[0] {
                    true => vertices,
                    false => [vertices[1], vertices[0]],
                };
                return Err(MeshError::InconsistentOrientation {
                    vertices: ends,
                    faces: [a as usize / 4, b as usize / 4],
                });
            }
            _ => {
                let faces = edge.iter().map(|&(_, h)| h as usize / 4).collect();
                return Err(MeshError::NonManifoldEdge { vertices, faces });
            }
        }
    }
    Ok(twin)
}

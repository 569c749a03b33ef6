//! The part of a mesh on one side of planes. It is cut exactly: where an edge crosses a plane, it gets a
//! vertex on both.
//!
//! Vertices that are very near a plane are moved onto it first, so that no needles arise. Faces in a plane
//! belong to neither side. Small pieces that the cut leaves where the mesh is not quite symmetric go to the side
//! that surrounds them: they would become handles of the mirrored surface. A vertex at which what is left has several fans becomes one vertex for each.

use std::collections::BTreeMap;

use super::{MirrorPlane, diagonal, refused};
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::refine::DEVIATION;
use crate::mesh::vector::{Vec3, add, cross, norm, scale, sub};
use crate::monitor::may_continue;

/// A vertex is moved onto a plane that is nearer than this part of its shortest edge, and than
/// [`DEVIATION`].
const NEAR: f64 = 0.1;

/// The same where that leaves faces without area, as a part of the diagonal.
const LEAST_NEAR: f64 = 1e-13;

/// Pieces of a component are on the wrong side of the cut if they are smaller than this part of the area
/// that is kept.
const SCRAP: f64 = 0.01;

/// The place of a vertex on the mesh that was cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Vertex(u32),
    /// On the edge between these vertices, the lower first.
    Edge([u32; 2]),
    Inside,
}

impl Place {
    fn is_on(self, [a, b]: [u32; 2]) -> bool {
        match self {
            Place::Vertex(v) => v == a || v == b,
            Place::Edge(edge) => edge == [a.min(b), a.max(b)],
            Place::Inside => false,
        }
    }
}

/// The part of a mesh on one side of each of some planes.
#[derive(Debug, Clone)]
pub struct Half {
    /// The part.
    pub mesh: TriangleMesh,
    /// The face of the given mesh of which each face is a part.
    pub face_origin: Vec<u32>,
    /// The vertex of the given mesh that each vertex is, if it is one.
    pub vertex_origin: Vec<Option<u32>>,
    /// The edge of the given mesh of which each edge is a part, if it is one.
    pub edge_origin: Vec<Option<u32>>,
    /// The edges that lie on planes, in increasing order: those of the boundary along which the part meets
    /// its mirror images.
    pub seam: Vec<usize>,
    /// The planes on which each vertex lies, as bits.
    pub(crate) on: Vec<u8>,
    /// The number of small pieces that the cut left on the wrong side, as it does where the mesh is not quite
    /// symmetric: those on the side that is kept are dropped, and those on the other side are kept.
    pub small_pieces: usize,
}

impl Half {
    /// Cuts a mesh by planes, and keeps what lies on the side of their normals.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] with the number of a plane that has the whole mesh on one side;
    /// [`Error::Cancelled`].
    pub fn new(mesh: &TriangleMesh, planes: &[MirrorPlane]) -> Result<Self> {
        let size = diagonal(mesh);
        let far = [(NEAR, DEVIATION * size), (f64::INFINITY, LEAST_NEAR * size)];
        let mut last = None;
        for (of_edge, most) in far {
            let mut cut = Cut::new(mesh);
            for k in 0..planes.len() {
                cut.by(&planes[k], k, of_edge, most)?;
                may_continue()?;
            }
            cut.split_fans();
            match cut.half(mesh) {
                Ok(half) => return Ok(half),
                Err(error) => last = Some(error),
            }
        }
        Err(last.unwrap_or(Error::Empty))
    }

    /// The parts of some edges of the given mesh, in increasing order.
    pub fn parts_of(&self, is_wanted: impl Fn(usize) -> bool) -> Vec<usize> {
        let is_part = |&e: &usize| self.edge_origin[e].is_some_and(|e| is_wanted(e as usize));
        (0..self.edge_origin.len()).filter(is_part).collect()
    }
}

/// A mesh while it is cut.
struct Cut {
    points: Vec<Vec3>,
    places: Vec<Place>,
    on: Vec<u8>,
    triangles: Vec<[u32; 3]>,
    face_origin: Vec<u32>,
    small_pieces: usize,
}

/// Where a triangle lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Kept,
    Plane,
    Other,
}

impl Cut {
    fn new(mesh: &TriangleMesh) -> Self {
        Cut {
            points: mesh.vertices().to_vec(),
            places: (0..mesh.vertex_count() as u32).map(Place::Vertex).collect(),
            on: vec![0; mesh.vertex_count()],
            triangles: mesh.triangles().to_vec(),
            face_origin: (0..mesh.face_count() as u32).collect(),
            small_pieces: 0,
        }
    }

    /// Cuts by the plane of number `k`.
    fn by(&mut self, plane: &MirrorPlane, k: usize, of_edge: f64, most: f64) -> Result<()> {
        let height = self.heights(plane, k, of_edge, most);
        let is_beyond =
            |t: &[u32; 3], sign: f64| t.iter().any(|&v| sign * height[v as usize] > 0.0);
        for sign in [1.0, -1.0] {
            if !self.triangles.iter().any(|t| is_beyond(t, sign)) {
                let what = format!(
                    "mirror plane {k}, {plane}, cuts nothing: the mesh lies on one side of it"
                );
                return refused(what, Some(k));
            }
        }
        let mut crossings: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        let triangles = std::mem::take(&mut self.triangles);
        let origins = std::mem::take(&mut self.face_origin);
        let mut sides = Vec::with_capacity(triangles.len());
        for (t, origin) in triangles.into_iter().zip(origins) {
            let mut polygons = [Vec::with_capacity(4), Vec::with_capacity(4)];
            for i in 0..3 {
                let (a, b) = (t[i], t[(i + 1) % 3]);
                let (from, to) = (height[a as usize], height[b as usize]);
                if from >= 0.0 {
                    polygons[0].push(a);
                }
                if from <= 0.0 {
                    polygons[1].push(a);
                }
                if from < 0.0 && to > 0.0 || from > 0.0 && to < 0.0 {
                    let edge = [a.min(b), a.max(b)];
                    let known = crossings.get(&edge).copied();
                    let v = known.unwrap_or_else(|| self.crossing(edge, &height, plane, k));
                    crossings.insert(edge, v);
                    polygons.iter_mut().for_each(|polygon| polygon.push(v));
                }
            }
            let is_flat = t.iter().all(|&v| height[v as usize] == 0.0);
            let of_sides = match is_flat {
                true => [Some(Side::Plane), None],
                false => [Some(Side::Kept), Some(Side::Other)],
            };
            for (side, polygon) in of_sides.into_iter().zip(polygons) {
                let Some(side) = side else { continue };
                for part in self.halves(&polygon) {
                    self.triangles.push(part);
                    self.face_origin.push(origin);
                    sides.push(side);
                }
            }
        }
        self.keep_side(&mut sides);
        Ok(())
    }

    /// Drops all that is not on the side that is kept, but for small pieces that are enclosed by it, and small
    /// pieces on that side.
    fn keep_side(&mut self, sides: &mut [Side]) {
        let areas: Vec<f64> = self.triangles.iter().map(|t| self.area(t)).collect();
        let scrap = SCRAP * areas.iter().sum::<f64>() / 2.0;
        let neighbours = self.neighbours();
        // Of the other sides first: what they enclose is then a part of the side that is kept.
        for from in [Side::Other, Side::Plane, Side::Kept] {
            let mut sets = Sets::new(self.triangles.len());
            let is_same = |&&[a, b]: &&[u32; 2]| sides[a as usize] == sides[b as usize];
            neighbours
                .iter()
                .filter(is_same)
                .for_each(|&[a, b]| sets.join(a, b));
            let roots: Vec<usize> = (0..areas.len())
                .map(|t| sets.root(t as u32) as usize)
                .collect();
            let mut area = vec![0.0; areas.len()];
            roots
                .iter()
                .zip(&areas)
                .for_each(|(&root, own)| area[root] += own);
            // A piece that nothing surrounds is all of a component.
            let mut is_joined = vec![false; areas.len()];
            for &[a, b] in neighbours.iter().filter(|pair| !is_same(pair)) {
                is_joined[roots[a as usize]] = true;
                is_joined[roots[b as usize]] = true;
            }
            let mut small: Vec<usize> = Vec::new();
            for t in 0..areas.len() {
                let root = roots[t];
                if sides[t] == from && is_joined[root] && area[root] < scrap {
                    small.push(t);
                }
            }
            for &t in &small {
                sides[t] = match from {
                    Side::Kept => Side::Other,
                    Side::Other | Side::Plane => Side::Kept,
                };
            }
            let mut pieces: Vec<usize> = small.iter().map(|&t| roots[t]).collect();
            pieces.sort_unstable();
            pieces.dedup();
            self.small_pieces += pieces.len();
        }
        let mut keep = sides.iter();
        self.triangles.retain(|_| keep.next() == Some(&Side::Kept));
        let mut keep = sides.iter();
        self.face_origin
            .retain(|_| keep.next() == Some(&Side::Kept));
    }

    fn area(&self, triangle: &[u32; 3]) -> f64 {
        let [a, b, c] = triangle.map(|v| self.points[v as usize]);
        0.5 * norm(cross(sub(b, a), sub(c, a)))
    }

    /// The pairs of triangles that share an edge.
    fn neighbours(&self) -> Vec<[u32; 2]> {
        let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * self.triangles.len());
        for (f, t) in self.triangles.iter().enumerate() {
            for i in 0..3 {
                let [a, b] = [t[i], t[(i + 1) % 3]];
                sides.push(([a.min(b), a.max(b)], f as u32));
            }
        }
        sides.sort_unstable();
        let pairs = sides.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        pairs.map(|pair| [pair[0].1, pair[1].1]).collect()
    }

    /// The height of every vertex. Vertices near the plane are moved onto it.
    fn heights(&mut self, plane: &MirrorPlane, k: usize, of_edge: f64, most: f64) -> Vec<f64> {
        let mut shortest = vec![f64::INFINITY; self.points.len()];
        for t in &self.triangles {
            for i in 0..3 {
                let [a, b] = [t[i] as usize, t[(i + 1) % 3] as usize];
                let length = norm(sub(self.points[a], self.points[b]));
                shortest[a] = shortest[a].min(length);
                shortest[b] = shortest[b].min(length);
            }
        }
        let mut height: Vec<f64> = self.points.iter().map(|&p| plane.height(p)).collect();
        for v in 0..height.len() {
            if height[v].abs() <= most.min(of_edge * shortest[v]) {
                self.points[v] = plane.project(self.points[v]);
                self.on[v] |= 1 << k;
                height[v] = 0.0;
            }
        }
        height
    }

    /// A new vertex where an edge crosses the plane.
    fn crossing(&mut self, edge: [u32; 2], height: &[f64], plane: &MirrorPlane, k: usize) -> u32 {
        let [a, b] = edge.map(|v| v as usize);
        let share = height[a] / (height[a] - height[b]);
        let (p, q) = (self.points[a], self.points[b]);
        let point = plane.project(add(p, scale(sub(q, p), share)));
        let place = match (self.places[a], self.places[b]) {
            (Place::Vertex(a), Place::Vertex(b)) => Place::Edge([a.min(b), a.max(b)]),
            (Place::Edge(e), other) | (other, Place::Edge(e)) if other.is_on(e) => Place::Edge(e),
            _ => Place::Inside,
        };
        self.points.push(point);
        self.places.push(place);
        self.on.push(self.on[a] & self.on[b] | 1 << k);
        (self.points.len() - 1) as u32
    }

    /// A triangle as it is; a quad as two triangles, divided by the shorter diagonal.
    fn halves(&self, polygon: &[u32]) -> Vec<[u32; 3]> {
        match *polygon {
            [a, b, c] => vec![[a, b, c]],
            [a, b, c, d] => {
                let length =
                    |a: u32, b: u32| norm(sub(self.points[a as usize], self.points[b as usize]));
                match length(a, c) <= length(b, d) {
                    true => vec![[a, b, c], [a, c, d]],
                    false => vec![[b, c, d], [b, d, a]],
                }
            }
            _ => Vec::new(),
        }
    }

    /// Gives each fan of a vertex a vertex of its own, and drops vertices without faces.
    fn split_fans(&mut self) {
        // Corners of one vertex are of one fan if their faces share an edge there.
        let mut sets = Sets::new(3 * self.triangles.len());
        let mut sides: Vec<([u32; 2], [u32; 2])> = Vec::new();
        for (f, t) in self.triangles.iter().enumerate() {
            for i in 0..3 {
                let (j, f) = ((i + 1) % 3, 3 * f as u32);
                let (from, to) = ((t[i], f + i as u32), (t[j], f + j as u32));
                let (low, high) = if from < to { (from, to) } else { (to, from) };
                sides.push(([low.0, high.0], [low.1, high.1]));
            }
        }
        sides.sort_unstable();
        for pair in sides.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            sets.join(pair[0].1[0], pair[1].1[0]);
            sets.join(pair[0].1[1], pair[1].1[1]);
        }
        let mut number = vec![u32::MAX; 3 * self.triangles.len()];
        let mut old = Vec::new();
        for f in 0..self.triangles.len() {
            for i in 0..3 {
                let fan = sets.root((3 * f + i) as u32) as usize;
                if number[fan] == u32::MAX {
                    number[fan] = old.len() as u32;
                    old.push(self.triangles[f][i] as usize);
                }
                self.triangles[f][i] = number[fan];
            }
        }
        self.points = old.iter().map(|&v| self.points[v]).collect();
        self.places = old.iter().map(|&v| self.places[v]).collect();
        self.on = old.iter().map(|&v| self.on[v]).collect();
    }

    fn half(self, given: &TriangleMesh) -> Result<Half> {
        let mesh = TriangleMesh::new(self.points, self.triangles)?;
        let (mut seam, mut edge_origin) = (Vec::new(), Vec::new());
        for (e, edge) in mesh.edges().enumerate() {
            let [a, b] = edge.vertices;
            if edge.second.is_none() && self.on[a] & self.on[b] != 0 {
                seam.push(e);
            }
            let face = self.face_origin[edge.first.0] as usize;
            let corners = given.triangles()[face];
            let is_part = |&k: &usize| {
                let side = [corners[k], corners[(k + 1) % 3]];
                [a, b].iter().all(|&v| self.places[v].is_on(side))
            };
            let side = (0..3).find(is_part);
            edge_origin.push(side.map(|k| given.edge_of(face, k) as u32));
        }
        let vertex_origin = self.places.iter().map(|&place| match place {
            Place::Vertex(v) => Some(v),
            _ => None,
        });
        Ok(Half {
            mesh,
            vertex_origin: vertex_origin.collect(),
            face_origin: self.face_origin,
            edge_origin,
            seam,
            on: self.on,
            small_pieces: self.small_pieces,
        })
    }
}

/// Sets of numbers that are joined.
struct Sets(Vec<u32>);

impl Sets {
    fn new(count: usize) -> Self {
        Sets((0..count as u32).collect())
    }

    fn root(&mut self, mut of: u32) -> u32 {
        while self.0[of as usize] != of {
            self.0[of as usize] = self.0[self.0[of as usize] as usize];
            of = self.0[of as usize];
        }
        of
    }

    /// The lower root is that of both.
    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

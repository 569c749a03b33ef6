//! The same mesh with faces and vertices that are near each other in space near each other in memory.
//!
//! Some files have faces in an order in which neighbours are anywhere. Every walk over the surface, and over the
//! unknowns of its problems, then waits for memory: quads of a mesh of 200,000 such faces take half as long again as in
//! this order.

use super::TriangleMesh;
use super::vector::{Vec3, sub};
use crate::error::Result;
use crate::monitor::{collect_in_parts, may_continue, sort_in_parts};

/// The faces of a mesh that is in the cache in any order.
const FEW: usize = 1 << 15;

/// The edges that are looked at, spread evenly over all.
const LOOKS: usize = 1 << 12;

/// The most of these edges, as a part of all, whose two faces or vertices may be far apart. In a random order nearly
/// all of them are.
const FAR: f64 = 0.25;

/// Numbers are far apart if they differ by more than so many times the root of how many there are. Those of
/// neighbours in two rows of a grid differ by one root.
const ROOTS: f64 = 4.0;

/// The cells of space along each axis, as a power of two: three such numbers fit into 64 bits.
const BITS: u32 = 21;

/// The least number of faces that are worth a thread.
const LEAST: usize = 1 << 14;

/// A mesh in another order. Corners of faces stay in theirs.
#[derive(Debug)]
pub(crate) struct Reordered {
    pub mesh: TriangleMesh,
    /// The number that each face and each vertex had.
    faces: Vec<u32>,
    vertices: Vec<u32>,
    /// Where each face and each vertex is now.
    place_of_face: Vec<u32>,
    place_of_vertex: Vec<u32>,
}

impl Reordered {
    /// A large mesh in another order, if neighbours are far apart in its own.
    ///
    /// # Errors
    /// The reason to end the current step.
    pub fn if_scattered(mesh: &TriangleMesh) -> Result<Option<Self>> {
        match mesh.face_count() > FEW && is_scattered(mesh) {
            true => Self::new(mesh).map(Some),
            false => Ok(None),
        }
    }

    /// The mesh with its faces in the order of the cells of space in which they are (`morton1966`), and its vertices in
    /// the order of the first face of each.
    ///
    /// # Errors
    /// The reason to end the current step.
    pub fn new(mesh: &TriangleMesh) -> Result<Self> {
        let [low, high] = mesh.bounding_box();
        let size = sub(high, low).into_iter().fold(0.0, f64::max);
        let mut cells = collect_in_parts(mesh.face_count(), LEAST, |face| {
            let corners = mesh.corner_positions(face);
            let center = [0, 1, 2].map(|axis| corners.iter().map(|p| p[axis] / 3.0).sum());
            (cell(center, low, size), face as u32)
        });
        may_continue()?;
        sort_in_parts(&mut cells, LEAST);
        may_continue()?;
        let faces: Vec<u32> = cells.into_iter().map(|(_, face)| face).collect();
        let mut place_of_face = vec![0; faces.len()];
        let mut vertices = Vec::with_capacity(mesh.vertex_count());
        let mut place_of_vertex = vec![u32::MAX; mesh.vertex_count()];
        for (place, &face) in faces.iter().enumerate() {
            place_of_face[face as usize] = place as u32;
            for &v in &mesh.triangles()[face as usize] {
                let place = &mut place_of_vertex[v as usize];
                if *place == u32::MAX {
                    *place = vertices.len() as u32;
                    vertices.push(v);
                }
            }
        }
        may_continue()?;
        Ok(Reordered {
            mesh: mesh.in_order([&faces, &vertices], [&place_of_face, &place_of_vertex])?,
            faces,
            vertices,
            place_of_face,
            place_of_vertex,
        })
    }

    /// The numbers that these faces had, in increasing order.
    pub fn given_faces(&self, places: &[usize]) -> Vec<usize> {
        sorted(places, |place| self.face(place))
    }

    /// The numbers that these vertices had, in increasing order.
    pub fn given_vertices(&self, places: &[usize]) -> Vec<usize> {
        sorted(places, |place| self.vertex(place))
    }

    /// The numbers that these edges had in `given`, the mesh as it was, in increasing order.
    pub fn given_edges(&self, given: &TriangleMesh, places: &[usize]) -> Vec<usize> {
        sorted(places, |place| self.edge(given, place))
    }

    /// The number that a face had.
    pub fn face(&self, place: usize) -> usize {
        self.faces[place] as usize
    }

    /// The number that a vertex had.
    pub fn vertex(&self, place: usize) -> usize {
        self.vertices[place] as usize
    }

    /// The number that an edge of this mesh had in `given`, the mesh as it was.
    pub fn edge(&self, given: &TriangleMesh, place: usize) -> usize {
        let (face, k) = self.mesh.edge(place).first;
        given.edge_of(self.face(face), k)
    }

    pub fn place_of_face(&self, face: usize) -> usize {
        self.place_of_face[face] as usize
    }

    pub fn place_of_vertex(&self, vertex: usize) -> usize {
        self.place_of_vertex[vertex] as usize
    }

    /// Where an edge of `given`, the mesh as it was, is now, and whether its first side is the other one.
    pub fn place_of_edge(&self, given: &TriangleMesh, edge: usize) -> (usize, bool) {
        let (face, k) = given.edge(edge).first;
        let place = self.place_of_face(face);
        let is_turned = !self.mesh.is_first_side(place, k);
        (self.mesh.edge_of(place, k), is_turned)
    }

    /// Where these vertices are now, in their order.
    pub fn places_of_vertices(&self, vertices: &[usize]) -> Vec<usize> {
        let places = vertices.iter().map(|&v| self.place_of_vertex(v));
        places.collect()
    }

    /// Where these edges of `given`, the mesh as it was, are now, in their order.
    pub fn places_of_edges(&self, given: &TriangleMesh, edges: &[usize]) -> Vec<usize> {
        let places = edges.iter().map(|&e| self.place_of_edge(given, e).0);
        places.collect()
    }

    /// The number that each face had.
    pub fn faces(&self) -> &[u32] {
        &self.faces
    }

    /// Values of vertices as they were, in the order of this mesh.
    pub fn of_vertices<T: Clone>(&self, values: &[T]) -> Vec<T> {
        picked(values, &self.vertices)
    }

    /// Values of faces as they were, in the order of this mesh; none if there are none.
    pub fn of_faces<T: Clone>(&self, values: &[T]) -> Vec<T> {
        match values.is_empty() {
            true => Vec::new(),
            false => picked(values, &self.faces),
        }
    }

    /// Values of the faces of this mesh, in the order in which they were.
    pub fn of_given_faces<T: Clone>(&self, values: &[T]) -> Vec<T> {
        picked(values, &self.place_of_face)
    }
}

fn sorted(places: &[usize], number: impl Fn(usize) -> usize) -> Vec<usize> {
    let mut numbers: Vec<usize> = places.iter().map(|&place| number(place)).collect();
    numbers.sort_unstable();
    numbers
}

fn picked<T: Clone>(values: &[T], places: &[u32]) -> Vec<T> {
    let picked = places.iter().map(|&at| values[at as usize].clone());
    picked.collect()
}

/// The number of the cell of space in which a point of the box at `low` is: the bits of its numbers along the axes in
/// turn, so that cells with near numbers are near each other.
fn cell(point: Vec3, low: Vec3, size: f64) -> u64 {
    let cells = f64::from(1u32 << BITS);
    let along = sub(point, low).map(|x| (x / size * cells) as u64);
    let along = along.map(|k| k.min((1 << BITS) - 1));
    let bit = |k: u32| (0..3).fold(0, |bits, axis| bits << 1 | along[axis] >> k & 1);
    (0..BITS).rev().fold(0, |cell, k| cell << 3 | bit(k))
}

/// Whether the faces or the vertices of many edges have numbers that are far apart.
fn is_scattered(mesh: &TriangleMesh) -> bool {
    let near = |count: usize| (ROOTS * (count as f64).sqrt()) as usize;
    let [near_face, near_vertex] = [mesh.face_count(), mesh.vertex_count()].map(near);
    let looks = LOOKS.min(mesh.edge_count());
    let [mut far_faces, mut far_vertices] = [0, 0];
    for k in 0..looks {
        let edge = mesh.edge(k * mesh.edge_count() / looks);
        let [a, b] = edge.vertices;
        far_vertices += usize::from(a.abs_diff(b) > near_vertex);
        let second = edge.second.map_or(edge.first.0, |(face, _)| face);
        far_faces += usize::from(edge.first.0.abs_diff(second) > near_face);
    }
    far_faces.max(far_vertices) as f64 > FAR * looks as f64
}

/// A mesh with its faces and vertices in a random order.
#[cfg(test)]
pub(crate) fn shuffled(mesh: &TriangleMesh) -> TriangleMesh {
    let mut random = crate::test_random::Random::new(7);
    let mut order = |n: usize| {
        let mut order: Vec<u32> = (0..n as u32).collect();
        (1..n).for_each(|k| order.swap(k, random.below(k + 1)));
        order
    };
    let vertices = order(mesh.vertex_count());
    let mut place = vec![0; vertices.len()];
    for (at, &v) in vertices.iter().enumerate() {
        place[v as usize] = at as u32;
    }
    let faces = order(mesh.face_count());
    let triangles = picked(mesh.triangles(), &faces);
    let triangles = triangles.into_iter().map(|t| t.map(|v| place[v as usize]));
    TriangleMesh::new(picked(mesh.vertices(), &vertices), triangles.collect()).unwrap()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape::by_name;
    use crate::monitor::{spawned, with_threads};

    #[test]
    fn large_meshes_in_no_order_are_put_into_one_and_others_stay() {
        for name in ["torus", "genus-2", "plane"] {
            let mesh = by_name(name, 40_000).unwrap();
            assert!(Reordered::if_scattered(&mesh).unwrap().is_none(), "{name}");
            let scattered = shuffled(&mesh);
            let reordered = Reordered::if_scattered(&scattered).unwrap().unwrap();
            assert!(!is_scattered(&reordered.mesh), "{name}");
        }
        let small = shuffled(&by_name("torus", 2_000).unwrap());
        assert!(is_scattered(&small) && Reordered::if_scattered(&small).unwrap().is_none());
    }

    #[test]
    fn connectivity_is_that_of_a_mesh_that_is_made_in_this_order() {
        for (name, faces) in [("torus", 1_000), ("plane", 70_000), ("gear", 1_000)] {
            let scattered = shuffled(&by_name(name, faces).unwrap());
            scattered.angles();
            let mut mesh = None;
            let made = || mesh = Some(with_threads(3, || Reordered::new(&scattered).unwrap().mesh));
            assert_eq!(spawned(made) > 0, faces > LEAST, "{name}");
            let mesh = mesh.unwrap();
            let made = TriangleMesh::new(mesh.vertices().to_vec(), mesh.triangles().to_vec());
            let made = made.unwrap();
            assert!(mesh.edges().eq(made.edges()), "{name}");
            assert!(
                mesh.angles
                    .get()
                    .is_some_and(|known| known == made.angles())
            );
            for v in 0..mesh.vertex_count() {
                assert!(mesh.ring(v).eq(made.ring(v)), "{name}");
            }
            for face in 0..mesh.face_count() {
                for k in 0..3 {
                    assert_eq!(mesh.neighbor(face, k), made.neighbor(face, k), "{name}");
                    assert_eq!(mesh.edge_of(face, k), made.edge_of(face, k), "{name}");
                }
            }
        }
    }

    #[test]
    fn cells_with_near_numbers_are_near_each_other() {
        let at = |p: Vec3| cell(p, [0.0; 3], 2.0);
        assert_eq!(at([0.0; 3]), 0);
        assert_eq!(at([2.0; 3]), (1 << (3 * BITS)) - 1);
        // The halves along the first axis, then those along the others.
        let half = 1 << (3 * BITS - 1);
        assert_eq!(at([1.0, 0.0, 0.0]), half);
        assert_eq!(at([0.0, 1.0, 0.0]), half / 2);
        assert_eq!(at([0.0, 0.0, 1.0]), half / 4);
        assert_eq!(at([0.5, 0.0, 0.0]), half / 8);
    }

    #[test]
    fn elements_are_found_in_both_directions() {
        let given = shuffled(&by_name("plane", 500).unwrap());
        let reordered = Reordered::new(&given).unwrap();
        let mesh = &reordered.mesh;
        for face in 0..given.face_count() {
            let place = reordered.place_of_face(face);
            assert_eq!(reordered.face(place), face);
            let corners = mesh.corners(place).map(|v| reordered.vertex(v));
            assert_eq!(corners, given.corners(face));
            assert_eq!(mesh.corner_positions(place), given.corner_positions(face));
        }
        for vertex in 0..given.vertex_count() {
            assert_eq!(reordered.vertex(reordered.place_of_vertex(vertex)), vertex);
        }
        let mut turned = 0;
        for (e, edge) in given.edges().enumerate() {
            let (place, is_turned) = reordered.place_of_edge(&given, e);
            assert_eq!(reordered.edge(&given, place), e);
            let mut vertices = mesh.edge(place).vertices.map(|v| reordered.vertex(v));
            if is_turned {
                vertices.reverse();
            }
            assert_eq!(vertices, edge.vertices);
            turned += usize::from(is_turned);
        }
        assert!(turned > 100);
        let numbers: Vec<usize> = (0..given.face_count()).collect();
        let there = picked(&numbers, reordered.faces());
        assert_eq!(there[reordered.place_of_face(7)], 7);
        assert_eq!(reordered.of_given_faces(&there), numbers);
        let numbers: Vec<usize> = (0..given.vertex_count()).collect();
        assert_eq!(
            reordered.of_vertices(&numbers)[reordered.place_of_vertex(9)],
            9
        );
    }
}

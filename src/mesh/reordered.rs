//! The same mesh with faces and vertices that are near each other in space near each other in memory.
//!
//! Files of scanners and of mesh reduction have faces in an order in which neighbours are anywhere. Every walk over
//! the surface, and over the unknowns of its problems, then waits for memory: a field, a map and quads of a mesh of
//! 200,000 such faces take half as long again, or twice as long, as in this order.

use super::{ClosestPoint, MeshError, TriangleMesh};

/// The faces of a mesh that is in the cache in any order.
const FEW: usize = 1 << 15;

/// The most edges, as a part of all, whose two faces or vertices may be far apart. Where the order follows the
/// surface, about one in sixteen are.
const FAR: f64 = 0.25;

/// Numbers are far apart if they differ by more than so many times the root of how many there are. Those of
/// neighbours in two rows of a grid differ by one root.
const ROOTS: f64 = 4.0;

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
    /// Those of [`new`](Self::new).
    pub fn if_scattered(mesh: &TriangleMesh) -> Result<Option<Self>, MeshError> {
        match mesh.face_count() > FEW && is_scattered(mesh) {
            true => Self::new(mesh).map(Some),
            false => Ok(None),
        }
    }

    /// The mesh in the order of its boxes in space.
    ///
    /// # Errors
    /// None for a mesh whose faces and vertices can be made again.
    pub fn new(mesh: &TriangleMesh) -> Result<Self, MeshError> {
        let faces = ClosestPoint::new(mesh).into_order();
        let mut vertices = Vec::with_capacity(mesh.vertex_count());
        let mut place_of_vertex = vec![u32::MAX; mesh.vertex_count()];
        let mut place_of_face = vec![0; mesh.face_count()];
        let mut triangles = Vec::with_capacity(mesh.face_count());
        for (place, &face) in faces.iter().enumerate() {
            place_of_face[face as usize] = place as u32;
            triangles.push(mesh.triangles()[face as usize].map(|v| {
                let place = &mut place_of_vertex[v as usize];
                if *place == u32::MAX {
                    *place = vertices.len() as u32;
                    vertices.push(v);
                }
                *place
            }));
        }
        let positions = vertices.iter().map(|&v| mesh.position(v as usize));
        Ok(Reordered {
            mesh: TriangleMesh::new(positions.collect(), triangles)?,
            faces,
            vertices,
            place_of_face,
            place_of_vertex,
        })
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

    /// The number that each face had.
    pub fn faces(&self) -> &[u32] {
        &self.faces
    }

    /// Values of vertices as they were, in the order of this mesh.
    pub fn of_vertices<T: Clone>(&self, values: &[T]) -> Vec<T> {
        picked(values, &self.vertices)
    }

    /// Values of the faces of this mesh, in the order in which they were.
    pub fn of_given_faces<T: Clone>(&self, values: &[T]) -> Vec<T> {
        picked(values, &self.place_of_face)
    }
}

fn picked<T: Clone>(values: &[T], places: &[u32]) -> Vec<T> {
    let picked = places.iter().map(|&at| values[at as usize].clone());
    picked.collect()
}

/// Whether the faces or the vertices of many edges have numbers that are far apart.
fn is_scattered(mesh: &TriangleMesh) -> bool {
    let [faces, vertices] = [mesh.face_count(), mesh.vertex_count()];
    let near = |count: usize| (ROOTS * (count as f64).sqrt()) as usize;
    let [near_face, near_vertex] = [faces, vertices].map(near);
    let [mut far_faces, mut far_vertices] = [0, 0];
    for edge in mesh.edges() {
        let [a, b] = edge.vertices;
        far_vertices += usize::from(a.abs_diff(b) > near_vertex);
        let second = edge.second.map_or(edge.first.0, |(face, _)| face);
        far_faces += usize::from(edge.first.0.abs_diff(second) > near_face);
    }
    far_faces.max(far_vertices) as f64 > FAR * mesh.edge_count() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape::by_name;
    use crate::test_random::Random;

    /// A mesh with its faces and vertices in a random order.
    fn shuffled(mesh: &TriangleMesh) -> TriangleMesh {
        let mut random = Random::new(7);
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

//! The quads of each component of a mesh, apart and joined again.

use crate::extract::{Origin, QuadMesh};
use crate::mesh::TriangleMesh;

/// The components of a mesh, with what their quads must have.
pub(super) struct Components {
    pub(super) count: usize,
    /// The component of each face.
    pub(super) of_face: Vec<usize>,
    /// The Euler characteristic of each.
    euler: Vec<i64>,
}

impl Components {
    /// The components.
    pub(super) fn new(mesh: &TriangleMesh) -> Self {
        let found = mesh.components();
        let of_face: Vec<usize> = found.of_face.iter().map(|&c| c as usize).collect();
        let mut euler = vec![0; found.count];
        of_face.iter().for_each(|&c| euler[c] += 1);
        mesh.edges()
            .for_each(|edge| euler[of_face[edge.first.0]] -= 1);
        let mut components = Components {
            count: found.count,
            of_face,
            euler,
        };
        for vertex in 0..mesh.vertex_count() {
            if let Some(c) = components.of_vertex(mesh, vertex) {
                components.euler[c] += 1;
            }
        }
        components
    }

    fn of_vertex(&self, mesh: &TriangleMesh, vertex: usize) -> Option<usize> {
        let (face, _) = mesh.ring(vertex).next()?;
        Some(self.of_face[face])
    }

    /// The faces of each component, in increasing order.
    pub(super) fn faces(&self) -> Vec<Vec<usize>> {
        let mut faces = vec![Vec::new(); self.count];
        for (face, &c) in self.of_face.iter().enumerate() {
            faces[c].push(face);
        }
        faces
    }

    /// The quads of each component, with its Euler characteristic and its folded triangles. The first has
    /// the counts of the extraction.
    pub(super) fn split(&self, mesh: &TriangleMesh, quads: &QuadMesh) -> Vec<QuadMesh> {
        let of_origin = |&origin: &Origin| match origin {
            Origin::Vertex(vertex) => self.of_vertex(mesh, vertex),
            Origin::Face(face, _) => Some(self.of_face[face]),
            Origin::Middle => None,
        };
        let component: Vec<Option<usize>> = quads.origins.iter().map(of_origin).collect();
        // Vertices in the middle of cells are those of the face that they are in.
        let of_polygon = |polygon: &[u32]| {
            let known = polygon.iter().find_map(|&v| component[v as usize]);
            known.unwrap_or(0)
        };
        let mut parts: Vec<QuadMesh> = self
            .euler
            .iter()
            .map(|&euler| QuadMesh::from_quads(Vec::new(), Vec::new(), euler))
            .collect();
        // The component that a vertex was last added to, and its number there.
        let mut numbers = vec![(usize::MAX, 0); quads.vertices.len()];
        let mut number = |c: usize, part: &mut QuadMesh, v: u32| {
            let known = &mut numbers[v as usize];
            if known.0 != c {
                *known = (c, part.vertices.len() as u32);
                part.vertices.push(quads.vertices[v as usize]);
                part.origins.push(quads.origins[v as usize]);
            }
            known.1
        };
        for quad in &quads.quads {
            let c = of_polygon(quad);
            let corners = quad.map(|v| number(c, &mut parts[c], v));
            parts[c].quads.push(corners);
        }
        for polygon in &quads.others {
            let c = of_polygon(polygon);
            let corners = polygon.iter().map(|&v| number(c, &mut parts[c], v));
            let corners = corners.collect();
            parts[c].others.push(corners);
        }
        for &face in &quads.folded {
            parts[self.of_face[face]].folded.push(face);
        }
        if let Some(first) = parts.first_mut() {
            first.partial_cells = quads.partial_cells;
            first.folds_removed = quads.folds_removed;
            first.repaired = quads.repaired;
        }
        parts
    }
}

/// The quads of all components as one mesh.
pub(super) fn join(parts: Vec<QuadMesh>) -> QuadMesh {
    let mut whole = QuadMesh::from_quads(Vec::new(), Vec::new(), 0);
    for part in parts {
        let first = whole.vertices.len() as u32;
        whole.vertices.extend(part.vertices);
        whole.origins.extend(part.origins);
        let quads = part.quads.into_iter();
        whole
            .quads
            .extend(quads.map(|quad| quad.map(|v| v + first)));
        let others = part.others.into_iter();
        let moved = |polygon: Vec<u32>| polygon.into_iter().map(|v| v + first).collect();
        whole.others.extend(others.map(moved));
        whole.partial_cells += part.partial_cells;
        whole.folds_removed += part.folds_removed;
        whole.repaired += part.repaired;
        whole.folded.extend(part.folded);
        whole.expected_euler += part.expected_euler;
    }
    whole.folded.sort_unstable();
    whole.folded.dedup();
    whole
}

#[cfg(test)]
mod tests {
    use super::super::quadrangulate;
    use super::*;
    use crate::mesh::shape::by_name;
    use crate::monitor::Monitor;
    use crate::quad::QuadOptions;

    /// A torus, and a cube beside it.
    fn two() -> TriangleMesh {
        let [torus, cube] = ["torus", "rounded-cube"].map(|name| by_name(name, 600).unwrap());
        let first = torus.vertex_count() as u32;
        let mut points = torus.vertices().to_vec();
        points.extend(cube.vertices().iter().map(|p| [p[0] + 9.0, p[1], p[2]]));
        let mut triangles = torus.triangles().to_vec();
        triangles.extend(cube.triangles().iter().map(|t| t.map(|v| v + first)));
        TriangleMesh::new(points, triangles).unwrap()
    }

    #[test]
    fn quads_that_are_split_conform_apart_and_joined() {
        let mesh = two();
        let made = quadrangulate(&mesh, &QuadOptions::default(), Monitor::default).unwrap();
        let components = Components::new(&mesh);
        let parts = components.split(&mesh, &made.quads);
        assert_eq!(
            parts.iter().map(|p| p.expected_euler).collect::<Vec<_>>(),
            [0, 2]
        );
        assert!(parts.iter().all(QuadMesh::is_conforming));
        let joined = join(parts);
        assert!(joined.is_conforming());
        assert_eq!(joined.quads.len(), made.quads.quads.len());
        assert_eq!(joined.figures(), made.quads.figures());
        assert_eq!(joined.repaired, made.quads.repaired);
    }
}

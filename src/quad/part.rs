//! A component of a mesh as a mesh of its own, and what was given for its elements.

use super::QuadOptions;
use crate::error::Result;
use crate::extract::{Origin, QuadMesh};
use crate::field::{Guidance, PrescribedIndex};
use crate::map::Sizing;
use crate::mesh::TriangleMesh;
use crate::smooth::SmoothOptions;

/// The least number of quads that is asked for: a closed surface needs six.
const LEAST: f64 = 8.0;

/// Faces of a mesh that are connected to no others, as a mesh.
pub(super) struct Part {
    pub(super) mesh: TriangleMesh,
    /// The face of the whole mesh of each face, in increasing order.
    faces: Vec<usize>,
    /// The vertex of the whole mesh of each vertex, in increasing order.
    vertices: Vec<usize>,
}

impl Part {
    /// The part with these faces, which are in increasing order.
    ///
    /// # Errors
    /// Those of [`TriangleMesh::new`].
    pub(super) fn new(whole: &TriangleMesh, faces: Vec<usize>) -> Result<Self> {
        let corners = faces.iter().flat_map(|&face| whole.corners(face));
        let mut vertices: Vec<usize> = corners.collect();
        vertices.sort_unstable();
        vertices.dedup();
        let number = |v: usize| vertices.partition_point(|&other| other < v) as u32;
        let triangles = faces.iter().map(|&face| whole.corners(face).map(number));
        let points = vertices.iter().map(|&v| whole.position(v));
        Ok(Part {
            mesh: TriangleMesh::new(points.collect(), triangles.collect())?,
            faces,
            vertices,
        })
    }

    /// The options for the part: what was given for its elements, and quads as large as those of the whole
    /// mesh if a few of them have room. Strategies are not compared.
    pub(super) fn options(&self, whole: &TriangleMesh, options: &QuadOptions) -> QuadOptions {
        let smooth = options.smooth.as_ref().map(|given| SmoothOptions {
            features: self.edges(whole, &given.features),
            ..given.clone()
        });
        QuadOptions {
            sizing: self.sizing(whole, &options.sizing),
            guidance: self.guidance(whole, &options.guidance),
            smooth,
            density: match options.density.is_empty() {
                true => Vec::new(),
                false => self.vertices.iter().map(|&v| options.density[v]).collect(),
            },
            near_vertices: self.own(&options.near_vertices),
            compare: Vec::new(),
            ..options.clone()
        }
    }

    fn sizing(&self, whole: &TriangleMesh, sizing: &Sizing) -> Sizing {
        let area = self.mesh.surface_area();
        let edge = sizing.edge_length(whole);
        match sizing {
            Sizing::Quads(_) => Sizing::Quads((area / (edge * edge)).max(LEAST).round() as usize),
            Sizing::EdgeLength(_) => Sizing::EdgeLength(edge.min((area / LEAST).sqrt())),
            Sizing::Lengths(lengths) => {
                Sizing::Lengths(self.faces.iter().map(|&face| lengths[face]).collect())
            }
            Sizing::Graded { lengths, .. } => Sizing::Graded {
                quads: (area / (edge * edge)).max(LEAST).round() as usize,
                lengths: self.faces.iter().map(|&face| lengths[face]).collect(),
            },
        }
    }

    fn guidance(&self, whole: &TriangleMesh, given: &Guidance) -> Guidance {
        let constraints = given.constraints.iter().filter_map(|constraint| {
            let face = self.face(constraint.face)?;
            Some(crate::field::Constraint {
                face,
                ..*constraint
            })
        });
        let guides = given.guides.iter().filter_map(|guide| {
            let face = self.face(guide.face)?;
            Some(crate::field::Guide { face, ..*guide })
        });
        let indices = given.indices.as_ref().map(|indices| {
            let own = indices.iter().filter_map(|index| {
                let vertex = self.vertices.binary_search(&index.vertex).ok()?;
                Some(PrescribedIndex { vertex, ..*index })
            });
            own.collect()
        });
        let lines = given.feature_lines.iter().filter_map(|&[a, b]| {
            let own = [a, b].map(|v| self.vertices.binary_search(&v).ok());
            Some([own[0]?, own[1]?])
        });
        Guidance {
            constraints: constraints.collect(),
            guides: guides.collect(),
            indices,
            feature_lines: lines.collect(),
            feature_edges: self.edges(whole, &given.feature_edges),
            ..given.clone()
        }
    }

    /// Those of these vertices of the whole mesh that are vertices of the part.
    fn own(&self, vertices: &[usize]) -> Vec<usize> {
        let own = vertices.iter().map(|v| self.vertices.binary_search(v).ok());
        own.flatten().collect()
    }

    /// The number of a face of the whole mesh in the part.
    fn face(&self, face: usize) -> Option<usize> {
        self.faces.binary_search(&face).ok()
    }

    /// Those of these edges of the whole mesh that are edges of the part.
    fn edges(&self, whole: &TriangleMesh, edges: &[usize]) -> Vec<usize> {
        let own = edges.iter().filter_map(|&edge| {
            let (face, k) = whole.edge(edge).first;
            Some(self.mesh.edge_of(self.face(face)?, k))
        });
        own.collect()
    }

    /// Edges of the part by their numbers in the whole mesh.
    pub(super) fn edges_of_whole<'a>(
        &'a self,
        whole: &'a TriangleMesh,
        edges: &'a [usize],
    ) -> impl Iterator<Item = usize> + 'a {
        edges.iter().map(|&edge| {
            let (face, k) = self.mesh.edge(edge).first;
            whole.edge_of(self.faces[face], k)
        })
    }

    /// Quads of the part that name elements of the whole mesh.
    pub(super) fn on_whole(&self, mut quads: QuadMesh) -> QuadMesh {
        for origin in &mut quads.origins {
            *origin = match *origin {
                Origin::Vertex(vertex) => Origin::Vertex(self.vertices[vertex]),
                Origin::Face(face, weights) => Origin::Face(self.faces[face], weights),
                Origin::Middle => Origin::Middle,
            };
        }
        quads.folded.iter_mut().for_each(|f| *f = self.faces[*f]);
        quads
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::Constraint;
    use crate::mesh::shape::by_name;

    /// Two tetrahedra, whose faces alternate.
    fn two() -> TriangleMesh {
        let tetrahedron = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let points = [0.0, 5.0].map(|x| corners.map(|p: [f64; 3]| [p[0] + x, p[1], p[2]]));
        let both = tetrahedron.map(|t: [u32; 3]| [t, t.map(|v| v + 4)]);
        TriangleMesh::new(points.concat(), both.concat()).unwrap()
    }

    #[test]
    fn what_is_given_for_elements_is_given_for_those_of_the_part() {
        let mesh = two();
        let part = Part::new(&mesh, vec![1, 3, 5, 7]).unwrap();
        assert_eq!(part.vertices, [4, 5, 6, 7]);
        let of = |face: usize| Constraint { face, angle: 0.5 };
        let edges: Vec<usize> = (0..mesh.edge_count()).collect();
        let options = QuadOptions {
            sizing: Sizing::Lengths((0..8).map(|f| [1.0 + f as f64; 2]).collect()),
            guidance: Guidance {
                constraints: vec![of(2), of(5)],
                feature_lines: vec![[0, 1], [5, 4]],
                feature_edges: edges.clone(),
                indices: Some(vec![PrescribedIndex {
                    vertex: 6,
                    steps: 1,
                }]),
                ..Guidance::default()
            },
            ..QuadOptions::default()
        };
        let own = part.options(&mesh, &options);
        assert_eq!(
            own.sizing,
            Sizing::Lengths([2.0, 4.0, 6.0, 8.0].map(|l| [l; 2]).to_vec())
        );
        assert_eq!(own.guidance.constraints, [of(2)]);
        assert_eq!(own.guidance.feature_lines, [[1, 0]]);
        assert_eq!(own.guidance.indices.unwrap()[0].vertex, 2);
        let mut features = own.guidance.feature_edges;
        assert_eq!(features.len(), 6);
        features.sort_unstable();
        let back: Vec<usize> = part.edges_of_whole(&mesh, &features).collect();
        assert!(
            back.iter()
                .all(|&e| mesh.edge(e).vertices.iter().all(|&v| v >= 4))
        );
    }

    #[test]
    fn a_part_has_room_for_a_few_quads() {
        let mesh = two();
        let part = Part::new(&mesh, vec![0, 2, 4, 6]).unwrap();
        let options = QuadOptions {
            sizing: Sizing::Quads(4),
            ..QuadOptions::default()
        };
        assert_eq!(part.options(&mesh, &options).sizing, Sizing::Quads(8));
        let large = by_name("sphere", 200).unwrap();
        let all = Part::new(&large, (0..large.face_count()).collect()).unwrap();
        let options = QuadOptions::default();
        assert_eq!(all.options(&large, &options).sizing, Sizing::Quads(1000));
    }
}

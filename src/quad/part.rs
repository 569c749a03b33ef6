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

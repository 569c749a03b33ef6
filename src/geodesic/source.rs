//! What distances are measured from.

use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{Vec3, add, scale};

/// A point of the surface: a face, and three weights of its corners that add up to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// The face.
    pub face: usize,
    /// The weights of its corners.
    pub barycentric: [f64; 3],
}

impl SurfacePoint {
    /// A vertex of the mesh, as a corner of the first face around it.
    ///
    /// # Panics
    /// If the vertex does not exist.
    pub fn vertex(mesh: &TriangleMesh, vertex: usize) -> Self {
        let mut ring = mesh.ring(vertex);
        let (face, k) = ring.next().expect("every vertex has a face");
        let mut barycentric = [0.0; 3];
        barycentric[k] = 1.0;
        SurfacePoint { face, barycentric }
    }

    /// Its position.
    ///
    /// # Panics
    /// If the face does not exist.
    pub fn position(&self, mesh: &TriangleMesh) -> Vec3 {
        let corners = mesh.corner_positions(self.face);
        let parts = [0, 1, 2].map(|k| scale(corners[k], self.barycentric[k]));
        add(add(parts[0], parts[1]), parts[2])
    }
}

/// A source of distances. Distance is 0 on all of it.
#[derive(Debug, Clone, PartialEq)]
pub enum Source {
    /// A vertex.
    Vertex(usize),
    /// A point of the surface.
    Point(SurfacePoint),
    /// A polyline on the surface: the straight segments between points that follow each other, which must lie on a
    /// common face, its boundary included.
    Polyline {
        /// The points.
        points: Vec<SurfacePoint>,
        /// Whether a segment joins the last point with the first.
        closed: bool,
    },
    /// Edges of the mesh, in any order.
    Edges(Vec<usize>),
}

impl Source {
    /// The boundary of a mesh, each loop a source, in the order of [`TriangleMesh::boundary_loops`].
    pub fn boundary(mesh: &TriangleMesh) -> Vec<Source> {
        let edges = |l: &Vec<(usize, usize)>| l.iter().map(|&(f, k)| mesh.edge_of(f, k)).collect();
        let loops = mesh.boundary_loops();
        loops.iter().map(|l| Source::Edges(edges(l))).collect()
    }

    /// The curves of a feature graph, each a source, in the order of [`FeatureGraph::curves`].
    pub fn features(graph: &FeatureGraph) -> Vec<Source> {
        let curves = graph.curves().iter();
        curves.map(|c| Source::Edges(c.edges.clone())).collect()
    }

    /// Whether it lies on the surface. `number` is its place among the sources, which errors name.
    pub(super) fn check(&self, mesh: &TriangleMesh, number: usize) -> Result<()> {
        match self {
            Source::Vertex(v) => in_range("source vertices", number, *v, mesh.vertex_count()),
            Source::Point(point) => check_point(mesh, SOURCE, number, 0, point),
            Source::Polyline { points, .. } => {
                let mut places = points.iter().enumerate();
                places.try_for_each(|(i, p)| check_point(mesh, SOURCE, number, i, p))
            }
            Source::Edges(edges) => {
                let mut edges = edges.iter();
                let count = mesh.edge_count();
                edges.try_for_each(|&e| in_range("source edges", number, e, count))
            }
        }
    }
}

/// How far a barycentric coordinate may be outside of [0, 1], and the sum of all from 1.
pub const BARYCENTRIC_TOLERANCE: f64 = 1e-9;

/// What errors call a source, its faces and its coordinates.
const SOURCE: [&str; 3] = [
    "source",
    "source faces",
    "barycentric coordinates of sources",
];

/// Whether a point lies on the surface. Its place is `index` of what is called this, of this number.
pub(super) fn check_point(
    mesh: &TriangleMesh,
    [what, faces, coordinates]: [&'static str; 3],
    number: usize,
    index: usize,
    p: &SurfacePoint,
) -> Result<()> {
    in_range(faces, number, p.face, mesh.face_count())?;
    is_in_triangle(p.barycentric).map_err(|wrong| match wrong {
        None => Error::NotFinite {
            what: coordinates,
            position: number,
        },
        Some(wrong) => Error::InvalidArgument {
            what: format!(
                "{what} {number}: point {index} is outside of face {}: {wrong}",
                p.face
            ),
            index: Some(number),
        },
    })
}

/// Whether these are the coordinates of a point of a triangle; else what is wrong, nothing for NaN and infinity.
pub(super) fn is_in_triangle(barycentric: [f64; 3]) -> std::result::Result<(), Option<String>> {
    if !barycentric.iter().all(|x| x.is_finite()) {
        return Err(None);
    }
    if let Some(x) = barycentric.iter().find(|x| **x < -BARYCENTRIC_TOLERANCE) {
        return Err(Some(format!("a barycentric coordinate is {x}")));
    }
    let sum: f64 = barycentric.iter().sum();
    match (sum - 1.0).abs() <= BARYCENTRIC_TOLERANCE {
        true => Ok(()),
        false => Err(Some(format!("the barycentric coordinates add up to {sum}"))),
    }
}

fn in_range(what: &'static str, position: usize, value: usize, len: usize) -> Result<()> {
    match value < len {
        true => Ok(()),
        false => Err(Error::IndexOutOfRange {
            what,
            position,
            value: i64::try_from(value).unwrap_or(i64::MAX),
            len,
        }),
    }
}

//! The constraint of each vertex: to the surface, to a curve on it, or to a point.

use std::collections::BTreeMap;

use super::curve::Curve;
use crate::error::Result;
use crate::extract::{Origin, QuadMesh};
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{Vec3, cross, dot, norm, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};
use crate::monitor::{collect_in_parts, may_continue};

/// The constraint of a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Bond {
    Surface,
    /// The curve of this number.
    Curve(u32),
    Fixed,
}

/// The most triangles that closest points are looked for among, for each vertex of the quads. On other meshes
/// than those of needles across the axes, sixty rounds take about 500.
const WORK_PER_VERTEX: u64 = 20_000;

/// How far from an edge of the boundary a point counts as on it, as a part of the length of the edge.
const ON_RIM: f64 = 1e-12;

/// The least number of vertices that are worth a thread.
const LEAST: usize = 1 << 8;

/// The surface with its curves: boundary and features.
pub(super) struct Surface {
    faces: ClosestPoint,
    /// The curves, each with its own search tree: curves may be closer to each other than vertices are.
    pub(super) curves: Vec<Curve>,
    pub(super) bonds: Vec<Bond>,
    /// The vertex of the mesh at which each fixed vertex lies, where curves end, meet or turn.
    pub(super) node: Vec<Option<usize>>,
    /// The edges of the boundary that each triangle touches, if it touches some.
    rims: BTreeMap<usize, Vec<[Vec3; 2]>>,
    /// The triangle or segment in which each vertex was last found.
    hints: Vec<Option<usize>>,
    pub(super) fixed: Vec<Vec3>,
    /// The triangles of the surface that were looked at so far.
    work: u64,
}

impl Surface {
    /// `faces` is the tree of the mesh, made here if there is none yet.
    pub(super) fn new(
        quads: &QuadMesh,
        mesh: &TriangleMesh,
        faces: Option<ClosestPoint>,
        features: &FeatureGraph,
    ) -> Result<Self> {
        let mut on = vec![Bond::Surface; mesh.edge_count()];
        for (number, curve) in features.curves().iter().enumerate() {
            for &edge in &curve.edges {
                on[edge] = Bond::Curve(number as u32);
            }
        }
        let mut is_node = vec![false; mesh.vertex_count()];
        for &v in features.corners().iter().chain(features.open_ends()) {
            is_node[v] = true;
        }
        let place = |origin: &Origin| place(mesh, &on, &is_node, origin);
        let (bonds, node) = quads.origins.iter().map(place).unzip();
        let curve = |curve| Curve::new(mesh, curve);
        may_continue()?;
        let faces = faces.unwrap_or_else(|| ClosestPoint::new(mesh));
        may_continue()?;
        Ok(Surface {
            faces,
            curves: features.curves().iter().map(curve).collect(),
            rims: rims(mesh),
            bonds,
            node,
            hints: quads.origins.iter().map(|_| None).collect(),
            fixed: quads.vertices.clone(),
            work: 0,
        })
    }

    /// Notes a vertex that was added to the quads at this point, and the node that it is, if any.
    pub(super) fn add_vertex(&mut self, at: Vec3, bond: Bond, node: Option<usize>) {
        self.bonds.push(bond);
        self.node.push(node);
        self.hints.push(None);
        self.fixed.push(at);
    }

    /// Whether closest points have taken so long that no more may be looked for.
    pub(super) fn has_spent_its_work(&self) -> bool {
        self.work > WORK_PER_VERTEX * self.fixed.len() as u64
    }

    /// The point nearest to `p` that satisfies the constraint of the vertex. None for a vertex inside the surface that
    /// would come to lie on its boundary, and touch what is beyond it.
    pub(super) fn project(&mut self, vertex: usize, p: Vec3) -> Option<Vec3> {
        let found = self.find(vertex, p);
        self.keep(vertex, found)
    }

    /// Moves each vertex to the point nearest to its wanted one that satisfies its constraint, if there is one.
    pub(super) fn project_all(
        &mut self,
        wanted: impl Fn(usize) -> Option<Vec3> + Sync,
        vertices: &mut [Vec3],
    ) {
        let found = collect_in_parts(vertices.len(), LEAST, |v| Some(self.find(v, wanted(v)?)));
        for (v, found) in found.into_iter().enumerate() {
            if let Some(point) = found.and_then(|found| self.keep(v, found)) {
                vertices[v] = point;
            }
        }
    }

    fn find(&self, vertex: usize, p: Vec3) -> Found {
        let hint = self.hints[vertex];
        let mut work = 0;
        let at = match self.bonds[vertex] {
            Bond::Surface => self.faces.find_counted(p, hint, &mut work),
            Bond::Curve(number) => self.curves[number as usize].closest(p, hint),
            Bond::Fixed => None,
        };
        Found { at, work }
    }

    /// Whether a vertex inside the surface would come to lie on the boundary.
    fn is_driven_out(&self, vertex: usize, face: usize, point: Vec3) -> bool {
        let is_on = |&[a, b]: &[Vec3; 2]| {
            let (along, there) = (sub(b, a), sub(point, a));
            let square = dot(along, along);
            let part = dot(there, along) / square;
            norm(cross(there, along)) <= ON_RIM * square && (-ON_RIM..=1.0 + ON_RIM).contains(&part)
        };
        self.bonds[vertex] == Bond::Surface
            && self
                .rims
                .get(&face)
                .is_some_and(|rims| rims.iter().any(is_on))
    }

    fn keep(&mut self, vertex: usize, found: Found) -> Option<Vec3> {
        self.work += found.work;
        let Some((hint, point)) = found.at else {
            return Some(self.fixed[vertex]);
        };
        self.hints[vertex] = Some(hint);
        (!self.is_driven_out(vertex, hint, point)).then_some(point)
    }
}

/// The edges of the boundary that each triangle touches, if it touches some.
fn rims(mesh: &TriangleMesh) -> BTreeMap<usize, Vec<[Vec3; 2]>> {
    let mut rims: BTreeMap<usize, Vec<[Vec3; 2]>> = BTreeMap::new();
    for edge in mesh.edges().filter(|edge| edge.second.is_none()) {
        let ends = edge.vertices.map(|v| mesh.position(v));
        for (face, _) in edge.vertices.iter().flat_map(|&v| mesh.ring(v)) {
            rims.entry(face).or_default().push(ends);
        }
    }
    rims
}

/// A closest point.
struct Found {
    /// The triangle or segment, and the point; none for a fixed vertex.
    at: Option<(usize, Vec3)>,
    /// The triangles of the surface that were looked at.
    work: u64,
}

/// The constraint of a vertex with this origin, and the node at which it is fixed.
fn place(
    mesh: &TriangleMesh,
    on: &[Bond],
    is_node: &[bool],
    origin: &Origin,
) -> (Bond, Option<usize>) {
    let of_vertex = |v: usize| {
        if is_node[v] {
            return (Bond::Fixed, Some(v));
        }
        let mut sides = mesh.ring(v).flat_map(|(f, k)| [(f, k), (f, (k + 2) % 3)]);
        let bond = sides.find_map(|(f, k)| curve(on[mesh.edge_of(f, k)]));
        (bond.unwrap_or(Bond::Surface), None)
    };
    match *origin {
        Origin::Vertex(v) => of_vertex(v),
        Origin::Middle => (Bond::Surface, None),
        Origin::Face(face, at) => {
            let corners = mesh.corners(face);
            if let Some(k) = (0..3).find(|&k| at[k] == 1.0) {
                return of_vertex(corners[k]);
            }
            // A vertex whose weight of a corner is zero lies on the edge opposite to that corner.
            let opposite = |k: usize| curve(on[mesh.edge_of(face, (k + 1) % 3)]);
            let bond = (0..3).filter(|&k| at[k] == 0.0).find_map(opposite);
            (bond.unwrap_or(Bond::Surface), None)
        }
    }
}

fn curve(bond: Bond) -> Option<Bond> {
    (bond != Bond::Surface).then_some(bond)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape::by_name;

    /// Quads whose only use is their vertices, which are those of the mesh.
    fn vertices_of(mesh: &TriangleMesh) -> QuadMesh {
        QuadMesh::from_quads(mesh.vertices().to_vec(), Vec::new(), 0)
    }

    /// Whether the closest points of sixty rounds take so long that no more are looked for.
    fn takes_too_long(mesh: &TriangleMesh) -> bool {
        let quads = vertices_of(mesh);
        let mut surface = Surface::new(&quads, mesh, None, &FeatureGraph::none(mesh)).unwrap();
        for round in 0..60 {
            for (v, &p) in quads.vertices.iter().enumerate() {
                let beside = p.map(|x| x + 0.01 * f64::from(round));
                surface.project(v, beside);
            }
        }
        surface.has_spent_its_work()
    }

    #[test]
    fn vertices_inside_stay_off_the_boundary_and_those_on_it_stay_on_it() {
        let mesh = by_name("plane", 200).unwrap();
        let boundary = FeatureGraph::boundary(&mesh);
        let mut quads = vertices_of(&mesh);
        quads.origins = (0..mesh.vertex_count()).map(Origin::Vertex).collect();
        let mut surface = Surface::new(&quads, &mesh, None, &boundary).unwrap();
        let mut points = quads.vertices.clone();
        // Far beyond the corner, and beyond each side.
        for out in [[9.0, 9.0, 0.0], [9.0, 0.01, 0.0], [0.01, -9.0, 0.0]] {
            surface.project_all(|_| Some(out), &mut points);
            for (v, &before) in quads.vertices.iter().enumerate() {
                match surface.bonds[v] {
                    Bond::Surface => assert_eq!(points[v], before),
                    _ => assert!(
                        points[v]
                            .map(f64::abs)
                            .contains(&quads.vertices[0][0].abs())
                    ),
                }
                assert_eq!(
                    surface.project(v, out).is_none(),
                    surface.bonds[v] == Bond::Surface
                );
            }
        }
        surface.project_all(|_| Some([0.01, 0.02, 0.3]), &mut points);
        let inside = surface.bonds.iter().position(|&b| b == Bond::Surface);
        let moved = sub(points[inside.unwrap()], [0.01, 0.02, 0.0]);
        assert!(norm(moved) < 1e-15, "{moved:?}");
    }

    #[test]
    fn only_the_closest_points_of_needles_take_too_long() {
        assert!(!takes_too_long(&by_name("genus-2", 2_000).unwrap()));
        // A ribbon of needles from each of two ends to the points of the other side, across the axes.
        let count = 800;
        let along = |k: u32, side: f64| {
            let x = 9_000.0 * f64::from(k) / f64::from(count - 1);
            [x + side, x - side, 0.3 * x]
        };
        let points = (0..count).map(|k| along(k, 1.0));
        let points: Vec<Vec3> = points.chain((0..count).map(|k| along(k, -1.0))).collect();
        let first = (0..count - 1).map(|k| [count, k + 1, k]);
        let second = (0..count - 1).map(|k| [count - 1, count + k, count + k + 1]);
        let mesh = TriangleMesh::new(points, first.chain(second).collect()).unwrap();
        assert!(takes_too_long(&mesh));
    }
}

//! Curvature of details smaller than a quad, which a field ignores.
//!
//! Around a vertex a field turns by the curvature there less 2 pi times its index. Noise and small
//! features therefore attract irregular vertices, often in pairs with hardly a quad between them.
//! If curvature is smoothed before the indices are decided (`ray2009`), irregular vertices stay
//! where there is curvature at the scale of interest. Two steps of implicit diffusion tell how much
//! curvature flows along each edge, and the transport over the edge turns by as much more.

use super::FieldOptions;
use super::graded_flow::graded_flow;
use crate::error::{Error, Result};
use crate::linalg::{Cholesky, Sparse};
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{cotangent, norm, sub};
use crate::monitor::{collect_in_parts, may_continue, span};

/// Steps of diffusion: a single one leaves a peak where all curvature was at one vertex.
const STEPS: usize = 2;

/// Least and largest weight of an edge: with them the Laplacian of thin and obtuse triangles keeps
/// its signs.
const WEIGHTS: [f64; 2] = [0.1, 10.0];

/// The least number of faces or edges that are worth a thread.
const LEAST: usize = 1 << 12;

/// The additional turn of the transport over every edge, from its first to its second face, after
/// curvature has flowed as far as the length of details in `options`.
///
/// No curvature flows to or from the boundary or the vertices of firmly constrained faces: what turns
/// there is not noise.
///
/// # Errors
/// [`Error::NotFinite`], [`Error::InvalidArgument`] for a negative length, and those of
/// [`FieldOptions::fixed_angles`].
pub(super) fn detail(mesh: &TriangleMesh, options: &FieldOptions) -> Result<Vec<f64>> {
    let _span = span("detail");
    let mut flow = graded_flow(mesh, options)?;
    let length = length(mesh, options)?;
    if length == 0.0 {
        return Ok(flow);
    }
    let flowing = flowing(mesh, options)?;
    let vertices = mesh.vertex_count();
    let time = length * length / STEPS as f64;
    let mut mass = vec![0.0; vertices];
    let mut curvature = vec![std::f64::consts::TAU; vertices];
    for (&moved, [a, b]) in flow.iter().zip(ends(mesh)) {
        curvature[a] -= moved;
        curvature[b] += moved;
    }
    let areas = collect_in_parts(mesh.face_count(), LEAST, |face| mesh.area(face));
    for (face, (area, angles)) in areas.into_iter().zip(mesh.angles()).enumerate() {
        for (v, angle) in mesh.corners(face).into_iter().zip(angles) {
            mass[v] += area / 3.0;
            curvature[v] -= angle;
        }
    }
    let mut diagonal = mass.clone();
    let mut pairs = Vec::with_capacity(mesh.edge_count());
    for (weight, [a, b]) in flowing.iter().zip(ends(mesh)) {
        diagonal[a] += time * weight;
        diagonal[b] += time * weight;
        pairs.push((a.max(b) as u32, a.min(b) as u32, -time * weight));
    }
    may_continue()?;
    let diagonal = diagonal.iter().enumerate();
    let diagonal = diagonal.map(|(v, &d)| (v as u32, v as u32, d));
    let system = Sparse::from_triplets(vertices, vertices, diagonal.chain(pairs.iter().copied()))?;
    let factor = Cholesky::new(&system)?;
    for _ in 0..STEPS {
        let mut density = curvature.clone();
        may_continue()?;
        factor.solve(&mut density)?;
        may_continue()?;
        for (e, [a, b]) in ends(mesh).enumerate() {
            let moved = time * flowing[e] * (density[a] - density[b]);
            flow[e] += moved;
            curvature[a] -= moved;
            curvature[b] += moved;
        }
    }
    Ok(flow)
}

/// The length of details, at most the size of the mesh: beyond, nothing changes any more.
fn length(mesh: &TriangleMesh, options: &FieldOptions) -> Result<f64> {
    let length = options.detail;
    if !length.is_finite() {
        return Err(Error::NotFinite {
            what: "the length of details",
            position: 0,
        });
    }
    if length < 0.0 {
        return Err(Error::InvalidArgument {
            what: format!("the length of details is {length}; it must be at least 0"),
            index: None,
        });
    }
    let [low, high] = mesh.bounding_box();
    Ok(length.min(norm(sub(high, low))))
}

/// The ends of each edge, in the direction of its first face.
fn ends(mesh: &TriangleMesh) -> impl Iterator<Item = [usize; 2]> + '_ {
    mesh.edges().map(|edge| edge.vertices)
}

/// How easily curvature flows along each edge: cotangent weights.
fn flowing(mesh: &TriangleMesh, options: &FieldOptions) -> Result<Vec<f64>> {
    let mut is_kept: Vec<bool> = (0..mesh.vertex_count())
        .map(|v| mesh.is_boundary_vertex(v))
        .collect();
    let fixed = options.fixed_angles(mesh)?;
    for constraint in options.constraints.iter().take(options.firm) {
        for v in mesh.corners(constraint.face) {
            is_kept[v] = true;
        }
    }
    let weight = |e: usize| {
        let edge = mesh.edge(e);
        let [a, b] = edge.vertices;
        let Some(second) = edge.second else {
            return 0.0;
        };
        if is_kept[a] || is_kept[b] || fixed[edge.first.0].is_some() && fixed[second.0].is_some() {
            return 0.0;
        }
        let sum: f64 = [edge.first, second]
            .map(|(face, k)| opposite_cotangent(mesh, face, k))
            .iter()
            .sum();
        (0.5 * sum).clamp(WEIGHTS[0], WEIGHTS[1])
    };
    let weights = collect_in_parts(mesh.edge_count(), LEAST, weight);
    may_continue()?;
    Ok(weights)
}

/// The cotangent of the angle opposite to a local edge.
fn opposite_cotangent(mesh: &TriangleMesh, face: usize, k: usize) -> f64 {
    let corners = mesh.corner_positions(face);
    let [a, b, c] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
    cotangent(sub(a, c), sub(b, c))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{Constraint, solve_field};
    use crate::mesh::shape;
    use crate::monitor::Monitor;
    use crate::search::Options;

    fn of(detail: f64) -> FieldOptions {
        FieldOptions {
            detail,
            ..FieldOptions::default()
        }
    }

    /// A cube whose vertices are pushed in and out.
    fn rough() -> TriangleMesh {
        let smooth = shape::by_name("rounded-cube", 3_000).unwrap();
        let push =
            |(v, p): (usize, &[f64; 3])| p.map(|x| x * (1.0 + 0.06 * (7.0 * v as f64).sin()));
        let points = smooth.vertices().iter().enumerate().map(push);
        TriangleMesh::new(points.collect(), smooth.triangles().to_vec()).unwrap()
    }

    /// What flows in at every vertex less what flows out.
    fn inflow(mesh: &TriangleMesh, flow: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; mesh.vertex_count()];
        for (flow, [a, b]) in flow.iter().zip(ends(mesh)) {
            sums[a] -= flow;
            sums[b] += flow;
        }
        sums
    }

    /// The angle defect of every vertex.
    fn curvature(mesh: &TriangleMesh) -> Vec<f64> {
        let mut sums = vec![std::f64::consts::TAU; mesh.vertex_count()];
        for face in 0..mesh.face_count() {
            for (k, v) in mesh.corners(face).into_iter().enumerate() {
                sums[v] -= mesh.angle(face, k);
            }
        }
        sums
    }

    #[test]
    fn what_has_flowed_is_smooth_and_as_much_as_before() {
        let mesh = rough();
        let before = curvature(&mesh);
        let flow = detail(&mesh, &of(4.0 * mesh.mean_edge_length())).unwrap();
        let inflow = inflow(&mesh, &flow);
        let after: Vec<f64> = before.iter().zip(&inflow).map(|(k, i)| k + i).collect();
        let sum = |k: &[f64]| k.iter().sum::<f64>();
        assert!((sum(&before) - sum(&after)).abs() < 1e-9);
        let roughness = |k: &[f64]| ends(&mesh).map(|[a, b]| (k[a] - k[b]).powi(2)).sum::<f64>();
        assert!(roughness(&after) < 0.05 * roughness(&before));
    }

    #[test]
    fn nothing_flows_to_given_faces_nor_without_details() {
        let mesh = rough();
        assert!(detail(&mesh, &of(0.0)).unwrap().iter().all(|&f| f == 0.0));
        let given = FieldOptions {
            constraints: vec![Constraint {
                face: 5,
                angle: 0.3,
            }],
            ..of(4.0 * mesh.mean_edge_length())
        };
        let inflow = inflow(&mesh, &detail(&mesh, &given).unwrap());
        assert!(mesh.corners(5).iter().all(|&v| inflow[v] == 0.0));
        assert!(inflow.iter().any(|&i| i != 0.0));
    }

    #[test]
    fn details_attract_no_irregular_vertices() {
        let mesh = rough();
        let irregular = |detail: f64| {
            let options = Options::default();
            let (field, _) = solve_field(&mesh, &of(detail), &options, Monitor::default).unwrap();
            field.irregular_vertices(&mesh).len()
        };
        let (all, few) = (irregular(0.0), irregular(6.0 * mesh.mean_edge_length()));
        assert!(few == 8 && all > few, "{all} and {few}");
    }

    #[test]
    fn a_length_is_finite_and_not_negative() {
        let mesh = rough();
        for length in [f64::NAN, f64::INFINITY, -1.0] {
            assert!(detail(&mesh, &of(length)).is_err());
        }
        assert!(
            detail(&mesh, &of(1e300))
                .unwrap()
                .iter()
                .all(|f| f.is_finite())
        );
    }
}

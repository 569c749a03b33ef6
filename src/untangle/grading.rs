//! Smaller quads around the folds and winding defects that remain in a map, and nowhere else.
//!
//! A few faults in one place seldom need a finer map as a whole. With smaller quads around them the
//! integers change and the map has more room there. Lengths in the map grow by [`FINER`] at a fault. The
//! factor falls back to 1 within [`REACH`] quads.

use std::collections::VecDeque;

use super::Untangled;
use crate::map::SeamlessProblem;
use crate::mesh::TriangleMesh;

/// The factor by which lengths grow at a fault, each time.
pub(crate) const FINER: f64 = 1.5;

/// The distance in quads beyond which lengths do not grow.
const REACH: f64 = 3.0;

/// The least distance beyond which lengths do not grow, in edges of triangles.
const LEAST_EDGES: f64 = 4.0;

/// The vertices at the faults of a map: corners of folded faces, and winding defects.
pub(crate) fn faulty<'a>(
    mesh: &'a TriangleMesh,
    untangled: &'a Untangled,
) -> impl Iterator<Item = usize> + 'a {
    let corners = untangled.map.flipped().iter();
    let corners = corners.flat_map(|&f| mesh.corners(f));
    untangled.winding_defects.iter().copied().chain(corners)
}

/// Multiplies the lengths of faces, one a face, around these vertices.
pub(crate) fn grow_around(
    mesh: &TriangleMesh,
    problem: &SeamlessProblem,
    faults: impl Iterator<Item = usize>,
    lengths: &mut [f64],
) {
    let reach = (REACH / mean_aim(problem, mesh)).max(LEAST_EDGES);
    let edges = edges_from(mesh, faults, reach as usize);
    for (face, length) in lengths.iter_mut().enumerate() {
        let nearest = mesh
            .corners(face)
            .into_iter()
            .filter_map(|v| edges[v])
            .min();
        if let Some(edges) = nearest {
            *length *= 1.0 + (FINER - 1.0) * (1.0 - edges as f64 / reach).max(0.0);
        }
    }
}

/// The number of edges from each vertex to the nearest of the given vertices, up to a largest number.
fn edges_from(
    mesh: &TriangleMesh,
    from: impl Iterator<Item = usize>,
    most: usize,
) -> Vec<Option<usize>> {
    let mut edges = vec![None; mesh.vertex_count()];
    let mut queue: VecDeque<(usize, usize)> = from.map(|v| (v, 0)).collect();
    while let Some((v, distance)) = queue.pop_front() {
        if edges[v].is_some() || distance > most {
            continue;
        }
        edges[v] = Some(distance);
        for (face, corner) in mesh.ring(v) {
            let corners = mesh.corners(face);
            let ends = [1, 2].map(|k| corners[(corner + k) % 3]);
            queue.extend(ends.map(|w| (w, distance + 1)));
        }
    }
    edges
}

/// The mean length of an edge in the map if the map had the gradients that are asked for.
fn mean_aim(problem: &SeamlessProblem, mesh: &TriangleMesh) -> f64 {
    let length = |face: usize| {
        let [u, v] = problem.aim(mesh, face, 0, 1);
        u.hypot(v)
    };
    (0..mesh.face_count()).map(length).sum::<f64>() / mesh.face_count() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{FieldOptions, solve_field};
    use crate::map::SeamlessOptions;
    use crate::mesh::shape;
    use crate::monitor::Monitor;
    use crate::search::Options;
    use crate::solve::Solver;

    #[test]
    fn lengths_that_grow_alike_everywhere_are_a_finer_map() {
        let mesh = shape::by_name("rounded-cube", 600).unwrap();
        let (field, options) = (FieldOptions::default(), Options::default());
        let (field, _) = solve_field(&mesh, &field, &options, Monitor::default).unwrap();
        let size = SeamlessOptions { quads: 100 };
        let problem = SeamlessProblem::new(&mesh, &field, &size).unwrap();
        let mut solver = Solver::new(problem.problem()).unwrap();
        let alike = vec![1.3; mesh.face_count()];
        let graded = problem.graded(&mesh, &alike, &mut solver).unwrap();
        let found = solver.solve(&options).unwrap();
        let refined = problem.refined(&mesh, 1.3, &mut solver).unwrap();
        assert_eq!(graded.problem().linear(), refined.problem().linear());
        assert_eq!(found.values(), solver.solve(&options).unwrap().values());
    }

    #[test]
    fn edges_are_counted_from_the_nearest_as_far_as_asked() {
        let mesh = shape::by_name("sphere", 2_000).unwrap();
        let edges = edges_from(&mesh, [0, 100].into_iter(), 3);
        assert_eq!((edges[0], edges[100]), (Some(0), Some(0)));
        for (v, own) in edges.iter().enumerate() {
            let around = mesh
                .ring(v)
                .map(|(f, k)| edges[mesh.corners(f)[(k + 1) % 3]]);
            let next = around.flatten().min();
            match own {
                Some(0) => assert!(v == 0 || v == 100),
                Some(n) => assert_eq!(next, Some(n - 1)),
                None => assert!(next.is_none_or(|n| n == 3)),
            }
        }
    }
}

//! What quads are to be like where they were extracted: how large, and how much longer than wide.

use super::rectangle;
use crate::extract::{Origin, QuadMesh};
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{Vec3, dot, normalize};

/// What quads are to be like in every face of the mesh.
#[derive(Clone, Copy, Default)]
pub(crate) struct Shapes<'a> {
    /// The lengths of their edges, in any unit; all are to be equal if there are none.
    pub(crate) lengths: Option<&'a [f64]>,
    /// Two vectors along the edges, in inverse proportion to the lengths of these; quads are to be squares if there
    /// are none.
    pub(crate) proportions: Option<&'a dyn Fn(usize) -> [Vec3; 2]>,
}

impl Shapes<'_> {
    /// The length that edges of each quad are to have, over the mean of all.
    pub(super) fn sizes(&self, quads: &QuadMesh, mesh: &TriangleMesh) -> Option<Vec<f64>> {
        (self.lengths).map(|lengths| relative_sizes(quads, mesh, lengths))
    }

    /// By what factor the first and the third edge of each quad are to be longer than that, and the others shorter.
    pub(super) fn elongations(&self, quads: &QuadMesh, mesh: &TriangleMesh) -> Option<Vec<f64>> {
        (self.proportions).map(|proportions| elongations(quads, mesh, proportions))
    }
}

/// The length that edges of each quad are to have, over the mean of all, from the places where it was extracted.
fn relative_sizes(quads: &QuadMesh, mesh: &TriangleMesh, lengths: &[f64]) -> Vec<f64> {
    let of_vertex = |v: usize| {
        let ring = mesh.ring(v);
        let count = ring.len() as f64;
        ring.map(|(face, _)| lengths[face]).sum::<f64>() / count
    };
    let of_origin = |&origin: &Origin| match origin {
        Origin::Vertex(v) => Some(of_vertex(v)),
        Origin::Face(face, _) => Some(lengths[face]),
        Origin::Middle => None,
    };
    let at: Vec<Option<f64>> = quads.origins.iter().map(of_origin).collect();
    let of_quad = |quad: &[u32; 4]| {
        let known: Vec<f64> = quad.iter().filter_map(|&v| at[v as usize]).collect();
        (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
    };
    let sizes: Vec<Option<f64>> = quads.quads.iter().map(of_quad).collect();
    let known = sizes.iter().flatten();
    let mean = known.clone().sum::<f64>() / known.count().max(1) as f64;
    sizes
        .iter()
        .map(|size| size.map_or(1.0, |size| size / mean))
        .collect()
}

/// By what factor the first and the third edge of each quad are to be longer than its size, and the others shorter: the
/// mean at the places where its corners were extracted.
fn elongations(
    quads: &QuadMesh,
    mesh: &TriangleMesh,
    proportions: &dyn Fn(usize) -> [Vec3; 2],
) -> Vec<f64> {
    let of_quad = |quad: &[u32; 4]| {
        let corners = quad.map(|v| quads.vertices[v as usize]);
        let sides = rectangle::sides(corners).map(normalize);
        let (mut sum, mut count) = (0.0, 0.0);
        let mut add = |face: usize| {
            let arms = proportions(face);
            let squared =
                sides.map(|side| arms.iter().map(|&arm| dot(arm, side).powi(2)).sum::<f64>());
            if squared.iter().all(|&s| s > 0.0) {
                sum += (squared[1] / squared[0]).ln();
                count += 1.0;
            }
        };
        for &v in quad {
            match quads.origins[v as usize] {
                Origin::Vertex(v) => mesh.ring(v).for_each(|(face, _)| add(face)),
                Origin::Face(face, _) => add(face),
                Origin::Middle => {}
            }
        }
        // A fourth of the logarithm of the squared ratio.
        (0.25 * sum / f64::max(count, 1.0)).exp()
    };
    quads.quads.iter().map(of_quad).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::vector::{norm, sub};
    use crate::monitor::Monitor;
    use crate::smooth::tests::grid;
    use crate::smooth::{SmoothOptions, smooth_to};

    /// Lengths along the first axis are to be four times those along the second.
    const LONG: fn(usize) -> [Vec3; 2] = |_| [[0.25, 0.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn edges_are_elongated_along_the_axis_of_greater_length() {
        let (mut quads, mesh) = grid();
        let shapes = Shapes {
            proportions: Some(&LONG),
            ..Shapes::default()
        };
        let factors = |quads: &QuadMesh| shapes.elongations(quads, &mesh).unwrap();
        assert!(factors(&quads).iter().all(|f| (f - 2.0).abs() < 1e-12));
        // From the next corner on, edges are in turn along the other axis.
        quads.quads.iter_mut().for_each(|quad| quad.rotate_left(1));
        assert!(factors(&quads).iter().all(|f| (f - 0.5).abs() < 1e-12));
    }

    /// The lengths of a quad of the inner two by two, smoothed on their own on the mesh of all.
    fn lengths_in_the_middle(shapes: Shapes) -> [f64; 2] {
        let (quads, mesh) = grid();
        let mut inner = quads.clone();
        // No vertex on the boundary.
        inner.quads.retain(|quad| {
            quad.iter()
                .all(|&v| (1..4).contains(&(v % 5)) && (1..4).contains(&(v / 5)))
        });
        smooth_to(
            &mut inner,
            &mesh,
            None,
            &SmoothOptions::default(),
            shapes,
            &mut Monitor::default(),
        )
        .unwrap();
        let [a, b, _, d] = inner.quads[0].map(|v| inner.vertices[v as usize]);
        [norm(sub(b, a)), norm(sub(d, a))]
    }

    #[test]
    fn smoothing_makes_rectangles_where_they_are_asked_for() {
        let [along, across] = lengths_in_the_middle(Shapes::default());
        assert!((along - across).abs() < 1e-9, "{along} {across}");
        let shapes = Shapes {
            proportions: Some(&LONG),
            ..Shapes::default()
        };
        let [along, across] = lengths_in_the_middle(shapes);
        assert!(along > 1.5 * across, "{along} {across}");
    }
}

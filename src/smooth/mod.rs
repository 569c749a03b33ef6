//! Smoothing of quads on the surface, towards squares of one size, or rectangles where quads are to be longer than wide.
//!
//! Every quad has a target for its corners: the square closest to it (the least-squares fit of
//! `bouaziz2012`, section 4), of a size between its own and the mean size. A vertex moves to the
//! mean of its targets, and from there to the closest point of the surface. Vertices on the
//! boundary and on features slide along them; a vertex where these end, meet or turn is fixed.
//! Poor quads are improved one vertex at a time. In the quads of a whole run, those that are missing at the boundary
//! are added before, and flat ones are removed or turned after that.
//!
//! Closest points are looked for among thousands of triangles each where these are long needles. Smoothing ends
//! early there.

mod chains;
mod curve;
mod mend;
mod quality;
mod reconnect;
mod rectangle;
mod rims;
mod square;
mod surface;

use crate::error::{Error, Result};
use crate::extract::{Origin, QuadMesh};
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{Vec3, add, dot, normalize, scale, sub};
use crate::monitor::{Monitor, Phase, collect_in_parts, span};
pub use quality::QuadQuality;
use surface::Surface;

/// The least number of quads that are worth a thread.
const LEAST: usize = 1 << 11;

/// The options of smoothing.
#[derive(Debug, Clone, PartialEq)]
pub struct SmoothOptions {
    /// The number of times that all vertices move.
    pub rounds: usize,
    /// The size of a quad's target: from its own size at 0 to the mean size of all at 1.
    pub uniformity: f64,
    /// The pull of a vertex to its place in the map: none at 0, all at 1.
    pub hold: f64,
    /// Edges of the triangle mesh on which edges of quads stay.
    pub features: Vec<usize>,
}

impl Default for SmoothOptions {
    fn default() -> Self {
        SmoothOptions {
            rounds: 60,
            uniformity: 0.6,
            hold: 0.07,
            features: Vec::new(),
        }
    }
}

/// Moves the vertices of quads over the mesh that they were extracted from.
///
/// Faces that are not quads have no effect. A caller who [finishes](crate::Flow::Finish)
/// gets quads of fewer rounds, or as they were. Connectivity and origins do not change.
///
/// # Errors
/// [`Error::IndexOutOfRange`] for a feature that is no edge, [`Error::InvalidArgument`] for a
/// uniformity outside 0 to 1, [`Error::Cancelled`].
pub fn smooth(
    quads: &mut QuadMesh,
    mesh: &TriangleMesh,
    options: &SmoothOptions,
    monitor: &mut Monitor,
) -> Result<()> {
    let (_watch, _memory) = (monitor.watch(), mesh.watch_memory());
    if smoothed(quads, mesh, options, (Shapes::default(), false), monitor)?.is_some() {
        mend::leave_surface(quads);
    }
    Ok(())
}

/// What quads are to be like in every face of the mesh.
#[derive(Clone, Copy, Default)]
pub(crate) struct Shapes<'a> {
    /// The lengths of their edges, in any unit; all are to be equal if there are none.
    pub(crate) lengths: Option<&'a [f64]>,
    /// Two vectors along the edges, in inverse proportion to the lengths of these; quads are to be squares if there
    /// are none.
    pub(crate) proportions: Option<&'a dyn Fn(usize) -> [Vec3; 2]>,
}

/// As [`smooth`], where quads are to have these shapes. Quads that are missing at the boundary are added, and flat ones
/// are removed or turned if all conform.
pub(crate) fn smooth_to(
    quads: &mut QuadMesh,
    mesh: &TriangleMesh,
    options: &SmoothOptions,
    shapes: Shapes,
    monitor: &mut Monitor,
) -> Result<()> {
    let (_watch, _memory) = (monitor.watch(), mesh.watch_memory());
    if let Some(mut surface) = smoothed(quads, mesh, options, (shapes, true), monitor)? {
        if quads.is_conforming() {
            reconnect::reconnect(quads, &mut surface, monitor)?;
        }
        mend::leave_surface(quads);
    }
    Ok(())
}

/// Moves vertices on the surface, after quads that are missing at the boundary are added if `fills`. `None` if the
/// caller wants what there is.
fn smoothed(
    quads: &mut QuadMesh,
    mesh: &TriangleMesh,
    options: &SmoothOptions,
    (shapes, fills): (Shapes, bool),
    monitor: &mut Monitor,
) -> Result<Option<Surface>> {
    let _span = span("smooth");
    check(options)?;
    if monitor.finishes() {
        return Ok(None);
    }
    let features = FeatureGraph::from_edges(mesh, &options.features)?;
    let features = features.with(mesh, &FeatureGraph::boundary(mesh))?;
    let mut surface = Surface::new(quads, mesh, &features)?;
    chains::close(quads, mesh, &mut surface);
    if fills {
        rims::fill(quads, mesh, &features, &mut surface);
    }
    let home = quads.vertices.clone();
    let sizes = (shapes.lengths).map(|lengths| relative_sizes(quads, mesh, lengths));
    let aspects = (shapes.proportions).map(|proportions| aspects(quads, mesh, proportions));
    for round in 0..options.rounds {
        if monitor.finishes() || surface.has_spent_its_work() {
            break;
        }
        monitor.progress(Phase::Quads, round as f64 / options.rounds as f64)?;
        let size = square::mean_edge(quads);
        let targets = collect_in_parts(quads.quads.len(), LEAST, |q| {
            let corners = quads.quads[q].map(|v| quads.vertices[v as usize]);
            let size = sizes.as_ref().map_or(size, |sizes| size * sizes[q]);
            match &aspects {
                None => square::closest(corners, size, options.uniformity),
                Some(aspects) => {
                    let edges = [size * aspects[q], size / aspects[q]];
                    rectangle::closest(corners, edges, options.uniformity)
                }
            }
        });
        let mut sum = vec![([0.0; 3], 0.0); quads.vertices.len()];
        for (quad, targets) in quads.quads.iter().zip(targets) {
            for (&v, target) in quad.iter().zip(targets) {
                let (total, count) = &mut sum[v as usize];
                *total = add(*total, target);
                *count += 1.0;
            }
        }
        let wanted = sum.into_iter().zip(&home).map(|((total, count), &home)| {
            let wanted = scale(total, 1.0 / count);
            (count > 0.0).then(|| add(wanted, scale(sub(home, wanted), options.hold)))
        });
        surface.project_all(&wanted.collect::<Vec<_>>(), &mut quads.vertices);
    }
    mend::mend(quads, &mut surface);
    Ok(Some(surface))
}

/// By what factor the first and the third edge of each quad are to be longer than its size, and the others shorter: the
/// mean at the places where its corners were extracted.
fn aspects(
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

fn check(options: &SmoothOptions) -> Result<()> {
    if !(0.0..=1.0).contains(&options.uniformity) {
        return Err(Error::InvalidArgument {
            what: format!(
                "the uniformity is {}; it must be from 0 to 1",
                options.uniformity
            ),
            index: None,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: u32 = 4;

    /// A square of four by four quads, and the same with two triangles for each.
    pub(super) fn grid() -> (QuadMesh, TriangleMesh) {
        let row = SIDE + 1;
        let at = |i: u32, j: u32| i + row * j;
        let cells = (0..SIDE * SIDE).map(|c| (c % SIDE, c / SIDE));
        let quad = |(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        let quads: Vec<[u32; 4]> = cells.map(quad).collect();
        let vertices = (0..row * row).map(|v| [f64::from(v % row), f64::from(v / row), 0.0]);
        let vertices: Vec<[f64; 3]> = vertices.collect();
        let halves = |&[a, b, c, d]: &[u32; 4]| [[a, b, c], [a, c, d]];
        let triangles = quads.iter().flat_map(halves).collect();
        let mesh = TriangleMesh::new(vertices.clone(), triangles).unwrap();
        let quads = QuadMesh {
            origins: (0..vertices.len()).map(Origin::Vertex).collect(),
            ..QuadMesh::from_quads(vertices, quads, 1)
        };
        (quads, mesh)
    }
}

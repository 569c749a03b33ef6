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
mod shapes;
mod square;
mod surface;

use crate::error::{Error, Result};
use crate::extract::QuadMesh;
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{add, scale, sub};
use crate::mesh::{ClosestPoint, TriangleMesh};
use crate::monitor::{Monitor, Phase, collect_in_parts, span};
pub use quality::QuadQuality;
pub(crate) use shapes::Shapes;
use surface::Surface;

/// The least number of quads that are worth a thread.
const LEAST: usize = 1 << 9;

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
    let shapes = (Shapes::default(), false);
    if smoothed(quads, mesh, None, options, shapes, monitor)?.is_some() {
        mend::leave_surface(quads);
    }
    Ok(())
}

/// As [`smooth`], where quads are to have these shapes. Quads that are missing at the boundary are added, and flat ones
/// are removed or turned if all conform. `faces` is the tree of the mesh, if there is one already.
pub(crate) fn smooth_to(
    quads: &mut QuadMesh,
    mesh: &TriangleMesh,
    faces: Option<ClosestPoint>,
    options: &SmoothOptions,
    shapes: Shapes,
    monitor: &mut Monitor,
) -> Result<()> {
    let (_watch, _memory) = (monitor.watch(), mesh.watch_memory());
    if let Some(mut surface) = smoothed(quads, mesh, faces, options, (shapes, true), monitor)? {
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
    faces: Option<ClosestPoint>,
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
    let mut surface = Surface::new(quads, mesh, faces, &features)?;
    chains::close(quads, mesh, &mut surface);
    if fills {
        rims::fill(quads, mesh, &features, &mut surface);
    }
    let (home, corners) = (quads.vertices.clone(), corners(quads));
    let (sizes, elongations) = (shapes.sizes(quads, mesh), shapes.elongations(quads, mesh));
    for round in 0..options.rounds {
        if monitor.finishes() || surface.has_spent_its_work() {
            break;
        }
        monitor.progress(Phase::Quads, round as f64 / options.rounds as f64)?;
        let size = square::mean_edge(quads);
        let targets = collect_in_parts(quads.quads.len(), LEAST, |q| {
            let corners = quads.quads[q].map(|v| quads.vertices[v as usize]);
            let size = sizes.as_ref().map_or(size, |sizes| size * sizes[q]);
            match &elongations {
                None => square::closest(corners, size, options.uniformity),
                Some(elongations) => {
                    let edges = [size * elongations[q], size / elongations[q]];
                    rectangle::closest(corners, edges, options.uniformity)
                }
            }
        });
        let wanted = |v: usize| {
            let (corners, home) = (&corners[v], home[v]);
            let targets = corners
                .iter()
                .map(|&(q, k)| targets[q as usize][k as usize]);
            let total = targets.fold([0.0; 3], add);
            let wanted = scale(total, 1.0 / corners.len() as f64);
            (!corners.is_empty()).then(|| add(wanted, scale(sub(home, wanted), options.hold)))
        };
        surface.project_all(wanted, &mut quads.vertices);
    }
    mend::mend(quads, &mut surface);
    Ok(Some(surface))
}

/// The corners of quads at every vertex, each as its quad and its number there, in the order of the quads.
fn corners(quads: &QuadMesh) -> Vec<Vec<(u32, u8)>> {
    let mut corners = vec![Vec::new(); quads.vertices.len()];
    for (q, quad) in quads.quads.iter().enumerate() {
        for (k, &v) in quad.iter().enumerate() {
            corners[v as usize].push((q as u32, k as u8));
        }
    }
    corners
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
    use crate::extract::Origin;

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

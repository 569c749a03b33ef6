//! Smoothing of quads on the surface, towards squares of one size.
//!
//! Every quad has a target for its corners: the square closest to it (the least-squares fit of
//! `bouaziz2012`, section 4), of a size between its own and the mean size. A vertex moves to the
//! mean of its targets, and from there to the closest point of the surface. Vertices on the
//! boundary and on features slide along them; a vertex where these end, meet or turn is fixed.
//! Quads that are still inverted are improved one vertex at a time.
//!
//! Closest points are looked for among thousands of triangles each where these are long needles. Smoothing ends
//! early there.

mod chains;
mod curve;
mod mend;
mod quality;
mod square;
mod surface;

use crate::error::{Error, Result};
use crate::extract::QuadMesh;
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{add, scale, sub};
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
    let _span = span("smooth");
    check(options)?;
    let (_watch, _memory) = (monitor.watch(), mesh.watch_memory());
    if monitor.finishes() {
        return Ok(());
    }
    let features = FeatureGraph::from_edges(mesh, &options.features)?;
    let features = features.with(mesh, &FeatureGraph::boundary(mesh))?;
    let mut surface = Surface::new(quads, mesh, &features)?;
    chains::close(quads, mesh, &mut surface);
    let home = quads.vertices.clone();
    for round in 0..options.rounds {
        if monitor.finishes() || surface.has_spent_its_work() {
            break;
        }
        monitor.progress(Phase::Quads, round as f64 / options.rounds as f64)?;
        let size = square::mean_edge(quads);
        let targets = collect_in_parts(quads.quads.len(), LEAST, |q| {
            let corners = quads.quads[q].map(|v| quads.vertices[v as usize]);
            square::closest(corners, size, options.uniformity)
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
    Ok(())
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

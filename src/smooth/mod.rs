//! Smoothing of quads that stay on the surface: towards squares of one size.
//!
//! Every quad asks for its corners where the square closest to it has them (the least-squares fit
//! of Bouaziz, Deuss, Schwartzburg, Weise, Pauly 2012, "Shape-Up: shaping discrete geometry with
//! projections", section 4), of a size between its own and that of all; a vertex goes to the mean of
//! what its quads ask, and from there to the closest point of the surface. Vertices on the boundary
//! and on features slide along them; where these end, meet or turn, one stays. What is left turned over is mended one vertex at
//! a time.

mod chains;
mod curve;
mod mend;
mod quality;
mod square;
mod surface;

use crate::extract::QuadMesh;
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::{add, scale, sub};
use crate::monitor::Phase;
use crate::{Error, Monitor, Result};
pub use quality::QuadQuality;
use surface::Surface;

/// How to smooth.
#[derive(Debug, Clone, PartialEq)]
pub struct SmoothOptions {
    /// How many times all vertices are moved.
    pub rounds: usize,
    /// From 0 to 1: how much a quad shall have the mean size of all instead of its own.
    pub uniformity: f64,
    /// From 0 to 1: how much a vertex is held where the map has it.
    pub hold: f64,
    /// Edges of the triangle mesh that edges of quads shall stay on.
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
/// Faces that are no quads have no say. Connectivity and origins stay.
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
    check(options)?;
    let features = FeatureGraph::from_edges(mesh, &options.features)?;
    let features = features.with(mesh, &FeatureGraph::boundary(mesh))?;
    let mut surface = Surface::new(quads, mesh, &features);
    chains::close(quads, mesh, &mut surface);
    let home = quads.vertices.clone();
    for round in 0..options.rounds {
        monitor.progress(Phase::Quads, round as f64 / options.rounds as f64)?;
        let size = square::mean_edge(quads);
        let mut sum = vec![([0.0; 3], 0.0); quads.vertices.len()];
        for quad in &quads.quads {
            let corners = quad.map(|v| quads.vertices[v as usize]);
            let targets = square::closest(corners, size, options.uniformity);
            for (&v, target) in quad.iter().zip(targets) {
                let (total, count) = &mut sum[v as usize];
                *total = add(*total, target);
                *count += 1.0;
            }
        }
        for (v, (total, count)) in sum.into_iter().enumerate() {
            if count > 0.0 {
                quads.vertices[v] = {
                    let wanted = scale(total, 1.0 / count);
                    let held = add(wanted, scale(sub(home[v], wanted), options.hold));
                    surface.project(v, held)
                };
            }
        }
    }
    mend::mend(quads, &mut surface);
    Ok(())
}

fn check(options: &SmoothOptions) -> Result<()> {
    if !(0.0..=1.0).contains(&options.uniformity) {
        return Err(Error::InvalidArgument {
            what: format!("the uniformity is {}, outside 0 to 1", options.uniformity),
            index: None,
        });
    }
    Ok(())
}

//! Refinement: a triangulation that is too coarse or too thin is remeshed, and the surface stays in place.
//!
//! Triangulations of CAD programs have as few triangles as the shape allows: two for each side of a box,
//! fans of needles for the caps of a cylinder. An orientation field has one direction for each triangle, and
//! a map is linear on it, so that neither means much there.
//!
//! Faces that lie in one plane are grouped into regions. Within a region edges may be
//! flipped; all other edges are held and can only be split. Edges that are too long are split at their
//! midpoint, the longest first, and Delaunay flips follow (`lawson1977`). Angles that are too small are
//! removed by Delaunay refinement (`chew1993`, `ruppert1995`): a vertex is put at the circumcenter of the
//! triangle, or in the middle of the held edge that lies between.
//!
//! | idea | file |
//! | --- | --- |
//! | when refinement is needed | `need` |
//! | regions of faces in one plane | `flat` |
//! | a mesh that changes: splits and flips | `working_mesh` |
//! | Delaunay flips | `delaunay` |
//! | where a point of a region lies on the original mesh | `locate` |
//! | which edge or triangle is next | `queue` |
//! | small angles | `angles` |
//! | the result | `refined` |
//! | curves that become edges | `cut_along`, `simplify` |

mod angles;
mod cut_along;
mod delaunay;
mod flat;
mod locate;
mod need;
mod queue;
mod refined;
mod simplify;
#[cfg(test)]
mod tests;
mod working_mesh;

use super::TriangleMesh;
use super::features::FeatureGraph;
use crate::error::{Error, Result};
use crate::monitor::{may_continue, may_continue_at};
pub use cut_along::CutAlong;
pub(crate) use cut_along::{Piece, cut_along_pieces};
pub use need::{Need, SMALL_ANGLE, needs_refinement};
use queue::{Next, Queue};
pub use refined::Refined;
use working_mesh::WorkingMesh;

/// The part of the bounding box's diagonal that [`RefineOptions::new`] allows the surface to move by.
pub const DEVIATION: f64 = 1e-4;

/// The options of a refinement.
#[derive(Debug, Clone, PartialEq)]
pub struct RefineOptions {
    /// Edges longer than this are split.
    pub longest_edge: f64,
    /// Triangles with an angle below this, in radians, are improved where the shape allows it.
    pub smallest_angle: f64,
    /// The largest distance between the old surface and the new one. Edges are flipped only where the
    /// surface stays within it; 0 allows only flips in exact planes.
    pub deviation: f64,
    /// The refinement stops when there are this many triangles.
    pub most_triangles: usize,
}

impl RefineOptions {
    /// The angle that refinement aims at: 12 degrees. Delaunay refinement is sure to end for angles up to
    /// 20.7 degrees (`ruppert1995`).
    pub const ANGLE: f64 = 12.0 / 180.0 * std::f64::consts::PI;

    /// Edges of at most this length, and at most `triangles` triangles more than the mesh has.
    pub fn new(mesh: &TriangleMesh, longest_edge: f64, triangles: usize) -> Self {
        RefineOptions {
            longest_edge,
            smallest_angle: Self::ANGLE,
            deviation: DEVIATION * diagonal(mesh),
            most_triangles: mesh.face_count().saturating_add(triangles),
        }
    }

    fn check(&self) -> Result<()> {
        let refused = |what: String| Err(Error::InvalidArgument { what, index: None });
        if !self.longest_edge.is_finite() || self.longest_edge <= 0.0 {
            let length = self.longest_edge;
            return refused(format!(
                "the longest edge is {length}; it must be finite and above 0"
            ));
        }
        if !(0.0..=std::f64::consts::FRAC_PI_6).contains(&self.smallest_angle) {
            let angle = self.smallest_angle;
            return refused(format!(
                "the smallest angle is {angle}; it must be from 0 to pi / 6"
            ));
        }
        if !self.deviation.is_finite() || self.deviation < 0.0 {
            let deviation = self.deviation;
            return refused(format!(
                "the deviation is {deviation}; it must be finite and at least 0"
            ));
        }
        Ok(())
    }
}

/// The length of the diagonal of the bounding box.
pub(crate) fn diagonal(mesh: &TriangleMesh) -> f64 {
    let [low, high] = mesh.bounding_box();
    super::vector::norm(super::vector::sub(high, low))
}

/// Refines a mesh. The edges of `features` stay: they are split, but never flipped.
///
/// Vertices keep their numbers and places, and new ones follow. New vertices lie on original triangles.
/// Triangles that are neither too large nor too thin change only where flips reach them.
///
/// # Errors
/// [`Error::InvalidArgument`] for options out of range, [`Error::LengthMismatch`] for the features of
/// another mesh, and those of [`TriangleMesh::new`].
pub fn refine(
    mesh: &TriangleMesh,
    features: &FeatureGraph,
    options: &RefineOptions,
) -> Result<Refined> {
    options.check()?;
    features.check_mesh(mesh)?;
    let regions = flat::regions(mesh, features, options.deviation);
    may_continue()?;
    let mut work = WorkingMesh::new(mesh, features, &regions);
    may_continue()?;
    let mut queue = Queue::new(&mut work, options);
    work.open_enclosed_faces(features);
    let mut is_complete = true;
    for steps in 0.. {
        may_continue_at(steps)?;
        queue.update(&mut work);
        let Some(next) = queue.next(&work) else { break };
        if work.triangles.len() >= options.most_triangles {
            is_complete = false;
            break;
        }
        match next {
            Next::Long(half) => {
                work.split_in_the_middle(half);
            }
            Next::Thin(face) => {
                if work.improve(face, queue.shortest_split()) {
                    queue.again(&work, face);
                }
            }
        }
    }
    work.finish(is_complete)
}

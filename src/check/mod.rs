//! Checks element by element whether coordinates on a surface are an integer-grid map.
//!
//! The conditions are those of `bommes2012`, chapter 6, equations (6.1) to (6.3), and `bommes2013`, section
//! 3. The integer lines of the plane become a quad mesh on the surface if these hold:
//! | condition | file |
//! | --- | --- |
//! | over every edge coordinates change by a quarter turn and integers | `transitions` |
//! | every singular vertex is at an integer point | `singular` |
//! | every triangle is positively oriented | `orientation` |
//! | features and boundary are on integer lines | `isolines` |
//!
//! The check uses only the mesh and the coordinates of its corners, whatever their source. It shares no code
//! with the computation of maps.

mod isolines;
mod orientation;
mod singular;
mod transitions;

pub use isolines::feature_edges;
use orientation::orientation;
pub use singular::Singularity;

use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::features::check_edges;
use isolines::distance_to_isoline;
use singular::singularities;
use transitions::seen;

/// The required accuracy of a map, in units of the integer grid.
///
/// Coordinates with six decimals pass, and so does the residual of a constraint after a solve. A wrong
/// translation is hardly ever this close to an integer by chance.
pub const MAP_TOLERANCE: f64 = 1e-6;

/// The tolerance, and the checks beyond transitions, singular vertices and orientation.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckOptions {
    /// The largest distance from an integer, or between equal points, in units of the grid.
    pub tolerance: f64,
    /// Edges of the mesh that must be on integer isolines.
    pub features: Vec<usize>,
    /// Whether the boundary must be on integer isolines.
    pub boundary: bool,
}

impl Default for CheckOptions {
    fn default() -> Self {
        CheckOptions {
            tolerance: MAP_TOLERANCE,
            features: Vec::new(),
            boundary: true,
        }
    }
}

/// An element that breaks a rule, and the amount in units of the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Defect {
    /// The edge, vertex or face.
    pub element: usize,
    /// Its distance from satisfying the rule.
    pub amount: f64,
}

/// The faults of a map for each rule, with elements in increasing order.
#[derive(Debug, Clone, PartialEq)]
pub struct MapCheck {
    /// Edges over which coordinates do not change by a quarter turn, with the difference of the edge's
    /// two images.
    pub rotations: Vec<Defect>,
    /// Edges over which coordinates change by a quarter turn, but with a translation that is not
    /// integer.
    pub translations: Vec<Defect>,
    /// All singular vertices, good and bad.
    pub singularities: Vec<Singularity>,
    /// Singular vertices that are not at integer points.
    pub off_grid: Vec<Defect>,
    /// Faces with negative orientation, decided exactly, with their area in unit squares.
    pub flipped: Vec<Defect>,
    /// Faces whose corners are exactly collinear.
    pub degenerate: Vec<usize>,
    /// Boundary edges off the integer isolines.
    pub boundary: Vec<Defect>,
    /// Feature edges off the integer isolines.
    pub features: Vec<Defect>,
    /// The largest difference of an edge's two images.
    pub worst_rotation: f64,
    /// The largest distance of a translation from integers, over edges with a quarter turn.
    pub worst_translation: f64,
}

impl MapCheck {
    /// Whether there is no fault.
    pub fn is_valid(&self) -> bool {
        self.is_integer() && self.is_fold_free() && self.is_aligned()
    }

    /// Whether coordinates change by a quarter turn and any translation over every edge.
    pub fn is_seamless(&self) -> bool {
        self.rotations.is_empty()
    }

    /// Whether translations are integer as well, and every singular vertex is at an integer point.
    pub fn is_integer(&self) -> bool {
        self.is_seamless() && self.translations.is_empty() && self.off_grid.is_empty()
    }

    /// Whether every triangle is positively oriented.
    pub fn is_fold_free(&self) -> bool {
        self.flipped.is_empty() && self.degenerate.is_empty()
    }

    /// Whether the features and the boundary that were checked are on integer isolines.
    pub fn is_aligned(&self) -> bool {
        self.boundary.is_empty() && self.features.is_empty()
    }
}

/// Checks the map that gives each corner of each face of a mesh these coordinates (u, v).
///
/// # Errors
/// [`Error::LengthMismatch`] for other than one entry a face, [`Error::NotFinite`] with the face,
/// [`Error::IndexOutOfRange`] for a feature that is no edge, [`Error::InvalidArgument`] for a
/// tolerance that is not between 0 and 1/4.
pub fn check_map(
    mesh: &TriangleMesh,
    uv: &[[[f64; 2]; 3]],
    options: &CheckOptions,
) -> Result<MapCheck> {
    validate(mesh, uv, options)?;
    let tolerance = options.tolerance;
    let (mut rotations, mut translations) = (Vec::new(), Vec::new());
    let (mut worst_rotation, mut worst_translation) = (0.0f64, 0.0f64);
    let mut quarters = vec![0; mesh.edge_count()];
    for edge in 0..mesh.edge_count() {
        let Some(seen) = seen(mesh, uv, edge, tolerance) else {
            continue;
        };
        quarters[edge] = seen.quarters;
        worst_rotation = worst_rotation.max(seen.rotation_error);
        if seen.rotation_error > tolerance {
            rotations.push(defect(edge, seen.rotation_error));
            continue;
        }
        worst_translation = worst_translation.max(seen.translation_error);
        if seen.translation_error > tolerance {
            translations.push(defect(edge, seen.translation_error));
        }
    }
    let singularities = singularities(mesh, uv, &quarters, options.boundary);
    let off_grid = off_grid(mesh, uv, &singularities, tolerance);
    let off_lines = |edges: &mut dyn Iterator<Item = usize>| {
        let measured = edges.map(|edge| defect(edge, distance_to_isoline(mesh, uv, edge)));
        measured.filter(|d| d.amount > tolerance).collect()
    };
    let is_boundary = |e: &usize| options.boundary && mesh.edge(*e).second.is_none();
    let faces = 0..mesh.face_count();
    let area = |f: usize| 0.5 * orientation(uv[f]);
    Ok(MapCheck {
        rotations,
        translations,
        off_grid,
        singularities,
        flipped: (faces.clone().map(|f| defect(f, area(f))))
            .filter(|d| d.amount < 0.0)
            .collect(),
        degenerate: faces.filter(|&f| area(f) == 0.0).collect(),
        boundary: off_lines(&mut (0..mesh.edge_count()).filter(is_boundary)),
        features: off_lines(&mut options.features.iter().copied()),
        worst_rotation,
        worst_translation,
    })
}

/// The singular vertices that are not at an integer point in some face around them.
fn off_grid(
    mesh: &TriangleMesh,
    uv: &[[[f64; 2]; 3]],
    singularities: &[Singularity],
    tolerance: f64,
) -> Vec<Defect> {
    let farthest = |vertex: usize| {
        let around = mesh.ring(vertex).map(|(face, corner)| uv[face][corner]);
        let coordinates = around.flatten().map(|x| (x - x.round()).abs());
        coordinates.fold(0.0, f64::max)
    };
    let vertices = singularities.iter().map(|s| s.vertex);
    let measured = vertices.map(|v| defect(v, farthest(v)));
    measured.filter(|d| d.amount > tolerance).collect()
}

fn validate(mesh: &TriangleMesh, uv: &[[[f64; 2]; 3]], options: &CheckOptions) -> Result<()> {
    if uv.len() != mesh.face_count() {
        return Err(Error::LengthMismatch {
            what: "the coordinates of the corners",
            expected: mesh.face_count(),
            actual: uv.len(),
        });
    }
    let is_finite = |corners: &[[f64; 2]; 3]| corners.iter().flatten().all(|x| x.is_finite());
    if let Some(position) = uv.iter().position(|corners| !is_finite(corners)) {
        return Err(Error::NotFinite {
            what: "the coordinates of the corners",
            position,
        });
    }
    if !(0.0..0.25).contains(&options.tolerance) {
        return Err(Error::InvalidArgument {
            what: format!(
                "the tolerance is {}; it must be at least 0 and below 0.25",
                options.tolerance
            ),
            index: None,
        });
    }
    check_edges(mesh, "features", &options.features)
}

fn defect(element: usize, amount: f64) -> Defect {
    Defect { element, amount }
}

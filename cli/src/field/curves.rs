//! Curves in space that a field or quads follow: `--guide-curves` and `--feature-curves`.

use std::collections::BTreeSet;
use std::fmt;
use std::path::{Path, PathBuf};

use roundel::field::{Guidance, Guide, guides_along};
use roundel::geodesic::{SurfacePoint, cut_along, draw_curve};
use roundel::map::Sizing;
use roundel::mesh::features::FeatureGraph;
use roundel::mesh::refine::Refined;
use roundel::mesh::vector::Vec3;
use roundel::mesh::{MeshError, TriangleMesh};
use roundel::quad::RefinedInput;
use roundel::soup::io::read_polylines;
use roundel::{Error, Monitor, Result};
use serde::Serialize;

use super::directions::{named, weight};
use crate::interrupt;
use crate::summary::{counted, counted_vertices};

/// The files of curves.
#[derive(clap::Args)]
pub struct Curves {
    /// Draw the lines (l V1 V2 ...) of this OBJ file onto the surface, by closest points and shortest paths, and
    /// let the field follow them where nothing else decides its direction
    #[arg(long, value_name = "CURVES.obj")]
    guide_curves: Option<PathBuf>,

    /// The weight of --guide-curves in a face that a curve crosses from side to side, where the angle to a
    /// neighbouring face has weight 1
    #[arg(long, value_name = "WEIGHT", default_value_t = 10.0, value_parser = weight)]
    #[arg(allow_negative_numbers = true)]
    curve_weight: f64,

    /// Draw the lines of this OBJ file onto the surface, and cut the mesh along them: they are features, and so
    /// become chains of edges of the quads, closed ones edge loops
    #[arg(long, value_name = "CURVES.obj")]
    feature_curves: Option<PathBuf>,
}

/// What was made of curves.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct CurveCounts {
    /// The faces with a guide, those of `--guide` among them.
    guided_faces: usize,
    /// Curves along which the mesh was cut, the vertices that were inserted, and the edges along them.
    feature_curves: usize,
    inserted_vertices: usize,
    curve_edges: usize,
}

impl fmt::Display for CurveCounts {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let mut words = Vec::new();
        if self.guided_faces > 0 {
            words.push(format!("guides for {}", counted(self.guided_faces, "face")));
        }
        if self.feature_curves > 0 {
            words.push(format!(
                "{} along {}, {} inserted",
                counted(self.curve_edges, "edge"),
                counted(self.feature_curves, "curve"),
                counted_vertices(self.inserted_vertices, "")
            ));
        }
        f.write_str(&words.join("; "))
    }
}

/// What a field or a map follows, on the mesh that was cut along curves where there are any.
pub struct Followed {
    /// The mesh that was cut, and what it was before; none without curves.
    pub cut: Option<Refined>,
    pub guidance: Guidance,
    pub features: FeatureGraph,
    pub sizing: Sizing,
    /// None without curves.
    pub counts: Option<CurveCounts>,
}

impl Curves {
    /// The files.
    pub(super) fn files(&self) -> [Option<&Path>; 2] {
        [self.guide_curves.as_deref(), self.feature_curves.as_deref()]
    }

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.files().iter().all(Option::is_none)
    }

    /// Whether curves guide the field.
    pub(super) fn guide(&self) -> bool {
        self.guide_curves.is_some()
    }

    /// The guides along curves, for faces that have no other.
    pub(super) fn guides(&self, mesh: &TriangleMesh, guidance: &Guidance) -> Result<Vec<Guide>> {
        let Some(path) = &self.guide_curves else {
            return Ok(Vec::new());
        };
        let guided: BTreeSet<usize> = guidance.guides.iter().map(|guide| guide.face).collect();
        let curves = drawn(mesh, path)?;
        let mut guides = guides_along(mesh, &curves, guidance.symmetry, self.curve_weight)?;
        guides.retain(|guide| !guided.contains(&guide.face));
        Ok(guides)
    }

    /// The curves that guide the field, as polylines on the surface.
    pub fn guide_lines(&self, mesh: &TriangleMesh) -> Result<Vec<Vec<Vec3>>> {
        let Some(path) = &self.guide_curves else {
            return Ok(Vec::new());
        };
        let places = |curve: Vec<SurfacePoint>| {
            let places = curve.iter().map(|point| point.position(mesh));
            places.collect()
        };
        Ok(drawn(mesh, path)?.into_iter().map(places).collect())
    }

    /// Cuts the mesh along the curves that are features, and gives what is to be followed there.
    pub fn follow(
        &self,
        mesh: &TriangleMesh,
        (guidance, features): (Guidance, FeatureGraph),
        sizing: Sizing,
    ) -> Result<Followed> {
        let mut counts = CurveCounts {
            guided_faces: guidance.guides.len(),
            ..CurveCounts::default()
        };
        let Some(path) = &self.feature_curves else {
            return Ok(Followed {
                cut: None,
                guidance,
                features,
                sizing,
                counts: (!self.is_empty()).then_some(counts),
            });
        };
        let along = cut_along(mesh, &drawn(mesh, path)?)?;
        let edges = along.edges();
        counts = CurveCounts {
            feature_curves: along.curves.len(),
            inserted_vertices: along.cut.splits,
            curve_edges: edges.len(),
            ..counts
        };
        let input = RefinedInput::on(mesh, (&guidance, &features, &sizing), along.cut)?;
        let cut = &input.refined.mesh;
        let features = input
            .features
            .with(cut, &FeatureGraph::from_edges(cut, &edges)?)?;
        Ok(Followed {
            guidance: Guidance {
                feature_edges: features.edges().collect(),
                ..input.guidance
            },
            features,
            sizing: input.sizing,
            cut: Some(input.refined),
            counts: Some(counts),
        })
    }
}

/// The lines of a file as curves on the surface.
fn drawn(mesh: &TriangleMesh, path: &Path) -> Result<Vec<Vec<SurfacePoint>>> {
    let lines = read_polylines(path).map_err(|error| named(path, MeshError::from(error).into()))?;
    let refused = |what: String, index| Error::InvalidArgument { what, index };
    if lines.is_empty() {
        let what = format!("{} has no lines", path.display());
        return Err(refused(what, None));
    }
    let monitor = Monitor::default().cancel_token(interrupt::cancel_token()?);
    let draw = |(number, line): (usize, &Vec<Vec3>)| {
        draw_curve(mesh, line, &monitor).map_err(|error| match error {
            Error::InvalidArgument { what, index } => {
                let what = format!("line {number} of {}: {what}", path.display());
                refused(what, index)
            }
            other => other,
        })
    };
    lines.iter().enumerate().map(draw).collect()
}

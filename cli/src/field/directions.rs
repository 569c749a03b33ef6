//! The flags for what a field follows, of every command that computes one.

use std::path::{Path, PathBuf};

use roundel::Error;
use roundel::field::{Constraint, Guidance};
use roundel::mesh::TriangleMesh;
use roundel::mesh::features::FeatureGraph;
use roundel::quad::QuadOptions;
use roundel::soup::io::Attribute;

use super::curves::Curves;
use super::feature_sources::FeatureSources;
use crate::mesh::Input;

/// The default fraction of faces that have the direction of their curvature.
const CURVED: f64 = 0.1;

/// Features, and directions from curvature, for single faces and from a file.
#[derive(clap::Args)]
pub struct Directions {
    /// Follow feature edges; in a map they are isolines. A list of: an angle in degrees (40 or angle:40), at
    /// which and above which the surface is sharp, and names of what the two faces of an edge differ in:
    /// materials, groups, smoothing, seams (of texture coordinates), normals (OBJ), colors (of faces, PLY)
    #[arg(long, value_name = "DEGREES|NAMES", value_parser = FeatureSources::parse)]
    #[arg(allow_negative_numbers = true)]
    pub features: Option<FeatureSources>,

    /// Follow the edges that are line elements (l V1 V2 ...) of this OBJ file. It must have the
    /// vertices of the mesh, and may be the file of the mesh
    #[arg(long, value_name = "LINES.obj")]
    pub feature_lines: Option<PathBuf>,

    /// Leave sharp edges out (--features DEGREES) in curves that end somewhere and are shorter than this, in units
    /// of the mesh, and around patches whose area is below a sixteenth of its square [default: 0; for a map or quads,
    /// two edges of the quads]
    #[arg(long, value_name = "LENGTH", value_parser = weight)]
    #[arg(allow_negative_numbers = true)]
    pub feature_length: Option<f64>,

    /// Do not follow the boundary, which is a feature by default
    #[arg(long)]
    pub free_boundary: bool,

    /// Constrain this fraction of the faces, those with the most reliable curvature, to the
    /// direction of least curvature; from 0 to 1 [default: for a map or quads without
    /// --curvature-weight 0.005, and 0 with --guide-curves; otherwise 0.1, and 0 with features, curves, indices
    /// or --symmetry 1]
    #[arg(long, value_name = "FRACTION", value_parser = fraction)]
    #[arg(allow_negative_numbers = true)]
    pub constrain_curvature: Option<f64>,

    /// Pull all other faces towards the direction of least curvature, with this weight for an area of
    /// 1 and a difference of curvatures of 1 [default: for a map or quads without
    /// --constrain-curvature and indices 0.07; otherwise 0]
    #[arg(long, value_name = "WEIGHT", value_parser = weight)]
    #[arg(allow_negative_numbers = true)]
    pub curvature_weight: Option<f64>,

    /// Ignore details smaller than this length, in units of the mesh, so that they attract no irregular
    /// vertices [default: 0; for a map, the edge length of its quads; for quads, a quarter of it]
    #[arg(long, value_name = "LENGTH", value_parser = weight)]
    #[arg(allow_negative_numbers = true)]
    pub detail: Option<f64>,

    /// Keep irregular vertices this far from features, along the surface and in units of the mesh, or on
    /// them; 0 turns it off [default: 0; for quads with features, the edge length of the quads]
    #[arg(long, value_name = "LENGTH", value_parser = weight)]
    #[arg(allow_negative_numbers = true)]
    pub clearance: Option<f64>,

    /// Constrain this face to this direction, in degrees counter-clockwise from its first edge; may be
    /// repeated, and takes precedence over all other flags
    #[arg(long, value_name = "FACE:DEGREES", value_parser = constraint)]
    pub fix: Vec<Constraint>,

    /// Read guidance from this file. A line is one of: direction FACE X Y Z [WEIGHT], edge VERTEX
    /// VERTEX, index VERTEX STEPS (in quarter turns)
    #[arg(long, value_name = "GUIDE.txt")]
    pub guide: Option<PathBuf>,

    #[command(flatten)]
    pub curves: Curves,
}

impl Directions {
    /// The files that are read: feature lines, the guide and curves.
    pub fn files(&self) -> [Option<&Path>; 4] {
        let [guides, features] = self.curves.files();
        let lines = self.feature_lines.as_deref();
        [lines, self.guide.as_deref(), guides, features]
    }

    /// The attributes of the file whose changes are features.
    pub fn attributes(&self) -> &[Attribute] {
        self.features.as_ref().map_or(&[], |f| &f.attributes)
    }

    /// The guidance of the command line, for a field of this symmetry, and the edges to follow, among them
    /// those by attributes. `edge_length` is that of the quads that it is for, if it is for quads.
    pub fn of(
        &self,
        mesh: &TriangleMesh,
        by_attributes: Option<&FeatureGraph>,
        symmetry: u8,
        edge_length: Option<f64>,
    ) -> roundel::Result<(Guidance, FeatureGraph)> {
        let angle = self.features.as_ref().and_then(|f| f.angle);
        let mut guidance = Guidance {
            symmetry,
            constraints: self.fix.clone(),
            curvature_weight: self.curvature_weight.unwrap_or(0.0),
            feature_angle: angle.map(f64::to_radians),
            feature_length: self.feature_length,
            align_boundary: !self.free_boundary,
            detail: self.detail,
            clearance: self.clearance,
            ..Guidance::default()
        };
        if let Some(path) = &self.guide {
            let read = guidance.read(mesh, path);
            read.map_err(|error| named(path, error))?;
        }
        guidance.guides.extend(self.curves.guides(mesh, &guidance)?);
        let mut by_name = FeatureGraph::none(mesh);
        if let Some(given) = by_attributes {
            by_name = by_name.with(mesh, given)?;
        }
        if let Some(path) = &self.feature_lines {
            let lines = FeatureGraph::read(mesh, path).map_err(|error| named(path, error))?;
            by_name = by_name.with(mesh, &lines)?;
        }
        guidance.feature_edges = by_name.edges().collect();
        // Sharp shapes are flat elsewhere: curvature there is noise. Curves say what to follow.
        let by_features =
            self.features.is_some() || self.feature_lines.is_some() || !self.curves.is_empty();
        let by_all = symmetry != 1 && guidance.indices.is_none() && !by_features;
        let default = if by_all { CURVED } else { 0.0 };
        guidance.constrain_curvature = self.constrain_curvature.unwrap_or(default);
        let guidance = match edge_length {
            Some(length) => guidance.for_quads(length),
            None => guidance,
        };
        let features = guidance.features(mesh)?;
        Ok((guidance, features))
    }
}

/// How many sharp edges are not among the features because they are [too short](FeatureGraph::without_short).
pub fn too_short(mesh: &TriangleMesh, guidance: &Guidance) -> roundel::Result<usize> {
    if guidance.feature_angle.is_none() {
        return Ok(0);
    }
    let all = Guidance {
        feature_length: Some(0.0),
        ..guidance.clone()
    };
    let [all, long] = [&all, guidance].map(|of| of.features(mesh));
    Ok(all?.edges().count() - long?.edges().count())
}

impl Directions {
    /// Refuses flags that count faces or vertices of a mesh that was repaired.
    ///
    /// # Errors
    /// Those of [`Input::keeps_numbers`].
    pub fn keep_numbers(&self, input: &Input) -> roundel::Result<()> {
        input.keeps_numbers("--feature-lines", self.feature_lines.is_some())?;
        input.keeps_numbers("--fix", !self.fix.is_empty())?;
        input.keeps_numbers("--guide", self.guide.is_some())
    }

    /// As [`of`](Self::of), for crosses that a map follows: without flags for curvature, the defaults
    /// of quads hold.
    pub fn of_map(
        &self,
        mesh: &TriangleMesh,
        by_attributes: Option<&FeatureGraph>,
        edge_length: Option<f64>,
    ) -> roundel::Result<(Guidance, FeatureGraph)> {
        let (mut guidance, features) = self.of(mesh, by_attributes, 4, edge_length)?;
        if !self.says_curvature() && guidance.indices.is_none() {
            let default = QuadOptions::default().guidance;
            guidance.constrain_curvature = match self.curves.guide() {
                true => 0.0,
                false => default.constrain_curvature,
            };
            guidance.curvature_weight = default.curvature_weight;
        }
        Ok((guidance, features))
    }

    /// Whether the command line has flags for curvature.
    pub fn says_curvature(&self) -> bool {
        self.constrain_curvature.is_some() || self.curvature_weight.is_some()
    }
}

/// The error with the name of its file, as messages begin with the name of the mesh.
pub fn named(path: &Path, error: Error) -> Error {
    match error {
        Error::Parse { line, message } => Error::Parse {
            line,
            message: format!("{message} ({})", path.display()),
        },
        other => other,
    }
}

pub(super) fn weight(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number")?;
    match value >= 0.0 && value.is_finite() {
        true => Ok(value),
        false => Err("the number must be finite and at least 0".into()),
    }
}

fn fraction(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number")?;
    match (0.0..=1.0).contains(&value) {
        true => Ok(value),
        false => Err("the fraction must be from 0 to 1".into()),
    }
}

fn constraint(text: &str) -> Result<Constraint, String> {
    let (face, degrees) = text.split_once(':').ok_or("expected FACE:DEGREES")?;
    let face = face
        .parse()
        .map_err(|_| "FACE is not the number of a face")?;
    let degrees: f64 = degrees.parse().map_err(|_| "DEGREES is not a number")?;
    match degrees.is_finite() {
        true => Ok(Constraint {
            face,
            angle: degrees.to_radians(),
        }),
        false => Err("DEGREES is not finite".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::{constraint, fraction, weight};

    #[test]
    fn a_direction_is_a_face_and_finite_degrees() {
        let given = constraint("7:-90").unwrap();
        assert_eq!((given.face, given.angle), (7, -std::f64::consts::FRAC_PI_2));
        for text in [
            "", "7", "7:", ":3", "-1:3", "1.5:3", "7:nan", "7:inf", "7:3:4",
        ] {
            assert!(constraint(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_fraction_is_at_most_one() {
        assert_eq!((fraction("0"), fraction("1")), (Ok(0.0), Ok(1.0)));
        for text in ["-0.1", "1.01", "nan", "a tenth", ""] {
            assert!(fraction(text).is_err(), "{text}");
        }
    }

    #[test]
    fn weights_are_not_negative() {
        assert_eq!(weight("0"), Ok(0.0));
        for text in ["-1", "inf", "nan", "much"] {
            assert!(weight(text).is_err(), "{text}");
        }
    }
}

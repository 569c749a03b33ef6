//! What is told of a mesh.

use std::process::ExitStatus;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::meshes::MeshFile;
use crate::summary::counted;

/// How a mesh ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Outcome {
    /// All faces are quads, and they conform.
    Quads,
    /// There are faces, but they do not conform.
    Faulty,
    /// An error was told.
    Refused,
    /// It took longer than the limit.
    Stopped,
    /// The process ended without a word.
    Crashed,
}

impl Outcome {
    pub const ALL: [Outcome; 5] = [
        Outcome::Quads,
        Outcome::Faulty,
        Outcome::Refused,
        Outcome::Stopped,
        Outcome::Crashed,
    ];

    /// The word of the journal.
    pub fn name(self) -> &'static str {
        match self {
            Outcome::Quads => "quads",
            Outcome::Faulty => "faulty",
            Outcome::Refused => "refused",
            Outcome::Stopped => "stopped",
            Outcome::Crashed => "crashed",
        }
    }

    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            Outcome::Quads => "became quads",
            Outcome::Faulty => "became quads with faults",
            Outcome::Refused => "refused",
            Outcome::Stopped => "given up for time",
            Outcome::Crashed => "crashed",
        }
    }
}

/// A mesh and its quads. What an outcome does not have is left out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Row {
    pub name: String,
    pub bytes: u64,
    pub modified: u64,
    /// The version of Roundel, and the flags of `roundel quad`.
    pub version: String,
    pub flags: Vec<String>,
    pub outcome: Outcome,
    /// Wall-clock time of the process.
    pub seconds: f64,
    #[serde(flatten)]
    pub figures: Figures,
}

/// Figures of quads.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub(super) struct Figures {
    /// The code of an error, and its text.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub code: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub triangles: Option<u64>,
    /// How often each kind of repair was done.
    #[serde(skip_serializing_if = "serde_json::Map::is_empty")]
    pub repair: serde_json::Map<String, Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub quads: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub irregular_vertices: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inverted: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scaled_jacobian_min: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean_angle_deviation: Option<f64>,
    /// The largest distance of the quads from the mesh over the diagonal of its bounding box.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub peak_memory_bytes: Option<u64>,
    /// A picture of the quads: a PNG file in base64.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thumbnail: Option<String>,
}

impl Row {
    /// A row without figures.
    pub fn new(mesh: &MeshFile, flags: &[String], outcome: Outcome, seconds: f64) -> Self {
        Row {
            name: mesh.name.clone(),
            bytes: mesh.bytes,
            modified: mesh.modified,
            version: env!("CARGO_PKG_VERSION").into(),
            flags: flags.to_vec(),
            outcome,
            seconds,
            figures: Figures::default(),
        }
    }

    /// Whether it was made of this file, with these flags, by this version.
    pub fn is_of(&self, mesh: &MeshFile, flags: &[String]) -> bool {
        (&self.name, self.bytes, self.modified) == (&mesh.name, mesh.bytes, mesh.modified)
            && self.flags == flags
            && self.version == env!("CARGO_PKG_VERSION")
    }

    /// Takes over what `roundel quad --json` has told.
    pub fn fill(&mut self, told: &Value, status: ExitStatus) {
        let number = |key: &str| told[key].as_u64();
        let text = |value: &Value| value.as_str().map(String::from);
        let error = &told["error"];
        self.outcome = match (error.is_object(), told["conforming"].as_bool()) {
            (true, _) => Outcome::Refused,
            (false, Some(true)) => Outcome::Quads,
            (false, Some(false)) => Outcome::Faulty,
            (false, None) => Outcome::Crashed,
        };
        self.figures = Figures {
            code: text(&error["code"]),
            message: text(&error["message"]),
            triangles: number("faces"),
            repair: told["repair"].as_object().cloned().unwrap_or_default(),
            quads: number("quads"),
            irregular_vertices: number("irregular_vertices"),
            inverted: number("inverted"),
            scaled_jacobian_min: told["scaled_jacobian_min"].as_f64(),
            mean_angle_deviation: told["mean_angle_deviation"].as_f64(),
            distance: told["distance"]["of_diagonal"].as_f64(),
            peak_memory_bytes: number("peak_memory_bytes"),
            thumbnail: None,
        };
        if self.outcome == Outcome::Crashed {
            self.figures.message = Some(status.to_string());
        }
    }

    /// One line for people.
    pub fn line(&self) -> String {
        let figures = &self.figures;
        let told = match (figures.quads, &figures.message) {
            (Some(quads), _) => {
                let irregular = figures.irregular_vertices.unwrap_or(0);
                let fault = match self.outcome {
                    Outcome::Faulty => ", with faults",
                    _ => "",
                };
                format!(
                    "{}, {irregular} irregular{fault}",
                    counted(quads as usize, "quad")
                )
            }
            (None, Some(message)) => format!("{}: {message}", self.outcome.words()),
            (None, None) => self.outcome.words().into(),
        };
        format!("{}: {told} ({:.1} s)", self.name, self.seconds)
    }
}

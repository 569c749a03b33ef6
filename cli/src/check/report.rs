//! The JSON object of a check: counts, and every element at fault with its amount.

use std::path::Path;

use roundel::check::Defect;
use serde::Serialize;

use super::checked::Checked;

/// What `--json` prints of a check.
#[derive(Serialize)]
pub struct CheckReport {
    file: String,
    valid: bool,
    seamless: bool,
    integer: bool,
    unfolded: bool,
    aligned: bool,
    faces: usize,
    vertices: usize,
    worst_rotation: f64,
    worst_translation: f64,
    rotations: Vec<Amount>,
    translations: Vec<Amount>,
    singularities: Vec<Index>,
    off_grid: Vec<Amount>,
    flipped: Vec<Amount>,
    degenerate: Vec<usize>,
    boundary: Vec<Amount>,
    features: Vec<Amount>,
    seconds: Seconds,
}

#[derive(Serialize)]
struct Amount {
    element: usize,
    amount: f64,
}

#[derive(Serialize)]
struct Index {
    vertex: usize,
    quarters: i32,
}

#[derive(Serialize)]
struct Seconds {
    read: f64,
    check: f64,
}

impl CheckReport {
    /// The report of what was found in `file`.
    pub(super) fn new(file: &Path, checked: &Checked) -> Self {
        let check = &checked.check;
        let indices = check.singularities.iter().map(|s| Index {
            vertex: s.vertex,
            quarters: s.quarters,
        });
        CheckReport {
            file: file.to_string_lossy().into_owned(),
            valid: check.is_valid(),
            seamless: check.is_seamless(),
            integer: check.is_integer(),
            unfolded: check.is_fold_free(),
            aligned: check.is_aligned(),
            faces: checked.mesh.face_count(),
            vertices: checked.mesh.vertex_count(),
            worst_rotation: check.worst_rotation,
            worst_translation: check.worst_translation,
            rotations: amounts(&check.rotations),
            translations: amounts(&check.translations),
            singularities: indices.collect(),
            off_grid: amounts(&check.off_grid),
            flipped: amounts(&check.flipped),
            degenerate: check.degenerate.clone(),
            boundary: amounts(&check.boundary),
            features: amounts(&check.features),
            seconds: Seconds {
                read: checked.read,
                check: checked.seconds,
            },
        }
    }
}

fn amounts(defects: &[Defect]) -> Vec<Amount> {
    let amount = |d: &Defect| Amount {
        element: d.element,
        amount: d.amount,
    };
    defects.iter().map(amount).collect()
}

//! The reference figures: those of the thesis (a 2.8 GHz i7 of 2012), and those of the original program
//! with the thesis' parameters (CPU seconds of the solve, 2 cores of 2026, one thread).
//!
//! The thesis states the same problems, but with other constrained faces and another scale of the
//! energy, so that its energies can only be compared with each other.

use roundel::{Error, Result};
use serde::Deserialize;

use super::experiments::{Family, Subject};
use super::row::Row;

/// One figure of `reference.json`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Figure {
    problem: String,
    mesh: String,
    source: String,
    solver: String,
    integers: Option<u64>,
    continuous: Option<u64>,
    seconds: f64,
    energy: Option<f64>,
    irregular_vertices: Option<u64>,
    factor_nonzeros: Option<u64>,
    peak_memory_bytes: Option<u64>,
}

/// The figures for one problem of a mesh.
pub fn rows(family: Family, subject: &Subject) -> Result<Vec<Row>> {
    let figures: Vec<Figure> =
        serde_json::from_str(include_str!("reference.json")).map_err(|reason| Error::Io {
            message: format!("reference.json: {reason}"),
        })?;
    let of_subject = |f: &Figure| f.problem == family.name() && f.mesh == subject.name;
    let figures = figures.into_iter().filter(of_subject);
    Ok(figures.map(|figure| row(figure, subject)).collect())
}

fn row(figure: Figure, subject: &Subject) -> Row {
    Row {
        mesh: subject.name.clone(),
        shape: subject.shape.into(),
        triangles: subject.triangles,
        source: figure.source,
        solver: figure.solver,
        status: "reference".into(),
        integers: figure.integers,
        continuous: figure.continuous,
        energy: figure.energy,
        irregular_vertices: figure.irregular_vertices,
        factor_nonzeros: figure.factor_nonzeros,
        seconds: Some(figure.seconds),
        peak_memory_bytes: figure.peak_memory_bytes,
        ..Row::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evaluate::experiments::all;

    #[test]
    fn every_mesh_of_the_thesis_has_its_figures() {
        for experiment in all(usize::MAX) {
            for subject in &experiment.subjects {
                let rows = rows(experiment.family, subject).unwrap();
                let thesis = rows.iter().filter(|r| r.source == "thesis").count();
                assert!(thesis > 0, "{} {}", experiment.name, subject.name);
                assert!(rows.iter().all(Row::is_reference));
            }
        }
    }

    #[test]
    fn no_figure_is_for_a_mesh_that_no_table_has() {
        let figures: Vec<Figure> = serde_json::from_str(include_str!("reference.json")).unwrap();
        let experiments = all(usize::MAX);
        for figure in figures {
            let used = experiments.iter().any(|e| {
                let has = |s: &Subject| s.name == figure.mesh;
                e.family.name() == figure.problem && e.subjects.iter().any(has)
            });
            assert!(used, "{} {}", figure.problem, figure.mesh);
        }
    }
}

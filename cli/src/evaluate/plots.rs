//! Which plots a table has: energy over time, or time and memory over size.

use super::experiments::{Experiment, Kind};
use super::plot::{Plot, Series};
use super::row::Row;

/// The plots of a table, in the order of its meshes.
pub fn plots(experiment: &Experiment, rows: &[Row]) -> Vec<Plot> {
    match experiment.kind {
        Kind::TestBed => distinct(rows, |r| &r.mesh)
            .into_iter()
            .map(|mesh| energy_over_time(mesh, rows))
            .collect(),
        Kind::Growth => distinct(rows, |r| &r.shape)
            .into_iter()
            .flat_map(|shape| [time_over_size(shape, rows), memory_over_size(shape, rows)])
            .collect(),
        Kind::Ordering => Vec::new(),
    }
}

/// Energies of the thesis are on a scale of their own, and are left to the table.
fn energy_over_time(mesh: &str, rows: &[Row]) -> Plot {
    let shown = |r: &&Row| r.mesh == mesh && r.source != "thesis";
    // The original's figures are those of the mesh, not of what stands in for it.
    let stands_in = rows.iter().any(|r| r.mesh == mesh && r.stand_in.is_some());
    let shown = rows
        .iter()
        .filter(shown)
        .filter(|r| !stands_in || !r.is_reference());
    Plot {
        title: format!("{mesh}: energy over time"),
        x: "seconds",
        y: "energy",
        log_y: false,
        lines: false,
        series: series(shown, |r| Some([r.seconds?, r.energy?])),
    }
}

fn time_over_size(shape: &str, rows: &[Row]) -> Plot {
    Plot {
        title: format!("{shape}: time over size"),
        x: "triangles",
        y: "seconds",
        log_y: true,
        lines: true,
        series: series(of_shape(shape, rows), |r| {
            Some([r.triangles as f64, r.seconds?])
        }),
    }
}

fn memory_over_size(shape: &str, rows: &[Row]) -> Plot {
    Plot {
        title: format!("{shape}: peak memory over size"),
        x: "triangles",
        y: "MB",
        log_y: true,
        lines: true,
        series: series(of_shape(shape, rows), |r| {
            Some([r.triangles as f64, r.peak_memory_bytes? as f64 / 1e6])
        }),
    }
}

fn of_shape<'a>(shape: &'a str, rows: &'a [Row]) -> impl Iterator<Item = &'a Row> {
    rows.iter().filter(move |r| r.shape == shape)
}

/// One series a solver; solvers without a point have none.
fn series<'a>(
    rows: impl Iterator<Item = &'a Row>,
    point: impl Fn(&Row) -> Option<[f64; 2]>,
) -> Vec<Series> {
    let mut found: Vec<Series> = Vec::new();
    for row in rows {
        let Some(point) = point(row) else { continue };
        let name = row.label();
        match found.iter_mut().find(|s| s.name == name) {
            Some(series) => series.points.push(point),
            None => found.push(Series {
                name,
                points: vec![point],
                is_reference: row.is_reference(),
            }),
        }
    }
    found
}

fn distinct<'a>(rows: &'a [Row], key: impl Fn(&'a Row) -> &'a String) -> Vec<&'a str> {
    let mut found: Vec<&str> = Vec::new();
    for row in rows {
        if !found.contains(&key(row).as_str()) {
            found.push(key(row));
        }
    }
    found
}

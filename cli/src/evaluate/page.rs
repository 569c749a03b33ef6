//! The page: one HTML file without references to other files or the network.

use std::fmt::Write;

use super::escape::escape;
use super::experiments::Experiment;
use super::others::{self, Others};
use super::plots::plots;
use super::row::Row;
use super::table;
use crate::summary::thousands;

const STYLE: &str = "\
body { font: 15px/1.5 sans-serif; max-width: 76em; margin: 2em auto; padding: 0 1em; }
table { border-collapse: collapse; font-size: 13px; }
th, td { padding: 1px 10px; text-align: right; }
th { border-bottom: 1px solid; }
th:nth-child(-n+2), td:nth-child(-n+2) { text-align: left; }
tr.first td { border-top: 1px solid #bbb; }
tr.reference { color: #777; }
svg { width: 36em; max-width: 100%; font: 12px sans-serif; }
.title { font-weight: bold; }
.x { text-anchor: middle; }
.y { text-anchor: end; }
.grid { stroke: #ddd; fill: none; }
";

/// The page of all tables.
pub fn html(tables: &[(Experiment, Vec<Row>)], others: Option<&Others>, most: usize) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <title>Roundel: evaluation</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <h1>Roundel {version}: evaluation</h1>\n"
    );
    page += &about(most);
    page += &stand_ins(tables);
    for (experiment, rows) in tables {
        let _ = writeln!(page, "<h2>{}</h2>", escape(experiment.title));
        for plot in plots(experiment, rows) {
            page += &plot.svg();
        }
        page += &table::html(rows, experiment.kind);
    }
    if let Some(others) = others {
        page += &others::html(others);
    }
    page + "</body>\n</html>\n"
}

fn about(most: usize) -> String {
    let processor = processor().unwrap_or_else(|| "an unknown processor".into());
    let left_out = match most {
        usize::MAX => String::new(),
        most => format!(
            " Meshes of more than {} triangles were left out.",
            thousands(most)
        ),
    };
    format!(
        "<p>Section 5.3 of Bommes' thesis (2012), run anew. Seconds are wall-clock seconds of the \
         solve alone on one thread ({}), the shortest of three where they are short; peak memory is \
         that of the whole process, mesh and all.{left_out} The thesis ran on a 2.8 GHz i7, with \
         energies on a scale of its own. The original is its program with its parameters, run on \
         the meshes named, CPU seconds on a machine of 2026. Maps follow the field of the adaptive \
         strategy.</p>\n",
        escape(&processor)
    )
}

/// The rows whose mesh is a procedural stand-in.
fn stand_ins(tables: &[(Experiment, Vec<Row>)]) -> String {
    let mut said: Vec<(&str, &str)> = Vec::new();
    for row in tables.iter().flat_map(|(_, rows)| rows) {
        if let Some(stand_in) = &row.stand_in
            && !said.contains(&(&row.mesh, stand_in))
        {
            said.push((&row.mesh, stand_in));
        }
    }
    if said.is_empty() {
        return String::new();
    }
    let items: String = said
        .iter()
        .map(|(mesh, by)| format!("<li>{}: {}</li>\n", escape(mesh), escape(by)))
        .collect();
    format!(
        "<p>These meshes were not there. Procedural ones stand in for them, and figures of the \
         thesis and of the original are of other meshes than ours:</p>\n<ul>\n{items}</ul>\n"
    )
}

/// The name of the processor, from a file of Linux.
fn processor() -> Option<String> {
    let info = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = info.lines().find(|l| l.starts_with("model name"))?;
    Some(line.split(':').nth(1)?.trim().to_owned())
}

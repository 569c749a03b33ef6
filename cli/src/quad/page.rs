//! `--report`: one page that a browser turns and zooms, without network.
//!
//! The tables are written here, so that they are there without scripts; meshes go along as JSON and
//! are drawn by WebGL.

use std::fmt::Write;
use std::path::Path;

use roundel::extract::QuadMesh;
use roundel::quad::Compared;
use roundel::{Error, Result};
use serde::Serialize;

use super::steps::Solved;
use super::words;
use crate::summary::{counted, outcome, telling_gap, verdict};

const PAGE: &str = include_str!("page.html");

/// What the page draws.
#[derive(Serialize)]
struct Data<'a> {
    vertices: &'a [[f64; 3]],
    faces: &'a [[u32; 3]],
    /// One arm of every face's cross, in space.
    arms: Vec<[f64; 3]>,
    /// Irregular vertices and their index in quarters.
    irregular: Vec<(usize, i32)>,
    uvs: Vec<[[f64; 2]; 3]>,
    quad_vertices: &'a [[f64; 3]],
    quads: &'a [[u32; 4]],
}

/// Writes the page.
pub(super) fn write(path: &Path, title: &str, solved: &Solved) -> Result<()> {
    let failed = |reason: String| Error::Io {
        message: format!("{}: {reason}", path.display()),
    };
    let text = page(title, solved).map_err(|error| failed(error.to_string()))?;
    std::fs::write(path, text).map_err(|error| failed(error.to_string()))
}

fn page(title: &str, solved: &Solved) -> serde_json::Result<String> {
    let made = &solved.made;
    let mesh = made.mesh(&solved.mesh);
    let quarters = made.field.vertex_index_steps(mesh).into_iter().enumerate();
    let data = Data {
        vertices: mesh.vertices(),
        faces: mesh.triangles(),
        arms: (0..mesh.face_count())
            .map(|face| made.field.direction(mesh, face))
            .collect(),
        irregular: quarters.filter(|&(_, quarters)| quarters != 0).collect(),
        uvs: made.untangled.map.corner_uvs(),
        quad_vertices: &made.quads.vertices,
        quads: &made.quads.quads,
    };
    // Nothing in JSON but a text could end the script; numbers cannot.
    let data = serde_json::to_string(&data)?;
    Ok(PAGE
        .replace("@TITLE@", &escaped(title))
        .replace("@TABLES@", &tables(solved))
        .replace("@DATA@", &data))
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;");
    text.replace('>', "&gt;").replace('@', "&#64;")
}

fn tables(solved: &Solved) -> String {
    let made = &solved.made;
    let quality = roundel::smooth::QuadQuality::new(&made.quads);
    let (solution, seconds) = (&made.solution, made.seconds);
    let mut out = String::new();
    let rows = [
        ("outcome", words(&made.quads)),
        (
            "mean deviation from right angles",
            format!("{:.2} degrees", quality.angle_deviation),
        ),
        (
            "scaled Jacobian, 1st percentile",
            format!("{:.3}", quality.scaled_jacobian_p1),
        ),
        (
            "scaled Jacobian, least",
            format!("{:.3}", quality.scaled_jacobian_min),
        ),
        ("quads turned over", quality.inverted.to_string()),
        (
            "spread of edge lengths",
            format!("{:.1} %", 100.0 * quality.edge_spread),
        ),
    ];
    table(&mut out, "Quads", &rows);
    let field = &made.field_solution;
    let solve = |name: &str, solution: &roundel::Solution| {
        [
            (format!("{name}: outcome"), verdict(solution)),
            (
                format!("{name}: integers"),
                counted(solution.counts().reduced_integers, "integer"),
            ),
            (
                format!("{name}: energy"),
                format!("{:.6}", solution.energy()),
            ),
            (format!("{name}: lower bound"), bound(solution)),
            (format!("{name}: gap"), gap(solution)),
        ]
    };
    let rows = [solve("field", field), solve("map", solution)].concat();
    table(&mut out, "Solver", &rows);
    if !made.compared.is_empty() {
        strategies(&mut out, &made.compared);
    }
    let rows = [
        ("read", solved.read_seconds),
        ("field", seconds.field),
        ("map", seconds.map),
        ("quads", seconds.extract),
        ("smooth", seconds.smooth),
    ];
    let rows = rows.map(|(name, seconds)| (name, format!("{seconds:.3} s")));
    table(&mut out, "Times", &rows);
    histogram(&mut out, &made.quads);
    out
}

/// One row a strategy, of the field's problem and of the map's.
fn strategies(out: &mut String, compared: &[Compared]) {
    for problem in ["Field", "Map"] {
        let _ = write!(
            out,
            "<table class=\"strategies\"><tr><th>{problem} by strategy</th><th>outcome</th>\
             <th>energy</th><th>lower bound</th><th>gap</th><th>seconds</th></tr>"
        );
        for one in compared {
            let solution = match problem {
                "Field" => &one.field,
                _ => &one.map,
            };
            let cells = [
                one.strategy.name().to_string(),
                outcome(solution),
                format!("{:.6}", solution.energy()),
                bound(solution),
                gap(solution),
                format!("{:.3}", solution.seconds().total),
            ];
            let cells = cells.map(|cell| format!("<td>{cell}</td>")).concat();
            let _ = write!(out, "<tr>{cells}</tr>");
        }
        out.push_str("</table>\n");
    }
}

/// The lower bound, if it says something.
fn bound(solution: &roundel::Solution) -> String {
    let telling = telling_gap(solution.gap()).and(solution.lower_bound());
    telling.map_or_else(|| "none".into(), |bound| format!("{bound:.4}"))
}

fn gap(solution: &roundel::Solution) -> String {
    let gap = telling_gap(solution.gap());
    gap.map_or_else(|| "none".into(), |gap| format!("{:.4} %", 100.0 * gap))
}

fn table<N: AsRef<str>>(out: &mut String, title: &str, rows: &[(N, String)]) {
    let _ = write!(out, "<table><tr><th>{title}</th><th></th></tr>");
    for (name, value) in rows {
        let name = escaped(name.as_ref());
        let _ = write!(out, "<tr><td>{name}</td><td>{}</td></tr>", escaped(value));
    }
    out.push_str("</table>\n");
}

/// How many vertices have how many edges.
fn histogram(out: &mut String, quads: &QuadMesh) {
    let mut edges: Vec<[u32; 2]> = Vec::new();
    for face in quads.faces() {
        let ends = face.iter().zip(face.iter().cycle().skip(1));
        edges.extend(ends.map(|(&a, &b)| [a.min(b), a.max(b)]));
    }
    edges.sort_unstable();
    edges.dedup();
    let mut valence = vec![0; quads.vertices.len()];
    for &v in edges.as_flattened() {
        valence[v as usize] += 1;
    }
    let most = valence.iter().copied().max().unwrap_or(0);
    out.push_str("<table><tr><th>Valence</th><th>vertices</th><th></th></tr>");
    for k in 1..=most {
        let count = valence.iter().filter(|&&v| v == k).count();
        if count > 0 {
            let width = 12.0 * count as f64 / valence.len() as f64;
            let _ = write!(
                out,
                "<tr><td>{k}</td><td>{count}</td><td style=\"text-align:left\">\
                 <span class=\"bar\" style=\"width:{width:.2}em\"></span></td></tr>"
            );
        }
    }
    out.push_str("</table>\n");
}

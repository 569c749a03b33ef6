//! The elements at fault if quads do not conform, for programs and in one line for people.

use std::io::{self, Write};
use std::path::Path;

use roundel::extract::QuadMesh;
use serde::Serialize;

/// The elements at fault, and the triangles that the map folds.
#[derive(Serialize)]
pub(super) struct Faults {
    faces: Vec<usize>,
    edges: Vec<[usize; 2]>,
    vertices: Vec<usize>,
    folded_triangles: Vec<usize>,
}

impl Faults {
    /// The faults of these quads; none if they conform.
    pub(super) fn of(quads: &QuadMesh) -> Option<Self> {
        if quads.is_conforming() {
            return None;
        }
        let faults = quads.faults();
        Some(Faults {
            faces: faults.faces,
            edges: faults.edges,
            vertices: faults.vertices,
            folded_triangles: quads.folded.clone(),
        })
    }

    fn words(&self, quads: &QuadMesh) -> String {
        let edges = self.edges.iter().map(|[a, b]| format!("{a}-{b}"));
        let lists = [
            listed("faces", &text(&self.faces)),
            listed("edges", &edges.collect::<Vec<_>>()),
            listed("vertices", &text(&self.vertices)),
            listed("triangles folded by the map", &text(&self.folded_triangles)),
        ];
        let mut parts: Vec<String> = lists.into_iter().flatten().collect();
        let euler = quads.figures().euler;
        if euler != quads.expected_euler {
            let wanted = quads.expected_euler;
            parts.push(format!("Euler characteristic {euler}, not {wanted}"));
        }
        parts.join("; ")
    }
}

/// Prints on stderr, in one line, the faults of quads that do not conform.
pub fn tell_faults(file: &Path, quads: &QuadMesh) {
    if let Some(faults) = Faults::of(quads) {
        let (file, words) = (file.display(), faults.words(quads));
        // If stderr is closed, nobody reads the line.
        let _ = writeln!(
            io::stderr(),
            "roundel: {file}: the quads do not conform: {words}"
        );
    }
}

fn text(numbers: &[usize]) -> Vec<String> {
    numbers.iter().map(ToString::to_string).collect()
}

/// The first few of a list, and how many more there are.
fn listed(name: &str, elements: &[String]) -> Option<String> {
    const SHOWN: usize = 8;
    let shown = elements[..elements.len().min(SHOWN)].join(" ");
    match elements.len() {
        0 => None,
        n if n > SHOWN => Some(format!("{name} {shown} and {} more", n - SHOWN)),
        _ => Some(format!("{name} {shown}")),
    }
}

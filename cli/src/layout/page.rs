//! `--report`: the page of a layout and its quads.

use std::path::Path;

use roundel::Result;
use roundel::extract::QuadMesh;
use roundel::layout::LayoutQuads;
use roundel::layout::found::{FoundLayout, QuadSurface};
use roundel::mesh::TriangleMesh;

use crate::changes::Changes;
use crate::page::{
    Page, Rows, Scene, Tables, histogram, mesh_rows, quad_rows, seconds_rows, valences,
};
use crate::quad::words;
use crate::summary::thousands;

/// Quads that follow a layout.
pub(super) struct Followed<'a> {
    pub name: &'a Path,
    pub mesh: &'a TriangleMesh,
    pub changes: &'a Changes,
    pub found: &'a LayoutQuads,
    /// Steps, and how long they took.
    pub seconds: &'a [(&'a str, f64)],
}

impl Followed<'_> {
    /// Writes the page.
    pub fn write(&self, path: &Path) -> Result<()> {
        let found = self.found;
        let scene = Scene::new(self.mesh, None, self.changes).quads(self.mesh, &found.quads);
        let scene = match found.is_as_prescribed {
            true => {
                let arcs = found.arc_vertices.iter().map(Vec::as_slice);
                scene.layout(arcs, &found.quad_patches)
            }
            false => scene,
        };
        let mut tables = Tables::default();
        tables.add("Layout", &self.layout_rows());
        tables.add("Quads", &quad_rows(&found.quads));
        tables.add("Input", &mesh_rows(self.mesh, self.changes));
        let edges: Vec<usize> = found
            .subdivisions
            .arcs
            .iter()
            .map(|&n| n as usize)
            .collect();
        tables.add_bars("Arcs by their number of edges", &histogram(&edges));
        tables.add_bars("Seconds", &seconds_rows(self.seconds));
        tables.add_bars("Edges at a vertex", &valences(&found.quads));
        let page = Page {
            mesh: self.name,
            summary: words(&found.quads),
            tables,
            scene,
        };
        page.write(path)
    }

    fn layout_rows(&self) -> Rows {
        let LayoutQuads {
            layout,
            subdivisions,
            lengths,
            folded,
            ..
        } = self.found;
        let yes = |is: bool| if is { "yes" } else { "no" };
        let proof = match subdivisions.is_optimal {
            true => "proved",
            false => "not proved",
        };
        let mut rows = vec![
            ("patches", thousands(layout.polygons().len())),
            ("arcs", thousands(layout.arc_count())),
            ("vertices", thousands(layout.vertex_count())),
            (
                "quads are as prescribed",
                yes(self.found.is_as_prescribed).into(),
            ),
            (
                "energy of the subdivisions",
                format!("{:.6}, {proof}", subdivisions.energy),
            ),
            ("lower bound", format!("{:.6}", subdivisions.lower_bound)),
            ("folds", thousands(*folded)),
            (
                "length of all arcs",
                format!("{:.6}", lengths.iter().sum::<f64>()),
            ),
        ];
        if subdivisions.edge_length > 0.0 {
            rows.push((
                "edges are to be long",
                format!("{:.6}", subdivisions.edge_length),
            ));
        }
        rows
    }
}

/// The layout of quads that were given.
pub(super) struct Found<'a> {
    pub name: &'a Path,
    pub given: &'a QuadSurface,
    /// The quads that the layout divides: those that were given, or new ones.
    pub surface: &'a QuadSurface,
    pub layout: &'a FoundLayout,
    /// What is told of the layout.
    pub rows: Rows,
    pub seconds: &'a [(&'a str, f64)],
}

impl Found<'_> {
    /// Writes the page.
    pub fn write(&self, path: &Path) -> Result<()> {
        let quads = mesh_of(self.surface);
        let mesh = triangles_of(self.given)?;
        let none = Changes::default();
        let arcs = self.layout.arcs.iter().map(|arc| arc.vertices.as_slice());
        let mut tables = Tables::default();
        tables.add("Layout", &self.rows);
        tables.add("Quads", &quad_rows(&quads));
        let edges = self.layout.arcs.iter().map(|arc| arc.vertices.len() - 1);
        let edges: Vec<usize> = edges.collect();
        tables.add_bars("Arcs by their number of edges", &histogram(&edges));
        tables.add_bars("Seconds", &seconds_rows(self.seconds));
        tables.add_bars("Edges at a vertex", &valences(&quads));
        let scene = Scene::new(&mesh, None, &none).quads(&mesh, &quads);
        let page = Page {
            mesh: self.name,
            summary: words(&quads),
            tables,
            scene: scene.layout(arcs, &self.layout.patch_of),
        };
        page.write(path)
    }
}

fn mesh_of(surface: &QuadSurface) -> QuadMesh {
    let (vertices, quads) = (surface.positions().to_vec(), surface.quads().to_vec());
    QuadMesh::from_quads(vertices, quads, surface.euler_characteristic())
}

/// The quads, each as two triangles.
fn triangles_of(surface: &QuadSurface) -> Result<TriangleMesh> {
    let halves = surface.quads().iter();
    let halves = halves.flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Ok(TriangleMesh::new(
        surface.positions().to_vec(),
        halves.collect(),
    )?)
}

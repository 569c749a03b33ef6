//! What a page draws, as its scripts read it.

use std::f64::consts::TAU;

use roundel::extract::QuadMesh;
use roundel::field::OrientationField;
use roundel::map::SeamlessMap;
use roundel::mesh::TriangleMesh;
use roundel::mesh::vector::Vec3;
use serde::Serialize;

use super::arrays::{Array, Grid};
use super::distances::distances;
use crate::changes::{Change, Changes};

/// The mesh of a run, and what was made on it. Elements are counted from 0.
#[derive(Serialize)]
pub struct Scene {
    grid: Grid,
    positions: Array,
    /// Three for each triangle: vertices, or copies of vertices on the cut surface of the map.
    corners: Array,
    /// The vertex of each copy.
    #[serde(skip_serializing_if = "Option::is_none")]
    copies: Option<Array>,
    /// The corners of the triangles that were given, if they were refined. Refinement keeps the numbers of
    /// vertices.
    #[serde(skip_serializing_if = "Option::is_none")]
    given: Option<Array>,
    /// Pairs of vertices: edges that quads follow, and those that no quad follows.
    features: Array,
    missed: Array,
    /// Curves that guide the field.
    #[serde(skip_serializing_if = "Option::is_none")]
    guides: Option<Lines>,
    #[serde(skip_serializing_if = "Option::is_none")]
    field: Option<Field>,
    #[serde(skip_serializing_if = "Option::is_none")]
    map: Option<Map>,
    #[serde(skip_serializing_if = "Option::is_none")]
    quads: Option<Quads>,
    #[serde(skip_serializing_if = "Option::is_none")]
    layout: Option<Layout>,
    /// What repair changed on the mesh, refined if it was.
    changes: Vec<Marks>,
}

/// Polylines in space.
#[derive(Serialize)]
struct Lines {
    /// The number of sides of each.
    sides: Array,
    /// Their points, one line after the other: one more than its sides.
    positions: Array,
}

#[derive(Serialize)]
struct Field {
    symmetry: u8,
    /// Of every face, from its first edge, in 256ths of the angle between two arms.
    angles: Array,
    /// Vertices and the integer steps of their index.
    irregular: Vec<(usize, i32)>,
}

#[derive(Serialize)]
struct Map {
    #[serde(flatten)]
    grid: Grid,
    /// The coordinates of every copy.
    steps: Array,
    folded: Vec<usize>,
}

#[derive(Serialize)]
struct Quads {
    positions: Array,
    corners: Array,
    others: Vec<Vec<u32>>,
    /// The largest distance of each quad from the mesh that was given.
    distances: Array,
}

/// A layout that quads follow.
#[derive(Serialize)]
struct Layout {
    /// Of every quad.
    patches: Array,
    /// The edges of quads along every arc.
    edges: Array,
    /// The vertices of quads along all arcs, one arc after the other: one more than its edges.
    vertices: Array,
}

#[derive(Serialize)]
struct Marks {
    name: String,
    vertices: Array,
    triangles: Array,
}

impl Scene {
    /// The mesh that was given, or what it was refined to, with what repair changed on it, and nothing else yet.
    pub fn new(given: &TriangleMesh, refined: Option<&TriangleMesh>, changes: &Changes) -> Self {
        let mesh = refined.unwrap_or(given);
        let (grid, positions) = Grid::of(mesh.vertices());
        Scene {
            grid,
            positions,
            corners: Array::indices(mesh.triangles().as_flattened()),
            copies: None,
            given: refined.map(|_| Array::indices(given.triangles().as_flattened())),
            features: Array::indices(&[]),
            missed: Array::indices(&[]),
            guides: None,
            field: None,
            map: None,
            quads: None,
            layout: None,
            changes: changes.iter().map(Marks::new).collect(),
        }
    }

    /// Adds edges of the mesh that was given: those to follow, and those that no quad follows.
    pub fn features(mut self, given: &TriangleMesh, edges: &[usize], missed: &[usize]) -> Self {
        let ends = |edges: &[usize]| {
            let ends = edges.iter().flat_map(|&e| given.edge(e).vertices);
            Array::indices(&ends.map(|v| v as u32).collect::<Vec<_>>())
        };
        self.features = ends(edges);
        self.missed = ends(missed);
        self
    }

    /// Adds curves that guide the field, if there are any.
    pub fn guides(mut self, curves: &[Vec<Vec3>]) -> Self {
        let sides: Vec<u32> = curves.iter().map(|curve| curve.len() as u32 - 1).collect();
        let positions = curves.concat().into_flattened();
        self.guides = (!curves.is_empty()).then(|| Lines {
            sides: Array::indices(&sides),
            positions: Array::doubles(&positions),
        });
        self
    }

    /// Adds a field of the mesh.
    pub fn field(mut self, mesh: &TriangleMesh, field: &OrientationField) -> Self {
        let steps = field.vertex_index_steps(mesh).into_iter().enumerate();
        let step = TAU / f64::from(field.symmetry()) / 256.0;
        // Whole turns between arms fall away.
        let angle = |angle: &f64| (angle / step).round().rem_euclid(256.0) as u8;
        let angles: Vec<u8> = field.angles().iter().map(angle).collect();
        self.field = Some(Field {
            symmetry: field.symmetry(),
            angles: Array::bytes(&angles),
            irregular: steps.filter(|&(_, steps)| steps != 0).collect(),
        });
        self
    }

    /// Adds a map of the mesh.
    pub fn map(mut self, mesh: &TriangleMesh, map: &SeamlessMap) -> Self {
        let mut vertices = vec![0; map.vertex_uvs().len()];
        for (copies, corners) in map.copies().iter().zip(mesh.triangles()) {
            for (&copy, &vertex) in copies.iter().zip(corners) {
                vertices[copy as usize] = vertex;
            }
        }
        let (grid, steps) = Grid::of(map.vertex_uvs());
        self.corners = Array::indices(map.copies().as_flattened());
        self.copies = Some(Array::indices(&vertices));
        self.map = Some(Map {
            grid,
            steps,
            folded: map.flipped().to_vec(),
        });
        self
    }

    /// Adds the quads of the mesh that was given. Their coordinates are those of their file.
    pub fn quads(mut self, given: &TriangleMesh, quads: &QuadMesh) -> Self {
        self.quads = Some(Quads {
            positions: Array::doubles(quads.vertices.as_flattened()),
            corners: Array::indices(quads.quads.as_flattened()),
            others: quads.others.clone(),
            distances: Array::floats(&distances(quads, given)),
        });
        self
    }

    /// Adds the layout of these quads: the vertices along every arc, and the patch of every quad.
    pub fn layout<'a>(mut self, arcs: impl Iterator<Item = &'a [u32]>, patches: &[u32]) -> Self {
        let (mut edges, mut vertices) = (Vec::new(), Vec::new());
        for arc in arcs {
            edges.push(arc.len() as u32 - 1);
            vertices.extend(arc);
        }
        self.layout = Some(Layout {
            patches: Array::indices(patches),
            edges: Array::indices(&edges),
            vertices: Array::indices(&vertices),
        });
        self
    }
}

impl Marks {
    fn new(change: &Change) -> Self {
        Marks {
            name: change.words.clone(),
            vertices: Array::indices(&change.vertices),
            triangles: Array::indices(&change.triangles),
        }
    }
}

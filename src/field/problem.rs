//! The smoothest N-symmetric direction field of a mesh as a mixed-integer problem.
//!
//! `bommes2009`, section 4, and `bommes2012`, section 8.2, for crosses, N = 4; `ray2008` for any N.
//! With one angle for each face and one period jump for each interior edge,
//!
//! ```text
//! E = sum over interior edges (i, j) of (theta_i + kappa_ij + 2 pi/N p_ij - theta_j)^2
//!   + sum over guided faces of w_i (theta_i - phi_i)^2
//! ```
//!
//! without the edges between two constrained faces. Jumps are zero on a spanning forest, which grows
//! from the constrained and guided faces: their frames cannot be turned to move a jump away.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::detail::detail;
use super::prescribed_indices::{ring_sum, steps};
use super::spanning_forest::spanning_forest;
use super::{Constraint, FieldOptions, Guide, OrientationField};
use crate::error::{Error, Result};
use crate::linalg::sparse::reserve;
use crate::mesh::TriangleMesh;

use crate::monitor::{both, in_parts, may_continue, may_continue_at, span};
use crate::problem::{Layout, MatrixRef, Problem};
use crate::solve::Solution;

/// The least number of faces, edges or vertices that are worth a thread.
const LEAST: usize = 1 << 12;

/// What is known of one interior edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Jump {
    /// The edge has no other face.
    Boundary,
    /// In the problem as this unknown.
    Unknown(u32),
    /// Zero on the forest; between constrained faces the nearest jump.
    Known(i32),
}

/// The mixed-integer problem of an orientation field, and how to read its solution.
///
/// Unknowns: the angle of face `f` is unknown `f`; period jumps follow in the order of the mesh's
/// edges. Least-squares rows follow the order of the edges as well, then that of guided faces.
#[derive(Debug, Clone)]
pub struct FieldProblem {
    pub(super) problem: Problem,
    symmetry: u8,
    jumps: Vec<Jump>,
    kappa: Arc<Vec<f64>>,
}

impl FieldProblem {
    /// The problem of a cross field for a mesh with some directions given.
    ///
    /// # Errors
    /// Those of [`with_options`](Self::with_options).
    pub fn new(mesh: &TriangleMesh, constraints: &[Constraint]) -> Result<Self> {
        let options = FieldOptions {
            constraints: constraints.to_vec(),
            ..FieldOptions::default()
        };
        Self::with_options(mesh, &options)
    }

    /// The problem for a mesh and the options of the field.
    ///
    /// # Errors
    /// With the position in the list at fault, [`Error::IndexOutOfRange`] for what does not exist,
    /// [`Error::NotFinite`], [`Error::InvalidArgument`] for a face or vertex that is named twice, a
    /// negative weight or an index at the boundary. [`Error::InvalidArgument`] for another symmetry
    /// than 1, 2, 4 and 6, for indices that do not sum to the Euler characteristic, and, with the
    /// vertex, where constrained faces alone decide an index and it is another, or for a negative
    /// length of details.
    pub fn with_options(mesh: &TriangleMesh, options: &FieldOptions) -> Result<Self> {
        let _span = span("assemble field");
        let _memory = mesh.watch_memory();
        may_continue()?;
        let step = options.step()?;
        let fixed = options.fixed_angles(mesh)?;
        let guided = options.guided(mesh, &fixed)?;
        let is_named = (0..mesh.face_count()).map(|f| fixed[f].is_some() || guided[f].is_some());
        may_continue()?;
        let is_named = is_named.collect::<Vec<_>>();
        let faces = mesh.face_count();
        let (in_forest, kappa) = both(
            faces >= LEAST,
            || spanning_forest(mesh, &is_named),
            || mesh.transports(),
        );
        let jumps = jumps(mesh, step, &fixed, &in_forest?, &kappa)?;
        let ignored = detail(mesh, options)?;
        let unknown = |j: &&Jump| matches!(j, Jump::Unknown(_));
        let mut this = FieldProblem {
            problem: Problem::new(faces + jumps.iter().filter(unknown).count())?,
            symmetry: options.symmetry,
            jumps,
            kappa: Arc::new(kappa),
        };
        for c in &options.constraints {
            this.problem.pin(c.face, c.angle)?;
        }
        let row_of_edge = this.add_edges(mesh, step, &fixed, &ignored)?;
        for Guide {
            face,
            angle,
            weight,
        } in guided.into_iter().flatten()
        {
            may_continue_at(face)?;
            this.problem
                .add_least_squares(&[face], &[1.0], angle, weight)?;
        }
        if let Some(given) = &options.indices {
            this.prescribe(mesh, &steps(mesh, options.symmetry, given)?)?;
        }
        may_continue()?;
        hint_rings(mesh, &row_of_edge, &mut this.problem)?;
        Ok(this)
    }

    /// Adds one row of the energy for each edge, whose transport turns by `ignored` in addition.
    /// Returns the row of every edge that has one.
    fn add_edges(
        &mut self,
        mesh: &TriangleMesh,
        step: f64,
        fixed: &[Option<f64>],
        ignored: &[f64],
    ) -> Result<Vec<Option<usize>>> {
        let mut row_of_edge = vec![None; mesh.edge_count()];
        let edges = mesh.edge_count();
        let (mut offsets, mut rhs) = (reserve(edges + 1)?, reserve(edges)?);
        let (mut indices, mut values) = (reserve(3 * edges)?, reserve(3 * edges)?);
        let mut integers = Vec::new();
        offsets.push(0);
        for (e, edge) in mesh.edges().enumerate() {
            may_continue_at(e)?;
            let Some((j, _)) = edge.second else { continue };
            let i = edge.first.0;
            if fixed[i].is_some() && fixed[j].is_some() {
                continue;
            }
            row_of_edge[e] = Some(rhs.len());
            indices.extend([i, j]);
            values.extend([1.0, -1.0]);
            if let Jump::Unknown(p) = self.jumps[e] {
                indices.push(p as usize);
                values.push(step);
                integers.push(p as usize);
            }
            offsets.push(indices.len());
            rhs.push(-(self.kappa[e] + ignored[e]));
        }
        let rows = MatrixRef {
            layout: Layout::Rows,
            offsets: &offsets,
            indices: &indices,
            values: &values,
        };
        self.problem.set_integers(&integers)?;
        self.problem.add_least_squares_matrix(&rows, &rhs, None)?;
        Ok(row_of_edge)
    }

    /// Constrains the jumps around every interior vertex to its index.
    fn prescribe(&mut self, mesh: &TriangleMesh, steps: &[i32]) -> Result<()> {
        let (mut unknowns, mut signs) = (Vec::new(), Vec::new());
        for v in (0..mesh.vertex_count()).filter(|&v| !mesh.is_boundary_vertex(v)) {
            may_continue_at(v)?;
            let mut sum = self.ring_sum(mesh, v, steps[v]);
            unknowns.clear();
            signs.clear();
            for (face, corner) in mesh.ring(v) {
                let k = (corner + 2) % 3;
                match self.jump(mesh, face, k) {
                    (Jump::Boundary, _) => {}
                    (Jump::Known(p), sign) => sum -= sign * f64::from(p),
                    (Jump::Unknown(p), sign) => {
                        unknowns.push(p as usize);
                        signs.push(sign);
                    }
                }
            }
            if !unknowns.is_empty() {
                self.problem.add_constraint(&unknowns, &signs, sum)?;
            } else if sum != 0.0 {
                return Err(Error::InvalidArgument {
                    what: format!(
                        "the directions given around vertex {v} fix another index than the one prescribed"
                    ),
                    index: Some(v),
                });
            }
        }
        Ok(())
    }

    /// The jump over a side of a face, and the sign of its edge's direction out of the face.
    pub(super) fn jump(&self, mesh: &TriangleMesh, face: usize, k: usize) -> (Jump, f64) {
        let e = mesh.edge_of(face, k);
        (self.jumps[e], mesh.out_of(face, k, 1.0))
    }

    /// What the jumps around an interior vertex sum to, counter-clockwise, for an index of `steps`.
    pub(super) fn ring_sum(&self, mesh: &TriangleMesh, vertex: usize, steps: i32) -> f64 {
        let step = TAU / f64::from(self.symmetry);
        ring_sum(mesh, &self.kappa, step, vertex, steps)
    }

    /// The problem, to be solved by any strategy.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The right sides of the least-squares rows of the same field where the transport over each edge turns by
    /// `ignored` in addition.
    pub(super) fn right_sides(&self, mesh: &TriangleMesh, ignored: &[f64]) -> Vec<f64> {
        let mut rhs = self.problem.least_squares().0.rhs().to_vec();
        let is_fixed = |face: usize| self.problem.pins()[face].is_some();
        let inner = mesh.edges().enumerate().filter(|(_, edge)| {
            let second = edge.second.map(|(face, _)| face);
            second.is_some_and(|second| !(is_fixed(edge.first.0) && is_fixed(second)))
        });
        for (row, (e, _)) in rhs.iter_mut().zip(inner) {
            *row = -(self.kappa[e] + ignored[e]);
        }
        rhs
    }

    /// The field that belongs to a solution of the problem.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for the solution of another problem, [`Error::Overflow`] for
    /// period jumps beyond 2^31.
    pub fn field(&self, mesh: &TriangleMesh, solution: &Solution) -> Result<OrientationField> {
        let values = solution.values();
        if values.len() != self.problem.variables() || self.jumps.len() != mesh.edge_count() {
            return Err(Error::LengthMismatch {
                what: "the solution of the field",
                expected: self.problem.variables(),
                actual: values.len(),
            });
        }
        let mut period_jumps = Vec::with_capacity(self.jumps.len());
        for (e, jump) in self.jumps.iter().enumerate() {
            period_jumps.push(match *jump {
                Jump::Boundary => 0,
                Jump::Known(p) => p,
                Jump::Unknown(k) => {
                    let value = values[k as usize];
                    if value.abs() > f64::from(i32::MAX) {
                        return Err(Error::Overflow {
                            what: format!("the period jump of edge {e} is beyond 2^31"),
                            index: Some(e),
                        });
                    }
                    value as i32
                }
            });
        }
        let angles = values[..mesh.face_count()].to_vec();
        let pins = self.problem.pins();
        let constrained = (0..mesh.face_count()).map(|f| pins[f].is_some());
        Ok(OrientationField {
            symmetry: self.symmetry,
            angles,
            period_jumps,
            kappa: Arc::clone(&self.kappa),
            constrained: constrained.collect(),
        })
    }
}

/// The jump and kappa of every edge, from its first to its second face.
fn jumps(
    mesh: &TriangleMesh,
    step: f64,
    fixed: &[Option<f64>],
    in_forest: &[bool],
    kappa: &[f64],
) -> Result<Vec<Jump>> {
    // A mesh has fewer than 2^32 half-edges, and so fewer faces and edges together.
    let mut unknowns = mesh.face_count() as u32..;
    let jumps = mesh.edges().enumerate().map(|(e, edge)| {
        may_continue_at(e)?;
        let i = edge.first.0;
        let Some((j, _)) = edge.second else {
            return Ok(Jump::Boundary);
        };
        Ok(match (fixed[i], fixed[j]) {
            (Some(a), Some(b)) => Jump::Known(((b - a - kappa[e]) / step).round() as i32),
            _ if in_forest[e] => Jump::Known(0),
            _ => unknowns.next().map_or(Jump::Known(0), Jump::Unknown),
        })
    });
    jumps.collect()
}

/// Gives the rings of interior vertices to the solver as short cycles. They are a basis but for one
/// ring of each closed component and the cycles around handles, boundaries and constrained regions.
fn hint_rings(
    mesh: &TriangleMesh,
    row_of_edge: &[Option<usize>],
    problem: &mut Problem,
) -> Result<()> {
    let parts = in_parts(mesh.vertex_count(), LEAST, |part| {
        let (mut lengths, mut rows, mut signs) = (Vec::new(), Vec::new(), Vec::new());
        for v in part.filter(|&v| !mesh.is_boundary_vertex(v)) {
            let start = rows.len();
            for (face, corner) in mesh.ring(v) {
                let k = (corner + 2) % 3;
                let e = mesh.edge_of(face, k);
                if let Some(row) = row_of_edge[e] {
                    rows.push(row);
                    signs.push(mesh.out_of(face, k, 1));
                }
            }
            if rows.len() - start == mesh.face_degree(v) {
                lengths.push(rows.len() - start);
            } else {
                // A ring through constrained faces is no cycle of the problem's rows.
                rows.truncate(start);
                signs.truncate(start);
            }
        }
        (lengths, rows, signs)
    });
    let (mut offsets, mut rows, mut signs) = (vec![0], Vec::new(), Vec::new());
    let mut end = 0;
    for (lengths, some_rows, some_signs) in parts {
        offsets.extend(lengths.iter().map(|length| {
            end += length;
            end
        }));
        rows.extend(some_rows);
        signs.extend(some_signs);
    }
    problem.hint_cycles(&offsets, &rows, &signs)
}

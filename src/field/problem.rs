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

use super::detail::detail;
use super::prescribed_indices::{ring_sum, steps};
use super::spanning_forest::spanning_forest;
use super::{Constraint, FieldOptions, Guide, OrientationField};
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::problem::Problem;
use crate::solve::Solution;

/// What is known of one interior edge.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Jump {
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
    problem: Problem,
    symmetry: u8,
    jumps: Vec<Jump>,
    kappa: Vec<f64>,
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
        let step = options.step()?;
        let fixed = options.fixed_angles(mesh)?;
        let guided = options.guided(mesh, &fixed)?;
        let is_named = (0..mesh.face_count()).map(|f| fixed[f].is_some() || guided[f].is_some());
        let in_forest = spanning_forest(mesh, &is_named.collect::<Vec<_>>());
        let (jumps, kappa) = jumps(mesh, step, &fixed, &in_forest);
        let unknown = |j: &&Jump| matches!(j, Jump::Unknown(_));
        let faces = mesh.face_count();
        let mut this = FieldProblem {
            problem: Problem::new(faces + jumps.iter().filter(unknown).count())?,
            symmetry: options.symmetry,
            jumps,
            kappa,
        };
        for c in &options.constraints {
            this.problem.pin(c.face, c.angle)?;
        }
        let ignored = detail(mesh, options)?;
        let row_of_edge = this.add_edges(mesh, step, &fixed, &ignored)?;
        for Guide {
            face,
            angle,
            weight,
        } in guided.into_iter().flatten()
        {
            this.problem
                .add_least_squares(&[face], &[1.0], angle, weight)?;
        }
        if let Some(given) = &options.indices {
            this.prescribe(mesh, step, &steps(mesh, options.symmetry, given)?)?;
        }
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
        for (e, edge) in mesh.edges().enumerate() {
            let Some((j, _)) = edge.second else { continue };
            let i = edge.first.0;
            if fixed[i].is_some() && fixed[j].is_some() {
                continue;
            }
            let kappa = -(self.kappa[e] + ignored[e]);
            let problem = &mut self.problem;
            row_of_edge[e] = Some(match self.jumps[e] {
                Jump::Unknown(p) => {
                    let p = p as usize;
                    problem.set_integers(&[p])?;
                    problem.add_least_squares(&[i, j, p], &[1.0, -1.0, step], kappa, 1.0)?
                }
                _ => problem.add_least_squares(&[i, j], &[1.0, -1.0], kappa, 1.0)?,
            });
        }
        Ok(row_of_edge)
    }

    /// Constrains the jumps around every interior vertex to its index.
    fn prescribe(&mut self, mesh: &TriangleMesh, step: f64, steps: &[i32]) -> Result<()> {
        let (mut unknowns, mut signs) = (Vec::new(), Vec::new());
        for v in (0..mesh.vertex_count()).filter(|&v| !mesh.is_boundary_vertex(v)) {
            let mut sum = ring_sum(mesh, &self.kappa, step, v, steps[v]);
            unknowns.clear();
            signs.clear();
            for (face, corner) in mesh.ring(v) {
                let k = (corner + 2) % 3;
                let e = mesh.edge_of(face, k);
                let sign = mesh.out_of(face, k, 1.0);
                match self.jumps[e] {
                    Jump::Boundary => {}
                    Jump::Known(p) => sum -= sign * f64::from(p),
                    Jump::Unknown(p) => {
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

    /// The problem, to be solved by any strategy.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The right sides of the least-squares rows of the same field with all details.
    pub(super) fn right_sides_with_details(&self, mesh: &TriangleMesh) -> Vec<f64> {
        let mut rhs = self.problem.least_squares().0.rhs().to_vec();
        let is_fixed = |face: usize| self.problem.pins()[face].is_some();
        let inner = mesh.edges().enumerate().filter(|(_, edge)| {
            let second = edge.second.map(|(face, _)| face);
            second.is_some_and(|second| !(is_fixed(edge.first.0) && is_fixed(second)))
        });
        for (row, (e, _)) in rhs.iter_mut().zip(inner) {
            *row = -self.kappa[e];
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
            kappa: self.kappa.clone(),
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
) -> (Vec<Jump>, Vec<f64>) {
    // A mesh has fewer than 2^32 half-edges, and so fewer faces and edges together.
    let mut unknowns = mesh.face_count() as u32..;
    let mut kappa = Vec::with_capacity(mesh.edge_count());
    let jumps = mesh.edges().enumerate().map(|(e, edge)| {
        let (i, k) = edge.first;
        kappa.push(mesh.transport(i, k).unwrap_or(0.0));
        let Some((j, _)) = edge.second else {
            return Jump::Boundary;
        };
        match (fixed[i], fixed[j]) {
            (Some(a), Some(b)) => Jump::Known(((b - a - kappa[e]) / step).round() as i32),
            _ if in_forest[e] => Jump::Known(0),
            _ => unknowns.next().map_or(Jump::Known(0), Jump::Unknown),
        }
    });
    (jumps.collect(), kappa)
}

/// Gives the rings of interior vertices to the solver as short cycles. They are a basis but for one
/// ring of each closed component and the cycles around handles, boundaries and constrained regions.
fn hint_rings(
    mesh: &TriangleMesh,
    row_of_edge: &[Option<usize>],
    problem: &mut Problem,
) -> Result<()> {
    let (mut offsets, mut rows, mut signs) = (vec![0], Vec::new(), Vec::new());
    for v in (0..mesh.vertex_count()).filter(|&v| !mesh.is_boundary_vertex(v)) {
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
            offsets.push(rows.len());
        } else {
            // A ring through constrained faces is no cycle of the problem's rows.
            rows.truncate(start);
            signs.truncate(start);
        }
    }
    problem.hint_cycles(&offsets, &rows, &signs)
}

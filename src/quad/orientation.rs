//! The smoothest 4-symmetric direction field of a mesh as a mixed-integer problem.
//!
//! Bommes, Zimmer, Kobbelt 2009, section 4: one angle a face, one period jump an interior edge,
//!
//! ```text
//! E = sum over interior edges (i, j) of (theta_i + kappa_ij + pi/2 p_ij - theta_j)^2
//! ```
//!
//! without the edges between two constrained faces. Jumps are zero on a spanning forest.

use std::f64::consts::FRAC_PI_2;

use super::OrientationField;
use super::forest::spanning_forest;
use crate::mesh::TriangleMesh;
use crate::{Error, Problem, Result, Solution};

/// A face whose direction is given: one arm of its cross, as an angle in radians in the face's
/// frame (counter-clockwise about the normal from the first edge).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constraint {
    /// The face.
    pub face: usize,
    /// The angle of one arm.
    pub angle: f64,
}

/// What is known of one interior edge.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Jump {
    /// The edge has no other face.
    Boundary,
    /// In the problem as this unknown.
    Unknown(u32),
    /// Zero, on the forest; or, between constrained faces, whatever is nearest.
    Known(i32),
}

/// The mixed-integer problem of an orientation field, and how to read its solution.
///
/// Unknowns: the angle of face `f` is unknown `f`; period jumps follow in the order of the mesh's
/// edges. Least-squares rows follow the order of the edges as well.
#[derive(Debug, Clone)]
pub struct FieldProblem {
    problem: Problem,
    jumps: Vec<Jump>,
    kappa: Vec<f64>,
}

impl FieldProblem {
    /// The problem for a mesh with some directions given.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`] for a face that does not exist, [`Error::NotFinite`],
    /// [`Error::InvalidArgument`] for a face that is constrained twice; positions are positions in
    /// `constraints`.
    pub fn new(mesh: &TriangleMesh, constraints: &[Constraint]) -> Result<Self> {
        let fixed = fixed_angles(mesh, constraints)?;
        let constrained: Vec<bool> = fixed.iter().map(Option::is_some).collect();
        let in_forest = spanning_forest(mesh, &constrained);
        let (jumps, kappa) = jumps(mesh, &fixed, &in_forest);
        let unknown = |j: &&Jump| matches!(j, Jump::Unknown(_));
        let faces = mesh.face_count();
        let mut problem = Problem::new(faces + jumps.iter().filter(unknown).count())?;
        for c in constraints {
            problem.pin(c.face, c.angle)?;
        }
        let mut row_of_edge = vec![None; mesh.edge_count()];
        for (e, edge) in mesh.edges().enumerate() {
            let Some((j, _)) = edge.second else { continue };
            let i = edge.first.0;
            if constrained[i] && constrained[j] {
                continue;
            }
            row_of_edge[e] = Some(match jumps[e] {
                Jump::Unknown(p) => {
                    let p = p as usize;
                    problem.set_integers(&[p])?;
                    problem.add_least_squares(
                        &[i, j, p],
                        &[1.0, -1.0, FRAC_PI_2],
                        -kappa[e],
                        1.0,
                    )?
                }
                _ => problem.add_least_squares(&[i, j], &[1.0, -1.0], -kappa[e], 1.0)?,
            });
        }
        hint_rings(mesh, &row_of_edge, &mut problem)?;
        Ok(FieldProblem {
            problem,
            jumps,
            kappa,
        })
    }

    /// The problem, to be solved by any strategy.
    pub fn problem(&self) -> &Problem {
        &self.problem
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
            angles,
            period_jumps,
            kappa: self.kappa.clone(),
            constrained: constrained.collect(),
        })
    }
}

fn fixed_angles(mesh: &TriangleMesh, constraints: &[Constraint]) -> Result<Vec<Option<f64>>> {
    let mut fixed = vec![None; mesh.face_count()];
    for (position, c) in constraints.iter().enumerate() {
        if c.face >= fixed.len() {
            return Err(Error::IndexOutOfRange {
                what: "constrained faces",
                position,
                value: i64::try_from(c.face).unwrap_or(i64::MAX),
                len: fixed.len(),
            });
        }
        if !c.angle.is_finite() {
            return Err(Error::NotFinite {
                what: "constrained angles",
                position,
            });
        }
        if fixed[c.face].replace(c.angle).is_some() {
            return Err(Error::InvalidArgument {
                what: format!("face {} is constrained twice", c.face),
                index: Some(position),
            });
        }
    }
    Ok(fixed)
}

/// The jump and kappa of every edge, from its first to its second face.
fn jumps(mesh: &TriangleMesh, fixed: &[Option<f64>], in_forest: &[bool]) -> (Vec<Jump>, Vec<f64>) {
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
            (Some(a), Some(b)) => Jump::Known(((b - a - kappa[e]) / FRAC_PI_2).round() as i32),
            _ if in_forest[e] => Jump::Known(0),
            _ => unknowns.next().map_or(Jump::Known(0), Jump::Unknown),
        }
    });
    (jumps.collect(), kappa)
}

/// Hands the rings of interior vertices to the solver: a basis of short cycles, up to one ring a
/// closed component and the cycles around handles, boundaries and constrained regions.
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
                signs.push(if mesh.edge(e).first == (face, k) {
                    1
                } else {
                    -1
                });
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

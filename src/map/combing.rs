//! Combing: one arm of every cross is chosen such that the arms match over all edges off the cut.
//!
//! `kalberer2007`, section 3, and `bommes2009`, section 5: once the surface is cut open to a disk
//! without cones, the period jumps can be removed by turning one face after the other. The rest of
//! them, quarter turns, lies on the cut.

use std::collections::VecDeque;
use std::f64::consts::FRAC_PI_2;

use super::CutGraph;
use crate::error::Result;
use crate::field::OrientationField;
use crate::mesh::TriangleMesh;
use crate::mesh::vector::{Vec3, add, cross, scale};

/// The quarter turns that comb a field over a cut surface.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Combing {
    pub(super) quarters: Vec<u8>,
    pub(super) transitions: Vec<u8>,
}

impl Combing {
    /// Combs a field: breadth-first from the lowest face of every component, not across the cut.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`](crate::Error::LengthMismatch) for the field of another mesh.
    pub fn new(mesh: &TriangleMesh, field: &OrientationField, cut: &CutGraph) -> Result<Self> {
        field.check_mesh(mesh)?;
        let quarters = comb(mesh, field, cut);
        let transitions = mesh.edges().enumerate().map(|(e, edge)| {
            let Some((j, _)) = edge.second else { return 0 };
            let [from, to] = [edge.first.0, j].map(|f| i64::from(quarters[f]));
            (from - i64::from(field.period_jumps()[e]) - to).rem_euclid(4) as u8
        });
        Ok(Combing {
            transitions: transitions.collect(),
            quarters,
        })
    }

    /// One number for each face, 0 to 3: the quarter turns, counter-clockwise, from the arm that
    /// the field stores to the one chosen.
    pub fn quarters(&self) -> &[u8] {
        &self.quarters
    }

    /// One number for each edge, 0 to 3: the quarter turns, counter-clockwise, that take coordinates
    /// along the arms of its first face to those along the arms of its second. Zero off the cut.
    pub fn transitions(&self) -> &[u8] {
        &self.transitions
    }

    /// The transition over local edge `k` of a face, out of that face.
    pub fn transition_from(&self, mesh: &TriangleMesh, face: usize, k: usize) -> u8 {
        let forth = i32::from(self.transitions[mesh.edge_of(face, k)]);
        mesh.out_of(face, k, forth).rem_euclid(4) as u8
    }

    /// The combed cross of a face: the chosen arm X, and Y a quarter turn counter-clockwise about
    /// the normal from it. Unit vectors in space.
    #[inline]
    pub fn arms(&self, mesh: &TriangleMesh, field: &OrientationField, face: usize) -> [Vec3; 2] {
        let [x, y] = mesh.frame(face);
        let angle = field.angles()[face] + FRAC_PI_2 * f64::from(self.quarters[face]);
        let arm = add(scale(x, angle.cos()), scale(y, angle.sin()));
        [arm, cross(mesh.normal(face), arm)]
    }
}

/// Over an edge from face i, `q_j = q_i - p` makes the jump vanish.
fn comb(mesh: &TriangleMesh, field: &OrientationField, cut: &CutGraph) -> Vec<u8> {
    const UNREACHED: u8 = u8::MAX;
    let mut quarters = vec![UNREACHED; mesh.face_count()];
    let mut queue = VecDeque::new();
    for root in 0..mesh.face_count() {
        if quarters[root] != UNREACHED {
            continue;
        }
        quarters[root] = 0;
        queue.push_back(root);
        while let Some(face) = queue.pop_front() {
            for k in 0..3 {
                let e = mesh.edge_of(face, k);
                let Some((across, _)) = mesh.neighbor(face, k) else {
                    continue;
                };
                if cut.contains(e) || quarters[across] != UNREACHED {
                    continue;
                }
                let jump = i64::from(field.period_jumps()[e]);
                let turned = i64::from(quarters[face]) - mesh.out_of(face, k, jump);
                quarters[across] = turned.rem_euclid(4) as u8;
                queue.push_back(across);
            }
        }
    }
    quarters
}

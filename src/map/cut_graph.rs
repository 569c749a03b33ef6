//! The cut graph: edges along which a surface is opened so that one chart covers it.
//!
//! `bommes2009`, section 5 ("computing the cut graph"). A spanning tree of the dual graph glues the
//! triangles of each component to one disk. The other edges, pruned of their loose ends, are a cut
//! graph of the topology alone (`erickson2004`, section 3). Shortest paths then join it to every
//! cone, so that the rest of the surface is simply connected and has no cone in its interior.

use std::collections::VecDeque;

use super::cone_paths::{Sweep, join_cones};
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::monitor::{both, may_continue, may_continue_at};

/// The least number of faces that are worth a thread.
const LEAST: usize = 1 << 14;

/// A set of interior edges that cuts each component into one disk without a cone in its interior.
///
/// Boundary edges bound the disk as well, but are not in the set. A closed sphere with fewer than two
/// cones is opened along one edge.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CutGraph {
    pub(super) is_cut: Vec<bool>,
}

impl CutGraph {
    /// The cut graph of a mesh through these vertices.
    ///
    /// # Errors
    /// [`Error::IndexOutOfRange`] for a vertex that does not exist.
    pub fn new(mesh: &TriangleMesh, cones: &[usize]) -> Result<Self> {
        let vertices = mesh.vertex_count();
        if let Some(position) = cones.iter().position(|&v| v >= vertices) {
            return Err(Error::IndexOutOfRange {
                what: "cones",
                position,
                value: i64::try_from(cones[position]).unwrap_or(i64::MAX),
                len: vertices,
            });
        }
        let (is_cut, sweep) = both(
            mesh.face_count() >= LEAST,
            || -> Result<_> {
                let mut is_cut = edges_off_the_dual_tree(mesh)?;
                may_continue()?;
                prune(mesh, &mut is_cut)?;
                may_continue()?;
                Ok(is_cut)
            },
            || Sweep::new(mesh, cones),
        );
        let mut is_cut = is_cut?;
        join_cones(sweep, cones, &mut is_cut)?;
        Ok(CutGraph { is_cut })
    }

    /// Whether an edge of the mesh is cut.
    pub fn contains(&self, edge: usize) -> bool {
        self.is_cut[edge]
    }

    /// The cut edges, in increasing order.
    pub fn edges(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.is_cut.len()).filter(|&e| self.is_cut[e])
    }

    /// How many cut edges end at every vertex.
    pub fn degrees(&self, mesh: &TriangleMesh) -> Vec<u32> {
        degrees(mesh, &self.is_cut)
    }
}

/// Interior edges that a breadth-first tree of the dual graph does not cross.
fn edges_off_the_dual_tree(mesh: &TriangleMesh) -> Result<Vec<bool>> {
    let mut off: Vec<bool> = mesh.edges().map(|e| e.second.is_some()).collect();
    let mut reached = vec![false; mesh.face_count()];
    let mut queue = VecDeque::new();
    for root in 0..mesh.face_count() {
        if reached[root] {
            continue;
        }
        reached[root] = true;
        queue.push_back(root);
        while let Some(face) = queue.pop_front() {
            may_continue_at(face)?;
            for k in 0..3 {
                let Some((across, _)) = mesh.neighbor(face, k) else {
                    continue;
                };
                if !reached[across] {
                    reached[across] = true;
                    off[mesh.edge_of(face, k)] = false;
                    queue.push_back(across);
                }
            }
        }
    }
    Ok(off)
}

/// Removes edges with a loose end until there is none. An end on the boundary is not loose.
fn prune(mesh: &TriangleMesh, is_cut: &mut [bool]) -> Result<()> {
    let mut degree = degrees(mesh, is_cut);
    let is_loose = |v: usize, degree: u32| degree == 1 && !mesh.is_boundary_vertex(v);
    let mut loose: Vec<usize> = (0..degree.len())
        .filter(|&v| is_loose(v, degree[v]))
        .collect();
    while let Some(v) = loose.pop() {
        may_continue_at(v)?;
        let mut spokes = mesh.ring(v);
        let Some((face, k)) = spokes.find(|&(f, k)| is_cut[mesh.edge_of(f, k)]) else {
            continue;
        };
        is_cut[mesh.edge_of(face, k)] = false;
        let tip = mesh.corners(face)[(k + 1) % 3];
        for end in [v, tip] {
            degree[end] -= 1;
        }
        if is_loose(tip, degree[tip]) {
            loose.push(tip);
        }
    }
    Ok(())
}

fn degrees(mesh: &TriangleMesh, is_cut: &[bool]) -> Vec<u32> {
    let mut degree = vec![0; mesh.vertex_count()];
    for (edge, _) in mesh.edges().zip(is_cut).filter(|&(_, &cut)| cut) {
        for v in edge.vertices {
            degree[v] += 1;
        }
    }
    degree
}

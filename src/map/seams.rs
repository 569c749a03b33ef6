//! Seams: the cut graph taken apart into chains with one transition each.
//!
//! Around a regular vertex the transitions compose to the identity. If exactly two cut edges meet
//! there, they therefore have the same transition, the translation included. A seam ends where that
//! does not hold: at cones, at the boundary, and where other than two cut edges meet.

use super::CutGraph;
use crate::mesh::TriangleMesh;

/// A chain of cut edges, tip to tail: (face, local edge) on its left side.
pub(super) type Seam = Vec<(usize, usize)>;

/// All seams, in increasing order of the lower end, counter-clockwise around it.
pub(super) fn seams(mesh: &TriangleMesh, cut: &CutGraph, cones: &[usize]) -> Vec<Seam> {
    let degree = cut.degrees(mesh);
    let ends = |v: usize| degree[v] > 0 && (degree[v] != 2 || mesh.is_boundary_vertex(v));
    let mut is_end: Vec<bool> = (0..mesh.vertex_count()).map(ends).collect();
    cones.iter().for_each(|&v| is_end[v] = true);
    let mut is_done = vec![false; mesh.edge_count()];
    let mut seams = Vec::new();
    for v in (0..mesh.vertex_count()).filter(|&v| is_end[v]) {
        for side in mesh.ring(v) {
            let e = mesh.edge_of(side.0, side.1);
            if cut.contains(e) && !is_done[e] {
                let seam = follow(mesh, cut, &is_end, side);
                for &(face, k) in &seam {
                    is_done[mesh.edge_of(face, k)] = true;
                }
                seams.push(seam);
            }
        }
    }
    seams
}

fn follow(mesh: &TriangleMesh, cut: &CutGraph, is_end: &[bool], start: (usize, usize)) -> Seam {
    let mut seam = vec![start];
    let mut side = start;
    loop {
        let tip = mesh.corners(side.0)[(side.1 + 1) % 3];
        let last = mesh.edge_of(side.0, side.1);
        let goes_on = |&(f, k): &(usize, usize)| {
            let e = mesh.edge_of(f, k);
            cut.contains(e) && e != last
        };
        match mesh.ring(tip).find(goes_on) {
            Some(next) if !is_end[tip] => {
                seam.push(next);
                side = next;
            }
            _ => return seam,
        }
    }
}

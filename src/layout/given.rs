//! Arcs whose course is given, cut into the mesh as chains of edges.

use super::base_layout::BaseLayout;
use super::drawn_layout::inner;
use super::embed::{Given, feet};
use crate::error::{Error, Result};
use crate::geodesic::{cut_along, draw_curve};
use crate::mesh::TriangleMesh;
use crate::mesh::refine::CutAlong;
use crate::mesh::vector::Vec3;
use crate::monitor::Monitor;

/// The mesh with the given courses cut into it.
pub(super) struct GivenCurves {
    cut: Option<CutAlong>,
    /// The chain of vertices of each arc that is given.
    pub chains: Given,
    /// The vertex of each vertex of the layout that one of them ends at.
    pub nodes: Vec<Option<u32>>,
}

impl GivenCurves {
    /// # Errors
    /// With the arc, those of drawing and cutting, and [`Error::InvalidArgument`] for curves that end at a vertex in
    /// different places.
    pub fn new(
        mesh: &TriangleMesh,
        layout: &BaseLayout,
        curves: &[(usize, Vec<Vec3>)],
        monitor: &Monitor<'_>,
    ) -> Result<Self> {
        let mut given = GivenCurves {
            cut: None,
            chains: Vec::new(),
            nodes: vec![None; layout.vertex_count()],
        };
        if curves.is_empty() {
            return Ok(given);
        }
        let feet = feet(mesh, layout);
        let mut drawn = Vec::with_capacity(curves.len());
        for (arc, points) in curves {
            let [from, to] = layout.arcs()[*arc].map(|v| feet[v as usize]);
            let all = [&[from], inner(points), &[to]].concat();
            drawn.push(draw_curve(mesh, &all, monitor).map_err(|error| of_arc(error, *arc))?);
        }
        let cut = cut_along(mesh, &drawn).map_err(|error| match error {
            Error::InvalidArgument { index: Some(i), .. } => of_arc(error, curves[i].0),
            other => other,
        })?;
        for ((arc, _), edges) in curves.iter().zip(&cut.curves) {
            let chain = chain_of(&cut.cut.mesh, edges, feet[layout.arcs()[*arc][0] as usize]);
            for (v, end) in layout.arcs()[*arc]
                .into_iter()
                .zip([chain.first(), chain.last()])
            {
                let node = &mut given.nodes[v as usize];
                if node.is_some() && *node != end.copied() {
                    return Err(Error::InvalidArgument {
                        what: format!("the curves given for arcs at vertex {v} do not meet there"),
                        index: Some(*arc),
                    });
                }
                *node = end.copied();
            }
            given.chains.push((*arc, chain));
        }
        given.cut = Some(cut);
        Ok(given)
    }

    /// The mesh into which curves are cut.
    pub fn mesh<'a>(&'a self, original: &'a TriangleMesh) -> &'a TriangleMesh {
        self.cut.as_ref().map_or(original, |cut| &cut.cut.mesh)
    }

    /// The face of the original mesh that a face is part of.
    pub fn original(&self, face: u32) -> usize {
        let origin = self
            .cut
            .as_ref()
            .map(|cut| cut.cut.face_origin[face as usize]);
        origin.unwrap_or(face) as usize
    }

    /// The edges of the original mesh along which curves run whole.
    pub fn features(&self, original: &TriangleMesh) -> Vec<usize> {
        let Some(cut) = &self.cut else {
            return Vec::new();
        };
        let edges = cut.edges();
        let on = edges.iter().filter_map(|&edge| cut.cut.edge_origin[edge]);
        let mut found: Vec<usize> = on.map(|edge| edge as usize).collect();
        found.sort_unstable();
        found.dedup();
        found.retain(|&edge| edge < original.edge_count());
        found
    }
}

fn of_arc(error: Error, arc: usize) -> Error {
    Error::InvalidArgument {
        what: format!("the curve given for arc {arc}: {error}"),
        index: Some(arc),
    }
}

/// The vertices of edges that follow each other, from the end that is nearer to a point.
fn chain_of(mesh: &TriangleMesh, edges: &[usize], from: Vec3) -> Vec<u32> {
    let ends = |edge: usize| mesh.edge(edge).vertices;
    let mut chain = match edges {
        [] => return Vec::new(),
        [only] => ends(*only).to_vec(),
        [first, second, ..] => {
            let [a, b] = ends(*first);
            let mut chain = if ends(*second).contains(&b) {
                vec![a, b]
            } else {
                vec![b, a]
            };
            for &edge in &edges[1..] {
                let [p, q] = ends(edge);
                let last = chain[chain.len() - 1];
                chain.push(if p == last { q } else { p });
            }
            chain
        }
    };
    let off = |v: usize| {
        let step = crate::mesh::vector::sub(mesh.position(v), from);
        crate::mesh::vector::norm(step)
    };
    if off(chain[chain.len() - 1]) < off(chain[0]) {
        chain.reverse();
    }
    chain.into_iter().map(|v| v as u32).collect()
}

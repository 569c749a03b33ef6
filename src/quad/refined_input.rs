//! Refinement before the field: a mesh that is too coarse or too thin for its quads, and what is given for
//! its elements, on the refined mesh.
//!
//! Vertices keep their numbers. Edges of faces with directions of their own are held, so that each such
//! face is divided into faces that take its direction.

use crate::error::{Error, Result};
use crate::extract::Origin;
use crate::field::{Constraint, Guidance, Guide};
use crate::map::Sizing;
use crate::mesh::features::FeatureGraph;
use crate::mesh::refine::{Need, RefineOptions, Refined, SMALL_ANGLE, needs_refinement, refine};
use crate::mesh::vector::{add, dot, scale};
use crate::mesh::{ClosestPoint, TriangleMesh, barycentric};
use crate::monitor::may_continue;

use super::Quadrangulation;

/// The longest edge of a refined mesh, in edges of the quads, where edges were too long.
const LONGEST_EDGE: f64 = 0.6;

/// The same where only angles were too small: the mesh stays as it is elsewhere.
const LONGEST_BESIDE_NEEDLES: f64 = 2.0;

/// The most triangles that are added for each quad.
const TRIANGLES_PER_QUAD: f64 = 50.0;

/// The most triangles that are added in all.
const MOST_TRIANGLES: f64 = 20e6;

/// A refined mesh, and everything that was given for the original one.
#[derive(Debug)]
pub struct RefinedInput {
    /// The refined mesh.
    pub refined: Refined,
    /// The guidance. Features are among its edges by number.
    pub guidance: Guidance,
    /// The features of the guidance.
    pub features: FeatureGraph,
    /// The sizes.
    pub sizing: Sizing,
}

impl RefinedInput {
    /// Refines a mesh if [`needs_refinement`] says so and the refinement changes anything. A refinement is not used
    /// if it ends at the bound on its triangles and leaves more needles than the mesh has.
    ///
    /// `features` are edges besides those of the guidance.
    ///
    /// # Errors
    /// Those of [`Guidance::features`] and of [`refine`](refine()), and those of a map for sizes that no map
    /// can have.
    pub fn new(
        mesh: &TriangleMesh,
        guidance: &Guidance,
        features: &FeatureGraph,
        sizing: &Sizing,
    ) -> Result<Option<Self>> {
        sizing.check(mesh)?;
        let edge_length = sizing.edge_length(mesh);
        let quads = mesh.surface_area() / (edge_length * edge_length);
        may_continue()?;
        let longest = match needs_refinement(mesh, edge_length) {
            Some(Need::LongEdge(_)) => LONGEST_EDGE * edge_length,
            Some(Need::SmallAngle(_)) => LONGEST_BESIDE_NEEDLES * edge_length,
            None => return Ok(None),
        };
        if !is_in_range(mesh, guidance) {
            return Ok(None);
        }
        let wanted = guidance.features_to_divide(mesh)?.with(mesh, features)?;
        let sides = directed_faces(guidance).flat_map(|f| [0, 1, 2].map(|k| mesh.edge_of(f, k)));
        let sides = FeatureGraph::from_edges(mesh, &sides.collect::<Vec<_>>())?;
        let held = wanted.clone().with(mesh, &sides)?;
        let most = (TRIANGLES_PER_QUAD * quads).min(MOST_TRIANGLES) as usize;
        let options = RefineOptions::new(mesh, longest, most);
        let refined = refine(mesh, &held, &options)?;
        if refined.is_unchanged() || has_more_needles(mesh, &refined) {
            return Ok(None);
        }
        Self::on(mesh, (guidance, &wanted, sizing), refined).map(Some)
    }

    /// What is given for a mesh, on the mesh that it was refined to or [cut](crate::geodesic::cut_along) into:
    /// guidance, features besides those of the guidance, and sizes.
    ///
    /// # Errors
    /// Those of [`Guidance::features`], and [`Error::LengthMismatch`] and
    /// [`Error::IndexOutOfRange`] for what is not of the mesh.
    pub fn on(
        mesh: &TriangleMesh,
        (guidance, features, sizing): (&Guidance, &FeatureGraph, &Sizing),
        refined: Refined,
    ) -> Result<Self> {
        sizing.check(mesh)?;
        check_faces(mesh, guidance)?;
        let wanted = guidance.features(mesh)?.with(mesh, features)?;
        let parts = refined.parts_of(|edge| wanted.contains(edge));
        let guidance = divided(mesh, guidance, &refined.mesh, &refined.face_origin, &parts);
        Ok(RefinedInput {
            features: FeatureGraph::from_edges(&refined.mesh, &parts)?,
            guidance,
            sizing: sizing.on_faces(&refined.face_origin),
            refined,
        })
    }

    /// The result for the refined mesh, with elements of the original one where it names elements.
    pub(super) fn result_for(self, mesh: &TriangleMesh, made: Quadrangulation) -> Quadrangulation {
        let refined = self.refined;
        let original = |edges: Vec<usize>| {
            let origins = edges.into_iter().filter_map(|e| refined.edge_origin[e]);
            let mut origins: Vec<usize> = origins.map(|e| e as usize).collect();
            origins.sort_unstable();
            origins.dedup();
            origins
        };
        let mut quads = made.quads;
        let tree = ClosestPoint::new(mesh);
        for origin in &mut quads.origins {
            *origin = original_place(mesh, &refined, &tree, *origin);
        }
        quads.folded = {
            let faces = quads
                .folded
                .iter()
                .map(|&f| refined.face_origin[f] as usize);
            let mut faces: Vec<usize> = faces.collect();
            faces.sort_unstable();
            faces.dedup();
            faces
        };
        Quadrangulation {
            quads,
            features: original(made.features),
            missed_features: original(made.missed_features),
            refined: Some(refined),
            ..made
        }
    }
}

/// Whether a refinement that ended at its bound leaves more needles than the mesh has: held edges very near each
/// other divide needles into needles without end.
fn has_more_needles(mesh: &TriangleMesh, refined: &Refined) -> bool {
    let is_needle = |angles: &&[f64; 3]| angles.iter().any(|&angle| angle < SMALL_ANGLE);
    !refined.is_complete && refined.small_angles > mesh.angles().iter().filter(is_needle).count()
}

fn directed_faces(guidance: &Guidance) -> impl Iterator<Item = usize> + '_ {
    let constraints = guidance.constraints.iter().map(|c| c.face);
    constraints.chain(guidance.guides.iter().map(|g| g.face))
}

/// A direction of a face that is not there is an error here: the mesh to come has other faces.
pub(super) fn check_faces(mesh: &TriangleMesh, guidance: &Guidance) -> Result<()> {
    let constraints = guidance.constraints.iter().map(|c| c.face);
    let guides = guidance.guides.iter().map(|g| g.face);
    let lists = [
        ("faces with a direction", constraints.collect::<Vec<_>>()),
        ("faces with a guide", guides.collect()),
    ];
    for (what, faces) in lists {
        if let Some(position) = faces.iter().position(|&f| f >= mesh.face_count()) {
            return Err(Error::IndexOutOfRange {
                what,
                position,
                value: faces[position] as i64,
                len: mesh.face_count(),
            });
        }
    }
    Ok(())
}

/// Whether the faces of the guidance exist: where they do not, the field's problem says so.
fn is_in_range(mesh: &TriangleMesh, guidance: &Guidance) -> bool {
    directed_faces(guidance).all(|face| face < mesh.face_count())
}

/// The guidance on a mesh whose faces are parts of those of the given mesh.
pub(super) fn divided(
    mesh: &TriangleMesh,
    guidance: &Guidance,
    refined: &TriangleMesh,
    face_origin: &[u32],
    features: &[usize],
) -> Guidance {
    let mut parts: Vec<(u32, usize)> = face_origin.iter().copied().zip(0..).collect();
    parts.sort_unstable();
    let parts_of = |face: usize| {
        let first = parts.partition_point(|&(origin, _)| (origin as usize) < face);
        let rest = parts[first..].iter();
        rest.take_while(move |&&(origin, _)| origin as usize == face)
            .map(|&(_, part)| part)
    };
    let turned = |face: usize, angle: f64, part: usize| {
        let [x, y] = mesh.frame(face);
        let direction = add(scale(x, angle.cos()), scale(y, angle.sin()));
        let [x, y] = refined.frame(part).map(|axis| dot(direction, axis));
        y.atan2(x)
    };
    let constraints = guidance.constraints.iter().flat_map(|given| {
        parts_of(given.face).map(|part| Constraint {
            face: part,
            angle: turned(given.face, given.angle, part),
        })
    });
    let guides = guidance.guides.iter().flat_map(|given| {
        parts_of(given.face).map(|part| Guide {
            face: part,
            angle: turned(given.face, given.angle, part),
            weight: given.weight,
        })
    });
    Guidance {
        constraints: constraints.collect(),
        guides: guides.collect(),
        feature_lines: Vec::new(),
        feature_edges: features.to_vec(),
        feature_angle: None,
        ..guidance.clone()
    }
}

/// A place of the refined mesh on the original one.
fn original_place(
    mesh: &TriangleMesh,
    refined: &Refined,
    tree: &ClosestPoint,
    place: Origin,
) -> Origin {
    let (point, hint) = match place {
        Origin::Vertex(vertex) => match refined.vertex_origin[vertex] {
            Some(original) => return Origin::Vertex(original as usize),
            None => (refined.mesh.position(vertex), refined.vertex_face[vertex]),
        },
        Origin::Face(face, weights) => {
            let corners = refined.mesh.corner_positions(face);
            let point = (0..3).fold([0.0; 3], |p, k| add(p, scale(corners[k], weights[k])));
            (point, refined.face_origin[face])
        }
        Origin::Middle => return place,
    };
    match tree.find(point, Some(hint as usize)) {
        Some((face, foot)) => Origin::Face(face, barycentric(mesh.corner_positions(face), foot)),
        None => place,
    }
}

//! The seamless parametrization that follows a field, as a mixed-integer problem.
//!
//! Bommes, Zimmer, Kobbelt 2009, section 5: coordinates (u, v) on the surface cut open, with
//!
//! ```text
//! E = sum over triangles of area (|grad u - h X|^2 + |grad v - h Y|^2) + 1e-6 |translations|^2
//! ```
//!
//! X the combed arm of the field, Y a quarter turn counter-clockwise about the normal from it, so
//! that the map keeps the orientation of the surface. Over a seam the coordinates turn by quarters
//! and shift by integers, and cones lie on integers, so that the integer lines of both sides meet:
//!
//! ```text
//! (u', v') = R^r (u, v) + (s, t),    R = [0 -1; 1 0]
//! ```

use super::dirichlet::Dirichlet;
use super::seams::{Seam, seams};
use super::sectors::Sectors;
use super::{Combing, CutGraph, OrientationField, SeamlessMap};
use crate::mesh::TriangleMesh;
use crate::{Error, Problem, Result, Solution, Triangle};

/// What the square of an integer translation costs: enough to decide those that nothing else does,
/// too little to change any other.
pub const TRANSLATION_WEIGHT: f64 = 1e-6;

/// How to parametrize.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SeamlessOptions {
    /// How many unit squares the map shall cover: the number of quads aimed at.
    pub quads: usize,
}

impl Default for SeamlessOptions {
    fn default() -> Self {
        SeamlessOptions { quads: 1000 }
    }
}

/// The mixed-integer problem of a seamless parametrization, and how to read its solution.
///
/// Unknowns: u and v of copy `c` of the cut surface's vertices are unknowns `2 c` and `2 c + 1`;
/// the translation (s, t) of each seam follows. Integer are all translations and the first copy of
/// every cone. In every component the first cone, or else the first vertex, is pinned to the origin.
#[derive(Debug, Clone)]
pub struct SeamlessProblem {
    pub(super) problem: Problem,
    pub(super) field: OrientationField,
    pub(super) cut: CutGraph,
    pub(super) combing: Combing,
    pub(super) sectors: Sectors,
    pub(super) seams: Vec<Seam>,
    pub(super) cones: Vec<usize>,
    /// Unit squares a unit length: the length of the gradients aimed at.
    pub(super) density: f64,
}

impl SeamlessProblem {
    /// The problem for a mesh and a field on it.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for the field of another mesh, [`Error::InvalidArgument`] for no
    /// quads, [`Error::Overflow`] for more than 2^31 - 1 unknowns, [`Error::OutOfMemory`].
    pub fn new(
        mesh: &TriangleMesh,
        field: &OrientationField,
        options: &SeamlessOptions,
    ) -> Result<Self> {
        if options.quads == 0 {
            return Err(Error::InvalidArgument {
                what: "a parametrization for no quads".into(),
                index: None,
            });
        }
        field.check_mesh(mesh)?;
        let cones = field.irregular_vertices(mesh);
        let cut = CutGraph::new(mesh, &cones)?;
        let combing = Combing::new(mesh, field, &cut)?;
        let sectors = Sectors::new(mesh, &cut);
        let seams = seams(mesh, &cut, &cones);
        let density = (options.quads as f64 / mesh.surface_area()).sqrt();
        let mut this = SeamlessProblem {
            problem: Problem::new(2 * (sectors.count() + seams.len()))?,
            field: field.clone(),
            cut,
            combing,
            sectors,
            seams,
            cones,
            density,
        };
        this.add_energy(mesh)?;
        for seam in 0..this.seams.len() {
            this.add_seam(mesh, seam)?;
        }
        this.set_integers()?;
        this.pin_origins(mesh)?;
        Ok(this)
    }

    /// The problem, to be solved by any strategy.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The edges along which the surface is cut.
    pub fn cut(&self) -> &CutGraph {
        &self.cut
    }

    /// The arms that the coordinates follow.
    pub fn combing(&self) -> &Combing {
        &self.combing
    }

    /// The irregular vertices, in increasing order.
    pub fn cones(&self) -> &[usize] {
        &self.cones
    }

    /// The map that belongs to a solution of the problem.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for another mesh or the solution of another problem.
    pub fn map(&self, mesh: &TriangleMesh, solution: &Solution) -> Result<SeamlessMap> {
        self.field.check_mesh(mesh)?;
        SeamlessMap::new(self, mesh, solution.values())
    }

    /// Whether this is a map of that mesh and this problem.
    pub(super) fn check_map(&self, mesh: &TriangleMesh, map: &SeamlessMap) -> Result<()> {
        self.field.check_mesh(mesh)?;
        let (expected, actual) = (self.problem.variables(), map.values().len());
        match expected == actual && map.copies() == self.sectors.copy {
            true => Ok(()),
            false => Err(Error::LengthMismatch {
                what: "the map of the parametrization",
                expected,
                actual,
            }),
        }
    }

    /// Combed arms of a face, as long as the gradients shall be.
    pub(super) fn targets(&self, mesh: &TriangleMesh, face: usize) -> [[f64; 3]; 2] {
        let arms = self.combing.arms(mesh, &self.field, face);
        arms.map(|arm| arm.map(|x| self.density * x))
    }

    /// The unknown that is `s` of a seam; `t` is the next.
    pub(super) fn translation(&self, seam: usize) -> usize {
        2 * (self.sectors.count() + seam)
    }

    fn add_energy(&mut self, mesh: &TriangleMesh) -> Result<()> {
        let energy = Dirichlet::new(self, mesh);
        energy.add_to(&mut self.problem)?;
        let translations: Vec<usize> =
            (self.translation(0)..self.translation(self.seams.len())).collect();
        let weights = vec![2.0 * TRANSLATION_WEIGHT; translations.len()];
        self.problem
            .add_quadratic_triplets(Triangle::Lower, &translations, &translations, &weights)
    }

    /// The transition of one seam at each of its vertices, from its left to its right side.
    fn add_seam(&mut self, mesh: &TriangleMesh, seam: usize) -> Result<()> {
        let s = self.translation(seam);
        let turns = self.seam_turns(mesh, seam);
        for pair in seam_copies(mesh, &self.sectors, &self.seams[seam]) {
            let [left, right] = pair.map(|copy| 2 * copy as usize);
            for axis in 0..2 {
                let (from, sign) = turned(turns, axis);
                let row = [right + axis, left + from, s + axis];
                self.problem
                    .add_constraint(&row, &[1.0, -sign, -1.0], 0.0)?;
            }
        }
        Ok(())
    }

    /// The quarter turns of a seam, from its left to its right side.
    pub(super) fn seam_turns(&self, mesh: &TriangleMesh, seam: usize) -> u8 {
        let first = self.seams[seam].first();
        first.map_or(0, |&(f, k)| self.combing.transition_from(mesh, f, k))
    }

    fn set_integers(&mut self) -> Result<()> {
        let first = &self.sectors.first;
        let cones = self.cones.iter().flat_map(|&v| {
            let u = 2 * first[v] as usize;
            [u, u + 1]
        });
        let translations = self.translation(0)..self.translation(self.seams.len());
        self.problem
            .set_integers(&cones.chain(translations).collect::<Vec<_>>())
    }

    fn pin_origins(&mut self, mesh: &TriangleMesh) -> Result<()> {
        let components = mesh.components();
        let mut is_pinned = vec![false; components.count];
        for v in self.cones.iter().copied().chain(0..mesh.vertex_count()) {
            let face = mesh.ring(v).next().map_or(0, |(face, _)| face);
            let component = components.of_face[face] as usize;
            if !std::mem::replace(&mut is_pinned[component], true) {
                let u = 2 * self.sectors.first[v] as usize;
                self.problem.pin(u, 0.0)?;
                self.problem.pin(u + 1, 0.0)?;
            }
        }
        Ok(())
    }
}

/// Where coordinate `axis` of a point comes from when it is turned by quarters: (axis, sign).
pub(super) fn turned(quarters: u8, axis: usize) -> (usize, f64) {
    match (quarters % 4, axis) {
        (0, _) => (axis, 1.0),
        (1, 0) => (1, -1.0),
        (1, _) => (0, 1.0),
        (2, _) => (axis, -1.0),
        (_, 0) => (1, 1.0),
        (_, _) => (0, -1.0),
    }
}

/// The copies [left, right] of each vertex along a seam, from its first to its last.
fn seam_copies<'a>(
    mesh: &'a TriangleMesh,
    sectors: &'a Sectors,
    seam: &'a Seam,
) -> impl Iterator<Item = [u32; 2]> + 'a {
    let at = |&(face, k): &(usize, usize), end: usize| {
        let (across, j) = mesh.neighbor(face, k)?;
        let left = sectors.copy[face][(k + end) % 3];
        Some([left, sectors.copy[across][(j + 1 - end) % 3]])
    };
    let starts = seam.iter().filter_map(move |side| at(side, 0));
    starts.chain(seam.last().and_then(move |side| at(side, 1)))
}

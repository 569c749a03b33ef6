//! The seamless parametrization that follows a field, as a mixed-integer problem.
//!
//! `bommes2009`, section 5, and `bommes2012`, section 8.4: coordinates (u, v) on the surface cut open,
//! with the energy
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
//!
//! Feature edges are isolines of integer value ([`super::isolines`]).

use super::dirichlet::Dirichlet;
use super::isolines::{Isoline, isolines};
use super::seams::{Seam, seams};
use super::sectors::Sectors;
use super::sizing::Density;
use super::{Combing, CutGraph, SeamlessMap, Sizing, gradient};
use crate::error::{Error, Result};
use crate::field::OrientationField;
use crate::mesh::features::FeatureGraph;
use crate::mesh::vector::norm;
use crate::mesh::{TriangleMesh, turned};
use crate::monitor::{may_continue, span};
use crate::problem::{Problem, Triangle};
use crate::solve::Solver;

/// The weight of the square of an integer translation: enough to decide translations that nothing else
/// decides, too little to change any other.
pub const TRANSLATION_WEIGHT: f64 = 1e-6;

/// The options of a parametrization.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SeamlessOptions {
    /// The target number of quads: how many unit squares the map should cover.
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
/// the translation (s, t) of each seam follows. The integers are all translations, the coordinates of
/// the first copy of every cone, and one coordinate of every feature curve in every chart. In every
/// component the first cone is pinned to the origin. A component without cones has each coordinate
/// pinned at the first feature along which it is constant, or else at the first vertex.
#[derive(Debug, Clone)]
pub struct SeamlessProblem {
    pub(super) problem: Problem,
    pub(super) field: OrientationField,
    pub(super) cut: CutGraph,
    pub(super) combing: Combing,
    pub(crate) sectors: Sectors,
    pub(super) seams: Vec<Seam>,
    pub(super) cones: Vec<usize>,
    pub(crate) isolines: Vec<Isoline>,
    /// The target lengths of the gradients.
    pub(super) density: Density,
    /// By what factor lengths are larger than that along the arm that the field stores, and smaller across, in every
    /// face; empty where they are neither.
    pub(super) elongations: Vec<f64>,
    /// The gradients of another map, which this one should have in place of the target gradients; empty without it.
    pub(super) guides: Vec<[[f64; 3]; 2]>,
}

impl SeamlessProblem {
    /// The problem for a mesh and a field on it, without features.
    ///
    /// # Errors
    /// Those of [`with_features`](Self::with_features).
    pub fn new(
        mesh: &TriangleMesh,
        field: &OrientationField,
        options: &SeamlessOptions,
    ) -> Result<Self> {
        let sizing = Sizing::Quads(options.quads);
        Self::with_features(mesh, field, &sizing, &FeatureGraph::none(mesh))
    }

    /// The problem for a mesh, a field on it, the size of quads, and the edges that are to be
    /// isolines, which the field should follow
    /// ([`feature_constraints`](crate::field::feature_constraints)). Of three around one face, the longest
    /// is left out.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for field, sizes or features of another mesh,
    /// [`Error::InvalidArgument`] for a field of other than crosses, for no quads or lengths not
    /// above zero, [`Error::NotFinite`] for lengths, [`Error::Overflow`] for more than 2^31 - 1
    /// unknowns, [`Error::OutOfMemory`].
    pub fn with_features(
        mesh: &TriangleMesh,
        field: &OrientationField,
        sizing: &Sizing,
        features: &FeatureGraph,
    ) -> Result<Self> {
        let _span = span("assemble map");
        let _memory = mesh.watch_memory();
        may_continue()?;
        let density = Density::new(mesh, sizing)?;
        may_continue()?;
        field.check_mesh(mesh)?;
        features.check_mesh(mesh)?;
        let features = &features.with_two_of_each_face(mesh);
        if field.symmetry() != 4 {
            return Err(Error::InvalidArgument {
                what: format!(
                    "a map needs a field of symmetry 4; this one has {}",
                    field.symmetry()
                ),
                index: None,
            });
        }
        let steps = field.vertex_index_steps(mesh);
        may_continue()?;
        let cones: Vec<usize> = (0..steps.len()).filter(|&v| steps[v] != 0).collect();
        let cut = CutGraph::new(mesh, &cones)?;
        may_continue()?;
        let combing = Combing::new(mesh, field, &cut)?;
        may_continue()?;
        let sectors = Sectors::new(mesh, &cut);
        may_continue()?;
        let seams = seams(mesh, &cut, &cones);
        may_continue()?;
        let isolines = isolines(mesh, field, &combing, &sectors, features);
        let mut this = SeamlessProblem {
            problem: Problem::new(2 * (sectors.count() + seams.len()))?,
            field: field.clone(),
            cut,
            combing,
            sectors,
            seams,
            cones,
            isolines,
            density,
            elongations: Vec::new(),
            guides: Vec::new(),
        };
        this.state(mesh)?;
        Ok(this)
    }

    /// Adds the energy, constraints, integers and pins to the problem.
    fn state(&mut self, mesh: &TriangleMesh) -> Result<()> {
        self.add_terms(mesh)?;
        may_continue()?;
        self.set_integers(mesh)?;
        may_continue()?;
        self.pin_origins(mesh)
    }

    /// Adds the energy and the constraints to the problem.
    pub(super) fn add_terms(&mut self, mesh: &TriangleMesh) -> Result<()> {
        self.add_energy(mesh)?;
        for seam in 0..self.seams.len() {
            self.add_seam(mesh, seam)?;
        }
        for isoline in &self.isolines {
            let row = isoline.unknowns();
            self.problem.add_constraint(&row, &[1.0, -1.0], 0.0)?;
        }
        Ok(())
    }

    /// Follows another field with the same period jumps instead. Only linear terms change, in `solver` too.
    ///
    /// False if the field has other period jumps, or if there are isolines, for these may depend on directions. Then
    /// nothing changes.
    pub(crate) fn follow_directions(
        &mut self,
        mesh: &TriangleMesh,
        field: &OrientationField,
        solver: &mut Solver,
    ) -> Result<bool> {
        let is_same = field.period_jumps() == self.field.period_jumps();
        if !is_same || !self.isolines.is_empty() {
            return Ok(false);
        }
        self.field = field.clone();
        let energy = self.dirichlet(mesh)?;
        self.tell(&energy, solver)?;
        Ok(true)
    }

    /// Sets the linear terms of the energy, in `solver` too.
    fn tell(&mut self, energy: &Dirichlet, solver: &mut Solver) -> Result<()> {
        solver.set_linear(&energy.linear)?;
        solver.set_constant(energy.constant)?;
        self.problem.set_linear(&energy.linear)?;
        self.problem.set_constant(energy.constant)
    }

    /// Makes quads longer by a factor for every face along the arm that the field stores, and narrower by it across.
    /// Their area stays, and so do these factors at other sizes. Only linear terms change.
    pub(crate) fn elongate(&mut self, mesh: &TriangleMesh, elongations: Vec<f64>) -> Result<()> {
        self.elongations = elongations;
        let energy = self.dirichlet(mesh)?;
        self.problem.set_linear(&energy.linear)?;
        self.problem.set_constant(energy.constant)
    }

    /// Changes the target size of quads. Only linear terms change: the solver of this problem keeps its
    /// elimination, orderings and factors, and its next solve gives the result of a new problem of that
    /// size.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for another mesh or the solver of another problem, and those of
    /// [`with_features`](Self::with_features) for sizes.
    pub fn resize(
        &mut self,
        mesh: &TriangleMesh,
        sizing: &Sizing,
        solver: &mut Solver,
    ) -> Result<()> {
        self.field.check_mesh(mesh)?;
        let before = std::mem::replace(&mut self.density, Density::new(mesh, sizing)?);
        let energy = self.dirichlet(mesh)?;
        let told = solver.set_linear(&energy.linear);
        if let Err(error) = told.and_then(|()| solver.set_constant(energy.constant)) {
            self.density = before;
            return Err(error);
        }
        self.problem.set_linear(&energy.linear)?;
        self.problem.set_constant(energy.constant)
    }

    /// The same problem for a map that is `factor` times as large in length. The new linear terms
    /// are set in `solver` too, which keeps what does not depend on the size.
    pub(crate) fn refined(
        &self,
        mesh: &TriangleMesh,
        factor: f64,
        solver: &mut Solver,
    ) -> Result<Self> {
        self.with_density(mesh, self.density.scaled(factor), solver)
    }

    /// As [`refined`](Self::refined) with a factor for u and one for v in every face.
    pub(crate) fn stretched(
        &self,
        mesh: &TriangleMesh,
        factors: &[[f64; 2]],
        solver: &mut Solver,
    ) -> Result<Self> {
        let density = self.density.stretched(factors, self.combing.quarters());
        self.with_density(mesh, density, solver)
    }

    /// As [`refined`](Self::refined) with a factor for every face.
    pub(crate) fn graded(
        &self,
        mesh: &TriangleMesh,
        factors: &[f64],
        solver: &mut Solver,
    ) -> Result<Self> {
        self.with_density(mesh, self.density.graded(factors), solver)
    }

    /// As [`refined`](Self::refined), with the gradients of a finer map in place of the target gradients. They are
    /// made smaller by as much as lengths of `finer`, the problem of that map, are larger.
    pub(crate) fn guided(
        &self,
        mesh: &TriangleMesh,
        factor: f64,
        (finer, map): (&Self, &SeamlessMap),
        solver: &mut Solver,
    ) -> Result<Self> {
        let mut this = self.clone();
        this.density = self.density.scaled(factor);
        let guide = |face: usize| {
            let lengths = [&this, finer].map(|of| norm(of.targets(mesh, face)[0]));
            let uv = map.uv(face);
            let smaller = |axis: usize| uv.map(|corner| lengths[0] / lengths[1] * corner[axis]);
            [0, 1].map(|axis| gradient(mesh, face, smaller(axis)))
        };
        this.guides = (0..mesh.face_count()).map(guide).collect();
        let energy = this.dirichlet(mesh)?;
        this.tell(&energy, solver)?;
        Ok(this)
    }

    fn with_density(
        &self,
        mesh: &TriangleMesh,
        density: Density,
        solver: &mut Solver,
    ) -> Result<Self> {
        let mut this = self.clone();
        this.density = density;
        let energy = this.dirichlet(mesh)?;
        this.tell(&energy, solver)?;
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

    /// The target gradients of a face: the combed arms, scaled by the density.
    pub(crate) fn targets(&self, mesh: &TriangleMesh, face: usize) -> [[f64; 3]; 2] {
        let arms = self.proportions(mesh, face);
        let density = self.density.of(face, self.combing.quarters()[face]);
        [0, 1].map(|axis| arms[axis].map(|x| density[axis] * x))
    }

    /// The gradients that the coordinates of a face should have: those of another map, if there is one.
    pub(crate) fn wanted(&self, mesh: &TriangleMesh, face: usize) -> [[f64; 3]; 2] {
        match self.guides.get(face) {
            Some(&guide) => guide,
            None => self.targets(mesh, face),
        }
    }

    /// The combed arms of a face, of length 1 but where quads are stretched: there in inverse proportion to lengths.
    pub(crate) fn proportions(&self, mesh: &TriangleMesh, face: usize) -> [[f64; 3]; 2] {
        let [first, second] = self.combing.arms(mesh, &self.field, face);
        let Some(&elongation) = self.elongations.get(face) else {
            return [first, second];
        };
        let longer = match self.combing.quarters()[face] % 2 {
            0 => elongation,
            _ => elongation.recip(),
        };
        [first.map(|x| x / longer), second.map(|x| x * longer)]
    }

    /// The length of an edge of quads, in units of the mesh: the mean over faces.
    pub(crate) fn edge_length(&self, mesh: &TriangleMesh) -> f64 {
        let length = |face| 1.0 / norm(self.targets(mesh, face)[0]);
        (0..mesh.face_count()).map(length).sum::<f64>() / mesh.face_count() as f64
    }

    /// The unknown that is `s` of a seam; `t` is the next.
    pub(super) fn translation(&self, seam: usize) -> usize {
        2 * (self.sectors.count() + seam)
    }

    fn dirichlet(&self, mesh: &TriangleMesh) -> Result<Dirichlet> {
        let unknowns = self.translation(self.seams.len());
        let wanted = |face| self.wanted(mesh, face);
        Dirichlet::new(mesh, &self.sectors, &self.cut, unknowns, wanted)
    }

    fn add_energy(&mut self, mesh: &TriangleMesh) -> Result<()> {
        let energy = self.dirichlet(mesh)?;
        may_continue()?;
        energy.add_to(&mut self.problem)?;
        may_continue()?;
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
                let (from, sign) = turned_axis(turns, axis);
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

    /// The boundary vertices between two isolines, in increasing order.
    fn between_isolines(&self, mesh: &TriangleMesh) -> Vec<usize> {
        let edges = self.isolines.iter().map(|isoline| mesh.edge(isoline.edge));
        let mut ends: Vec<usize> = edges
            .filter(|edge| edge.second.is_none())
            .flat_map(|edge| edge.vertices)
            .collect();
        ends.sort_unstable();
        let twice = ends.chunk_by(|a, b| a == b).filter(|same| same.len() == 2);
        twice.map(|same| same[0]).collect()
    }

    /// The quarter turns of a map around every interior vertex; none at the boundary.
    pub(crate) fn quarters(&self, mesh: &TriangleMesh) -> Result<Vec<Option<i32>>> {
        let steps = self.field.vertex_index_steps(mesh);
        may_continue()?;
        let quarters = |(v, steps)| (!mesh.is_boundary_vertex(v)).then_some(4 - steps);
        Ok(steps.into_iter().enumerate().map(quarters).collect())
    }

    /// Makes the coordinates of cones, the translations and the values of isolines integer, and the
    /// coordinates of vertices where the boundary turns back: there both boundary edges lie on one
    /// isoline, which leaves the vertex free along it.
    fn set_integers(&mut self, mesh: &TriangleMesh) -> Result<()> {
        let first = &self.sectors.first;
        let turns = self.between_isolines(mesh);
        let turns = turns
            .into_iter()
            .filter(|&v| self.field.boundary_quarters(mesh, v) == 4);
        let cones = self.cones.iter().copied().chain(turns).flat_map(|v| {
            let u = 2 * first[v] as usize;
            [u, u + 1]
        });
        let translations = self.translation(0)..self.translation(self.seams.len());
        let first = self.isolines.iter().filter(|isoline| isoline.is_first);
        let values = first.map(|isoline| isoline.unknowns()[0]);
        self.problem
            .set_integers(&cones.chain(translations).chain(values).collect::<Vec<_>>())
    }

    /// Pins the origin of every component, which neither energy nor constraints determine.
    fn pin_origins(&mut self, mesh: &TriangleMesh) -> Result<()> {
        let components = mesh.components();
        let component_of = |v: usize| {
            let face = mesh.ring(v).next().map_or(0, |(face, _)| face);
            components.of_face[face] as usize
        };
        let mut is_pinned = vec![[false; 2]; components.count];
        for i in 0..self.cones.len() {
            let v = self.cones[i];
            if !std::mem::replace(&mut is_pinned[component_of(v)], [true; 2])[0] {
                self.pin_first_copy(v, 0)?;
                self.pin_first_copy(v, 1)?;
            }
        }
        if is_pinned.iter().all(|&axes| axes == [true; 2]) {
            return Ok(());
        }
        // The values of isolines are integer: only an integer shift is free, which a pin decides.
        let component_of_copy = self.component_of_copy(mesh, &components.of_face);
        for isoline in &self.isolines {
            let pinned = &mut is_pinned[component_of_copy[isoline.ends[0] as usize] as usize];
            if !std::mem::replace(&mut pinned[isoline.axis], true) {
                self.problem.pin(isoline.unknowns()[0], 0.0)?;
            }
        }
        for v in 0..mesh.vertex_count() {
            for axis in 0..2 {
                if !std::mem::replace(&mut is_pinned[component_of(v)][axis], true) {
                    self.pin_first_copy(v, axis)?;
                }
            }
        }
        Ok(())
    }

    fn pin_first_copy(&mut self, vertex: usize, axis: usize) -> Result<()> {
        let unknown = 2 * self.sectors.first[vertex] as usize + axis;
        self.problem.pin(unknown, 0.0)
    }

    fn component_of_copy(&self, mesh: &TriangleMesh, of_face: &[u32]) -> Vec<u32> {
        let mut component = vec![0; self.sectors.count()];
        for face in 0..mesh.face_count() {
            for copy in self.sectors.copy[face] {
                component[copy as usize] = of_face[face];
            }
        }
        component
    }
}

/// The coordinate, with its sign, that becomes coordinate `axis` after a turn by quarters.
fn turned_axis(quarters: u8, axis: usize) -> (usize, f64) {
    let signed = turned(quarters, [1.0_f64, 2.0])[axis];
    (signed.abs() as usize - 1, signed.signum())
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

//! Maps without folds: the integers and the seams stay, and every triangle becomes counter-clockwise.
//!
//! The method is that of `garanzha2021`, applied to the unknowns that the constraints leave free once the
//! integers are fixed. Folds are few and lie near cones. Therefore only the faces within a few rings of a
//! fold move at first, and more of the surface moves only if that does not suffice.
//!
//! | step | file |
//! | --- | --- |
//! | the unknowns that may move | `freedom` |
//! | local stiffening around folds | `stiffen` |
//! | the regions that may move | `region` |
//! | the energy of a triangle, to second order | `energy` |
//! | the Hessian of a region | `hessian` |
//! | Newton steps of a region | `system` |
//! | the schedule that closes the barrier | `schedule` |
//! | folds that no motion can remove | `stuck` |
//! | a disk around a vertex | `disk` |
//! | a disk around a cone, in polar coordinates | `polar` |
//! | vertices with a wrong winding number | `unwind` |
//! | rows between cones near each other | `near_cones` |
//! | all elements whose shape integers alone decide | `held_elements`, `isoline_triangles` |
//! | smaller quads around the remaining faults | `grading` |
//! | maps of patches, whose seams slide | `patchwork` |
//!
//! [`solve_fold_free`](crate::quad::solve_fold_free) decides which of these is tried when.

mod disk;
mod energy;
mod freedom;
mod grading;
mod held_elements;
mod hessian;
mod isoline_triangles;
mod near_cones;
mod patchwork;
mod polar;
mod region;
mod schedule;
mod stiffen;
mod stuck;
mod system;
mod unwind;

pub(crate) use grading::{FINER, faulty, grow_around};
pub(crate) use held_elements::HeldElements;
pub(crate) use near_cones::{FAR, NEAR};
pub(crate) use patchwork::Patchwork;

use crate::error::Result;
use crate::map::{SeamlessMap, SeamlessProblem};
use crate::mesh::vector::{dot, sub};
use crate::mesh::{Reordered, TriangleMesh, orientation};
use crate::monitor::Phase;
use crate::monitor::{Monitor, may_continue, span};
use energy::Rest;
use freedom::Freedom;
use region::{Region, at_once, regions};
use schedule::Outcome;
use stuck::Stuck;
use system::System;

/// The numbers of rings around a fold that may move, attempt after attempt.
const RINGS: [usize; 6] = [3, 8, 20, 50, 120, usize::MAX];

/// A region is left as it is if the budget allows it fewer steps than this.
const LEAST_STEPS: usize = 10;

/// The limits of the work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UntangleOptions {
    /// The most Newton steps of a region.
    pub steps: usize,
    /// The most faces that all steps together may visit, as a multiple of the mesh's faces.
    pub passes: usize,
    /// The number of times that the surroundings of a fold are stiffened where the map distorts them,
    /// before anything else is tried. The integers are kept.
    pub stiffenings: usize,
    /// The number of times that the integers of collapsed cones are decided anew.
    pub rounds: usize,
    /// The number of times that a map with folds is made finer as a whole. If this is not zero, the map
    /// is afterwards made finer a few times around the remaining folds alone.
    pub refinements: usize,
}

impl Default for UntangleOptions {
    fn default() -> Self {
        UntangleOptions {
            steps: 100,
            passes: 200,
            stiffenings: 5,
            rounds: 6,
            refinements: 5,
        }
    }
}

/// A map after untangling, and the work that was done.
#[derive(Debug, Clone, PartialEq)]
pub struct Untangled {
    /// The map.
    pub map: SeamlessMap,
    /// Number of folded or collapsed faces before untangling.
    pub flipped_before: usize,
    /// Number of folded or collapsed faces after local stiffening.
    pub flipped_stiffened: usize,
    /// Number of folded or collapsed faces after untangling: [`SeamlessMap::flipped`] names them.
    pub flipped_after: usize,
    /// Vertices that the map winds around another number of times than the field does, after untangling.
    pub winding_defects: Vec<usize>,
    /// Newton steps, over all regions.
    pub steps: usize,
    /// The faces that these steps visited, which [`UntangleOptions::passes`] limits.
    pub(crate) visited: usize,
    /// Flipped faces that no motion can unfold, because integers fix all their corners.
    pub stuck_faces: Vec<usize>,
    /// Edges of flipped faces that integers collapse: both ends are cones at one point.
    pub collapsed_edges: Vec<usize>,
}

impl Untangled {
    /// The number of faces and vertices where the map is not locally injective; zero for a good map.
    pub fn faults(&self) -> usize {
        self.flipped_after + self.winding_defects.len()
    }

    /// The same on `given`, the mesh as it was before it was reordered, with the map there.
    pub(crate) fn on_given(
        self,
        reordered: &Reordered,
        given: &TriangleMesh,
        map: SeamlessMap,
    ) -> Self {
        Untangled {
            map,
            winding_defects: reordered.given_vertices(&self.winding_defects),
            stuck_faces: reordered.given_faces(&self.stuck_faces),
            collapsed_edges: reordered.given_edges(given, &self.collapsed_edges),
            ..self
        }
    }

    /// The outcome for a map that is left as it is.
    ///
    /// # Errors
    /// [`LengthMismatch`](crate::Error::LengthMismatch) for the map of another problem or mesh.
    pub fn untouched(
        mesh: &TriangleMesh,
        problem: &SeamlessProblem,
        map: SeamlessMap,
    ) -> Result<Self> {
        let flipped = map.flipped().len();
        Ok(Untangled {
            winding_defects: problem.winding_defects(mesh, &map)?,
            map,
            flipped_before: flipped,
            flipped_stiffened: flipped,
            flipped_after: flipped,
            steps: 0,
            visited: 0,
            stuck_faces: Vec::new(),
            collapsed_edges: Vec::new(),
        })
    }
}

/// Moves the vertices of a map that the integers do not fix until no triangle is folded.
///
/// A map without folds is returned unchanged. If some folds cannot be removed, the map with the fewest
/// folds found is returned.
///
/// # Errors
/// [`LengthMismatch`](crate::Error::LengthMismatch) for the map of another problem or mesh,
/// [`OutOfMemory`](crate::Error::OutOfMemory), and [`Cancelled`](crate::Error::Cancelled) when
/// `monitor` asks for it.
pub fn untangle(
    mesh: &TriangleMesh,
    problem: &SeamlessProblem,
    map: &SeamlessMap,
    options: &UntangleOptions,
    monitor: &mut Monitor,
) -> Result<Untangled> {
    let _span = span("untangle");
    problem.check_map(mesh, map)?;
    let structure = Structure::new(mesh, problem, map, monitor)?;
    structure.untangle(mesh, problem, map, options, monitor)
}

/// The data of a map that depend on neither its integers nor its size.
pub(crate) struct Structure {
    freedom: Freedom,
    /// How many quarter turns there should be around each vertex.
    quarters: Vec<Option<i32>>,
}

impl Structure {
    /// The structure of all maps of this problem, whatever their size; `map` is one of them.
    pub(crate) fn new(
        mesh: &TriangleMesh,
        problem: &SeamlessProblem,
        map: &SeamlessMap,
        monitor: &mut Monitor,
    ) -> Result<Self> {
        Ok(Structure {
            freedom: Freedom::new(problem, map.copies(), map.values(), monitor)?,
            quarters: problem.quarters(mesh)?,
        })
    }

    /// The elements that integers alone may collapse in maps of this problem, with rows between those within
    /// `reach` quads of each other.
    ///
    /// # Errors
    /// Those of the monitor's requests to end.
    pub(crate) fn held_elements(
        &self,
        mesh: &TriangleMesh,
        problem: &SeamlessProblem,
        reach: f64,
        monitor: &Monitor,
    ) -> Result<HeldElements> {
        monitor.watching(|| HeldElements::new(problem, mesh, &self.freedom.held(), reach))
    }

    /// [`untangle`], for a map of this structure.
    pub(crate) fn untangle(
        &self,
        mesh: &TriangleMesh,
        problem: &SeamlessProblem,
        map: &SeamlessMap,
        options: &UntangleOptions,
        monitor: &mut Monitor,
    ) -> Result<Untangled> {
        let (_watch, _memory) = (monitor.watch(), mesh.watch_memory());
        may_continue()?;
        let mut work = Untangling::new(self, mesh, problem, map, options);
        let flipped_before = work.folded().len();
        if flipped_before == 0 && work.winding_defects()?.is_empty() {
            return Untangled::untouched(mesh, problem, map.clone());
        }
        work.stiffen(options.stiffenings, monitor)?;
        let flipped_stiffened = work.folded().len();
        for rings in RINGS {
            let folded = work.folded();
            if folded.is_empty() || work.budget == 0 {
                break;
            }
            let regions = regions(work.freedom, &folded, rings);
            work.undo_folds(&regions, schedule::FIRST_EPS, monitor)?;
        }
        work.unwind(options.passes, monitor)?;
        monitor.progress(Phase::Untangle, 1.0)?;
        let left = work.folded();
        let stuck = Stuck::find(mesh, work.freedom, &work.values, &left);
        Ok(Untangled {
            stuck_faces: stuck.faces,
            collapsed_edges: stuck.edges,
            flipped_before,
            flipped_stiffened,
            winding_defects: work.winding_defects()?,
            flipped_after: left.len(),
            steps: work.steps,
            visited: options.passes.saturating_mul(mesh.face_count()) - work.budget,
            map: SeamlessMap::new(problem, mesh, &work.values)?,
        })
    }
}

/// The state of an untangling.
struct Untangling<'a> {
    mesh: &'a TriangleMesh,
    problem: &'a SeamlessProblem,
    freedom: &'a Freedom,
    quarters: &'a [Option<i32>],
    values: Vec<f64>,
    /// Newton steps made so far.
    steps: usize,
    /// The most Newton steps of a region.
    most_steps: usize,
    /// The number of faces that steps may still visit.
    budget: usize,
}

impl<'a> Untangling<'a> {
    fn new(
        structure: &'a Structure,
        mesh: &'a TriangleMesh,
        problem: &'a SeamlessProblem,
        map: &SeamlessMap,
        options: &UntangleOptions,
    ) -> Self {
        Untangling {
            mesh,
            problem,
            freedom: &structure.freedom,
            quarters: &structure.quarters,
            values: map.values().to_vec(),
            steps: 0,
            most_steps: options.steps,
            budget: options.passes.saturating_mul(mesh.face_count()),
        }
    }

    fn folded(&self) -> Vec<usize> {
        let faces = 0..self.freedom.copies.len();
        faces.filter(|&f| orientation(self.uv(f)) <= 0.0).collect()
    }

    fn uv(&self, face: usize) -> [[f64; 2]; 3] {
        self.freedom.uv(&self.values, face)
    }

    fn system<'r>(&self, region: &'r Region) -> Result<System<'r>>
    where
        'a: 'r,
    {
        let rest = |face: usize| at_rest(self.mesh, self.problem, face);
        System::new(self.freedom, region, rest)
    }

    /// Works on regions, and keeps the results that have fewer folds.
    fn undo_folds(
        &mut self,
        regions: &[Region],
        first_eps: f64,
        monitor: &mut Monitor,
    ) -> Result<()> {
        let steps: Vec<usize> = regions.iter().map(|of| self.steps_for(of)).collect();
        let undone = |this: &Self, k: usize, steps, values: &mut [f64], monitor: &mut Monitor| {
            if steps == 0 {
                return Ok(Outcome::default());
            }
            let mut system = this.system(&regions[k])?;
            schedule::undo_folds(&mut system, values, steps, first_eps, monitor)
        };
        let done = at_once(&self.values, regions, monitor, |k, values, monitor| {
            undone(self, k, steps[k], values, monitor)
        })?;
        for (k, mut outcome) in done.into_iter().enumerate() {
            // The budget is spent in the order of the regions.
            let left = self.steps_for(&regions[k]);
            if left != steps[k] {
                let mut values = self.values.clone();
                outcome = undone(self, k, left, &mut values, monitor)?;
            }
            let better = outcome.better.iter();
            better.for_each(|moved| moved.put(&mut self.values));
            self.steps += outcome.steps;
            let looked_at = outcome.steps.saturating_mul(regions[k].faces.len());
            self.budget = self.budget.saturating_sub(looked_at);
        }
        Ok(())
    }

    /// The Newton steps that a region may make.
    fn steps_for(&self, region: &Region) -> usize {
        let steps = self.most_steps.min(self.budget / region.faces.len().max(1));
        match steps < LEAST_STEPS.min(self.most_steps) {
            true => 0,
            false => steps,
        }
    }
}

/// A face laid into the plane in the directions of the field and at the size that is asked for.
fn at_rest(mesh: &TriangleMesh, problem: &SeamlessProblem, face: usize) -> Rest {
    let corners = mesh.corner_positions(face);
    let targets = problem.targets(mesh, face);
    let from_first = |k: usize| {
        let step = sub(corners[k], corners[0]);
        targets.map(|target| dot(target, step))
    };
    Rest::new([0, 1, 2].map(from_first))
}

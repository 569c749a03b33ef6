//! Correction of vertices that a map winds around once too often, and of folds at cones.
//!
//! Removing folds may leave a cone of -1/4 with a total angle of one quarter turn, next to a vertex with
//! two full turns. No motion without folds leads out of that state. A disk around both is therefore laid
//! out anew in polar coordinates, with larger and larger radii. The folds that this causes are untangled
//! again. The same is tried where a fold remains at a cone: most of these wind wrongly, too.

use std::collections::BTreeSet;

use super::Untangling;
use super::disk::Disk;
use super::polar::{Layout, faces_within};
use super::region::regions;
use crate::error::Result;
use crate::map::{has_winding_defect, winding_defects};
use crate::mesh::{TriangleMesh, orientation};
use crate::monitor::Monitor;

/// The radii of the disks that are laid out anew around a cone, in units of the map, in this order.
const RADII: [f64; 12] = [0.5, 0.7, 1.0, 1.2, 1.4, 1.7, 2.0, 2.4, 2.8, 3.4, 4.0, 5.6];

/// Larger disks are not tried: they cost more than they gain.
const MOST_FACES: usize = 4000;

/// Passes over all winding defects: removing one defect may cause another.
const ROUNDS: usize = 8;

/// The work limit: how many faces all layouts and steps together may visit, as a multiple of the mesh's faces.
const PASSES: usize = 40;

/// Meshes of fewer faces count as if they had so many: disks are not smaller there.
const LEAST_FACES: usize = 10_000;

/// The share of the work that one layout may take.
const SHARE: usize = 24;

/// A disk of which so large a part is folded after untangling is too small, whatever the first eps.
const LARGE_PART: usize = 8;

/// The first eps of the barrier, attempt after attempt. A large eps removes more folds. A small one keeps
/// the winding that the layout has corrected.
const FIRST_EPS: [f64; 3] = [1.0, 0.1, 0.01];

/// How many rings of faces around the new folds may move, attempt after attempt.
const RINGS: [usize; 3] = [2, 5, 12];

/// The faults of a map, increasing.
#[derive(Debug, Clone, PartialEq)]
struct Faults {
    folded: Vec<usize>,
    defects: Vec<usize>,
}

impl Faults {
    fn count(&self) -> usize {
        self.folded.len() + self.defects.len()
    }

    /// The vertices at faults.
    fn vertices(&self, mesh: &TriangleMesh) -> BTreeSet<usize> {
        let corners = self.folded.iter().flat_map(|&face| mesh.corners(face));
        self.defects.iter().copied().chain(corners).collect()
    }
}

/// What remains of a list where nothing changed, and those of what changed for which `holds`.
fn replaced(
    list: &[usize],
    changed: &BTreeSet<usize>,
    holds: impl Fn(&usize) -> bool,
) -> Vec<usize> {
    let far = list.iter().filter(|k| !changed.contains(k)).copied();
    let mut left: Vec<usize> = far.chain(changed.iter().copied().filter(holds)).collect();
    left.sort_unstable();
    left
}

impl Untangling<'_> {
    /// The vertices around which the winding of the map differs from that of the field.
    pub(super) fn winding_defects(&self) -> Result<Vec<usize>> {
        winding_defects(self.mesh, self.quarters, |face| self.uv(face))
    }

    fn faults(&self) -> Result<Faults> {
        Ok(Faults {
            folded: self.folded(),
            defects: self.winding_defects()?,
        })
    }

    /// Removes as many folds and winding defects at cones as it can in at most so many passes over the mesh.
    pub(super) fn unwind(&mut self, passes: usize, monitor: &mut Monitor) -> Result<()> {
        let whole = self.budget;
        self.budget = PASSES.min(passes) * self.mesh.face_count().max(LEAST_FACES);
        let share = self.budget / SHARE;
        let mut faults = self.faults()?;
        let mut left_behind = BTreeSet::new();
        let is_cone = |v: &usize| self.quarters[*v] != Some(4);
        for _ in 0..ROUNDS {
            let before = faults.clone();
            // Some folds cannot be removed. They come last, so that they do not take the work of the others.
            let at_defects: BTreeSet<usize> = before.defects.iter().copied().collect();
            let at_folds = before.vertices(self.mesh);
            let others = at_folds.difference(&at_defects);
            let cones: Vec<usize> = (at_defects.iter().chain(others).copied())
                .filter(is_cone)
                .collect();
            for (k, &cone) in cones.iter().enumerate() {
                if faults.vertices(self.mesh).contains(&cone) {
                    let fair = self.budget / (cones.len() - k);
                    self.within(fair, |this| {
                        this.unwind_cone(cone, share, &mut faults, &mut left_behind, monitor)
                    })?;
                }
            }
            if faults.count() == 0 || faults == before {
                break;
            }
        }
        self.budget = whole;
        Ok(())
    }

    /// Works with at most this part of the budget.
    fn within<T>(&mut self, most: usize, work: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        let for_others = self.budget.saturating_sub(most);
        self.budget -= for_others;
        let done = work(self);
        self.budget += for_others;
        done
    }

    /// Lays larger and larger disks around a cone out anew until fewer faults remain. Each may take this share of the
    /// work.
    ///
    /// If no disk reduces their number, the first one is kept that moves the defect to a cone that
    /// was not `left_behind` before: that cone may have more room around it.
    fn unwind_cone(
        &mut self,
        cone: usize,
        share: usize,
        faults: &mut Faults,
        left_behind: &mut BTreeSet<usize>,
        monitor: &mut Monitor,
    ) -> Result<()> {
        let mut instead = None;
        let mut faces = 0;
        for radius in RADII {
            let Some(disk) = self.disk(cone, radius).filter(|_| self.budget > 0) else {
                break;
            };
            if std::mem::replace(&mut faces, disk.faces.len()) == disk.faces.len() {
                continue;
            }
            if faces > MOST_FACES {
                break;
            }
            let Some(layout) = self.layout(&disk)? else {
                continue;
            };
            for first_eps in FIRST_EPS {
                let before = self.values.clone();
                let was_folded = self.within(share, |this| {
                    this.lay(&layout);
                    this.budget = this.budget.saturating_sub(faces);
                    this.untangle_disk(&disk, first_eps, monitor)
                })?;
                let left = self.faults_after_move(&before, faults);
                let now = std::mem::replace(&mut self.values, before);
                let folds_no_more = left.folded.len() <= faults.folded.len();
                if folds_no_more && left.count() < faults.count() {
                    (self.values, *faults) = (now, left);
                    return Ok(());
                }
                let is_too_small = left.folded.len() > faults.folded.len() + faces / LARGE_PART;
                let is_other = |v: &usize| !left_behind.contains(v);
                let moves = folds_no_more
                    && left.count() == faults.count()
                    && !left.defects.contains(&cone);
                if instead.is_none() && moves && left.defects.iter().all(is_other) {
                    instead = Some((now, left));
                }
                if !was_folded || is_too_small {
                    // Another eps changes nothing.
                    break;
                }
            }
        }
        if let Some((values, left)) = instead {
            left_behind.insert(cone);
            (self.values, *faults) = (values, left);
        }
        Ok(())
    }

    /// The faults after a move, given the values and the faults before it.
    fn faults_after_move(&self, before: &[f64], faults: &Faults) -> Faults {
        let first = &self.problem.sectors.first;
        let vertex = |i: usize| first.partition_point(|&copy| copy as usize <= i / 2) - 1;
        let both = self.values.iter().zip(before).enumerate();
        let moved: BTreeSet<usize> = both
            .filter(|(_, (x, y))| x != y)
            .map(|(i, _)| vertex(i))
            .collect();
        let around = moved.iter().flat_map(|&v| self.mesh.ring(v));
        let faces: BTreeSet<usize> = around.map(|(face, _)| face).collect();
        let corners = faces.iter().flat_map(|&face| self.mesh.corners(face));
        let near: BTreeSet<usize> = corners.collect();
        let is_folded = |face: &usize| orientation(self.uv(*face)) <= 0.0;
        let uv = |face| self.uv(face);
        let has_winding_defect = |v: &usize| has_winding_defect(self.mesh, self.quarters, uv, *v);
        Faults {
            folded: replaced(&faults.folded, &faces, is_folded),
            defects: replaced(&faults.defects, &near, has_winding_defect),
        }
    }

    /// The disk within `radius` of a cone in the map, without vertices that cannot move freely. Those are
    /// cones and vertices on the boundary or on features.
    fn disk(&self, cone: usize, radius: f64) -> Option<Disk> {
        let near = faces_within(self.mesh, cone, radius, &|face| self.uv(face));
        let is_fixed = |v: usize| {
            self.mesh.is_boundary_vertex(v) || self.freedom.of_copies(self.copies_of(v)).is_none()
        };
        Disk::around(self.mesh, cone, |face| {
            near.contains_key(&face) && !self.mesh.corners(face).into_iter().any(is_fixed)
        })
    }

    fn copies_of(&self, v: usize) -> std::ops::Range<u32> {
        self.problem.sectors.first[v]..self.problem.sectors.first[v + 1]
    }

    fn layout(&self, disk: &Disk) -> Result<Option<Layout>> {
        let quarters = self.quarters[disk.center].unwrap_or(4);
        Layout::new(self.mesh, disk, quarters, &|face| self.uv(face))
    }

    fn lay(&mut self, layout: &Layout) {
        for &(v, face, corner, to) in &layout.places {
            let copy = self.freedom.copies[face][corner];
            if let Some(unknowns) = self.freedom.of_copies(self.copies_of(v)) {
                self.freedom.put(copy, unknowns, to, &mut self.values);
            }
        }
    }

    /// Untangles a disk that was laid out anew, and returns whether it was folded.
    fn untangle_disk(
        &mut self,
        disk: &Disk,
        first_eps: f64,
        monitor: &mut Monitor,
    ) -> Result<bool> {
        let mut was_folded = false;
        for rings in RINGS {
            let is_folded = |&face: &usize| orientation(self.uv(face)) <= 0.0;
            let mut folded: Vec<usize> = disk.faces.iter().copied().filter(is_folded).collect();
            folded.sort_unstable();
            if folded.is_empty() {
                break;
            }
            was_folded = true;
            self.undo_folds(&regions(self.freedom, &folded, rings), first_eps, monitor)?;
        }
        Ok(was_folded)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{FieldOptions, solve_field};
    use crate::map::{SeamlessOptions, SeamlessProblem};
    use crate::mesh::{jitter, shape};
    use crate::search::Options;
    use crate::solve::solve;
    use crate::untangle::{Structure, UntangleOptions, untangle};

    #[test]
    fn a_disk_around_a_cone_is_laid_as_often_as_the_cone_asks_for() {
        let mesh = jitter(&shape::by_name("genus-2", 2000).unwrap(), 1e-3, 7).unwrap();
        let options = Options::default();
        let field = FieldOptions::default();
        let (field, _) = solve_field(&mesh, &field, &options, Monitor::default).unwrap();
        let problem = SeamlessProblem::new(&mesh, &field, &SeamlessOptions { quads: 300 }).unwrap();
        let map = problem.map(&mesh, &solve(problem.problem(), &options).unwrap());
        let effort = UntangleOptions::default();
        let map = untangle(
            &mesh,
            &problem,
            &map.unwrap(),
            &effort,
            &mut Monitor::default(),
        );
        let map = map.unwrap().map;
        assert!(map.flipped().is_empty());
        let watch = &mut Monitor::default();
        let structure = Structure::new(&mesh, &problem, &map, watch).unwrap();
        let mut laid = 0;
        for &cone in problem.cones() {
            let mut work = Untangling::new(&structure, &mesh, &problem, &map, &effort);
            let Some(disk) = work.disk(cone, 1.5).filter(|d| d.inside.len() > 5) else {
                continue;
            };
            let layout = work.layout(&disk).unwrap().unwrap();
            let (before, none) = (work.values.clone(), work.faults().unwrap());
            assert_eq!(none.count(), 0);
            // This removes the old shape: all inner vertices are put beside one point.
            let center = faces_within(&mesh, cone, 9.0, &|face| work.uv(face));
            let beside = |face: usize, v: usize| center[&face].map(|x| x + 1e-6 * v as f64);
            let places = layout.places.iter();
            let places = places.map(|&(v, face, corner, _)| (v, face, corner, beside(face, v)));
            work.lay(&Layout {
                places: places.collect(),
            });
            let crushed = work.folded().len();
            // The update from the moved faces alone agrees with a full computation.
            assert_eq!(
                work.faults_after_move(&before, &none),
                work.faults().unwrap()
            );
            let folds = work.values.clone();
            work.unwind(PASSES, watch).unwrap();
            let left = work.folded().len();
            assert!(4 * left < crushed, "{cone}: {left} of {crushed}");
            work.values = folds;
            work.lay(&layout);
            let folded = work.folded().len();
            assert!(4 * folded < crushed, "{cone}: {folded} of {crushed}");
            work.untangle_disk(&disk, 0.1, watch).unwrap();
            assert!(work.faults().unwrap() == none, "{cone}");
            assert_eq!(work.faults_after_move(&before, &none), none);
            // What did not move stays.
            let far = Faults {
                folded: vec![0],
                defects: vec![cone],
            };
            assert_eq!(work.faults_after_move(&work.values, &far), far);
            laid += 1;
        }
        assert!(laid > 3, "{laid}");
    }
}

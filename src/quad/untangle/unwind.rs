//! Vertices that a map without folds goes around once too often, mended.
//!
//! Undoing folds, a cone of -1/4 may come out a quarter turn wide, and a vertex beside it two whole
//! turns: no motion without folds leads out of it. A disk around both is laid anew in polar
//! coordinates, larger and larger ones, and what that folds is untangled again.

use super::Untangling;
use super::disk::Disk;
use super::polar::{Layout, faces_within};
use super::region::regions;
use crate::quad::check::orientation;
use crate::quad::check::turns_around;
use crate::{Monitor, Result};

/// How far around a cone, in units of the map, is laid anew, attempt after attempt.
const RADII: [f64; 12] = [0.5, 0.7, 1.0, 1.2, 1.4, 1.7, 2.0, 2.4, 2.8, 3.4, 4.0, 5.6];

/// How often all such cones are looked at: mending one may wind another up.
const ROUNDS: usize = 4;

/// How closed the barrier is at first: open, it undoes more folds; nearly closed, what the layout
/// unwound stays so.
const FIRST_EPS: [f64; 3] = [1.0, 0.1, 0.01];

/// How far around what that folds is worked on.
const RINGS: [usize; 3] = [2, 5, 12];

impl Untangling<'_> {
    /// The vertices that the map goes around another number of times than the field.
    pub(super) fn wound(&self) -> Vec<usize> {
        (0..self.mesh.vertex_count())
            .filter(|&v| self.is_wound(v))
            .collect()
    }

    fn is_wound(&self, v: usize) -> bool {
        let turns = || turns_around(self.mesh, |face| self.uv(face), v);
        self.quarters[v].is_some() && turns().is_some_and(|turns| Some(turns) != self.quarters[v])
    }

    /// Mends cones that are narrower than they should be, as far as it can.
    pub(super) fn unwind(
        &mut self,
        most_steps: usize,
        budget: &mut usize,
        monitor: &mut Monitor,
    ) -> Result<()> {
        let mut wound = self.wound();
        for _ in 0..ROUNDS {
            let before = wound.len();
            for cone in wound.clone() {
                if self.quarters[cone] != Some(4) && wound.contains(&cone) {
                    self.unwind_cone(cone, &mut wound, most_steps, budget, monitor)?;
                }
            }
            if wound.is_empty() || wound.len() == before {
                break;
            }
        }
        Ok(())
    }

    /// Lays larger and larger disks around a cone anew, until fewer vertices are `wound`.
    fn unwind_cone(
        &mut self,
        cone: usize,
        wound: &mut Vec<usize>,
        most_steps: usize,
        budget: &mut usize,
        monitor: &mut Monitor,
    ) -> Result<()> {
        let folded = self.folded().len();
        let mut before = 0;
        for radius in RADII {
            let near = faces_within(self.mesh, cone, radius, &|face| self.uv(face));
            let may_be_in = |face: usize| {
                let corners = self.mesh.corners(face);
                near.contains_key(&face) && !corners.into_iter().any(|v| self.is_fixed(v))
            };
            let disk = Disk::around(self.mesh, cone, may_be_in);
            if disk
                .as_ref()
                .is_some_and(|d| d.faces.len() == std::mem::replace(&mut before, d.faces.len()))
            {
                continue;
            }
            let Some(disk) = disk.filter(|_| *budget > 0) else {
                break;
            };
            let Some(layout) = self.layout(&disk)? else {
                continue;
            };
            for first_eps in FIRST_EPS {
                let before = self.values.clone();
                self.lay(&layout);
                self.unfold_disk(&disk, most_steps, first_eps, budget, monitor)?;
                if self.folded().len() <= folded {
                    let left = self.wound();
                    if left.len() < wound.len() {
                        *wound = left;
                        return Ok(());
                    }
                }
                self.values = before;
            }
        }
        Ok(())
    }

    /// Whether a vertex cannot go wherever one likes: on the boundary, a cone, on a feature.
    fn is_fixed(&self, v: usize) -> bool {
        self.mesh.is_boundary_vertex(v) || self.freedom.of_copies(self.copies_of(v)).is_none()
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

    fn unfold_disk(
        &mut self,
        disk: &Disk,
        most_steps: usize,
        first_eps: f64,
        budget: &mut usize,
        monitor: &mut Monitor,
    ) -> Result<()> {
        for rings in RINGS {
            let is_folded = |&face: &usize| orientation(self.uv(face)) <= 0.0;
            let mut folded: Vec<usize> = disk.faces.iter().copied().filter(is_folded).collect();
            folded.sort_unstable();
            if folded.is_empty() {
                break;
            }
            for region in regions(&self.freedom, &folded, rings) {
                self.unfold(&region, most_steps, first_eps, budget, monitor)?;
            }
        }
        Ok(())
    }
}

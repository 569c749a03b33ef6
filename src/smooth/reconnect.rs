//! Changes the connectivity around quads that no motion of their corners makes convex.
//!
//! Where three corners of a quad lie on one straight feature, the quad is flat wherever they slide, and where a map was
//! folded, thin quads are left. Three moves help (`tarini2010`): opposite corners of a quad become one vertex, a vertex
//! of two quads goes and makes them one, or the edge of two quads turns within their six corners. A move is made if the
//! quads there are better after it, once the vertices around it have moved.
//! Corners and edges on features and on the boundary stay, so that quads follow them as before.

use std::collections::BTreeSet;

use super::mend::{INVERTED, improve, quality};
use super::surface::{Bond, Surface};
use crate::error::Result;
use crate::extract::QuadMesh;
use crate::mesh::vector::Vec3;
use crate::monitor::{Monitor, may_continue};

/// Moves are tried for quads with a scaled Jacobian of less than this.
const FLAT: f64 = 0.1;

/// Quads around a move count by how much their scaled Jacobian is less than this.
const FAIR: f64 = 0.3;

/// The least improvement of that sum for which a move is made.
const GAIN: f64 = 0.1;

/// How often all vertices around a move are moved before it is judged.
const ROUNDS: usize = 4;

/// The most quads around a vertex that a move makes.
const MOST_AROUND: usize = 7;

/// Removes or turns flat quads of a conforming mesh, the worst first, until no move helps or the caller wants what there
/// is.
///
/// # Errors
/// [`Error::Cancelled`](crate::Error::Cancelled).
pub(super) fn reconnect(
    quads: &mut QuadMesh,
    surface: &mut Surface,
    monitor: &mut Monitor,
) -> Result<()> {
    let mut reconnect = Reconnect {
        is_gone: vec![false; quads.quads.len()],
        around: quads.around(),
        quads,
        surface,
    };
    while !monitor.finishes() && reconnect.move_some()? {}
    let is_gone = reconnect.is_gone;
    compact(quads, &is_gone);
    Ok(())
}

/// What a move of connectivity makes of the quads.
struct Rewritten {
    removed: Option<u32>,
    /// The vertex that goes.
    gone: Option<u32>,
    /// Quads that stay, and their new corners.
    changed: Vec<(u32, [u32; 4])>,
}

/// What there was before a move.
struct Before {
    removed: Option<u32>,
    changed: Vec<(u32, [u32; 4])>,
    places: Vec<(u32, Vec3)>,
}

struct Reconnect<'a> {
    quads: &'a mut QuadMesh,
    surface: &'a mut Surface,
    /// The quads at every vertex that are still there.
    around: Vec<Vec<u32>>,
    is_gone: Vec<bool>,
}

impl Reconnect<'_> {
    /// Makes a move for each quad that is flat, the worst first, if one helps. Returns whether one was made.
    fn move_some(&mut self) -> Result<bool> {
        let all = (0..self.is_gone.len()).filter(|&q| !self.is_gone[q]);
        let all = all.map(|q| (quality(self.quads, q), q as u32));
        let mut flat: Vec<(f64, u32)> = all.filter(|pair| pair.0 < FLAT).collect();
        flat.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut moves = false;
        for (_, quad) in flat {
            may_continue()?;
            moves |= self.move_best(quad);
        }
        Ok(moves)
    }

    /// Makes the best move for a quad, if it is still flat and one helps.
    fn move_best(&mut self, quad: u32) -> bool {
        let is_flat = !self.is_gone[quad as usize] && quality(self.quads, quad as usize) < FLAT;
        if !is_flat || self.surface.has_spent_its_work() {
            return false;
        }
        let mut best: Option<(f64, Rewritten)> = None;
        let merged = (0..4).filter_map(|k| self.merged(quad, k));
        let without = (0..4).filter_map(|k| self.without(quad, k));
        let turns = (0..8).filter_map(|k| self.turned_edge(quad, k / 2, k % 2 == 1));
        for rewritten in merged.chain(without).chain(turns).collect::<Vec<_>>() {
            let (gain, before) = self.make(&rewritten);
            self.undo(before);
            if gain > GAIN && best.as_ref().is_none_or(|(most, _)| gain > *most) {
                best = Some((gain, rewritten));
            }
        }
        if let Some((_, rewritten)) = &best {
            self.make(rewritten);
        }
        best.is_some()
    }

    /// The corner opposite to corner `k` of a quad becomes that corner.
    fn merged(&self, quad: u32, k: usize) -> Option<Rewritten> {
        let [kept, left, gone, right] = turned(self.quads.quads[quad as usize], k);
        let (of_kept, of_gone) = (self.neighbours(kept), self.neighbours(gone));
        let shared: Vec<u32> = of_kept.intersection(&of_gone).copied().collect();
        let is_disk = !of_kept.contains(&gone) && shared == [left.min(right), left.max(right)];
        let count = |v: u32| self.around[v as usize].len();
        let keeps_enough = [left, right].into_iter().all(|v| count(v) > self.least(v))
            && (self.least(kept)..=MOST_AROUND).contains(&(count(kept) + count(gone) - 2));
        if !self.is_free(gone) || !is_disk || !keeps_enough {
            return None;
        }
        let others = self.around[gone as usize].iter().filter(|&&q| q != quad);
        let with_kept = others.map(|&q| {
            let corners = self.quads.quads[q as usize];
            (q, corners.map(|v| if v == gone { kept } else { v }))
        });
        Some(Rewritten {
            removed: Some(quad),
            gone: Some(gone),
            changed: with_kept.collect(),
        })
    }

    /// Corner `k` of a quad, which has one other quad, goes, and both become one.
    fn without(&self, quad: u32, k: usize) -> Option<Rewritten> {
        let [gone, left, across, right] = turned(self.quads.quads[quad as usize], k);
        let &[a, b] = self.around[gone as usize].as_slice() else {
            return None;
        };
        let other = if a == quad { b } else { a };
        let corners = self.quads.quads[other as usize];
        let at = corners.iter().position(|&v| v == gone)?;
        let [_, next, beyond, last] = turned(corners, at);
        let is_doublet = [next, last] == [right, left] && beyond != across;
        let count = |v: u32| self.around[v as usize].len();
        let keeps_enough = [left, right].into_iter().all(|v| count(v) > self.least(v));
        (self.is_free(gone) && is_doublet && keeps_enough).then(|| Rewritten {
            removed: Some(quad),
            gone: Some(gone),
            changed: vec![(other, [left, across, right, beyond])],
        })
    }

    /// The edge from corner `k` on of a quad turns within the six corners of its two quads, by one corner or back.
    fn turned_edge(&self, quad: u32, k: usize, back: bool) -> Option<Rewritten> {
        let [start, end, c, d] = turned(self.quads.quads[quad as usize], k);
        let (other, [_, _, e, f]) = self.around[end as usize].iter().find_map(|&q| {
            let corners = self.quads.quads[q as usize];
            let at = corners.iter().position(|&v| v == end)?;
            (corners[(at + 1) % 4] == start).then(|| (q, turned(corners, at)))
        })?;
        let ring = BTreeSet::from([start, e, f, end, c, d]);
        let (from, to) = if back { (f, d) } else { (e, c) };
        let count = |v: u32| self.around[v as usize].len();
        let is_sound = ring.len() == 6
            && [start, end].into_iter().any(|v| self.is_free(v))
            && [start, end].into_iter().all(|v| count(v) > self.least(v))
            && [from, to].into_iter().all(|v| count(v) < MOST_AROUND)
            && !self.neighbours(from).contains(&to);
        let corners = match back {
            true => [[f, end, c, d], [d, start, e, f]],
            false => [[e, f, end, c], [c, d, start, e]],
        };
        is_sound.then(|| Rewritten {
            removed: None,
            gone: None,
            changed: [quad, other].into_iter().zip(corners).collect(),
        })
    }

    /// Whether a vertex is bound to nothing but the surface, and inside it.
    fn is_free(&self, v: u32) -> bool {
        self.surface.bonds[v as usize] == Bond::Surface && self.is_inside(v)
    }

    fn is_inside(&self, v: u32) -> bool {
        self.neighbours(v).len() == self.around[v as usize].len()
    }

    /// The least number of quads at a vertex: a doublet remains only where a feature makes it useful.
    fn least(&self, v: u32) -> usize {
        match self.is_inside(v) {
            false => 1,
            true if self.is_free(v) => 3,
            true => 2,
        }
    }

    fn neighbours(&self, v: u32) -> BTreeSet<u32> {
        let mut neighbours = BTreeSet::new();
        for &q in &self.around[v as usize] {
            let corners = self.quads.quads[q as usize];
            for k in (0..4).filter(|&k| corners[k] == v) {
                neighbours.extend([corners[(k + 1) % 4], corners[(k + 3) % 4]]);
            }
        }
        neighbours
    }

    /// Makes a move. Returns by how much the quads around it are better then.
    fn make(&mut self, rewritten: &Rewritten) -> (f64, Before) {
        let removed = rewritten.removed;
        let of_quad = |quad: u32| self.quads.quads[quad as usize];
        let known = rewritten.changed.iter().map(|&(q, _)| q);
        let vertices: BTreeSet<u32> = known.chain(removed).flat_map(of_quad).collect();
        let of_vertex = |v: &u32| self.around[*v as usize].iter().copied();
        let near: BTreeSet<u32> = vertices.iter().flat_map(of_vertex).collect();
        let vertices: BTreeSet<u32> = near.iter().copied().flat_map(of_quad).collect();
        let place = |&v: &u32| (v, self.quads.vertices[v as usize]);
        let before = Before {
            removed,
            changed: (rewritten.changed.iter())
                .map(|&(q, _)| (q, of_quad(q)))
                .collect(),
            places: vertices.iter().map(place).collect(),
        };
        let cost = self.cost(&near);
        if let Some(removed) = removed {
            self.leave(removed);
            self.is_gone[removed as usize] = true;
        }
        for &(quad, corners) in &rewritten.changed {
            self.leave(quad);
            self.enter(quad, corners);
        }
        for _ in 0..ROUNDS {
            let mut moves = false;
            for &v in vertices.iter().filter(|&&v| Some(v) != rewritten.gone) {
                let around = &self.around[v as usize];
                moves |= improve(self.quads, self.surface, v as usize, around);
            }
            if !moves {
                break;
            }
        }
        (cost - self.cost(&near), before)
    }

    fn undo(&mut self, before: Before) {
        for (quad, corners) in before.changed {
            self.leave(quad);
            self.enter(quad, corners);
        }
        if let Some(removed) = before.removed {
            self.is_gone[removed as usize] = false;
            self.enter(removed, self.quads.quads[removed as usize]);
        }
        for (v, place) in before.places {
            self.quads.vertices[v as usize] = place;
        }
    }

    /// Takes a quad from its corners.
    fn leave(&mut self, quad: u32) {
        for v in self.quads.quads[quad as usize] {
            self.around[v as usize].retain(|&q| q != quad);
        }
    }

    /// Gives a quad these corners.
    fn enter(&mut self, quad: u32, corners: [u32; 4]) {
        self.quads.quads[quad as usize] = corners;
        for v in corners {
            let around = &mut self.around[v as usize];
            let at = around.partition_point(|&q| q < quad);
            around.insert(at, quad);
        }
    }

    /// How far these quads are from fair ones.
    fn cost(&self, quads: &BTreeSet<u32>) -> f64 {
        let there = quads.iter().filter(|&&q| !self.is_gone[q as usize]);
        let lacks = |&q: &u32| match quality(self.quads, q as usize) {
            inverted if inverted <= INVERTED => 1.0 + FAIR,
            quality => (FAIR - quality).max(0.0),
        };
        there.map(lacks).sum()
    }
}

/// The corners of a quad from corner `k` on.
fn turned(corners: [u32; 4], k: usize) -> [u32; 4] {
    [0, 1, 2, 3].map(|i| corners[(k + i) % 4])
}

/// Leaves out the quads that are gone, and vertices without quads.
pub(super) fn compact(quads: &mut QuadMesh, is_gone: &[bool]) {
    if !is_gone.contains(&true) {
        return;
    }
    let mut there = is_gone.iter().map(|&gone| !gone);
    quads.quads.retain(|_| there.next().unwrap_or(true));
    let around = quads.around();
    let (mut number, mut count) = (Vec::with_capacity(around.len()), 0);
    for (v, around) in around.iter().enumerate() {
        number.push(count as u32);
        if !around.is_empty() {
            quads.vertices[count] = quads.vertices[v];
            quads.origins[count] = quads.origins[v];
            count += 1;
        }
    }
    quads.vertices.truncate(count);
    quads.origins.truncate(count);
    for quad in &mut quads.quads {
        *quad = quad.map(|v| number[v as usize]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extract::Origin;
    use crate::mesh::TriangleMesh;
    use crate::smooth::tests::grid;
    use crate::smooth::{QuadQuality, Shapes, SmoothOptions, smooth, smooth_to};

    fn add_vertex(quads: &mut QuadMesh, at: Vec3) -> u32 {
        quads.vertices.push(at);
        quads.origins.push(Origin::Middle);
        quads.vertices.len() as u32 - 1
    }

    /// What smoothing makes of quads, where it keeps connectivity and where it changes it.
    fn both(quads: &QuadMesh, mesh: &TriangleMesh) -> [QuadMesh; 2] {
        let options = SmoothOptions::default();
        let mut monitor = Monitor::default();
        let [mut kept, mut changed] = [quads.clone(), quads.clone()];
        smooth(&mut kept, mesh, &options, &mut monitor).unwrap();
        smooth_to(
            &mut changed,
            mesh,
            None,
            &options,
            Shapes::default(),
            &mut monitor,
        )
        .unwrap();
        assert_eq!(kept.quads, quads.quads);
        [kept, changed]
    }

    /// Whether these are the quads of the grid, with a scaled Jacobian of more than `quality`.
    fn is_grid(found: &QuadMesh, quality: f64) -> bool {
        let (grid, _) = grid();
        found.is_conforming()
            && found.origins.len() == found.vertices.len()
            && found.quads.len() == grid.quads.len()
            && found.figures() == grid.figures()
            && QuadQuality::new(found).scaled_jacobian_min > quality
    }

    #[test]
    fn a_quad_with_three_corners_on_a_straight_side_is_collapsed() {
        let (mut quads, mesh) = grid();
        // The middle of the lower side has two quads; a flat one parts them from it.
        let inside = add_vertex(&mut quads, [2.0, 0.3, 0.0]);
        for quad in &mut quads.quads {
            *quad = quad.map(|v| if v == 2 { inside } else { v });
        }
        quads.quads.push([1, 2, 3, inside]);
        assert!(quads.is_conforming());
        let [kept, changed] = both(&quads, &mesh);
        assert!(QuadQuality::new(&kept).scaled_jacobian_min < FLAT);
        assert!(is_grid(&changed, 0.9));
        assert_eq!(changed.vertices[2][1], 0.0);
    }

    #[test]
    fn a_vertex_of_two_quads_goes() {
        let (mut quads, mesh) = grid();
        let [a, b, c, d] = quads.quads[5];
        let inside = add_vertex(&mut quads, [1.5, 1.5, 0.0]);
        quads.quads[5] = [a, b, c, inside];
        quads.quads.push([a, inside, c, d]);
        assert!(quads.is_conforming());
        let [kept, changed] = both(&quads, &mesh);
        assert!(QuadQuality::new(&kept).scaled_jacobian_min < FLAT);
        assert!(is_grid(&changed, 0.9));
    }

    #[test]
    fn an_edge_turns_where_three_corners_lie_on_a_straight_side() {
        // Two quads of the lower side, from left to right, share the edge from its middle up.
        let [left, foot, right] = [1, 2, 3];
        let [above_left, above, above_right] = [6, 7, 8];
        let to_the_left = [
            [left, foot, right, above_left],
            [right, above_right, above, above_left],
        ];
        let to_the_right = [
            [left, foot, right, above_right],
            [left, above_right, above, above_left],
        ];
        for turned in [to_the_left, to_the_right] {
            let (mut quads, mesh) = grid();
            assert_eq!(quads.quads[1], [left, foot, above, above_left]);
            assert_eq!(quads.quads[2], [foot, right, above_right, above]);
            quads.quads[1..3].copy_from_slice(&turned);
            assert!(quads.is_conforming());
            let [kept, changed] = both(&quads, &mesh);
            assert!(QuadQuality::new(&kept).scaled_jacobian_min < FLAT);
            assert!(is_grid(&changed, FAIR));
        }
    }

    #[test]
    fn good_quads_stay_as_they_are() {
        let (quads, mesh) = grid();
        let [kept, changed] = both(&quads, &mesh);
        assert_eq!(kept, changed);
    }
}

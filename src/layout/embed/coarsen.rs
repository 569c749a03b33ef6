//! Vertices that splits have left behind are taken away again.
//!
//! Arcs that are laid again, or beside each other, refine the mesh where they run, and each would find twice as many
//! edges to cross as the one before. A vertex that is not needed is moved onto a neighbour, on its face or along its
//! edge of the original mesh, so that the surface stays as it is; one of an arc moves along the arc.

use super::surface::{NONE, Surface, next, previous};
use crate::layout::base_layout::reversed;
use crate::mesh::vector::{Vec3, cross, dot, norm, sub};

/// Triangles may become as flat as this, by their area over the square of their longest side, or as flat as those
/// around are already.
const FLAT: f64 = 0.02;

impl Surface {
    /// Takes vertices away that are no nodes and none of the mesh. Gives the new number of each vertex, [`NONE`] for
    /// those that are gone.
    pub fn coarsen(&mut self, nodes: &[u32]) -> Vec<u32> {
        let mut is_node = vec![false; self.positions.len()];
        nodes.iter().for_each(|&v| is_node[v as usize] = true);
        let mut open: Vec<u32> = (self.kept..self.positions.len() as u32).collect();
        while let Some(v) = open.pop() {
            if self.out[v as usize] == NONE || is_node[v as usize] {
                continue;
            }
            if let Some(half) = self.best_collapse(v) {
                let around: Vec<u32> = self.around(v).map(|half| self.tip(half)).collect();
                self.collapse(half);
                open.extend(around.into_iter().filter(|&w| w >= self.kept));
            }
        }
        self.close_gaps()
    }

    /// The half-edge along which a vertex is best moved onto its neighbour.
    fn best_collapse(&self, v: u32) -> Option<u32> {
        let fan: Vec<u32> = self.around(v).collect();
        if self.twin[fan[0] as usize] == NONE {
            return None;
        }
        let origin = |half: u32| self.origin[half as usize / 3];
        let is_on_edge = fan.iter().any(|&half| origin(half) != origin(fan[0]));
        let now = fan.iter().map(|&half| shape(self.corners(half / 3)));
        let least = now.fold(FLAT, f64::min);
        let mut best: Option<(f64, u32)> = None;
        for &half in &fan {
            let leaves_its_edge = is_on_edge && origin(half) == origin(self.twin[half as usize]);
            let leaves_its_arc = self.is_taken[v as usize] && self.dart[half as usize] == NONE;
            if leaves_its_edge || leaves_its_arc || !self.may_collapse(half, &fan) {
                continue;
            }
            let flattest = self.flattest(half, &fan);
            if flattest >= least && best.is_none_or(|(known, _)| flattest > known) {
                best = Some((flattest, half));
            }
        }
        best.map(|(_, half)| half)
    }

    /// Whether the surface stays a surface when the tail of a half-edge moves onto its tip.
    fn may_collapse(&self, half: u32, fan: &[u32]) -> bool {
        let (u, other) = (self.tip(half), self.twin[half as usize]);
        let opposite = [half, other].map(|h| self.tail(previous(h)));
        let is_free = |h: u32| self.dart[h as usize] == NONE;
        let become_one = [[next(half), previous(half)], [next(other), previous(other)]];
        if become_one
            .into_iter()
            .any(|[a, b]| !is_free(a) && !is_free(b))
        {
            return false;
        }
        let is_beside = |w: u32| fan.iter().any(|&h| self.tip(h) == w);
        let mut common = 0;
        for h in self.around(u) {
            common += usize::from(is_beside(self.tip(h)));
            // The last neighbour at the boundary has no half-edge from here.
            let last = previous(h);
            if self.twin[last as usize] == NONE {
                common += usize::from(is_beside(self.tail(last)));
            }
        }
        let stays_regular = |w: u32| {
            let is_boundary = self
                .around(w)
                .next()
                .is_some_and(|h| self.twin[h as usize] == NONE);
            is_boundary || self.around(w).nth(3).is_some()
        };
        common == 2 && opposite.into_iter().all(stays_regular)
    }

    /// The flattest triangle that moving the tail of a half-edge onto its tip leaves; below 0 if one is turned over.
    fn flattest(&self, half: u32, fan: &[u32]) -> f64 {
        let u = self.position(self.tip(half));
        let (left, right) = (half / 3, self.twin[half as usize] / 3);
        let others = fan.iter().filter(|&&h| h / 3 != left && h / 3 != right);
        let shapes = others.map(|&h| {
            let [v, w, x] = [h, next(h), previous(h)].map(|h| self.position(self.tail(h)));
            let normal = |a: Vec3| cross(sub(w, a), sub(x, a));
            match dot(normal(u), normal(v)) > 0.0 {
                true => shape([u, w, x]),
                false => -1.0,
            }
        });
        shapes.fold(f64::INFINITY, f64::min)
    }

    /// Moves the tail of a half-edge onto its tip; the two faces beside it vanish.
    fn collapse(&mut self, half: u32) {
        let (v, u, other) = (self.tail(half), self.tip(half), self.twin[half as usize]);
        let fan: Vec<u32> = self.around(v).collect();
        for &h in &fan {
            self.triangles[h as usize / 3][h as usize % 3] = u;
        }
        // Of each face that vanishes, the side that stays and the side of the vertex that moves become one.
        for (stays, moves) in [(next(half), previous(half)), (previous(other), next(other))] {
            let [far, near] = [stays, moves].map(|h| self.twin[h as usize]);
            self.twin[near as usize] = far;
            if self.dart[near as usize] == NONE {
                self.dart[near as usize] = self.dart[stays as usize];
            }
            if far != NONE {
                self.twin[far as usize] = near;
                self.dart[far as usize] = match self.dart[near as usize] {
                    NONE => NONE,
                    dart => reversed(dart),
                };
                self.note_corners(far / 3);
            }
        }
        for face in [half / 3, other / 3] {
            self.triangles[face as usize] = [NONE; 3];
        }
        self.out[v as usize] = NONE;
        for h in fan {
            if h / 3 != half / 3 && h / 3 != other / 3 {
                self.note_corners(h / 3);
            }
        }
    }

    /// Numbers the faces and vertices that are left.
    fn close_gaps(&mut self) -> Vec<u32> {
        let mut number = vec![NONE; self.positions.len()];
        let mut vertices = 0;
        for v in 0..self.positions.len() {
            if self.out[v] != NONE {
                number[v] = vertices as u32;
                self.positions[vertices] = self.positions[v];
                self.is_taken[vertices] = self.is_taken[v];
                vertices += 1;
            }
        }
        self.positions.truncate(vertices);
        self.is_taken.truncate(vertices);
        self.out = vec![NONE; vertices];
        let mut face_number = vec![NONE; self.triangles.len()];
        let mut faces = 0;
        for f in 0..self.triangles.len() {
            if self.triangles[f][0] != NONE {
                face_number[f] = faces as u32;
                faces += 1;
            }
        }
        for f in 0..self.triangles.len() {
            let to = face_number[f];
            if to == NONE {
                continue;
            }
            self.triangles[to as usize] = self.triangles[f].map(|v| number[v as usize]);
            self.origin[to as usize] = self.origin[f];
            for k in 0..3 {
                let (from, to) = (3 * f + k, 3 * to as usize + k);
                let across = self.twin[from];
                self.twin[to] = match across {
                    NONE => NONE,
                    half => 3 * face_number[half as usize / 3] + half % 3,
                };
                self.dart[to] = self.dart[from];
            }
            self.note_corners(to);
        }
        self.triangles.truncate(faces);
        self.origin.truncate(faces);
        self.twin.truncate(3 * faces);
        self.dart.truncate(3 * faces);
        number
    }
}

/// The area of a triangle over the square of its longest side.
fn shape([a, b, c]: [Vec3; 3]) -> f64 {
    let [ab, bc, ca] = [sub(b, a), sub(c, b), sub(a, c)];
    let longest = [ab, bc, ca]
        .map(|side| dot(side, side))
        .into_iter()
        .fold(0.0, f64::max);
    match longest > 0.0 {
        true => 0.5 * norm(cross(ab, ca)) / longest,
        false => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape::by_name;
    use crate::test_random::Random;

    fn area(surface: &Surface) -> f64 {
        let corners = surface
            .triangles
            .iter()
            .map(|t| t.map(|v| surface.position(v)));
        let areas = corners.map(|[a, b, c]| 0.5 * norm(cross(sub(b, a), sub(c, a))));
        areas.sum()
    }

    fn check(surface: &Surface) {
        for half in 0..surface.twin.len() as u32 {
            let twin = surface.twin[half as usize];
            assert_eq!(surface.twin[twin as usize], half);
            assert_eq!(surface.tail(half), surface.tip(twin));
        }
        for v in 0..surface.positions.len() as u32 {
            assert!(surface.around(v).all(|half| surface.tail(half) == v));
        }
    }

    #[test]
    fn splits_are_taken_back_and_the_surface_stays() {
        let mesh = by_name("sphere", 300).unwrap();
        let mut surface = Surface::new(&mesh);
        let mut random = Random::new(5);
        for _ in 0..1000 {
            let half = random.below(surface.twin.len()) as u32;
            if random.below(2) == 0 {
                surface.split_in_the_middle(half);
            } else {
                let [a, b, c] = surface.corners(half / 3);
                let middle = [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0);
                surface.split_face(half / 3, middle);
            }
        }
        let split = surface.positions.len();
        let number = surface.coarsen(&[]);
        check(&surface);
        let kept = mesh.vertex_count();
        assert!((0..kept).all(|v| number[v] == v as u32));
        assert_eq!(&surface.positions[..kept], mesh.vertices());
        let left = surface.positions.len() - kept;
        assert!(20 * left < split - kept, "{left} of {}", split - kept);
        assert!((area(&surface) - mesh.surface_area()).abs() < 1e-12);
    }

    #[test]
    fn arcs_keep_their_ends_and_lose_vertices_between() {
        let mesh = by_name("sphere", 300).unwrap();
        let mut surface = Surface::new(&mesh);
        let [from, to] = [surface.tail(0), surface.tip(0)];
        let middle = surface.split_in_the_middle(0);
        let half = surface.half_between(middle, to).unwrap();
        let quarter = surface.split_in_the_middle(half);
        for pair in [from, middle, quarter, to].windows(2) {
            surface.take_edge(pair[0], pair[1], 6);
        }
        let number = surface.clone().coarsen(&[from, quarter, to]);
        assert!(number[middle as usize] == NONE && number[quarter as usize] != NONE);
        let number = surface.coarsen(&[from, to]);
        check(&surface);
        assert!(number[middle as usize] == NONE && number[quarter as usize] == NONE);
        let half = surface.half_between(from, to).unwrap();
        assert_eq!(surface.dart[half as usize], 6);
        assert_eq!(surface.triangles.len(), mesh.face_count());
    }
}

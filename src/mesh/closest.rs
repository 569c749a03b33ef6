//! The closest point on a set of triangles, by a tree of bounding boxes.
//!
//! Boxes are halved at the median centroid along their longest side. A search visits nearer boxes first
//! and leaves out those farther away than the best point so far. The closest point on one triangle is
//! that of `ericson2005`, section 5.1.5, which holds for triangles that are segments as well.

use super::TriangleMesh;
use super::vector::{Vec3, add, dot, scale, sub};
use crate::monitor::{allowed_threads, both, is_wanted};

/// Triangles in boxes.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosestPoint {
    triangles: Vec<[Vec3; 3]>,
    /// Numbers of triangles, those of a box next to each other.
    order: Vec<u32>,
    boxes: Vec<Node>,
}

#[derive(Debug, Clone, PartialEq)]
struct Node {
    low: Vec3,
    high: Vec3,
    /// Range of `order`.
    first: u32,
    last: u32,
    /// The second half; the first is the next box. None in a leaf: 0.
    second: u32,
}

/// A box with at most this many triangles is not divided.
const LEAF: usize = 4;

/// The most boxes that are still to be visited at any time: one for each division on the way to a box, and the two of
/// the last. There are at most 32 divisions, because each halves the number of triangles, which is one of 32 bits.
const OPEN: usize = 34;

/// A half with fewer triangles is not worth a thread.
const LEAST: usize = 1 << 11;

/// Before the division of a box with as many triangles or more, the call is asked whether it ends.
const ASKED: usize = 1 << 12;

impl ClosestPoint {
    /// The tree of the faces of a mesh.
    pub fn new(mesh: &TriangleMesh) -> Self {
        Self::of_triangles(
            (0..mesh.face_count())
                .map(|f| mesh.corner_positions(f))
                .collect(),
        )
    }

    /// The tree of any triangles, those without area included.
    pub fn of_triangles(triangles: Vec<[Vec3; 3]>) -> Self {
        let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
        let boxes = match triangles.is_empty() {
            true => Vec::new(),
            false => boxes(&triangles, &mut order, 0),
        };
        ClosestPoint {
            triangles,
            order,
            boxes,
        }
    }

    /// The triangle with the point closest to `p`, and that point; none if there is no triangle.
    ///
    /// A `hint`, a triangle that may be near such as that of the last search, shortens the search.
    pub fn find(&self, p: Vec3, hint: Option<usize>) -> Option<(usize, Vec3)> {
        self.find_counted(p, hint, &mut 0)
    }

    /// As [`Self::find`]. Adds the number of triangles that were looked at to `work`.
    pub(crate) fn find_counted(
        &self,
        p: Vec3,
        hint: Option<usize>,
        work: &mut u64,
    ) -> Option<(usize, Vec3)> {
        let start = hint.unwrap_or(0);
        let first = (start, closest(*self.triangles.get(start)?, p));
        let least = squared(sub(first.1, p));
        self.search(p, Some(first), least, |_| true, work)
    }

    /// The closest of the triangles that are wanted, if one is less than `reach` away.
    pub(crate) fn find_wanted(
        &self,
        p: Vec3,
        reach: f64,
        is_wanted: impl Fn(usize) -> bool,
    ) -> Option<(usize, Vec3)> {
        self.search(p, None, reach * reach, is_wanted, &mut 0)
    }

    /// The best of the triangles that are wanted, where the best so far has the squared distance `least`.
    fn search(
        &self,
        p: Vec3,
        mut best: Option<(usize, Vec3)>,
        mut least: f64,
        is_wanted: impl Fn(usize) -> bool,
        work: &mut u64,
    ) -> Option<(usize, Vec3)> {
        // The boxes that are still to be visited, and how far away they are; the next one is the last.
        let mut open = [(0.0, 0u32); OPEN];
        let mut count = 0;
        if let Some(all) = self.boxes.first() {
            open[0] = (distance(all, p), 0);
            count = 1;
        }
        while count > 0 {
            count -= 1;
            let (away, node) = open[count];
            if away >= least {
                continue;
            }
            let bounds = &self.boxes[node as usize];
            if bounds.second == 0 {
                *work += u64::from(bounds.last - bounds.first);
                for &t in &self.order[bounds.first as usize..bounds.last as usize] {
                    let point = closest(self.triangles[t as usize], p);
                    let found = squared(sub(point, p));
                    if found < least && is_wanted(t as usize) {
                        (best, least) = (Some((t as usize, point)), found);
                    }
                }
                continue;
            }
            let halves = [node + 1, bounds.second];
            let [a, b] = halves.map(|half| (distance(&self.boxes[half as usize], p), half));
            let (near, far) = if a.0 < b.0 { (a, b) } else { (b, a) };
            for half in [far, near] {
                if half.0 < least {
                    open[count] = half;
                    count += 1;
                }
            }
        }
        best
    }
}

/// The boxes of the triangles `members`, from the largest one on, each first half before the second. `first` is the
/// place of the members in the order of all.
fn boxes(triangles: &[[Vec3; 3]], members: &mut [u32], first: usize) -> Vec<Node> {
    let mut boxes = Vec::with_capacity(members.len());
    append_boxes(&mut boxes, triangles, members, first);
    boxes
}

fn append_boxes(boxes: &mut Vec<Node>, triangles: &[[Vec3; 3]], members: &mut [u32], first: usize) {
    let corners = members.iter().flat_map(|&t| triangles[t as usize]);
    let [mut low, mut high] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for corner in corners {
        for axis in 0..3 {
            low[axis] = low[axis].min(corner[axis]);
            high[axis] = high[axis].max(corner[axis]);
        }
    }
    let node = boxes.len();
    boxes.push(Node {
        low,
        high,
        first: first as u32,
        last: (first + members.len()) as u32,
        second: 0,
    });
    // A call that ends needs no smaller boxes.
    if members.len() <= LEAF || members.len() >= ASKED && is_wanted().is_err() {
        return;
    }
    let size = sub(high, low);
    let longest = (1..3).fold(
        0,
        |best, axis| if size[axis] > size[best] { axis } else { best },
    );
    let center = |&t: &u32| {
        triangles[t as usize]
            .iter()
            .map(|p| p[longest])
            .sum::<f64>()
    };
    let middle = members.len() / 2;
    members.select_nth_unstable_by(middle, |a, b| {
        center(a).total_cmp(&center(b)).then(a.cmp(b))
    });
    let (one, other) = members.split_at_mut(middle);
    if other.len() < LEAST || allowed_threads() < 2 {
        append_boxes(boxes, triangles, one, first);
        boxes[node].second = boxes.len() as u32;
        append_boxes(boxes, triangles, other, first + middle);
        return;
    }
    let (one, other) = both(
        true,
        || self::boxes(triangles, one, first),
        || self::boxes(triangles, other, first + middle),
    );
    let moved = |by: usize| {
        move |mut inner: Node| {
            inner.second += if inner.second > 0 { by as u32 } else { 0 };
            inner
        }
    };
    boxes.extend(one.into_iter().map(moved(node + 1)));
    let second = boxes.len();
    boxes[node].second = second as u32;
    boxes.extend(other.into_iter().map(moved(second)));
}

fn squared(v: Vec3) -> f64 {
    dot(v, v)
}

/// Squared distance to a box.
fn distance(bounds: &Node, p: Vec3) -> f64 {
    let off = |axis: usize| {
        (bounds.low[axis] - p[axis])
            .max(p[axis] - bounds.high[axis])
            .max(0.0)
    };
    squared([off(0), off(1), off(2)])
}

/// The point of a segment that is closest to `p`.
pub(crate) fn closest_on_segment([a, b]: [Vec3; 2], p: Vec3) -> Vec3 {
    let along = sub(b, a);
    let whole = dot(along, along);
    let share = match whole > 0.0 {
        true => (dot(sub(p, a), along) / whole).clamp(0.0, 1.0),
        false => 0.0,
    };
    add(a, scale(along, share))
}

/// The point of a triangle that is closest to `p`.
pub(crate) fn closest([a, b, c]: [Vec3; 3], p: Vec3) -> Vec3 {
    let (ab, ac, ap) = (sub(b, a), sub(c, a), sub(p, a));
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = sub(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return add(a, scale(ab, d1 / (d1 - d3)));
    }
    let cp = sub(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return add(a, scale(ac, d2 / (d2 - d6)));
    }
    let va = d3 * d6 - d5 * d4;
    let (e, f) = (d4 - d3, d5 - d6);
    if va <= 0.0 && e >= 0.0 && f >= 0.0 {
        return add(b, scale(sub(c, b), e / (e + f)));
    }
    let sum = va + vb + vc;
    add(a, add(scale(ab, vb / sum), scale(ac, vc / sum)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape;
    use crate::monitor::{spawned, with_threads};

    #[test]
    fn the_tree_finds_what_a_search_of_all_triangles_finds() {
        let mesh = shape::by_name("genus-2", 600).unwrap();
        let tree = ClosestPoint::new(&mesh);
        let mut x = 0.37;
        for i in 0..200 {
            let p = [0; 3].map(|_| {
                x = (x * 977.13_f64).fract();
                6.0 * x - 3.0
            });
            let distance = |q: Vec3| squared(sub(q, p));
            let all =
                (0..mesh.face_count()).map(|f| distance(closest(mesh.corner_positions(f), p)));
            let least = all.fold(f64::INFINITY, f64::min);
            let (face, point) = tree.find(p, (i % 2 == 0).then_some(i)).unwrap();
            assert_eq!(distance(point), least);
            assert_eq!(closest(mesh.corner_positions(face), p), point);
            let is_wanted = |f: usize| f % 7 == i % 7;
            let wanted = (0..mesh.face_count()).filter(|&f| is_wanted(f));
            let of_wanted = wanted.map(|f| distance(closest(mesh.corner_positions(f), p)));
            let least = of_wanted.fold(f64::INFINITY, f64::min);
            let (face, point) = tree.find_wanted(p, 10.0, is_wanted).unwrap();
            assert_eq!((distance(point), face % 7), (least, i % 7));
            assert_eq!(tree.find_wanted(p, 0.99 * least.sqrt(), is_wanted), None);
        }
    }

    #[test]
    fn any_number_of_threads_builds_the_same_tree() {
        let mesh = shape::by_name("genus-2", 6 * LEAST).unwrap();
        let tree = |threads| with_threads(threads, || ClosestPoint::new(&mesh));
        let one = tree(1);
        assert_eq!(spawned(|| assert_eq!(tree(2), one)), 1);
        // Of the three threads, the first half has two.
        assert_eq!(spawned(|| assert_eq!(tree(3), one)), 2);
    }

    #[test]
    fn of_no_triangles_none_is_closest() {
        assert_eq!(
            ClosestPoint::of_triangles(Vec::new()).find([0.0; 3], None),
            None
        );
    }
}

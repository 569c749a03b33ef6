//! Step 7, first part: which two triangles stay together at an edge with more than two.
//!
//! Those pairs stay that fit best (`gueziec2001`), so that the fewest boundaries arise: pairs that run against
//! each other before pairs that do not, among these pairs that shared the edge before welding, among these
//! those with the smallest angle between their planes. Two sides of one triangle are the last to be paired.
//! At three and four triangles all pairings are compared, at more the best pair is taken first.

use super::edges::Edges;
use super::lists::NONE;
use super::surface::{Surface, next, previous, tail, tip};
use crate::linalg::vector::{Vec3, cross, dot, normalize, scale, sub};

/// Above this number of triangles at an edge, each is compared only with those next to it by angle.
const ALL_PAIRS: usize = 24;

/// The half-edges that lie on each edge.
pub(super) struct Pairs {
    /// The half-edge across every half-edge, or [`NONE`]. Both may run the same way.
    pub(super) twin: Vec<u32>,
    /// The edges with more than two half-edges.
    pub(super) crowded: Vec<Vec<u32>>,
}

/// Pairs the half-edges of edges that have two, and lists those of edges that have more.
pub(super) fn pair_simple(surface: &Surface) -> Pairs {
    let mut twin = vec![NONE; 3 * surface.triangles.len()];
    let mut crowded = Vec::new();
    let edges = Edges::of(surface.positions.len(), &surface.triangles);
    edges.each(|halves| match *halves {
        [h, g] => join(&mut twin, h, g),
        [_] => {}
        _ => crowded.push(halves.to_vec()),
    });
    Pairs { twin, crowded }
}

pub(super) fn join(twin: &mut [u32], h: u32, g: u32) {
    twin[h as usize] = g;
    twin[g as usize] = h;
}

/// Pairs the half-edges of crowded edges; `turned` says which triangles run the other way than given.
pub(super) fn pair_crowded(surface: &Surface, pairs: &mut Pairs, turned: &[bool]) {
    for halves in &pairs.crowded {
        let sides: Vec<_> = halves
            .iter()
            .map(|&h| Side::new(surface, h, turned[h as usize / 3]))
            .collect();
        for (i, j) in best_pairs(&sides) {
            join(&mut pairs.twin, halves[i], halves[j]);
        }
    }
}

/// A triangle at an edge.
struct Side {
    /// Whether it runs from the lower to the upper end.
    up: bool,
    /// The edge's ends before welding.
    before: [u32; 2],
    opposite: u32,
    /// The direction from the edge into the triangle, of length 1, and the triangle's normal.
    inwards: Vec3,
    normal: Vec3,
    /// The direction of the edge from its lower to its upper end.
    along: Vec3,
}

impl Side {
    fn new(surface: &Surface, h: u32, turned: bool) -> Side {
        let (from, to) = (tail(&surface.triangles, h), tip(&surface.triangles, h));
        let opposite = tail(&surface.triangles, previous(h));
        let up = (from < to) != turned;
        let mut before = [h, next(h)].map(|h| tail(&surface.before, h));
        if from > to {
            before.reverse();
        }
        let [low, high, apex] =
            [from.min(to), from.max(to), opposite].map(|v| surface.positions[v as usize]);
        let along = normalize(sub(high, low));
        let out = normalize(sub(apex, low));
        let inwards = normalize(sub(out, scale(along, dot(out, along))));
        let normal = scale(cross(along, inwards), if up { 1.0 } else { -1.0 });
        Side {
            up,
            before,
            opposite,
            inwards,
            normal,
            along,
        }
    }

    /// How badly two triangles fit: classes first, then the angle between their planes. At equal angles a
    /// convex edge is better, which parts solids that touch.
    fn cost(&self, other: &Side) -> f64 {
        let class = |bad: bool, weight: f64| if bad { weight } else { 0.0 };
        let angle = 1.0 + dot(self.inwards, other.inwards);
        let concave = dot(self.normal, other.inwards) > 0.0;
        class(self.opposite == other.opposite, 1e6)
            + class(self.up == other.up, 1e4)
            + class(self.before != other.before, 1e2)
            + angle
            + class(concave, 1e-6)
    }
}

/// As many disjoint pairs as there can be, as numbers of sides.
fn best_pairs(sides: &[Side]) -> Vec<(usize, usize)> {
    let cost = |i: usize, j: usize| sides[i].cost(&sides[j]);
    let best = |pairings: &[[(usize, usize); 2]], used: usize| {
        let total = |pairing: &[(usize, usize); 2]| -> f64 {
            pairing[..used].iter().map(|&(i, j)| cost(i, j)).sum()
        };
        let first = pairings[0];
        let better =
            |a: [(usize, usize); 2], b: &[(usize, usize); 2]| match total(b) < total(&a) - 1e-9 {
                true => *b,
                false => a,
            };
        pairings.iter().fold(first, better)[..used].to_vec()
    };
    match sides.len() {
        3 => best(&[[(0, 1); 2], [(0, 2); 2], [(1, 2); 2]], 1),
        4 => best(&[[(0, 1), (2, 3)], [(0, 2), (1, 3)], [(0, 3), (1, 2)]], 2),
        _ => greedy(sides),
    }
}

/// The best pair first.
fn greedy(sides: &[Side]) -> Vec<(usize, usize)> {
    let n = sides.len();
    let mut candidates: Vec<(f64, usize, usize)> = Vec::new();
    let mut add = |i: usize, j: usize| {
        let (i, j) = (i.min(j), i.max(j));
        candidates.push((sides[i].cost(&sides[j]), i, j));
    };
    if n <= ALL_PAIRS {
        for i in 0..n {
            for j in i + 1..n {
                add(i, j);
            }
        }
    } else {
        let order = by_angle(sides);
        for i in 0..n {
            for step in 1..=ALL_PAIRS / 2 {
                add(order[i], order[(i + step) % n]);
            }
        }
    }
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut free = vec![true; n];
    let mut pairs = Vec::new();
    let mut take = |i: usize, j: usize| {
        if free[i] && free[j] && i != j {
            free[i] = false;
            free[j] = false;
            pairs.push((i, j));
        }
    };
    for (_, i, j) in candidates {
        take(i, j);
    }
    let left: Vec<_> = (0..n).filter(|&i| free[i]).collect();
    pairs.extend(left.chunks_exact(2).map(|pair| (pair[0], pair[1])));
    pairs
}

/// The sides in their order around the edge.
fn by_angle(sides: &[Side]) -> Vec<usize> {
    let x = sides[0].inwards;
    let y = cross(sides[0].along, x);
    let angle = |i: usize| dot(sides[i].inwards, y).atan2(dot(sides[i].inwards, x));
    let mut order: Vec<usize> = (0..sides.len()).collect();
    order.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)).then(a.cmp(&b)));
    order
}

//! The entries of a list: enumeration of a patch's own charges for each pair of entries of its children.
//!
//! A pair of entries with energies that leave a rest below the threshold determines a target. The own
//! charges within the rest of it are enumerated (`schnorr1994`, section 2). Most pairs have none. A first
//! test in single precision, a few operations a pair, finds most of these: the distance of the target's
//! last coordinate from the nearest integer.

use super::list::Found;
use super::local::Local;
use super::watch::Watch;
use crate::monitor::{allowed_threads, in_parts};

/// The pairs tested at a time.
const BLOCK: usize = 256;

/// The pairs after which a chunk ends, times the square of the own charges. It ends after no fewer than the others.
const CHUNK: usize = 1 << 18;
const LEAST_CHUNK: usize = 1 << 12;

/// The most chunks that each thread computes before they are joined.
const AHEAD: usize = 8;

/// Why a list is not complete.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Overflow {
    /// It has too many entries, or takes too much work.
    Full,
    /// The search ends.
    Ended,
}

/// The entries of a child's list as targets: what they are worth, their energies, and by entry the images
/// of what it sends.
#[derive(Debug)]
pub(super) struct Targets {
    pub worth: Vec<f64>,
    pub energy: Vec<f64>,
    pub image: Vec<f64>,
}

/// Limits of an enumeration.
pub(super) struct Limits<'a> {
    pub entries: usize,
    /// Multiplications, about.
    pub work: u64,
    /// Hears the multiplications and the nodes, and says whether to end.
    pub watch: &'a mut dyn Watch,
}

impl Limits<'_> {
    /// Counts them. Returns whether to end.
    fn count(&mut self, work: u64, nodes: u64) -> bool {
        self.watch.visited(nodes);
        self.watch.ends(work)
    }
}

/// All entries with at most this energy, of pairs that are worth at most as much.
///
/// Pairs are divided into chunks by their number alone. Threads compute some chunks beyond those that have been
/// joined. A chunk that would exceed a limit is computed again with what the chunks before it have left, so that
/// work and nodes do not depend on the number of threads.
pub(super) fn join(
    local: &Local,
    targets: [&Targets; 2],
    threshold: f64,
    limits: &mut Limits,
) -> Result<Found, Overflow> {
    let pairs = Pairs {
        local,
        targets,
        threshold,
        most: limits.work,
        first_test: FirstTest::new(local, targets[0], targets[1]),
    };
    let (chunks, threads) = (pairs.chunks(), allowed_threads());
    let mut found = Found::default();
    let mut left = Left {
        entries: limits.entries,
        work: limits.work,
        nodes: limits.watch.nodes(),
    };
    let (mut first, mut window) = (0, 1);
    while first < chunks.len() {
        let ahead = &chunks[first..chunks.len().min(first + window)];
        let share = |k: usize| ahead.iter().skip(k).step_by(threads);
        let parts = in_parts(threads.min(ahead.len()), 1, |of_thread| {
            let compute = |chunk: &Chunk| pairs.join(chunk, left);
            of_thread
                .flat_map(|k| share(k).map(compute))
                .collect::<Vec<_>>()
        });
        let mut parts: Vec<_> = parts.into_iter().map(Vec::into_iter).collect();
        for (k, chunk) in ahead.iter().enumerate() {
            let mut joined = parts[k % threads].next().unwrap_or_default();
            if k > 0 && !left.covers(&joined) {
                joined = pairs.join(chunk, left);
            }
            let is_covered = left.covers(&joined);
            if limits.count(joined.work, joined.nodes) || joined.nodes >= left.nodes {
                return Err(Overflow::Ended);
            }
            if !is_covered {
                return Err(Overflow::Full);
            }
            left.entries -= joined.found.energy.len();
            left.work -= joined.work;
            left.nodes -= joined.nodes;
            found.extend(joined.found);
        }
        first += ahead.len();
        window = (2 * window).min(AHEAD * threads);
    }
    Ok(found)
}

/// Some first entries, each with the number of second entries that are worth a test.
struct Chunk {
    first: usize,
    ends: Vec<usize>,
}

/// What is left of the limits.
#[derive(Clone, Copy)]
struct Left {
    entries: usize,
    work: u64,
    nodes: u64,
}

impl Left {
    /// Whether a chunk exceeds nothing.
    fn covers(&self, joined: &Joined) -> bool {
        joined.found.energy.len() <= self.entries
            && joined.work <= self.work
            && joined.nodes < self.nodes
    }
}

/// The entries of a chunk, and what it took.
#[derive(Default)]
struct Joined {
    found: Found,
    work: u64,
    nodes: u64,
}

/// All pairs.
struct Pairs<'a> {
    local: &'a Local,
    targets: [&'a Targets; 2],
    threshold: f64,
    /// The most work of one walk.
    most: u64,
    first_test: FirstTest,
}

impl Pairs<'_> {
    /// The pairs that are worth a test.
    fn chunks(&self) -> Vec<Chunk> {
        let [a, b] = self.targets;
        let Some(&least) = b.worth.first() else {
            return Vec::new();
        };
        let mut chunks: Vec<Chunk> = Vec::new();
        let most = (CHUNK / self.local.own.pow(2).max(1)).max(LEAST_CHUNK);
        let (mut end, mut pairs) = (b.energy.len(), most);
        for (i, &worth) in a.worth.iter().enumerate() {
            let left = self.threshold - worth;
            if left < least {
                break;
            }
            while end > 0 && b.worth[end - 1] > left {
                end -= 1;
            }
            if pairs >= most {
                pairs = 0;
                let ends = Vec::new();
                chunks.push(Chunk { first: i, ends });
            }
            pairs += end;
            if let Some(chunk) = chunks.last_mut() {
                chunk.ends.push(end);
            }
        }
        chunks
    }

    /// The entries of a chunk, until a limit is exceeded.
    fn join(&self, chunk: &Chunk, left: Left) -> Joined {
        let ([a, b], n) = (self.targets, self.local.own);
        let mut joined = Joined::default();
        let mut walk = Walk::new(self.local, left.nodes);
        let mut passed = Vec::with_capacity(BLOCK);
        let mut base = vec![0.0; n];
        for (k, &end) in chunk.ends.iter().enumerate() {
            let i = chunk.first + k;
            let rest = self.threshold - a.energy[i];
            for (k, base) in base.iter_mut().enumerate() {
                *base = self.local.target[k] + a.image[i * n + k];
            }
            let mut from = 0;
            while from < end {
                let to = (from + BLOCK).min(end);
                passed.clear();
                self.first_test.pass(i, from..to, rest, &mut passed);
                joined.work += (to - from) as u64;
                for &j in &passed {
                    let j = j as usize;
                    let energy = a.energy[i] + b.energy[j];
                    let image = &b.image[j * n..(j + 1) * n];
                    let rest = self.threshold - energy;
                    let found = &mut joined.found;
                    joined.work += walk.run(&base, image, rest, self.most, &mut |z, distance| {
                        found.push(energy + distance, [i as u32, j as u32], z);
                        found.energy.len() <= left.entries
                    });
                    joined.nodes = left.nodes - walk.left;
                    if !left.covers(&joined) {
                        return joined;
                    }
                }
                from = to;
            }
        }
        joined
    }
}

/// The test of the last coordinates of pairs.
///
/// The last coordinate of `z` must lie within `sqrt(rest) / R_nn` of an integer plus the target's. The
/// fractional parts of the two entries' shares are kept in single precision. Their errors, and that of the
/// test, are covered by `slack`.
struct FirstTest {
    /// By entry: the fractional part of the share of the last coordinate.
    a: Vec<f32>,
    b: Vec<f32>,
    energy: Vec<f32>,
    /// The squared last diagonal entry of R.
    square: f32,
    least: f64,
    slack: f64,
}

impl FirstTest {
    fn new(local: &Local, a: &Targets, b: &Targets) -> Self {
        let n = local.own;
        let last = if n > 0 { local.r[n * n - 1] } else { 1.0 };
        let fraction = |x: f64| {
            let q = x / last;
            (q - q.round()) as f32
        };
        let shares = |t: &Targets, extra: f64| match n {
            0 => vec![0.0; t.energy.len()],
            _ => (0..t.energy.len())
                .map(|i| fraction(t.image[i * n + n - 1] + extra))
                .collect(),
        };
        let least = b.energy.iter().fold(f64::INFINITY, |m, &e| m.min(e));
        let most = b.energy.iter().fold(least, |m, &e| m.max(e)) - least;
        let square = if n > 0 { last * last } else { 0.0 };
        FirstTest {
            a: shares(a, 0.0),
            b: shares(b, local.target.last().copied().unwrap_or(0.0)),
            energy: b.energy.iter().map(|e| (e - least) as f32).collect(),
            square: square as f32,
            least,
            // Each quantity is rounded a few times at most, by 2^-24 of its size.
            slack: 16.0 * f64::from(f32::EPSILON) * (square + most),
        }
    }

    /// Adds the places in `range` of entries whose pair with entry `i` can have own charges.
    fn pass(&self, i: usize, range: std::ops::Range<usize>, left: f64, passed: &mut Vec<u32>) {
        let most = (left - self.least) * (1.0 + 1e-6) + self.slack;
        let (most, share, square) = (most as f32, self.a[i], self.square);
        let mut open = [false; BLOCK];
        let start = range.start;
        let (b, energy) = (&self.b[range.clone()], &self.energy[range]);
        for ((open, &b), &energy) in open.iter_mut().zip(b).zip(energy) {
            let sum = (share + b).abs();
            let distance = sum.min((1.0 - sum).abs());
            *open = distance * distance * square + energy <= most;
        }
        let count = b.len();
        for (k, _) in open[..count].iter().enumerate().filter(|(_, open)| **open) {
            passed.push((start + k) as u32);
        }
    }
}

/// A depth-first walk over the own charges near a target.
pub(super) struct Walk<'a> {
    local: &'a Local,
    z: Vec<f64>,
    centre: Vec<f64>,
    /// By level: the squared distance of the levels above, and the next step of the zigzag.
    distance: Vec<f64>,
    step: Vec<f64>,
    /// The nodes that may still be visited, now and at the last report.
    left: u64,
    left_before: u64,
}

impl<'a> Walk<'a> {
    /// A walk that visits up to `nodes` nodes.
    pub fn new(local: &'a Local, nodes: u64) -> Self {
        let n = local.own;
        Walk {
            local,
            z: vec![0.0; n],
            centre: vec![0.0; n],
            distance: vec![0.0; n + 1],
            step: vec![0.0; n],
            left: nodes,
            left_before: nodes,
        }
    }

    /// The nodes visited since the last call: candidates for one coordinate after those above it were
    /// decided, kept or not.
    pub fn take_nodes(&mut self) -> u64 {
        let before = std::mem::replace(&mut self.left_before, self.left);
        before - self.left
    }

    fn enter(&mut self, k: usize, y: f64) {
        let n = self.local.own;
        let row = &self.local.r[k * n..(k + 1) * n];
        let mut sum = y;
        for (r, z) in row[k + 1..].iter().zip(&self.z[k + 1..]) {
            sum -= r * z;
        }
        let centre = sum / row[k];
        self.centre[k] = centre;
        self.z[k] = centre.round();
        self.step[k] = if centre >= self.z[k] { 1.0 } else { -1.0 };
    }

    fn advance(&mut self, k: usize) {
        self.z[k] += self.step[k];
        self.step[k] = -self.step[k] - self.step[k].signum();
    }

    /// Calls `take` with all `z` with `|R z - y|^2 <= bound`, where y is the sum of `base` and `image`, until
    /// it returns false, the work exceeds `most`, or no nodes are left. Returns the work.
    pub fn run(
        &mut self,
        base: &[f64],
        image: &[f64],
        bound: f64,
        most: u64,
        take: &mut dyn FnMut(&[f64], f64) -> bool,
    ) -> u64 {
        let n = self.local.own;
        if n == 0 {
            take(&self.z, 0.0);
            return 1;
        }
        let mut work = 0;
        let mut k = n - 1;
        self.enter(k, base[k] + image[k]);
        loop {
            if self.left == 0 {
                return work;
            }
            self.left -= 1;
            let off = self.local.r[k * n + k] * (self.centre[k] - self.z[k]);
            let distance = self.distance[k + 1] + off * off;
            if distance <= bound {
                if k == 0 {
                    if !take(&self.z, distance) {
                        return work;
                    }
                    self.advance(0);
                    continue;
                }
                k -= 1;
                self.distance[k + 1] = distance;
                self.enter(k, base[k] + image[k]);
                work += (n - k) as u64 + 4;
                if work > most {
                    return work;
                }
            } else {
                k += 1;
                if k == n {
                    return work;
                }
                self.advance(k);
            }
        }
    }
}

/// All charges of a leaf with at most this energy.
pub(super) fn enumerate(
    local: &Local,
    threshold: f64,
    limits: &mut Limits,
) -> Result<Found, Overflow> {
    let mut found = Found::default();
    let mut walk = Walk::new(local, limits.watch.nodes());
    let none = vec![0.0; local.own];
    let (entries, most) = (limits.entries, limits.work);
    let work = walk.run(&local.target, &none, threshold, most, &mut |z, distance| {
        found.push(distance, [0, 0], z);
        found.energy.len() <= entries
    });
    let ended = limits.count(work, walk.take_nodes());
    match (
        ended || walk.left == 0,
        found.energy.len() > entries || work > most,
    ) {
        (true, _) => Err(Overflow::Ended),
        (_, true) => Err(Overflow::Full),
        _ => Ok(found),
    }
}

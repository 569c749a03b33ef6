//! A shallow tree of unknowns, in which neighbours are children of the heaviest among them.
//!
//! The unknowns are listed so that neighbours follow each other. The list is cut into pieces of [`PIECE`],
//! and the heaviest unknown of each piece becomes the parent of the others. The step is repeated with the
//! parents until one is left. This is the hierarchy of a Haar basis (`haar1910`), but with single unknowns in
//! place of averages, which keeps it sparse.

use super::unknowns::Unknowns;
use crate::error::Result;
use crate::linalg::Sparse;
use crate::monitor::Monitor;

/// The number of unknowns in a piece. Small pieces make the tree deep; large ones couple more unknowns.
const PIECE: usize = 4;

const NONE: u32 = u32::MAX;

/// A tree in which every unknown is at least as heavy as its children.
pub(super) struct Tree {
    /// All unknowns, children before parents.
    pub order: Vec<usize>,
    pub root: usize,
    first_child: Vec<u32>,
    next_sibling: Vec<u32>,
}

impl Tree {
    /// The tree of at least one member, from the members' places in the Hessian's graph and their weights.
    pub fn new(
        places: &[u32],
        weights: &[f64],
        hessian: &Sparse,
        monitor: &mut Monitor,
    ) -> Result<Self> {
        let mut heads = near_each_other(places, hessian, monitor)?;
        let mut tree = Tree {
            order: Vec::with_capacity(places.len()),
            root: 0,
            first_child: vec![NONE; places.len()],
            next_sibling: vec![NONE; places.len()],
        };
        while heads.len() > 1 {
            heads = heads
                .chunks(PIECE)
                .map(|piece| tree.join(piece, weights))
                .collect();
        }
        tree.root = heads[0];
        tree.order.push(tree.root);
        Ok(tree)
    }

    /// Makes the heaviest member of `piece` (ties to the first) the parent of the others, and returns it.
    fn join(&mut self, piece: &[usize], weights: &[f64]) -> usize {
        let heavier = |a: usize, &b: &usize| if weights[b] > weights[a] { b } else { a };
        let head = piece.iter().fold(piece[0], heavier);
        for &v in piece.iter().filter(|&&v| v != head) {
            self.next_sibling[v] = self.first_child[head];
            self.first_child[head] = v as u32;
            self.order.push(v);
        }
        head
    }

    pub fn children(&self, v: usize) -> impl Iterator<Item = usize> + '_ {
        let mut next = self.first_child[v];
        std::iter::from_fn(move || {
            let child = (next != NONE).then_some(next as usize)?;
            next = self.next_sibling[child];
            Some(child)
        })
    }
}

/// The members in an order in which near ones follow each other: the preorder of a breadth-first tree of the
/// Hessian's graph, one component after the other.
fn near_each_other(places: &[u32], lower: &Sparse, monitor: &mut Monitor) -> Result<Vec<usize>> {
    let upper = lower.transpose();
    let mut member = vec![NONE; lower.rows()];
    for (v, &place) in places.iter().enumerate() {
        if place != Unknowns::NOWHERE {
            member[place as usize] = v as u32;
        }
    }
    let mut seen = vec![false; places.len()];
    let mut parent = vec![NONE; places.len()];
    let mut queue = Vec::with_capacity(places.len());
    for root in 0..places.len() {
        if seen[root] {
            continue;
        }
        seen[root] = true;
        let mut next = queue.len();
        queue.push(root);
        while let Some(&v) = queue.get(next) {
            monitor.check()?;
            next += 1;
            if places[v] == Unknowns::NOWHERE {
                continue;
            }
            let place = places[v] as usize;
            for (j, _) in lower.row(place).chain(upper.row(place)) {
                let w = member[j];
                if w != NONE && !seen[w as usize] {
                    seen[w as usize] = true;
                    parent[w as usize] = v as u32;
                    queue.push(w as usize);
                }
            }
        }
    }
    // The place of a member in the preorder is that of its parent plus the sizes of the subtrees between
    // them.
    let mut size = vec![1usize; places.len()];
    for &v in queue.iter().rev() {
        if parent[v] != NONE {
            size[parent[v] as usize] += size[v];
        }
    }
    let mut order = vec![0; places.len()];
    let mut free = vec![0usize; places.len()];
    let mut free_root = 0;
    for &v in &queue {
        let start = match parent[v] {
            NONE => &mut free_root,
            p => &mut free[p as usize],
        };
        let at = *start;
        *start += size[v];
        free[v] = at + 1;
        order[at] = v;
    }
    Ok(order)
}

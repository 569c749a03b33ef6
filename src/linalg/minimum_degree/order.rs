//! The order of elimination that a quotient graph leads to: a post-order of its elements.

use super::super::ordering::{NONE, inverse, post_order};
use super::quotient_graph::{QuotientGraph, State};

impl QuotientGraph {
    /// The unknowns of every element after those of the elements that it absorbed, of which the one with the longest
    /// list comes last.
    pub fn order(self) -> Vec<u32> {
        let n = self.nodes.len();
        let is_element = |state: State| matches!(state, State::Element | State::Dead);
        let mut elements: Vec<u32> = (0..n as u32).collect();
        elements.retain(|&e| is_element(self.nodes[e as usize].state));
        elements.sort_by_key(|&e| self.nodes[e as usize].len);
        // The number of each element among these, and that of the element of each variable.
        let mut number = vec![NONE; n];
        for (k, &e) in elements.iter().enumerate() {
            number[e as usize] = k as u32;
        }
        for v in 0..n {
            let mut last = v;
            while number[last] == NONE && self.nodes[last].parent != NONE {
                last = self.nodes[last].parent as usize;
            }
            let element = number[last];
            // All that were passed belong to the same element.
            let mut passed = v;
            while number[passed] == NONE && self.nodes[passed].parent != NONE {
                number[passed] = element;
                passed = self.nodes[passed].parent as usize;
            }
        }
        let parents = elements
            .iter()
            .map(|&e| match self.nodes[e as usize].parent {
                NONE => NONE,
                parent => number[parent as usize],
            });
        let post = post_order(&parents.collect::<Vec<u32>>());
        let place = inverse(&post);
        // Counting sort by the place of the element; those without one are the dense variables.
        let place_of = |v: usize| match number[v] {
            NONE => place.len(),
            element => place[element as usize] as usize,
        };
        let mut next = vec![0usize; place.len() + 2];
        (0..n).for_each(|v| next[place_of(v) + 1] += 1);
        for k in 0..place.len() {
            next[k + 1] += next[k];
        }
        let mut order = vec![0; n];
        let is_pivot = |v: usize| is_element(self.nodes[v].state);
        // The pivot comes last among the unknowns that are eliminated with it.
        for v in (0..n)
            .filter(|&v| !is_pivot(v))
            .chain((0..n).filter(|&v| is_pivot(v)))
        {
            let next = &mut next[place_of(v)];
            order[*next] = v as u32;
            *next += 1;
        }
        order
    }
}

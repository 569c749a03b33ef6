//! Approximate minimum degree (`amestoy1996`): an order of elimination that keeps the factor sparse.
//!
//! The graph of what is left is kept as a quotient graph. An eliminated unknown becomes an *element*: the list of
//! the unknowns that its elimination connects. A *variable* has a list of elements and one of variables with which
//! it shares an entry of the matrix and no element. Variables that cannot be told apart are one, with a weight.
//! The degree of a variable is bounded from above (equation 4 of the paper), which costs less than counting.

#[cfg(test)]
mod tests;

use std::ops::Range;

use super::ordering::{NONE, inverse, post_order, too_many_entries};
use super::sparse::reserve;
use crate::error::Result;
use crate::monitor::is_wanted;

/// A variable with more neighbours than this many times the root of their number is eliminated last.
const DENSE: f64 = 10.0;

/// No variable with fewer neighbours is eliminated last.
const LEAST_DENSE: usize = 16;

/// The entries of lists that are read between two questions whether the order is still wanted: a millisecond or so.
const QUESTION: usize = 1 << 18;

/// The order of elimination of the symmetric matrix with this pattern: entry k is the unknown that is eliminated
/// k-th. The off-diagonal entries of row `i` of the lower triangle are among
/// `columns[offsets[i]..offsets[i + 1]]`. The order is a post-order of the assembly tree.
///
/// # Errors
/// [`OutOfMemory`](crate::Error::OutOfMemory), and the reason to end the current step.
pub(super) fn minimum_degree(offsets: &[usize], columns: &[u32]) -> Result<Vec<u32>> {
    let mut graph = QuotientGraph::new(offsets, columns)?;
    while graph.left > 0 {
        let pivot = graph.least_degree();
        graph.eliminate(pivot)?;
    }
    Ok(graph.order())
}

/// The quotient graph. Unknowns are variables until they are eliminated, absorbed by another variable, or an
/// element, or dead.
struct QuotientGraph {
    nodes: Vec<Node>,
    /// The lists of all nodes, and what is left of earlier ones.
    lists: Vec<u32>,
    /// A mark below this one is out of date.
    base: u64,
    /// The first variable of each degree. Variables of the same degree are a doubly linked list.
    first: Vec<u32>,
    /// No variable has a lower degree.
    least: usize,
    /// The first variable of each hash value.
    hashed: Vec<u32>,
    /// The weight of the variables that are not eliminated.
    left: u32,
    /// The length of `lists` from which on they are compacted.
    full: usize,
    /// The entries that were read since the last question whether the order is wanted.
    work: usize,
}

/// An unknown. What is read together is stored together.
#[derive(Debug, Clone)]
struct Node {
    /// The list begins here.
    start: u32,
    /// The number of its entries.
    len: u32,
    /// How many elements the list of a variable begins with.
    elements: u32,
    /// How many unknowns a variable stands for. 0 for all other nodes.
    weight: u32,
    /// The bound of a variable's degree; the weight of an element's variables.
    degree: u32,
    /// The last pivot whose element a variable belongs to.
    front: u32,
    /// Of an element: the base, and the weight of those of its variables which do not belong to the element of the
    /// pivot. In the comparison of variables, what a list contains.
    mark: u64,
    /// The next variable of the same degree, or of the same hash value.
    next: u32,
    /// The variable before it of the same degree, or the hash value.
    previous: u32,
    /// The variable or element that absorbed the node.
    parent: u32,
    state: State,
}

impl Default for Node {
    /// A variable without neighbours.
    fn default() -> Self {
        Node {
            start: 0,
            len: 0,
            elements: 0,
            weight: 1,
            degree: 0,
            front: NONE,
            mark: 0,
            next: NONE,
            previous: NONE,
            parent: NONE,
            state: State::Variable,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    /// A variable, or part of one.
    Variable,
    Element,
    /// An element that was absorbed, or that has no variables.
    Dead,
    /// Eliminated last.
    Dense,
}

impl QuotientGraph {
    fn new(offsets: &[usize], columns: &[u32]) -> Result<Self> {
        let n = offsets.len() - 1;
        let pairs = || {
            let row = |i: usize| columns[offsets[i]..offsets[i + 1]].iter();
            let pairs = move |i: usize| row(i).map(move |&j| [i, j as usize]);
            (0..n).flat_map(pairs).filter(|[i, j]| i != j)
        };
        let mut nodes = reserve(n)?;
        nodes.resize(n, Node::default());
        pairs().flatten().for_each(|v| nodes[v].len += 1);
        let mut entries = 0u32;
        for node in &mut nodes {
            (node.start, node.degree) = (entries, node.len);
            entries = entries.checked_add(node.len).ok_or_else(too_many_entries)?;
        }
        let entries = entries as usize;
        let full = entries + entries / 4 + n;
        let mut lists = reserve(full)?;
        lists.resize(entries, 0);
        // How much of each list is there.
        for [i, j] in pairs() {
            for (v, other) in [(i, j), (j, i)] {
                let node = &mut nodes[v];
                lists[(node.start + node.elements) as usize] = other as u32;
                node.elements += 1;
            }
        }
        let mut graph = QuotientGraph {
            nodes,
            lists,
            base: 1,
            first: vec![NONE; n + 1],
            least: 0,
            hashed: vec![NONE; n.next_power_of_two()],
            left: n as u32,
            full,
            work: entries,
        };
        let dense = LEAST_DENSE.max((DENSE * (n as f64).sqrt()) as usize) as u32;
        for v in 0..n as u32 {
            let node = &mut graph.nodes[v as usize];
            node.elements = 0;
            if node.len > dense {
                (node.state, node.weight) = (State::Dense, 0);
                graph.left -= 1;
            } else {
                graph.insert(v);
            }
        }
        Ok(graph)
    }

    fn node(&mut self, v: u32) -> &mut Node {
        &mut self.nodes[v as usize]
    }

    fn list(&self, v: u32) -> Range<usize> {
        let Node { start, len, .. } = self.nodes[v as usize];
        start as usize..(start + len) as usize
    }

    /// Adds a variable to those of its degree.
    fn insert(&mut self, v: u32) {
        let degree = self.node(v).degree as usize;
        let next = std::mem::replace(&mut self.first[degree], v);
        if next != NONE {
            self.node(next).previous = v;
        }
        (self.node(v).next, self.node(v).previous) = (next, NONE);
        self.least = self.least.min(degree);
    }

    /// Takes a variable from those of its degree.
    fn remove(&mut self, v: u32) {
        let &mut Node {
            degree,
            next,
            previous,
            ..
        } = self.node(v);
        if next != NONE {
            self.node(next).previous = previous;
        }
        if previous == NONE {
            self.first[degree as usize] = next;
        } else {
            self.node(previous).next = next;
        }
    }

    /// The variable of least degree.
    fn least_degree(&mut self) -> u32 {
        while self.first[self.least] == NONE {
            self.least += 1;
        }
        self.first[self.least]
    }

    /// Makes an element of a variable.
    fn eliminate(&mut self, pivot: u32) -> Result<()> {
        self.remove(pivot);
        let weight = std::mem::take(&mut self.node(pivot).weight);
        self.node(pivot).state = State::Element;
        self.left -= weight;
        let weight = self.connect(pivot)?;
        self.weigh_elements(pivot);
        let weight = self.update(pivot, weight);
        self.join_equal(pivot);
        self.finish(pivot, weight);
        if self.work > QUESTION {
            self.work = 0;
            is_wanted()?;
        }
        Ok(())
    }

    /// Makes the list of a new element: the variables of the pivot and of its elements, which it absorbs. Returns
    /// their weight.
    fn connect(&mut self, pivot: u32) -> Result<u32> {
        let own = self.list(pivot);
        let variables = own.start + self.node(pivot).elements as usize..own.end;
        let elements = own.start..variables.start;
        let element_len = |k: usize| self.nodes[self.lists[k] as usize].len as usize;
        let need = own.len() + elements.clone().map(element_len).sum::<usize>();
        if self.lists.len() + need > self.full {
            self.compact(need)?;
            return self.connect(pivot);
        }
        self.work += need;
        let begin = self.lists.len();
        let mut weight = 0;
        for k in elements {
            let element = self.lists[k];
            for k in self.list(element) {
                weight += self.join_front(pivot, self.lists[k]);
            }
            self.node(element).state = State::Dead;
            self.node(element).parent = pivot;
        }
        for k in variables {
            weight += self.join_front(pivot, self.lists[k]);
        }
        let len = (self.lists.len() - begin) as u32;
        (self.node(pivot).start, self.node(pivot).len) = (begin as u32, len);
        Ok(weight)
    }

    /// Adds a variable to the element of the pivot if it is not there, and returns its weight.
    fn join_front(&mut self, pivot: u32, variable: u32) -> u32 {
        let node = self.node(variable);
        if node.weight == 0 || node.front == pivot {
            return 0;
        }
        node.front = pivot;
        let weight = node.weight;
        self.lists.push(variable);
        self.remove(variable);
        weight
    }

    /// Drops what is left of earlier lists, so that there is room for so many entries.
    fn compact(&mut self, need: usize) -> Result<()> {
        let is_live = |v: &u32| match self.nodes[*v as usize].state {
            State::Variable => self.nodes[*v as usize].weight > 0,
            // The list of the pivot is still that of a variable.
            State::Element => true,
            State::Dead | State::Dense => false,
        };
        let live: Vec<u32> = (0..self.nodes.len() as u32).filter(is_live).collect();
        let entries: usize = live.iter().map(|&v| self.list(v).len()).sum();
        self.full = self.full.max(entries + entries / 4 + need);
        if self.full > u32::MAX as usize {
            return Err(too_many_entries());
        }
        let mut lists = reserve(self.full)?;
        for v in live {
            let list = self.list(v);
            self.node(v).start = lists.len() as u32;
            lists.extend_from_slice(&self.lists[list]);
        }
        self.work += entries;
        self.lists = lists;
        Ok(())
    }

    /// Finds, of every element that shares variables with that of the pivot, the weight of the other ones.
    fn weigh_elements(&mut self, pivot: u32) {
        for k in self.list(pivot) {
            let variable = self.lists[k];
            let (weight, elements) = (self.node(variable).weight, self.node(variable).elements);
            let start = self.list(variable).start;
            for k in start..start + elements as usize {
                let element = &mut self.nodes[self.lists[k] as usize];
                if element.state == State::Dead {
                    continue;
                }
                if element.mark < self.base {
                    element.mark = self.base + u64::from(element.degree);
                }
                element.mark -= u64::from(weight);
            }
            self.work += elements as usize;
        }
    }

    /// Brings the lists and degrees of the element's variables up to date. Those that have no other neighbours are
    /// eliminated with the pivot. Returns the weight of the rest.
    fn update(&mut self, pivot: u32, mut weight: u32) -> u32 {
        for k in self.list(pivot) {
            let variable = self.lists[k];
            let list = self.list(variable);
            self.work += list.len();
            let variables = list.start + self.node(variable).elements as usize;
            let (mut end, mut degree, mut hash) = (list.start, 0u64, u64::from(pivot));
            for k in list.start..variables {
                let element = self.lists[k];
                let node = &mut self.nodes[element as usize];
                if node.state == State::Dead {
                    continue;
                }
                let others = node.mark - self.base;
                if others == 0 {
                    // All its variables belong to the pivot's.
                    (node.state, node.parent) = (State::Dead, pivot);
                    continue;
                }
                degree += others;
                hash += u64::from(element);
                self.lists[end] = element;
                end += 1;
            }
            let kept = end;
            for k in variables..list.end {
                let other = self.lists[k];
                let node = &self.nodes[other as usize];
                if node.weight == 0 || node.front == pivot {
                    continue;
                }
                degree += u64::from(node.weight);
                hash += u64::from(other);
                self.lists[end] = other;
                end += 1;
            }
            let node = &mut self.nodes[variable as usize];
            if end == list.start {
                node.parent = pivot;
                let eliminated = std::mem::take(&mut node.weight);
                weight -= eliminated;
                self.left -= eliminated;
                continue;
            }
            // The variable had the pivot, or an element that the pivot absorbed, in its list, so there is room.
            self.lists[end] = self.lists[kept];
            self.lists[kept] = self.lists[list.start];
            self.lists[list.start] = pivot;
            node.elements = (kept - list.start) as u32 + 1;
            node.len = (end - list.start) as u32 + 1;
            node.degree = u64::from(node.degree).min(degree) as u32;
            // Their number is a power of two.
            let hash = hash as usize & (self.hashed.len() - 1);
            node.next = std::mem::replace(&mut self.hashed[hash], variable);
            node.previous = hash as u32;
        }
        // Marks of this pivot are below the next base.
        self.base += u64::from(u32::MAX);
        weight
    }

    /// Makes one variable of those of the element that have the same lists.
    fn join_equal(&mut self, pivot: u32) {
        for k in self.list(pivot) {
            let node = &self.nodes[self.lists[k] as usize];
            if node.weight == 0 {
                continue;
            }
            let mut first = std::mem::replace(&mut self.hashed[node.previous as usize], NONE);
            while first != NONE {
                self.join_to(first);
                first = self.node(first).next;
            }
        }
    }

    /// Joins to a variable those after it, of the same hash value, that have the same lists.
    fn join_to(&mut self, variable: u32) {
        if self.node(variable).next == NONE {
            return;
        }
        // The first element of all is the pivot.
        for k in self.list(variable).skip(1) {
            self.nodes[self.lists[k] as usize].mark = self.base;
        }
        let mut before = variable;
        while self.node(before).next != NONE {
            let other = self.node(before).next;
            let [one, two] = [variable, other].map(|v| &self.nodes[v as usize]);
            self.work += two.len as usize;
            let is_marked = |k: usize| self.nodes[self.lists[k] as usize].mark == self.base;
            if one.len == two.len
                && one.elements == two.elements
                && self.list(other).skip(1).all(is_marked)
            {
                let (weight, next) = (two.weight, two.next);
                self.node(variable).weight += weight;
                (self.node(other).weight, self.node(other).parent) = (0, variable);
                self.node(before).next = next;
            } else {
                before = other;
            }
        }
        self.base += 1;
    }

    /// Keeps what is left of the element's variables, with their new degrees.
    fn finish(&mut self, pivot: u32, weight: u32) {
        let list = self.list(pivot);
        let mut end = list.start;
        for k in list.clone() {
            let variable = self.lists[k];
            let left = self.left;
            let node = self.node(variable);
            if node.weight == 0 {
                continue;
            }
            let bound = u64::from(node.degree) + u64::from(weight - node.weight);
            node.degree = bound.min(u64::from(left - node.weight)) as u32;
            self.insert(variable);
            self.lists[end] = variable;
            end += 1;
        }
        self.lists.truncate(end);
        let node = self.node(pivot);
        (node.len, node.degree) = ((end - list.start) as u32, weight);
        if node.len == 0 {
            node.state = State::Dead;
        }
    }

    /// The unknowns of every element after those of the elements that it absorbed, of which the one with the longest
    /// list comes last.
    fn order(self) -> Vec<u32> {
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

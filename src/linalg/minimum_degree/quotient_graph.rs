//! The quotient graph of what is left to eliminate.
//!
//! An eliminated unknown becomes an *element*: the list of the unknowns that its elimination connects. A *variable* has
//! a list of elements and one of variables with which it shares an entry of the matrix and no element. Variables that
//! cannot be told apart are one, with a weight. The degree of a variable is bounded from above (equation 4 of
//! `amestoy1996`), which costs less than counting.

use std::ops::Range;

use super::super::ordering::{NONE, too_many_entries};
use super::super::sparse::reserve;
use super::Pattern;
use crate::error::Result;
use crate::monitor::{is_wanted, may_continue};

/// A variable with more neighbours than this many times the root of their number is eliminated last.
const DENSE: f64 = 10.0;

/// No variable with fewer neighbours is eliminated last.
const LEAST_DENSE: usize = 16;

/// The entries of lists that are read between two questions whether the order is still wanted: a millisecond or so.
const QUESTION: usize = 1 << 18;

/// The room that lists of so many entries get, so that they are seldom compacted.
fn with_room(entries: usize, nodes: usize) -> usize {
    entries + entries / 4 + nodes
}

/// The quotient graph. Unknowns are variables until they are eliminated, absorbed by another variable, or an
/// element, or dead.
pub(super) struct QuotientGraph {
    pub nodes: Vec<Node>,
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
pub(super) struct Node {
    /// The list begins here.
    start: u32,
    /// The number of its entries.
    pub len: u32,
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
    pub parent: u32,
    pub state: State,
    /// A variable with neighbours outside the graph, which is neither eliminated nor joined to another one.
    is_kept: bool,
}

impl Node {
    /// Whether its list is still read.
    fn is_live(&self) -> bool {
        match self.state {
            State::Variable => self.weight > 0,
            State::Element => true,
            State::Dead | State::Dense => false,
        }
    }
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
            is_kept: false,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// A variable, or part of one.
    Variable,
    Element,
    /// An element that was absorbed, or that has no variables.
    Dead,
    /// Eliminated last.
    Dense,
}

impl QuotientGraph {
    /// The graph of a part of the unknowns, numbered from 0 on. `outside` are all pairs of an unknown of the part, in
    /// order, and a neighbour outside of it.
    ///
    /// # Errors
    /// [`OutOfMemory`](crate::Error::OutOfMemory), and [`Overflow`](crate::Error::Overflow) for too many entries.
    pub fn new(pattern: Pattern, part: Range<usize>, outside: &[[u32; 2]]) -> Result<Self> {
        let n = part.len();
        let pairs = || pattern.pairs_within(part.clone());
        let mut nodes = reserve(n)?;
        nodes.resize(n, Node::default());
        pairs().flatten().for_each(|v| nodes[v].len += 1);
        may_continue()?;
        let mut entries = 0u32;
        for node in &mut nodes {
            (node.start, node.degree) = (entries, node.len);
            entries = entries.checked_add(node.len).ok_or_else(too_many_entries)?;
        }
        for &[v, _] in outside {
            let node = &mut nodes[v as usize - part.start];
            node.is_kept = true;
            node.degree += 1;
        }
        let entries = entries as usize;
        let mut lists = reserve(with_room(entries, n))?;
        lists.resize(entries, 0);
        // How much of each list is there.
        for [i, j] in pairs() {
            for (v, other) in [(i, j), (j, i)] {
                let node = &mut nodes[v];
                lists[(node.start + node.elements) as usize] = other as u32;
                node.elements += 1;
            }
        }
        may_continue()?;
        let dense = LEAST_DENSE.max((DENSE * (pattern.unknowns() as f64).sqrt()) as usize) as u32;
        for node in &mut nodes {
            node.elements = 0;
            if node.degree > dense {
                (node.state, node.weight) = (State::Dense, 0);
            }
        }
        Ok(Self::with(nodes, lists))
    }

    /// The graph of these nodes and lists.
    fn with(nodes: Vec<Node>, lists: Vec<u32>) -> Self {
        let n = nodes.len();
        let mut graph = QuotientGraph {
            base: 1,
            first: vec![NONE; n + 1],
            least: 0,
            hashed: vec![NONE; n.next_power_of_two()],
            left: 0,
            full: with_room(lists.len(), n),
            work: lists.len(),
            nodes,
            lists,
        };
        for v in 0..n as u32 {
            let &mut Node { state, weight, .. } = graph.node(v);
            if state == State::Variable && weight > 0 {
                graph.left += weight;
                graph.insert(v);
            }
        }
        graph
    }

    /// One graph of those of parts that follow each other, with the pairs of neighbours in different parts: each in
    /// both directions, in order.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn joined(graphs: Vec<Self>, between: &[[u32; 2]]) -> Result<Self> {
        let n = graphs.iter().map(|graph| graph.nodes.len()).sum();
        let entries: usize = graphs.iter().map(Self::live_entries).sum();
        let entries = entries + between.len();
        if with_room(entries, n) > u32::MAX as usize {
            return Err(too_many_entries());
        }
        let mut nodes = reserve(n)?;
        let mut lists = reserve(with_room(entries, n))?;
        let mut between = between;
        for graph in graphs {
            let first = nodes.len() as u32;
            let moved = |v: u32| if v == NONE { NONE } else { v + first };
            for (v, node) in graph.nodes.iter().enumerate() {
                let start = lists.len();
                if node.is_live() {
                    let list = &graph.lists[graph.list(v as u32)];
                    lists.extend(list.iter().map(|&other| other + first));
                }
                let own = between
                    .iter()
                    .take_while(|pair| pair[0] == v as u32 + first);
                let (own, rest) = between.split_at(own.count());
                lists.extend(own.iter().map(|pair| pair[1]));
                between = rest;
                let degree = match node.is_kept {
                    true => graph.degree_within(v as u32) + own.len() as u32,
                    false => node.degree,
                };
                nodes.push(Node {
                    start: start as u32,
                    len: (lists.len() - start) as u32,
                    degree,
                    front: NONE,
                    mark: 0,
                    parent: moved(node.parent),
                    is_kept: false,
                    ..node.clone()
                });
            }
        }
        Ok(Self::with(nodes, lists))
    }

    /// Eliminates the variables whose degree is at most this.
    ///
    /// # Errors
    /// [`OutOfMemory`](crate::Error::OutOfMemory), and the reason to end the current step.
    pub fn eliminate_up_to(&mut self, most: usize) -> Result<()> {
        while let Some(pivot) = self.least_degree(most) {
            self.eliminate(pivot)?;
        }
        Ok(())
    }

    /// A bound of the degree of a variable, from its list.
    fn degree_within(&self, variable: u32) -> u32 {
        let list = self.lists[self.list(variable)].iter();
        let (mut degree, mut elements) = (0, self.nodes[variable as usize].elements);
        for &other in list {
            let node = &self.nodes[other as usize];
            degree += match (elements > 0, node.state) {
                (true, State::Element) => node.degree - self.nodes[variable as usize].weight,
                (true, _) => 0,
                (false, _) => node.weight,
            };
            elements = elements.saturating_sub(1);
        }
        degree
    }

    /// The entries of the lists that are still read.
    fn live_entries(&self) -> usize {
        let live = self.nodes.iter().filter(|node| node.is_live());
        live.map(|node| node.len as usize).sum()
    }

    fn node(&mut self, v: u32) -> &mut Node {
        &mut self.nodes[v as usize]
    }

    fn list(&self, v: u32) -> Range<usize> {
        let Node { start, len, .. } = self.nodes[v as usize];
        start as usize..(start + len) as usize
    }

    /// Adds a variable to those of its degree, unless it is kept.
    fn insert(&mut self, v: u32) {
        if self.node(v).is_kept {
            return;
        }
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
            is_kept,
            ..
        } = self.node(v);
        if is_kept {
            return;
        }
        if next != NONE {
            self.node(next).previous = previous;
        }
        if previous == NONE {
            self.first[degree as usize] = next;
        } else {
            self.node(previous).next = next;
        }
    }

    /// The variable of least degree, if that is at most `most`.
    fn least_degree(&mut self, most: usize) -> Option<u32> {
        let end = self.first.len().min(most.saturating_add(1));
        while self.least < end {
            match self.first[self.least] {
                NONE => self.least += 1,
                pivot => return Some(pivot),
            }
        }
        None
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
        // The list of the pivot is still that of a variable.
        let is_live = |v: &u32| self.nodes[*v as usize].is_live();
        let live: Vec<u32> = (0..self.nodes.len() as u32).filter(is_live).collect();
        let entries = self.live_entries();
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
            if end == list.start && !node.is_kept {
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
            if node.is_kept {
                node.previous = 0;
                continue;
            }
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
}

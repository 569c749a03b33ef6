//! Conversion of the caller's hinted cycles, which are lists of least-squares rows, to cycles of edges.
//!
//! A row with a local integer corresponds to that integer's edge. Any other row corresponds to the edge
//! without an integer between the same two nodes. A row between known angles has no edge. A hinted cycle is
//! ignored if one of its rows corresponds to no edge, or if it passes the ground more than once.

use super::cycles::Cycles;
use super::detect::AngleSystem;
use super::graph::NONE;
use crate::eliminate::ReducedModel;
use crate::problem::Model;

/// The reduced form of one of the caller's unknowns.
#[derive(Clone, Copy)]
enum Became {
    Known,
    Node(u32),
    Integer(u32),
    Other,
}

/// The hinted cycles of `model`, in the edges of `system`.
pub(super) fn hinted_cycles(model: &Model, reduced: &ReducedModel, system: &AngleSystem) -> Cycles {
    let mut cycles = Cycles::new();
    // A small component of a model has no expansion.
    if model.cycles().is_empty() || reduced.expansion().matrix().rows() == 0 {
        return cycles;
    }
    let became = became(reduced);
    let lookup = Lookup::new(system);
    let (rows, _) = model.least_squares();
    let mut closing = vec![0i32; system.graph.nodes()];
    for k in 0..model.cycles().len() {
        let mut cycle = Vec::new();
        let understood =
            model
                .cycles()
                .cycle(k)
                .all(|(row, sign)| match lookup.edge(rows.row(row), &became) {
                    Row::Edge(e, along) => {
                        cycle.push((e, if sign > 0.0 { along } else { -along }));
                        true
                    }
                    Row::Known => true,
                    Row::Other => false,
                });
        if understood && closes(system, &cycle, &mut closing) {
            cycles.push(cycle.into_iter());
        }
    }
    cycles
}

fn became(reduced: &ReducedModel) -> Vec<Became> {
    let mut of_reduced = vec![Became::Other; reduced.dim()];
    for (k, &i) in reduced.continuous().iter().enumerate() {
        of_reduced[i as usize] = Became::Node(k as u32);
    }
    for (k, &i) in reduced.integers().iter().enumerate() {
        of_reduced[i as usize] = Became::Integer(k as u32);
    }
    let expansion = reduced.expansion().matrix();
    let row = |i: usize| {
        let mut row = expansion.row(i);
        match (row.next(), row.next()) {
            (None, _) => Became::Known,
            (Some((y, 1.0)), None) => of_reduced[y],
            _ => Became::Other,
        }
    };
    (0..expansion.rows()).map(row).collect()
}

/// The role of a least-squares row.
enum Row {
    /// An edge, with 1 if the row runs from tail to head and -1 if it runs backwards.
    Edge(u32, i8),
    Known,
    Other,
}

struct Lookup<'s> {
    system: &'s AngleSystem,
    of_integer: Vec<u32>,
    /// Edges without an integer, by their nodes.
    plain: Vec<(u32, u32, u32)>,
}

impl<'s> Lookup<'s> {
    fn new(system: &'s AngleSystem) -> Self {
        let mut of_integer = vec![NONE; system.sign.len()];
        let mut plain = Vec::new();
        for (e, edge) in system.graph.edges.iter().enumerate() {
            match edge.integer {
                NONE => plain.push((edge.tail, edge.head, e as u32)),
                p => of_integer[p as usize] = e as u32,
            }
        }
        plain.sort_unstable();
        Lookup {
            system,
            of_integer,
            plain,
        }
    }

    fn edge(&self, row: impl Iterator<Item = (usize, f64)>, became: &[Became]) -> Row {
        let mut nodes = Vec::with_capacity(2);
        let mut found = None;
        for (i, a) in row.filter(|&(_, a)| a != 0.0) {
            match became[i] {
                Became::Known => {}
                Became::Node(node) => nodes.push((node, a)),
                Became::Integer(p) => found = Some(self.of_integer[p as usize]),
                Became::Other => return Row::Other,
            }
        }
        let (e, tail, head) = match (found, &nodes[..]) {
            (None | Some(NONE), []) => return Row::Known,
            (Some(e), _) if e != NONE => {
                let edge = &self.system.graph.edges[e as usize];
                (e, edge.tail, edge.head)
            }
            (None, &[(a, _)]) => self.plain(a, self.system.graph.ground()),
            (None, &[(a, _), (b, _)]) => self.plain(a.max(b), a.min(b)),
            _ => return Row::Other,
        };
        let ground = self.system.graph.ground();
        let at_tail = nodes.iter().find(|n| n.0 == tail);
        let others = nodes.iter().filter(|n| n.0 != tail && n.0 != head).count();
        match at_tail {
            Some(&(_, a))
                if e != NONE && others == 0 && nodes.len() == 1 + usize::from(head != ground) =>
            {
                Row::Edge(e, if a > 0.0 { 1 } else { -1 })
            }
            _ => Row::Other,
        }
    }

    /// The edge without an integer between two nodes, or [`NONE`].
    fn plain(&self, tail: u32, head: u32) -> (u32, u32, u32) {
        let at = self
            .plain
            .partition_point(|&(a, b, _)| (a, b) < (tail, head));
        match self.plain.get(at) {
            Some(&(a, b, e)) if (a, b) == (tail, head) => (e, tail, head),
            _ => (NONE, tail, head),
        }
    }
}

/// Whether the edges form a closed walk that passes the ground at most once.
fn closes(system: &AngleSystem, cycle: &[(u32, i8)], closing: &mut [i32]) -> bool {
    let graph = &system.graph;
    let mut grounded = 0;
    for &(e, sign) in cycle {
        let edge = &graph.edges[e as usize];
        closing[edge.tail as usize] += i32::from(sign);
        closing[edge.head as usize] -= i32::from(sign);
        grounded += usize::from(edge.head == graph.ground());
    }
    let mut closed = !cycle.is_empty() && grounded <= 2;
    for &(e, _) in cycle {
        let edge = &graph.edges[e as usize];
        for node in [edge.tail, edge.head] {
            closed &= std::mem::take(&mut closing[node as usize]) == 0;
        }
    }
    closed
}

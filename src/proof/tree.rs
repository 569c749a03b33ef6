//! The tree of a part, node by node.

use std::rc::Rc;

use super::estimate::Floats;
use super::exact::Exact;
use super::fault::{Checked, FaultKind, wrong};
use super::format::{End, Node, Step};
use super::held::Held;
use super::minorant::{Minorant, Open, PartObjective};
use super::problem::{ExactProblem, Limits, Side};
use super::steps::take;

/// A node that is still to come.
struct Waiting {
    /// The replacements of bounds that hold there.
    mark: usize,
    branch: Option<(usize, Side, Exact)>,
    /// The nearest certificate above.
    held: Option<Rc<Held>>,
}

/// The check of a tree: the nodes come in preorder.
pub(super) struct Tree<'a> {
    part: &'a PartObjective,
    floats: Floats,
    /// What each leaf must prove. Nothing if all must be empty.
    bound: Option<Exact>,
    /// The nodes still to come, the next one last.
    waiting: Vec<Waiting>,
    mark: usize,
}

impl<'a> Tree<'a> {
    pub fn new(part: &'a PartObjective, bound: Option<Exact>, limits: &Limits) -> Self {
        let mark = limits.mark();
        Tree {
            part,
            floats: Floats::of(part),
            bound,
            waiting: vec![Waiting {
                mark,
                branch: None,
                held: None,
            }],
            mark,
        }
    }

    /// The number of nodes that are known to come.
    pub fn wanted(&self) -> usize {
        self.waiting.len()
    }

    /// Checks the next node. After the last one, the limits are those before the first one.
    ///
    /// # Errors
    /// Whatever is wrong with the node.
    pub fn visit(
        &mut self,
        problem: &mut ExactProblem,
        limits: &mut Limits,
        node: &Node,
    ) -> Checked<()> {
        let Some(next) = self.waiting.pop() else {
            return wrong(FaultKind::Branch, "the tree has no more nodes");
        };
        limits.go_back(next.mark);
        if let Some((unknown, side, to)) = next.branch {
            limits.tighten(problem, unknown, side, to);
        }
        for &step in &node.steps {
            take_in_tree(problem, limits, step)?;
        }
        let held = match &node.certificate {
            None => next.held,
            Some(own) => {
                let own = own.clone();
                Some(Rc::new(Held::of(problem, self.part, &self.floats, own)))
            }
        };
        match &node.end {
            End::Branch(unknown, at) => self.branch(problem, limits, (*unknown, *at), held)?,
            End::Bound => self.check_bound(problem, limits, held.as_deref())?,
            End::Empty(multipliers) => {
                let rows = Minorant::of_rows(problem, limits, self.part, multipliers)?;
                let is_empty = limits.are_empty()
                    || rows
                        .least(limits, self.part)
                        .is_ok_and(|least| least.sign().is_gt());
                if !is_empty {
                    return wrong(FaultKind::NotEmpty, "this leaf is not shown to be empty");
                }
            }
        }
        if self.waiting.is_empty() {
            limits.go_back(self.mark);
        }
        Ok(())
    }

    fn branch(
        &mut self,
        problem: &ExactProblem,
        limits: &Limits,
        (unknown, at): (u32, f64),
        held: Option<Rc<Held>>,
    ) -> Checked<()> {
        let unknown = unknown as usize;
        match problem.integer.get(unknown) {
            None => {
                let text = format!("there is no unknown {unknown}");
                return wrong(FaultKind::Reference, text);
            }
            Some(false) => {
                let text = format!("a branch on x{unknown}, which is not an integer");
                return wrong(FaultKind::Branch, text);
            }
            Some(true) => {}
        }
        let ends = Exact::of(at).zip(Exact::of(1.0));
        let Some((at, one)) = ends.filter(|(at, _)| at.is_integer()) else {
            let text = format!("a branch at {at}, which is no integer");
            return wrong(FaultKind::Branch, text);
        };
        let mark = limits.mark();
        let next = &at + &one;
        for (side, to) in [(Side::Lower, next), (Side::Upper, at)] {
            self.waiting.push(Waiting {
                mark,
                branch: Some((unknown, side, to)),
                held: held.clone(),
            });
        }
        Ok(())
    }

    fn check_bound(
        &self,
        problem: &ExactProblem,
        limits: &Limits,
        held: Option<&Held>,
    ) -> Checked<()> {
        let Some(bound) = &self.bound else {
            let text = "a leaf that is not empty, in a part that is said to have no point";
            return wrong(FaultKind::NotEmpty, text);
        };
        let Some(held) = held else {
            return wrong(FaultKind::Certificate, "no certificate bounds this leaf");
        };
        if held.reaches(bound, limits, self.part, &self.floats) {
            return Ok(());
        }
        let minorant = held.exact(problem, limits, self.part)?;
        match minorant.least(limits, self.part) {
            Ok(least) if least >= *bound => Ok(()),
            Ok(least) => {
                let (least, bound) = (least.below(), bound.below());
                let text = format!("the certificate proves {least}, and the part claims {bound}");
                wrong(FaultKind::Bound, text)
            }
            Err(Open(unknown)) => {
                let text = format!("the certificate's bound falls for ever along x{unknown}");
                wrong(FaultKind::Bound, text)
            }
        }
    }
}

/// Takes a step below the root. Sides of rows belong to the root, as nothing takes them back.
///
/// # Errors
/// Those of [`take`], and [`FaultKind::Step`] for a side of a row.
pub(super) fn take_in_tree(
    problem: &mut ExactProblem,
    limits: &mut Limits,
    step: Step,
) -> Checked<()> {
    if matches!(step, Step::RowLower(..) | Step::RowUpper(..)) {
        let text = "a side of a row changes within a tree";
        return wrong(FaultKind::Step, text);
    }
    take(problem, limits, step)
}

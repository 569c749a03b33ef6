//! Maps of few quads that follow the lines of given quads.
//!
//! The field of the quads prescribes their irregular vertices. An integer-grid map that follows it with larger
//! squares has the same ones, and fewer lines between them: lines that run side by side fall on one, at the price
//! of a drift across the lines of the quads. `bommes2011` moves lines together one after the other, and
//! `tarini2011` chooses among lines that may drift; here the mixed-integer problem of the map decides about all
//! lines at once, with separation rows that keep irregular vertices apart.

use super::triangulated::Triangulated;
use crate::error::Result;
use crate::map::{SeamlessMap, SeamlessProblem, Sizing};
use crate::mesh::features::FeatureGraph;
use crate::monitor::Monitor;
use crate::search::Options;
use crate::solve::{SoftRow, Solver};
use crate::untangle::{FAR, Structure, UntangleOptions};

/// The most times that integers are decided anew because they bring irregular vertices together.
const ROUNDS: usize = 8;

/// The most nodes of the search for integers.
const NODES: usize = 1_000_000;

/// The problem of maps of any size.
pub(super) struct CoarseMaps<'a> {
    of: &'a Triangulated,
    problem: SeamlessProblem,
    solver: Solver,
    structure: Option<Structure>,
}

impl<'a> CoarseMaps<'a> {
    /// Maps in which these edges of the triangles are isolines of integers.
    pub(super) fn new(of: &'a Triangulated, features: &[usize], quads: usize) -> Result<Self> {
        let features = FeatureGraph::from_edges(&of.mesh, features)?;
        let sizing = Sizing::Quads(quads);
        let problem = SeamlessProblem::with_features(&of.mesh, &of.field, &sizing, &features)?;
        Ok(CoarseMaps {
            of,
            solver: Solver::new(problem.problem())?,
            problem,
            structure: None,
        })
    }

    /// A map of about this many quads, if one without folds is found.
    pub(super) fn map<'m>(
        &mut self,
        quads: usize,
        monitor: &impl Fn() -> Monitor<'m>,
    ) -> Result<Option<SeamlessMap>> {
        let mesh = &self.of.mesh;
        self.problem
            .resize(mesh, &Sizing::Quads(quads), &mut self.solver)?;
        let options = Options {
            nodes: NODES,
            ..Options::default()
        };
        let solution = self.solver.solve_with(&options, monitor())?;
        let mut map = self.problem.map(mesh, &solution)?;
        let structure = match self.structure.take() {
            Some(structure) => structure,
            None => Structure::new(mesh, &self.problem, &map, &mut monitor())?,
        };
        let elements = structure.held_elements(mesh, &self.problem, FAR, &monitor())?;
        let mut rows: Vec<SoftRow> = Vec::new();
        for _ in 0..ROUNDS {
            let known = rows.len();
            for row in elements.missed(mesh, &self.problem, &map) {
                if !rows.contains(&row) {
                    rows.push(row);
                }
            }
            if rows.len() == known {
                break;
            }
            let solution = self.solver.solve_softly(&rows, &options, monitor())?;
            map = self.problem.map(mesh, &solution)?;
        }
        let effort = UntangleOptions::default();
        let untangled = structure.untangle(mesh, &self.problem, &map, &effort, &mut monitor())?;
        self.structure = Some(structure);
        Ok((untangled.faults() == 0).then_some(untangled.map))
    }
}

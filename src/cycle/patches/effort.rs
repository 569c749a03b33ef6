//! How much is done for a proof.

use super::dissect::Recipe;
use crate::cycle::space::CycleSpace;
use crate::search::Options;

/// `auto`: the most multiplications of a proof, about three seconds.
const BRIEF: u64 = 800_000_000;

/// `auto`: the multiplications of a proof for each edge, about a tenth of a millisecond. Ten times as many
/// lower the gap of the corpus' fields of up to 2,000 faces from 8 to 5 % at the most.
const PER_EDGE: u64 = 30_000;

/// `auto`: systems of more edges get one bisection of each patch instead of several.
const SEVERAL: usize = 60_000;

/// `auto`: systems of more edges get no bound.
const MOST: usize = 250_000;

/// `auto`: the seed of the tree. Gaps differ by a third and more from seed to seed; of eight that were tried, this one had
/// small ones on most fields of the corpus.
const SEED: u64 = 33;

/// `exact`: the multiplications for each node that may be visited. They include those that prepare the
/// enumerations, and those of the first tests of pairs.
const PER_NODE: u64 = 20;

/// `exact`: the number of trees that are tried.
const TREES: u64 = 12;

/// `exact`: the multiplications after which no further tree is tried.
const TRIALS: u64 = 1_200_000_000;

/// The effort of a proof.
#[derive(Debug, Clone)]
pub(in crate::cycle) struct Proof {
    /// The trees that are tried. The one with the best bound is continued.
    pub recipes: Vec<Recipe>,
    /// The multiplications after which no further tree is tried.
    pub trials: u64,
    /// The largest number of multiplications.
    pub work: u64,
    /// The largest number of nodes.
    pub nodes: u64,
    /// Whether charges that violate conditions of optimality are dropped.
    pub conditions: bool,
}

impl Proof {
    /// That of `auto`.
    pub fn brief(space: &CycleSpace) -> Self {
        let edges = space.system.graph.edges.len();
        let recipe = Recipe {
            floors: match edges > SEVERAL {
                true => vec![0.4],
                false => vec![0.1, 0.4, 1.5],
            },
            tries: 1,
            seed: SEED,
            ..recipe(0)
        };
        Proof {
            recipes: vec![recipe],
            trials: 0,
            work: if edges > MOST {
                0
            } else {
                BRIEF.min(PER_EDGE * edges as u64)
            },
            nodes: u64::MAX,
            conditions: false,
        }
    }

    /// That of `exact`, with the option `nodes`.
    pub fn thorough(nodes: usize) -> Self {
        Proof {
            recipes: (0..TREES).map(recipe).collect(),
            trials: TRIALS,
            work: (nodes as u64).saturating_mul(PER_NODE),
            // The library's own budget is one of work.
            nodes: match nodes == Options::default().nodes {
                true => u64::MAX,
                false => nodes as u64,
            },
            conditions: true,
        }
    }
}

/// The recipe of the tree with this number.
fn recipe(number: u64) -> Recipe {
    const LEAVES: [usize; 4] = [16, 16, 30, 8];
    const BALANCES: [f64; 2] = [0.8, 0.5];
    Recipe {
        leaf: LEAVES[(number % 4) as usize],
        floors: vec![0.1, 0.4, 1.5],
        tries: 2,
        price: 0.02,
        balance: BALANCES[(number % 2) as usize],
        seed: 1 + number,
    }
}

//! The fundamental cycles of a spanning forest: the third step of the cycle method.

use super::forest::Forest;
use super::graph::Graph;

/// The cycle of the forest and edge `e`, where `e` is a *chord*: an edge outside the forest. The cycle runs
/// through `e` from tail to head. None if it is longer than `longest`.
pub(super) fn fundamental_cycle(
    graph: &Graph,
    forest: &Forest,
    e: u32,
    longest: usize,
) -> Option<Vec<(u32, i8)>> {
    let edge = &graph.edges[e as usize];
    let (mut up, mut down) = (vec![(e, 1)], Vec::new());
    let (mut a, mut b) = (edge.head, edge.tail);
    while a != b {
        if up.len() + down.len() == longest {
            return None;
        }
        let from_head = forest.depth[a as usize] >= forest.depth[b as usize];
        let node = if from_head { &mut a } else { &mut b };
        let parent = forest.parent[*node as usize];
        let climbed = &graph.edges[parent as usize];
        let sign = climbed.sign_from(*node);
        *node = climbed.other(*node);
        if from_head {
            up.push((parent, sign));
        } else {
            down.push((parent, -sign));
        }
    }
    up.extend(down.into_iter().rev());
    Some(up)
}

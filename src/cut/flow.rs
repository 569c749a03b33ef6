//! The maximum flow between moves: push and relabel, first in first out (`goldberg1988`).
//!
//! A label is a lower bound on the number of arcs with room to the nearest node of negative excess. Labels
//! are computed anew after a number of relabels that is proportional to the graph (`cherkassky1997`). That
//! computation also moves the integers where excess cannot flow on. So flow that is there stays there
//! through all moves.

use std::collections::VecDeque;

use super::network::Network;
use super::price::Labels;

/// Arcs scanned in relabels, for each arc, before labels are computed anew.
const RELABELS: usize = 1;

/// Rounds of moves with one step length before a start counts as far, and the step is doubled.
const FAR: u32 = 48;

/// Arcs scanned between two questions whether to end.
const PATIENCE: usize = 1 << 16;

/// Moves the integers until the flow proves that they are optimal. `ends` counts scanned arcs and says
/// whether to end. Returns whether the integers are optimal.
///
/// Every move lowers the energy. From a far start the step is doubled a few times and then halved.
pub(super) fn descend(network: &mut Network, ends: &mut dyn FnMut(u64) -> bool) -> bool {
    let mut labels = Labels::new(network.nodes());
    let mut longer = true;
    let mut rounds = 0;
    loop {
        let update = labels.update(network);
        if ends(update.work) {
            return false;
        }
        if update.done {
            if network.scale == 0 {
                return true;
            }
            longer = false;
            if !network.refine() {
                return false;
            }
            continue;
        }
        rounds += u32::from(update.moved);
        if longer && rounds == FAR {
            rounds = 0;
            if network.scale < 50 {
                network.scale += 1;
                continue;
            }
        }
        if push_and_relabel(network, &mut labels.label, ends) {
            return false;
        }
    }
}

/// Pushes excess towards the nodes of negative excess, until none can go on or new labels are due. Returns
/// whether to end.
fn push_and_relabel(
    network: &mut Network,
    label: &mut [u32],
    ends: &mut dyn FnMut(u64) -> bool,
) -> bool {
    let nodes = network.nodes();
    let far = nodes as u32;
    let mut budget = RELABELS * 2 * network.ends.len() + nodes;
    let mut current: Vec<u32> = (0..nodes).map(|i| network.range(i).start as u32).collect();
    let active =
        |network: &Network, label: &[u32], i: usize| network.excess[i] > 0 && label[i] < far;
    let mut queue: VecDeque<u32> = (0..nodes as u32)
        .filter(|&i| active(network, label, i as usize))
        .collect();
    // How many nodes have each label. If none has, those with higher labels have no path to any that has a
    // lower one, and nothing above the gap is worth a relabel.
    let mut count = vec![0u32; nodes + 1];
    label.iter().for_each(|&l| count[l as usize] += 1);
    let mut gap = far;
    let mut scanned = 0;
    while let Some(i) = queue.pop_front() {
        let i = i as usize;
        if label[i] > gap {
            continue;
        }
        let range = network.range(i);
        let mut at = current[i] as usize;
        while network.excess[i] > 0 {
            if at == range.end {
                // No arc leads down: the new label is one more than the least of a neighbour with room.
                let mut least = far - 1;
                for at in range.clone() {
                    let (edge, other, is_head) = network.arc(at);
                    if network.room(edge, is_head) > 0 {
                        least = least.min(label[other]);
                    }
                }
                count[label[i] as usize] -= 1;
                if count[label[i] as usize] == 0 {
                    gap = gap.min(label[i]);
                }
                label[i] = least + 1;
                count[label[i] as usize] += 1;
                at = range.start;
                scanned += 2 * range.len();
                budget = budget.saturating_sub(range.len() + 1);
                if label[i] >= far || label[i] > gap || budget == 0 {
                    break;
                }
                continue;
            }
            let (edge, other, is_head) = network.arc(at);
            if label[i] == label[other] + 1 {
                let room = network.room(edge, is_head);
                if room > 0 {
                    let amount = room.min(network.excess[i]);
                    let was_active = network.excess[other] > 0;
                    network.flow[edge] += if is_head { -amount } else { amount };
                    network.excess[i] -= amount;
                    network.excess[other] += amount;
                    if !was_active && network.excess[other] > 0 {
                        queue.push_back(other as u32);
                    }
                    if amount < room {
                        break;
                    }
                }
            }
            at += 1;
        }
        current[i] = at as u32;
        if scanned >= PATIENCE {
            if ends(scanned as u64) {
                return true;
            }
            scanned = 0;
        }
        if budget == 0 {
            break;
        }
    }
    ends(scanned as u64)
}

//! Step 2: vertices of equal position become one, the lowest.
//!
//! An open-addressing hash table over the bits of the coordinates; 0 equals -0. It holds one number for
//! each position, and its order of insertion is that of the vertices, so that the result depends on
//! nothing else.

use super::lists::NONE;
use crate::linalg::vector::Vec3;

/// For each vertex the lowest of equal position, or [`NONE`] if a coordinate is not finite.
pub(super) fn equal_positions(positions: &[Vec3]) -> Vec<u32> {
    let size = (2 * positions.len()).next_power_of_two().max(2);
    let shift = 64 - size.trailing_zeros();
    let mut table = vec![NONE; size];
    let mut stands_for = Vec::with_capacity(positions.len());
    for (vertex, position) in positions.iter().enumerate() {
        if position.iter().any(|x| !x.is_finite()) {
            stands_for.push(NONE);
            continue;
        }
        let mut slot = (hash(position.map(|x| (x + 0.0).to_bits())) >> shift) as usize;
        let lowest = loop {
            match table[slot] {
                NONE => {
                    table[slot] = vertex as u32;
                    break vertex as u32;
                }
                other if positions[other as usize] == *position => break other,
                _ => slot = (slot + 1) & (size - 1),
            }
        };
        stands_for.push(lowest);
    }
    stands_for
}

/// Three words mixed to one whose upper bits are spread evenly.
pub(super) fn hash(words: [u64; 3]) -> u64 {
    words.into_iter().fold(0, |mixed: u64, word| {
        let mixed = (mixed ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        (mixed ^ mixed >> 32).wrapping_mul(0xd6e8_feb8_6659_fd93)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_of_equal_position_stands_for_all() {
        let nan = f64::NAN;
        let positions = [
            [0.0, 1.0, 2.0],
            [-0.0, 1.0, 2.0],
            [nan, 0.0, 0.0],
            [0.0, 1.0, 2.0 + 1e-15],
            [0.0, 1.0, 2.0],
        ];
        assert_eq!(equal_positions(&positions), [0, 0, NONE, 3, 0]);
    }
}

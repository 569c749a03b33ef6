//! Disjoint sets (union-find with path halving): which elements have been joined, directly or through
//! others.

/// A partition of `0..len`. The least element of a set identifies the set.
#[derive(Debug, Clone)]
pub(crate) struct DisjointSets {
    parent: Vec<u32>,
}

impl DisjointSets {
    /// Puts every element into a set of its own.
    pub fn new(len: usize) -> Self {
        DisjointSets {
            parent: (0..len as u32).collect(),
        }
    }

    /// The least element of the set of `element`.
    pub fn root(&mut self, element: usize) -> usize {
        let mut at = element;
        while self.parent[at] as usize != at {
            self.parent[at] = self.parent[self.parent[at] as usize];
            at = self.parent[at] as usize;
        }
        at
    }

    /// Joins the sets of `a` and `b`. Returns whether they were different.
    pub fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b)] = a.min(b) as u32;
        a != b
    }

    /// The sets, ordered by their least elements. The elements of each set increase.
    pub fn sets(mut self) -> Vec<Vec<usize>> {
        let mut sets = vec![Vec::new(); self.parent.len()];
        for element in 0..sets.len() {
            sets[self.root(element)].push(element);
        }
        sets.retain(|set| !set.is_empty());
        sets
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_elements_are_in_one_set() {
        let mut sets = DisjointSets::new(6);
        assert!(sets.join(4, 1) && sets.join(5, 2) && sets.join(1, 5));
        assert!(!sets.join(4, 2));
        assert_eq!((sets.root(5), sets.root(3)), (1, 3));
        assert_eq!(sets.sets(), [vec![0], vec![1, 2, 4, 5], vec![3]]);
    }
}

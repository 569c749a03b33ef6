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

/// The sets of `len` elements of which each is joined with those that `before` names, all of lower number: the set of
/// each element, and the number of sets. They are numbered in the order of their least elements.
///
/// # Errors
/// The first that `go_on` returns, which is asked with the number of each element.
pub(crate) fn joined_sets<E, I: Iterator<Item = usize>>(
    len: usize,
    before: impl Fn(usize) -> I,
    go_on: impl Fn(usize) -> Result<(), E>,
) -> Result<(Vec<u32>, usize), E> {
    // Each element joins the group of one before it, if there is one. There are few groups, so that it takes little
    // time to see which of them are joined by other elements.
    let mut set = vec![0; len];
    let mut groups = 0;
    for i in 0..len {
        go_on(i)?;
        set[i] = match before(i).next() {
            Some(j) => set[j],
            None => {
                groups += 1;
                groups - 1
            }
        };
    }
    let mut joined = DisjointSets::new(groups as usize);
    for i in 0..len {
        go_on(i)?;
        for j in before(i).filter(|&j| set[j] != set[i]) {
            joined.join(set[i] as usize, set[j] as usize);
        }
    }
    let mut number = vec![0; groups as usize];
    let mut count = 0;
    for group in 0..number.len() {
        let least = joined.root(group);
        number[group] = match least == group {
            true => {
                count += 1;
                count - 1
            }
            false => number[least],
        };
    }
    set.iter_mut().for_each(|set| *set = number[*set as usize]);
    Ok((set, count as usize))
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;
    use crate::test_random::Random;

    #[test]
    fn sets_are_numbered_in_the_order_of_their_least_elements() {
        let mut random = Random::new(3);
        for len in [0, 1, 2, 5, 40, 300] {
            for joins in [0, 1, len / 2, 2 * len] {
                let mut before = vec![Vec::new(); len];
                let mut sets = DisjointSets::new(len);
                for _ in 0..if len > 1 { joins } else { 0 } {
                    let (i, j) = (random.below(len), random.below(len));
                    if i != j {
                        before[i.max(j)].push(i.min(j));
                        sets.join(i, j);
                    }
                }
                let of = |i: usize| before[i].iter().copied();
                let found = joined_sets(len, of, |_| Ok::<_, Infallible>(()));
                let Ok((set, count)) = found;
                let expected = sets.sets();
                assert_eq!(count, expected.len());
                for (k, elements) in expected.iter().enumerate() {
                    assert!(elements.iter().all(|&i| set[i] == k as u32));
                }
            }
        }
        let ended = joined_sets(
            9,
            |_| std::iter::empty(),
            |i| if i < 5 { Ok(()) } else { Err(i) },
        );
        assert_eq!(ended, Err(5));
    }

    #[test]
    fn joined_elements_are_in_one_set() {
        let mut sets = DisjointSets::new(6);
        assert!(sets.join(4, 1) && sets.join(5, 2) && sets.join(1, 5));
        assert!(!sets.join(4, 2));
        assert_eq!((sets.root(5), sets.root(3)), (1, 3));
        assert_eq!(sets.sets(), [vec![0], vec![1, 2, 4, 5], vec![3]]);
    }
}

//! Lists that copies of a problem share until one of them changes its own.

use std::sync::Arc;

use crate::error::{Error, Result};

/// The list, to be changed, with room for `more` elements: a copy where others share it. Changes nothing if that
/// fails.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub(super) fn own<'a, T: Clone>(
    list: &'a mut Arc<Vec<T>>,
    more: usize,
    what: &'static str,
) -> Result<&'a mut Vec<T>> {
    let no_memory = |_| Error::OutOfMemory { what };
    if Arc::get_mut(list).is_none() {
        let mut copy = Vec::new();
        copy.try_reserve_exact(list.len() + more)
            .map_err(no_memory)?;
        copy.extend_from_slice(list);
        *list = Arc::new(copy);
    }
    let own = Arc::make_mut(list);
    own.try_reserve(more).map_err(no_memory)?;
    Ok(own)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{Problem, Triangle};

    #[test]
    fn a_list_is_copied_where_it_is_shared_and_only_there() {
        let mut list = Arc::new(vec![1, 2]);
        let before = Arc::as_ptr(&list);
        own(&mut list, 1, "numbers").unwrap().push(3);
        assert_eq!(Arc::as_ptr(&list), before);
        let other = Arc::clone(&list);
        own(&mut list, 1, "numbers").unwrap().push(4);
        assert_eq!((&list[..], &other[..]), (&[1, 2, 3, 4][..], &[1, 2, 3][..]));
    }

    #[test]
    fn copies_of_a_problem_share_quadratic_entries_until_one_adds_some() {
        let mut problem = Problem::new(2).unwrap();
        let add = |problem: &mut Problem, value| {
            problem.add_quadratic_triplets(Triangle::Lower, &[1], &[0], &[value])
        };
        add(&mut problem, 1.0).unwrap();
        let mut copy = problem.clone();
        assert_eq!(copy.quadratic().as_ptr(), problem.quadratic().as_ptr());
        add(&mut copy, 2.0).unwrap();
        assert_eq!(problem.quadratic(), [(1, 0, 1.0)]);
        assert_eq!(copy.quadratic(), [(1, 0, 1.0), (1, 0, 2.0)]);
    }

    #[test]
    fn memory_that_cannot_be_had_is_an_error_and_changes_nothing() {
        for shared in [false, true] {
            let mut list = Arc::new(vec![1.0]);
            let other = shared.then(|| Arc::clone(&list));
            let error = own(&mut list, isize::MAX as usize / 8, "numbers").unwrap_err();
            assert_eq!(error.code(), "out_of_memory");
            assert_eq!(*list, [1.0]);
            drop(other);
        }
    }
}

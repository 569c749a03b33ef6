//! Exact greedy rounding: round the integer that is closest to a whole number, re-optimise, repeat.
//!
//! This is the "naive greedy rounding" of `bommes2012`, section 5.3. Each step re-optimises exactly without
//! a new factorization: see [`crate::linalg::FixedSolve`]. With few integers it works on their Schur
//! complement alone, otherwise on the sparse factor of the whole Hessian.

use super::direct::round_all;
use crate::eliminate::ReducedModel;
use crate::error::Result;
use crate::linalg::FixedSolve;
use crate::monitor::Phase;
use crate::search::{Factors, Search};

/// Deviations that exceed the least one by at most this are ties. The lowest variable wins a tie.
pub const TIE: f64 = 1e-9;

/// Rounds one integer at a time, offers the result and returns it.
///
/// If it has to stop early, it offers the integers decided so far and rounds the others.
///
/// # Errors
/// [`Error::OutOfMemory`](crate::Error::OutOfMemory), and the errors of [`Search::offer`].
pub(crate) fn greedy(
    model: &ReducedModel,
    factors: &mut Factors,
    search: &mut Search,
) -> Result<Vec<f64>> {
    let integers = model.integers();
    search.prepare(factors)?;
    let go_on = || !search.monitor.ends();
    let Some(mut factor) = factors.updatable(model, go_on)? else {
        return round_all(model, factors, search);
    };
    let relaxed = |&i: &u32| search.relaxed()[i as usize];
    let point: Vec<f64> = factor.unknowns.iter().map(relaxed).collect();
    let watched = factor.integers;
    let mut solve = FixedSolve::new(&mut factor.ldl, &point, &watched)?;
    let nearest = |place: usize, solve: &FixedSolve| {
        model.nearest(integers[place] as usize, solve.value(watched[place]))
    };
    let mut rounded = vec![0.0; integers.len()];
    // Places in `integers`, increasing.
    let mut free: Vec<u32> = (0..integers.len() as u32).collect();
    while !free.is_empty() {
        let done = 1.0 - free.len() as f64 / integers.len() as f64;
        if search.monitor.ends_at(Phase::Round, done) {
            for &place in &free {
                rounded[place as usize] = nearest(place as usize, &solve);
            }
            break;
        }
        let at = closest(&free, |place| solve.value(watched[place as usize]));
        let place = free.remove(at) as usize;
        rounded[place] = nearest(place, &solve);
        solve.fix(watched[place], rounded[place]);
    }
    search.offer(factors, &rounded)?;
    Ok(rounded)
}

/// Position in `free` of the value closest to an integer, the first among ties.
fn closest(free: &[u32], value: impl Fn(u32) -> f64) -> usize {
    let deviation = |&place: &u32| {
        let x = value(place);
        (x - x.round()).abs()
    };
    let least = free.iter().map(deviation).fold(f64::INFINITY, f64::min);
    let tied = |place: &u32| deviation(place) <= least + TIE;
    free.iter().position(tied).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_of_tied_deviations_wins() {
        let values = [0.3, 1.2 + 5e-10, 0.8, 3.5];
        assert_eq!(closest(&[0, 1, 2, 3], |p| values[p as usize]), 1);
        assert_eq!(closest(&[0, 2, 3], |p| values[p as usize]), 1);
    }
}
